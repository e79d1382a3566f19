// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <base/exceptions.h>
#include <time_integration/semi_discrete_system.h>
#include <time_integration/stage_problem.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Contact structure without prescribed displacements, which contact does not
    /// affect.
    ContactStructure
    contact_structure(const ContactOperator &contact,
                      const Constraints     &constraints)
    {
      ContactStructure structure = contact.structure();
      if (structure.functionals)
        {
          const Functionals &all = structure.functionals->functionals;
          Functionals        free;
          for (unsigned int f = 0; f < all.size(); ++f)
            {
              for (std::size_t k = all.begin[f]; k < all.begin[f + 1]; ++k)
                if (!constraints.is_constrained(all.index[k]))
                  free.add(all.index[k], all.value[k]);
              free.end_functional();
            }
          structure.functionals->functionals = std::move(free);
        }
      return structure;
    }
  } // namespace

  namespace
  {
    /// Parameters for condensed systems: their solutions have to solve the whole
    /// system, too, whose residual has other round-off.
    NewtonSolver::Parameters
    with_margin(NewtonSolver::Parameters parameters)
    {
      parameters.tolerance *= .5;
      return parameters;
    }
  } // namespace



  SemiDiscreteSystem::SemiDiscreteSystem(
    const BodyMatrix               &mass,
    const BodyMatrix               &invertible_mass,
    const BulkOperator             &bulk,
    ContactOperator                &contact,
    const Unknowns                 &unknowns,
    Load                            load,
    const NewtonSolver::Parameters &newton_parameters,
    const LinearSolver::Parameters &solver_parameters,
    const FollowerLoad             *follower)
    : bulk(bulk)
    , contact(contact)
    , unknowns(unknowns)
    , mass(mass)
    , invertible_mass(invertible_mass)
    , clamped(constrained_indices(*unknowns.constraints,
                                  mass.locally_owned_range_indices()))
    , load(std::move(load))
    , follower(follower)
    , newton(newton_parameters)
    , condensed_newton(with_margin(newton_parameters))
    , quasi_newton(newton_parameters)
    , linear_solver(solver_parameters,
                    contact_structure(contact, *unknowns.constraints),
                    bulk.is_linear(),
                    clamped,
                    unknowns.coarse_space,
                    unknowns.dim,
                    mass.m(),
                    Utilities::MPI::n_mpi_processes(
                      mass.get_mpi_communicator()))
    , has_multipliers(
        Utilities::MPI::max(unknowns.multipliers.n_elements() > 0 ? 1 : 0,
                            mass.get_mpi_communicator()) == 1)
    , work(contact.row_scaling())
    , constant_part(contact.row_scaling())
    , force(contact.row_scaling())
    , reaction(contact.row_scaling())
    , safe_guess(contact.row_scaling())
    , residual(contact.row_scaling())
  {}

  void
  SemiDiscreteSystem::external_load(const double time, Vector &result) const
  {
    result = 0.;
    if (load)
      load(time, result);
  }

  void
  SemiDiscreteSystem::total_force(const State &state, Vector &result) const
  {
    total_force(state.solution, state.contact_force, state.time, result);
    if (bulk.is_viscous())
      {
        result += state.viscous_force;
        set_clamped_to_zero(clamped, result);
      }
  }

  void
  SemiDiscreteSystem::sum_of_forces(const Vector &solution,
                                    const Vector &contact_force,
                                    const double  time,
                                    Vector       &result) const
  {
    bulk.force(solution, result);
    result += contact_force;
    if (load)
      {
        external_load(time, work);
        result -= work;
      }
    if (follower)
      {
        follower->force_at(solution, time, work);
        result -= work;
      }
  }

  void
  SemiDiscreteSystem::total_force(const Vector &solution,
                                  const Vector &contact_force,
                                  const double  time,
                                  Vector       &result) const
  {
    sum_of_forces(solution, contact_force, time, result);
    set_clamped_to_zero(clamped, result);
  }

  void
  SemiDiscreteSystem::static_reactions(const State &state, Vector &forces) const
  {
    forces.reinit(state.solution);
    sum_of_forces(state.solution,
                  state.contact_force,
                  state.time,
                  constant_part);
    if (bulk.is_viscous())
      constant_part += state.viscous_force;
    for (const auto i : clamped)
      forces(i) = constant_part(i);
    forces.compress(VectorOperation::insert);
  }

  double
  SemiDiscreteSystem::follower_work(const State &old_state,
                                    const State &new_state) const
  {
    if (!follower)
      return 0.;
    follower->step_force(old_state.solution,
                         new_state.solution,
                         old_state.time,
                         new_state.time,
                         work);
    constant_part = new_state.solution;
    constant_part -= old_state.solution;
    return work * constant_part;
  }

  double
  SemiDiscreteSystem::trapezoidal_follower_work(const State &old_state,
                                                const State &new_state) const
  {
    if (!follower)
      return 0.;
    constant_part = new_state.solution;
    constant_part -= old_state.solution;
    double sum = 0.;
    for (const State *state : {&old_state, &new_state})
      {
        follower->force_at(state->solution, state->time, work);
        sum += .5 * (work * constant_part);
      }
    return sum;
  }

  void
  SemiDiscreteSystem::solve_mass(const Vector &right_hand_side,
                                 Vector       &acceleration)
  {
    if (!mass_solver)
      {
        // Multipliers have no mass; they have equations of their own.
        std::vector<MassSolver::Index> own(clamped.begin(), clamped.end());
        own.insert(own.end(),
                   unknowns.multipliers.begin(),
                   unknowns.multipliers.end());
        mass_solver.emplace(invertible_mass, own);
      }
    mass_solver->solve(right_hand_side, acceleration);
  }

  State
  SemiDiscreteSystem::initial_state(const Vector              &displacement,
                                    const Vector              &velocity,
                                    const double               time,
                                    const std::vector<Vector> &contact_forces)
  {
    frozen_tangent.forget();
    State state;
    state.time     = time;
    state.solution = displacement;
    state.velocity = velocity;
    set_clamped_to_zero(clamped, state.solution);
    set_clamped_to_zero(clamped, state.velocity);
    if (unknowns.impose)
      {
        unknowns.impose(time, state.solution);
        unknowns.impose_rate(time, state.velocity);
      }
    state.contact_force.reinit(displacement);
    state.acceleration.reinit(displacement);
    state.scheme_force.reinit(displacement);
    if (contact.traits().has_friction)
      state.friction_force.reinit(displacement);
    state.mean_velocity = state.velocity;

    set_contact_force(state);
    if (state.contact_shares.empty() && contact_forces.size() == 1 &&
        contact_forces[0].size() > 0)
      copy_values(contact_forces[0], state.contact_force);
    for (unsigned int k = 0;
         k < std::min(contact_forces.size(), state.contact_shares.size());
         ++k)
      if (contact_forces[k].size() > 0)
        {
          state.contact_force -= state.contact_shares[k];
          state.contact_force += contact_forces[k];
          copy_values(contact_forces[k], state.contact_shares[k]);
        }
    if (bulk.is_viscous())
      {
        // In one second the body comes from here.
        entries(work) = entries(state.solution) - entries(state.velocity);
        state.viscous_force.reinit(displacement);
        bulk.viscous_force(work, state.solution, 1., state.viscous_force);
      }
    total_force(state, force);
    force *= -1.;
    solve_mass(force, state.acceleration);

    mass.vmult(state.scheme_force, state.acceleration);
    state.scheme_force *= -1.;
    return state;
  }

  void
  SemiDiscreteSystem::set_contact_force(State &state) const
  {
    contact.force_at(state.solution, state.time, state.contact_force);
    take_shares(state);
  }

  void
  SemiDiscreteSystem::take_shares(State &state) const
  {
    const std::vector<const Vector *> shares = contact.shares();
    state.contact_shares.resize(shares.size());
    for (unsigned int k = 0; k < shares.size(); ++k)
      copy_values(*shares[k], state.contact_shares[k]);
  }

  bool
  SemiDiscreteSystem::solve_condensed(
    StageProblem                &problem,
    const NewtonSolver::Problem &newton_problem,
    Vector                      &solution)
  {
    newton_problem.residual(solution, residual);
    if (!std::isfinite(newton_problem.norm(residual)))
      return false;
    problem.report.add(SolverReport::condensed);
    CondensedStage condensed = problem.condensed(newton_problem, residual);
    const auto     report    = [&]() {
      const auto &iterations = condensed.iterations();
      if (iterations.empty())
        return;
      problem.report.newton_iterations += iterations.size() - 1;
      ++problem.report.outer_iterations;
      if (newton_observer)
        newton_observer(iterations, SolverReport::condensed);
    };
    try
      {
        condensed.solve(condensed_newton, solution, problem.report);
      }
    catch (const NewtonFailure &)
      {
        report();
        throw;
      }
    report();
    problem.hold_clamped(solution);
    return newton.solves(newton_problem, solution);
  }

  void
  SemiDiscreteSystem::condense_body(StageProblem &problem,
                                    const Stage  &stage,
                                    const Vector &old_solution)
  {
    if (!frozen_tangent.serves(stage.time_step))
      {
        frozen_tangent.begin(stage.end_time, stage.time_step, old_solution);
        ++problem.report.n_tangents;
      }
    copy_values(frozen_tangent.solution, frozen_guess);
    if (unknowns.impose)
      unknowns.impose(frozen_tangent.record.end_time, frozen_guess);
    if (factored_tangent.is_same(frozen_tangent))
      return;
    factored_tangent.forget();
    const FrozenTangent::Record &record = frozen_tangent.record;
    problem.condense_at({frozen_tangent.solution,
                         frozen_guess,
                         record.end_time,
                         record.end_time + record.time_step});
    factored_tangent = frozen_tangent;
  }

  bool
  SemiDiscreteSystem::solve_near_last_state(
    StageProblem                &problem,
    const NewtonSolver::Problem &newton_problem,
    const Stage                 &stage,
    const ContactStart          &start,
    Vector                      &solution)
  {
    first_guess = solution;
    for (;;)
      {
        // After contact the body may be far from free flight, where its tangent may be
        // that of nearly flat elements; the last state is an admissible one.
        solution       = safe_guess;
        bool is_solved = false, is_old = false;
        try
          {
            if (!body_is_condensed)
              condense_body(problem, stage, start.solution);
            body_is_condensed = true;
            problem.report.add(SolverReport::frozen_tangent);
            is_old              = frozen_tangent.exists();
            is_solved           = quasi_newton.solve(problem,
                                           newton_problem,
                                           condensed_newton,
                                           solution);
            const auto &history = quasi_newton.iterations();
            n_iterations_with_tangent += history.size() - 1;
            if (newton_observer)
              newton_observer(history, SolverReport::frozen_tangent);
            if (!is_solved && !is_old &&
                (has_multipliers || !(history.back().relative_residual < 1e-3)))
              solution = first_guess;
          }
        catch (const NewtonFailure &)
          {
            if (!is_old)
              {
                solution = first_guess;
                throw;
              }
          }
        if (is_solved || !is_old)
          return is_solved;
        problem.report.add(SolverReport::tangent_renewed);
        frozen_tangent.forget();
        body_is_condensed         = false;
        n_iterations_with_tangent = 0;
        contact.begin_stage(start, stage.contact_weight_new);
      }
  }

  SolverReport
  SemiDiscreteSystem::solve_stage(const Stage &stage,
                                  const State &old_state,
                                  State       &new_state)
  {
    AssertThrow(stage.bulk_step_force || stage.rate_time > 0. || !needs_rates(),
                ExcMessage("A time scheme that declares gives_rates has to set "
                           "Stage::rate_origin and rate_time."));
    Vector      &solution = new_state.solution;
    StageProblem problem({mass,
                          bulk,
                          contact,
                          linear_solver,
                          *unknowns.constraints,
                          clamped,
                          static_cast<unsigned int>(
                            unknowns.multipliers.n_elements()),
                          unknowns.pattern,
                          residual_seconds,
                          tangent_seconds,
                          united_pattern,
                          work,
                          force,
                          constant_part,
                          condensed_space,
                          reaction,
                          body_matrix,
                          follower},
                         stage,
                         old_state,
                         solution,
                         safe_guess);
    // Iterates keep the prescribed displacements of the guess.
    copy_values(old_state.solution, safe_guess);
    if (unknowns.impose)
      {
        unknowns.impose(stage.end_time, solution);
        unknowns.impose(stage.end_time, safe_guess);
      }
    const NewtonSolver::Problem newton_problem = problem.for_newton();
    const ContactStart          start{old_state.solution,
                             old_state.contact_force,
                             old_state.mean_velocity,
                             stage.time_step,
                             stage.end_time,
                             &old_state.contact_shares,
                             stage.rate_time > 0. ? &stage.rate_origin
                                                           : nullptr,
                             stage.rate_time};
    // No second attempt in this stage after a failure, which would repeat
    // itself.
    bool condenses = linear_solver.condenses() &&
      (bulk.is_linear() ||
       (stage.is_near_last_state && quasi_newton.is_allowed()));
    const auto solve_all_passes = [&]() {
      problem.forget_tangents();
      body_is_condensed         = false;
      n_iterations_with_tangent = 0;
      contact.begin_stage(start, stage.contact_weight_new);
      do
        {
          if (condenses)
            {
              try
                {
                  const bool is_solved = bulk.is_linear()
                    ? solve_condensed(problem, newton_problem, solution)
                    : solve_near_last_state(problem,
                                            newton_problem,
                                            stage,
                                            start,
                                            solution);
                  if (is_solved)
                    continue;
                  problem.report.add(SolverReport::condensed_failed);
                  condenses = bulk.is_linear();
                  // Multipliers of constraints that are nearly the same may have
                  // grown beyond all forces, which scale the residuals.
                  if (!bulk.is_linear() && has_multipliers)
                    contact.begin_stage(start, stage.contact_weight_new);
                }
              catch (const NewtonFailure &)
                {
                  problem.report.add(SolverReport::condensed_failed);
                  condenses = false;
                  // The whole system may converge, as its residuals are scaled by
                  // all forces; if not, its failure is reported.
                  contact.begin_stage(start, stage.contact_weight_new);
                }
            }
          const auto &history = newton.solve(newton_problem, solution);
          if (newton_observer)
            newton_observer(history, std::nullopt);
      } while (contact.next_pass());
    };
    try
      {
        solve_all_passes();
      }
    catch (const NewtonFailure &)
      {
        // The guess of a nonlinear body may be so bad, with nearly flat elements,
        // that the iteration fails; the last state is an admissible one.
        if (bulk.is_linear())
          throw;
        problem.report.add(SolverReport::stage_repeated);
        const std::string first_reason = bulk.failure();
        solution                       = safe_guess;
        try
          {
            solve_all_passes();
          }
        catch (const NewtonFailure &newton_failure)
          {
            const std::string second_reason = bulk.failure();
            const std::string reason =
              second_reason.empty() ? first_reason : second_reason;
            if (reason.empty())
              throw;
            throw NewtonFailure(newton_failure.what() + reason + "\n");
          }
      }
    // A failure of the frozen tangent requires another one in the next step.
    if (condenses && !bulk.is_linear() && stage.bulk_step_force)
      frozen_tangent.count(n_iterations_with_tangent);
    else
      frozen_tangent.forget();
    // A support that moves would do work that is missing in the balance.
    for (const auto i : clamped)
      {
        (void)i;
        Assert(solution(i) == safe_guess(i), ExcInternalError());
      }
    stage_round_off = newton_problem.round_off();
    copy_values(contact.contact_force(), new_state.contact_force);
    if (!stage.bulk_step_force)
      {
        if (const Vector *part = contact.friction_force())
          copy_values(*part, new_state.friction_force);
        if (bulk.is_viscous())
          bulk.viscous_force(stage.rate_origin,
                             solution,
                             stage.rate_time,
                             new_state.viscous_force);
      }
    take_shares(new_state);
    return problem.report;
  }

  double
  SemiDiscreteSystem::imposed_work(const Vector &way) const
  {
    double sum = 0.;
    for (const auto i : clamped)
      sum += reaction(i) * way(i);
    return Utilities::MPI::sum(sum, mass.get_mpi_communicator());
  }

  SemiDiscreteSystem::Shares
  SemiDiscreteSystem::shares() const
  {
    return {residual_seconds,
            tangent_seconds,
            linear_solver.factorisation_seconds(),
            linear_solver.back_substitution_seconds()};
  }

  void
  SemiDiscreteSystem::reconstruct_massless(const State &old_state,
                                           const double time_step,
                                           State       &new_state) const
  {
    for (const auto i : unknowns.massless)
      {
        const double velocity =
          (new_state.solution(i) - old_state.solution(i)) / time_step;
        new_state.velocity(i) = velocity;
        new_state.acceleration(i) =
          (velocity - old_state.velocity(i)) / time_step;
      }
    for (const auto i : unknowns.multipliers)
      new_state.velocity(i) = new_state.acceleration(i) = 0.;
    new_state.velocity.compress(VectorOperation::insert);
    new_state.acceleration.compress(VectorOperation::insert);
  }

  double
  SemiDiscreteSystem::distance(const Vector &from, const Vector &to) const
  {
    const unsigned int n =
      to.locally_owned_size() - unknowns.multipliers.n_elements();
    return std::sqrt(Utilities::MPI::sum(
      (entries(to).head(n) - entries(from).head(n)).squaredNorm(),
      mass.get_mpi_communicator()));
  }

  double
  SemiDiscreteSystem::kinetic_energy(const Vector &velocity) const
  {
    mass.vmult(work, velocity);
    return .5 *
      product(entries(work),
              entries(velocity),
              velocity.get_mpi_communicator());
  }
} // namespace Ricochet
