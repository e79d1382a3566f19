// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/united_pattern.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

#include <Epetra_CrsGraph.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  void
  UnitedPattern::update(const TrilinosWrappers::SparsityPattern &body,
                        const Couplings                         &couplings)
  {
    if (version == couplings.version && version != 0)
      return;
    version              = couplings.version;
    const IndexSet owned = body.locally_owned_range_indices();
    IndexSet       rows  = owned;
    for (const auto &list : couplings.lists)
      rows.add_indices(list.begin(), list.end());
    rows.compress();

    DynamicSparsityPattern all(owned.size(), owned.size(), rows);
    const Epetra_CrsGraph &graph = body.trilinos_sparsity_pattern();
    std::vector<types::global_dof_index> columns;
    for (int row = 0; row < graph.NumMyRows(); ++row)
      {
        int  n       = 0;
        int *indices = nullptr;
        graph.ExtractMyRowView(row, n, indices);
        columns.clear();
        for (int k = 0; k < n; ++k)
          columns.push_back(graph.GCID64(indices[k]));
        std::sort(columns.begin(), columns.end());
        all.add_entries(graph.GRID64(row),
                        columns.begin(),
                        columns.end(),
                        true);
      }
    for (const auto &list : couplings.lists)
      for (const auto row : list)
        all.add_entries(row, list.begin(), list.end(), true);
    const MPI_Comm communicator = body.get_mpi_communicator();
    SparsityTools::distribute_sparsity_pattern(all, owned, communicator, rows);
    united.reinit(owned, all, communicator);

    Matrix matrix;
    matrix.reinit(united);
    find_places(body, matrix);
  }



  void
  UnitedPattern::find_places(const TrilinosWrappers::SparsityPattern &body,
                             const Matrix &united_matrix)
  {
    const Epetra_CrsGraph  &graph  = body.trilinos_sparsity_pattern();
    const Epetra_CrsMatrix &epetra = united_matrix.trilinos_matrix();
    int                    *begin = nullptr, *columns = nullptr;
    double                 *values = nullptr;
    epetra.ExtractCrsDataPointers(begin, columns, values);
    places.clear();
    places.reserve(graph.NumMyNonzeros());
    for (int row = 0; row < graph.NumMyRows(); ++row)
      {
        int  n       = 0;
        int *indices = nullptr;
        graph.ExtractMyRowView(row, n, indices);
        for (int k = 0; k < n; ++k)
          {
            const int  column = epetra.LCID(graph.GCID64(indices[k]));
            const int *entry =
              std::find(columns + begin[row], columns + begin[row + 1], column);
            Assert(entry != columns + begin[row + 1], ExcInternalError());
            places.push_back(entry - columns);
          }
      }
  }



  void
  UnitedPattern::embed(const Matrix &body, Matrix &matrix) const
  {
    if (matrix.m() == 0)
      matrix.reinit(united);
    else
      matrix = 0.;
    Assert(matrix.n_nonzero_elements() == united.n_nonzero_elements(),
           ExcMessage("The matrix is on another pattern."));
    int    *begin = nullptr, *columns = nullptr;
    double *from = nullptr, *to = nullptr;
    body.trilinos_matrix().ExtractCrsDataPointers(begin, columns, from);
    const_cast<Epetra_CrsMatrix &>(matrix.trilinos_matrix())
      .ExtractCrsDataPointers(begin, columns, to);
    for (std::size_t k = 0; k < places.size(); ++k)
      to[places[k]] = from[k];
  }
} // namespace Ricochet
