// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/quasi_newton.h>

#include <cmath>

namespace Ricochet
{
  namespace
  {
    /// Number of iterations within which the residual has to fall by a factor;
    /// otherwise Newton's method is faster.
    constexpr unsigned int patience        = 12;
    constexpr double       required_factor = .1;
    constexpr unsigned int max_iterations  = 100;

    /// Tolerance of contact in the condensed system, relative to the residual of an
    /// iterate. Values ten and a hundred times as large take as many iterations; with
    /// zero, round-off that stiff laws amplify may exceed the tolerance while the
    /// residual is large.
    constexpr double rest_of_contact = 1e-3;
  } // namespace



  bool
  QuasiNewton::solve(StageProblem                &problem,
                     const NewtonSolver::Problem &newton_problem,
                     NewtonSolver                &condensed_newton,
                     Vector                      &solution)
  {
    if (residual.size() != solution.size())
      {
        residual.reinit(solution);
        step.reinit(solution);
      }
    history.clear();
    mixing.restart();
    while (true)
      {
        newton_problem.residual(solution, residual);
        const double norm =
          newton_problem.norm(residual) / newton_problem.scale();
        newton_problem.accept();
        history.push_back(
          {norm, history.empty() ? 0. : 1., newton_problem.active_set()});
        const unsigned int n = history.size();
        if (!std::isfinite(norm))
          return false;
        if (n > 1 && newton_problem.is_small(norm, parameters.tolerance))
          return true;
        if (n > max_iterations ||
            (n > patience &&
             !(norm <
               required_factor * history[n - 1 - patience].relative_residual)))
          return false;

        // Residuals are compared as forces, whatever the units of the multipliers'
        // equations.
        problem.rows_to_forces(residual);
        mixing.next(residual, step);
        entries(step) *= -1.;
        problem.forces_to_rows(step);
        ++problem.report.newton_iterations;
        ++problem.report.outer_iterations;
        CondensedStage condensed = problem.condensed(newton_problem, step);
        condensed.solve(condensed_newton,
                        solution,
                        problem.report,
                        rest_of_contact * norm * newton_problem.scale());
        problem.hold_clamped(solution);
      }
  }
} // namespace Ricochet
