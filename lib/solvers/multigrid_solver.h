// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_multigrid_solver_h
#define ricochet_solvers_multigrid_solver_h

#include <solvers/coarse_space.h>
#include <solvers/iteration_budget.h>
#include <solvers/multigrid.h>
#include <solvers/tangent_operator.h>
#include <solvers/tangent_solver.h>

#include <cstdint>
#include <memory>
#include <optional>

namespace Ricochet
{
  /// Multigrid for each system, for bodies in 3D whose factorisation takes too
  /// long or too much memory.
  class MultigridSolver : public TangentSolver
  {
  public:
    /// @param clamped unknowns of this rank.
    MultigridSolver(const ContactStructure &contact,
                    const bool              linear_body,
                    const dealii::IndexSet &clamped,
                    CoarseSpace             coarse_space);

    SolverReport::Strategy
    strategy() const override
    {
      return SolverReport::multigrid;
    }

    /// @return true.
    /// @return false when it does not converge.
    bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) override;

  private:
    /// Cache key of a tangent.
    struct Name
    {
      std::optional<BodyKey>       body;
      std::optional<std::uint64_t> contact;

      bool
      operator==(const Name &other) const
      {
        return body && contact && body == other.body &&
          contact == other.contact;
      }
    };

    /// Update the tangent in the form for multigrid.
    void
    update_tangent(const Tangent          &tangent,
                   const dealii::IndexSet &owned,
                   const MPI_Comm          communicator);

    const ContactStructure contact;
    const dealii::IndexSet clamped;
    // Whether the tangent is a sum of the body's constant terms, of open
    // contact and of contact by the rows of its Jacobian; otherwise it is one
    // matrix.
    const bool is_sum;
    // Matrix of open contact if the tangent is a sum; otherwise of the whole
    // tangent.
    BodyMatrix                       matrix{Matrix()};
    std::optional<BodyKey>           body;
    std::unique_ptr<TangentOperator> current;
    // Smooths with the present tangent, even when it has changed since the setup:
    // a large body leaves no memory for another one.
    Multigrid multigrid;
    // Keys of the tangent, and of that for which the coarse levels were set up.
    Name name, set_up_name;
    bool smoother_is_current = false;
    // Whether there was a first system in this stage, and its iterations.
    bool            set_up_in_stage = false;
    IterationBudget budget;
  };
} // namespace Ricochet

#endif
