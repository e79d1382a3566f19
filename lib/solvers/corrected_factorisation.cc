// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <base/stopwatch.h>
#include <solvers/corrected_factorisation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  CorrectedFactorisation::CorrectedFactorisation(
    std::unique_ptr<Factorisation>    factorisation,
    const Correction                  correction,
    const ContactStructure           &contact,
    const LowRankCorrection::Options &options,
    TangentSolver::Costs             &spent)
    : factorisation(std::move(factorisation))
    , kind(correction)
    , contact(contact)
    , options(options)
    , spent(spent)
  {}



  CorrectedFactorisation::~CorrectedFactorisation() = default;



  void
  CorrectedFactorisation::save_rows(std::vector<double> OwnedRow::*copy)
  {
    for (OwnedRow &row : rows)
      (row.*copy).assign(row.values, row.values + row.n_entries);
  }



  void
  CorrectedFactorisation::restore_rows(
    const std::vector<double> OwnedRow::*copy)
  {
    for (OwnedRow &row : rows)
      std::copy((row.*copy).begin(), (row.*copy).end(), row.values);
  }



  void
  CorrectedFactorisation::set_body(const Tangent &tangent)
  {
    tangent.assemble_body(tangent_matrix);
    if (kind == Correction::none)
      {
        tangent.complete_contact(tangent_matrix);
        return;
      }
    if (!correction && kind == Correction::rows)
      make_row_correction();
    // Assembly may have put the values elsewhere.
    for (OwnedRow &row : rows)
      tangent_matrix.trilinos_matrix().ExtractMyRowView(row.local,
                                                        row.n_entries,
                                                        row.values);
    save_rows(&OwnedRow::body);
    if (kind == Correction::rows)
      tangent.complete_open_contact(tangent_matrix);
    else
      tangent.complete_constant_contact(tangent_matrix);
    save_rows(&OwnedRow::open);
    if (!correction)
      correction = std::make_unique<LowRankCorrection>(
        tangent_matrix.locally_owned_range_indices(),
        tangent_matrix.get_mpi_communicator(),
        *contact.functionals,
        std::nullopt,
        options);
  }



  bool
  CorrectedFactorisation::factorise()
  {
    const Stopwatch stopwatch(spent.factorising);
    restore_rows(&OwnedRow::open);
    if (correction)
      correction->forget_columns();
    return factorisation->factorise(tangent_matrix, false);
  }



  void
  CorrectedFactorisation::make_row_correction()
  {
    const auto &epetra     = tangent_matrix.trilinos_matrix();
    const auto  columns_of = [&](const int row) {
      int                n_entries = 0;
      double            *values    = nullptr;
      int               *indices   = nullptr;
      std::vector<Index> result;
      epetra.ExtractMyRowView(row, n_entries, values, indices);
      for (int k = 0; k < n_entries; ++k)
        result.push_back(epetra.GCID64(indices[k]));
      return result;
    };
    const auto own_row = [&](const Index index) {
      return epetra.LRID(static_cast<TrilinosWrappers::types::int_type>(index));
    };

    // A direction for each row.
    Functionals         directions;
    std::vector<double> order;
    std::set<Index>     my_columns;
    for (unsigned int place = 0; place < contact.rows.size(); ++place)
      {
        OwnedRow row{};
        row.local = own_row(contact.rows[place]);
        if (row.local < 0)
          continue;
        rows.push_back(row);
        directions.add(contact.rows[place], 1.);
        directions.end_functional();
        order.push_back(place);
        for (const Index column : columns_of(row.local))
          my_columns.insert(column);
      }

    // An observable for each unknown that these rows couple to.
    const MPI_Comm  communicator = tangent_matrix.get_mpi_communicator();
    std::set<Index> region;
    for (const auto &list :
         Utilities::MPI::all_gather(communicator,
                                    std::vector<Index>(my_columns.begin(),
                                                       my_columns.end())))
      region.insert(list.begin(), list.end());
    Functionals        observables;
    std::vector<Index> mine;
    for (const Index column : region)
      if (own_row(column) >= 0)
        {
          observables.add(column, 1.);
          observables.end_functional();
          mine.push_back(column);
        }
    std::map<Index, unsigned int> place_of;
    for (const auto &list : Utilities::MPI::all_gather(communicator, mine))
      for (const Index column : list)
        place_of.emplace(column, place_of.size());
    for (OwnedRow &row : rows)
      for (const Index column : columns_of(row.local))
        row.observable.push_back(place_of.at(column));

    LowRankCorrection::Options row_options = options;
    row_options.is_symmetric               = false;
    correction = std::make_unique<LowRankCorrection>(
      tangent_matrix.locally_owned_range_indices(),
      communicator,
      ContactStructure::ActsThrough{directions, order, {}},
      observables,
      row_options);
  }



  void
  CorrectedFactorisation::set_contact(const Tangent &tangent)
  {
    if (kind == Correction::none)
      return;
    if (kind == Correction::rows)
      {
        restore_rows(&OwnedRow::body);
        tangent.complete_contact(tangent_matrix);
        change.assign(rows.size(), {});
        for (unsigned int r = 0; r < rows.size(); ++r)
          for (int k = 0; k < rows[r].n_entries; ++k)
            if (rows[r].values[k] != rows[r].open[k])
              change[r].emplace_back(rows[r].observable[k],
                                     rows[r].values[k] - rows[r].open[k]);
      }
    else
      {
        change.assign(n_known(), {});
        excess_change.assign(n_known(), {});
        tangent.contact_change(change);
        if (contact.takes_rows)
          tangent.contact_excess_change(excess_change);
        set_change_of_functionals(false);
        return;
      }
    const Stopwatch stopwatch(spent.factorising);
    correction->set_change(change, *factorisation);
  }



  void
  CorrectedFactorisation::set_change_of_functionals(const bool may_update)
  {
    const Stopwatch stopwatch(spent.factorising);
    for (auto *const rows_of_all : {&change, &excess_change})
      for (LowRankCorrection::Row &row : *rows_of_all)
        for (auto &entry : row)
          entry.first = correction->place(entry.first);
    correction->set_change(change, *factorisation, may_update, excess_change);
  }



  void
  CorrectedFactorisation::solve(const Vector &right_hand_side, Vector &solution)
  {
    if (correction)
      spent.n_substitutions +=
        correction->solve(right_hand_side, solution, *factorisation);
    else
      {
        ++spent.n_substitutions;
        factorisation->solve(right_hand_side, solution);
      }
  }



  void
  CorrectedFactorisation::begin(const Vector &right_hand_side)
  {
    const Stopwatch stopwatch(spent.substituting);
    ++spent.n_substitutions;
    has_seen_contact = false;
    if (body_solution.size() != right_hand_side.size())
      {
        body_solution.reinit(right_hand_side);
        work.reinit(right_hand_side);
      }
    if (correction->uses_halves(*factorisation))
      factorisation->go_forwards(right_hand_side, half);
    else
      factorisation->solve(right_hand_side, body_solution);
  }



  void
  CorrectedFactorisation::observe(std::vector<double> &values)
  {
    if (correction->uses_halves(*factorisation))
      {
        {
          const Stopwatch stopwatch(spent.factorising);
          correction->solve_first_columns(values.size(), *factorisation);
        }
        const Stopwatch stopwatch(spent.substituting);
        correction->observe_half(half, values, *factorisation);
        return;
      }
    const Stopwatch stopwatch(spent.substituting);
    correction->observe(body_solution, values);
  }



  void
  CorrectedFactorisation::finish(const std::vector<double> &coefficients,
                                 Vector                    &solution)
  {
    const Stopwatch stopwatch(spent.substituting);
    if (correction->uses_halves(*factorisation))
      {
        correction->subtract_half(coefficients, half, *factorisation);
        factorisation->go_backwards(half, solution);
        return;
      }
    copy_values(body_solution, solution);
    const bool pressed = std::any_of(coefficients.begin(),
                                     coefficients.end(),
                                     [](const double z) { return z != 0.; });
    if (Utilities::MPI::max(pressed ? 1 : 0,
                            tangent_matrix.get_mpi_communicator()) == 0)
      return;
    ++spent.n_substitutions;
    work = 0.;
    correction->add_directions(coefficients, work);
    factorisation->solve(work, body_solution);
    solution -= body_solution;
  }



  std::vector<double>
  CorrectedFactorisation::along_functionals(const Vector &vector)
  {
    std::vector<double> all(correction->n_places());
    correction->observe(vector, all);
    std::vector<double> own(contact.functionals->functionals.size());
    for (unsigned int f = 0; f < own.size(); ++f)
      own[f] = all[correction->place(f)];
    return own;
  }



  void
  CorrectedFactorisation::add_compliance(
    const double               factor,
    const std::vector<double> &coefficients,
    std::vector<double>       &values)
  {
    const Stopwatch stopwatch(spent.factorising);
    correction->add_compliance(factor, coefficients, values, *factorisation);
  }



  void
  CorrectedFactorisation::solve_contact(
    const std::vector<FunctionalRow> &new_change,
    const std::vector<FunctionalRow> &new_excess_change,
    std::vector<double>              &coefficients,
    const std::vector<double>        &values)
  {
    change        = new_change;
    excess_change = new_excess_change;
    // The states of one stage are near each other; what is left of another stage
    // would not be there in a resumed run.
    set_change_of_functionals(has_seen_contact);
    has_seen_contact = true;
    const Stopwatch stopwatch(spent.factorising);
    correction->solve_small(coefficients, values, *factorisation);
  }
} // namespace Ricochet
