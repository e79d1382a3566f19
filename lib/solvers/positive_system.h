// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_positive_system_h
#define ricochet_solvers_positive_system_h

#include <deal.II/lac/lapack_full_matrix.h>

#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * Dense systems with the rows and columns of a symmetric, positive matrix C (the
   * compliance of contact) that belong to a set of places, and more on the diagonal:
   *
   *     (C_ij + d_i delta_ij) z_j = b_i,   i, j in the set.
   *
   * Steps of time ask for sets that grow and shrink at their ends, if places have the
   * order in which they come into contact. A set is factored in blocks of columns
   * from its beginning on, and those that the last one began with, too, are kept.
   * They have the digits that they would get again.
   *
   * The iterations of Newton's method ask for sets that differ by a few places. One
   * of them is factored, and another one that is near is solved for with that
   * factorisation: places that leave get z = 0 by a multiplier, places that join are
   * unknowns beside it. With k of both and n places this costs 2 n^2 k operations
   * instead of n^3 / 3.
   */
  class PositiveSystem
  {
  public:
    /**
     * @param places of the set, ascending.
     * @param diagonal d of each of them, not negative.
     * @param columns of C, by place; the same ones until forget() is called.
     * @param may_update use the factorisation of another set; without it, the
     * result does not depend on what came before.
     * @return whether the matrix is positive definite, as far as is seen. If not,
     * the system cannot be used.
     */
    bool
    set(const std::vector<unsigned int>        &places,
        const std::vector<double>              &diagonal,
        const std::vector<std::vector<double>> &columns,
        const bool                              may_update);

    /// C becomes another one.
    void
    forget();

    /// Whether it is solved with the factorisation of another set.
    bool
    is_updated() const
    {
      return rest.has_value();
    }

    /// @param vector b, becomes z, in the order of the places.
    void
    solve(dealii::Vector<double> &vector) const;

  private:
    using DenseMatrix = dealii::LAPACKFullMatrix<double>;

    bool
    factorise(const std::vector<unsigned int>        &places,
              const std::vector<double>              &diagonal,
              const std::vector<std::vector<double>> &columns);

    bool
    update(const std::vector<unsigned int>        &places,
           const std::vector<double>              &diagonal,
           const std::vector<std::vector<double>> &columns);

    /// Overwrite columns of @p n rows with the inverse of the first @p n rows and columns
    /// of the factor, or its transposed, times them.
    /// @param distance between the beginnings of columns.
    void
    solve_half(const char *transpose,
               const int   n,
               double     *columns,
               const int   n_columns,
               const int   distance) const;

    /// Entry of the factor R, C = R^T R, by columns.
    double &
    factor(const unsigned int i, const unsigned int j);

    /// Columns of a block: enough for matrix products, and few where sets end.
    static constexpr unsigned int block_size = 64;

    // The set that is factored, and how many of its places are.
    std::vector<unsigned int> base_places;
    std::vector<double>       base_diagonal;
    unsigned int              n_factored = 0;
    // Its upper triangle, with space for more rows than it has.
    std::vector<double> upper;
    int                 n_rows = 0;

    // Another one: where its places are in the factored set (-1: they joined), and
    // what is beside it: those that joined, then those that left, by their place in
    // the factored set.
    std::vector<int>          place_in_base;
    std::vector<unsigned int> joined, left;
    // R^{-T} times what couples to the factored set, and the matrix of the rest.
    DenseMatrix                border;
    std::optional<DenseMatrix> rest;
  };
} // namespace Ricochet

#endif
