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

    /// Numbers of residuals at which a region with a changed tangent is chosen, and
    /// chosen again; the first iterates are too far from the solution. The region costs
    /// about three iterations, so that it is left out if only few are expected.
    constexpr unsigned int first_look = 4, look_again = 12;
    constexpr double       few_iterations = 6.;
  } // namespace



  bool
  QuasiNewton::region_is_worth_while() const
  {
    const unsigned int n = history.size();
    if (n < first_look || (n - first_look) % look_again != 0)
      return false;
    const double norm = history[n - 1].relative_residual,
                 rate = std::sqrt(norm / history[n - 3].relative_residual);
    return std::pow(rate, few_iterations) * norm > parameters.tolerance;
  }



  bool
  QuasiNewton::solve(StageProblem                     &problem,
                     const NewtonSolver::Problem      &newton_problem,
                     NewtonSolver                     &condensed_newton,
                     const StageProblem::TangentPoint &kept,
                     Vector                           &solution)
  {
    if (residual.size() != solution.size())
      {
        residual.reinit(solution);
        step.reinit(solution);
      }
    history.clear();
    mixing.restart();
    region.forget();
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
        if (region_is_worth_while())
          problem.find_region(residual, kept, region);
        mixing.next(residual, step, [this](std::vector<double> &force) {
          if (region.exists())
            region.complete(force);
        });
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
