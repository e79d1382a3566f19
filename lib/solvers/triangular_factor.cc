// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/triangular_factor.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
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
                    rows.size(),
                    rows.size() + n_below,
                    values.size(),
                    -1};
        rows.insert(rows.end(), below, below + n_below);
        for (int column = first; column < end; ++column)
          {
            block_of[column]         = blocks.size();
            const double diagonal    = columns.values[columns.begin[column]];
            inverse_diagonal[column] = columns.diagonal_is_of_l
              ? 1. / (diagonal * diagonal)
              : 1. / diagonal;
          }
        const auto add_row = [&](const int row, const int width) {
          for (int c = 0; c < width; ++c)
            {
              const int column = first + c;
              // Rows of the block itself come first in all of its columns.
              const int     k     = columns.begin[column] + row - column;
              const double *value = columns.values + k;
              values.push_back(columns.diagonal_is_of_l ? *value /
                                   columns.values[columns.begin[column]]
                                                        : *value);
            }
        };
        for (int row = first + 1; row < end; ++row)
          add_row(row, row - first);
        for (int k = 0; k < n_below; ++k)
          add_row(end + k, end - first);
        blocks.push_back(block);
        first = end;
      }
    for (Block &block : blocks)
      if (block.end > block.begin)
        block.parent = block_of[rows[block.begin]];
    is_needed.assign(blocks.size(), 0);
  }



  void
  TriangularFactor::eliminate(const Block &block, double *half) const
  {
    const float *value = values.data() + block.first_value;
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
    for (std::size_t k = block.begin; k < block.end; ++k)
      {
        double sum = 0.;
        for (int c = 0; c < width; ++c)
          sum += value[c] * own[c];
        half[rows[k]] -= sum;
        value += width;
      }
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
        for (int b = block_of[entry.place]; b >= 0 && is_needed[b] == 0;
             b     = blocks[b].parent)
          {
                is_needed[b] = 1;
                half.blocks.push_back(b);
          }
      }
    std::sort(half.blocks.begin(), half.blocks.end());
    for (const int b : half.blocks)
      {
        const Block &block = blocks[b];
        eliminate(block, dense.data());
        half.values.insert(half.values.end(),
                           dense.begin() + block.first,
                           dense.begin() + block.first + block.width);
        std::fill_n(dense.begin() + block.first, block.width, 0.);
        is_needed[b] = 0;
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
      {
        const int    width = block->width;
        double      *own   = half.data() + block->first;
        const float *value = values.data() + block->first_value;
        const float *below = value + width * (width - 1) / 2;
        for (std::size_t k = block->begin; k < block->end; ++k)
          {
            const double other = half[rows[k]];
            for (int c = 0; c < width; ++c)
              own[c] -= below[c] * other;
            below += width;
          }
        for (int i = width - 1; i > 0; --i)
          {
            const float *row = value + i * (i - 1) / 2;
            for (int c = 0; c < i; ++c)
              own[c] -= row[c] * own[i];
          }
      }
    for (unsigned int i = 0; i < n(); ++i)
      solution[i] = half[place[i]];
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
