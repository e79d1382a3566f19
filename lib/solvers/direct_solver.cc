// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/direct_solver.h>
#include <base/kept.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Give the constraints of @p matrix, its rows that have an entry zero in the
    /// diagonal, a compliance that is small against that of the body. Constraints may
    /// be redundant, such as those of two fixed nodes at one position: their
    /// multipliers are not unique, and the compliance selects those closest to the last
    /// ones. The residual is unchanged, so that the only cost is the accuracy of the
    /// tangent. @return whether there are constraints. Collective.
    bool
    soften_constraints(Matrix &matrix)
    {
      constexpr double relative_compliance = 1e-8;
      double           stiffest            = 0.;
      for (const auto row : matrix.locally_owned_range_indices())
        stiffest = std::max(stiffest, std::abs(matrix.diag_element(row)));
      stiffest = Utilities::MPI::max(stiffest, matrix.get_mpi_communicator());
      bool some_softened = false;
      for (const auto row : matrix.locally_owned_range_indices())
        if (matrix.diag_element(row) == 0.)
          {
            double square = 0.;
            for (auto entry = matrix.begin(row); entry != matrix.end(row);
                 ++entry)
              square += entry->value() * entry->value();
            if (square == 0.)
              continue;
            matrix.set(row, row, -relative_compliance * square / stiffest);
            some_softened = true;
          }
      matrix.compress(VectorOperation::insert);
      return Utilities::MPI::max(some_softened ? 1 : 0,
                                 matrix.get_mpi_communicator()) == 1;
    }
  } // namespace



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
      entry.factorisation = std::make_unique<Factorisation>(package);
    const Stopwatch stopwatch(spent.factorising);
    ++spent.n_factorisations;
    bool is_regular = entry.factorisation->factorise(entry.matrix, keep_pivots);
    if (!is_regular && soften_constraints(entry.matrix))
      {
        entry.factorisation = std::make_unique<Factorisation>(package);
        is_regular = entry.factorisation->factorise(entry.matrix, false);
      }
    if (!is_regular)
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
        // Pivots are not kept where contact changes the pattern, since they may
        // have become poor.
        factorise(tangent, !stage_begins && tangent.pattern == 0, *entry);
        stage_begins = false;
      }

    const Stopwatch stopwatch(spent.substituting);
    ++spent.n_substitutions;
    entry->factorisation->solve(right_hand_side, solution);
    return true;
  }
} // namespace Ricochet
