// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_block_matrix_h
#define ricochet_solvers_block_matrix_h

#include <base/types.h>

#include <deal.II/base/partitioner.h>
#include <deal.II/lac/la_parallel_vector.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Which nodes a symmetric matrix couples. The dim unknowns of a node stand
   * together. On a rank, nodes have numbers: first its own, in the order of their
   * unknowns, then those of other ranks that they couple to (ghosts).
   */
  struct BlockPattern
  {
    /**
     * @param matrices whose entries are to find a place, all with the same rows;
     * rows of a rank are contiguous, and a multiple of @p dim.
     * @param others unknowns of other ranks that are to be known besides.
     * Collective.
     */
    BlockPattern(const MatrixSum                                    &matrices,
                 const std::vector<dealii::types::global_dof_index> &others,
                 const unsigned int                                  dim);

    /// Of the place of a block, or that of its end where there is none.
    std::size_t
    find(const unsigned int row, const unsigned int column) const;

    unsigned int
    n_rows() const
    {
      return begin.size() - 1;
    }

    unsigned int dim;
    /// Of the unknowns; ghosts are those of whole nodes.
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner> partitioner;
    /// The blocks to the right of the diagonal of row i begin[i] <= k < begin[i+1]
    /// are in the columns #column[k], in ascending order; those from #ghosts_begin[i]
    /// on are ghosts. What is to the left of the diagonal is what is to the right of
    /// it in another row, or in one of another rank.
    std::vector<std::size_t>  begin, ghosts_begin;
    std::vector<unsigned int> column;
  };

  /**
   * A symmetric matrix of blocks between nodes, half of which is stored: for bodies
   * in space with 4-byte numbers and nodes of degree 2 a sixth of the bytes of a
   * matrix of entries. deal.II 9.4 and Epetra have no such matrix (theirs know neither
   * blocks of fixed size in single precision nor symmetry).
   */
  template <typename Number>
  class BlockMatrix
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<Number>;

    /// Zero.
    explicit BlockMatrix(std::shared_ptr<const BlockPattern> pattern);

    /// Add @p factor times the symmetric part of @p matrix (but between ranks, where
    /// each has its own rows). Its entries have a place in the pattern.
    void
    add(const double factor, const Matrix &matrix);

    /// The rows and columns of the unknowns whose @p flags (with ghosts) are not zero
    /// become zero, with @p diagonal on the diagonal.
    void
    clear(const VectorType &flags, const Number diagonal);

    /// @p result = this @p vector, both on the partitioner of the pattern. Collective.
    void
    vmult(VectorType &result, const VectorType &vector) const;

    /// Entry in row and column @p i of this rank.
    Number
    diagonal_entry(const dealii::types::global_dof_index i) const;

    const BlockPattern &
    pattern() const
    {
      return *places;
    }

    /// Bytes of the matrix on this rank.
    std::size_t
    memory_consumption() const;

  private:
    template <int dim>
    void
    multiply(const Number *from, Number *to) const;

    std::shared_ptr<const BlockPattern> places;
    // Row by row, dim * dim entries each: on the diagonal, and at #places->column.
    std::vector<Number> diagonal, blocks;
  };
} // namespace Ricochet

#endif
