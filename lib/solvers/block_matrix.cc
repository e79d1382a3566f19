// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/block_matrix.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The number on this rank of each column of @p matrix.
    std::vector<unsigned int>
    local_columns(const Epetra_CrsMatrix            &matrix,
                  const Utilities::MPI::Partitioner &partitioner)
    {
      std::vector<unsigned int> columns(matrix.NumMyCols());
      for (unsigned int c = 0; c < columns.size(); ++c)
        columns[c] = partitioner.global_to_local(matrix.GCID64(c));
      return columns;
    }



    /// Call @p action(column, value) for the entries of row @p r.
    template <typename Action>
    void
    for_each_entry(const Epetra_CrsMatrix &matrix,
                   const int               r,
                   const Action           &action)
    {
      int     n_entries = 0;
      double *values    = nullptr;
      int    *indices   = nullptr;
      matrix.ExtractMyRowView(r, n_entries, values, indices);
      for (int e = 0; e < n_entries; ++e)
        action(indices[e], values[e]);
    }
  } // namespace



  BlockPattern::BlockPattern(const MatrixSum &matrices,
                             const std::vector<types::global_dof_index> &others,
                             const unsigned int                          dim)
    : dim(dim)
  {
    const Matrix  &first = *matrices.front().matrix;
    const IndexSet owned = first.locally_owned_range_indices();
    // Ghosts, each node with all of its unknowns.
    std::vector<types::global_dof_index> ghosts;
    const auto add_ghost = [&](const types::global_dof_index unknown) {
      if (!owned.is_element(unknown))
        for (unsigned int c = 0; c < dim; ++c)
          ghosts.push_back(unknown / dim * dim + c);
    };
    for (const auto unknown : others)
      add_ghost(unknown);
    for (const MatrixTerm &term : matrices)
      {
        const Epetra_CrsMatrix &epetra = term.matrix->trilinos_matrix();
        for (int c = 0; c < epetra.NumMyCols(); ++c)
          add_ghost(epetra.GCID64(c));
      }
    std::sort(ghosts.begin(), ghosts.end());
    IndexSet ghost_set(owned.size());
    ghost_set.add_indices(ghosts.begin(), ghosts.end());
    partitioner = std::make_shared<Utilities::MPI::Partitioner>(
      owned,
      ghost_set,
      first.get_mpi_communicator());
    AssertThrow(owned.n_elements() % dim == 0 &&
                  partitioner->local_range().first % dim == 0,
                ExcMessage("The unknowns of a node do not stand together."));

    const unsigned int                     n = owned.n_elements() / dim;
    std::vector<std::vector<unsigned int>> columns;
    for (const MatrixTerm &term : matrices)
      columns.push_back(
        local_columns(term.matrix->trilinos_matrix(), *partitioner));
    begin.reserve(n + 1);
    begin.push_back(0);
    ghosts_begin.reserve(n);
    std::vector<unsigned int> last_row(n + ghost_set.n_elements() / dim,
                                       numbers::invalid_unsigned_int);
    for (unsigned int i = 0; i < n; ++i)
      {
        for (unsigned int k = 0; k < matrices.size(); ++k)
          for (unsigned int c = 0; c < dim; ++c)
            for_each_entry(matrices[k].matrix->trilinos_matrix(),
                           i * dim + c,
                           [&](const int entry_column, double) {
                             const unsigned int j =
                               columns[k][entry_column] / dim;
                             if (j > i && last_row[j] != i)
                               {
                                 last_row[j] = i;
                                 column.push_back(j);
                               }
                           });
        const auto row = column.begin() + begin.back();
        std::sort(row, column.end());
        ghosts_begin.push_back(std::lower_bound(row, column.end(), n) -
                               column.begin());
        begin.push_back(column.size());
      }
    column.shrink_to_fit();
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
  BlockMatrix<Number>::BlockMatrix(std::shared_ptr<const BlockPattern> pattern)
    : places(std::move(pattern))
    , diagonal(places->n_rows() * places->dim * places->dim, Number(0))
    , blocks(places->column.size() * places->dim * places->dim, Number(0))
  {}



  template <typename Number>
  void
  BlockMatrix<Number>::add(const double factor, const Matrix &matrix)
  {
    const Epetra_CrsMatrix         &epetra = matrix.trilinos_matrix();
    const unsigned int              dim = places->dim, n = places->n_rows();
    const std::vector<unsigned int> local =
      local_columns(epetra, *places->partitioner);
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
            epetra,
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
            // Half from each side of the diagonal, and all of what is one-sided.
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



  template <typename Number>
  template <int dim>
  void
  BlockMatrix<Number>::multiply(const Number *from, Number *to) const
  {
    const unsigned int *const column = places->column.data();
    for (unsigned int i = 0; i < places->n_rows(); ++i)
      {
        Number own[dim], sum[dim];
        for (int c = 0; c < dim; ++c)
          own[c] = from[i * dim + c];
        const auto add =
          [](const Number *block, const Number *vector, Number *result) {
            for (int c = 0; c < dim; ++c)
              {
                Number product = block[c * dim] * vector[0];
                for (int d = 1; d < dim; ++d)
                  product += block[c * dim + d] * vector[d];
                result[c] += product;
              }
          };
        for (int c = 0; c < dim; ++c)
          sum[c] = to[i * dim + c];
        add(diagonal.data() + i * dim * dim, own, sum);
        std::size_t       k   = places->begin[i];
        const std::size_t mid = places->ghosts_begin[i];
        for (; k < mid; ++k)
          {
            const Number *block = blocks.data() + k * dim * dim;
            const Number *other = from + column[k] * dim;
            Number       *below = to + column[k] * dim;
            add(block, other, sum);
            // The block to the left of the diagonal is its transpose.
            for (int d = 0; d < dim; ++d)
              {
                Number product = block[d] * own[0];
                for (int c = 1; c < dim; ++c)
                  product += block[c * dim + d] * own[c];
                below[d] += product;
              }
          }
        for (; k < places->begin[i + 1]; ++k)
          add(blocks.data() + k * dim * dim, from + column[k] * dim, sum);
        for (int c = 0; c < dim; ++c)
          to[i * dim + c] = sum[c];
      }
  }



  template <typename Number>
  void
  BlockMatrix<Number>::vmult(VectorType &result, const VectorType &vector) const
  {
    vector.update_ghost_values();
    result = Number(0);
    if (places->dim == 3)
      multiply<3>(vector.begin(), result.begin());
    else if (places->dim == 2)
      multiply<2>(vector.begin(), result.begin());
    else
      multiply<1>(vector.begin(), result.begin());
    vector.zero_out_ghost_values();
  }



  template <typename Number>
  Number
  BlockMatrix<Number>::diagonal_entry(const types::global_dof_index i) const
  {
    const unsigned int local = places->partitioner->global_to_local(i);
    const unsigned int c     = local % places->dim;
    return diagonal[local * places->dim + c];
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
