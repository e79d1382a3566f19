// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/corrected_solver.h>
#include <base/kept.h>

namespace Ricochet
{
  CorrectedSolver::Corrected
  CorrectedSolver::factorise_body(const Tangent &tangent)
  {
    // Should the body's matrix not be positive definite, LU will do.
    for (const bool symmetric : {true, false})
      {
        if (!symmetric &&
            factorisations.name(false) == factorisations.name(true))
          break;
        LowRankCorrection::Options options;
        options.is_symmetric  = symmetric && !contact.is_clamped;
        options.may_be_single = !contact.has_multipliers &&
          !contact.takes_rows && !contact.has_mixed_functionals;
        Corrected entry{tangent.body,
                        {},
                        std::make_unique<CorrectedFactorisation>(
                          factorisations.make(symmetric),
                          contact.functionals
                            ? CorrectedFactorisation::Correction::functionals
                            : CorrectedFactorisation::Correction::rows,
                          contact,
                          options,
                          spent)};
        entry.factorisation->set_body(tangent);
        ++spent.n_factorisations;
        if (entry.factorisation->factorise())
          return entry;
      }
    throw NewtonFailure(
      "The matrix of the body cannot be factored: it is singular. Is "
      "the body held, or does it have inertia?");
  }



  CorrectedSolver::Corrected &
  CorrectedSolver::find(const Tangent &tangent)
  {
    return find_or_make(
      kept,
      n_kept,
      [&](const Corrected &corrected) {
        return corrected.body == tangent.body;
      },
      [&]() { return factorise_body(tangent); });
  }



  CondensedSystem &
  CorrectedSolver::condensed(const Tangent &tangent)
  {
    // It will change what it has of contact.
    Corrected &entry = find(tangent);
    entry.contact.reset();
    return *entry.factorisation;
  }



  bool
  CorrectedSolver::solve(const Tangent &tangent,
                         const Vector  &right_hand_side,
                         Vector        &solution,
                         const bool /*may_reuse*/,
                         const double /*tolerance*/)
  {
    Corrected &entry = find(tangent);
    // A state of contact with a name need not be put again.
    if (tangent.complete_contact &&
        !(tangent.contact && entry.contact == tangent.contact))
      {
        entry.contact.reset();
        entry.factorisation->set_contact(tangent);
        entry.contact = tangent.contact;
      }
    const Stopwatch stopwatch(spent.substituting);
    entry.factorisation->solve(right_hand_side, solution);
    return true;
  }
} // namespace Ricochet
