// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_quasi_newton_h
#define ricochet_time_integration_quasi_newton_h

#include <solvers/force_mixing.h>
#include <solvers/newton.h>
#include <solvers/tangent_region.h>
#include <time_integration/stage_problem.h>

#include <vector>

namespace Ricochet
{
  /**
   * The nonlinear system of one stage of a nonlinear body: contact as it is, the body
   * by a tangent T of another state. With the residual R = B(x) + C(x) of body and
   * contact, each iterate solves
   *
   *     T (x_new - x) + C(x_new) - C(x) = -s
   *
   * for a step s of the force, which is a CondensedStage: Newton's method for the
   * coefficients of contact alone. Plain steps are s = R; ForceMixing makes better ones,
   * and a TangentRegion, where the body's tangent is far from T. Whatever contact does, the
   * iterate depends on the force with the norm of T^{-1} at most (C is monotone but for
   * friction), so that only the body's tangents have to be near T. There is one solution
   * with T an iteration.
   */
  class QuasiNewton
  {
  public:
    explicit QuasiNewton(const NewtonSolver::Parameters &parameters)
      : parameters(parameters)
    {}

    /// Not where a new tangent is asked for in each iteration.
    bool
    is_allowed() const
    {
      return parameters.reuse_tangent_below > 0.;
    }

    /**
     * Solve @p problem, from @p solution to @p solution, to the tolerance of Newton's
     * method; the first iterate should be where T was made, as that is.
     *
     * @param condensed_newton for the condensed stages.
     * @param kept where T was made.
     * @return whether it is solved; if it converges slowly or not at all, it gives up,
     * and the solution is not finite or nearer than it was.
     * @throws NewtonFailure when a condensed stage cannot be solved.
     */
    bool
    solve(StageProblem                     &problem,
          const NewtonSolver::Problem      &newton_problem,
          NewtonSolver                     &condensed_newton,
          const StageProblem::TangentPoint &kept,
          Vector                           &solution);

    /// One entry per residual of the last solve(), as NewtonSolver has it.
    const std::vector<NewtonSolver::Iteration> &
    iterations() const
    {
      return history;
    }

  private:
    /// Whether to look for the region where the tangent has changed, anew.
    bool
    region_is_worth_while() const;

    const NewtonSolver::Parameters       parameters;
    std::vector<NewtonSolver::Iteration> history;
    // Steps are few thousand times shorter at the end than at the beginning: all of a
    // stage are remembered, but for very slow ones.
    ForceMixing   mixing{40};
    TangentRegion region;
    Vector        residual, step;
  };
} // namespace Ricochet

#endif
