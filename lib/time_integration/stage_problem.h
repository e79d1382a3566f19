// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_stage_problem_h
#define ricochet_time_integration_stage_problem_h

#include <contact/contact_operator.h>
#include <discretization/bulk_operator.h>
#include <discretization/follower_load.h>
#include <solvers/body_matrix.h>
#include <solvers/linear_solver.h>
#include <solvers/newton.h>
#include <solvers/solver_report.h>
#include <time_integration/condensed_stage.h>
#include <time_integration/stage.h>
#include <time_integration/state.h>

#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * The nonlinear system of one stage in the form for Newton's method: residual,
   * tangent, norms, and the scale of a small residual.
   */
  class StageProblem
  {
  public:
    /// Constant data of all stages, which must outlive the problem.
    struct Parts
    {
      const BodyMatrix   &mass;
      const BulkOperator &bulk;
      ContactOperator    &contact;
      LinearSolver       &linear_solver;
      /// Prescribed displacements, and those of this rank.
      const Constraints      &constraints;
      const dealii::IndexSet &clamped;
      /// Number of multipliers of this rank, which are the last of its
      /// unknowns.
      unsigned int n_multipliers = 0;
      /// Sparsity pattern of the tangents.
      const std::function<const dealii::TrilinosWrappers::SparsityPattern &()>
        &pattern;
      /// Timings of all stages (s).
      double &residual_seconds, &tangent_seconds;
      /// Extended pattern, where contact couples unknowns that the body does
      /// not.
      UnitedPattern &united_pattern;
      // Work space, so that nothing is allocated in a time step.
      Vector                    &work, &force, &constant_part;
      CondensedStage::WorkSpace &condensed_space;
      /// Residual of the equations in clamped unknowns (N), an output.
      Vector &reaction;
      Matrix &body_matrix;
      /// Load that depends on the displacement; null for none.
      const FollowerLoad *follower = nullptr;
    };

    /// @param old_state the beginning of the stage.
    /// @param solution the iterate: residuals are evaluated at other points,
    /// too, but tangents at this vector only.
    /// @param safe_guess initial iterate if the residual at @p solution is not
    /// finite.
    StageProblem(const Parts  &parts,
                 const Stage  &stage,
                 const State  &old_state,
                 const Vector &solution,
                 const Vector &safe_guess);

    /// The problem for NewtonSolver::solve().
    NewtonSolver::Problem
    for_newton();

    /// Drop the tangents of other stages, so that a resumed run does the same.
    void
    forget_tangents();

    /// The same system condensed to contact, for the guess of the last evaluation of
    /// the residual, @p residual. @pre Parts::linear_solver condenses.
    CondensedStage
    condensed(const NewtonSolver::Problem &for_newton, const Vector &residual);

    /// A pair of states for the tangent of a step.
    struct TangentPoint
    {
      const Vector &old_solution, &solution;
      /// Beginning and end of the step (s).
      double begin, end;
    };

    /// Condense with the tangent of a stage like this one at another @p point.
    /// @throws NewtonFailure
    void
    condense_at(const TangentPoint &point);

    /// Reset the clamped unknowns of an iterate to their prescribed values, from which
    /// solvers may deviate by their tolerance, which no residual shows.
    void
    hold_clamped(Vector &iterate) const;

    /// Scale the rows of a residual to forces, whatever the units of the
    /// multipliers' equations; and the inverse.
    void
    rows_to_forces(Vector &result) const;

    void
    forces_to_rows(Vector &forces) const;

    /// Report on the solution of the stage so far, failed attempts included.
    SolverReport report;

  private:
    void
    residual(const Vector &point, Vector &result);

    void
    solve(const Vector &right_hand_side,
          Vector       &update,
          const bool    may_reuse,
          const double  tolerance);

    /// The tangent point of this stage, at the iterate.
    TangentPoint
    here() const
    {
      return {old_solution,
              solution,
              stage.end_time - stage.time_step,
              stage.end_time};
    }

    /// Add the derivative of the body's forces at a point, see BulkOperator::add_tangent().
    void
    add_bulk_tangent(const TangentPoint &point, Matrix &matrix) const;

    /// @param condenses contact is evaluated by the rows of its Jacobian alone.
    Tangent
    tangent(const TangentPoint &point, const bool condenses = false);

    double
    norm(const Vector &result);

    /// The norm of the residual with rows_to_forces().
    double
    norm_of_forces(const Vector &result);

    /// Residual (N) that round-off alone can cause.
    double
    round_off();

    /// l2 norm of the displacements in a system vector (m): those of multipliers
    /// are pressures.
    double
    displacement_norm(const Vector &vector) const;

    const Parts   parts;
    const Stage  &stage;
    const Vector &old_solution, &solution, &safe_guess;
    double        constant_scale = 0., force_scale = 0., contact_scale = 0.;
    // Computed when first needed.
    std::optional<double> bulk_round_off;
    // The active set of the tangent without a cache key, if there is one.
    std::optional<std::uint64_t> factored_active_set;
  };

  /// Set the @p clamped entries of @p vector to zero. A NaN is kept, since it
  /// may mark an inverted element.
  void
  set_clamped_to_zero(const dealii::IndexSet &clamped, Vector &vector);
} // namespace Ricochet

#endif
