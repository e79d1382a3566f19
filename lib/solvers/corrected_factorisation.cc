// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/stopwatch.h>
#include <solvers/corrected_factorisation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    using EpetraIndex = TrilinosWrappers::types::int_type;

    /// The entry @p index of @p vector, or null on other ranks.
    double *
    owned_entry(Ricochet::Vector &vector, const Factorisation::Index index)
    {
      auto     &epetra = vector.trilinos_vector();
      const int local  = epetra.Map().LID(static_cast<EpetraIndex>(index));
      return local < 0 ? nullptr : epetra[0] + local;
    }
  } // namespace



  CorrectedFactorisation::CorrectedFactorisation(
    std::unique_ptr<Factorisation> factorisation,
    const std::vector<Index>      &contact_rows,
    const unsigned int             group_size,
    double                        &factorising)
    : factorisation(std::move(factorisation))
    , contact_rows(contact_rows)
    , group_size(group_size)
    , factorising(factorising)
  {}



  CorrectedFactorisation::~CorrectedFactorisation() = default;



  void
  CorrectedFactorisation::set_body(
    const std::function<void(Matrix &)> &assemble_body,
    const std::function<void(Matrix &)> &complete_open)
  {
    assemble_body(body);
    open.copy_from(body);
    complete_open(open);
    tangent.copy_from(open);
    if (work.size() == 0)
      {
        work.reinit(open.locally_owned_range_indices(),
                    open.get_mpi_communicator());
        find_region();
      }
    const auto values = [](Matrix &matrix, const int row) {
      int     n_entries = 0;
      double *values    = nullptr;
      matrix.trilinos_matrix().ExtractMyRowView(row, n_entries, values);
      return values;
    };
    for (OwnedRow &row : rows)
      {
        row.body    = values(body, row.local);
        row.open    = values(open, row.local);
        row.tangent = values(tangent, row.local);
      }
    changed.clear();
  }



  bool
  CorrectedFactorisation::factorise()
  {
    const Stopwatch stopwatch(factorising);
    columns.assign(contact_rows.size(), {});
    if (group_size == 0)
      whole_columns.resize(contact_rows.size());
    return factorisation->factorise(open, false);
  }



  void
  CorrectedFactorisation::find_region()
  {
    const MPI_Comm communicator = open.get_mpi_communicator();
    const auto    &epetra       = open.trilinos_matrix();
    const auto     columns_of   = [&](const int row) {
      int                n_entries = 0;
      double            *values    = nullptr;
      int               *indices   = nullptr;
      std::vector<Index> result;
      epetra.ExtractMyRowView(row, n_entries, values, indices);
      for (int k = 0; k < n_entries; ++k)
        result.push_back(epetra.GCID64(indices[k]));
      return result;
    };

    std::set<Index> my_columns;
    for (unsigned int place = 0; place < contact_rows.size(); ++place)
      {
        const int local =
          epetra.LRID(static_cast<EpetraIndex>(contact_rows[place]));
        if (local < 0)
          continue;
        OwnedRow row;
        row.place     = place;
        row.local     = local;
        row.n_entries = epetra.NumMyEntries(local);
        rows.push_back(row);
        for (const Index column : columns_of(local))
          my_columns.insert(column);
      }

    std::map<Index, unsigned int> place_in_region;
    for (const auto &list :
         Utilities::MPI::all_gather(communicator,
                                    std::vector<Index>(my_columns.begin(),
                                                       my_columns.end())))
      for (const Index column : list)
        place_in_region[column] = 0;
    for (auto &[column, place] : place_in_region)
      {
        place           = region_size++;
        const int local = epetra.LRID(static_cast<EpetraIndex>(column));
        if (local >= 0)
          owned_region.emplace_back(local, place);
      }
    region_values.resize(region_size);
    for (OwnedRow &row : rows)
      for (const Index column : columns_of(row.local))
        row.region.push_back(place_in_region.at(column));
  }



  void
  CorrectedFactorisation::extract_region(const Vector &vector,
                                         double       *values) const
  {
    std::fill(values, values + region_size, 0.);
    const double *owned = vector.trilinos_vector()[0];
    for (const auto &[local, place] : owned_region)
      values[place] = owned[local];
    const ArrayView<double> view(values, region_size);
    Utilities::MPI::sum(ArrayView<const double>(values, region_size),
                        open.get_mpi_communicator(),
                        view);
  }



  void
  CorrectedFactorisation::solve_columns(const std::vector<unsigned int> &places)
  {
    if (places.empty())
      return;
    std::vector<Vector> units(places.size(), work),
      solutions(places.size(), work);
    for (unsigned int c = 0; c < places.size(); ++c)
      {
        units[c] = 0.;
        if (double *entry = owned_entry(units[c], contact_rows[places[c]]))
          *entry = 1.;
      }
    factorisation->solve(units, solutions);
    for (unsigned int c = 0; c < places.size(); ++c)
      {
        columns[places[c]].resize(region_size);
        extract_region(solutions[c], columns[places[c]].data());
        if (group_size == 0)
          whole_columns[places[c]].swap(solutions[c]);
      }
  }



  void
  CorrectedFactorisation::solve_changed_columns()
  {
    if (group_size == 0)
      {
        std::vector<unsigned int> missing;
        for (const unsigned int place : changed)
          if (columns[place].empty())
            missing.push_back(place);
        solve_columns(missing);
        return;
      }
    std::set<unsigned int> groups;
    for (const unsigned int place : changed)
      if (columns[place].empty())
        groups.insert(place / group_size);
    for (const unsigned int group : groups)
      {
        std::vector<unsigned int> places;
        for (unsigned int place = group * group_size;
             place < std::min<std::size_t>((group + 1) * group_size,
                                           contact_rows.size());
             ++place)
          places.push_back(place);
        solve_columns(places);
      }
  }



  void
  CorrectedFactorisation::set_contact(
    const std::function<void(Matrix &)> &complete)
  {
    for (const OwnedRow &row : rows)
      std::copy(row.body, row.body + row.n_entries, row.tangent);
    complete(tangent);

    // Which rows contact changes, and by what.
    std::vector<unsigned int> my_changed;
    changes.clear();
    for (const OwnedRow &row : rows)
      {
        std::vector<std::pair<unsigned int, double>> change;
        for (int k = 0; k < row.n_entries; ++k)
          if (row.tangent[k] != row.open[k])
            change.emplace_back(row.region[k], row.tangent[k] - row.open[k]);
        if (!change.empty())
          {
            my_changed.push_back(row.place);
            changes.push_back(std::move(change));
          }
      }
    const MPI_Comm communicator = open.get_mpi_communicator();
    changed.clear();
    for (const auto &list :
         Utilities::MPI::all_gather(communicator, my_changed))
      changed.insert(changed.end(), list.begin(), list.end());
    std::sort(changed.begin(), changed.end());
    owned_changed.clear();
    for (const unsigned int place : my_changed)
      owned_changed.push_back(
        std::lower_bound(changed.begin(), changed.end(), place) -
        changed.begin());
    if (changed.empty())
      return;
    const Stopwatch stopwatch(factorising);
    solve_changed_columns();

    const unsigned int  n = changed.size();
    std::vector<double> sums(n * n, 0.);
    // In blocks of columns, packed so that the innermost loop runs over
    // neighbours.
    constexpr unsigned int width = 16;
    std::vector<double>    block(region_size * width, 0.);
    for (unsigned int begin = 0; begin < n; begin += width)
      {
        const unsigned int size = std::min(width, n - begin);
        for (unsigned int j = 0; j < size; ++j)
          {
            const double *column = columns[changed[begin + j]].data();
            for (unsigned int place = 0; place < region_size; ++place)
              block[place * width + j] = column[place];
          }
        for (unsigned int i = 0; i < changes.size(); ++i)
          {
            std::array<double, width> row{};
            for (const auto &[place, value] : changes[i])
              for (unsigned int j = 0; j < width; ++j)
                row[j] += value * block[place * width + j];
            std::copy(row.begin(),
                      row.begin() + size,
                      &sums[owned_changed[i] * n + begin]);
          }
      }
    Utilities::MPI::sum(ArrayView<const double>(sums.data(), sums.size()),
                        communicator,
                        ArrayView<double>(sums.data(), sums.size()));
    small = std::make_unique<LAPACKFullMatrix<double>>(n, n);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        (*small)(i, j) = sums[i * n + j] + (i == j ? 1. : 0.);
    small->compute_lu_factorization();
  }



  void
  CorrectedFactorisation::solve(const Vector &right_hand_side, Vector &solution)
  {
    factorisation->solve(right_hand_side, solution);
    if (changed.empty())
      return;
    extract_region(solution, region_values.data());
    dealii::Vector<double> y(changed.size());
    for (unsigned int i = 0; i < changes.size(); ++i)
      for (const auto &[place, value] : changes[i])
        y[owned_changed[i]] += value * region_values[place];
    Utilities::MPI::sum(ArrayView<const double>(y.begin(), y.size()),
                        open.get_mpi_communicator(),
                        ArrayView<double>(y.begin(), y.size()));
    small->solve(y);
    if (group_size == 0)
      {
        for (unsigned int i = 0; i < changed.size(); ++i)
          solution.add(-y[i], whole_columns[changed[i]]);
        return;
      }
    work = right_hand_side;
    for (unsigned int i = 0; i < changed.size(); ++i)
      if (double *entry = owned_entry(work, contact_rows[changed[i]]))
        *entry -= y[i];
    factorisation->solve(work, solution);
  }



  unsigned int
  CorrectedFactorisation::n_columns() const
  {
    return std::count_if(columns.begin(),
                         columns.end(),
                         [](const std::vector<double> &column) {
                           return !column.empty();
                         });
  }
} // namespace Ricochet
