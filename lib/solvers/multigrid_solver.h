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
  /// Solves each system by multigrid, for bodies in three dimensions whose
  /// factorisation takes too long or too much memory.
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
    /// What a tangent was made of.
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

    /// The tangent as multigrid takes it.
    void
    update_tangent(const Tangent          &tangent,
                   const dealii::IndexSet &owned,
                   const MPI_Comm          communicator);

    const ContactStructure contact;
    const dealii::IndexSet clamped;
    // The tangent is the sum of the body's constant terms, of open contact and
    // of what contact does through its functionals; otherwise one matrix.
    const bool is_sum;
    // Open contact, or all of it.
    BodyMatrix                       matrix{Matrix()};
    std::optional<BodyKey>           body;
    std::unique_ptr<TangentOperator> current;
    // Smooths with this very tangent, even when it has changed since the setup: a
    // large body has no room for another one.
    Multigrid multigrid;
    // Of the tangent, and of the one that the coarse levels are for.
    Name name, set_up_name;
    bool smoother_is_current = false;
    // Whether there was a first system in this stage, and the iterations that it
    // needed.
    bool            set_up_in_stage = false;
    IterationBudget budget;
  };
} // namespace Ricochet

#endif
