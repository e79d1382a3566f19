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
  /// What contact takes over a step (J).
  struct ContactWork
  {
    /// Against the normal forces.
    double normal = 0.;
    /// Against friction; never negative.
    double friction = 0.;
  };

  /**
   * Contact as a stage of a time scheme sees it: it adds its forces to (or, for
   * active sets, takes rows out of) a residual that already holds everything else.
   *
   * All vectors are system vectors without ghost values; all functions are
   * collective.
   */
  class StageContact
  {
  public:
    virtual ~StageContact() = default;

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

    /// From here on another problem with the same contact is solved, near the last
    /// iterate, or the same one from elsewhere: what former iterates did, such as to come
    /// back to where they were, tells nothing. Which points were active still counts.
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

    /// The contact force (N, without the stage's weight and without the
    /// multipliers' own equations) at the solution of the last
    /// complete_residual().
    virtual const Vector &
    contact_force() const = 0;

    /// The forces of the several contacts whose sum contact_force() is, in their order;
    /// none where there is only one. Also right after force_at().
    virtual std::vector<const Vector *>
    shares() const
    {
      return {};
    }

    /// The part of contact_force() that friction makes; null without friction.
    virtual const Vector *
    friction_force() const
    {
      return nullptr;
    }

    /// What friction takes over the step that ends at the last
    /// complete_residual() (J): the work of its tractions along the slip.
    virtual double
    friction_dissipation() const
    {
      return 0.;
    }

    /// Whether contact_work() tells one contact from the others.
    virtual bool
    knows_work_of_contacts() const
    {
      return false;
    }

    /// What the contact of the points with @p boundary_id takes over the step that
    /// ends at the last complete_residual(). Collective.
    virtual ContactWork
    contact_work(const dealii::types::boundary_id /*boundary_id*/) const
    {
      AssertThrow(false,
                  dealii::ExcMessage("This contact is not told in parts."));
      return {};
    }

    /// What contact has made of the energy over the step that ends at the last
    /// complete_residual(), of each boundary with points; that step is over then. The
    /// amounts have a meaning where contact acts over a step.
    ///
    /// @param begin the solution (m) at the beginning of the step, at @p begin_time (s).
    /// @param end the same at its end. Collective.
    virtual ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) = 0;

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

    /// Per row, the factor that makes the residual a force: 1 for
    /// displacements, a stiffness for multipliers.
    virtual const Vector &
    row_scaling() const = 0;

    /// Whether complete_residual() takes rows out of the residual, so that all other
    /// forces have to be in it before.
    virtual bool
    takes_rows() const
    {
      return false;
    }

    /// The number of active contact points at the last complete_residual(), and
    /// of all, for Newton's table.
    virtual std::string
    active_set_description() const = 0;
  };

  /// Contact as linear solvers see it, at the solution of the last
  /// complete_residual().
  class TangentContact
  {
  public:
    virtual ~TangentContact() = default;

    virtual void
    complete_tangent(Matrix &tangent) const = 0;

    /// Where the structure has functionals: complete @p tangent with what
    /// complete_tangent() adds besides tangent_change(), at any state. For most contact
    /// that is what open points add.
    virtual void
    complete_constant_tangent(Matrix & /*tangent*/) const
    {}

    /// What complete_tangent() couples at the last complete_residual() beyond the
    /// couplings of the body; null if it never does. Collective.
    virtual const Couplings *
    couplings()
    {
      return nullptr;
    }

    /// How complete_tangent() enters a tangent: contact spreads by initial gap.
    /// A symmetric structure keeps a symmetric tangent symmetric.
    virtual ContactStructure
    tangent_structure() const = 0;

    /// Where the structure has functionals: the difference between
    /// complete_tangent() and complete_constant_tangent() in terms of them, see
    /// Tangent::contact_change. @p change has an empty row for each functional
    /// that this rank knows.
    virtual void
    tangent_change(std::vector<FunctionalRow> & /*change*/) const
    {
      AssertThrow(false,
                  dealii::ExcMessage("This contact has no functionals."));
    }

    /// Where contact takes rows: how the coefficients of force_change() follow from
    /// the forces along the functionals that are there without contact, see
    /// Tangent::contact_excess_change. @p change as above.
    virtual void
    excess_change(std::vector<FunctionalRow> & /*change*/) const
    {}

    /// Where the structure has functionals: look at the state where their values (of
    /// this rank) differ by @p change from those at the last complete_residual(), as
    /// complete_residual() does. Until that is called again, all but contact_force(),
    /// friction_force(), and works speak of this state.
    /// The other argument is the residual without contact along them (N), of use
    /// where contact takes rows.
    virtual void
    look_at_change(const std::vector<double> & /*change*/,
                   const std::vector<double> & /*excess*/)
    {
      AssertThrow(false,
                  dealii::ExcMessage("This contact has no functionals."));
    }

    /// The contact force less what open contact makes of the same state, times the
    /// stage's weight, as a sum of the functionals: the coefficient of each of this
    /// rank's (N). Its derivatives are those of tangent_change() and
    /// excess_change().
    virtual void
    force_change(std::vector<double> & /*coefficients*/) const
    {
      AssertThrow(false,
                  dealii::ExcMessage("This contact has no functionals."));
    }

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
  };

  /// A contact treatment: what time schemes, linear solvers and reports ask of
  /// it.
  class ContactOperator
    : public StageContact
    , public TangentContact
    , public ContactReport
  {
  public:
    /// Of all contacts together; set by the table that makes them.
    EnergyPromise promise;

    /// That of the contact of the points with @p boundary_id.
    virtual const EnergyPromise &
    promise_at(const dealii::types::boundary_id /*boundary_id*/) const
    {
      return promise;
    }
  };
} // namespace Ricochet

#endif
