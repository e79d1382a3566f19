// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/vector_operations.h>
#include <time_integration/generalised_alpha.h>
#include <time_integration/static_equilibrium.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  StepReport
  StaticEquilibrium::step(SemiDiscreteSystem &system,
                          const State        &old_state,
                          const double        time_step,
                          State              &new_state)
  {
    return step(system,
                old_state,
                time_step,
                /* is_last_resort */ false,
                new_state);
  }



  StepReport
  StaticEquilibrium::step_of_last_resort(SemiDiscreteSystem &system,
                                         const State        &old_state,
                                         const double        time_step,
                                         State              &new_state)
  {
    return step(system,
                old_state,
                time_step,
                /* is_last_resort */ true,
                new_state);
  }



  StepReport
  StaticEquilibrium::step(SemiDiscreteSystem &system,
                          const State        &old_state,
                          const double        time_step,
                          const bool          is_last_resort,
                          State              &new_state)
  {
    new_state                = old_state;
    new_state.time           = old_state.time + time_step;
    stage.end_time           = new_state.time;
    stage.is_near_last_state = false;
    stage.inertia            = 0.;
    // With the imposed displacements, which have no imbalance and a share in round-off.
    copy_values(old_state.solution, stage.inertia_origin);
    if (system.unknowns.impose)
      system.unknowns.impose(stage.end_time, stage.inertia_origin);
    if (system.needs_rates())
      {
        stage.rate_time = time_step;
        copy_values(old_state.solution, stage.rate_origin);
      }
    stage.load.reinit(old_state.solution, true);
    system.external_load(new_state.time, stage.load);

    // The guess goes on as in the last step.
    new_state.solution.add(time_step, old_state.mean_velocity);
    StepReport report;
    if (is_last_resort)
      copy_values(stage.inertia_origin, new_state.solution);
    report.solver = is_last_resort || !system.unknowns.unheld.bodies.empty()
      ? find_rest(system, old_state, new_state)
      : system.solve_stage(stage, old_state, new_state);
    if (is_last_resort)
      report.solver.add(SolverReport::pseudo_transient);

    copy_values(new_state.solution, increment);
    increment -= old_state.solution;
    copy_values(increment, new_state.mean_velocity);
    new_state.mean_velocity *= 1. / time_step;

    // Energy balance. F_new is zero, and so is F_old after a step.
    force.reinit(old_state.solution, true);
    system.total_force(old_state, force);
    report.numerical_dissipation -= .5 * (force * increment);
    if (system.has_imposed_displacements())
      {
        system.static_reactions(old_state, old_reaction);
        system.static_reactions(new_state, new_reaction);
        report.imposed_work +=
          .5 * (old_reaction * increment + new_reaction * increment);
      }
    add_trapezoidal_works(system, old_state, new_state, report);
    return report;
  }



  SolverReport
  StaticEquilibrium::find_rest(SemiDiscreteSystem &system,
                               const State        &old_state,
                               State              &new_state)
  {
    // The part of the forces below which there is no imbalance; the smallest stiffness of
    // c M, over that of the body; and displacements of a pass, over the size of a cell.
    constexpr double smallest_imbalance = 1e-11, smallest_stiffness = 1e-11,
                     first_move = 1e-2, good_move = .25, largest_move = 1e3;
    constexpr unsigned int most_passes = 200, most_failures = 30;

    const auto &[bodies, cell_size] = system.unknowns.unheld;
    // The last unknowns of a rank are multipliers.
    const auto largest_displacement = [&]() {
      const unsigned int n = increment.locally_owned_size() -
        system.unknowns.multipliers.n_elements();
      return dealii::Utilities::MPI::max(
        n == 0 ? 0. : entries(increment).head(n).cwiseAbs().maxCoeff(),
        increment.get_mpi_communicator());
    };
    const double of_body = smallest_stiffness * system.bulk.stiffness_scale() /
      system.mass_matrix().linfty_norm();
    // The first pass moves by a small part of a cell.
    force.reinit(old_state.solution, true);
    increment.reinit(old_state.solution, true);
    system.total_force(stage.inertia_origin,
                       old_state.contact_force,
                       stage.end_time,
                       force);
    system.solve_mass(force, increment);
    stage.inertia =
      std::max(of_body, largest_displacement() / (first_move * cell_size));

    SolverReport report;
    double       last_imbalance = 0., share = 1., smallest_part = .01;
    unsigned int n_failures = 0;
    for (unsigned int pass = 0; pass < most_passes; ++pass)
      {
        try
          {
            report += system.solve_stage(stage, old_state, new_state);
          }
        catch (const NewtonFailure &)
          {
            if (++n_failures > most_failures)
              throw;
            copy_values(stage.inertia_origin, new_state.solution);
            stage.inertia *= 4.;
            smallest_part = std::min(.5, 2. * smallest_part);
            continue;
          }
        copy_values(new_state.solution, increment);
        increment -= stage.inertia_origin;
        system.mass_matrix().vmult(force, increment);
        const double imbalance = stage.inertia * force.l2_norm();
        system.bulk.force(new_state.solution, force);
        const double forces = force.l2_norm() + stage.load.l2_norm() +
          new_state.contact_force.l2_norm();
        share = forces > 0. ? imbalance / forces : 0.;
        if (share <= smallest_imbalance)
          return report;
        copy_values(new_state.solution, stage.inertia_origin);
        // c falls with the imbalance, and faster where little has moved.
        const double move = largest_displacement() / cell_size;
        if (!(move < largest_move))
          break;
        const double part =
          last_imbalance > 0. ? imbalance / last_imbalance : 1.;
        stage.inertia  = std::max(of_body,
                                 stage.inertia *
                                   std::clamp(std::min(part, move / good_move),
                                              smallest_part,
                                              .5));
        last_imbalance = imbalance;
      }
    std::string names;
    for (const std::string &name : bodies)
      names += (names.empty() ? "'" : ", '") + name + "'";
    if (names.empty())
      throw NewtonFailure(
        "No equilibrium was found, near the last one or elsewhere: " +
        to_text(share) + " of the forces are not balanced.\n");
    throw ComputationError(
      "No support holds " + names +
      ", and no equilibrium was found: " + to_text(share) +
      " of the forces are not balanced. A condition (fixed, displacement, springs) in "
      "each direction, contact with something that is held, or friction could hold it.");
  }
} // namespace Ricochet
