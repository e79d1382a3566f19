// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_solver_report_h
#define ricochet_solvers_solver_report_h

#include <string>
#include <utility>
#include <vector>

namespace Ricochet
{
  /// How the nonlinear systems of a step were solved, so that a run with fallbacks
  /// shows them.
  struct SolverReport
  {
    /// Strategies and fallbacks. Their numbers are powers of two, so that a sum has
    /// several of them: the column `solver` of energy.csv.
    enum Strategy : unsigned int
    {
      /// Factorisation of the whole tangent.
      direct = 1,
      /// Multigrid for linear systems of the whole tangent.
      multigrid = 2,
      /// Stage of a linear body, condensed to contact.
      condensed = 4,
      /// Stage condensed to contact, with a frozen tangent of the body.
      frozen_tangent = 8,
      /// Fallback: the tangent of earlier steps did not converge, and was renewed
      /// within the step.
      tangent_renewed = 16,
      /// Fallback: the iterations of a condensed stage were restarted where they
      /// stagnated.
      condensed_restarted = 32,
      /// Fallback: the condensed stage was not solved, and the whole system replaced
      /// it.
      condensed_failed = 64,
      /// Fallback: an iterative linear solver did not converge, and the whole tangent was
      /// factored.
      iterative_failed = 128,
      /// Fallback: Newton's method failed, and the stage was restarted from the last
      /// state.
      stage_repeated = 256,
      /// Fallback: Newton's method found no equilibrium from the last one, and
      /// pseudo-transient continuation did, see StaticEquilibrium.
      pseudo_transient = 512
    };

    /// Sum of #Strategy.
    unsigned int strategies = 0;
    /// Iterations of Newton's method: the inner ones of a linear body that is condensed
    /// to contact, otherwise the outer ones.
    unsigned int newton_iterations = 0;
    /// Iterations with the residual of the whole system.
    unsigned int outer_iterations = 0;
    /// Iterations of condensed stages.
    unsigned int inner_iterations = 0;
    /// Tangents at states of this step. Tangents of earlier steps that are used again,
    /// and those from a linear body's constant matrices, do not count, so that the
    /// number is the same in a resumed run.
    unsigned int n_tangents = 0;

    void
    add(const Strategy strategy)
    {
      strategies |= strategy;
    }

    /// Unite the strategies and sum the counts.
    SolverReport &
    operator+=(const SolverReport &other);

    /// Each strategy's number with a short name.
    static const std::vector<std::pair<unsigned int, std::string>> &
    names();

    /// Whether @p strategies include a fallback.
    static bool
    has_fallback(const unsigned int strategies)
    {
      return strategies >= tangent_renewed;
    }

    /// Abbreviation of the strategies that are no fallbacks, with an exclamation mark
    /// if there is a fallback: "frozen tangent+direct!".
    static std::string
    short_text(const unsigned int strategies);

    /// Number of the @p steps (their strategies) with each strategy, in words; empty
    /// if there are none.
    static std::string
    summary(const std::vector<unsigned int> &steps);
  };
} // namespace Ricochet

#endif
