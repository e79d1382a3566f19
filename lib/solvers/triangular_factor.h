// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_triangular_factor_h
#define ricochet_solvers_triangular_factor_h

#include <solvers/functionals.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Ricochet
{
  /**
   * Solutions with the factors of a symmetric matrix A = P^T L D L^T P, whole or in
   * part. The forward solve of a sparse right-hand side needs the few columns of L on
   * the path of the elimination tree from its unknowns to the last one; entries b_i^T
   * A^{-1} b_j for sparse vectors are products of their forward solves.
   */
  class TriangularSolves
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// Number of columns of a ForwardColumns, stored side by side, so that L is read
    /// once for all of them.
    static constexpr unsigned int n_columns = 16;

    /// Vectors L^{-1} P b of some sparse b: the blocks of L on their paths, ascending, and
    /// their values, a row of #n_columns for each unknown.
    struct ForwardColumns
    {
      std::vector<int>    blocks;
      std::vector<double> values;
    };

    virtual ~TriangularSolves() = default;

    /// Number of unknowns.
    virtual unsigned int
    n() const = 0;

    /// @p forward = L^{-1} P @p right_hand_side.
    virtual void
    forward(const double        *right_hand_side,
            std::vector<double> &forward) const = 0;

    /// As above, for the rows @p numbers (at most #n_columns) of a sparse
    /// matrix.
    virtual ForwardColumns
    forward(const Functionals               &rows,
            const std::vector<unsigned int> &numbers) const = 0;

    /// @p solution = P^T L^{-T} D^{-1} @p forward, which is overwritten.
    virtual void
    backward(std::vector<double> &forward, double *solution) const = 0;

    /// The blocks on the paths of some unknowns to the last one, ascending.
    virtual std::vector<int>
    region_of(const std::vector<Index> &unknowns) const = 0;

    /// P^T L^{-T} D^{-1} @p forward in the blocks of @p region, which includes the
    /// paths of all its members; undefined elsewhere. By position, see place_of().
    virtual void
    backward(const std::vector<double> &forward,
             const std::vector<int>    &region,
             std::vector<double>       &solution) const = 0;

    /// Position of an unknown in the order of the factors.
    virtual int
    place_of(const Index unknown) const = 0;

    /// One^T D^{-1} other: the entries between the columns of both, #n_columns squared, by
    /// rows.
    virtual void
    multiply(const ForwardColumns &one,
             const ForwardColumns &other,
             std::vector<double>  &products) const = 0;

    /// Add the @p columns times @p coefficients (of each column) to @p forward.
    virtual void
    add(const ForwardColumns &columns,
        const double         *coefficients,
        std::vector<double>  &forward) const = 0;
  };

  /**
   * The factors in the order in which solves pass through L, from one end to the other,
   * whose speed is limited by memory.
   *
   * Columns of L with the same rows below them, or nearly so, form blocks, with zeros
   * where a column has no entry. The rows below are stored in pairs of consecutive
   * rows, such as those of a node.
   *
   * @tparam Value type in which L is stored. In single precision (float) the
   * factors are those of a matrix that differs from A by the rounding; for that
   * matrix, all operations are in double precision.
   */
  template <typename Value>
  class TriangularFactor : public TriangularSolves
  {
  public:
    /// Columns in the form of sparse factorisations.
    struct Columns
    {
      int n;
      /// Unknown at each position.
      const int *order;
      /// Beginning of columns among rows and among values, and their numbers of
      /// entries, the one on the diagonal first, rows in ascending order.
      const int    *begin, *first_value, *n_entries, *rows;
      const double *values;
      /// The diagonal is that of L; otherwise it is D, and that of L is 1.
      bool diagonal_is_of_l;
      /// Sign of unknowns: -1 where rows have been multiplied by -1, which couple
      /// only to each other; otherwise 1.
      const double *sign;
    };

    explicit TriangularFactor(const Columns &columns);

    unsigned int
    n() const override
    {
      return place.size();
    }

    void
    forward(const double        *right_hand_side,
            std::vector<double> &forward) const override;

    ForwardColumns
    forward(const Functionals               &rows,
            const std::vector<unsigned int> &numbers) const override;

    void
    backward(std::vector<double> &forward, double *solution) const override;

    std::vector<int>
    region_of(const std::vector<Index> &unknowns) const override;

    void
    backward(const std::vector<double> &forward,
             const std::vector<int>    &region,
             std::vector<double>       &solution) const override;

    int
    place_of(const Index unknown) const override
    {
      return place[unknown];
    }

    void
    multiply(const ForwardColumns &one,
             const ForwardColumns &other,
             std::vector<double>  &products) const override;

    void
    add(const ForwardColumns &columns,
        const double         *coefficients,
        std::vector<double>  &forward) const override;

  private:
    struct Block
    {
      int first, width;
      /// Pairs of rows below among #first_rows.
      std::size_t begin, end;
      /// Beginning of the strict lower triangle in #values, row by row, and of the
      /// pairs of rows below: in each pair the two values of one column follow those
      /// of the other. A row that is missing has zeros.
      std::size_t triangle, below;
      /// The block of the first row below; -1 for none.
      int parent;
    };

    /// The first column and the end of each block.
    static std::vector<std::array<int, 2>>
    find_blocks(const Columns &columns);

    /// Values of a block in a forward solve, and its parts of #values and
    /// #first_rows.
    struct View
    {
      double      *own;
      const Value *triangle, *below;
      const int   *rows, *rows_end;
    };

    View
    view(const Block &block, double *forward) const
    {
      return {forward + block.first,
              values.data() + block.triangle,
              values.data() + block.below,
              first_rows.data() + block.begin,
              first_rows.data() + block.end};
    }

    /// Eliminate @p block from @p forward.
    void
    eliminate(const Block &block, double *forward) const;

    /// As above, for the columns @p own of a block.
    /// @param columns_of a function that returns the columns of a row, null for a row
    /// on no path.
    template <typename ColumnsOf>
    void
    eliminate_columns(const Block     &block,
                      double          *own,
                      const ColumnsOf &columns_of) const;

    /// Subtract the known values below @p block from it in @p forward, and
    /// solve.
    void
    substitute(const Block &block, double *forward) const;

    /// Add @p block and those after it to @p region, if they are missing.
    void
    mark(int block, std::vector<int> &region) const;

    /// Sort @p region, and unmark it.
    void
    finish(std::vector<int> &region) const;

    /// Call @p action(begin, end) with blocks of independent trees, on several threads.
    template <typename Action>
    void
    for_each_part(const Action &action) const;

    /// First position of block @p b, or the end of all.
    int
    first_place(const unsigned int b) const
    {
      return b < blocks.size() ? blocks[b].first : n();
    }

    // Position of each unknown, and unknown at each position.
    std::vector<int>   place, unknown;
    std::vector<int>   block_of;
    std::vector<Block> blocks;
    std::vector<int>   first_rows;
    std::vector<Value> values;
    // 1 / D
    std::vector<double> inverse_diagonal;
    // First blocks of independent trees, with no earlier column that has rows in or
    // behind them, and the number of values before each. The last one is the end.
    std::vector<unsigned int> trees;
    std::vector<double>       values_before;
    // Work space: zero between calls, and -1 between calls.
    mutable std::vector<char> is_needed;
    mutable std::vector<int>  row_of_block;
  };
} // namespace Ricochet

#endif
