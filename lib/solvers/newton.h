// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_newton_h
#define ricochet_solvers_newton_h

#include <base/types.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Semi-smooth Newton iteration (for instance Renard, CMAME 256, 2013).
   *
   * The solver returns a converged solution or throws an exception.
   */
  class NewtonSolver
  {
  public:
    struct Parameters
    {
      /// Residual over the norm of the forces that it consists of.
      double       tolerance         = 1e-12;
      unsigned int max_iterations    = 30;
      unsigned int line_search_after = 10;
      /// A tangent is used again while the residual falls by this factor.
      double reuse_tangent_below = .03;

      void
      add_parameters(dealii::ParameterHandler &parameters);
    };

    /// The equations, as functions of the solution.
    struct Problem
    {
      /// Write the residual at @p solution; keep the data that the tangent at
      /// this point needs.
      std::function<void(const Vector &solution, Vector &residual)> residual;

      /// Solve tangent * @p update = @p residual at the point of the last
      /// residual(), iterative solvers to a relative @p tolerance; if
      /// @p may_reuse, an older tangent of this problem may be used.
      std::function<void(const Vector &residual,
                         Vector       &update,
                         const bool    may_reuse,
                         const double  tolerance)>
        solve;

      /// Norm of the residual with all its rows as forces (N).
      std::function<double(const Vector &residual)> norm;

      /// Called when the point of the last residual() becomes the next iterate;
      /// trial points of a line search are not accepted.
      std::function<void()> accept;

      /// Number of active contact points at the last residual(), for the table.
      std::function<std::string()> active_set;

      /// Magnitude of the forces that make up the last residual() (N).
      std::function<double()> force_scale;

      /// Residual (N) that round-off alone can cause, at the last residual().
      std::function<double()> round_off;

      /// Initial iterate if the residual at the guess is not finite; null for
      /// none.
      const Vector *safe_guess = nullptr;

      /// force_scale, or 1 if there are no forces.
      double
      scale() const
      {
        const double size = force_scale();
        // A NaN must not pass as zero.
        return size == 0. ? 1. : size;
      }

      /// Whether the last residual(), whose norm over scale() is @p norm, is so small
      /// that its point is a solution.
      bool
      is_small(const double norm, const double tolerance) const
      {
        return norm <= tolerance || norm <= tolerance + round_off() / scale();
      }
    };

    /// Record of an iteration.
    struct Iteration
    {
      /// Residual over force_scale.
      double      relative_residual;
      double      step_length;
      std::string active_set;
    };

    explicit NewtonSolver(const Parameters &parameters)
      : parameters(parameters)
    {}

    /**
     * Solve @p problem, from @p solution to @p solution. If the residual at the
     * guess is not finite (an element is turned inside out), the safe guess
     * replaces it; a step to such a point is shortened, to 1/1024 at most. The
     * guess is never accepted as it is, unless its residual is exactly zero:
     * there is at least one linear solve.
     *
     * @param line_search_at_once shorten steps that do not reduce the residual from
     * the first one on, not only after some full ones.
     * @return one entry for the guess and each iterate after it: the number of linear
     * solves plus one.
     * @throws NewtonFailure with the table of all iterations in its text: not converged
     * in the allowed number of iterations, no step length that reduces the residual, or
     * not finite; @p solution is the last iterate then, or the best one if that has
     * less than half of its residual. The exceptions of Problem::solve are passed on;
     * @p solution is the last iterate then.
     */
    const std::vector<Iteration> &
    solve(const Problem &problem,
          Vector        &solution,
          const bool     line_search_at_once = false);

    /// The iterations of the last solve(), also if it failed.
    const std::vector<Iteration> &
    iterations() const
    {
      return history;
    }

    /// Index in iterations() of the last solve()'s result: the last one, unless it
    /// failed and returned to a better one.
    unsigned int
    end_iteration() const
    {
      return end;
    }

    /// Whether the last solve() failed at the limit of iterations while its last step
    /// still reduced the residual by a tenth at least.
    bool
    was_on_its_way() const
    {
      return history.size() > parameters.max_iterations &&
        end + 1 == history.size() &&
        history.back().relative_residual <
        .9 * history[history.size() - 2].relative_residual;
    }

    /// Whether @p solution solves @p problem, to the same tolerance; if so, it is
    /// accepted as the next iterate.
    bool
    solves(const Problem &problem, const Vector &solution);

  private:
    /// The residual at @p point over Problem::scale().
    double
    evaluate(const Problem &problem, const Vector &point);

    [[noreturn]] void
    fail(const std::string &reason) const;

    const Parameters       parameters;
    std::vector<Iteration> history;
    unsigned int           end = 0;
    Vector                 residual, update, trial, best;
  };
} // namespace Ricochet

#endif
