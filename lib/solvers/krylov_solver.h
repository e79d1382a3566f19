// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_krylov_solver_h
#define ricochet_solvers_krylov_solver_h

#include <solvers/corrected_factorisation.h>
#include <solvers/factorisation_choice.h>
#include <solvers/gathered_body.h>
#include <solvers/tangent_solver.h>

#include <memory>

namespace Ricochet
{
  /// For nonlinear bodies: the symmetric part of a tangent is factored, which costs
  /// less than half of a factorisation with pivots, and serves GMRES for several
  /// tangents; or condensed to contact, all iterations of a stage that need no other
  /// tangent.
  class KrylovSolver : public TangentSolver
  {
  public:
    KrylovSolver(const FactorisationChoice &factorisations,
                 const ContactStructure    &contact)
      : factorisations(factorisations)
      , contact(contact)
    {}

    void
    forget_condensed() override;

    /// Not those in which contact couples what the body does not: these it condenses
    /// only.
    bool
    takes(const Tangent & /*tangent*/) const override
    {
      return !contact.couplings_change;
    }

    SolverReport::Strategy
    strategy() const override
    {
      return SolverReport::corrected;
    }

    /// @return whether GMRES converged.
    bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) override;

    /// Where contact enters by functionals.
    bool
    condenses() const override
    {
      return contact.functionals.has_value();
    }

    /// The symmetric part of the first tangent since forget_condensed(): not that of @p
    /// tangent, but near it.
    /// @throws NewtonFailure when it cannot be factored.
    CondensedSystem &
    condensed(const Tangent &tangent) override;

  private:
    std::unique_ptr<FactoredBody>
    make_nearby();

    const FactorisationChoice               factorisations;
    const ContactStructure                  contact;
    std::unique_ptr<CorrectedFactorisation> factorisation;
    // For condensed systems.
    std::unique_ptr<FactoredBody>           nearby;
    std::unique_ptr<CorrectedFactorisation> body;
    bool                                    has_condensed = false;
  };
} // namespace Ricochet

#endif
