// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_sparse_cholesky_h
#define ricochet_solvers_sparse_cholesky_h

#include <base/types.h>
#include <solvers/triangular_factor.h>

#include <memory>

namespace Ricochet
{
  /**
   * Cholesky factorisation by CHOLMOD of the matrix of a body, all of whose rows are on
   * this rank. LDL^T in 2D, which allows for an indefinite matrix, and the supernodal
   * LL^T where that is faster.
   *
   * Multipliers may have a negative definite block of their own that is not coupled
   * to others.
   */
  class SparseCholesky
  {
  public:
    enum class Kind
    {
      /// A symmetric matrix in double precision, which is factored once for many
      /// solutions.
      exact,
      /// The symmetric part of a matrix in single precision, which is factored every few
      /// steps.
      frozen_tangent
    };

    explicit SparseCholesky(const Kind kind);

    ~SparseCholesky();

    /**
     * Factor @p matrix, whose pattern is the same each time. The result does not depend
     * on the history.
     * @return whether it succeeded; if not, the matrix is singular, or not of the
     * required kind.
     */
    bool
    factorise(const Matrix &matrix);

    /// @pre factorise() has returned true.
    const TriangularSolves &
    factor() const
    {
      return *solves;
    }

  private:
    /// The matrix in CHOLMOD's form, and CHOLMOD's factor.
    struct Workshop;

    const Kind                        kind;
    std::unique_ptr<Workshop>         workshop;
    std::unique_ptr<TriangularSolves> solves;
  };
} // namespace Ricochet

#endif
