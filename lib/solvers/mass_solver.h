// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_mass_solver_h
#define ricochet_solvers_mass_solver_h

#include <base/types.h>
#include <solvers/body_matrix.h>

#include <vector>

namespace Ricochet
{
  /**
   * Accelerations from forces, M a = f, by conjugate gradients with the diagonal of M:
   * its condition does not depend on the mesh (Wathen, IMA J. Numer. Anal. 7, 1987),
   * so this takes fewer operations than a factorisation that is used once.
   */
  class MassSolver
  {
  public:
    using Index = dealii::TrilinosWrappers::SparseMatrix::size_type;

    /**
     * @param mass symmetric and positive definite except for the rows of @p own;
     * it has to outlive this object.
     * @param own unknowns of this rank with the equation a = f: clamped ones, whose
     * forces have to be zero, and those without mass that couple to no other.
     * @throws NewtonFailure where an unknown has no mass.
     */
    MassSolver(const BodyMatrix &mass, const std::vector<Index> &own);

    /// @p acceleration = M^{-1} @p force, to round-off. @throws NewtonFailure
    void
    solve(const Vector &force, Vector &acceleration) const;

    /// The product M @p acceleration in the solver's form.
    void
    vmult(Vector &force, const Vector &acceleration) const;

  private:
    const BodyMatrix        &mass;
    const std::vector<Index> own;
    Vector                   inverse_diagonal;
  };
} // namespace Ricochet

#endif
