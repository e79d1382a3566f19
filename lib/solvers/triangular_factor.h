// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_triangular_factor_h
#define ricochet_solvers_triangular_factor_h

#include <base/large_pages.h>

#include <array>
#include <cstddef>
#include <vector>

namespace Ricochet
{
  /**
   * The factors of a symmetric matrix A = P^T L D L^T P, in the order in which ways
   * through them read L, from one end to the other: it is memory that limits them.
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
  class TriangularFactor
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
      /// other one; otherwise 1.
      const double *sign;
    };

    explicit TriangularFactor(const Columns &columns);

    /// A vector L^{-1} P b of a sparse b: blocks in their order, and their values one
    /// behind the other.
    struct Half
    {
      std::vector<int>    blocks;
      std::vector<double> values;
    };

    unsigned int
    n() const
    {
      return place.size();
    }

    /// @p half = L^{-1} P @p right_hand_side.
    void
    go_forwards(const double *right_hand_side, std::vector<double> &half) const
    {
      go_forwards(right_hand_side, half, nullptr);
    }

    /// @p half = |D|^{-1/2} L^{-1} P @p right_hand_side.
    void
    go_half_way(const double *right_hand_side, std::vector<double> &half) const
    {
      go_forwards(right_hand_side, half, &root_of_inverse);
    }

    /// The same for a sparse right hand side: @p n_entries values with their unknowns.
    template <typename Index>
    Half
    go_forwards(const Index       *unknowns,
                const double      *values,
                const unsigned int n_entries) const
    {
      std::vector<Start> start;
      for (unsigned int k = 0; k < n_entries; ++k)
        start.push_back({place[unknowns[k]], values[k]});
      return go_forwards(start);
    }

    /// @p solution = P^T L^{-T} D^{-1} @p half, which is overwritten.
    void
    go_backwards(std::vector<double> &half, double *solution) const
    {
      go_backwards(half.data(), half, solution, inverse_diagonal);
    }

    /// @p solution = P^T L^{-T} |D|^{-1/2} @p half
    /// @param work space.
    void
    go_other_half_way(const std::vector<double> &half,
                      std::vector<double>       &work,
                      double                    *solution) const
    {
      work.resize(n());
      go_backwards(half.data(), work, solution, root_of_inverse);
    }

    /// @p one D^{-1} @p other
    double
    product(const Half &one, const std::vector<double> &other) const;

    /// The blocks on the ways of some unknowns to the last one.
    template <typename Index>
    std::vector<int>
    region_of(const std::vector<Index> &unknowns) const
    {
      std::vector<int> region;
      for (const Index unknown : unknowns)
        mark(block_of[place[unknown]], region);
      finish(region);
      return region;
    }

    /// P^T L^{-T} D^{-1} @p half where @p region is; elsewhere nothing of meaning.
    void
    go_backwards(const std::vector<double> &half,
                 const std::vector<int>    &region,
                 std::vector<double>       &solution) const;

    /// Place of an unknown in the last go_backwards() with a region.
    template <typename Index>
    int
    place_of(const Index unknown) const
    {
      return place[unknown];
    }

    /// @p other += @p factor @p half
    void
    add(const double         factor,
        const Half          &half,
        std::vector<double> &other) const;

    /// @p other = 0 where @p half has values.
    void
    clear(const Half &half, std::vector<double> &other) const;

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

    struct Start
    {
      int    place;
      double value;
    };

    Half
    go_forwards(const std::vector<Start> &start) const;

    void
    go_forwards(const double              *right_hand_side,
                std::vector<double>       &half,
                const std::vector<double> *factor) const;

    void
    go_backwards(const double              *half,
                 std::vector<double>       &work,
                 double                    *solution,
                 const std::vector<double> &factor) const;

    /// The first column and the end of each block.
    static std::vector<std::array<int, 2>>
    find_blocks(const Columns &columns);

    /// Where the values of a block of a half solution are, and what #values and
    /// #first_rows have for it.
    struct View
    {
      double      *own;
      const Value *triangle, *below;
      const int   *rows, *rows_end;
    };

    View
    view(const Block &block, double *half) const
    {
      return {half + block.first,
              values.data() + block.triangle,
              values.data() + block.below,
              first_rows.data() + block.begin,
              first_rows.data() + block.end};
    }

    /// Take @p block out of @p half.
    void
    eliminate(const Block &block, double *half) const;

    /// Take what is known below it out of @p block of @p half, and solve.
    void
    substitute(const Block &block, double *half) const;

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
    LargeVector<Value> values;
    // 1 / D, and the root of its absolute values.
    std::vector<double> inverse_diagonal, root_of_inverse;
    // No column before a block of #trees has rows in it or behind it; and how many values
    // there are before it. The last one is the end.
    std::vector<unsigned int> trees;
    std::vector<double>       values_before;
    // Work space: zero between calls.
    mutable std::vector<double> dense;
    mutable std::vector<char>   is_needed;
  };
} // namespace Ricochet

#endif
