// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <time_integration/condensed_stage.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  CondensedStage::CondensedStage(const NewtonSolver::Problem &problem,
                                 ContactSchurComplement      &system,
                                 ContactOperator             &contact,
                                 const Vector                &residual,
                                 const ContactForces         &contact_forces,
                                 WorkSpace                   &space)
    : problem(problem)
    , system(system)
    , contact(contact)
    , contact_forces(contact_forces)
    , body_force_scale(problem.force_scale() - contact_forces.scale)
    , contact_force_scale(contact_forces.scale)
    , open_residual(space.open_residual)
    , work(space.work)
    , change(space.change)
    , excess_change(space.excess_change)
  {
    copy_values(residual, open_residual);
    if (work.size() != residual.size())
      work.reinit(residual);
    contact.forces_on_rows(forces);
    const std::vector<double> all = by_place(forces);
    for (double &force : forces)
      force = -force;
    system.add_rows(forces, open_residual);
    if (contact.structure().eliminates_rows)
      open_excess = system.along_rows(open_residual);
    system.begin(open_residual);
    look_around(all);
  }



  void
  CondensedStage::look_around(const std::vector<double> &coefficients)
  {
    // Points far from contact keep their values at the guess, until contact comes
    // near. The residual of the whole stage shows if they were needed.
    const auto        last      = std::find_if(coefficients.rbegin(),
                                   coefficients.rend(),
                                   [](const double z) { return z != 0.; });
    const std::size_t n_pressed = coefficients.rend() - last;
    const std::size_t n_near =
      std::min(coefficients.size(), n_pressed + n_pressed / 8 + 64);
    if (n_near <= flight_values.size())
      return;
    flight_values.resize(n_near);
    system.observe(flight_values);
    for (double &value : flight_values)
      value = -value;
  }



  CondensedStage::Unknowns
  CondensedStage::read(const Vector &vector)
  {
    const double *values = local_values(vector);
    const auto    n      = vector.locally_owned_size() - 1;
    return {{values, values + n}, values[n]};
  }



  void
  CondensedStage::write(const Unknowns &unknowns, Vector &vector)
  {
    double *values = local_values(vector);
    std::copy(unknowns.coefficients.begin(),
              unknowns.coefficients.end(),
              values);
    values[unknowns.coefficients.size()] = unknowns.share;
  }



  std::vector<double>
  CondensedStage::by_place(const std::vector<double> &coefficients) const
  {
    std::vector<double> all(system.n_rows());
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      all[system.place(f)] = coefficients[f];
    return all;
  }



  void
  CondensedStage::residual(const Vector &point, Vector &result)
  {
    Unknowns                  unknowns     = read(point);
    const std::vector<double> coefficients = by_place(unknowns.coefficients);
    look_around(coefficients);
    std::vector<double> values(flight_values);
    for (double &value : values)
      value *= unknowns.share;
    system.add_compliance(-1., coefficients, values);
    std::vector<double> change(unknowns.coefficients.size());
    for (unsigned int f = 0; f < change.size(); ++f)
      change[f] =
        system.place(f) < values.size() ? values[system.place(f)] : 0.;
    if (contact.structure().eliminates_rows)
      {
        work = 0.;
        system.add_rows(unknowns.coefficients, work);
        excess = system.along_rows(work);
        for (unsigned int f = 0; f < excess.size(); ++f)
          excess[f] = (1. - unknowns.share) * open_excess[f] - excess[f];
      }
    contact.evaluate_at_increment(change, excess);
    contact.forces_on_rows(forces);
    for (unsigned int f = 0; f < change.size(); ++f)
      unknowns.coefficients[f] = forces[f] - unknowns.coefficients[f];
    contact_force_scale = unknowns.share == 0.
      ? contact_forces.scale
      : system.norm_of_rows(forces, nullptr);
    unknowns.share      = 1. - unknowns.share;
    write(unknowns, result);
  }



  double
  CondensedStage::norm(const Vector &small_residual)
  {
    const Unknowns rest = read(small_residual);
    if (rest.share == 0.)
      return system.norm_of_rows(rest.coefficients,
                                 contact_forces.row_scaling) +
        contact_forces.weight * contact.linearisation_error();
    work = 0.;
    work.add(rest.share, open_residual);
    system.add_rows(rest.coefficients, work);
    return problem.norm(work);
  }



  void
  CondensedStage::linear_solve(const Vector &right_hand_side,
                               Vector       &update,
                               const bool    may_reuse)
  {
    Unknowns rest = read(right_hand_side);
    // Reuse of the dense system where Newton's method converges fast: a new one
    // costs more than the one or two iterations that it would save.
    const std::uint64_t active_set = contact.active_set().hash;
    if (!may_reuse || tangent_active_set != active_set)
      {
        change.assign(system.n_rows(), {});
        excess_change.assign(system.n_rows(), {});
        contact.differentiate_forces(change, excess_change);
        system.set_contact(change, excess_change);
        tangent_active_set = active_set;
      }
    for (unsigned int f = 0; f < open_excess.size(); ++f)
      for (const auto &[g, value] : excess_change[f])
        rest.coefficients[f] -= value * rest.share * open_excess[g];
    std::vector<double> coefficients = by_place(rest.coefficients);
    std::vector<double> values(flight_values);
    for (double &value : values)
      value *= -rest.share;
    values.resize(system.n_rows(), 0.);
    system.solve_contact(coefficients, values);
    for (unsigned int f = 0; f < rest.coefficients.size(); ++f)
      rest.coefficients[f] = -coefficients[system.place(f)];
    rest.share = -rest.share;
    write(rest, update);
  }



  void
  CondensedStage::solve(NewtonSolver &newton,
                        Vector       &solution,
                        SolverReport &report,
                        const double  sufficient)
  {
    Vector unknowns(complete_index_set(forces.size() + 1), MPI_COMM_SELF);

    const NewtonSolver::Problem condensed{
      [this](const Vector &point, Vector &result) { residual(point, result); },
      [this](const Vector &right_hand_side,
             Vector       &update,
             const bool    may_reuse,
             const double /*tolerance*/) {
        linear_solve(right_hand_side, update, may_reuse);
      },
      [this](const Vector &result) { return norm(result); },
      problem.accept,
      problem.active_set,
      [this]() { return body_force_scale + contact_force_scale; },
      [this, sufficient]() { return problem.round_off() + sufficient; },
      nullptr};
    // A line search may stagnate where points pass from facet to facet, and full steps
    // may diverge. Iterations are cheap here.
    constexpr unsigned int n_attempts = 8;
    const auto             remember   = [&]() {
      // The initial iterate of a later attempt is the last one of the attempt
      // before.
      const auto &latest = newton.iterations();
      report.inner_iterations += latest.empty() ? 0 : latest.size() - 1;
      history.insert(history.end(),
                     latest.begin() +
                       (history.empty() || latest.empty() ? 0 : 1),
                     latest.end());
    };
    bool is_solved = false, line_search_at_once = false;
    for (unsigned int attempt = 1; !is_solved; ++attempt)
      try
        {
          newton.solve(condensed, unknowns, line_search_at_once);
          is_solved = true;
          remember();
        }
      catch (const NewtonFailure &)
        {
          remember();
          // An immediate failure would repeat itself.
          if (attempt == n_attempts || newton.iterations().size() < 3 ||
              !std::isfinite(newton.iterations().back().relative_residual))
            throw;
          report.add(SolverReport::condensed_restarted);
          // Iterates after the one that is restored do not indicate a cycle.
          const unsigned int end = newton.end_iteration();
          if (end + 1 < newton.iterations().size())
            contact.forget_iterates();
          // Full steps for the next attempt, unless they led nowhere, or shortened ones
          // are about to converge.
          line_search_at_once = end == 0 || newton.was_on_its_way();
        }

    Unknowns result = read(unknowns);
    // The guess is the solution to the last digit if there was no step.
    if (result.share == 0.)
      return;
    for (double &coefficient : result.coefficients)
      coefficient /= -result.share;
    system.finish(result.coefficients, work);
    solution.add(-result.share, work);
  }
} // namespace Ricochet
