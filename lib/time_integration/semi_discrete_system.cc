// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <time_integration/semi_discrete_system.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Clamped unknowns (@p clamped of this rank) have equations of their own,
    /// in which contact has no part.
    ContactStructure
    contact_structure(const TangentContact &contact,
                      const IndexSet       &my_clamped,
                      const MPI_Comm        communicator)
    {
      ContactStructure structure = contact.tangent_structure();
      if (structure.functionals)
        {
          IndexSet   clamped(my_clamped.size());
          const auto lists = Utilities::MPI::all_gather(
            communicator,
            std::vector<types::global_dof_index>(my_clamped.begin(),
                                                 my_clamped.end()));
          for (const auto &list : lists)
            clamped.add_indices(list.begin(), list.end());
          const Functionals &all = structure.functionals->functionals;
          Functionals        free;
          for (unsigned int f = 0; f < all.size(); ++f)
            {
              for (std::size_t k = all.begin[f]; k < all.begin[f + 1]; ++k)
                if (!clamped.is_element(all.index[k]))
                  free.add(all.index[k], all.value[k]);
              free.end_functional();
            }
          structure.functionals->functionals = std::move(free);
        }
      // Rows of clamped unknowns are cleared, columns are not.
      if (Utilities::MPI::max(my_clamped.n_elements() > 0 ? 1 : 0,
                              communicator) == 1)
        structure.is_symmetric = false;
      return structure;
    }
  } // namespace



  SemiDiscreteSystem::SemiDiscreteSystem(
    const Matrix                   &mass,
    const Matrix                   &invertible_mass,
    const BulkOperator             &bulk,
    ContactOperator                &contact,
    const Unknowns                 &unknowns,
    Load                            load,
    const NewtonSolver::Parameters &newton_parameters,
    const LinearSolver::Parameters &solver_parameters)
    : bulk(bulk)
    , contact(contact)
    , unknowns(unknowns)
    , mass(mass)
    , invertible_mass(invertible_mass)
    , clamped_list(unknowns.clamped.begin(), unknowns.clamped.end())
    , load(std::move(load))
    , newton(newton_parameters)
    , linear_solver(solver_parameters,
                    contact_structure(contact,
                                      unknowns.clamped,
                                      mass.get_mpi_communicator()),
                    bulk.is_linear(),
                    unknowns.clamped,
                    unknowns.coarse_space,
                    unknowns.dim,
                    mass.m(),
                    Utilities::MPI::n_mpi_processes(
                      mass.get_mpi_communicator()))
    , work(contact.row_scaling())
    , constant_part(contact.row_scaling())
    , force(contact.row_scaling())
  {}



  void
  SemiDiscreteSystem::set_clamped_to_zero(Vector &vector) const
  {
    // What is not a number stays so: it may be the mark of an element that is
    // turned inside out.
    for (const auto i : unknowns.clamped)
      vector(i) = 0. * vector(i);
    vector.compress(VectorOperation::insert);
  }



  double
  SemiDiscreteSystem::displacement_norm(const Vector &vector) const
  {
    // Multipliers are the last of each rank's unknowns.
    const double      *values = vector.trilinos_vector()[0];
    const unsigned int n =
      vector.locally_owned_size() - unknowns.multipliers.n_elements();
    const double square = std::inner_product(values, values + n, values, 0.);
    return std::sqrt(Utilities::MPI::sum(square, mass.get_mpi_communicator()));
  }



  void
  SemiDiscreteSystem::external_load(const double time, Vector &result) const
  {
    result = 0.;
    if (load)
      load(time, result);
  }



  void
  SemiDiscreteSystem::total_force(const Vector &solution,
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
    set_clamped_to_zero(result);
  }



  void
  SemiDiscreteSystem::solve_mass(const Vector &right_hand_side,
                                 Vector       &acceleration)
  {
    // A key of its own: no stage has a negative weight of the bulk force.
    Tangent tangent;
    tangent.body          = BodyKey{1., -1., 0.};
    tangent.contact       = 0;
    tangent.assemble_body = [&](Matrix &matrix) {
      matrix.copy_from(invertible_mass);
      matrix.clear_rows(clamped_list, 1.);
      // Multipliers have no mass; give them an equation.
      for (const auto i : unknowns.multipliers)
        matrix.set(i, i, 1.);
      matrix.compress(VectorOperation::insert);
    };
    tangent.complete_open_contact = [](Matrix &) {};
    tangent.body_terms            = {{1., &invertible_mass}};
    linear_solver.solve(tangent, right_hand_side, acceleration, false, 1e-14);
  }



  State
  SemiDiscreteSystem::initial_state(const Vector &displacement,
                                    const Vector &velocity,
                                    const double  time)
  {
    State state;
    state.time     = time;
    state.solution = displacement;
    state.velocity = velocity;
    set_clamped_to_zero(state.solution);
    set_clamped_to_zero(state.velocity);
    state.contact_force.reinit(displacement);
    state.acceleration.reinit(displacement);
    state.scheme_force.reinit(displacement);
    state.mean_velocity = state.velocity;

    contact.force_at(state.solution, time, state.contact_force);
    total_force(state.solution, state.contact_force, time, force);
    force *= -1.;
    solve_mass(force, state.acceleration);

    mass.vmult(state.scheme_force, state.acceleration);
    state.scheme_force *= -1.;
    return state;
  }



  unsigned int
  SemiDiscreteSystem::solve_stage(const Stage &stage,
                                  const State &old_state,
                                  Vector      &solution,
                                  Vector      &contact_force)
  {
    // What does not change during the iteration: old forces and load.
    constant_part = 0.;
    if (!stage.bulk_step_force && stage.bulk_weight_old != 0.)
      {
        bulk.force(old_state.solution, force);
        constant_part.add(stage.bulk_weight_old, force);
      }
    if (stage.contact_weight_old != 0.)
      constant_part.add(stage.contact_weight_old, old_state.contact_force);
    constant_part.add(-1., stage.load);
    const double constant_scale = constant_part.l2_norm();

    // The forces that nearly cancel in a residual are what "small" is measured
    // against: inertia, bulk, contact and what is constant. Inertia and bulk
    // forces are small differences of large numbers when the step is short or
    // the body far from where it started, and so is a small gap; their
    // round-off remains, whatever Newton's method does.
    double force_scale = 0.;
    mass.vmult(work, stage.inertia_origin);
    const double bulk_round_off = 4. * std::numeric_limits<double>::epsilon() *
      (stage.inertia * work.l2_norm() +
       bulk.stiffness_scale() * displacement_norm(stage.inertia_origin));

    const auto residual = [&](const Vector &point, Vector &result) {
      const Stopwatch stopwatch(residual_seconds);
      work = point;
      work -= stage.inertia_origin;
      mass.vmult(result, work);
      result *= stage.inertia;
      force_scale = constant_scale + result.l2_norm();
      if (stage.bulk_step_force)
        {
          bulk.step_force(old_state.solution, point, stage.time_step, force);
          force_scale += force.l2_norm();
          result += force;
        }
      else
        {
          bulk.force(point, force);
          force_scale += force.l2_norm();
          result.add(stage.bulk_weight_new, force);
        }
      result += constant_part;
      contact.complete_residual(point, result);
      force_scale +=
        stage.contact_weight_new * contact.contact_force().l2_norm();
      set_clamped_to_zero(result);
    };

    const double bulk_weight =
      stage.bulk_step_force ? .5 : stage.bulk_weight_new;
    // Which points are active in the tangent without a key, if there is one:
    // no other stage may use it, so that a resumed run does the same.
    std::optional<std::uint64_t> factored_active_set;
    // Counted where they are made, so that those of a first attempt that failed
    // count too.
    unsigned int n_iterations = 0;
    const auto   solve        = [&](const Vector &right_hand_side,
                           Vector       &update,
                           const bool    may_reuse,
                           const double  tolerance) {
      ++n_iterations;
      Tangent tangent;
      if (bulk.is_linear())
        {
          tangent.body =
            BodyKey{stage.inertia, bulk_weight, stage.contact_weight_new};
          tangent.contact    = contact.tangent_signature();
          tangent.body_terms = stage.bulk_step_force
                     ? bulk.step_tangent_terms(stage.time_step)
                     : bulk.tangent_terms(bulk_weight);
          AssertThrow(!tangent.body_terms.empty(), ExcInternalError());
          tangent.body_terms.push_back({stage.inertia, &mass});
        }
      tangent.assemble_body = [&](Matrix &matrix) {
        const Stopwatch stopwatch(tangent_seconds);
        if (matrix.n_nonzero_elements() ==
            unknowns.pattern->n_nonzero_elements())
          matrix = 0.;
        else
          matrix.reinit(*unknowns.pattern);
        matrix.add(stage.inertia, mass);
        if (stage.bulk_step_force)
          bulk.add_step_tangent(old_state.solution,
                                solution,
                                stage.time_step,
                                matrix);
        else
          bulk.add_tangent(bulk_weight, solution, matrix);
      };
      const auto complete = [&](void (TangentContact::*add)(Matrix &) const) {
        return [this, add](Matrix &matrix) {
          const Stopwatch stopwatch(tangent_seconds);
          (contact.*add)(matrix);
          matrix.clear_rows(clamped_list, 1.);
        };
      };
      tangent.complete_contact = complete(&TangentContact::complete_tangent);
      tangent.complete_open_contact =
        complete(&TangentContact::complete_open_tangent);
      tangent.contact_change = [&](std::vector<FunctionalRow> &change) {
        const Stopwatch stopwatch(tangent_seconds);
        contact.tangent_change(change);
      };
      const bool          has_name   = tangent.body && tangent.contact;
      const std::uint64_t active_set = contact.active_set_signature();
      const bool          reuse =
        may_reuse && !has_name && factored_active_set == active_set;
      if (!has_name)
        factored_active_set = active_set;
      linear_solver.solve(tangent, right_hand_side, update, reuse, tolerance);
    };

    const auto norm = [&](const Vector &result) {
      work = result;
      work.scale(contact.row_scaling());
      return work.l2_norm() +
        stage.contact_weight_new * contact.linearisation_error();
    };

    const NewtonSolver::Problem problem{
      residual,
      solve,
      norm,
      [&]() { contact.accept_iterate(); },
      [&]() { return contact.active_set_description(); },
      [&]() { return force_scale; },
      [&]() {
        return bulk_round_off + stage.contact_weight_new * contact.round_off();
      },
      &old_state.solution};
    const ContactStart start{old_state.solution,
                             old_state.contact_force,
                             old_state.mean_velocity,
                             stage.time_step,
                             stage.end_time};
    const auto         solve_all_passes = [&]() {
      linear_solver.begin_stage();
      factored_active_set.reset();
      contact.begin_stage(start, stage.contact_weight_new);
      do
        {
          const auto &history = newton.solve(problem, solution);
          if (newton_observer)
            newton_observer(history);
      } while (contact.next_pass());
    };
    try
      {
        solve_all_passes();
      }
    catch (const NewtonFailure &)
      {
        // The guess of a nonlinear body may be so bad, with elements nearly flat,
        // that there is no way out; the last state is a body that exists.
        if (bulk.is_linear())
          throw;
        const std::string first_reason = bulk.failure();
        solution                       = old_state.solution;
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
    contact_force = contact.contact_force();
    return n_iterations;
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
  SemiDiscreteSystem::kinetic_energy(const Vector &velocity) const
  {
    mass.vmult(work, velocity);
    return .5 * (work * velocity);
  }
} // namespace Ricochet
