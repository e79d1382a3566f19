// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_points_before_facets_h
#define ricochet_contact_kinematics_points_before_facets_h

#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/facet_chain.h>

namespace Ricochet
{
  /**
   * Each point of the slave, a node or a quadrature point, is held by the one facet
   * of the master before which it is (node to segment).
   *
   * No history enters: that facet follows from where both are (see FacetChain for
   * vertices, which a point may pass during a step). So gaps at the end of a step
   * are those at the beginning of the next one.
   */
  template <int dim>
  class PointsBeforeFacets : public SurfacePair<dim>
  {
  public:
    using typename SurfacePair<dim>::Derivatives;
    using typename SurfacePair<dim>::Index;
    using typename SurfacePair<dim>::Point;
    using typename SurfacePair<dim>::Position;
    using typename SurfacePair<dim>::Rows;

    enum class PointsIn
    {
      nodes,
      quadrature_points
    };

    /// @throws InputError see SurfacePair.
    PointsBeforeFacets(const Body<dim>   &body,
                       const ContactPair &pair,
                       const PointsIn     points_in);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int p,
                const double       pressure,
                const double       traction,
                const bool         freeze_convex) const override;

    void
    stay_at_vertex(const unsigned int p, const double tolerance) override;

    int
    passage(const unsigned int p) const override;

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

  private:
    using typename SurfacePair<dim>::Chain;
    using typename SurfacePair<dim>::Facing;
    using typename SurfacePair<dim>::Gaps;
    using typename SurfacePair<dim>::Positions;
    using SurfacePair<dim>::gaps;
    using SurfacePair<dim>::master;
    using SurfacePair<dim>::own_points;
    using SurfacePair<dim>::slave;
    using SurfacePair<dim>::work;

    /// At most a point and six nodes: a point that passes four vertices in a step.
    static constexpr unsigned int max_coordinates = 14;
    using Differentiable = Sacado::Fad::SLFad<double, max_coordinates>;

    /// Rows on the coordinates of the point and of nodes of the chain.
    template <typename Number>
    using ChainRows = typename FacetChain<Number>::Rows;

    struct Step
    {
      Chain chain;
      /// Facets of the chain before which the point is at both ends of the step.
      unsigned int old_facet = 0, new_facet = 0;
      /// It may pass vertices: it begins between the bisectors of the old facet.
      bool may_pass = false;

      bool up_to_date = false;
      Rows rows;
      /// Of the unknown k of the rows the coordinate[k] of the chain moves, by
      /// factor[k].
      std::vector<unsigned int> coordinate;
      std::vector<double>       factor;
    };

    void
    make_quadrature_points(const Body<dim> &body);

    /// Position of the point @p p and those of the nodes of its chain.
    const std::vector<Position> &
    gather_all(const unsigned int p,
               const Chain       &chain,
               const Positions   &positions) const;

    /// The facet before which the point is at the end of @p step, with positions @p
    /// x.
    unsigned int
    last_facet(const std::vector<Position> &x, const Step &step) const;

    /// The facet before which a point is at the beginning of a step, if there is one.
    void
    find_facet_now(const unsigned int p, const FacetSearch<dim> &search);

    /// For a point that is not pressed, a facet that it is in front of and before
    /// which it will be @p later, if there is one.
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
                 const bool         freeze_convex = false) const;

    void
    update(const unsigned int p) const;

    Positions                     old_positions, new_positions;
    mutable std::vector<Step>     steps;
    mutable std::vector<Position> old_work;
    mutable std::vector<std::array<Differentiable, dim>> differentiable_work;
    mutable ChainRows<double>                            chain_rows;
    mutable ChainRows<Differentiable>                    differentiable_rows;
    mutable Derivatives                                  result;
  };
} // namespace Ricochet

#endif
