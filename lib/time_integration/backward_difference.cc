// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/backward_difference.h>
#include <time_integration/generalised_alpha.h>

namespace Ricochet
{
  void
  BackwardDifferenceStage::solve(SemiDiscreteSystem       &system,
                                 const BackwardDifference &formula,
                                 const Vector             &solution_before,
                                 const Vector             &velocity_before,
                                 const State              &last,
                                 const double              end_time,
                                 State                    &new_state,
                                 StepReport               &report)
  {
    const auto &[of_last, of_before, rate_step] = formula;

    // v_new = velocity_part + rate_step a_new, and the same for u_new: so
    // u_new = inertia_origin + rate_step^2 a_new.
    new_state      = last;
    new_state.time = end_time;
    new_state.velocity.sadd(of_last, -of_before, velocity_before);
    stage.inertia  = 1. / (rate_step * rate_step);
    stage.end_time = new_state.time;
    copy_values(last.solution, stage.inertia_origin);
    stage.inertia_origin.sadd(of_last, -of_before, solution_before);
    stage.inertia_origin.add(rate_step, new_state.velocity);
    if (system.needs_rates())
      {
        stage.rate_time = rate_step;
        copy_values(stage.inertia_origin, stage.rate_origin);
        stage.rate_origin.add(-rate_step, new_state.velocity);
      }
    stage.load.reinit(last.solution, true);
    system.external_load(new_state.time, stage.load);

    new_state.solution.add(end_time - last.time, last.velocity);
    report.solver += system.solve_stage(stage, last, new_state);

    copy_values(new_state.solution, new_state.acceleration);
    new_state.acceleration -= stage.inertia_origin;
    new_state.acceleration *= stage.inertia;
    new_state.velocity.add(rate_step, new_state.acceleration);

    // Energy balance. With d1 = last - before and d2 = new - last, the formula reads
    // d2 y = of_before d1 y + rate_step y'_new, and M a_new is minus the total force:
    //   -D = -(f_new - f_mean) . d2 u + of_before f_new . d1 u
    //        + of_before v_new . M d1 v - 1/2 d2 v . M d2 v.
    last_force.reinit(last.solution, true);
    new_force.reinit(last.solution, true);
    system.total_force(last, last_force);
    system.total_force(new_state, new_force);
    copy_values(new_force, new_state.scheme_force);

    copy_values(new_state.solution, increment);
    increment -= last.solution;
    copy_values(new_force, work);
    work -= last_force;
    double gain = -.5 * (work * increment);
    copy_values(last.solution, increment);
    increment -= solution_before;
    gain += of_before * (new_force * increment);

    copy_values(last.velocity, velocity_increment);
    velocity_increment -= velocity_before;
    system.mass_matrix().vmult(work, velocity_increment);
    gain += of_before * (work * new_state.velocity);
    velocity_increment = new_state.velocity;
    velocity_increment -= last.velocity;
    system.mass_matrix().vmult(work, velocity_increment);
    gain -= .5 * (work * velocity_increment);

    report.numerical_dissipation -= gain;
    add_trapezoidal_works(system, last, new_state, report);
  }
} // namespace Ricochet
