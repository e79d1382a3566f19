// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <base/exceptions.h>
#include <solvers/newton.h>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <optional>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  void
  NewtonSolver::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Newton");
    parameters.add_parameter(
      "Tolerance",
      tolerance,
      "Newton's method has converged when the norm of the residual is below "
      "this fraction of the norm of the forces that make it up.",
      Patterns::Double(1e-15, 1e-6));
    parameters.add_parameter("Maximum iterations",
                             max_iterations,
                             "Number of linear solves after which Newton's "
                             "method has failed and the time step is halved.",
                             Patterns::Integer(1, 1000));
    parameters.add_parameter(
      "Line search after",
      line_search_after,
      "Number of full steps before steps are shortened until the residual "
      "falls. Full steps are best for finding the active set; a shortened one "
      "breaks a cycle.",
      Patterns::Integer(0, 1000));
    parameters.add_parameter(
      "Reuse tangent below",
      reuse_tangent_below,
      "With nonlinear materials and contact laws, a tangent is used again "
      "while each iteration makes the residual smaller by this factor; 0 for "
      "a new tangent in each iteration (Newton's method proper).",
      Patterns::Double(0., .9));
    parameters.leave_subsection();
  }



  void
  NewtonSolver::fail(const std::string &reason) const
  {
    std::ostringstream text;
    text << "Newton's method failed: " << reason << "\n"
         << "  iteration   relative residual   step length   active set\n";
    // First and last lines of the table.
    constexpr unsigned int n_first = 4, n_last = 8;
    for (unsigned int k = 0; k < history.size(); ++k)
      if (k == n_first && history.size() > n_first + n_last)
        {
          text << "        ...\n";
          k = history.size() - n_last - 1;
        }
      else
        text << std::setw(11) << k << std::setw(20) << std::scientific
             << std::setprecision(4) << history[k].relative_residual
             << std::setw(14) << std::defaultfloat << history[k].step_length
             << "   " << history[k].active_set << "\n";
    throw NewtonFailure(text.str());
  }



  double
  NewtonSolver::evaluate(const Problem &problem, const Vector &point)
  {
    // Only allocated when the problem changes its size.
    if (residual.size() != point.size())
      {
        residual.reinit(point);
        update.reinit(point);
        trial.reinit(point);
      }
    problem.residual(point, residual);
    return problem.norm(residual) / problem.scale();
  }



  bool
  NewtonSolver::solves(const Problem &problem, const Vector &solution)
  {
    if (!problem.is_small(evaluate(problem, solution), parameters.tolerance))
      return false;
    problem.accept();
    return true;
  }



  const std::vector<NewtonSolver::Iteration> &
  NewtonSolver::solve(const Problem &problem,
                      Vector        &solution,
                      const bool     line_search_at_once)
  {
    const unsigned int n_full_steps =
      line_search_at_once ? 0 : parameters.line_search_after;
    history.clear();
    double norm = evaluate(problem, solution);
    if (!std::isfinite(norm) && problem.safe_guess)
      {
        solution = *problem.safe_guess;
        norm     = evaluate(problem, solution);
      }
    const auto converged = [&]() {
      return history.size() > 1 ? problem.is_small(norm, parameters.tolerance)
                                : norm == 0.;
    };
    problem.accept();
    end = 0;
    history.push_back({norm, 0., problem.active_set()});
    // The best iterate that was left for a worse one. If the last one is not much
    // worse, the iteration may as well go on from there, with a different iterate.
    std::optional<unsigned int> best_iteration;
    const auto                  give_up = [&](const std::string &reason) {
      if (best_iteration &&
          !(.5 * norm <= history[*best_iteration].relative_residual))
        {
          copy_values(best, solution);
          end = *best_iteration;
        }
      fail(reason);
    };
    while (!converged())
      {
        if (!std::isfinite(norm))
          give_up("the state is not finite.");
        if (history.size() > parameters.max_iterations)
          give_up("not converged in " +
                  std::to_string(parameters.max_iterations) + " iterations.");

        // The tangent of the last iteration is good enough while the residual
        // falls fast: factorising it costs much more than an iteration.
        const bool may_reuse = history.size() > 1 &&
          history.size() <= n_full_steps &&
          norm < parameters.reuse_tangent_below *
              history[history.size() - 2].relative_residual;
        // Iterative linear solvers need not be more accurate than the
        // linearisation, whose error falls as the square of the residual
        // (Eisenstat and Walker, SIAM J. Sci. Comput. 17, 1996, choice 2).
        double tolerance = 1e-2;
        if (history.size() > 1)
          {
            const double ratio =
              norm / history[history.size() - 2].relative_residual;
            tolerance = std::clamp(ratio * ratio, 1e-8, 1e-2);
            // The last iteration should neither end just below the tolerance nor
            // continue far below it.
            if (norm * tolerance < 100. * parameters.tolerance)
              tolerance =
                std::clamp(.01 * parameters.tolerance / norm, 1e-8, 1e-2);
          }
        problem.solve(residual, update, may_reuse, tolerance);
        copy_values(solution, trial);
        trial.add(-1., update);
        double     new_norm    = evaluate(problem, trial);
        double     step_length = 1.;
        const auto shorten     = [&]() {
          step_length *= .5;
          copy_values(solution, trial);
          trial.add(-step_length, update);
          new_norm = evaluate(problem, trial);
        };
        while (!std::isfinite(new_norm) && step_length > 1. / 1024.)
          shorten();
        if (history.size() > n_full_steps)
          {
            while (!(new_norm < norm) && step_length > 1. / 64.)
              shorten();
            if (!(new_norm < norm) && std::isfinite(new_norm))
              give_up("no step length makes the residual smaller.");
          }
        if (!(new_norm < norm) &&
            !(best_iteration &&
              history[*best_iteration].relative_residual <= norm))
          {
            best_iteration = history.size() - 1;
            copy_values(solution, best);
          }
        solution.swap(trial);
        norm = new_norm;
        problem.accept();
        end = history.size();
        history.push_back({norm, step_length, problem.active_set()});
      }
    return history;
  }
} // namespace Ricochet
