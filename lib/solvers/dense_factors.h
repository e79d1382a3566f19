// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_dense_factors_h
#define ricochet_solvers_dense_factors_h

#include <vector>

namespace Ricochet
{
  /**
   * A dense square matrix, and its LU factorisation with row pivots on the threads of the
   * rank (see Threads): while one of them factors the next columns, the others subtract
   * the last ones from all that follow. LAPACK's own one has one thread or those of its
   * BLAS, which do not go to sleep when others are to work.
   *
   * @tparam Number double or float
   */
  template <typename Number>
  class DenseFactors
  {
  public:
    /// A matrix of @p n rows and columns, of any values. Its memory is kept.
    void
    reinit(const unsigned int n);

    Number &
    operator()(const unsigned int row, const unsigned int column)
    {
      return values[static_cast<std::size_t>(column) * size + row];
    }

    /// Replace the matrix by its factors. @return whether it is not singular.
    bool
    factorise();

    /// @param vector right-hand side, becomes the solution.
    /// @pre factorise() has returned true.
    void
    solve(Number *vector) const;

  private:
    /// Factor the columns from @p first on, of which all before has been subtracted.
    bool
    factorise_panel(const int first, const int width);

    /// Subtract the panel of columns from @p first on from @p n_columns columns.
    void
    subtract_panel(const int first,
                   const int width,
                   const int column,
                   const int n_columns);

    int                 size = 0;
    std::vector<Number> values;
    // As LAPACK counts: the row with which each one was exchanged, from 1 on.
    std::vector<int> pivots;
  };
} // namespace Ricochet

#endif
