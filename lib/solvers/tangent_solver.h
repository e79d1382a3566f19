// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_tangent_solver_h
#define ricochet_solvers_tangent_solver_h

#include <solvers/solver_report.h>
#include <solvers/tangent.h>

namespace Ricochet
{
  /// Interface of solvers for the tangents of Newton's method; LinearSolver
  /// chooses.
  class TangentSolver
  {
  public:
    /// Costs so far.
    struct Costs
    {
      /// Factorisations, or set-ups of multigrid.
      unsigned int n_factorisations = 0;
      /// Time spent in them and in forward solves of contact rows (s).
      double factorising = 0.;
      /// Solutions with factorisations, except the forward solves of contact rows.
      unsigned int n_substitutions = 0;
      /// Time spent in solving with them (s).
      double substituting = 0.;
    };

    virtual ~TangentSolver() = default;

    /// The strategy of solve() in a SolverReport.
    virtual SolverReport::Strategy
    strategy() const = 0;

    /// See LinearSolver::solve(). @return whether it succeeded; otherwise
    /// another solver is needed.
    virtual bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) = 0;

    /// See LinearSolver::begin_stage().
    virtual void
    begin_stage()
    {
      stage_begins = true;
    }

    const Costs &
    costs() const
    {
      return spent;
    }

  protected:
    bool  stage_begins = true;
    Costs spent;
  };

  /// Overwrite @p matrix with the whole @p tangent.
  inline void
  assemble(const Tangent &tangent, Matrix &matrix)
  {
    tangent.assemble_body(matrix);
    if (tangent.add_contact)
      tangent.add_contact(matrix);
  }
} // namespace Ricochet

#endif
