// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <base/stopwatch.h>
#include <time_integration/stage_problem.h>

#include <cmath>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  StageProblem::StageProblem(const Parts  &parts,
                             const Stage  &stage,
                             const State  &old_state,
                             const Vector &solution,
                             const Vector &safe_guess)
    : parts(parts)
    , stage(stage)
    , old_solution(old_state.solution)
    , solution(solution)
    , safe_guess(safe_guess)
  {
    // Constant terms of the iteration: old forces and load.
    Vector &constant_part = parts.constant_part;
    constant_part         = 0.;
    if (!stage.bulk_step_force && stage.bulk_weight_old != 0.)
      {
        parts.bulk.force(old_state.solution, parts.force);
        constant_part.add(stage.bulk_weight_old, parts.force);
        if (parts.bulk.is_viscous())
          constant_part.add(stage.bulk_weight_old, old_state.viscous_force);
        if (parts.follower)
          {
            parts.follower->force_at(old_state.solution,
                                     old_state.time,
                                     parts.force);
            constant_part.add(-stage.bulk_weight_old, parts.force);
          }
      }
    if (stage.contact_weight_old != 0.)
      constant_part.add(stage.contact_weight_old, old_state.contact_force);
    constant_part.add(-1., stage.load);
    constant_scale = l2_norm(constant_part);
  }

  double
  StageProblem::round_off()
  {
    // The scale of a small residual is that of the forces that nearly cancel:
    // inertia, bulk, contact and constant terms. Inertia and bulk forces are
    // small differences of large numbers when the step is short or the body is
    // far from its initial position, and so is a small gap; Newton's method
    // cannot reduce their round-off.
    if (!bulk_round_off)
      {
        parts.mass.vmult(parts.work, stage.inertia_origin);
        bulk_round_off = 4. * std::numeric_limits<double>::epsilon() *
            (stage.inertia * l2_norm(parts.work) +
             parts.bulk.stiffness_scale() *
               displacement_norm(stage.inertia_origin)) +
          parts.bulk.strain_round_off();
      }
    return *bulk_round_off +
      stage.contact_weight_new * parts.contact.round_off();
  }

  NewtonSolver::Problem
  StageProblem::for_newton()
  {
    return {[this](const Vector &point, Vector &result) {
              residual(point, result);
            },
            [this](const Vector &right_hand_side,
                   Vector       &update,
                   const bool    may_reuse,
                   const double  tolerance) {
              solve(right_hand_side, update, may_reuse, tolerance);
            },
            [this](const Vector &result) { return norm(result); },
            [this]() { parts.contact.accept_iterate(); },
            [this]() { return parts.contact.active_set_description(); },
            [this]() { return force_scale; },
            [this]() { return round_off(); },
            &safe_guess};
  }

  CondensedStage
  StageProblem::condensed(const NewtonSolver::Problem &for_newton,
                          const Vector                &residual)
  {
    parts.contact.forget_iterates();
    return {for_newton,
            parts.linear_solver.condensed(tangent(here(), true)),
            parts.contact,
            residual,
            CondensedStage::ContactForces{stage.contact_weight_new,
                                          contact_scale,
                                          parts.n_multipliers == 0
                                            ? nullptr
                                            : &parts.contact.row_scaling()},
            parts.condensed_space};
  }

  void
  StageProblem::condense_at(const TangentPoint &point)
  {
    parts.linear_solver.forget_condensed();
    parts.linear_solver.condensed(tangent(point, true));
  }

  void
  StageProblem::add_bulk_tangent(const TangentPoint &point,
                                 Matrix             &matrix) const
  {
    if (stage.bulk_step_force)
      parts.bulk.add_step_tangent(point.old_solution,
                                  point.solution,
                                  stage.time_step,
                                  matrix);
    else
      {
        parts.bulk.add_tangent(stage.bulk_weight_new, point.solution, matrix);
        if (parts.bulk.is_viscous())
          parts.bulk.add_viscous_tangent(stage.bulk_weight_new,
                                         stage.rate_origin,
                                         point.solution,
                                         stage.rate_time,
                                         matrix);
      }
  }

  void
  StageProblem::forget_tangents()
  {
    parts.linear_solver.begin_stage();
    factored_active_set.reset();
  }

  void
  StageProblem::residual(const Vector &point, Vector &result)
  {
    const Stopwatch stopwatch(parts.residual_seconds);
    entries(parts.work) =
      stage.inertia * (entries(point) - entries(stage.inertia_origin));
    parts.mass.vmult(result, parts.work);
    force_scale = constant_scale + l2_norm(result);
    if (stage.bulk_step_force)
      {
        parts.bulk.step_force(old_solution,
                              point,
                              stage.time_step,
                              parts.force);
        force_scale += l2_norm(parts.force);
        entries(result) += entries(parts.force) + entries(parts.constant_part);
        if (parts.follower)
          {
            parts.follower->step_force(old_solution,
                                       point,
                                       stage.end_time - stage.time_step,
                                       stage.end_time,
                                       parts.force);
            force_scale += l2_norm(parts.force);
            result -= parts.force;
          }
      }
    else
      {
        parts.bulk.force(point, parts.force);
        force_scale += l2_norm(parts.force);
        entries(result) += stage.bulk_weight_new * entries(parts.force) +
          entries(parts.constant_part);
        if (parts.bulk.is_viscous())
          {
            parts.bulk.viscous_force(stage.rate_origin,
                                     point,
                                     stage.rate_time,
                                     parts.force);
            force_scale += l2_norm(parts.force);
            result.add(stage.bulk_weight_new, parts.force);
          }
        if (parts.follower)
          {
            parts.follower->force_at(point, stage.end_time, parts.force);
            force_scale += l2_norm(parts.force);
            result.add(-stage.bulk_weight_new, parts.force);
          }
      }
    parts.contact.add_residual(point, result);
    contact_scale =
      stage.contact_weight_new * l2_norm(parts.contact.contact_force());
    force_scale += contact_scale;
    for (const auto i : parts.clamped)
      parts.reaction(i) = result(i);
    parts.reaction.compress(VectorOperation::insert);
    set_clamped_to_zero(parts.clamped, result);
  }

  Tangent
  StageProblem::tangent(const TangentPoint &point, const bool condenses)
  {
    const double bulk_weight =
      stage.bulk_step_force ? .5 : stage.bulk_weight_new;
    Tangent tangent;
    if (parts.bulk.is_linear())
      {
        tangent.body =
          BodyKey{stage.inertia, bulk_weight, stage.contact_weight_new};
        tangent.contact    = parts.contact.active_set().tangent_key;
        tangent.body_terms = stage.bulk_step_force
          ? parts.bulk.step_tangent_terms(stage.time_step)
          : parts.bulk.tangent_terms(bulk_weight);
        if (!stage.bulk_step_force && parts.bulk.is_viscous())
          for (const MatrixTerm &term :
               parts.bulk.viscous_tangent_terms(bulk_weight, stage.rate_time))
            tangent.body_terms.push_back(term);
        AssertThrow(!tangent.body_terms.empty(), ExcInternalError());
        tangent.body_terms.push_back({stage.inertia, &parts.mass});
      }
    const auto assemble_body = [this, point](Matrix &matrix) {
      const auto &pattern = parts.pattern();
      if (matrix.n_nonzero_elements() == pattern.n_nonzero_elements())
        matrix = 0.;
      else
        matrix.reinit(pattern);
      parts.mass.add_to(stage.inertia, matrix);
      add_bulk_tangent(point, matrix);
      if (parts.follower && stage.bulk_step_force)
        parts.follower->subtract_step_tangent(1.,
                                              point.old_solution,
                                              point.solution,
                                              point.begin,
                                              point.end,
                                              matrix);
      else if (parts.follower)
        parts.follower->subtract_tangent_at(stage.bulk_weight_new,
                                            point.solution,
                                            point.end,
                                            matrix);
    };
    tangent.row_scaling = &parts.contact.row_scaling();
    const Couplings *couplings =
      condenses ? nullptr : parts.contact.couplings();
    if (couplings)
      {
        parts.united_pattern.update(parts.pattern(), *couplings);
        tangent.pattern = couplings->version;
      }
    tangent.assemble_body =
      [this, assemble_body, is_united = couplings != nullptr](Matrix &matrix) {
        const Stopwatch stopwatch(parts.tangent_seconds);
        if (!is_united)
          return assemble_body(matrix);
        assemble_body(parts.body_matrix);
        parts.united_pattern.embed(parts.body_matrix, matrix);
      };
    const auto complete = [this](void (ContactOperator::*add)(Matrix &) const) {
      return [this, add](Matrix &matrix) {
        const Stopwatch stopwatch(parts.tangent_seconds);
        (parts.contact.*add)(matrix);
        eliminate(parts.constraints, matrix);
      };
    };
    tangent.add_contact      = complete(&ContactOperator::add_tangent);
    tangent.add_open_contact = complete(&ContactOperator::add_open_tangent);
    tangent.differentiate_contact =
      [this](std::vector<FunctionalRow> &with_values,
             std::vector<FunctionalRow> &with_residual) {
        const Stopwatch stopwatch(parts.tangent_seconds);
        parts.contact.differentiate_forces(with_values, with_residual);
      };
    return tangent;
  }

  void
  StageProblem::solve(const Vector &right_hand_side,
                      Vector       &update,
                      const bool    may_reuse,
                      const double  tolerance)
  {
    ++report.newton_iterations;
    ++report.outer_iterations;
    const Tangent       current    = tangent(here());
    const bool          has_name   = current.body && current.contact;
    const std::uint64_t active_set = parts.contact.active_set().hash;
    const bool          reuse =
      may_reuse && !has_name && factored_active_set == active_set;
    if (!has_name)
      factored_active_set = active_set;
    if (!has_name && !reuse)
      ++report.n_tangents;
    report.strategies |= parts.linear_solver.solve(current,
                                                   right_hand_side,
                                                   update,
                                                   reuse,
                                                   tolerance);
    // Iterative solvers leave errors within their tolerance in clamped unknowns,
    // which no residual shows.
    set_clamped_to_zero(parts.clamped, update);
  }

  double
  StageProblem::norm(const Vector &result)
  {
    return norm_of_forces(result) +
      stage.contact_weight_new * parts.contact.linearisation_error();
  }

  double
  StageProblem::norm_of_forces(const Vector &result)
  {
    if (parts.n_multipliers == 0)
      return l2_norm(result);
    entries(parts.work) =
      entries(result).cwiseProduct(entries(parts.contact.row_scaling()));
    return l2_norm(parts.work);
  }

  void
  StageProblem::hold_clamped(Vector &iterate) const
  {
    for (const auto i : parts.clamped)
      iterate(i) = safe_guess(i);
  }

  void
  StageProblem::rows_to_forces(Vector &result) const
  {
    if (parts.n_multipliers > 0)
      entries(result).array() *= entries(parts.contact.row_scaling()).array();
  }

  void
  StageProblem::forces_to_rows(Vector &forces) const
  {
    if (parts.n_multipliers > 0)
      entries(forces).array() /= entries(parts.contact.row_scaling()).array();
  }

  double
  StageProblem::displacement_norm(const Vector &vector) const
  {
    return l2_norm(vector, vector.locally_owned_size() - parts.n_multipliers);
  }

  void
  set_clamped_to_zero(const IndexSet &clamped, Vector &vector)
  {
    for (const auto i : clamped)
      vector(i) = 0. * vector(i);
    vector.compress(VectorOperation::insert);
  }
} // namespace Ricochet
