// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_body_matrix_h
#define ricochet_solvers_body_matrix_h

#include <base/types.h>
#include <solvers/block_matrix.h>

#include <memory>

namespace Ricochet
{
  /// How the matrices of a linear body are stored.
  enum class MatrixStorage
  {
    /// By entries, as for factorisations.
    entries,
    /// By blocks between nodes, half of them: a third of the memory (of a mass
    /// matrix a sixth), for bodies whose matrix is not factored.
    blocks
  };

  /// A constant matrix of a body: stiffness, viscosity or mass. All functions
  /// are collective.
  class BodyMatrix
  {
  public:
    /// An empty matrix.
    BodyMatrix() = default;

    /// Stored by entries.
    explicit BodyMatrix(Matrix matrix)
      : by_entries(std::make_unique<Matrix>(std::move(matrix)))
    {}

    /// Stored by blocks.
    explicit BodyMatrix(std::unique_ptr<BlockMatrix<double>> blocks);

    /// @p result = this @p vector.
    void
    vmult(Vector &result, const Vector &vector) const;

    /// @p result = the sum of two terms times @p vector, in one sweep. @pre both are
    /// stored by blocks on the same pattern, the second one's isotropic.
    static void
    vmult_sum(const MatrixTerm &full,
              const MatrixTerm &isotropic,
              Vector           &result,
              const Vector     &vector);

    /// @p matrix += @p factor times this; it has the entries.
    void
    add_to(const double factor, Matrix &matrix) const;

    /// @p matrix = this.
    void
    copy_to(Matrix &matrix) const;

    /// @p diagonal += @p factor times that of this.
    void
    add_diagonal(const double factor, Vector &diagonal) const;

    /// The largest sum of absolute values in a row.
    double
    linfty_norm() const;

    dealii::types::global_dof_index
    m() const;

    MPI_Comm
    get_mpi_communicator() const;

    dealii::IndexSet
    locally_owned_range_indices() const;

    /// Columns and values of the row with number @p row on this rank, by their indices
    /// in the whole matrix. The rows are in order: all of them, or those with some
    /// @p numbers in ascending order.
    using RowAction = std::function<
      void(const unsigned int                                  row,
           const std::vector<dealii::types::global_dof_index> &columns,
           const std::vector<double>                          &values)>;

    void
    for_each_row(const RowAction                 &action,
                 const std::vector<unsigned int> *numbers = nullptr) const;

    /// The matrix of blocks; null if it is stored by entries.
    const Matrix *
    entries() const
    {
      return by_entries.get();
    }

    Matrix *
    entries()
    {
      return by_entries.get();
    }

    const BlockMatrix<double> *
    blocks() const
    {
      return by_blocks.get();
    }

    /// Bytes on this rank.
    std::size_t
    memory_consumption() const;

  private:
    /// Call @p action with the local entries of @p vector, its ghosts behind
    /// its own.
    void
    with_ghosts(const Vector                                    &vector,
                const std::function<void(const double *values)> &action) const;

    std::unique_ptr<Matrix>              by_entries;
    std::unique_ptr<BlockMatrix<double>> by_blocks;
    // Copy of a vector with ghosts, on several ranks.
    mutable BlockMatrix<double>::VectorType ghosted;
  };
} // namespace Ricochet

#endif
