// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/body_matrix.h>

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
      by_blocks->vmult(from, result.trilinos_vector()[0]);
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
                                       result.trilinos_vector()[0]);
    });
  }



  void
  BodyMatrix::with_ghosts(
    const Vector                                    &vector,
    const std::function<void(const double *values)> &action) const
  {
    const double *from = vector.trilinos_vector()[0];
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
        const Epetra_CrsMatrix &epetra = by_entries->trilinos_matrix();
        std::vector<double>     values;
        const std::size_t       n_rows =
          numbers ? numbers->size() : epetra.NumMyRows();
        for (std::size_t k = 0; k < n_rows; ++k)
          {
            const unsigned int r         = numbers ? (*numbers)[k] : k;
            int                n_entries = 0;
            double            *row       = nullptr;
            int               *columns   = nullptr;
            epetra.ExtractMyRowView(r, n_entries, row, columns);
            indices.clear();
            for (int e = 0; e < n_entries; ++e)
              indices.push_back(epetra.GCID64(columns[e]));
            values.assign(row, row + n_entries);
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
    // Entries are found by where the matrix has its columns on this rank: to look up
    // each by its index takes longer than all the rest.
    using EpetraIndex = TrilinosWrappers::types::int_type;
    const Epetra_CrsMatrix            &epetra = matrix.trilinos_matrix();
    const Utilities::MPI::Partitioner &partitioner =
      *by_blocks->pattern()->partitioner;
    const auto       first = partitioner.local_range().first;
    std::vector<int> column_of(partitioner.locally_owned_size() +
                               partitioner.n_ghost_indices());
    for (unsigned int c = 0; c < column_of.size(); ++c)
      column_of[c] =
        epetra.LCID(static_cast<EpetraIndex>(partitioner.local_to_global(c)));
    std::vector<int> place_of(epetra.NumMyCols(), -1);
    by_blocks->for_each_row([&](const unsigned int               r,
                                const std::vector<unsigned int> &columns,
                                const std::vector<double>       &values) {
      int     n_entries = 0;
      double *row       = nullptr;
      int    *indices   = nullptr;
      epetra.ExtractMyRowView(epetra.LRID(static_cast<EpetraIndex>(first + r)),
                              n_entries,
                              row,
                              indices);
      for (int e = 0; e < n_entries; ++e)
        place_of[indices[e]] = e;
      for (unsigned int k = 0; k < columns.size(); ++k)
        {
          const int column = column_of[columns[k]];
          const int place  = column < 0 ? -1 : place_of[column];
          AssertThrow(place >= 0 || values[k] == 0.,
                      ExcMessage("The matrix lacks an entry."));
          if (place >= 0)
            row[place] += factor * values[k];
        }
      for (int e = 0; e < n_entries; ++e)
        place_of[indices[e]] = -1;
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
    double *values = diagonal.trilinos_vector()[0];
    if (by_entries)
      {
        Vector    own(diagonal);
        const int error = by_entries->trilinos_matrix().ExtractDiagonalCopy(
          *own.trilinos_vector()(0));
        AssertThrow(error == 0, ExcTrilinosError(error));
        diagonal.add(factor, own);
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
    return by_entries ? 12 * by_entries->trilinos_matrix().NumMyNonzeros() +
        4 * by_entries->trilinos_matrix().NumMyRows()
                      : by_blocks->memory_consumption();
  }
} // namespace Ricochet
