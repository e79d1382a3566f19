// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/direct_solver.h>
#include <base/kept.h>

namespace Ricochet
{
  void
  DirectSolver::factorise(const Tangent &tangent,
                          const bool     keep_pivots,
                          Factored      &entry)
  {
    if (entry.pattern != tangent.pattern)
      {
        entry.factorisation.reset();
        entry.matrix.clear();
        entry.pattern = tangent.pattern;
      }
    assemble(tangent, entry.matrix);
    if (!entry.factorisation)
      entry.factorisation = factorisations.make(false);
    const Stopwatch stopwatch(spent.factorising);
    ++spent.n_factorisations;
    if (!entry.factorisation->factorise(entry.matrix, keep_pivots))
      {
        entry.factorisation.reset();
        throw NewtonFailure(
          "The tangent matrix cannot be factored: it is singular. Is the "
          "body held, or does it have inertia?");
      }
  }



  bool
  DirectSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double /*tolerance*/)
  {
    Factored *entry = &changing;
    if (tangent.body && tangent.contact)
      entry = find_or_make(
                kept,
                n_kept,
                [&](const std::unique_ptr<Factored> &factored) {
                  return factored->body == tangent.body &&
                    factored->contact == *tangent.contact;
                },
                [&]() {
                  // LU refers to the matrix: it must not move.
                  auto factored     = std::make_unique<Factored>();
                  factored->body    = tangent.body;
                  factored->contact = *tangent.contact;
                  factorise(tangent, false, *factored);
                  return factored;
                })
                .get();
    else if (!may_reuse || !entry->factorisation)
      {
        // Where contact comes and goes, pivots that were good are so no longer.
        factorise(tangent, !stage_begins && tangent.pattern == 0, *entry);
        stage_begins = false;
      }

    const Stopwatch stopwatch(spent.substituting);
    ++spent.n_substitutions;
    entry->factorisation->solve(right_hand_side, solution);
    return true;
  }
} // namespace Ricochet
