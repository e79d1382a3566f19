// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_factorisation_h
#define ricochet_solvers_factorisation_h

#include <base/types.h>

#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * A sparse factorisation of one matrix, that may be made anew with other
   * values in the same places.
   */
  class Factorisation
  {
  public:
    using Index = dealii::types::global_dof_index;

    virtual ~Factorisation() = default;

    /**
     * Factor @p matrix, the same one each time: a matrix that is made anew needs
     * a new factorisation. (Whether it lies where the last one was, which could
     * tell them apart, differs from rank to rank.)
     *
     * @param keep_pivots use the pivots of the last time, which is faster;
     * without it, the result does not depend on what came before.
     * @return whether it could be done; if not, the matrix is singular, or not
     * what this kind of factorisation is for.
     */
    virtual bool
    factorise(const Matrix &matrix, const bool keep_pivots) = 0;

    /// Solve matrix * @p solution = @p right_hand_side. @throws NewtonFailure
    virtual void
    solve(const Vector &right_hand_side, Vector &solution) = 0;

    /// The same for several right hand sides.
    virtual void
    solve(const std::vector<Vector> &right_hand_sides,
          std::vector<Vector>       &solutions);
  };

  /// LU factorisation of any matrix by @p package of Trilinos' Amesos, "KLU" or
  /// "MUMPS".
  std::unique_ptr<Factorisation>
  make_lu_factorisation(const std::string &package);

  /**
   * Cholesky factorisation by CHOLMOD, on one rank, of a symmetric matrix. It is
   * LDL^T for plane meshes, which stands an indefinite matrix, and the
   * supernodal LL^T where that is faster.
   *
   * Couplings of one side only are allowed, where they lead from unknowns that
   * have equations of their own: clamped displacements, multipliers of open
   * points.
   *
   * @param approximate factor the symmetric part of the matrix. Without it,
   * another matrix is refused.
   */
  std::unique_ptr<Factorisation>
  make_cholesky_factorisation(const bool approximate);
} // namespace Ricochet

#endif
