// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/body_matrix.h>
#include <solvers/matrix_entries.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  BodyMatrix::BodyMatrix(std::unique_ptr<BlockMatrix<double>> blocks)
    : by_blocks(std::move(blocks))
  {
    const auto &partitioner = by_blocks->pattern()->partitioner;
    if (partitioner->n_mpi_processes() > 1)
      ghosted.reinit(partitioner);
  }



  void
  BodyMatrix::vmult(Vector &result, const Vector &vector) const
  {
    if (by_entries)
      return by_entries->vmult(result, vector);
    with_ghosts(vector, [&](const double *from) {
      by_blocks->vmult(from, local_values(result));
    });
  }



  void
  BodyMatrix::vmult_sum(const MatrixTerm &full,
                        const MatrixTerm &isotropic,
                        Vector           &result,
                        const Vector     &vector)
  {
    full.matrix->with_ghosts(vector, [&](const double *from) {
      full.matrix->blocks()->vmult_sum(full.weight,
                                       isotropic.weight,
                                       *isotropic.matrix->blocks(),
                                       from,
                                       local_values(result));
    });
  }



  void
  BodyMatrix::with_ghosts(
    const Vector                                    &vector,
    const std::function<void(const double *values)> &action) const
  {
    const double *from = local_values(vector);
    if (ghosted.size() == 0)
      return action(from);
    std::copy(from, from + ghosted.locally_owned_size(), ghosted.begin());
    ghosted.update_ghost_values();
    action(ghosted.begin());
    ghosted.zero_out_ghost_values();
  }



  void
  BodyMatrix::for_each_row(const RowAction                 &action,
                           const std::vector<unsigned int> *numbers) const
  {
    std::vector<types::global_dof_index> indices;
    if (by_entries)
      {
        const MatrixEntries matrix(*by_entries);
        std::vector<double> values;
        const std::size_t n_rows = numbers ? numbers->size() : matrix.n_rows();
        for (std::size_t k = 0; k < n_rows; ++k)
          {
            const unsigned int r = numbers ? (*numbers)[k] : k;
            const int first = matrix.begin[r], end = matrix.begin[r + 1];
            indices.clear();
            for (int e = first; e < end; ++e)
              indices.push_back(matrix.column_index(matrix.column[e]));
            values.assign(matrix.value + first, matrix.value + end);
            action(r, indices, values);
          }
        return;
      }
    const Utilities::MPI::Partitioner &partitioner =
      *by_blocks->pattern()->partitioner;
    by_blocks->for_each_row(
      [&](const unsigned int               r,
          const std::vector<unsigned int> &columns,
          const std::vector<double>       &values) {
        indices.clear();
        for (const unsigned int column : columns)
          indices.push_back(partitioner.local_to_global(column));
        action(r, indices, values);
      },
      numbers);
  }



  void
  BodyMatrix::add_to(const double factor, Matrix &matrix) const
  {
    if (by_entries)
      {
        matrix.add(factor, *by_entries);
        return;
      }
    // Entries are found by the matrix's own columns on this rank: a search for each
    // one by its index takes longer than all the rest.
    const MatrixEntries                entries(matrix);
    double *const                      value = entry_values(matrix);
    const Utilities::MPI::Partitioner &partitioner =
      *by_blocks->pattern()->partitioner;
    const auto       first = partitioner.local_range().first;
    std::vector<int> column_of(partitioner.locally_owned_size() +
                               partitioner.n_ghost_indices());
    for (unsigned int c = 0; c < column_of.size(); ++c)
      column_of[c] = entries.column_number(partitioner.local_to_global(c));
    std::vector<int> place_of(entries.n_columns(), -1);
    by_blocks->for_each_row([&](const unsigned int               r,
                                const std::vector<unsigned int> &columns,
                                const std::vector<double>       &values) {
      const int row   = entries.row_number(first + r);
      const int begin = entries.begin[row], end = entries.begin[row + 1];
      for (int e = begin; e < end; ++e)
        place_of[entries.column[e]] = e;
      for (unsigned int k = 0; k < columns.size(); ++k)
        {
          const int column = column_of[columns[k]];
          const int place  = column < 0 ? -1 : place_of[column];
          AssertThrow(place >= 0 || values[k] == 0.,
                      ExcMessage("The matrix lacks an entry."));
          if (place >= 0)
            value[place] += factor * values[k];
        }
      for (int e = begin; e < end; ++e)
        place_of[entries.column[e]] = -1;
    });
  }



  void
  BodyMatrix::copy_to(Matrix &matrix) const
  {
    if (by_entries)
      {
        matrix.copy_from(*by_entries);
        return;
      }
    const IndexSet         owned = locally_owned_range_indices();
    DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
    for_each_row([&](const unsigned int                          r,
                     const std::vector<types::global_dof_index> &columns,
                     const std::vector<double> &) {
      pattern.add_entries(owned.nth_index_in_set(r),
                          columns.begin(),
                          columns.end());
    });
    matrix.reinit(owned, pattern, get_mpi_communicator());
    add_to(1., matrix);
  }



  void
  BodyMatrix::add_diagonal(const double factor, Vector &diagonal) const
  {
    double *values = local_values(diagonal);
    if (by_entries)
      {
        const MatrixEntries matrix(*by_entries);
        for (unsigned int r = 0; r < matrix.n_rows(); ++r)
          if (const int k =
                matrix.find(r, matrix.column_number(matrix.row_index(r)));
              k >= 0)
            values[r] += factor * matrix.value[k];
      }
    else
      for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
        values[i] += factor * by_blocks->diagonal_entry(i);
  }



  double
  BodyMatrix::linfty_norm() const
  {
    if (by_entries)
      return by_entries->linfty_norm();
    const double largest = by_blocks->linfty_norm();
    return Utilities::MPI::max(largest, get_mpi_communicator());
  }



  types::global_dof_index
  BodyMatrix::m() const
  {
    return by_entries ? by_entries->m()
                      : by_blocks->pattern()->partitioner->size();
  }



  MPI_Comm
  BodyMatrix::get_mpi_communicator() const
  {
    return by_entries
      ? by_entries->get_mpi_communicator()
      : by_blocks->pattern()->partitioner->get_mpi_communicator();
  }



  IndexSet
  BodyMatrix::locally_owned_range_indices() const
  {
    return by_entries
      ? by_entries->locally_owned_range_indices()
      : by_blocks->pattern()->partitioner->locally_owned_range();
  }



  std::size_t
  BodyMatrix::memory_consumption() const
  {
    if (!by_entries)
      return by_blocks->memory_consumption();
    const MatrixEntries matrix(*by_entries);
    return 12 * matrix.size() + 4 * matrix.n_rows();
  }
} // namespace Ricochet
