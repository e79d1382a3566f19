// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_rounded_patch_h
#define ricochet_contact_surfaces_rounded_patch_h

#include <contact/surfaces/contact_surface.h>
#include <contact/surfaces/rounded_gap.h>

#include <array>
#include <vector>

namespace Ricochet
{
  /// Facets of a surface with rounded edges that a point is in contact with in a step, see
  /// RoundedGap.
  struct RoundedPatch
  {
    /// An edge between two facets of the patch, and its number in each of them.
    struct Edge
    {
      unsigned int first, second, number_in_first, number_in_second;
      /// Half width of its rounding (m).
      double width;

      /// Coordinate of the point from the bisector, positive on the side of the second facet,
      /// from its distances from the edge in both (m).
      template <typename Number>
      static Number
      coordinate(const Number &in_first, const Number &in_second)
      {
        return .5 * (in_second - in_first);
      }
    };

    /// An open edge of a facet of the patch, and its number in it.
    struct OpenEdge
    {
      unsigned int facet, number;
      /// Half of the largest overhang of the point (m).
      double half_overhang;

      /// Coordinate of the point from the middle of the range of overhangs, positive
      /// outwards, from its distance from the edge (m).
      template <typename Number>
      Number
      coordinate(const Number &from_edge) const
      {
        return -from_edge - half_overhang;
      }
    };

    /// The facet where the search begins is the first one.
    std::vector<unsigned int> facets;
    /// See RoundedGap::counts.
    std::vector<bool> counts;
    std::vector<Edge> edges;
    /// Open edges that the point is beyond at one of the instants.
    std::vector<OpenEdge> open_edges;
    /// Nodes of the facets, and the numbers of their corners among these.
    std::vector<unsigned int>                nodes;
    std::vector<std::array<unsigned int, 3>> corners;
  };

  /// Finds the patches of points on a surface in 3D.
  class RoundedPatches
  {
  public:
    using Position = std::array<double, 3>;

    /// A point and the nodes of the surface at one instant.
    struct Instant
    {
      Position                     point;
      const std::vector<Position> &nodes;
    };

    /// Whether facets belong to a patch that the point is near at the beginning of the step
    /// only, or at one of its ends.
    enum class NearAt
    {
      begin,
      begin_or_end
    };

    /// Largest number of facets and edges, also open ones, of a patch.
    static constexpr unsigned int most_scalars = 96;

    /// @param surface must outlive this object.
    explicit RoundedPatches(const ContactSurface<3> &surface);

    /**
     * The patch of a point in a step, whose neighbours are found from facet @p f on. It has all
     * facets with a weight at one of the instants, and those whose edges these weights
     * depend on.
     *
     * @param largest_overhang beyond open edges, at which the coverage is 0 (m).
     * @param gap gets the distances of the point from the planes of the facets, and the
     * coordinates of the edges.
     * @return whether it is small enough; points that face more are far off or pass many
     * facets in a step.
     */
    bool
    find(const unsigned int  f,
         const Instant      &begin,
         const Instant      &end,
         const NearAt        near_at,
         const double        largest_overhang,
         RoundedPatch       &patch,
         RoundedGap<double> &gap) const;

  private:
    /// Distances of a point from a facet: along its plane from the edges, positive inside, and from
    /// the nodes; and from the plane, positive in front (m).
    struct Distances
    {
      std::array<double, 3> from_edges, from_nodes;
      double                from_plane;
    };

    /// Facets, and their distances at both instants.
    struct Candidates
    {
      std::vector<unsigned int>             facets;
      std::vector<std::array<Distances, 2>> distances;
    };

    /// Half width of the rounding between two facets (m).
    double
    width(const unsigned int f, const unsigned int other) const;

    /// The edges of facet @p f have roundings of no more than this half width (m).
    double
    largest_width(const unsigned int f) const;

    /// The number of the edge of facet @p f beyond which its @p neighbour is.
    unsigned int
    number_of_edge(const unsigned int f, const unsigned int neighbour) const;

    static Distances
    distances(const std::array<Position, 4> &x);

    std::array<Position, 4>
    corners(const unsigned int f, const Instant &instant) const;

    void
    add(const unsigned int f,
        const Instant     &begin,
        const Instant     &end,
        Candidates        &candidates) const;

    /// The coordinate of the edge between two candidates at instant @p k.
    double
    coordinate(const Candidates         &candidates,
               const RoundedPatch::Edge &edge,
               const unsigned int        k) const;

    /// The facets that may have a weight, from facet @p f on. @return whether they are few.
    bool
    collect(const unsigned int f,
            const Instant     &begin,
            const Instant     &end,
            const NearAt       near_at,
            const double       largest_overhang,
            Candidates        &candidates) const;

    /// All edges between the candidates.
    void
    collect_edges(const Candidates                &candidates,
                  std::vector<RoundedPatch::Edge> &edges) const;

    const ContactSurface<3> &surface;
    /// The facets at each node, and within which distance of the node all of them are
    /// candidates (m).
    std::vector<std::vector<unsigned int>> at_node;
    std::vector<double>                    radius_of_node;
    std::vector<bool>                      has_open_edge;
  };
} // namespace Ricochet

#endif
