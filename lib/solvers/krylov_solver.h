// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_krylov_solver_h
#define ricochet_solvers_krylov_solver_h

#include <solvers/corrected_factorisation.h>
#include <solvers/factorisation_choice.h>
#include <solvers/tangent_solver.h>

#include <memory>

namespace Ricochet
{
  /// For nonlinear bodies: the symmetric part of a tangent is factored, which costs
  /// less than half of a factorisation with pivots, and serves GMRES for several
  /// tangents.
  class KrylovSolver : public TangentSolver
  {
  public:
    KrylovSolver(const FactorisationChoice &factorisations,
                 const ContactStructure    &contact)
      : factorisations(factorisations)
      , contact(contact)
    {}

    /// @return whether GMRES converged.
    bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) override;

  private:
    const FactorisationChoice               factorisations;
    const ContactStructure                  contact;
    std::unique_ptr<CorrectedFactorisation> factorisation;
  };
} // namespace Ricochet

#endif
