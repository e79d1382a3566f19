// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_block_matrix_h
#define ricochet_solvers_block_matrix_h

#include <base/types.h>
#include <solvers/matrix_entries.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <functional>
#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * The pairs of nodes that a symmetric matrix couples. The dim unknowns of a node
   * are consecutive. On a rank, nodes have numbers: first its own, in the order of
   * their unknowns, then those of other ranks that they couple to (ghosts). Where
   * there are no ghosts, other unknowns may follow those of the nodes: multipliers,
   * whose rows and columns are zero.
   */
  struct BlockPattern
  {
    /**
     * The pattern for the entries of some matrices.
     *
     * @param matrices all with the same rows; those of a rank are contiguous, and a
     * multiple of @p dim.
     * @param others unknowns of other ranks that are added to the ghosts.
     * Collective.
     */
    BlockPattern(const std::vector<MatrixEntries>                   &matrices,
                 const std::vector<dealii::types::global_dof_index> &others,
                 const unsigned int                                  dim,
                 const MPI_Comm communicator);

    /// @param rows for each own node the numbers of those that it couples to, in
    /// any order; those not to the right of the diagonal are left out. They are
    /// moved from.
    BlockPattern(
      std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner,
      std::vector<std::vector<unsigned int>>                   &&rows,
      const unsigned int                                         dim);

    /// Index of a block, or that of the row's end where there is none.
    std::size_t
    find(const unsigned int row, const unsigned int column) const;

    unsigned int
    n_rows() const
    {
      return begin.size() - 1;
    }

    const unsigned int dim;
    /// Partitioner of the unknowns; ghosts are those of whole nodes.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /// The blocks to the right of the diagonal of row i begin[i] <= k < begin[i+1]
    /// are in the columns #column[k], in ascending order; those from #ghosts_begin[i]
    /// on are ghosts. Blocks to the left of the diagonal are those to the right of it
    /// in another row, or in one of another rank.
    std::vector<std::size_t>  begin, ghosts_begin;
    std::vector<unsigned int> column;
    /// Rows at which independent parts begin: no block couples them to earlier rows,
    /// and they have no ghosts; and the number of blocks before each. The last one is
    /// the end.
    std::vector<unsigned int> separate;
    std::vector<double>       blocks_before;

  private:
    void
    set_rows(std::vector<std::vector<unsigned int>> &&rows);
  };

  /**
   * A symmetric matrix of blocks between nodes, half of which is stored: for bodies in
   * 3D with 4-byte numbers and nodes of degree 2 a sixth of the bytes of a matrix of
   * entries. deal.II 9.4 and Trilinos have no such matrix (theirs have neither blocks
   * of fixed size in single precision nor symmetry).
   */
  template <typename Number>
  class BlockMatrix
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<Number>;

    /// A matrix of zeros.
    /// @param isotropic blocks are multiples of the identity, of which one number is
    /// stored, as those of a mass matrix.
    explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern,
                         const bool                          isotropic = false);

    /// Add @p factor times the symmetric part of @p matrix (except for entries
    /// between ranks, where each rank has its own rows). Its entries have to be in
    /// the pattern.
    /// @pre it is not isotropic; as below.
    void
    add(const double factor, const MatrixEntries &matrix);

    /// Add @p factor times @p matrix, on the same pattern.
    void
    add(const double factor, const BlockMatrix<double> &matrix);

    /// Add the matrix of a cell, symmetric, whose rows are the unknowns with the
    /// numbers @p unknowns on this rank. Each rank adds all cells that touch its nodes.
    void
    add_cell(const std::vector<unsigned int>  &unknowns,
             const dealii::FullMatrix<double> &cell_matrix);

    /// The rows and columns of the unknowns whose @p flags (with ghosts) are not zero
    /// become zero, with @p diagonal on the diagonal.
    void
    clear(const VectorType &flags, const Number diagonal);

    /// @p result = this @p vector, both on the partitioner of the pattern. Collective.
    void
    vmult(VectorType &result, const VectorType &vector) const;

    /// As above, with local numbers; @p from has its ghosts behind its own
    /// entries.
    void
    vmult(const Number *from, Number *to) const;

    /// As above, for @p factor times this plus @p isotropic_factor times
    /// @p isotropic, which is isotropic and on the same pattern: both in one sweep.
    /// @pre this matrix is not isotropic.
    void
    vmult_sum(const double       factor,
              const double       isotropic_factor,
              const BlockMatrix &isotropic,
              const Number      *from,
              Number            *to) const;

    /// The largest sum of absolute values in a row of this rank.
    double
    linfty_norm() const;

    /// Entry in row and column @p i, a local number.
    Number
    diagonal_entry(const unsigned int i) const
    {
      const unsigned int dim = places->dim;
      if (i >= places->n_rows() * dim)
        return Number(0);
      return isotropic ? diagonal[i / dim] : diagonal[i * dim + i % dim];
    }

    /// The columns of a row, as local numbers, and the values there.
    using RowAction =
      std::function<void(const unsigned int               row,
                         const std::vector<unsigned int> &columns,
                         const std::vector<double>       &values)>;

    /// Call @p action for all rows of this rank, the unknowns' one after the other; or
    /// for some @p numbers of them, in ascending order.
    void
    for_each_row(const RowAction                 &action,
                 const std::vector<unsigned int> *numbers = nullptr) const;

    bool
    is_isotropic() const
    {
      return isotropic;
    }

    const std::shared_ptr<const BlockPattern> &
    pattern() const
    {
      return places;
    }

    /// Bytes of the matrix on this rank.
    std::size_t
    memory_consumption() const;

  private:
    template <typename>
    friend class BlockMatrix;

    /// Call @p add(k, j, from, to) for each block k (those on the diagonal first) in
    /// column j, and @p add_transposed for the blocks to the left of the diagonal.
    template <int dim,
              typename AddDiagonal,
              typename Add,
              typename AddTransposed>
    void
    sweep(const AddDiagonal   &add_diagonal,
          const Add           &add,
          const AddTransposed &add_transposed,
          const Number        *from,
          Number              *to) const;

    template <int dim, bool is_isotropic>
    void
    multiply(const Number *from, Number *to) const;

    template <int dim>
    void
    multiply_sum(const Number       factor,
                 const Number       isotropic_factor,
                 const BlockMatrix &isotropic,
                 const Number      *from,
                 Number            *to) const;

    std::shared_ptr<const BlockPattern> places;
    const bool                          isotropic;
    // Number of entries of a block.
    const unsigned int size;
    // Values row by row, #size entries each: on the diagonal, and at
    // #places->column.
    std::vector<Number> diagonal;
    std::vector<Number> blocks;
  };
} // namespace Ricochet

#endif
