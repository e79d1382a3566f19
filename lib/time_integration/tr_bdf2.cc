// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/tr_bdf2.h>

#include <cmath>

namespace Ricochet
{
  TRBDF2::TRBDF2(const double gamma)
    : gamma(gamma)
    , a_middle(1. / (gamma * (2. - gamma)))
    , a_old((1. - gamma) * (1. - gamma) / (gamma * (2. - gamma)))
    , a_rate((1. - gamma) / (2. - gamma))
    , trapezoidal_rule(0.)
  {
    // At gamma = 2 - sqrt(2) both stages have the same matrix, except for
    // round-off.
    if (std::abs(a_rate - .5 * gamma) < 1e-14)
      a_rate = .5 * gamma;
  }



  StepReport
  TRBDF2::step(SemiDiscreteSystem &system,
               const State        &old_state,
               const double        time_step,
               State              &new_state)
  {
    const double dt = time_step;

    StepReport report =
      trapezoidal_rule.step(system, old_state, gamma * dt, middle);

    // v_new = velocity_part + a_rate dt a_new, and the same for u_new: so
    // u_new = inertia_origin + (a_rate dt)^2 a_new.
    new_state          = middle;
    new_state.time     = old_state.time + dt;
    new_state.velocity = middle.velocity;
    new_state.velocity.sadd(a_middle, -a_old, old_state.velocity);
    // In the order in which the trapezoidal rule multiplies, so that equal means
    // equal to the last digit.
    const double rate_step = a_rate * dt;
    stage.inertia          = 1. / (rate_step * rate_step);
    stage.end_time         = new_state.time;
    copy_values(middle.solution, stage.inertia_origin);
    stage.inertia_origin.sadd(a_middle, -a_old, old_state.solution);
    stage.inertia_origin.add(a_rate * dt, new_state.velocity);
    if (system.needs_rates())
      {
        stage.rate_time = rate_step;
        copy_values(stage.inertia_origin, stage.rate_origin);
        stage.rate_origin.add(-rate_step, new_state.velocity);
      }
    stage.load.reinit(old_state.solution, true);
    system.external_load(new_state.time, stage.load);

    new_state.solution.add((1. - gamma) * dt, middle.velocity);
    report.solver += system.solve_stage(stage, middle, new_state);

    copy_values(new_state.solution, new_state.acceleration);
    new_state.acceleration -= stage.inertia_origin;
    new_state.acceleration *= stage.inertia;
    new_state.velocity.add(a_rate * dt, new_state.acceleration);

    // Energy balance of the second stage. With d1 = middle - old and d2 = new -
    // middle, BDF2 reads d2 y = a_old d1 y + a_rate dt y'_new, and M a_new is
    // minus the total force:
    //   -D = -(f_new - f_mean) . d2 u + a_old f_new . d1 u
    //        + a_old v_new . M d1 v - 1/2 d2 v . M d2 v.
    middle_force.reinit(old_state.solution, true);
    new_force.reinit(old_state.solution, true);
    system.total_force(middle, middle_force);
    system.total_force(new_state, new_force);
    copy_values(new_force, new_state.scheme_force);

    copy_values(new_state.solution, increment);
    increment -= middle.solution;
    copy_values(new_force, work);
    work -= middle_force;
    double gain = -.5 * (work * increment);
    copy_values(middle.solution, increment);
    increment -= old_state.solution;
    gain += a_old * (new_force * increment);

    copy_values(middle.velocity, velocity_increment);
    velocity_increment -= old_state.velocity;
    system.mass_matrix().vmult(work, velocity_increment);
    gain += a_old * (work * new_state.velocity);
    velocity_increment = new_state.velocity;
    velocity_increment -= middle.velocity;
    system.mass_matrix().vmult(work, velocity_increment);
    gain -= .5 * (work * velocity_increment);

    report.numerical_dissipation -= gain;
    add_trapezoidal_works(system, middle, new_state, report);

    system.reconstruct_massless(old_state, dt, new_state);
    return report;
  }
} // namespace Ricochet
