// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_surface_pair_h
#define ricochet_contact_kinematics_surface_pair_h

#include <contact/kinematics/contact_kinematics.h>
#include <contact/surfaces/contact_pair.h>
#include <contact/surfaces/contact_surface.h>
#include <contact/surfaces/facet_chain.h>

#include <Sacado_Fad_SLFad.hpp>

namespace Ricochet
{
  template <int dim>
  class FacetSearch;

  /**
   * The geometry of contact of the points of one surface with the facets of
   * another one, both of which move: gap, its increment and slip over a step, and
   * the directions of the forces, as rows on the unknowns of both.
   *
   * No history enters: the facet before which a point is follows from where both
   * are (see FacetChain for vertices, which a point may pass during a step). So
   * gaps at the end of a step are those at the beginning of the next one.
   */
  template <int dim>
  class SurfacePair
  {
  public:
    using Position = std::array<double, dim>;

    enum class PointsIn
    {
      nodes,
      quadrature_points
    };

    /// A point of the slave surface that this rank takes care of.
    struct Point
    {
      /// Numbers of nodes of the slave surface, and the weights with which the
      /// point is in their middle.
      std::vector<std::pair<unsigned int, double>> nodes;
      /// Facets of the slave surface whose outward normals it has.
      std::vector<unsigned int> facets;
      /// m^(dim-1)
      double weight = 0.;
      /// h_T (m)
      double                     cell_diameter = 0.;
      dealii::types::boundary_id boundary_id   = 0;
      /// Multipliers of the node; invalid ones in quadrature points.
      std::array<dealii::types::global_dof_index, dim> multipliers;
      /// Held nodes carry no contact.
      bool can_touch = true;
    };

    /// The rows of a point over a step: of the unknown k the coordinate
    /// coordinate[k] of the chain moves, by factor[k].
    struct Unknowns
    {
      std::vector<dealii::types::global_dof_index> index;
      std::vector<unsigned int>                    coordinate;
      std::vector<double>                          factor;
    };

    /// At most a point and six nodes: a point that passes four vertices in a step.
    static constexpr unsigned int max_coordinates = 14;
    using Differentiable = Sacado::Fad::SLFad<double, max_coordinates>;

    template <typename Number>
    using Rows = typename FacetChain<Number>::Rows;

    /// @throws InputError see ContactSurface; and when the surfaces do not face
    /// each other anywhere.
    SurfacePair(const Body<dim>   &body,
                const ContactPair &pair,
                const PointsIn     points_in);

    /// Begin a step: find out before which facets points are. With a step of no
    /// length it is an instant.
    void
    begin_step(const ContactStart &start);

    /// The end of the step.
    void
    evaluate(const Vector &solution);

    const std::vector<Point> &
    points() const
    {
      return own_points;
    }

    /// Whether the point @p p is before a facet, no deeper behind it than its
    /// length, during the step. What follows may only be asked for if it is.
    bool
    is_before_facet(const unsigned int p) const
    {
      return steps[p].is_before_facet;
    }

    /// m
    double
    old_gap(const unsigned int p) const
    {
      return steps[p].old_gap;
    }

    /// m
    double
    new_gap(const unsigned int p) const
    {
      return steps[p].new_gap;
    }

    /// The gap in the middle of the step, if the mean velocity of the step before
    /// goes on (m).
    double
    predicted_gap(const unsigned int p) const
    {
      return steps[p].predicted_gap;
    }

    /// The multipliers of a node at the last begin_step() or evaluate() (Pa).
    const Position &
    multipliers(const unsigned int p) const
    {
      return steps[p].multipliers;
    }

    /// Rows at the state of the last evaluate().
    const Rows<double> &
    rows(const unsigned int p) const;

    /// The same with derivatives with respect to the coordinates at the end of the
    /// step, in work space that the next call overwrites. @param freeze_convex see
    /// FacetChain
    const Rows<Differentiable> &
    differentiated_rows(const unsigned int p, const bool freeze_convex) const;

    /// Let the point end before the facet where it began: until the next begin_step()
    /// it passes no vertex. Only for a point so near to one that the gaps of both
    /// facets differ by less than @p tolerance times the facet's length; others are
    /// left alone.
    void
    stay_at_vertex(const unsigned int p, const double tolerance);

    /// Number of the facet at the end of the step.
    unsigned int
    facet(const unsigned int p) const
    {
      return steps[p].chain.facets[steps[p].new_facet];
    }

    /// Whether the point has passed a vertex in the step.
    bool
    has_passed_vertex(const unsigned int p) const
    {
      return steps[p].new_facet != steps[p].old_facet;
    }

    /// The unknowns on which the rows are.
    const Unknowns &
    unknowns(const unsigned int p) const;

    /// The same with the nodes of one more facet on each side, for sparsity
    /// patterns.
    std::vector<dealii::types::global_dof_index>
    unknowns_nearby(const unsigned int p) const;

    /// Round-off in gaps and increments of point @p p (m).
    double
    round_off(const unsigned int p) const;

  private:
    /// Positions of all nodes of both surfaces (m).
    struct Positions
    {
      std::vector<Position> slave, master;
    };

    /// Facets that hang together, and their nodes.
    struct Chain
    {
      std::vector<unsigned int> facets, nodes;
    };

    struct Step
    {
      bool  is_before_facet = false;
      Chain chain;
      /// Facets of the chain before which the point is at both ends of the step.
      unsigned int old_facet = 0, new_facet = 0;
      /// It may pass vertices: it begins between the bisectors of the old facet.
      bool         may_pass = false;
      double       old_gap = 0., new_gap = 0., predicted_gap = 0.;
      Position     multipliers{};
      bool         up_to_date = false;
      Rows<double> rows;
      Unknowns     unknowns;
    };

    void
    make_points(const Body<dim> &body, const PointsIn points_in);

    /// The positions at @p solution, a vector of displacements, or, with @p
    /// start, what a velocity @p solution makes of them in @p time.
    void
    get_positions(const Vector    &solution,
                  Positions       &positions,
                  const Positions *start = nullptr,
                  const double     time  = 1.) const;

    /// Outward, of any length.
    Position
    normal_of(const Point &point, const std::vector<Position> &slave_x) const;

    Position
    position_of(const Point &point, const std::vector<Position> &slave_x) const;

    /// The facet @p f of the master surface and two more on each side; @p place is
    /// its number among them.
    Chain
    chain_around(const unsigned int f, unsigned int &place) const;

    /// Positions of the point and of the nodes of @p chain, in #work.
    const std::vector<Position> &
    gather(const Point     &point,
           const Chain     &chain,
           const Positions &positions) const;

    /// The gap at positions from gather().
    double
    gap_before(const std::vector<Position> &x,
               const Chain                 &chain,
               const unsigned int           facet) const;

    /// The facet of the chain before which the point is, beginning with @p facet.
    unsigned int
    facet_before(const std::vector<Position> &x,
                 const unsigned int           facet) const;

    /// The facet before which the point is at the end of @p step, with positions @p
    /// x.
    unsigned int
    last_facet(const std::vector<Position> &x, const Step &step) const;

    /// The facet before which a point is at the beginning of a step, if there is one.
    void
    find_facet_now(const Point            &point,
                   const FacetSearch<dim> &search,
                   Step                   &step) const;

    /// For a point that is not pressed, a facet that it is in front of and before
    /// which it will be @p later, if there is one.
    void
    find_facet_later(const Point            &point,
                     const FacetSearch<dim> &search,
                     const Positions        &later,
                     Step                   &step) const;

    /// Whether the point can be followed from @p facet past vertices.
    bool
    may_pass(const std::vector<Position> &x, const unsigned int facet) const;

    /// Whether the point is beyond an open end of the surface, or beside it.
    bool
    is_off(const std::vector<Position> &x,
           const Chain                 &chain,
           const unsigned int           facet) const;

    /// Read the multipliers of all points, where the last vector of get_positions()
    /// was a solution.
    void
    get_multipliers();

    template <typename Number>
    void
    compute_rows(const unsigned int p,
                 Rows<Number>      &rows,
                 const bool         freeze_convex = false) const;

    void
    update(const unsigned int p) const;

    ContactSurface<dim>               slave, master;
    std::vector<Point>                own_points;
    mutable Vector                    ghosted;
    std::vector<std::array<int, dim>> slave_index, master_index;
    Positions                         old_positions, new_positions;
    mutable std::vector<Step>         steps;
    mutable std::vector<Position>     work, old_work;
    mutable std::vector<std::array<Differentiable, dim>> differentiable_work;
    mutable Rows<Differentiable>                         differentiable_rows;
  };
} // namespace Ricochet

#endif
