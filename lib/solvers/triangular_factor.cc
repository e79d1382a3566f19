// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/triangular_factor.h>

#include <algorithm>
#include <array>
#include <type_traits>

namespace Ricochet
{
  namespace
  {
    // Two or four at once, wherever they lie.
    using DoublePair __attribute__((vector_size(16), aligned(8), may_alias)) =
      double;
    using FloatPair __attribute__((vector_size(8), aligned(4), may_alias)) =
      float;
    using DoubleQuad __attribute__((vector_size(32))) = double;
    using FloatQuad __attribute__((vector_size(16), aligned(4), may_alias)) =
      float;

    inline DoublePair
    pair(const float *values)
    {
      return __builtin_convertvector(*reinterpret_cast<const FloatPair *>(
                                       values),
                                     DoublePair);
    }

    inline DoubleQuad
    quad(const float *values)
    {
      return __builtin_convertvector(*reinterpret_cast<const FloatQuad *>(
                                       values),
                                     DoubleQuad);
    }

    inline DoublePair &
    at(double *values)
    {
      return *reinterpret_cast<DoublePair *>(values);
    }

    // Blocks are no wider than this, and no more of what they have is filled up with
    // zeros: then wide blocks are worth it.
    constexpr int    largest_width = 8;
    constexpr double zeros         = .3;

    /// Call @p action with @p width, known when it is compiled.
    template <typename Action>
    inline void
    with_width(const int width, const Action &action)
    {
      static_assert(largest_width == 8);
      switch (width)
        {
          case 2:
            return action(std::integral_constant<int, 2>());
          case 4:
            return action(std::integral_constant<int, 4>());
          case 6:
            return action(std::integral_constant<int, 6>());
          case 8:
            return action(std::integral_constant<int, 8>());
          default:
            return action(width);
        }
    }
  } // namespace



  std::vector<std::array<int, 2>>
  TriangularFactor::find_blocks(const Columns &columns)
  {
    const auto n_below = [&](const int column) {
      return columns.n_entries[column] - 1;
    };
    std::vector<std::array<int, 2>> ranges;
    double                          n_zeros = 0.;
    for (int first = 0; first < columns.n;)
      {
        // With the same rows below, as sparse factorisations find them.
        int end = first + 1;
        while (
          end < columns.n && end - first < largest_width &&
          n_below(end - 1) == n_below(end) + 1 &&
          std::equal(columns.rows + columns.begin[end],
                     columns.rows + columns.begin[end] + columns.n_entries[end],
                     columns.rows + columns.begin[end - 1] + 1))
          ++end;

        // And those before, if all rows below them are here, too, and few are not.
        if (!ranges.empty())
          {
            auto &[last_first, last_end] = ranges.back();
            const int last               = last_end - 1;
            const int width              = end - last_first;
            const int last_width         = last_end - last_first;
            if (width <= largest_width && n_below(last) > 0 &&
                columns.rows[columns.begin[last] + 1] == first)
              {
                const int more = end - first + n_below(end - 1) - n_below(last);
                const double more_zeros = n_zeros + double(more) * last_width;
                if (more_zeros <=
                    zeros * width * (n_below(end - 1) + .5 * width))
                  {
                    n_zeros  = more_zeros;
                    last_end = end;
                    first    = end;
                    continue;
                  }
              }
          }
        n_zeros = 0.;
        ranges.push_back({{first, end}});
        first = end;
      }
    return ranges;
  }



  TriangularFactor::TriangularFactor(const Columns &columns)
    : place(columns.n)
    , block_of(columns.n)
    , inverse_diagonal(columns.n)
    , dense(columns.n, 0.)
  {
    for (int k = 0; k < columns.n; ++k)
      place[columns.order[k]] = k;
    // The entries of a block, and where in it a row is.
    std::vector<float> entries;
    std::vector<int>   row_in_block(columns.n);
    for (const auto &[first, end] : find_blocks(columns))
      {
        const int  width   = end - first;
        const int  last    = end - 1;
        const int *below   = columns.rows + columns.begin[last] + 1;
        const int  n_below = columns.n_entries[last] - 1;
        Block      block{first,
                    width,
                    first_rows.size(),
                    0,
                    values.size(),
                    0,
                    n_below > 0 ? below[0] : -1};
        for (int i = 0; i < width; ++i)
          row_in_block[first + i] = i;
        for (int k = 0; k < n_below; ++k)
          row_in_block[below[k]] = width + k;
        entries.assign(static_cast<std::size_t>(width) * (width + n_below),
                       0.F);
        for (int column = first; column < end; ++column)
          {
            block_of[column]         = blocks.size();
            const int    begin       = columns.begin[column];
            const double diagonal    = columns.values[begin];
            inverse_diagonal[column] = columns.sign[columns.order[column]] /
              (columns.diagonal_is_of_l ? diagonal * diagonal : diagonal);
            const double scale = columns.diagonal_is_of_l ? diagonal : 1.;
            for (int k = begin + 1; k < begin + columns.n_entries[column]; ++k)
              entries[row_in_block[columns.rows[k]] * width + column - first] =
                static_cast<float>(columns.values[k] / scale);
          }
        const auto entry = [&](const int row, const int column) {
          return entries[row * width + column];
        };
        for (int row = 1; row < width; ++row)
          for (int column = 0; column < row; ++column)
            values.push_back(entry(row, column));
        block.below = values.size();
        for (int k = 0; k < n_below;)
          {
            const bool has_second =
              k + 1 < n_below && below[k + 1] == below[k] + 1;
            // The last row of all stands behind the one before it.
            const bool is_second = !has_second && below[k] + 1 == columns.n;
            first_rows.push_back(is_second ? below[k] - 1 : below[k]);
            const int row = width + k;
            for (int column = 0; column < width; ++column)
              {
                values.push_back(is_second ? 0.F : entry(row, column));
                values.push_back(is_second      ? entry(row, column)
                                   : has_second ? entry(row + 1, column)
                                                : 0.F);
              }
            k += has_second ? 2 : 1;
          }
        block.end = first_rows.size();
        blocks.push_back(block);
      }
    for (Block &block : blocks)
      if (block.parent >= 0)
        block.parent = block_of[block.parent];
    is_needed.assign(blocks.size(), 0);
  }



  void
  TriangularFactor::eliminate(const Block &block, double *half) const
  {
    double      *own      = half + block.first;
    const float *triangle = values.data() + block.triangle;
    const float *below    = values.data() + block.below;
    const int   *rows     = first_rows.data() + block.begin;
    const int   *rows_end = first_rows.data() + block.end;
    with_width(block.width, [=](const auto width) {
      const float *value = triangle;
      for (int i = 1; i < width; ++i)
        {
          double sum = 0.;
          for (int c = 0; c < i; ++c)
            sum += value[c] * own[c];
          own[i] -= sum;
          value += i;
        }
      value = below;
      if constexpr (std::is_same_v<decltype(width), const int>)
        for (const int *row = rows; row != rows_end; ++row, value += 2 * width)
          {
            DoublePair sum = pair(value) * own[0];
            for (int c = 1; c < width; ++c)
              sum += pair(value + 2 * c) * own[c];
            at(half + *row) -= sum;
          }
      else
        {
          // Two columns at once.
          DoubleQuad own_twice[width / 2];
          for (int c = 0; c < width; c += 2)
            own_twice[c / 2] =
              DoubleQuad{own[c], own[c], own[c + 1], own[c + 1]};
          for (const int *row = rows; row != rows_end;
               ++row, value += 2 * width)
            {
              DoubleQuad sum = quad(value) * own_twice[0];
              for (int c = 1; c < width / 2; ++c)
                sum += quad(value + 4 * c) * own_twice[c];
              at(half + *row) -=
                DoublePair{sum[0], sum[1]} + DoublePair{sum[2], sum[3]};
            }
        }
    });
  }



  void
  TriangularFactor::substitute(const Block &block, double *half) const
  {
    double      *own      = half + block.first;
    const float *triangle = values.data() + block.triangle;
    const float *below    = values.data() + block.below;
    const int   *rows     = first_rows.data() + block.begin;
    const int   *rows_end = first_rows.data() + block.end;
    with_width(block.width, [=](const auto width) {
      const float *value = below;
      if constexpr (std::is_same_v<decltype(width), const int>)
        {
          DoublePair sums[largest_width] = {};
          for (const int *row = rows; row != rows_end;
               ++row, value += 2 * width)
            {
              const DoublePair values = at(half + *row);
              for (int c = 0; c < width; ++c)
                sums[c] += pair(value + 2 * c) * values;
            }
          for (int c = 0; c < width; ++c)
            own[c] -= sums[c][0] + sums[c][1];
        }
      else
        {
          DoubleQuad sums[width / 2] = {};
          for (const int *row = rows; row != rows_end;
               ++row, value += 2 * width)
            {
              const DoublePair two = at(half + *row);
              const DoubleQuad values{two[0], two[1], two[0], two[1]};
              for (int c = 0; c < width / 2; ++c)
                sums[c] += quad(value + 4 * c) * values;
            }
          for (int c = 0; c < width; ++c)
            own[c] -= sums[c / 2][c % 2 * 2] + sums[c / 2][c % 2 * 2 + 1];
        }
      for (int i = width - 1; i > 0; --i)
        {
          const float *row = triangle + i * (i - 1) / 2;
          for (int c = 0; c < i; ++c)
            own[c] -= row[c] * own[i];
        }
    });
  }



  void
  TriangularFactor::mark(int block, std::vector<int> &region) const
  {
    for (; block >= 0 && is_needed[block] == 0; block = blocks[block].parent)
      {
        is_needed[block] = 1;
        region.push_back(block);
      }
  }



  void
  TriangularFactor::finish(std::vector<int> &region) const
  {
    std::sort(region.begin(), region.end());
    for (const int block : region)
      is_needed[block] = 0;
  }



  void
  TriangularFactor::go_forwards(const double        *right_hand_side,
                                std::vector<double> &half) const
  {
    half.resize(n());
    for (unsigned int i = 0; i < n(); ++i)
      half[place[i]] = right_hand_side[i];
    for (const Block &block : blocks)
      eliminate(block, half.data());
  }



  TriangularFactor::Half
  TriangularFactor::go_forwards(const std::vector<Start> &start) const
  {
    Half half;
    for (const Start &entry : start)
      {
        dense[entry.place] += entry.value;
        mark(block_of[entry.place], half.blocks);
      }
    finish(half.blocks);
    for (const int b : half.blocks)
      {
        const Block &block = blocks[b];
        eliminate(block, dense.data());
        half.values.insert(half.values.end(),
                           dense.begin() + block.first,
                           dense.begin() + block.first + block.width);
        std::fill_n(dense.begin() + block.first, block.width, 0.);
      }
    return half;
  }



  void
  TriangularFactor::go_backwards(std::vector<double> &half,
                                 double              *solution) const
  {
    for (unsigned int i = 0; i < n(); ++i)
      half[i] *= inverse_diagonal[i];
    for (auto block = blocks.rbegin(); block != blocks.rend(); ++block)
      substitute(*block, half.data());
    for (unsigned int i = 0; i < n(); ++i)
      solution[i] = half[place[i]];
  }



  void
  TriangularFactor::go_backwards(const std::vector<double> &half,
                                 const std::vector<int>    &region,
                                 std::vector<double>       &solution) const
  {
    solution.resize(n());
    for (const int b : region)
      for (int k = blocks[b].first; k < blocks[b].first + blocks[b].width; ++k)
        solution[k] = inverse_diagonal[k] * half[k];
    for (auto b = region.rbegin(); b != region.rend(); ++b)
      substitute(blocks[*b], solution.data());
  }



  double
  TriangularFactor::product(const Half                &one,
                            const std::vector<double> &other) const
  {
    // Two sums do not wait for each other.
    std::array<double, 2> sums{};
    const double         *value = one.values.data();
    for (const int b : one.blocks)
      {
        const int end = blocks[b].first + blocks[b].width;
        int       k   = blocks[b].first;
        for (; k + 1 < end; k += 2, value += 2)
          {
            sums[0] += value[0] * inverse_diagonal[k] * other[k];
            sums[1] += value[1] * inverse_diagonal[k + 1] * other[k + 1];
          }
        if (k < end)
          sums[0] += *value++ * inverse_diagonal[k] * other[k];
      }
    return sums[0] + sums[1];
  }



  void
  TriangularFactor::add(const double         factor,
                        const Half          &half,
                        std::vector<double> &other) const
  {
    const double *value = half.values.data();
    for (const int b : half.blocks)
      for (int k = blocks[b].first; k < blocks[b].first + blocks[b].width; ++k)
        other[k] += factor * *value++;
  }



  void
  TriangularFactor::clear(const Half &half, std::vector<double> &other) const
  {
    for (const int b : half.blocks)
      std::fill_n(other.begin() + blocks[b].first, blocks[b].width, 0.);
  }
} // namespace Ricochet
