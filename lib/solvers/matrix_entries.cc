// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/matrix_entries.h>

#include <Epetra_CrsMatrix.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    using EpetraIndex = TrilinosWrappers::types::int_type;

    /// The arrays of a matrix, by Epetra's names.
    struct Arrays
    {
      explicit Arrays(const Epetra_CrsMatrix &matrix)
      {
        const int error = matrix.ExtractCrsDataPointers(offset, index, value);
        AssertThrow(error == 0,
                    ExcMessage("The matrix is not stored in one piece."));
      }

      int    *offset = nullptr, *index = nullptr;
      double *value = nullptr;
    };
  } // namespace



  MatrixEntries::MatrixEntries(const Epetra_CrsMatrix &matrix)
    : matrix(&matrix)
  {
    const Arrays arrays(matrix);
    begin  = arrays.offset;
    column = arrays.index;
    value  = arrays.value;
  }



  unsigned int
  MatrixEntries::n_rows() const
  {
    return matrix->NumMyRows();
  }



  unsigned int
  MatrixEntries::n_columns() const
  {
    return matrix->NumMyCols();
  }



  MatrixEntries::Index
  MatrixEntries::row_index(const int r) const
  {
    return matrix->GRID64(r);
  }



  MatrixEntries::Index
  MatrixEntries::column_index(const int c) const
  {
    return matrix->GCID64(c);
  }



  int
  MatrixEntries::row_number(const Index index) const
  {
    return matrix->LRID(static_cast<EpetraIndex>(index));
  }



  int
  MatrixEntries::column_number(const Index index) const
  {
    return matrix->LCID(static_cast<EpetraIndex>(index));
  }



  int
  MatrixEntries::find(const int r, const int c) const
  {
    const int *const end   = column + begin[r + 1];
    const int *const entry = std::lower_bound(column + begin[r], end, c);
    return entry != end && *entry == c ? entry - column : -1;
  }



  IndexSet
  MatrixEntries::row_indices() const
  {
    return IndexSet(static_cast<const Epetra_BlockMap &>(matrix->RowMap()));
  }



  double *
  entry_values(Matrix &matrix)
  {
    return Arrays(matrix.trilinos_matrix()).value;
  }
} // namespace Ricochet
