// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/threads.h>
#include <solvers/block_matrix.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The local number of each column of @p matrix.
    std::vector<unsigned int>
    local_columns(const MatrixEntries               &matrix,
                  const Utilities::MPI::Partitioner &partitioner)
    {
      std::vector<unsigned int> columns(matrix.n_columns());
      for (unsigned int c = 0; c < columns.size(); ++c)
        columns[c] = partitioner.global_to_local(matrix.column_index(c));
      return columns;
    }



    /// Call @p action(column, value) for the entries of row @p r.
    template <typename Action>
    void
    for_each_entry(const MatrixEntries &matrix,
                   const int            r,
                   const Action        &action)
    {
      for (int k = matrix.begin[r]; k < matrix.begin[r + 1]; ++k)
        action(matrix.column[k], matrix.value[k]);
    }
  } // namespace



  BlockPattern::BlockPattern(const std::vector<MatrixEntries> &matrices,
                             const std::vector<types::global_dof_index> &others,
                             const unsigned int                          dim,
                             const MPI_Comm communicator)
    : dim(dim)
  {
    const IndexSet owned = matrices.front().row_indices();
    // Ghosts, with all unknowns of each node.
    std::vector<types::global_dof_index> ghosts;
    const auto add_ghost = [&](const types::global_dof_index unknown) {
      if (!owned.is_element(unknown))
        for (unsigned int c = 0; c < dim; ++c)
          ghosts.push_back(unknown / dim * dim + c);
    };
    for (const auto unknown : others)
      add_ghost(unknown);
    for (const MatrixEntries &matrix : matrices)
      for (unsigned int c = 0; c < matrix.n_columns(); ++c)
        add_ghost(matrix.column_index(c));
    std::sort(ghosts.begin(), ghosts.end());
    IndexSet ghost_set(owned.size());
    ghost_set.add_indices(ghosts.begin(), ghosts.end());
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(owned,
                                                                ghost_set,
                                                                communicator);
    AssertThrow(owned.n_elements() % dim == 0 &&
                  partitioner->local_range().first % dim == 0,
                ExcMessage("The unknowns of a node do not stand together."));

    const unsigned int                     n = owned.n_elements() / dim;
    std::vector<std::vector<unsigned int>> rows(n);
    for (const MatrixEntries &matrix : matrices)
      {
        const std::vector<unsigned int> columns =
          local_columns(matrix, *partitioner);
        for (unsigned int r = 0; r < n * dim; ++r)
          for_each_entry(matrix, r, [&](const int entry_column, double) {
            // Blocks to the right of the diagonal, from entries on either side
            // of it.
            const unsigned int node = columns[entry_column] / dim;
            const auto [i, j]       = std::minmax({node, r / dim});
            if (rows[i].empty() || rows[i].back() != j)
              rows[i].push_back(j);
          });
      }
    set_rows(std::move(rows));
  }



  BlockPattern::BlockPattern(
    std::shared_ptr<const Utilities::MPI::Partitioner> partitioner,
    std::vector<std::vector<unsigned int>>           &&rows,
    const unsigned int                                 dim)
    : dim(dim)
    , partitioner(std::move(partitioner))
  {
    set_rows(std::move(rows));
  }



  void
  BlockPattern::set_rows(std::vector<std::vector<unsigned int>> &&rows)
  {
    const unsigned int n = rows.size();
    begin.reserve(n + 1);
    begin.push_back(0);
    ghosts_begin.reserve(n);
    std::size_t n_blocks = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        std::vector<unsigned int> &row = rows[i];
        std::sort(row.begin(), row.end());
        row.erase(std::unique(row.begin(), row.end()), row.end());
        row.erase(row.begin(), std::upper_bound(row.begin(), row.end(), i));
        n_blocks += row.size();
      }
    column.reserve(n_blocks);
    for (std::vector<unsigned int> &row : rows)
      {
        ghosts_begin.push_back(
          column.size() +
          (std::lower_bound(row.begin(), row.end(), n) - row.begin()));
        column.insert(column.end(), row.begin(), row.end());
        begin.push_back(column.size());
        std::vector<unsigned int>().swap(row);
      }
    unsigned int farthest = 0;
    for (unsigned int i = 0; i < n; ++i)
      {
        if (i == 0 || farthest < i)
          {
            separate.push_back(i);
            blocks_before.push_back(begin[i] + i);
          }
        if (ghosts_begin[i] > begin[i])
          farthest = std::max(farthest, column[ghosts_begin[i] - 1]);
      }
    separate.push_back(n);
    blocks_before.push_back(begin[n] + n);
  }



  std::size_t
  BlockPattern::find(const unsigned int row, const unsigned int wanted) const
  {
    const auto end = column.begin() + begin[row + 1];
    const auto place =
      std::lower_bound(column.begin() + begin[row], end, wanted);
    return place != end && *place == wanted ? place - column.begin()
                                            : column.size();
  }



  template <typename Number>
  BlockMatrix<Number>::BlockMatrix(std::shared_ptr<const BlockPattern> pattern,
                                   const bool isotropic)
    : places(std::move(pattern))
    , isotropic(isotropic)
    , size(isotropic ? 1 : places->dim * places->dim)
    , diagonal(places->n_rows() * std::size_t(size), Number(0))
    , blocks(places->column.size() * size, Number(0))
  {}



  template <typename Number>
  void
  BlockMatrix<Number>::add(const double factor, const MatrixEntries &matrix)
  {
    Assert(!isotropic, ExcNotImplemented());
    const unsigned int              dim = places->dim, n = places->n_rows();
    const std::vector<unsigned int> local =
      local_columns(matrix, *places->partitioner);
    // The blocks of a row of nodes, and the number of each column among them.
    std::vector<unsigned int> columns;
    std::vector<double>       values;
    std::vector<int>          number(places->partitioner->locally_owned_size() +
                              places->partitioner->n_ghost_indices(),
                            -1);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int c = 0; c < dim; ++c)
          for_each_entry(
            matrix,
            i * dim + c,
            [&](const int column, const double value) {
              const unsigned int j = local[column] / dim;
              if (number[j] < 0)
                {
                  number[j] = columns.size();
                  columns.push_back(j);
                  values.resize(columns.size() * dim * dim, 0.);
                }
              values[(number[j] * dim + c) * dim + local[column] % dim] +=
                factor * value;
            });
        for (unsigned int k = 0; k < columns.size(); ++k)
          {
            const unsigned int j     = columns[k];
            const double      *block = values.data() + k * dim * dim;
            number[j]                = -1;
            Number *target           = diagonal.data() + i * dim * dim;
            if (j != i)
              {
                const std::size_t place =
                  places->find(std::min(i, j), std::max(i, j));
                AssertThrow(place < places->column.size(),
                            ExcMessage("A block has no place."));
                target = blocks.data() + place * dim * dim;
              }
            // Half from each side of the diagonal, and all of entries on one
            // side only.
            const double half = j >= n ? 1. : .5;
            for (unsigned int c = 0; c < dim; ++c)
              for (unsigned int d = 0; d < dim; ++d)
                {
                  const double value = half * block[c * dim + d];
                  if (i <= j)
                    target[c * dim + d] += value;
                  if (j <= i)
                    target[d * dim + c] += value;
                }
          }
        columns.clear();
        values.clear();
      }
  }



  template <typename Number>
  void
  BlockMatrix<Number>::add(const double               factor,
                           const BlockMatrix<double> &matrix)
  {
    Assert(!isotropic, ExcNotImplemented());
    AssertThrow(places == matrix.places, ExcMessage("Other places."));
    const unsigned int dim = places->dim;
    const auto         add = [&](const auto &from, auto &to) {
      if (matrix.isotropic)
        for (std::size_t k = 0; k < from.size(); ++k)
          for (unsigned int c = 0; c < dim; ++c)
            to[k * size + c * (dim + 1)] += factor * from[k];
      else
        for (std::size_t k = 0; k < from.size(); ++k)
          to[k] += factor * from[k];
    };
    add(matrix.diagonal, diagonal);
    add(matrix.blocks, blocks);
  }



  template <typename Number>
  void
  BlockMatrix<Number>::add_cell(const std::vector<unsigned int> &unknowns,
                                const FullMatrix<double>        &cell_matrix)
  {
    const unsigned int dim = places->dim, n = places->n_rows();
    // Indices of the components of each node of the cell.
    std::vector<unsigned int> nodes, rows;
    for (unsigned int i = 0; i < unknowns.size(); ++i)
      {
        const unsigned int node   = unknowns[i] / dim;
        const auto         place  = std::find(nodes.begin(), nodes.end(), node);
        const std::size_t  number = place - nodes.begin();
        if (place == nodes.end())
          {
            nodes.push_back(node);
            rows.resize(nodes.size() * dim);
          }
        rows[number * dim + unknowns[i] % dim] = i;
      }
    for (unsigned int a = 0; a < nodes.size(); ++a)
      if (nodes[a] < n)
        for (unsigned int b = 0; b < nodes.size(); ++b)
          {
            if (nodes[b] < nodes[a])
              continue;
            Number *block = diagonal.data() + nodes[a] * std::size_t(size);
            if (a != b)
              {
                const std::size_t place = places->find(nodes[a], nodes[b]);
                AssertThrow(place < places->column.size(),
                            ExcMessage("A block has no place."));
                block = blocks.data() + place * size;
              }
            // Symmetric to the last digit.
            const auto entry = [&](const unsigned int c, const unsigned int d) {
              const unsigned int i = rows[a * dim + c], j = rows[b * dim + d];
              return .5 * (cell_matrix(i, j) + cell_matrix(j, i));
            };
            if (isotropic)
              *block += entry(0, 0);
            else
              for (unsigned int c = 0; c < dim; ++c)
                for (unsigned int d = 0; d < dim; ++d)
                  block[c * dim + d] += entry(c, d);
          }
  }



  template <typename Number>
  void
  BlockMatrix<Number>::clear(const VectorType &flags, const Number value)
  {
    const unsigned int dim = places->dim;
    const auto         clear =
      [&](Number *block, const unsigned int i, const unsigned int j) {
        for (unsigned int c = 0; c < dim; ++c)
          for (unsigned int d = 0; d < dim; ++d)
            if (flags.local_element(i * dim + c) != Number(0) ||
                flags.local_element(j * dim + d) != Number(0))
              block[c * dim + d] = i == j && c == d ? value : Number(0);
      };
    for (unsigned int i = 0; i < places->n_rows(); ++i)
      {
        clear(diagonal.data() + i * dim * dim, i, i);
        for (std::size_t k = places->begin[i]; k < places->begin[i + 1]; ++k)
          clear(blocks.data() + k * dim * dim, i, places->column[k]);
      }
  }



  namespace
  {
    /// @p result += @p block times @p vector.
    template <int dim, typename Number>
    inline void
    add_block(const Number *block, const Number *vector, Number *result)
    {
      for (int c = 0; c < dim; ++c)
        {
          Number product = block[c * dim] * vector[0];
          for (int d = 1; d < dim; ++d)
            product += block[c * dim + d] * vector[d];
          result[c] += product;
        }
    }

    /// As above, with the transposed block.
    template <int dim, typename Number>
    inline void
    add_transposed_block(const Number *block,
                         const Number *vector,
                         Number       *result)
    {
      for (int d = 0; d < dim; ++d)
        {
          Number product = block[d] * vector[0];
          for (int c = 1; c < dim; ++c)
            product += block[c * dim + d] * vector[c];
          result[d] += product;
        }
    }

    /// As above, with a multiple of the identity.
    template <int dim, typename Number>
    inline void
    add_multiple(const Number factor, const Number *vector, Number *result)
    {
      for (int c = 0; c < dim; ++c)
        result[c] += factor * vector[c];
    }
  } // namespace



  template <typename Number>
  template <int dim, typename AddDiagonal, typename Add, typename AddTransposed>
  void
  BlockMatrix<Number>::sweep(const AddDiagonal   &add_diagonal,
                             const Add           &add,
                             const AddTransposed &add_transposed,
                             const Number        *from,
                             Number              *to) const
  {
    const unsigned int *const column     = places->column.data();
    const auto                sweep_rows = [&](const unsigned int first,
                                const unsigned int last) {
      std::fill(to + std::size_t(first) * dim,
                to + std::size_t(last) * dim,
                Number(0));
      for (unsigned int i = first; i < last; ++i)
        {
          // A local copy stays in registers, even if the vectors may alias.
          Number own[dim], sum[dim];
          for (int c = 0; c < dim; ++c)
            {
              own[c] = from[std::size_t(i) * dim + c];
              sum[c] = to[std::size_t(i) * dim + c];
            }
          add_diagonal(i, own, sum);
          std::size_t k = places->begin[i];
          for (; k < places->ghosts_begin[i]; ++k)
            {
              add(k, from + std::size_t(column[k]) * dim, sum);
              add_transposed(k, own, to + std::size_t(column[k]) * dim);
            }
          for (; k < places->begin[i + 1]; ++k)
            add(k, from + std::size_t(column[k]) * dim, sum);
          for (int c = 0; c < dim; ++c)
            to[std::size_t(i) * dim + c] = sum[c];
        }
    };
    const unsigned int n = places->n_rows();
    std::fill(to + std::size_t(n) * dim,
              to + places->partitioner->locally_owned_size(),
              Number(0));
    // Bodies, each on one thread.
    Threads::for_each_balanced_part(places->separate,
                                    places->blocks_before,
                                    4000,
                                    sweep_rows);
  }



  template <typename Number>
  template <int dim, bool is_isotropic>
  void
  BlockMatrix<Number>::multiply(const Number *from, Number *to) const
  {
    const Number *const on_diagonal = diagonal.data();
    const Number *const right       = blocks.data();
    if constexpr (is_isotropic)
      {
        const auto add =
          [right](const std::size_t k, const Number *vector, Number *result) {
            add_multiple<dim>(right[k], vector, result);
          };
        sweep<dim>(
          [on_diagonal](const std::size_t i,
                        const Number     *vector,
                        Number           *result) {
            add_multiple<dim>(on_diagonal[i], vector, result);
          },
          add,
          add,
          from,
          to);
      }
    else
      sweep<dim>(
        [on_diagonal](const std::size_t i,
                      const Number     *vector,
                      Number           *result) {
          add_block<dim>(on_diagonal + i * (dim * dim), vector, result);
        },
        [right](const std::size_t k, const Number *vector, Number *result) {
          add_block<dim>(right + k * (dim * dim), vector, result);
        },
        [right](const std::size_t k, const Number *vector, Number *result) {
          add_transposed_block<dim>(right + k * (dim * dim), vector, result);
        },
        from,
        to);
  }



  template <typename Number>
  template <int dim>
  void
  BlockMatrix<Number>::multiply_sum(const Number       factor,
                                    const Number       isotropic_factor,
                                    const BlockMatrix &other,
                                    const Number      *from,
                                    Number            *to) const
  {
    // The block of the sum, kept in registers by the compiler.
    const auto sum_of = [factor, isotropic_factor](const Number *block,
                                                   const Number  multiple,
                                                   Number       *sum) {
      for (int e = 0; e < dim * dim; ++e)
        sum[e] = factor * block[e];
      for (int c = 0; c < dim; ++c)
        sum[c * (dim + 1)] += isotropic_factor * multiple;
    };
    const Number *const right          = blocks.data();
    const Number *const right_multiple = other.blocks.data();
    sweep<dim>(
      [&](const std::size_t i, const Number *vector, Number *result) {
        Number sum[dim * dim];
        sum_of(diagonal.data() + i * (dim * dim), other.diagonal[i], sum);
        add_block<dim>(sum, vector, result);
      },
      [&](const std::size_t k, const Number *vector, Number *result) {
        Number sum[dim * dim];
        sum_of(right + k * (dim * dim), right_multiple[k], sum);
        add_block<dim>(sum, vector, result);
      },
      [&](const std::size_t k, const Number *vector, Number *result) {
        Number sum[dim * dim];
        sum_of(right + k * (dim * dim), right_multiple[k], sum);
        add_transposed_block<dim>(sum, vector, result);
      },
      from,
      to);
  }



  template <typename Number>
  void
  BlockMatrix<Number>::vmult_sum(const double       factor,
                                 const double       isotropic_factor,
                                 const BlockMatrix &other,
                                 const Number      *from,
                                 Number            *to) const
  {
    Assert(!isotropic && other.isotropic && places == other.places,
           ExcNotImplemented());
    switch (places->dim)
      {
        case 1:
          return multiply_sum<1>(factor, isotropic_factor, other, from, to);
        case 2:
          return multiply_sum<2>(factor, isotropic_factor, other, from, to);
        default:
          return multiply_sum<3>(factor, isotropic_factor, other, from, to);
      }
  }



  template <typename Number>
  double
  BlockMatrix<Number>::linfty_norm() const
  {
    const unsigned int  dim = places->dim, n = places->n_rows();
    std::vector<double> sums(std::size_t(n) * dim, 0.);
    const auto          add = [&](const Number      *block,
                         const unsigned int i,
                         const unsigned int j,
                         const bool         also_left) {
      for (unsigned int c = 0; c < dim; ++c)
        for (unsigned int d = 0; d < dim; ++d)
          if (!isotropic || c == d)
            {
              const double value =
                std::abs(isotropic ? block[0] : block[c * dim + d]);
              sums[i * dim + c] += value;
              if (also_left)
                sums[j * dim + d] += value;
            }
    };
    for (unsigned int i = 0; i < n; ++i)
      {
        add(diagonal.data() + i * std::size_t(size), i, i, false);
        for (std::size_t k = places->begin[i]; k < places->begin[i + 1]; ++k)
          add(blocks.data() + k * size,
              i,
              places->column[k],
              k < places->ghosts_begin[i]);
      }
    return sums.empty() ? 0. : *std::max_element(sums.begin(), sums.end());
  }



  template <typename Number>
  void
  BlockMatrix<Number>::vmult(const Number *from, Number *to) const
  {
    switch (places->dim)
      {
        case 1:
          return multiply<1, false>(from, to);
        case 2:
          return isotropic ? multiply<2, true>(from, to)
                           : multiply<2, false>(from, to);
        default:
          return isotropic ? multiply<3, true>(from, to)
                           : multiply<3, false>(from, to);
      }
  }



  template <typename Number>
  void
  BlockMatrix<Number>::vmult(VectorType &result, const VectorType &vector) const
  {
    vector.update_ghost_values();
    vmult(vector.begin(), result.begin());
    vector.zero_out_ghost_values();
  }



  template <typename Number>
  void
  BlockMatrix<Number>::for_each_row(
    const RowAction                 &action,
    const std::vector<unsigned int> *numbers) const
  {
    // The blocks to the left of the diagonal, by row.
    const unsigned int       dim = places->dim, n = places->n_rows();
    std::vector<std::size_t> left_begin(n + 2, 0);
    const auto               for_each_left = [&](const auto &call) {
      for (unsigned int i = 0; i < n; ++i)
        for (std::size_t k = places->begin[i]; k < places->ghosts_begin[i]; ++k)
          call(i, places->column[k], k);
    };
    for_each_left([&](unsigned int, const unsigned int j, std::size_t) {
      ++left_begin[j + 2];
    });
    for (unsigned int i = 0; i < n; ++i)
      left_begin[i + 2] += left_begin[i + 1];
    std::vector<unsigned int> left_row(left_begin[n + 1]);
    std::vector<std::size_t>  left_place(left_begin[n + 1]);
    for_each_left(
      [&](const unsigned int i, const unsigned int j, const std::size_t k) {
        left_row[left_begin[j + 1]]     = i;
        left_place[left_begin[j + 1]++] = k;
      });

    std::vector<unsigned int> columns;
    std::vector<double>       values;
    const std::size_t         n_numbers =
      numbers ? numbers->size() : places->partitioner->locally_owned_size();
    for (std::size_t number = 0; number < n_numbers; ++number)
      {
        const unsigned int row = numbers ? (*numbers)[number] : number;
        const unsigned int i = row / dim, c = row % dim;
        columns.clear();
        values.clear();
        if (i >= n)
          {
            action(row, columns, values);
            continue;
          }
        const auto take = [&](const Number      *block,
                              const unsigned int j,
                              const unsigned int step,
                              const unsigned int begin) {
          for (unsigned int d = 0; d < dim; ++d)
            if (!isotropic || c == d)
              {
                columns.push_back(j * dim + d);
                values.push_back(isotropic ? block[0]
                                           : block[begin + d * step]);
              }
        };
        for (std::size_t l = left_begin[i]; l < left_begin[i + 1]; ++l)
          take(blocks.data() + left_place[l] * size, left_row[l], dim, c);
        take(diagonal.data() + i * std::size_t(size), i, 1, c * dim);
        for (std::size_t k = places->begin[i]; k < places->begin[i + 1]; ++k)
          take(blocks.data() + k * size, places->column[k], 1, c * dim);
        action(row, columns, values);
      }
  }



  template <typename Number>
  std::size_t
  BlockMatrix<Number>::memory_consumption() const
  {
    return sizeof(Number) * (diagonal.size() + blocks.size()) +
      sizeof(std::size_t) * 2 * places->begin.size() +
      sizeof(unsigned int) * places->column.size();
  }

  template class BlockMatrix<float>;
  template class BlockMatrix<double>;
} // namespace Ricochet
