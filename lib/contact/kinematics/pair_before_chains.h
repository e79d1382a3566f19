// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_pair_before_chains_h
#define ricochet_contact_kinematics_pair_before_chains_h

#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/facet_chain.h>

#include <boost/container/static_vector.hpp>

#include <limits>
#include <optional>

namespace Ricochet
{
  template <int dim>
  class FacetSearch;

  /// Surfaces in 2D, whose facets follow each other like the links of a chain, and in
  /// 1D, where they are points.
  template <int dim>
  class PairBeforeChains : public SurfacePair<dim>
  {
  public:
    using typename SurfacePair<dim>::Point;
    using typename SurfacePair<dim>::Position;
    using SurfacePair<dim>::SurfacePair;

  protected:
    using SurfacePair<dim>::master;

    /// Connected facets and their nodes: one that a point faces, and at most two on
    /// either side.
    struct Chain
    {
      static constexpr unsigned int n_beside = 2, most = 2 * n_beside + 1;

      boost::container::static_vector<unsigned int, most>     facets;
      boost::container::static_vector<unsigned int, most + 1> nodes;
    };

    /// The facet that a point faces.
    struct Facing
    {
      Chain chain;
      /// Index in the chain.
      unsigned int facet = 0;
    };

    /// The facet @p f of the master surface and two more on each side; @p place is
    /// its index among them.
    Chain
    chain_around(const unsigned int f, unsigned int &place) const;

    /// The position @p y and those of the nodes of @p chain, in #work.
    const std::vector<Position> &
    gather(const Position              &y,
           const Chain                 &chain,
           const std::vector<Position> &master_x) const;

    /// The gap at positions from gather().
    double
    gap_before(const std::vector<Position> &x,
               const Chain                 &chain,
               const unsigned int           facet) const;

    /// The facet of the chain that the point faces, beginning with @p facet.
    unsigned int
    facet_before(const std::vector<Position> &x,
                 const unsigned int           facet) const;

    /// The place of the point along @p facet of a chain, from its first node, and the length
    /// of the facet (m); zeros in 1D.
    static std::pair<double, double>
    place_along(const std::vector<Position> &x, const unsigned int facet);

    /// Whether the point is beyond an open end of the surface by more than @p
    /// largest_overhang (m), or beside it.
    bool
    is_off(const std::vector<Position> &x,
           const Chain                 &chain,
           const unsigned int           facet,
           const double                 largest_overhang) const;

    /// The facet that the point @p y of the slave with the outward @p normal faces,
    /// among those of @p search, if there is one. The positions are in #work then.
    ///
    /// @param largest_overhang beyond an open end of the surface (m).
    /// @param self the point, where a surface is searched for self-contact: its
    /// own facets and their neighbours are left out, and so are those on the far
    /// side of the wall that it is on.
    /// @param largest_distance largest distance from the facet (m).
    std::optional<Facing>
    find_facet(const Position              &y,
               const Position              &normal,
               const FacetSearch<dim>      &search,
               const std::vector<Position> &master_x,
               const double                 largest_overhang,
               const Point                 *self = nullptr,
               const double                 largest_distance =
                 std::numeric_limits<double>::infinity()) const;

    /// Largest depth behind a facet for contact, which does not reach through a
    /// body (m).
    double
    largest_depth(const Facing &facing) const
    {
      return master.facets[facing.chain.facets[facing.facet]].measure;
    }

    mutable std::vector<Position> work;

  private:
    /// Whether the @p point and facet @p f of one surface share a node.
    bool
    shares_node(const Point &point, const unsigned int f) const;

    /// Whether facet @p f of its own surface can touch the @p point at @p y.
    bool
    can_touch_itself(const Point                 &point,
                     const unsigned int           f,
                     const Position              &y,
                     const Position              &normal_of_point,
                     const std::vector<Position> &master_x) const;
  };
} // namespace Ricochet

#endif
