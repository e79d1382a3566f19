// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_contact_operator_h
#define ricochet_contact_contact_operator_h

#include <base/types.h>
#include <contact/contact_law.h>
#include <contact/contact_points.h>
#include <solvers/tangent.h>

#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace Ricochet
{
  /// What the ledger wants to know of one part of the contact boundary.
  struct ContactSummary
  {
    /// Area of the part (m^(dim-1)); 1 in 1D.
    double area = 0.;
    /// Total contact force, the integral of contact_pressure (N).
    double force = 0.;
    /// Mean gap (m).
    double mean_gap = 0.;
    /// Smallest gap (m), that of a boundary without points being infinite.
    double smallest_gap = std::numeric_limits<double>::infinity();
    /// Largest penetration (m), 0 without.
    double max_penetration = 0.;
    /// Mean of the pressure that the treatment itself stands for (Pa): [P_N]_-
    /// for Nitsche, the multiplier, the reaction over the boundary mass.
    double contact_pressure = 0.;
    /// Mean of the pressure of the body's own stress, -sigma_n(u_h) (Pa).
    double stress_pressure = 0.;
    /// Number of contact points that are active.
    unsigned int active_points = 0;

    /// Add a point to the sums: means are weighted sums until
    /// reduce_summaries() divides them.
    void
    add(const ContactPoint &point,
        const double        gap,
        const double        point_force,
        const bool          is_active);
  };

  /// The beginning of a step or stage, as far as contact looks back.
  struct ContactStart
  {
    /// Unknowns at the beginning of the step.
    const Vector &solution;
    /// Contact force there (N), from which active sets start.
    const Vector &contact_force;
    /// Mean velocity of the step before (m/s), for predictors of the gap.
    const Vector &mean_velocity;
    /// Length of the step (s), over which slip is counted.
    double time_step = 0.;
  };

  /**
   * A contact treatment as time schemes and Newton's method see it. It adds its
   * forces to (or, for active sets, takes rows out of) a residual that already
   * holds everything else.
   *
   * All vectors are system vectors without ghost values; all functions are
   * collective.
   */
  class ContactOperator
  {
  public:
    virtual ~ContactOperator() = default;

    /// Begin the solution of one stage; @p weight is the factor of the new
    /// contact force in the residual.
    virtual void
    begin_stage(const ContactStart &start, const double weight) = 0;

    /// Complete @p residual at @p solution. Nothing is remembered for the next
    /// iterate until accept_iterate() is called, so that a line search can look
    /// at several points.
    virtual void
    complete_residual(const Vector &solution, Vector &residual) = 0;

    /// The point of the last complete_residual() is the next iterate.
    virtual void
    accept_iterate()
    {}

    /**
     * Called after a stage was solved: treatments in several passes set up the
     * next one (from the same beginning of the step) and return true; it is
     * then solved too, and its solution counts.
     */
    virtual bool
    next_pass()
    {
      return false;
    }

    /// Complete @p tangent at the solution of the last complete_residual().
    virtual void
    complete_tangent(Matrix &tangent) const = 0;

    /// Complete @p tangent as if all points were open.
    virtual void
    complete_open_tangent(Matrix &tangent) const = 0;

    /// How complete_tangent() enters a tangent: contact spreads by initial gap.
    /// It is symmetric if it keeps a symmetric tangent symmetric, but for
    /// friction.
    virtual ContactStructure
    tangent_structure() const = 0;

    /// Where the structure has functionals: the difference between
    /// complete_tangent() and complete_open_tangent() in terms of them, see
    /// Tangent::contact_change. @p change has an empty row for each functional
    /// of this rank.
    virtual void
    tangent_change(std::vector<FunctionalRow> &change) const;

    /**
     * A number that is the same on all ranks and changes whenever the tangent
     * does, or nothing if the tangent changes with every state.
     */
    virtual std::optional<std::uint64_t>
    tangent_signature() const = 0;

    /// A number that is the same on all ranks and changes whenever a contact
    /// point changes between open, closed, sticking and slipping.
    virtual std::uint64_t
    active_set_signature() const = 0;

    /// The number of active contact points at the last complete_residual(), and
    /// of all, for Newton's table.
    virtual std::string
    active_set_description() const = 0;

    /// The contact force (N, without the stage's weight and without the
    /// multipliers' own equations) at the solution of the last
    /// complete_residual().
    virtual const Vector &
    contact_force() const = 0;

    /// By how much the force in the residual differs from that of the law, at
    /// the last complete_residual() (N): not zero where the law was linearised
    /// elsewhere, and part of what Newton's method makes small.
    virtual double
    linearisation_error() const
    {
      return 0.;
    }

    /// Force (N) that round-off in the gaps can cause at the last
    /// complete_residual(): a stiff law makes much of little.
    virtual double
    round_off() const = 0;

    /// The part of contact_force() that friction makes; null without friction.
    virtual const Vector *
    friction_force() const
    {
      return nullptr;
    }

    /// The contact force at @p solution outside of any stage: for the initial
    /// acceleration and for integrators of their own.
    virtual void
    force_at(const Vector &solution, Vector &force) = 0;

    /// Energy stored by the treatment at @p solution (J): the difference
    /// between modified and mechanical energy. 0 where there is none.
    virtual double
    potential(const Vector &solution) = 0;

    /// Whether there is a modified energy. A constraint stores nothing; a method
    /// without potential has none.
    virtual bool
    has_modified_energy() const
    {
      return true;
    }

    /// Per row, the factor that makes the residual a force: 1 for
    /// displacements, a stiffness for multipliers.
    virtual const Vector &
    row_scaling() const = 0;

    /// Contact pressure (Pa) at a solved state, as a field for pictures: the
    /// average around each node of the contact boundary, in the place of the
    /// node's first displacement; zero elsewhere. It depends on the arguments
    /// alone: in nodes it is read off the force, elsewhere it is the law's pressure
    /// at the solution.
    virtual Vector
    pressure_field(const Vector &solution, const Vector &contact_force) = 0;

    /// Whether the summary has the pressure of the body's own stress.
    virtual bool
    knows_stress_pressure() const = 0;

    /// By boundary id, at a solved state.
    virtual std::map<dealii::types::boundary_id, ContactSummary>
    summary(const Vector &solution, const Vector &contact_force) = 0;
  };

  /**
   * Values of gap, stress pressure and multiplier in the contact points of this
   * rank: the one place where global unknowns meet contact points.
   */
  class ContactPointEvaluator
  {
  public:
    template <int dim>
    ContactPointEvaluator(const Body<dim> &body, ContactPoints points)
      : points(std::move(points))
      , ghosted(body.make_ghosted_vector())
      , communicator(body.communicator)
    {
      find_local_indices();
      some_points = dealii::Utilities::MPI::sum(this->points.points.size(),
                                                body.communicator) > 0;
    }

    /// Evaluate all points at @p solution into @p states.
    void
    evaluate(const Vector &solution, std::vector<ContactPointState<>> &states);

    /// The displacement of all points at @p solution (m).
    void
    evaluate_displacement(const Vector                      &solution,
                          std::vector<dealii::Tensor<1, 3>> &displacements);

    /// Add @p force of point @p p, weighted, to @p vector (to be compressed by
    /// the caller).
    void
    add(const unsigned int p, const ContactPointForce<> &force, Vector &vector);

    /// The same for a @p traction on the displacement.
    void
    add(const unsigned int          p,
        const dealii::Tensor<1, 3> &traction,
        Vector                     &vector);

    /// Add @p tangent of point @p p, times @p factor, to @p matrix.
    void
    add(const unsigned int         p,
        const double               factor,
        const ContactPointTangent &tangent,
        Matrix                    &matrix) const;

    /// The same for a traction with the derivatives @p with_displacement, and
    /// @p with_state with respect to gap, stress pressure and multiplier.
    void
    add(const unsigned int                         p,
        const double                               factor,
        const dealii::Tensor<2, 3>                &with_displacement,
        const std::array<dealii::Tensor<1, 3>, 3> &with_state,
        Matrix                                    &matrix) const;

    /// Averages around each node of @p values in the points, in the place of the
    /// node's first displacement: weighted by the square of the node's shape
    /// function, which is never negative.
    Vector
    nodal_averages(const std::vector<double> &values) const;

    /// The displacement or force of @p vector at @p p, which must be a node of
    /// this rank.
    dealii::Tensor<1, 3>
    at_node(const unsigned int p, const Vector &vector) const;

    /// The normal force of @p force at the node @p p, positive in compression (N).
    double
    nodal_normal_force(const unsigned int p, const Vector &force) const
    {
      return -(points.points[p].obstacle_normal * at_node(p, force));
    }

    const std::vector<ContactPoint> &
    contact_points() const
    {
      return points.points;
    }

    /// The unknowns of all points on all ranks, by initial gap.
    std::vector<dealii::types::global_dof_index>
    unknowns() const;

    /// Whether there are points on any rank.
    bool
    has_points() const
    {
      return some_points;
    }

    const ContactPoints &
    coefficients() const
    {
      return points;
    }

  private:
    void
    find_local_indices();

    const ContactPoints points;
    Vector              ghosted;
    std::vector<int>    local_index;
    bool                some_points = false;
    // Work space of add().
    std::vector<double>         values;
    mutable std::vector<double> local_matrix;

  public:
    const MPI_Comm communicator;
  };
} // namespace Ricochet

#endif
