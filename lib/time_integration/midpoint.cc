// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/midpoint.h>

namespace Ricochet
{
  StepReport
  Midpoint::step(SemiDiscreteSystem &system,
                 const State        &old_state,
                 const double        time_step,
                 State              &new_state)
  {
    const double dt = time_step;
    new_state       = old_state;
    new_state.time  = old_state.time + dt;

    // (v_new - v_old)/dt = 2/dt^2 (u_new - u_old - dt v_old)
    stage.inertia = 2. / (dt * dt);
    copy_values(old_state.solution, stage.inertia_origin);
    stage.inertia_origin.add(dt, old_state.velocity);
    stage.time_step          = dt;
    stage.end_time           = new_state.time;
    stage.bulk_step_force    = true;
    stage.contact_weight_new = 1.;
    stage.contact_weight_old = 0.;

    work.reinit(old_state.solution, true);
    stage.load.reinit(old_state.solution, true);
    system.external_load(old_state.time, work);
    system.external_load(new_state.time, stage.load);
    stage.load.sadd(.5, .5, work);

    // The guess is free flight.
    new_state.solution.add(dt, old_state.velocity);
    StepReport report;
    report.solver = system.solve_stage(stage, old_state, new_state);

    copy_values(new_state.solution, work);
    work -= old_state.solution;
    new_state.velocity *= -1.;
    new_state.velocity.add(2. / dt, work);
    // The mean over the step. The acceleration at its end, which would follow from the
    // mean of both ends, oscillates with the largest eigenfrequency without decay.
    copy_values(new_state.velocity, new_state.acceleration);
    new_state.acceleration -= old_state.velocity;
    new_state.acceleration *= 1. / dt;

    copy_values(work, new_state.mean_velocity);
    new_state.mean_velocity *= 1. / dt;

    // The scheme dissipates nothing: M (v_new - v_old)/dt times u_new - u_old
    // is the difference of kinetic energies.
    if (const Vector *friction_force = system.contact.friction_force())
      // Friction on a moving obstacle does work, which counts as contact work
      // like all of its forces on the body.
      report.friction_work = system.contact.traits().has_moving_obstacles
        ? system.contact.friction_dissipation()
        : *friction_force * work;
    report.contact_work = new_state.contact_force * work - report.friction_work;
    if (system.works_of_bodies)
      report.works_of_bodies = system.works_of_bodies(new_state.contact_force,
                                                      old_state.solution,
                                                      new_state.solution);
    report.viscous_dissipation =
      system.bulk.viscous_dissipation(old_state.solution,
                                      new_state.solution,
                                      dt);
    report.external_work =
      stage.load * work + system.follower_work(old_state, new_state);
    if (system.has_imposed_displacements())
      report.imposed_work = system.imposed_work(work);

    system.reconstruct_massless(old_state, dt, new_state);
    return report;
  }
} // namespace Ricochet
