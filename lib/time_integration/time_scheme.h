// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_time_scheme_h
#define ricochet_time_integration_time_scheme_h

#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <time_integration/scheme_traits.h>
#include <time_integration/semi_discrete_system.h>

#include <deal.II/base/parameter_handler.h>

#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * What a step did, and the terms of its energy balance,
   *
   *     E_new - E_old = external_work + imposed_work - contact_work - friction_work
   *                     - viscous_dissipation - numerical_dissipation .
   *
   * The dissipation comes from the scheme's own closed formula, in which M a
   * stands for the forces that the scheme balances it with. So the balance
   * closes when the nonlinear equations were solved, and not by construction.
   */
  struct StepReport
  {
    /// J
    double external_work = 0.;
    /// Work of the forces by which displacements are imposed (J).
    double imposed_work = 0.;
    /// Work that the body does against the normal contact force (J).
    double contact_work = 0.;
    /// What each body does against contact forces, friction included, see
    /// SemiDiscreteSystem::works_of_bodies (J); empty if the scheme does not tell.
    std::vector<double> works_of_bodies = {};
    /// Work against friction (J); never negative.
    double friction_work = 0.;
    /// What viscosity takes (J); never negative.
    double viscous_dissipation = 0.;
    /// Energy that the scheme takes away (J); negative if it adds some.
    double numerical_dissipation = 0.;
    /// Work of moving obstacles on the body, from their resultants and motions
    /// (J): no term of the balance, but a part of minus the contact work. The
    /// time loop adds it.
    double obstacle_work = 0.;
    /// Round-off (J) in the balance: the force that round-off leaves in the equations,
    /// times the displacement of the step. The time loop adds it.
    double round_off = 0.;
    /// What contact has made, in the order of the time loop's contacts, of schemes whose
    /// contact acts over a step. The time loop adds it.
    std::vector<ContactStep> contact_steps = {};
    /// Sums that a program asked the time loop for.
    std::vector<double> own_sums = {};
    /// How the stages were solved.
    SolverReport solver = {};
    /// Solutions of linear systems that are in no stage.
    unsigned int other_linear_solves = 0;

    StepReport &
    operator+=(const StepReport &other);
  };

  /**
   * A time scheme: a short list of stages, each a nonlinear system for
   * SemiDiscreteSystem::solve_stage(), and the rule by which velocity and
   * acceleration follow. Schemes are listed in time_scheme_table.cc.
   */
  class TimeScheme
  {
  public:
    struct Parameters
    {
      std::string name = "Crank-Nicolson";
      /// The parameters of all schemes, as they declare them.
      ParameterValues values = all_parameters();

      /// Those of all schemes.
      static OwnParameters
      all_parameters();

      /// The parameters that the scheme makes no use of.
      std::vector<UnusedParameter>
      unused_parameters() const;

      void
      add_parameters(dealii::ParameterHandler &parameters);
    };

    virtual ~TimeScheme() = default;

    /**
     * From @p old_state over @p time_step (s) to @p new_state.
     * @throws NewtonFailure; then @p new_state is not to be used.
     */
    virtual StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) = 0;

    /// Whether a step is many steps of another integrator, without stages.
    virtual bool
    integrates_by_itself() const
    {
      return false;
    }

    /// Whether the contact force of a state acts over the whole step that leads
    /// to it, and not at its end.
    virtual bool
    contact_force_is_of_step() const
    {
      return false;
    }
  };

  /// Names of all schemes, as a pattern for Patterns::Selection.
  std::string
  time_scheme_names();

  /// The scheme that @p parameters name.
  std::unique_ptr<TimeScheme>
  make_time_scheme(const TimeScheme::Parameters &parameters);
} // namespace Ricochet

#endif
