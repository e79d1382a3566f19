// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/triangular_factor.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  namespace
  {
    // Two at once, wherever they lie.
    using DoublePair __attribute__((vector_size(16), aligned(8), may_alias)) =
      double;
    using FloatPair __attribute__((vector_size(8), aligned(4), may_alias)) =
      float;

    DoublePair
    pair(const float *values)
    {
      return __builtin_convertvector(*reinterpret_cast<const FloatPair *>(
                                       values),
                                     DoublePair);
    }

    DoublePair &
    at(double *values)
    {
      return *reinterpret_cast<DoublePair *>(values);
    }
  } // namespace



  TriangularFactor::TriangularFactor(const Columns &columns)
    : place(columns.n)
    , block_of(columns.n)
    , inverse_diagonal(columns.n)
    , dense(columns.n, 0.)
  {
    for (int k = 0; k < columns.n; ++k)
      place[columns.order[k]] = k;
    for (int first = 0; first < columns.n;)
      {
        int end = first + 1;
        while (
          end < columns.n &&
          columns.n_entries[end - 1] == columns.n_entries[end] + 1 &&
          std::equal(columns.rows + columns.begin[end],
                     columns.rows + columns.begin[end] + columns.n_entries[end],
                     columns.rows + columns.begin[end - 1] + 1))
          ++end;
        const int  last    = end - 1;
        const int *below   = columns.rows + columns.begin[last] + 1;
        const int  n_below = columns.n_entries[last] - 1;
        Block      block{first,
                    end - first,
                    first_rows.size(),
                    0,
                    values.size(),
                    0,
                    n_below > 0 ? below[0] : -1};
        for (int column = first; column < end; ++column)
          {
            block_of[column]         = blocks.size();
            const double diagonal    = columns.values[columns.begin[column]];
            inverse_diagonal[column] = columns.sign[columns.order[column]] /
              (columns.diagonal_is_of_l ? diagonal * diagonal : diagonal);
          }
        // Of a row of the block, those of its own columns being the first.
        const auto entry = [&](const int row, const int column) {
          const double value = columns.values[columns.begin[column] + row];
          return static_cast<float>(columns.diagonal_is_of_l ? value /
                                        columns.values[columns.begin[column]]
                                                             : value);
        };
        for (int row = first + 1; row < end; ++row)
          for (int column = first; column < row; ++column)
            values.push_back(entry(row - column, column));
        block.below = values.size();
        for (int k = 0; k < n_below;)
          {
            const bool has_second =
              k + 1 < n_below && below[k + 1] == below[k] + 1;
            // The last row of all stands behind the one before it.
            const bool is_second = !has_second && below[k] + 1 == columns.n;
            first_rows.push_back(is_second ? below[k] - 1 : below[k]);
            for (int column = first; column < end; ++column)
              {
                const int row = end + k - column;
                values.push_back(is_second ? 0.F : entry(row, column));
                values.push_back(is_second      ? entry(row, column)
                                   : has_second ? entry(row + 1, column)
                                                : 0.F);
              }
            k += has_second ? 2 : 1;
          }
        block.end = first_rows.size();
        if (sums.size() < 2 * std::size_t(block.width))
          sums.resize(2 * block.width);
        blocks.push_back(block);
        first = end;
      }
    for (Block &block : blocks)
      if (block.parent >= 0)
        block.parent = block_of[block.parent];
    is_needed.assign(blocks.size(), 0);
  }



  void
  TriangularFactor::eliminate(const Block &block, double *half) const
  {
    const float *value = values.data() + block.triangle;
    double      *own   = half + block.first;
    const int    width = block.width;
    for (int i = 1; i < width; ++i)
      {
        double sum = 0.;
        for (int c = 0; c < i; ++c)
          sum += value[c] * own[c];
        own[i] -= sum;
        value += i;
      }
    value = values.data() + block.below;
    for (std::size_t k = block.begin; k < block.end; ++k, value += 2 * width)
      {
        DoublePair sum = pair(value) * own[0];
        for (int c = 1; c < width; ++c)
          sum += pair(value + 2 * c) * own[c];
        at(half + first_rows[k]) -= sum;
      }
  }



  void
  TriangularFactor::substitute(const Block &block, double *half) const
  {
    const int    width = block.width;
    double      *own   = half + block.first;
    const float *value = values.data() + block.below;
    // A node in the plane has two unknowns, and most blocks are one node.
    if (width == 2)
      {
        DoublePair sum[2] = {};
        for (std::size_t k = block.begin; k < block.end; ++k, value += 4)
          {
            const DoublePair rows = at(half + first_rows[k]);
            sum[0] += pair(value) * rows;
            sum[1] += pair(value + 2) * rows;
          }
        for (int c = 0; c < 2; ++c)
          own[c] -= sum[c][0] + sum[c][1];
      }
    else
      {
        std::fill_n(sums.begin(), 2 * width, 0.);
        for (std::size_t k = block.begin; k < block.end;
             ++k, value += 2 * width)
          {
            const DoublePair rows = at(half + first_rows[k]);
            for (int c = 0; c < width; ++c)
              at(&sums[2 * c]) += pair(value + 2 * c) * rows;
          }
        for (int c = 0; c < width; ++c)
          own[c] -= sums[2 * c] + sums[2 * c + 1];
      }
    const float *triangle = values.data() + block.triangle;
    for (int i = width - 1; i > 0; --i)
      {
        const float *row = triangle + i * (i - 1) / 2;
        for (int c = 0; c < i; ++c)
          own[c] -= row[c] * own[i];
      }
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
    double        sum   = 0.;
    const double *value = one.values.data();
    for (const int b : one.blocks)
      for (int k = blocks[b].first; k < blocks[b].first + blocks[b].width; ++k)
        sum += *value++ * inverse_diagonal[k] * other[k];
    return sum;
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
