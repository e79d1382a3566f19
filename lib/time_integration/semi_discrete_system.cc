// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <time_integration/semi_discrete_system.h>

#include <cmath>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  SemiDiscreteSystem::SemiDiscreteSystem(
    const Matrix                   &mass,
    const Matrix                   &invertible_mass,
    const BulkOperator             &bulk,
    ContactOperator                &contact,
    const IndexSet                 &massless,
    const IndexSet                 &clamped,
    const IndexSet                 &multipliers,
    Load                            load,
    const NewtonSolver::Parameters &newton_parameters,
    const DirectSolver::Parameters &solver_parameters)
    : bulk(bulk)
    , contact(contact)
    , mass(mass)
    , invertible_mass(invertible_mass)
    , massless(massless)
    , clamped(clamped)
    , multipliers(multipliers)
    , clamped_list(clamped.begin(), clamped.end())
    , load(std::move(load))
    , newton(newton_parameters)
    , linear_solver(solver_parameters)
    , work(contact.row_scaling())
    , constant_part(contact.row_scaling())
    , force(contact.row_scaling())
  {}



  void
  SemiDiscreteSystem::set_clamped_to_zero(Vector &vector) const
  {
    for (const auto i : clamped)
      vector(i) = 0.;
    vector.compress(VectorOperation::insert);
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
    const DirectSolver::Key key{1., -1., 0., 0};
    linear_solver.solve(
      key,
      [&](Matrix &matrix) {
        matrix.copy_from(invertible_mass);
        matrix.clear_rows(clamped_list, 1.);
        // Multipliers have no mass; give them an equation.
        for (const auto i : multipliers)
          matrix.set(i, i, 1.);
        matrix.compress(VectorOperation::insert);
      },
      right_hand_side,
      acceleration);
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

    contact.force_at(state.solution, state.contact_force);
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
    if (!stage.bulk_discrete_derivative && stage.bulk_weight_old != 0.)
      {
        bulk.force(old_state.solution, force);
        constant_part.add(stage.bulk_weight_old, force);
      }
    if (stage.contact_weight_old != 0.)
      constant_part.add(stage.contact_weight_old, old_state.contact_force);
    constant_part.add(-1., stage.load);

    // The forces that nearly cancel in a residual are what "small" is measured
    // against: inertia, bulk and what is constant. The inertia term is a small
    // difference of large numbers when the step is short; their round-off
    // remains, whatever Newton's method does.
    work = solution;
    work -= stage.inertia_origin;
    mass.vmult(force, work);
    double force_scale = stage.inertia * force.l2_norm();
    bulk.force(solution, work);
    force_scale += work.l2_norm() + constant_part.l2_norm();
    mass.vmult(work, stage.inertia_origin);
    const double round_off = 4. * std::numeric_limits<double>::epsilon() *
      stage.inertia * work.l2_norm();

    const auto residual = [&](const Vector &point, Vector &result) {
      work = point;
      work -= stage.inertia_origin;
      mass.vmult(result, work);
      result *= stage.inertia;
      if (stage.bulk_discrete_derivative)
        {
          bulk.discrete_derivative(old_state.solution, point, force);
          result += force;
        }
      else
        {
          bulk.force(point, force);
          result.add(stage.bulk_weight_new, force);
        }
      result += constant_part;
      contact.complete_residual(point, result);
      set_clamped_to_zero(result);
    };

    const double bulk_weight =
      stage.bulk_discrete_derivative ? .5 : stage.bulk_weight_new;
    const auto solve = [&](const Vector &right_hand_side, Vector &update) {
      std::optional<DirectSolver::Key> key;
      const auto                       signature = contact.tangent_signature();
      if (bulk.is_linear() && signature)
        key = DirectSolver::Key{stage.inertia,
                                bulk_weight,
                                stage.contact_weight_new,
                                *signature};
      linear_solver.solve(
        key,
        [&](Matrix &tangent) {
          tangent.copy_from(mass);
          tangent *= stage.inertia;
          bulk.add_tangent(bulk_weight, solution, tangent);
          contact.complete_tangent(tangent);
          tangent.clear_rows(clamped_list, 1.);
        },
        right_hand_side,
        update);
    };

    const auto norm = [&](const Vector &result) {
      work = result;
      work.scale(contact.row_scaling());
      return work.l2_norm();
    };

    const auto active_set = [&]() { return contact.active_set_description(); };

    contact.begin_stage(old_state.solution,
                        old_state.contact_force,
                        stage.contact_weight_new);
    const std::vector<NewtonSolver::Iteration> &history =
      newton.solve({residual, solve, norm, active_set, force_scale, round_off},
                   solution);
    contact_force = contact.contact_force();
    if (newton_observer)
      newton_observer(history);
    return history.size() - 1;
  }



  void
  SemiDiscreteSystem::reconstruct_massless(const State &old_state,
                                           const double time_step,
                                           State       &new_state) const
  {
    for (const auto i : massless)
      {
        const double velocity =
          (new_state.solution(i) - old_state.solution(i)) / time_step;
        new_state.velocity(i) = velocity;
        new_state.acceleration(i) =
          (velocity - old_state.velocity(i)) / time_step;
      }
    for (const auto i : multipliers)
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
