// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_quasi_newton_h
#define ricochet_time_integration_quasi_newton_h

#include <solvers/force_mixing.h>
#include <solvers/newton.h>
#include <time_integration/stage_problem.h>

#include <vector>

namespace Ricochet
{
  /**
   * The nonlinear system of one stage of a nonlinear body: contact exactly, the body
   * by a frozen tangent T of another state. With the residual R = B(x) + C(x) of body
   * and contact, each iterate solves
   *
   *     T (x_new - x) + C(x_new) - C(x) = -s
   *
   * for a step s of the force, which is a CondensedStage: Newton's method for the
   * coefficients of contact alone. Plain steps are s = R; ForceMixing (Anderson
   * acceleration) makes better ones. Whatever the contact forces, the iterate depends on the
   * force with the norm of T^{-1} at most (C is monotone except for friction), so that
   * only the body's tangents have to be near T. There is one solution with T an
   * iteration.
   */
  class QuasiNewton
  {
  public:
    explicit QuasiNewton(const NewtonSolver::Parameters &parameters)
      : parameters(parameters)
    {}

    /// Whether tangents may be reused at all; not if a new one is required in
    /// each iteration.
    bool
    is_allowed() const
    {
      return parameters.reuse_tangent_below > 0.;
    }

    /**
     * Solve @p problem, from @p solution to @p solution, to the tolerance of Newton's
     * method; the first iterate should be the state for which T was assembled.
     *
     * @param condensed_newton for the condensed stages.
     * @return whether it has converged; it stops if it converges slowly or not at all,
     * and @p solution is then not finite, or nearer to the solution than the guess.
     * @throws NewtonFailure when a condensed stage cannot be solved.
     */
    bool
    solve(StageProblem                &problem,
          const NewtonSolver::Problem &newton_problem,
          NewtonSolver                &condensed_newton,
          Vector                      &solution);

    /// One entry per residual of the last solve(), as in NewtonSolver.
    const std::vector<NewtonSolver::Iteration> &
    iterations() const
    {
      return history;
    }

  private:
    const NewtonSolver::Parameters       parameters;
    std::vector<NewtonSolver::Iteration> history;
    // History of all iterates of a stage, except for very slow ones: their steps
    // become some thousand times shorter, and the first ones remain relevant.
    ForceMixing mixing{40};
    Vector      residual, step;
  };
} // namespace Ricochet

#endif
