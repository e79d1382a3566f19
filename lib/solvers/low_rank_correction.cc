// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <base/exceptions.h>
#include <solvers/functional_places.h>
#include <solvers/low_rank_correction.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  LowRankCorrection::LowRankCorrection(const IndexSet &owned,
                                       const MPI_Comm  communicator,
                                       const ContactStructure::ActsThrough &all,
                                       std::optional<Functionals> observables_,
                                       const Options             &options)
    : communicator(communicator)
    , directions(all.functionals)
    , own_observables(std::move(observables_))
    , observables(own_observables ? *own_observables : directions)
    , options(options)
    , products(directions)
    , work(owned, communicator)
  {
    IndexSet to_know(owned.size());
    to_know.add_indices(observables.index.begin(), observables.index.end());
    ghosted = GhostedVector(to_know, communicator);
    for (const Index index : observables.index)
      local_index.push_back(ghosted.local_index(index));

    for (const Index index : directions.index)
      owned_index.push_back(owned.is_element(index)
                              ? static_cast<int>(owned.index_within_set(index))
                              : -1);

    const FunctionalPlaces places(all, communicator);
    for (const unsigned int number : places.numbers)
      place_of_direction.push_back(places.place_of_number[number]);
    direction_at_place.assign(places.place_of_number.size(), -1);
    for (unsigned int d = 0; d < directions.size(); ++d)
      direction_at_place[place_of_direction[d]] = d;

    // The observables of all ranks stand one behind the other, unless they are the
    // directions: those that contact needs together lie together.
    if (own_observables)
      {
        const auto sizes =
          of_all_ranks(std::vector<unsigned int>{observables.size()},
                       communicator);
        const unsigned int my_rank =
          Utilities::MPI::this_mpi_process(communicator);
        n_observables = std::accumulate(sizes.begin(), sizes.end(), 0u);
        place_of_observable.resize(observables.size());
        std::iota(place_of_observable.begin(),
                  place_of_observable.end(),
                  std::accumulate(sizes.begin(), sizes.begin() + my_rank, 0u));
      }
    else
      {
        n_observables = n_places();
        place_of_observable.assign(place_of_direction.begin(),
                                   place_of_direction.begin() +
                                     directions.size());
      }
    forget_columns();
  }



  void
  LowRankCorrection::forget_columns()
  {
    columns.assign(direction_at_place.size(), {});
    half_columns.clear();
    if (options.group_size == 0)
      whole_columns.resize(direction_at_place.size());
    positive_small.forget();
    has_change = false;
    changed.clear();
  }



  void
  LowRankCorrection::observe(const Vector &vector, std::vector<double> &values)
  {
    ghosted.import(vector);
    const double *value = ghosted.values();
    std::fill(values.begin(), values.end(), 0.);
    for (unsigned int o = 0; o < observables.size(); ++o)
      {
        if (place_of_observable[o] >= values.size())
          continue;
        double sum = 0.;
        for (std::size_t k = observables.begin[o]; k < observables.begin[o + 1];
             ++k)
          sum += observables.value[k] * value[local_index[k]];
        values[place_of_observable[o]] = sum;
      }
    Utilities::MPI::sum(values, communicator, values);
  }



  void
  LowRankCorrection::solve_first_columns(const unsigned int n,
                                         Factorisation     &factorisation)
  {
    std::vector<unsigned int> places(n);
    std::iota(places.begin(), places.end(), 0U);
    solve_missing_columns(places, factorisation);
  }



  void
  LowRankCorrection::observe_half(const std::vector<double> &half,
                                  std::vector<double>       &values,
                                  const Factorisation &factorisation) const
  {
    const std::size_t   group_size = options.group_size;
    std::vector<double> seen;
    for (std::size_t begin = 0; begin < values.size(); begin += group_size)
      {
        const auto &group = half_columns.at(begin / group_size);
        seen.resize(group.n_columns);
        factorisation.observe(group, half, seen.data());
        std::copy_n(seen.begin(),
                    std::min(seen.size(), values.size() - begin),
                    values.begin() + begin);
      }
  }



  void
  LowRankCorrection::subtract_half(const std::vector<double> &coefficients,
                                   std::vector<double>       &half,
                                   const Factorisation &factorisation) const
  {
    const std::size_t   group_size = options.group_size;
    std::vector<double> by_place(n_places(), 0.);
    for (unsigned int d = 0; d < coefficients.size(); ++d)
      by_place[place_of_direction[d]] = coefficients[d];
    Utilities::MPI::sum(by_place, communicator, by_place);
    for (std::size_t begin = 0; begin < by_place.size(); begin += group_size)
      {
        const auto first = by_place.begin() + begin,
                   last = first + std::min(group_size, by_place.size() - begin);
        if (std::any_of(first, last, [](const double z) { return z != 0.; }))
          factorisation.subtract(half_columns.at(begin / group_size),
                                 &*first,
                                 half);
      }
  }



  void
  LowRankCorrection::add_direction(const unsigned int place,
                                   const double       factor,
                                   Vector            &vector) const
  {
    if (direction_at_place[place] >= 0)
      add_own_direction(direction_at_place[place], factor, vector);
  }



  void
  LowRankCorrection::add_own_direction(const unsigned int d,
                                       const double       factor,
                                       Vector            &vector) const
  {
    for (std::size_t k = directions.begin[d]; k < directions.begin[d + 1]; ++k)
      if (owned_index[k] >= 0)
        vector.trilinos_vector()[0][owned_index[k]] +=
          factor * directions.value[k];
      else
        vector(directions.index[k]) += factor * directions.value[k];
  }



  void
  LowRankCorrection::solve_columns(const std::vector<unsigned int> &places,
                                   Factorisation &factorisation)
  {
    if (places.empty())
      return;
    std::vector<Vector> units(places.size(), work),
      solutions(places.size(), work);
    for (unsigned int c = 0; c < places.size(); ++c)
      {
        units[c] = 0.;
        add_direction(places[c], 1., units[c]);
        units[c].compress(VectorOperation::add);
      }
    factorisation.solve(units, solutions);
    for (unsigned int c = 0; c < places.size(); ++c)
      {
        columns[places[c]].resize(n_observables);
        observe(solutions[c], columns[places[c]]);
        if (options.group_size == 0)
          whole_columns[places[c]].swap(solutions[c]);
      }
  }



  Functionals
  LowRankCorrection::directions_at(
    const std::vector<unsigned int> &places) const
  {
    struct Entry
    {
      unsigned int column;
      Index        index;
      double       value;
    };
    std::vector<Entry> entries;
    for (unsigned int c = 0; c < places.size(); ++c)
      if (const int d = direction_at_place[places[c]]; d >= 0)
        for (std::size_t k = directions.begin[d]; k < directions.begin[d + 1];
             ++k)
          entries.push_back({c, directions.index[k], directions.value[k]});
    entries = of_all_ranks(entries, communicator);
    std::stable_sort(entries.begin(),
                     entries.end(),
                     [](const Entry &a, const Entry &b) {
                       return a.column < b.column;
                     });
    Functionals all;
    for (unsigned int c = 0, e = 0; c < places.size(); ++c)
      {
        for (; e < entries.size() && entries[e].column == c; ++e)
          all.add(entries[e].index, entries[e].value);
        all.end_functional();
      }
    return all;
  }



  void
  LowRankCorrection::solve_half_columns(const unsigned int               group,
                                        const std::vector<unsigned int> &places,
                                        Factorisation &factorisation)
  {
    half_columns.emplace(group,
                         factorisation.go_forwards(directions_at(places)));
    for (const unsigned int place : places)
      columns[place].resize(n_observables);

    // The order of two groups does not depend on which of them came first.
    std::vector<double> products;
    for (const auto &[other, half] : half_columns)
      {
        const unsigned int first = std::min(group, other),
                           last  = std::max(group, other);
        const auto &left         = half_columns.at(first),
                   &right        = half_columns.at(last);
        factorisation.multiply(left, right, products);
        for (int c = 0; c < right.n_columns; ++c)
          for (int r = 0; r < (first == last ? c + 1 : left.n_columns); ++r)
            {
              const unsigned int row    = first * options.group_size + r,
                                 column = last * options.group_size + c;
              columns[row][column]      = columns[column][row] =
                products[c * left.n_columns + r];
            }
      }
  }



  void
  LowRankCorrection::solve_missing_columns(
    const std::vector<unsigned int> &needed,
    Factorisation                   &factorisation)
  {
    std::vector<unsigned int> missing;
    for (const unsigned int place : needed)
      if (columns[place].empty())
        missing.push_back(place);
    if (options.group_size == 0)
      {
        solve_columns(missing, factorisation);
        return;
      }
    std::set<unsigned int> groups;
    for (const unsigned int place : missing)
      groups.insert(place / options.group_size);
    for (const unsigned int group : groups)
      {
        std::vector<unsigned int> places(
          std::min<std::size_t>((group + 1) * options.group_size,
                                columns.size()) -
          group * options.group_size);
        std::iota(places.begin(), places.end(), group * options.group_size);
        if (uses_halves(factorisation))
          solve_half_columns(group, places, factorisation);
        else
          solve_columns(places, factorisation);
      }
  }



  bool
  LowRankCorrection::is_positive() const
  {
    if (!options.is_symmetric)
      return false;
    // Each direction observes itself: then V^T A^{-1} U is symmetric.
    for (unsigned int i = 0; i < changed.size(); ++i)
      {
        if (rows[i].size() != 1 || !(rows[i][0].second > 0.) ||
            rows[i][0].first != changed[i])
          return false;
        for (const auto &[place, value] : taken_rows[i])
          if (place != changed[i] || value < -1.)
            return false;
      }
    return true;
  }



  LowRankCorrection::Row
  LowRankCorrection::taken_by(const Row &excess_row)
  {
    Row row(excess_row);
    for (auto &entry : row)
      entry.first = direction_at_place[entry.first];
    row = products.times(row);
    for (auto &entry : row)
      entry.first = place_of_direction[entry.first];
    return row;
  }



  void
  LowRankCorrection::set_change(const std::vector<Row> &my_rows,
                                Factorisation          &factorisation,
                                const bool              may_update,
                                const std::vector<Row> &my_excess_rows)
  {
    // What is at hand may depend on what was solved for before. Then it does not serve in
    // another stage, which a resumed run may begin with.
    const bool has_past =
      small_is_positive ? positive_small.is_updated() : small.is_made_again();
    const bool same = has_change && my_rows == my_last_rows &&
      my_excess_rows == my_last_excess_rows && (may_update || !has_past);
    if (Utilities::MPI::min(same ? 1 : 0, communicator) == 1)
      return;
    has_change          = false;
    my_last_rows        = my_rows;
    my_last_excess_rows = my_excess_rows;

    // All ranks get all rows, by place.
    std::vector<NumberedRows> all;
    for (unsigned int d = 0; d < my_rows.size(); ++d)
      {
        const bool takes =
          !my_excess_rows.empty() && !my_excess_rows[d].empty();
        if (my_rows[d].empty() && !takes)
          continue;
        all.push_back({place_of_direction[d], {{my_rows[d], {}, {}}}});
        if (takes)
          {
            all.back().rows[1] = my_excess_rows[d];
            all.back().rows[2] = taken_by(my_excess_rows[d]);
          }
      }
    all = sum_of_all_ranks(std::move(all), communicator);
    changed.clear();
    rows.clear();
    excess_rows.clear();
    taken_rows.clear();
    for (auto &[place, own] : all)
      {
        changed.push_back(place);
        rows.push_back(std::move(own[0]));
        excess_rows.push_back(std::move(own[1]));
        taken_rows.push_back(std::move(own[2]));
      }
    if (!changed.empty())
      {
        std::vector<unsigned int> needed(changed);
        if (uses_halves(factorisation))
          for (const Row &row : rows)
            for (const auto &entry : row)
              needed.push_back(entry.first);
        solve_missing_columns(needed, factorisation);
        factorise_small(may_update);
      }
    has_change = true;
  }



  void
  LowRankCorrection::factorise_small(const bool may_update)
  {
    const unsigned int n = changed.size();
    small_is_positive    = is_positive();
    if (small_is_positive)
      {
        // Divided by C, the system is symmetric and positive definite; or not, if
        // the body's own matrix is indefinite.
        std::vector<double> diagonal;
        for (unsigned int i = 0; i < n; ++i)
          {
            double own = 1.;
            for (const auto &entry : taken_rows[i])
              own += entry.second;
            diagonal.push_back(own / rows[i][0].second);
          }
        small_is_positive =
          positive_small.set(changed, diagonal, columns, may_update);
        if (small_is_positive)
          return;
      }
    small.factorise(small_terms(), options.may_be_single);
  }



  void
  LowRankCorrection::solve_with_small(dealii::Vector<double> &vector)
  {
    if (small_is_positive)
      positive_small.solve(vector);
    else
      small.solve(small_terms(), vector);
  }



  unsigned int
  LowRankCorrection::solve(const Vector  &right_hand_side,
                           Vector        &solution,
                           Factorisation &factorisation)
  {
    factorisation.solve(right_hand_side, solution);
    if (changed.empty())
      return 1;
    observed.resize(n_observables);
    observe(solution, observed);
    dealii::Vector<double> y(changed.size());
    for (unsigned int i = 0; i < changed.size(); ++i)
      for (const auto &[o, value] : rows[i])
        y[i] += (small_is_positive ? 1. : value) * observed[o];
    if (std::any_of(excess_rows.begin(), excess_rows.end(), [](const Row &row) {
          return !row.empty();
        }))
      {
        observe(right_hand_side, observed);
        for (unsigned int i = 0; i < changed.size(); ++i)
          for (const auto &[place, value] : excess_rows[i])
            y[i] += value / (small_is_positive ? rows[i][0].second : 1.) *
              observed[place];
      }
    solve_with_small(y);
    if (options.group_size == 0)
      {
        for (unsigned int i = 0; i < changed.size(); ++i)
          solution.add(-y[i], whole_columns[changed[i]]);
        return 1;
      }
    // The sum of the directions first: it gathers entries from other ranks.
    work = 0.;
    for (unsigned int i = 0; i < changed.size(); ++i)
      add_direction(changed[i], -y[i], work);
    work.compress(VectorOperation::add);
    work += right_hand_side;
    factorisation.solve(work, solution);
    return 2;
  }



  void
  LowRankCorrection::add_directions(const std::vector<double> &coefficients,
                                    Vector                    &vector) const
  {
    for (unsigned int d = 0; d < coefficients.size(); ++d)
      if (coefficients[d] != 0.)
        add_own_direction(d, coefficients[d], vector);
    vector.compress(VectorOperation::add);
  }



  void
  LowRankCorrection::add_compliance(const double               factor,
                                    const std::vector<double> &coefficients,
                                    std::vector<double>       &values,
                                    Factorisation             &factorisation)
  {
    std::vector<unsigned int> places;
    for (unsigned int place = 0; place < coefficients.size(); ++place)
      if (coefficients[place] != 0.)
        places.push_back(place);
    std::vector<unsigned int> needed(places);
    if (uses_halves(factorisation))
      for (unsigned int o = 0; o < values.size(); o += options.group_size)
        needed.push_back(o);
    solve_missing_columns(needed, factorisation);
    std::vector<double> of_places;
    for (const unsigned int place : places)
      of_places.push_back(coefficients[place]);
    add_columns(factor, columns, places, of_places, values);
  }



  void
  LowRankCorrection::solve_small(std::vector<double>       &coefficients,
                                 const std::vector<double> &values,
                                 Factorisation             &factorisation)
  {
    // What does not change is known, and seen by the rest.
    std::vector<double> known(coefficients);
    for (const unsigned int place : changed)
      known[place] = 0.;
    unsigned int n_seen = 0;
    for (const Row &row : rows)
      for (const auto &entry : row)
        n_seen = std::max(n_seen, entry.first + 1);
    std::vector<double> seen(values.begin(), values.begin() + n_seen);
    add_compliance(1., known, seen, factorisation);
    if (changed.empty())
      return;
    dealii::Vector<double> z(changed.size());
    for (unsigned int i = 0; i < changed.size(); ++i)
      {
        z[i] = coefficients[changed[i]];
        for (const auto &[o, value] : rows[i])
          z[i] -= value * seen[o];
        for (const auto &[place, value] : taken_rows[i])
          z[i] -= value * known[place];
        if (small_is_positive)
          z[i] /= rows[i][0].second;
      }
    solve_with_small(z);
    for (unsigned int i = 0; i < changed.size(); ++i)
      coefficients[changed[i]] = z[i];
  }
} // namespace Ricochet
