// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/matrix_entries.h>
#include <solvers/united_pattern.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparsity_tools.h>

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
    Matrix                 on_body, on_both;
    on_body.reinit(body);
    const MatrixEntries                  from(on_body);
    std::vector<types::global_dof_index> columns;
    for (unsigned int row = 0; row < from.n_rows(); ++row)
      {
        columns.clear();
        for (int k = from.begin[row]; k < from.begin[row + 1]; ++k)
          columns.push_back(from.column_index(from.column[k]));
        std::sort(columns.begin(), columns.end());
        all.add_entries(from.row_index(row),
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

    on_both.reinit(united);
    const MatrixEntries to(on_both);
    places.clear();
    places.reserve(from.size());
    for (unsigned int row = 0; row < from.n_rows(); ++row)
      for (int k = from.begin[row]; k < from.begin[row + 1]; ++k)
        {
          places.push_back(
            to.find(row, to.column_number(from.column_index(from.column[k]))));
          Assert(places.back() >= 0, ExcInternalError());
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
    const double *from = MatrixEntries(body).value;
    double       *to   = entry_values(matrix);
    for (std::size_t k = 0; k < places.size(); ++k)
      to[places[k]] = from[k];
  }
} // namespace Ricochet
