// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef own_step_backward_euler_h
#define own_step_backward_euler_h

#include <time_integration/hht.h>
#include <time_integration/time_scheme_table.h>

#include <memory>

/**
 * A user's time scheme: the backward Euler method,
 *
 *     M (v_new - v_old)/dt + F(u_new) = 0,     u_new = u_old + dt v_new,
 *
 * where F is the internal and contact force less the load. The method is of
 * first order and damps unresolved vibrations.
 */
class BackwardEuler : public Ricochet::TimeScheme
{
public:
  static Ricochet::SchemeTraits
  traits()
  {
    return Ricochet::SchemeTraits::at_instants_with_rates("backward Euler");
  }

  static std::string
  about()
  {
    return "of first order, a scheme of one's own";
  }

  static Ricochet::OwnParameters
  parameters()
  {
    return {};
  }

  static std::unique_ptr<Ricochet::TimeScheme>
  make(const Ricochet::ParameterValues &)
  {
    return std::make_unique<BackwardEuler>();
  }

  Ricochet::StepReport
  step(Ricochet::SemiDiscreteSystem &system,
       const Ricochet::State        &old_state,
       const double                  time_step,
       Ricochet::State              &new_state) override
  {
    using namespace Ricochet;
    new_state      = old_state;
    new_state.time = old_state.time + time_step;

    // u_new = u_old + dt v_old + dt^2 a_new
    stage.inertia        = 1. / (time_step * time_step);
    stage.end_time       = new_state.time;
    stage.inertia_origin = old_state.solution;
    stage.inertia_origin.add(time_step, old_state.velocity);
    // For friction and viscosity: v_new = (u_new - u_old)/dt
    stage.rate_origin = old_state.solution;
    stage.rate_time   = time_step;
    stage.load.reinit(old_state.solution, true);
    system.external_load(new_state.time, stage.load);

    // The guess is free flight.
    new_state.solution.add(time_step, old_state.velocity);
    StepReport report;
    report.solver = system.solve_stage(stage, old_state, new_state);

    new_state.acceleration = new_state.solution;
    new_state.acceleration -= stage.inertia_origin;
    new_state.acceleration *= stage.inertia;
    new_state.velocity.add(time_step, new_state.acceleration);

    // The kinetic energy changes by -F_new . (u_new - u_old) - |v_new - v_old|_M^2/2, and
    // the works are those of the mean of both forces.
    Vector old_force(old_state.solution), increment(new_state.solution);
    new_state.scheme_force.reinit(old_state.solution, true);
    system.total_force(old_state, old_force);
    system.total_force(new_state, new_state.scheme_force);
    increment -= old_state.solution;
    report.numerical_dissipation =
      .5 * (new_state.scheme_force * increment - old_force * increment);
    Vector jump(new_state.velocity), momentum(new_state.velocity);
    jump -= old_state.velocity;
    system.mass_matrix().vmult(momentum, jump);
    report.numerical_dissipation += .5 * (momentum * jump);
    add_trapezoidal_works(system, old_state, new_state, report);

    system.reconstruct_massless(old_state, time_step, new_state);
    return report;
  }

private:
  Ricochet::Stage stage;
};

#endif
