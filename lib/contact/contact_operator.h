// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_contact_operator_h
#define ricochet_contact_contact_operator_h

#include <base/types.h>
#include <contact/contact_report.h>
#include <contact/energy_promise.h>
#include <contact/kinematics/contact_kinematics.h>
#include <solvers/tangent.h>
#include <solvers/united_pattern.h>

#include <cstdint>
#include <optional>
#include <string>

namespace Ricochet
{
  /// Works against contact over a step (J).
  struct ContactWork
  {
    /// Work against the normal forces.
    double normal = 0.;
    /// Work against friction; never negative.
    double friction = 0.;
  };

  /// The active set as numbers that are the same on all ranks.
  struct ActiveSet
  {
    /// Changes whenever a point changes between open, closed, sticking and slipping.
    std::uint64_t hash = 0;
    /// Changes whenever the tangent does; none if the tangent changes with every state.
    std::optional<std::uint64_t> tangent_key;
  };

  /// Properties of contact that are the same in all of a run.
  struct ContactTraits
  {
    bool has_friction = false;
    /// There is a modified energy. A constraint stores nothing; a method without
    /// potential has none.
    bool has_modified_energy = true;
    /// An obstacle moves, and so does work on the body.
    bool has_moving_obstacles = false;
    /// There may be times at which no point has a gap.
    bool gaps_may_be_unknown = false;
    /// The summary has the pressure of the body's own stress.
    bool knows_stress_pressure = false;
    /// contact_work() is known for each boundary.
    bool knows_work = false;
  };

  /**
   * A contact treatment: its forces and their derivatives in a stage of a time scheme,
   * and its report at an instant.
   *
   * A stage begins with begin_stage(). Newton's method evaluates it by add_residual(),
   * which adds the contact forces to a residual with all other forces (or, for active
   * sets, replaces rows of it), and makes an evaluated point its iterate by
   * accept_iterate(). All results except reports refer to the last evaluation.
   *
   * Contact acts through the rows of the contact Jacobian H (structure().functionals),
   * if there are any: its forces are those of open contact (all points open), which is
   * linear, and H^T z. A stage that is condensed to contact evaluates z from values of
   * H u alone (evaluate_at_increment()).
   *
   * All vectors are system vectors without ghost values; all functions are collective.
   */
  class ContactOperator : public ContactReport
  {
  public:
    // ### Constant properties

    /// Rows of contact in a tangent, and their kind.
    const ContactStructure &
    structure() const
    {
      return own_structure;
    }

    const ContactTraits &
    traits() const
    {
      return own_traits;
    }

    /// The factor of each row by which the residual is a force: 1 for
    /// displacements, a stiffness for multipliers.
    const Vector &
    row_scaling() const
    {
      return scaling;
    }

    /// The promise of all contacts together; set by the table that makes them.
    EnergyPromise promise;

    /// The promise of the contact of the points with @p boundary_id.
    virtual const EnergyPromise &
    promise_at(const dealii::types::boundary_id /*boundary_id*/) const
    {
      return promise;
    }

    /// Tell this contact of another one, whose stages begin and which is evaluated @p before
    /// it: both may hold the same nodes. @return whether both eliminate rows of a node. Not
    /// collective.
    virtual bool
    share_nodes(ContactOperator & /*before*/)
    {
      return false;
    }

    // ### A stage

    /// Begin the solution of one stage; @p weight is the factor of the new
    /// contact force in the residual.
    virtual void
    begin_stage(const ContactStart &start, const double weight) = 0;

    /// Add contact to @p residual at @p solution. Nothing is remembered for the next
    /// iterate until accept_iterate() is called, so that a line search can evaluate
    /// several points.
    virtual void
    add_residual(const Vector &solution, Vector &residual) = 0;

    /// Make the point of the last evaluation the next iterate.
    virtual void
    accept_iterate()
    {}

    /// Another problem with the same contact follows, near the last iterate, or the
    /// same one from another guess: a return of former iterates is then no sign of a
    /// cycle. The record of active points is kept.
    virtual void
    forget_iterates()
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

    /// By how much the force in the residual differs from that of the law (N): not zero
    /// where the law was linearised elsewhere, and part of what Newton's method makes
    /// small.
    virtual double
    linearisation_error() const
    {
      return 0.;
    }

    /// Force (N) that round-off in the gaps can cause: a stiff law amplifies it.
    virtual double
    round_off() const = 0;

    virtual ActiveSet
    active_set() const = 0;

    /// The numbers of active contact points and of all points, for Newton's
    /// table.
    virtual std::string
    active_set_description() const = 0;

    // ### Forces and works of the last evaluation

    /// The contact force (N, without the stage's weight and without the
    /// multipliers' own equations).
    const Vector &
    contact_force() const
    {
      return force;
    }

    /// The friction part of contact_force(); null without friction.
    const Vector *
    friction_force() const
    {
      return own_traits.has_friction ? &friction_part : nullptr;
    }

    /// The forces of the several contacts whose sum contact_force() is, in their order;
    /// none where there is only one. Also after force_at().
    virtual std::vector<const Vector *>
    shares() const
    {
      return {};
    }

    /// Energy dissipated by friction over the step (J): the work of its tractions along
    /// the slip.
    virtual double
    friction_dissipation() const
    {
      return 0.;
    }

    /// Works over the step against the contact of the points with @p boundary_id.
    /// @pre ContactTraits::knows_work
    virtual ContactWork
    contact_work(const dealii::types::boundary_id /*boundary_id*/) const
    {
      AssertThrow(false, dealii::ExcMessage("Works are not known in parts."));
      return {};
    }

    /// Energy generated by contact over the step, for each boundary with points; ends
    /// that step. The amounts have a meaning where contact acts over a step.
    ///
    /// @param begin the solution (m) at the beginning of the step, at @p begin_time (s).
    /// @param end the same at its end.
    virtual ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) = 0;

    // ### The tangent of the last evaluation

    virtual void
    add_tangent(Matrix &tangent) const = 0;

    /// Add the derivatives of open contact (the contact-free tangent), at any state:
    /// add_tangent() less the derivatives of the forces on rows.
    virtual void
    add_open_tangent(Matrix & /*tangent*/) const
    {}

    /// Unknowns that add_tangent() couples and the body does not; null if there are
    /// never any.
    virtual const Couplings *
    couplings()
    {
      return nullptr;
    }

    // ### By rows of the contact Jacobian, if there are any

    /// Evaluate contact at a state where the values of this rank's rows H u differ by
    /// @p increment from those at the last add_residual(), and the residual without
    /// contact along them is @p residual (N; needed where contact eliminates rows of
    /// the body). Until add_residual() is called again, all except contact_force(),
    /// friction_force() and works are those of this state.
    virtual void
    evaluate_at_increment(const std::vector<double> & /*increment*/,
                          const std::vector<double> & /*residual*/)
    {
      AssertThrow(false, dealii::ExcMessage("This contact has no rows."));
    }

    /// The coefficients z (N) of this rank's rows: H^T z is the contact force, less
    /// that of open contact at the same state, times the stage's weight.
    virtual void
    forces_on_rows(std::vector<double> & /*coefficients*/) const
    {
      AssertThrow(false, dealii::ExcMessage("This contact has no rows."));
    }

    /// The derivatives of forces_on_rows() with respect to the values of rows, and,
    /// where contact eliminates rows of the body, to the residual without contact along
    /// them. Both have an empty row for each of this rank.
    virtual void
    differentiate_forces(std::vector<FunctionalRow> & /*with_values*/,
                         std::vector<FunctionalRow> & /*with_residual*/) const
    {
      AssertThrow(false, dealii::ExcMessage("This contact has no rows."));
    }

  protected:
    /// @param layout of system vectors.
    explicit ContactOperator(const Vector &layout)
      : force(layout)
      , friction_part(layout)
      , scaling(layout)
    {
      force = friction_part = 0.;
      scaling               = 1.;
    }

    ContactStructure own_structure;
    ContactTraits    own_traits;
    Vector           force, friction_part, scaling;
  };
} // namespace Ricochet

#endif
