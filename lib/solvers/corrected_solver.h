// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_corrected_solver_h
#define ricochet_solvers_corrected_solver_h

#include <solvers/corrected_factorisation.h>
#include <solvers/factorisation_choice.h>
#include <solvers/tangent_solver.h>

#include <cstdint>
#include <list>
#include <memory>
#include <optional>

namespace Ricochet
{
  /// For linear bodies: keeps a factorisation of the body for each length of the
  /// time step, and treats contact as a correction of low rank.
  class CorrectedSolver : public TangentSolver
  {
  public:
    CorrectedSolver(const FactorisationChoice &factorisations,
                    const unsigned int         n_kept,
                    const ContactStructure    &contact)
      : factorisations(factorisations)
      , n_kept(n_kept)
      , contact(contact)
    {}

    /// Those with the name of their body.
    bool
    takes(const Tangent &tangent) const override
    {
      return tangent.body.has_value();
    }

    SolverReport::Strategy
    strategy() const override
    {
      return SolverReport::corrected;
    }

    /// @return true.
    /// @throws NewtonFailure when the body's matrix cannot be factored.
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

    CondensedSystem &
    condensed(const Tangent &tangent) override;

  private:
    /// A factored body, its name, and that of the contact last put to it.
    struct Corrected
    {
      std::optional<BodyKey>                  body;
      std::optional<std::uint64_t>            contact;
      std::unique_ptr<CorrectedFactorisation> factorisation;
    };

    Corrected
    factorise_body(const Tangent &tangent);

    /// That of the body of @p tangent, made if there is none.
    Corrected &
    find(const Tangent &tangent);

    const FactorisationChoice factorisations;
    const unsigned int        n_kept;
    const ContactStructure    contact;
    std::list<Corrected>      kept;
  };
} // namespace Ricochet

#endif
