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
#include <solvers/tangent_region.h>
#include <time_integration/condensed_stage.h>
#include <time_integration/stage.h>

#include <optional>
#include <vector>

namespace Ricochet
{
  /**
 * The nonlinear system of one stage, as Newton's method sees it: residual,
 * tangent, norms, and what "small" is measured against.
 */
  class StageProblem
  {
  public:
    /// What stays the same for all stages. All of it must outlive the problem.
    struct Parts
    {
      const BodyMatrix   &mass;
      const BulkOperator &bulk;
      ContactOperator    &contact;
      LinearSolver       &linear_solver;
      /// Prescribed displacements, and which of them are of this rank.
      const Constraints      &constraints;
      const dealii::IndexSet &clamped;
      /// Of this rank; they are the last of its unknowns.
      unsigned int n_multipliers = 0;
      /// Of the tangents.
      const std::function<const dealii::TrilinosWrappers::SparsityPattern &()>
        &pattern;
      /// s, summed up.
      double &residual_seconds, &tangent_seconds;
      /// Where contact couples what the body does not.
      UnitedPattern &united_pattern;
      // Work space, so that nothing is allocated in a time step.
      Vector                    &work, &force, &constant_part;
      CondensedStage::WorkSpace &condensed_space;
      /// Gets what the equations leave over in clamped unknowns (N).
      Vector &reaction;
      Matrix &body_matrix;
      /// Null for none.
      const FollowerLoad *follower = nullptr;
    };

    /// @param solution the iterate: residuals are looked at elsewhere, too, but
    /// tangents are those of this vector.
    /// @param safe_guess where to begin if the residual at @p solution is not
    /// finite.
    StageProblem(const Parts  &parts,
                 const Stage  &stage,
                 const Vector &old_solution,
                 const Vector &old_contact_force,
                 const Vector &solution,
                 const Vector &safe_guess);

    /// What NewtonSolver::solve() takes.
    NewtonSolver::Problem
    for_newton();

    /// Begin anew: no tangent of another stage may be used, so that a resumed run
    /// does the same.
    void
    forget_tangents();

    /// The same system condensed to contact, for the guess at which the residual was
    /// looked at last: @p residual. @pre Parts::linear_solver condenses.
    CondensedStage
    condensed(const NewtonSolver::Problem &for_newton, const Vector &residual);

    /// Where a tangent is that of a step.
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

    /// Find the region where the tangent at the iterate, which has left the @p residual
    /// (N), differs from that at the @p kept point.
    /// @pre condense_at() with that point.
    void
    find_region(const Vector       &residual,
                const TangentPoint &kept,
                TangentRegion      &region);

    /// Give the clamped unknowns of an iterate their prescribed values again, from which
    /// solvers may leave by their tolerance, and which no residual would show.
    void
    hold_clamped(Vector &iterate) const;

    /// Make the rows of a residual those of forces, whatever the equations of
    /// multipliers are; and the other way round.
    void
    rows_to_forces(Vector &result) const;

    void
    forces_to_rows(Vector &forces) const;

    /// How the stage was solved so far, attempts that failed included.
    SolverReport report;

  private:
    void
    residual(const Vector &point, Vector &result);

    void
    solve(const Vector &right_hand_side,
          Vector       &update,
          const bool    may_reuse,
          const double  tolerance);

    /// That of this stage, at the iterate.
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
    add_bulk_tangent(const TangentPoint &point,
                     Matrix             &matrix,
                     const UnknownList  *near = nullptr) const;

    /// @param condenses contact is looked at by its functionals alone.
    Tangent
    tangent(const TangentPoint &point, const bool condenses = false);

    double
    norm(const Vector &result);

    /// That of rows_to_forces().
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
    // Known when asked for.
    std::optional<double> bulk_round_off;
    // Which points are active in the tangent without a name, if there is one.
    std::optional<std::uint64_t> factored_active_set;
  };

  /// Set the @p clamped entries of @p vector to zero. What is not a number stays
  /// so: it may be the mark of an element that is turned inside out.
  void
  set_clamped_to_zero(const dealii::IndexSet &clamped, Vector &vector);
} // namespace Ricochet

#endif
