// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <time_integration/arkode.h>

#include <deal.II/lac/trilinos_parallel_block_vector.h>
#include <deal.II/sundials/arkode.h>

#include <arkode/arkode_arkstep.h>

namespace Ricochet
{
  using namespace dealii;

  ARKode::ARKode(const double relative_tolerance,
                 const double absolute_tolerance)
    : relative_tolerance(relative_tolerance)
    , absolute_tolerance(absolute_tolerance)
  {}



  StepReport
  ARKode::step(SemiDiscreteSystem &system,
               const State        &old_state,
               const double        time_step,
               State              &new_state)
  {
    // (displacement, velocity)
    using BlockVector = TrilinosWrappers::MPI::BlockVector;
    BlockVector solution(2);
    solution.block(0) = old_state.solution;
    solution.block(1) = old_state.velocity;
    solution.collect_sizes();

    SUNDIALS::ARKode<BlockVector>::AdditionalData data;
    data.initial_time       = old_state.time;
    data.final_time         = old_state.time + time_step;
    data.initial_step_size  = 1e-3 * time_step;
    data.minimum_step_size  = 1e-10 * time_step;
    data.output_period      = time_step;
    data.relative_tolerance = relative_tolerance;
    data.absolute_tolerance = absolute_tolerance;
    // Error estimates of higher order are less sensitive to the kinks of the
    // force.
    data.maximum_order = 4;
    SUNDIALS::ARKode<BlockVector> integrator(data);

    // SUNDIALS would stop after 500 steps, and tight tolerances need more within one
    // of ours. The message of a failure is kept instead of printed; from SUNDIALS 7
    // on that would need a context to which deal.II gives no access.
    std::string failure;
    integrator.custom_setup = [&failure](void *memory) {
      ARKStepSetMaxNumSteps(memory, 1000000);
#if DEAL_II_SUNDIALS_VERSION_GTE(7, 0, 0)
      (void)failure;
#else
      ARKStepSetErrHandlerFn(
        memory,
        [](int error, const char *, const char *, char *message, void *data) {
          if (error < 0)
            *static_cast<std::string *>(data) = message;
        },
        &failure);
#endif
    };
    // deal.II checks SUNDIALS' return codes in debug builds only, and would
    // otherwise repeat the call for ever: an integration that has not reached the
    // end has failed.
    integrator.solver_should_restart = [&](const double time, BlockVector &) {
      if (data.final_time - time > 1e-8 * time_step)
        throw NewtonFailure(
          "ARKODE could not integrate beyond t = " + to_text(time) +
          (failure.empty() ? "." : ": " + failure) + "\n");
      return false;
    };

    StepReport report;
    Vector     force(old_state.solution);
    Vector     contact_force(old_state.solution);
    integrator.explicit_function =
      [&](const double time, const BlockVector &y, BlockVector &rate) {
        rate.block(0) = y.block(1);
        system.contact.force_at(y.block(0), time, contact_force);
        system.total_force(y.block(0), contact_force, time, force);
        force *= -1.;
        system.solve_mass(force, rate.block(1));
        ++report.other_linear_solves;
        return 0;
      };
    deal_II_exceptions::disable_abort_on_exception();
    try
      {
        integrator.solve_ode(solution);
      }
    catch (const ExceptionBase &error)
      {
        if (failure.empty())
          failure = error.what();
      }
    deal_II_exceptions::enable_abort_on_exception();
    if (!failure.empty())
      throw NewtonFailure("ARKODE could not integrate: " + failure + "\n");

    new_state          = old_state;
    new_state.time     = old_state.time + time_step;
    new_state.solution = solution.block(0);
    new_state.velocity = solution.block(1);
    system.set_contact_force(new_state);
    system.total_force(new_state.solution,
                       new_state.contact_force,
                       new_state.time,
                       new_state.scheme_force);
    force = new_state.scheme_force;
    force *= -1.;
    system.solve_mass(force, new_state.acceleration);

    report.contact_work =
      system.contact.potential(new_state.solution, new_state.time) -
      system.contact.potential(old_state.solution, old_state.time);
    // The trapezoidal rule is exact for the available loads, which are
    // constant.
    Vector mean_load(force), new_load(force);
    system.external_load(old_state.time, mean_load);
    system.external_load(new_state.time, new_load);
    mean_load += new_load;
    force = new_state.solution;
    force -= old_state.solution;
    report.external_work = .5 * (mean_load * force);
    return report;
  }
} // namespace Ricochet
