// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/threads.h>
#include <solvers/triangular_factor.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <type_traits>

namespace Ricochet
{
  namespace
  {
    // Two or four values at once, without alignment.
    template <typename Value>
    using Pair __attribute__((vector_size(2 * sizeof(Value)),
                              aligned(sizeof(Value)),
                              may_alias)) = Value;
    template <typename Value>
    using Quad __attribute__((vector_size(4 * sizeof(Value)),
                              aligned(sizeof(Value)),
                              may_alias))             = Value;
    using DoublePair                                  = Pair<double>;
    using DoubleQuad __attribute__((vector_size(32))) = double;

    template <typename Value>
    inline DoublePair
    pair(const Value *values)
    {
      return __builtin_convertvector(*reinterpret_cast<const Pair<Value> *>(
                                       values),
                                     DoublePair);
    }

    template <typename Value>
    inline DoubleQuad
    quad(const Value *values)
    {
      return __builtin_convertvector(*reinterpret_cast<const Quad<Value> *>(
                                       values),
                                     DoubleQuad);
    }

    inline DoublePair &
    at(double *values)
    {
      return *reinterpret_cast<DoublePair *>(values);
    }

    // Largest width of a block, and largest part of it that is filled up with zeros:
    // below that, wider blocks are faster.
    constexpr int    largest_width = 8;
    constexpr double zeros         = .3;

    /// Call @p action with @p width as a compile-time constant.
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



  template <typename Value>
  std::vector<std::array<int, 2>>
  TriangularFactor<Value>::find_blocks(const Columns &columns)
  {
    const auto n_below = [&](const int column) {
      return columns.n_entries[column] - 1;
    };
    std::vector<std::array<int, 2>> ranges;
    double                          n_zeros = 0.;
    for (int first = 0; first < columns.n;)
      {
        // Columns with the same rows below, as sparse factorisations find them.
        int end = first + 1;
        while (
          end < columns.n && end - first < largest_width &&
          n_below(end - 1) == n_below(end) + 1 &&
          std::equal(columns.rows + columns.begin[end],
                     columns.rows + columns.begin[end] + columns.n_entries[end],
                     columns.rows + columns.begin[end - 1] + 1))
          ++end;

        // Merge with the block before, if its rows below include this block and
        // few entries are missing.
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



  template <typename Value>
  TriangularFactor<Value>::TriangularFactor(const Columns &columns)
    : place(columns.n)
    , unknown(columns.order, columns.order + columns.n)
    , block_of(columns.n)
    , inverse_diagonal(columns.n)
  {
    for (int k = 0; k < columns.n; ++k)
      place[columns.order[k]] = k;

    std::size_t n_values = 0;
    for (const auto &[first, end] : find_blocks(columns))
      {
        const int  width   = end - first;
        const int *below   = columns.rows + columns.begin[end - 1] + 1;
        const int  n_below = columns.n_entries[end - 1] - 1;
        Block      block{first,
                    width,
                    first_rows.size(),
                    0,
                    n_values,
                    n_values + width * (width - 1) / 2,
                    n_below > 0 ? below[0] : -1};
        std::fill_n(block_of.begin() + first, width, blocks.size());
        for (int k = 0; k < n_below;)
          {
            const bool has_second =
              k + 1 < n_below && below[k + 1] == below[k] + 1;
            // The last row of a tree is paired with the one before it: the next row
            // belongs to another thread, or does not exist.
            const bool is_second =
              !has_second && columns.n_entries[below[k]] == 1;
            first_rows.push_back(is_second ? below[k] - 1 : below[k]);
            k += has_second ? 2 : 1;
          }
        block.end = first_rows.size();
        n_values  = block.below + 2 * width * (block.end - block.begin);
        blocks.push_back(block);
      }

    values.assign(n_values, Value(0));
    // Index of the first entry of a row in its block.
    std::vector<std::size_t> row_at(columns.n);
    for (Block &block : blocks)
      {
        const int   width = block.width, end = block.first + width;
        std::size_t at = block.below;
        for (std::size_t k = block.begin; k < block.end; ++k, at += 2 * width)
          {
            row_at[first_rows[k]]     = at;
            row_at[first_rows[k] + 1] = at + 1;
          }
        // The row before the last one of a tree may be among the pairs, too.
        for (int i = 0; i < width; ++i)
          row_at[block.first + i] = block.triangle + i * (i - 1) / 2;
        for (int c = 0; c < width; ++c)
          {
            const int     column = block.first + c;
            const double *value  = columns.values + columns.first_value[column];
            const int    *row    = columns.rows + columns.begin[column];
            const int    *rows_end = row + columns.n_entries[column];
            const double  scale = columns.diagonal_is_of_l ? 1. / *value : 1.;
            inverse_diagonal[column] = columns.sign[columns.order[column]] *
              (columns.diagonal_is_of_l ? scale * scale : 1. / *value);
            for (++row, ++value; row != rows_end && *row < end; ++row, ++value)
              values[row_at[*row] + c] = static_cast<Value>(*value * scale);
            for (; row != rows_end; ++row, ++value)
              values[row_at[*row] + 2 * c] = static_cast<Value>(*value * scale);
          }
        if (block.parent >= 0)
          block.parent = block_of[block.parent];
      }
    is_needed.assign(blocks.size(), 0);
    row_of_block.assign(blocks.size(), -1);

    int last_parent = -1;
    for (unsigned int b = 0; b < blocks.size(); ++b)
      {
        if (last_parent < static_cast<int>(b))
          {
            trees.push_back(b);
            values_before.push_back(blocks[b].triangle);
          }
        last_parent = std::max(last_parent, blocks[b].parent);
      }
    trees.push_back(blocks.size());
    values_before.push_back(n_values);
  }



  template <typename Value>
  template <typename Action>
  void
  TriangularFactor<Value>::for_each_part(const Action &action) const
  {
    Threads::for_each_balanced_part(trees, values_before, 20000, action);
  }



  template <typename Value>
  void
  TriangularFactor<Value>::eliminate(const Block &block, double *forward) const
  {
    with_width(block.width,
               [forward, seen = view(block, forward)](const auto width) {
                 const auto [own, triangle, below, rows, rows_end] = seen;
                 const Value *value                                = triangle;
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
                   for (const int *row = rows; row != rows_end;
                        ++row, value += 2 * width)
                     {
                       DoublePair sum = pair(value) * own[0];
                       for (int c = 1; c < width; ++c)
                         sum += pair(value + 2 * c) * own[c];
                       at(forward + *row) -= sum;
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
                         at(forward + *row) -= DoublePair{sum[0], sum[1]} +
                           DoublePair{sum[2], sum[3]};
                       }
                   }
               });
  }



  template <typename Value>
  void
  TriangularFactor<Value>::substitute(const Block &block, double *forward) const
  {
    with_width(
      block.width,
      [forward, seen = view(block, forward)](const auto width) {
        const auto [own, triangle, below, rows, rows_end] = seen;
        // In descending order in each block, as are the blocks.
        const Value *value = below + 2 * width * (rows_end - rows);
        if constexpr (std::is_same_v<decltype(width), const int>)
          {
            DoublePair sums[largest_width] = {};
            for (const int *row = rows_end; row-- != rows;)
              {
                value -= 2 * width;
                const DoublePair values = at(forward + *row);
                for (int c = 0; c < width; ++c)
                  sums[c] += pair(value + 2 * c) * values;
              }
            for (int c = 0; c < width; ++c)
              own[c] -= sums[c][0] + sums[c][1];
          }
        else
          {
            DoubleQuad sums[width / 2] = {};
            for (const int *row = rows_end; row-- != rows;)
              {
                value -= 2 * width;
                const DoublePair two = at(forward + *row);
                const DoubleQuad values{two[0], two[1], two[0], two[1]};
                for (int c = 0; c < width / 2; ++c)
                  sums[c] += quad(value + 4 * c) * values;
              }
            for (int c = 0; c < width; ++c)
              own[c] -= sums[c / 2][c % 2 * 2] + sums[c / 2][c % 2 * 2 + 1];
          }
        for (int i = width - 1; i > 0; --i)
          {
            const Value *row = triangle + i * (i - 1) / 2;
            for (int c = 0; c < i; ++c)
              own[c] -= row[c] * own[i];
          }
      });
  }



  template <typename Value>
  void
  TriangularFactor<Value>::mark(int block, std::vector<int> &region) const
  {
    for (; block >= 0 && is_needed[block] == 0; block = blocks[block].parent)
      {
        is_needed[block] = 1;
        region.push_back(block);
      }
  }



  template <typename Value>
  void
  TriangularFactor<Value>::finish(std::vector<int> &region) const
  {
    std::sort(region.begin(), region.end());
    for (const int block : region)
      is_needed[block] = 0;
  }



  template <typename Value>
  void
  TriangularFactor<Value>::forward(const double        *right_hand_side,
                                   std::vector<double> &forward) const
  {
    forward.resize(n());
    for_each_part([&](const unsigned int begin, const unsigned int end) {
      for (int k = first_place(begin); k < first_place(end); ++k)
        forward[k] = right_hand_side[unknown[k]];
      for (unsigned int b = begin; b < end; ++b)
        eliminate(blocks[b], forward.data());
    });
  }



  namespace
  {
    constexpr unsigned int n_columns = TriangularSolves::n_columns;

    /// Values of a row in all columns.
    using Row = Eigen::Matrix<double, n_columns, 1>;
  } // namespace



  template <typename Value>
  template <typename ColumnsOf>
  void
  TriangularFactor<Value>::eliminate_columns(const Block     &block,
                                             double          *own,
                                             const ColumnsOf &columns_of) const
  {
    const auto   seen   = view(block, nullptr);
    const int    width  = block.width;
    const Value *value  = seen.triangle;
    const auto   own_at = [own](const int c) {
      return Eigen::Map<Row>(own + c * n_columns);
    };
    for (int i = 1; i < width; ++i)
      for (int c = 0; c < i; ++c)
        own_at(i) -= *value++ * own_at(c);
    value = seen.below;
    for (const int *row = seen.rows; row != seen.rows_end; ++row)
      {
        Row sums[2] = {Row::Zero(), Row::Zero()};
        for (int c = 0; c < width; ++c, value += 2)
          for (int k = 0; k < 2; ++k)
            sums[k] += value[k] * own_at(c);
        // The row that completes a pair may be on no path.
        for (int k = 0; k < 2; ++k)
          if (double *const target = columns_of(*row + k))
            Eigen::Map<Row>(target) -= sums[k];
      }
  }



  template <typename Value>
  TriangularSolves::ForwardColumns
  TriangularFactor<Value>::forward(
    const Functionals               &rows,
    const std::vector<unsigned int> &numbers) const
  {
    ForwardColumns columns;
    const auto     for_each_entry = [&](const auto &action) {
      for (unsigned int c = 0; c < numbers.size(); ++c)
        for (std::size_t k = rows.begin[numbers[c]];
             k < rows.begin[numbers[c] + 1];
             ++k)
          action(c, place[rows.index[k]], rows.value[k]);
    };
    for_each_entry([&](const unsigned int, const int at, const double) {
      mark(block_of[at], columns.blocks);
    });
    finish(columns.blocks);
    int n_rows = 0;
    for (const int b : columns.blocks)
      {
        row_of_block[b] = n_rows;
        n_rows += blocks[b].width;
      }
    columns.values.assign(static_cast<std::size_t>(n_rows) * n_columns, 0.);
    const auto columns_of = [&](const int at) -> double * {
      const int row = row_of_block[block_of[at]];
      return row < 0 ? nullptr
                     : columns.values.data() +
          static_cast<std::size_t>(row + at - blocks[block_of[at]].first) *
            n_columns;
    };
    for_each_entry([&](const unsigned int c, const int at, const double value) {
      columns_of(at)[c] += value;
    });
    for (const int b : columns.blocks)
      eliminate_columns(blocks[b], columns_of(blocks[b].first), columns_of);
    for (const int b : columns.blocks)
      row_of_block[b] = -1;
    return columns;
  }



  template <typename Value>
  void
  TriangularFactor<Value>::backward(std::vector<double> &forward,
                                    double              *solution) const
  {
    for_each_part([&](const unsigned int begin, const unsigned int end) {
      for (int k = first_place(begin); k < first_place(end); ++k)
        forward[k] *= inverse_diagonal[k];
      for (unsigned int b = end; b-- > begin;)
        substitute(blocks[b], forward.data());
      for (int k = first_place(begin); k < first_place(end); ++k)
        solution[unknown[k]] = forward[k];
    });
  }



  template <typename Value>
  std::vector<int>
  TriangularFactor<Value>::region_of(const std::vector<Index> &unknowns) const
  {
    std::vector<int> region;
    for (const Index unknown : unknowns)
      mark(block_of[place[unknown]], region);
    finish(region);
    return region;
  }



  template <typename Value>
  void
  TriangularFactor<Value>::backward(const std::vector<double> &forward,
                                    const std::vector<int>    &region,
                                    std::vector<double>       &solution) const
  {
    solution.resize(n());
    for (const int b : region)
      for (int k = blocks[b].first; k < blocks[b].first + blocks[b].width; ++k)
        solution[k] = inverse_diagonal[k] * forward[k];
    for (auto b = region.rbegin(); b != region.rend(); ++b)
      substitute(blocks[*b], solution.data());
  }



  template <typename Value>
  void
  TriangularFactor<Value>::multiply(const ForwardColumns &one,
                                    const ForwardColumns &other,
                                    std::vector<double>  &products) const
  {
    using Columns =
      Eigen::Matrix<double, Eigen::Dynamic, n_columns, Eigen::RowMajor>;
    using Products =
      Eigen::Matrix<double, n_columns, n_columns, Eigen::RowMajor>;
    Products sum = Products::Zero();
    Columns  scaled;
    // Consecutive rows in both.
    const auto add_rows = [&](const double *left,
                              const double *right,
                              const int     first,
                              const int     n) {
      scaled =
        Eigen::Map<const Eigen::VectorXd>(inverse_diagonal.data() + first, n)
          .asDiagonal() *
        Eigen::Map<const Columns>(right, n, n_columns);
      sum.noalias() +=
        Eigen::Map<const Columns>(left, n, n_columns).transpose() * scaled;
    };
    const double *left = one.values.data(), *right = other.values.data();
    auto          l = one.blocks.begin(), r = other.blocks.begin();
    const auto    pass = [&](auto &block, const double *&values) {
      values += blocks[*block].width * n_columns;
      ++block;
    };
    while (l != one.blocks.end() && r != other.blocks.end())
      if (*l < *r)
        pass(l, left);
      else if (*r < *l)
        pass(r, right);
      else
        {
          const double *first_left = left, *first_right = right;
          const int     first = blocks[*l].first;
          int           end   = first;
          while (l != one.blocks.end() && r != other.blocks.end() && *l == *r &&
                 blocks[*l].first == end)
            {
              end += blocks[*l].width;
              pass(l, left);
              pass(r, right);
            }
          add_rows(first_left, first_right, first, end - first);
        }
    products.assign(sum.data(), sum.data() + n_columns * n_columns);
  }



  template <typename Value>
  void
  TriangularFactor<Value>::add(const ForwardColumns &columns,
                               const double         *coefficients,
                               std::vector<double>  &forward) const
  {
    const double *value = columns.values.data();
    for (const int b : columns.blocks)
      for (int k = blocks[b].first; k < blocks[b].first + blocks[b].width;
           ++k, value += n_columns)
        for (unsigned int c = 0; c < n_columns; ++c)
          forward[k] += coefficients[c] * value[c];
  }



  template class TriangularFactor<float>;
  template class TriangularFactor<double>;
} // namespace Ricochet
