// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <time_integration/generalised_alpha.h>

#include <deal.II/base/quadrature_lib.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  StepReport
  GeneralisedAlpha::step(SemiDiscreteSystem &system,
                         const State        &old_state,
                         const double        time_step,
                         State              &new_state)
  {
    const double dt                             = time_step;
    const auto &[alpha_m, alpha_f, beta, gamma] = coefficients;
    new_state                                   = old_state;
    new_state.time                              = old_state.time + dt;

    // u_new = predicted + beta dt^2 a_new
    const double rate = 1. / (beta * dt * dt);
    copy_values(old_state.solution, predicted);
    predicted.add(dt,
                  old_state.velocity,
                  (.5 - beta) * dt * dt,
                  old_state.acceleration);
    // M ((1 - alpha_m) a_new + alpha_m a_old)
    stage.inertia  = (1. - alpha_m) * rate;
    stage.end_time = new_state.time;
    copy_values(predicted, stage.inertia_origin);
    if (alpha_m != 0.)
      stage.inertia_origin.add(-alpha_m / stage.inertia,
                               old_state.acceleration);
    // v_new = v_old + (1 - gamma) dt a_old + gamma dt a_new
    if (system.needs_rates())
      {
        stage.rate_time = beta * dt / gamma;
        copy_values(predicted, stage.rate_origin);
        stage.rate_origin.add(-stage.rate_time,
                              old_state.velocity,
                              -stage.rate_time * (1. - gamma) * dt,
                              old_state.acceleration);
      }
    stage.bulk_weight_new = stage.contact_weight_new = 1. - alpha_f;
    stage.bulk_weight_old = stage.contact_weight_old = alpha_f;

    work.reinit(old_state.solution, true);
    load.reinit(old_state.solution, true);
    system.external_load(old_state.time, work);
    system.external_load(new_state.time, load);
    copy_values(load, stage.load);
    stage.load.sadd(1. - alpha_f, alpha_f, work);

    // The guess is free flight over the step.
    new_state.solution.add(dt,
                           old_state.velocity,
                           .5 * dt * dt,
                           old_state.acceleration);
    StepReport report;
    report.solver = system.solve_stage(stage, old_state, new_state);

    copy_values(new_state.solution, new_state.acceleration);
    new_state.acceleration -= predicted;
    new_state.acceleration *= rate;
    new_state.velocity.add((1. - gamma) * dt,
                           old_state.acceleration,
                           gamma * dt,
                           new_state.acceleration);

    // Energy balance. With jump = a_new - a_old and mean = (a_new + a_old)/2
    // the Newmark formulas are
    //   u_new - u_old = dt (v_old + v_new)/2 + dt^2 (beta - gamma/2) jump,
    //   v_new - v_old = dt mean + dt (gamma - 1/2) jump,
    // and M a is minus the force that the scheme balances it with.
    old_force.reinit(old_state.solution, true);
    new_force.reinit(old_state.solution, true);
    system.total_force(old_state, old_force);
    system.total_force(new_state, new_force);
    copy_values(new_force, new_state.scheme_force);
    new_state.scheme_force.sadd(1. - alpha_f, alpha_f, old_force);
    if (alpha_m != 0.)
      new_state.scheme_force.sadd(1. / (1. - alpha_m),
                                  -alpha_m / (1. - alpha_m),
                                  old_state.scheme_force);

    // (mean scheme force - mean force) . (u_new - u_old)
    const MPI_Comm communicator = new_state.solution.get_mpi_communicator();
    const auto     increment =
      entries(new_state.solution) - entries(old_state.solution);
    double dissipation = .5 *
      product(entries(new_state.scheme_force) +
                entries(old_state.scheme_force) - entries(new_force) -
                entries(old_force),
              increment,
              communicator);

    // Zero for the trapezoidal rule.
    const double of_increment = gamma - .5, of_jump = beta - .5 * gamma;
    if (of_increment != 0. || of_jump != 0.)
      {
        copy_values(new_state.acceleration, work);
        work -= old_state.acceleration;
        mass_times_jump.reinit(work, true);
        system.mass_matrix().vmult(mass_times_jump, work);
        dissipation -= of_increment *
          product(entries(mass_times_jump), increment, communicator);

        // dt^2 (beta - gamma/2) (mean + (gamma - 1/2) jump) . M jump
        work.sadd(of_increment, .5, new_state.acceleration);
        work.add(.5, old_state.acceleration);
        dissipation += dt * dt * of_jump * (mass_times_jump * work);
      }

    report.numerical_dissipation = dissipation;
    add_trapezoidal_works(system, old_state, new_state, report);

    system.reconstruct_massless(old_state, dt, new_state);
    return report;
  }



  namespace
  {
    /// The work (J) of the forces of a body between two states, by Gauss' rule with four
    /// points on each of @p n_parts of the straight path.
    double
    work_on_parts_of_path(const BulkOperator &bulk,
                          const Vector       &begin,
                          const Vector       &end,
                          const unsigned int  n_parts)
    {
      const QIterated<1> rule(QGauss<1>(4), n_parts);
      Vector             point(begin), force(begin);
      double             work = 0.;
      for (unsigned int q = 0; q < rule.size(); ++q)
        {
          copy_values(begin, point);
          point.sadd(1. - rule.point(q)[0], rule.point(q)[0], end);
          bulk.force(point, force);
          work += rule.weight(q) *
            product(entries(force),
                    entries(end) - entries(begin),
                    end.get_mpi_communicator());
        }
      return work;
    }

    /// The same, to round-off. One part is enough for the strains of most steps, but not for
    /// cells that become nearly flat; more of them are taken where the work is not the
    /// difference of stored energies, until it does not change any more.
    double
    work_on_straight_path(const BulkOperator &bulk,
                          const Vector       &begin,
                          const Vector       &end)
    {
      constexpr double       tolerance  = 1e-12;
      constexpr unsigned int most_parts = 64;
      const double first = bulk.energy(begin), last = bulk.energy(end);
      const double small = tolerance * (std::abs(first) + std::abs(last));
      double       work  = work_on_parts_of_path(bulk, begin, end, 1);
      if (std::abs(work - (last - first)) <= small)
        return work;
      for (unsigned int n_parts = 2; n_parts <= most_parts; n_parts *= 2)
        {
          const double coarser = work;
          work = work_on_parts_of_path(bulk, begin, end, n_parts);
          if (!(std::abs(work - coarser) > small))
            break;
        }
      return work;
    }
  } // namespace



  void
  add_trapezoidal_works(const SemiDiscreteSystem &system,
                        const State              &old_state,
                        const State              &new_state,
                        StepReport               &report)
  {
    const MPI_Comm communicator = new_state.solution.get_mpi_communicator();
    const auto     increment =
      entries(new_state.solution) - entries(old_state.solution);
    const auto work_against = [&](Vector State::*const force) {
      return .5 *
        product(entries(new_state.*force) + entries(old_state.*force),
                increment,
                communicator);
    };
    const double friction_work = system.contact.traits().has_friction
      ? work_against(&State::friction_force)
      : 0.;
    report.friction_work += friction_work;
    report.contact_work += work_against(&State::contact_force) - friction_work;
    if (system.bulk.is_viscous())
      report.viscous_dissipation += work_against(&State::viscous_force);
    Vector old_part, new_part;
    old_part.reinit(new_state.solution, true);
    new_part.reinit(new_state.solution, true);

    if (system.works_of_bodies)
      {
        copy_values(new_state.contact_force, new_part);
        new_part.sadd(.5, .5, old_state.contact_force);
        const std::vector<double> works =
          system.works_of_bodies(new_part,
                                 old_state.solution,
                                 new_state.solution);
        report.works_of_bodies.resize(works.size(), 0.);
        for (unsigned int k = 0; k < works.size(); ++k)
          report.works_of_bodies[k] += works[k];
      }

    // The dissipation formulas of the schemes take the trapezoidal rule for the bulk
    // force too. For a linear body that is the difference of stored energies; for a
    // nonlinear one the rule is not exact, and the difference is numerical
    // dissipation. The work itself is integrated on the straight path between both
    // states: with the difference of stored energies, the balance could not detect a
    // stored energy that is not the potential of the forces.
    if (!system.bulk.is_linear())
      {
        system.bulk.force(old_state.solution, old_part);
        system.bulk.force(new_state.solution, new_part);
        const double work = work_on_straight_path(system.bulk,
                                                  old_state.solution,
                                                  new_state.solution);
        // A body that turns by nearly half a turn in a step.
        if (!std::isfinite(work))
          throw NewtonFailure(
            "On the straight path of the step a cell is turned inside out, so that "
            "the work of its forces is not known.\n");
        report.numerical_dissipation += .5 *
            product(entries(old_part) + entries(new_part),
                    increment,
                    communicator) -
          work;
      }

    system.external_load(old_state.time, old_part);
    system.external_load(new_state.time, new_part);
    report.external_work += .5 *
        product(entries(old_part) + entries(new_part),
                increment,
                communicator) +
      system.trapezoidal_follower_work(old_state, new_state);
  }
} // namespace Ricochet
