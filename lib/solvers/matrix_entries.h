// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_matrix_entries_h
#define ricochet_solvers_matrix_entries_h

#include <base/types.h>

#include <deal.II/base/index_set.h>

namespace Ricochet
{
  /**
   * The rows of a matrix on this rank as they are stored, in compressed rows: row r has
   * the entries begin[r] <= k < begin[r+1] with the values value[k] in the columns
   * column[k]. Rows and columns have local numbers; columns are in ascending order in
   * each row. Loops over it take a tenth of the time of deal.II's iterators, which copy
   * each row.
   *
   * Access to Trilinos' Epetra is restricted to this class and to those that hand a
   * matrix to one of its packages (Factorisation, CoupledMultigrid).
   */
  class MatrixEntries
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// @param matrix has to live as long as this, with its pattern.
    explicit MatrixEntries(const Matrix &matrix)
      : MatrixEntries(matrix.trilinos_matrix())
    {}

    /// As above, for a matrix of Trilinos.
    explicit MatrixEntries(const Epetra_CrsMatrix &matrix);

    /// Rows of this rank.
    unsigned int
    n_rows() const;

    /// Columns in which rows of this rank have entries.
    unsigned int
    n_columns() const;

    /// Number of entries on this rank.
    std::size_t
    size() const
    {
      return begin[n_rows()];
    }

    /// Index of row @p r in the whole matrix.
    Index
    row_index(const int r) const;

    /// Index of column @p c in the whole matrix.
    Index
    column_index(const int c) const;

    /// Number of the row @p index of the whole matrix; -1 where it is on another rank.
    int
    row_number(const Index index) const;

    /// Number of the column @p index of the whole matrix; -1 where it has no entries.
    int
    column_number(const Index index) const;

    /// Index of the entry in row @p r and column @p c; -1 where there is none.
    int
    find(const int r, const int c) const;

    /// Indices of the rows of this rank.
    dealii::IndexSet
    row_indices() const;

    const int    *begin = nullptr, *column = nullptr;
    const double *value = nullptr;

  private:
    const Epetra_CrsMatrix *matrix;
  };

  /// The values of @p matrix on this rank, in the order of its MatrixEntries.
  double *
  entry_values(Matrix &matrix);
} // namespace Ricochet

#endif
