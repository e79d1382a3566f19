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
   * part. The forward solve of a sparse right-hand side is made of the few columns of L
   * on the path of the elimination tree from its unknowns to the last one; entries of
   * the inverse as seen by two sparse vectors are products of their forward solves.
   */
  class TriangularSolves
  {
  public:
    using Index = dealii::types::global_dof_index;

    /// Columns of a ForwardColumns, one beside the other, so that L is read once for
    /// all of them.
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

    /// The same for the rows @p numbers (at most #n_columns) of a sparse matrix.
    virtual ForwardColumns
    forward(const Functionals               &rows,
            const std::vector<unsigned int> &numbers) const = 0;

    /// @p solution = P^T L^{-T} D^{-1} @p forward, which is overwritten.
    virtual void
    backward(std::vector<double> &forward, double *solution) const = 0;

    /// The blocks on the paths of some unknowns to the last one, ascending.
    virtual std::vector<int>
    region_of(const std::vector<Index> &unknowns) const = 0;

    /// P^T L^{-T} D^{-1} @p forward in the blocks of @p region, which holds the paths of
    /// all its members; elsewhere nothing of meaning. By place, see place_of().
    virtual void
    backward(const std::vector<double> &forward,
             const std::vector<int>    &region,
             std::vector<double>       &solution) const = 0;

    /// Place of an unknown in the order of the factors.
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
   * The factors in the order in which solves pass through L, from one end to the other:
   * it is memory that limits them.
   *
   * Columns of L with the same rows below them, or nearly so, make blocks, with zeros
   * where a column has nothing. The rows below are stored in pairs of rows that follow
   * each other, as those of a node do.
   *
   * @tparam Value what L is stored in. In single precision (float) the factors are
   * those of a matrix that differs from A by as much; for that one, all is done in
   * double precision.
   */
  template <typename Value>
  class TriangularFactor : public TriangularSolves
  {
  public:
    /// Columns as sparse factorisations leave them.
    struct Columns
    {
      int n;
      /// Unknown of each place.
      const int *order;
      /// Where columns begin among rows and among values, and how many entries they
      /// have, the one on the diagonal first, rows rising.
      const int    *begin, *first_value, *n_entries, *rows;
      const double *values;
      /// The diagonal is that of L; otherwise it is D, and that of L is 1.
      bool diagonal_is_of_l;
      /// -1 for unknowns whose rows have been multiplied by that, which couple to no
      /// others than their like; otherwise 1.
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
      /// Of the strict lower triangle in #values, row by row, and of the pairs of rows
      /// below: of each the two values of one column behind those of the other. A row
      /// that is not there has zeros.
      std::size_t triangle, below;
      /// The one of the first row below; -1: none.
      int parent;
    };

    /// The first column and the end of each block.
    static std::vector<std::array<int, 2>>
    find_blocks(const Columns &columns);

    /// Where the values of a block of a forward solve are, and what #values and
    /// #first_rows have for it.
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

    /// Take @p block out of @p forward.
    void
    eliminate(const Block &block, double *forward) const;

    /// The same for the columns @p own of a block.
    /// @param columns_of a function that returns the columns of a row, null for one that is
    /// on no path.
    template <typename ColumnsOf>
    void
    eliminate_columns(const Block     &block,
                      double          *own,
                      const ColumnsOf &columns_of) const;

    /// Take what is known below it out of @p block of @p forward, and solve.
    void
    substitute(const Block &block, double *forward) const;

    /// Add @p block and those after it to @p region, if they are not in it.
    void
    mark(int block, std::vector<int> &region) const;

    /// Put @p region in order, and unmark it.
    void
    finish(std::vector<int> &region) const;

    /// Call @p action(begin, end) with blocks of trees of their own, on several threads.
    template <typename Action>
    void
    for_each_part(const Action &action) const;

    /// Of block @p b, or the end of all.
    int
    first_place(const unsigned int b) const
    {
      return b < blocks.size() ? blocks[b].first : n();
    }

    // Of each unknown, and the other way round.
    std::vector<int>   place, unknown;
    std::vector<int>   block_of;
    std::vector<Block> blocks;
    std::vector<int>   first_rows;
    std::vector<Value> values;
    // 1 / D
    std::vector<double> inverse_diagonal;
    // No column before a block of #trees has rows in it or behind it; and how many values
    // there are before it. The last one is the end.
    std::vector<unsigned int> trees;
    std::vector<double>       values_before;
    // Work space: zero between calls, and -1 between calls.
    mutable std::vector<char> is_needed;
    mutable std::vector<int>  row_of_block;
  };
} // namespace Ricochet

#endif
