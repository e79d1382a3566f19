// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_points_before_facets_h
#define ricochet_contact_kinematics_points_before_facets_h

#include <contact/kinematics/pair_before_chains.h>
#include <contact/surfaces/facet_chain.h>

#include <Sacado_Fad_SLFad.hpp>

namespace Ricochet
{
  /**
   * Each point of the slave, a node or a quadrature point, is in contact with the
   * one facet of the master that it faces (node to segment).
   *
   * The facet depends on the positions alone, without history (see FacetChain for
   * vertices, which a point may pass during a step). So gaps at the end of a step
   * are those at the beginning of the next one.
   *
   * In a concave corner between two facets, a node may be pressed against both at
   * once. With one facet at a time it would be constrained by one only, and
   * oscillate. So where there is a multiplier for it, each node is two points. When
   * the node oscillates, or was pressed from both sides in the step before, one point
   * stays with the facet where it begins, the other one with the facet beyond the
   * concave vertex, and neither of them passes that vertex.
   */
  template <int dim>
  class PointsBeforeFacets : public PairBeforeChains<dim>
  {
  public:
    using typename SurfacePair<dim>::Coefficients;
    using typename SurfacePair<dim>::Derivatives;
    using typename SurfacePair<dim>::Index;
    using typename SurfacePair<dim>::Point;
    using typename SurfacePair<dim>::Position;
    using typename SurfacePair<dim>::Rows;
    using typename SurfacePair<dim>::Tangential;

    enum class PointsIn
    {
      nodes,
      /// Nodes, each with two points and two multipliers.
      nodes_and_valleys,
      quadrature_points,
      /// See SurfacePair::make_corner_points().
      corners
    };

    /// @throws InputError see SurfacePair.
    ///
    /// @param is_smooth vertices are rounded and there is a coverage at open ends, see
    /// FacetChain: for laws, whose energy is a function of the gap.
    PointsBeforeFacets(const Body<dim>   &body,
                       const ContactPair &pair,
                       const PointsIn     points_in,
                       const bool         is_smooth);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int  p,
                const Coefficients &coefficients,
                const Caution       caution) const override;

    void
    stay_at_vertex(const unsigned int p, const double tolerance) override;

    int
    passage(const unsigned int p) const override;

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

    bool
    is_other_side(const unsigned int p) const override
    {
      return p >= n_first_sides;
    }

    std::optional<unsigned int>
    other_side(const unsigned int p) const override
    {
      if (!has_other_sides() || is_other_side(p))
        return {};
      return p + n_first_sides;
    }

    double
    overhang(const unsigned int p) const override;

    double
    softness(const unsigned int p) const override
    {
      return steps[p].is_double ? this->softness_of_doubles : 0.;
    }

  private:
    using typename PairBeforeChains<dim>::Chain;
    using typename PairBeforeChains<dim>::Facing;
    using typename SurfacePair<dim>::Gaps;
    using typename SurfacePair<dim>::Positions;
    using SurfacePair<dim>::gaps;
    using SurfacePair<dim>::is_self;
    using SurfacePair<dim>::master;
    using SurfacePair<dim>::own_points;
    using SurfacePair<dim>::slave;
    using PairBeforeChains<dim>::work;

    /// At most a point and six nodes: a point that passes four vertices in a step.
    static constexpr unsigned int max_coordinates = 14;
    using Differentiable = Sacado::Fad::SLFad<double, max_coordinates>;

    /// Rows on the coordinates of the point and of nodes of the chain.
    template <typename Number>
    using ChainRows = typename FacetChain<Number>::Rows;

    bool
    has_other_sides() const
    {
      return n_first_sides < own_points.size();
    }

    struct Step
    {
      Chain chain;
      /// Facets of the chain that the point faces at the beginning and the end
      /// of the step.
      unsigned int old_facet = 0, new_facet = 0;
      /// The point may pass vertices: it begins between the bisectors of the old
      /// facet.
      bool may_pass = false;
      /// The point is a node on another one, whose constraint is the same or
      /// nearly so.
      bool is_double = false;
      /// The point is the other side of a node, with the row of the facet where it
      /// ends.
      bool is_beyond_valley = false;
      /// The first and the last facet of the chain whose nodes are in the rows.
      unsigned int first = 0, last = 0;
      /// The facets of the chain to which the point may pass.
      unsigned int first_allowed = 0,
                   last_allowed  = std::numeric_limits<unsigned int>::max();

      bool up_to_date = false;
      Rows rows;
      /// Dependence of the rows on the unknowns: unknown k moves the
      /// coordinate[k] of the chain, by factor[k].
      std::vector<unsigned int> coordinate;
      std::vector<double>       factor;
    };

    void
    make_quadrature_points(const Body<dim> &body);

    /// Give each node a point for the other facet of a concave corner.
    void
    make_other_sides();

    /// Assign the points @p p and other_side(p) to the facets of the concave corner
    /// that is the nearest one @p now, if there is one.
    void
    find_valley(const unsigned int p, const Positions &now);

    /// Position of the point @p p and those of the nodes of its chain.
    const std::vector<Position> &
    gather_all(const unsigned int p,
               const Chain       &chain,
               const Positions   &positions) const;

    /// The facet that the point faces at the end of @p step, with positions @p x.
    unsigned int
    last_facet(const std::vector<Position> &x, const Step &step) const;

    /// The sine of the angle of the surface at @p node: positive in a concave
    /// corner.
    double
    turn_at(const unsigned int node) const;

    /// Whether @p p is the one to leave out of two nodes of one surface that meet
    /// each other exactly: two constraints would be the same. The other one faces a
    /// concave corner, which supports it, rather than the tip in it.
    bool
    meets_node(const unsigned int p) const;

    /// The facet of a chain that a point faces.
    struct Place
    {
      Chain        chain;
      unsigned int facet    = 0;
      bool         may_pass = false;
      double       gap      = 0.;
    };

    /// The facets that points face at #old_positions: kept if the last step or report
    /// has found them at these.
    void
    find_places_now();

    /// The facet that a point faces at #old_positions, if there is one.
    std::optional<Place>
    place_now(const unsigned int p, const FacetSearch<dim> &search) const;

    /// Let the point @p p begin at @p place.
    void
    begin_before(const unsigned int p, Place place);

    /// For a point that is not pressed, a facet that it is in front of and will
    /// face @p later, if there is one.
    void
    find_facet_later(const unsigned int      p,
                     const FacetSearch<dim> &search,
                     const Positions        &later);

    /// Whether the point can be followed from @p facet past vertices.
    bool
    may_pass(const std::vector<Position> &x, const unsigned int facet) const;

    template <typename Number>
    void
    compute_rows(const unsigned int p,
                 ChainRows<Number> &rows,
                 const Caution      caution = Caution::none) const;

    void
    update(const unsigned int p) const;

    /// The open ends among the facets of a chain from @p first to @p last.
    OpenEnds
    open_ends(const unsigned int p,
              const Chain       &chain,
              const unsigned int first,
              const unsigned int last) const;

    /// The coverage of a point that faces facets from @p first to @p last of a chain.
    double
    coverage_at(const Positions   &positions,
                const unsigned int p,
                const Chain       &chain,
                const unsigned int first,
                const unsigned int last) const;

    /// Half widths of the vertices of a chain, see FacetChain, in #roundings.
    void
    find_roundings(const Chain &chain) const;

    /// The gap at positions from gather_all() to the surface, whose vertices
    /// are rounded if the point may pass them.
    double
    gap_at(const std::vector<Position> &x,
           const Chain                 &chain,
           const unsigned int           facet,
           const bool                   may_pass) const;

    /// Extend the facets whose nodes are in the rows of a @p step to those behind rounded
    /// vertices nearby.
    void
    find_nodes_of_rows(const std::vector<Position> &x, Step &step) const;

    /// Whether the point of @p step may pass vertices, which are rounded.
    bool
    is_rounded(const Step &step) const
    {
      return is_smooth && step.may_pass;
    }

    const bool                  is_smooth;
    mutable std::vector<double> roundings;
    Positions                   old_positions, new_positions;
    /// The facet of each point, and the positions for which they were found.
    std::vector<std::optional<Place>>                    places_now;
    Positions                                            found_at;
    mutable std::vector<Step>                            steps;
    mutable std::vector<Position>                        old_work;
    mutable std::vector<std::array<Differentiable, dim>> differentiable_work;
    mutable ChainRows<double>                            chain_rows;
    mutable ChainRows<Differentiable>                    differentiable_rows;
    mutable Derivatives                                  result;
    /// Number of points that have another one on the other side: the first
    /// ones.
    unsigned int n_first_sides = 0;
    /// Search distance for facets of the point's own surface (m).
    double self_distance = 0.;
  };
} // namespace Ricochet

#endif
