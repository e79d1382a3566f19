// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_factorisation_h
#define ricochet_solvers_factorisation_h

#include <base/types.h>
#include <solvers/functionals.h>
#include <solvers/triangular_factor.h>

#include <Epetra_CrsMatrix.h>

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
    factorise(const Epetra_CrsMatrix &matrix, const bool keep_pivots) = 0;

    bool
    factorise(const Matrix &matrix, const bool keep_pivots)
    {
      return factorise(matrix.trilinos_matrix(), keep_pivots);
    }

    /// Solve matrix * @p solution = @p right_hand_side. @throws NewtonFailure
    virtual void
    solve(const Vector &right_hand_side, Vector &solution) = 0;

    /// The same for several right hand sides.
    virtual void
    solve(const std::vector<Vector> &right_hand_sides,
          std::vector<Vector>       &solutions);

    /// Whether the functions below can be used since the last factorise(): with
    /// matrix = D L L^T (but for the order of the unknowns), D = -1 for multipliers with
    /// a negative matrix of their own and 1 for all else, a solution is the way forwards
    /// through D L and the one backwards through L^T, and where little is on the right
    /// hand side, a part of L will do for the first.
    virtual bool
    has_halves() const
    {
      return false;
    }

    /// The factors themselves since the last factorise(), less accurate, for right hand
    /// sides that are zero in unknowns with equations of their own. Null where they
    /// are not at hand.
    virtual const TriangularFactor<float> *
    triangular_factor()
    {
      return nullptr;
    }

    /// @p half = L^{-1} D @p right_hand_side, in an order of its own.
    virtual void
    go_forwards(const Vector & /*right_hand_side*/,
                std::vector<double> & /*half*/)
    {}

    /// L^{-1} times several right hand sides, where it is not zero: each of them only in
    /// those members of the region that lie on its way.
    struct HalfColumns
    {
      /// Members of the region that the same columns go through.
      struct Piece
      {
        /// Place of the first one, and behind the last one.
        std::size_t begin, end;
        /// Which columns: a range of #columns.
        std::size_t begin_column, end_column;
        /// Place in #values.
        std::size_t first_value;

        int
        n_columns() const
        {
          return end_column - begin_column;
        }
      };

      /// The part of L with all that is not zero.
      std::vector<int> region;
      /// The first unknown of each member of the region, counted in the region, and
      /// behind the last one.
      std::vector<int>   first_row;
      std::vector<Piece> pieces;
      std::vector<int>   columns;
      /// For each unknown of the region one number of each column of its piece.
      std::vector<double> values;
      int                 n_columns = 0;
    };

    virtual HalfColumns
    go_forwards(const Functionals & /*right_hand_sides*/)
    {
      return {};
    }

    /// Inner products of the columns of @p left and @p right, weighted by D, which are
    /// entries of the inverse as seen by their right hand sides: by columns.
    virtual void
    multiply(const HalfColumns & /*left*/,
             const HalfColumns & /*right*/,
             std::vector<double> & /*products*/) const
    {}

    /// Inner products of the @p columns and a @p half solution: what their right hand
    /// sides see of the whole one. @p values has a place for each column.
    virtual void
    observe(const HalfColumns & /*columns*/,
            const std::vector<double> & /*half*/,
            double * /*values*/) const
    {}

    /// Subtract D times the @p columns with their @p coefficients from a @p half
    /// solution.
    virtual void
    subtract(const HalfColumns & /*columns*/,
             const double * /*coefficients*/,
             std::vector<double> & /*half*/) const
    {}

    /// @p solution = L^{-T} @p half.
    virtual void
    go_backwards(const std::vector<double> & /*half*/, Vector & /*solution*/)
    {}
  };

  /// LU factorisation of any matrix by @p package of Trilinos' Amesos, "KLU" or
  /// "MUMPS".
  std::unique_ptr<Factorisation>
  make_lu_factorisation(const std::string &package);

  /**
   * Cholesky factorisation by CHOLMOD, on one rank (see GatheredFactorisation for
   * several ones), of a symmetric matrix. It is
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
