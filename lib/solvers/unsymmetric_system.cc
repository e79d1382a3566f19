// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/threads.h>
#include <solvers/unsymmetric_system.h>

#include <Eigen/Core>

#include <algorithm>
#include <array>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Rows that are multiplied at once: those of the components of a node, which look at
    /// the same values.
    constexpr unsigned int n_rows_at_once = 3;

    /// As many numbers as a register of AVX2 has.
    template <typename Number>
    using Lanes = Eigen::Array<Number, 32 / sizeof(Number), 1>;

    /// Columns that are summed at once: four registers of them.
    template <typename Number>
    constexpr unsigned int n_columns_at_once = 4 * (32 / sizeof(Number));

    /// Rows of C that look at the same values.
    template <typename Number>
    struct RowGroup
    {
      unsigned int              first_row, n_rows;
      std::vector<unsigned int> seen;
      /// For each value that they see one of each row.
      std::vector<Number> factors;
    };

    /// @param number of each value.
    template <typename Number>
    std::vector<RowGroup<Number>>
    groups_of_rows(const std::vector<FunctionalRow> &rows,
                   const std::vector<unsigned int>  &number)
    {
      const auto looks_like = [&](const unsigned int i, const unsigned int j) {
        return i < rows.size() &&
          std::equal(rows[i].begin(),
                     rows[i].end(),
                     rows[j].begin(),
                     rows[j].end(),
                     [](const auto &a, const auto &b) {
                       return a.first == b.first;
                     });
      };
      std::vector<RowGroup<Number>> groups;
      for (unsigned int i = 0; i < rows.size(); i += groups.back().n_rows)
        {
          RowGroup<Number> group{i, 1, {}, {}};
          while (group.n_rows < n_rows_at_once &&
                 looks_like(i + group.n_rows, i))
            ++group.n_rows;
          if (group.n_rows < n_rows_at_once)
            group.n_rows = 1;
          for (unsigned int k = 0; k < rows[i].size(); ++k)
            {
              group.seen.push_back(number[rows[i][k].first]);
              for (unsigned int r = 0; r < group.n_rows; ++r)
                group.factors.push_back(
                  static_cast<Number>(rows[i + r][k].second));
            }
          groups.push_back(std::move(group));
        }
      return groups;
    }

    /// Products of the rows of @p group with @p block, packed by values.
    template <unsigned int n_rows, typename Number>
    void
    multiply(
      const RowGroup<Number>                                         &group,
      const std::vector<Number>                                      &block,
      std::array<Number, n_rows_at_once * n_columns_at_once<Number>> &products)
    {
      constexpr unsigned int width = n_columns_at_once<Number>, n_parts = 4,
                             part = width / n_parts;
      Lanes<Number> sums[n_rows][n_parts];
      for (auto &row : sums)
        for (auto &sum : row)
          sum.setZero();
      const Number *factor = group.factors.data();
      for (const unsigned int o : group.seen)
        {
          const Number *values = block.data() + o * width;
#pragma GCC unroll 4
          for (unsigned int k = 0; k < n_parts; ++k)
            {
              const Lanes<Number> entry =
                Eigen::Map<const Lanes<Number>>(values + part * k);
#pragma GCC unroll 3
              for (unsigned int r = 0; r < n_rows; ++r)
                sums[r][k] += factor[r] * entry;
            }
          factor += n_rows;
        }
      for (unsigned int r = 0; r < n_rows; ++r)
        for (unsigned int k = 0; k < n_parts; ++k)
          Eigen::Map<Lanes<Number>>(products.data() + r * width + part * k) =
            sums[r][k];
    }



    /// Make the whole matrix.
    template <typename Number>
    void
    assemble(const UnsymmetricSystem::Terms &terms,
             DenseFactors<Number>           &matrix)
    {
      const auto        &places   = terms.places;
      const unsigned int n        = places.size(),
                         n_values = terms.columns[places.front()].size();
      matrix.reinit(n);

      // The values that rows look at: few of those that they could.
      std::vector<bool> is_seen(n_values, false);
      for (const FunctionalRow &row : terms.on_values)
        for (const auto &entry : row)
          is_seen[entry.first] = true;
      std::vector<unsigned int> seen, number_of_seen(n_values);
      for (unsigned int o = 0; o < n_values; ++o)
        if (is_seen[o])
          {
            number_of_seen[o] = seen.size();
            seen.push_back(o);
          }

      // In blocks of columns, packed so that the innermost loop runs over neighbours.
      const std::vector<RowGroup<Number>> groups =
        groups_of_rows<Number>(terms.on_values, number_of_seen);
      constexpr unsigned int width = n_columns_at_once<Number>;
      Threads::for_each_range(
        (n + width - 1) / width,
        1,
        [&](const unsigned int first_block, const unsigned int end_block) {
          std::vector<Number> block(seen.size() * width, Number());
          std::array<Number, n_rows_at_once * width> products;
          for (unsigned int begin = first_block * width;
               begin < std::min(n, end_block * width);
               begin += width)
            {
              const unsigned int size = std::min(width, n - begin);
              for (unsigned int j = 0; j < size; ++j)
                {
                  const std::vector<double> &column =
                    terms.columns[places[begin + j]];
                  for (unsigned int k = 0; k < seen.size(); ++k)
                    block[k * width + j] = static_cast<Number>(column[seen[k]]);
                }
              for (const RowGroup<Number> &group : groups)
                {
                  if (group.n_rows == n_rows_at_once)
                    multiply<n_rows_at_once>(group, block, products);
                  else
                    multiply<1>(group, block, products);
                  for (unsigned int j = 0; j < size; ++j)
                    for (unsigned int r = 0; r < group.n_rows; ++r)
                      matrix(group.first_row + r, begin + j) =
                        products[r * width + j];
                }
            }
        });
      for (unsigned int i = 0; i < n; ++i)
        matrix(i, i) += Number(1);
      for (unsigned int i = 0; i < n; ++i)
        for (const auto &[place, value] : terms.on_places[i])
          {
            const auto known =
              std::lower_bound(places.begin(), places.end(), place);
            if (known != places.end() && *known == place)
              matrix(i, known - places.begin()) += static_cast<Number>(value);
          }
    }
  } // namespace



  void
  add_columns(const double                            factor,
              const std::vector<std::vector<double>> &columns,
              const std::vector<unsigned int>        &places,
              const std::vector<double>              &coefficients,
              std::vector<double>                    &values)
  {
    // Several columns at once, so that the sums are read and written less often.
    constexpr unsigned int n_at_once = 4, smallest_part = 256;
    const unsigned int     smallest =
      places.size() < 100 ? values.size() : smallest_part;
    Threads::for_each_range(
      values.size(),
      smallest,
      [&](const unsigned int begin, const unsigned int end) {
        std::array<std::vector<double>::const_pointer, n_at_once> column{};
        std::array<double, n_at_once>                             weight{};
        for (std::size_t first = 0; first < places.size(); first += n_at_once)
          {
            for (unsigned int c = 0; c < n_at_once; ++c)
              {
                const bool is_there = first + c < places.size();
                column[c] =
                  columns[places[is_there ? first + c : first]].data();
                weight[c] = is_there ? factor * coefficients[first + c] : 0.;
              }
            for (std::size_t o = begin; o < end; ++o)
              values[o] +=
                (weight[0] * column[0][o] + weight[1] * column[1][o]) +
                (weight[2] * column[2][o] + weight[3] * column[3][o]);
          }
      });
  }



  void
  UnsymmetricSystem::factorise(const Terms &terms, const bool may_be_single)
  {
    // Small ones take no time.
    constexpr unsigned int fewest_for_single = 256;
    made_again                               = false;
    is_single = may_be_single && terms.places.size() >= fewest_for_single;
    if (is_single)
      {
        assemble(terms, single_factors);
        if (single_factors.factorise())
          return;
        is_single = false;
      }
    assemble(terms, factors);
    if (!factors.factorise())
      throw NewtonFailure(
        "The tangent matrix cannot be factored: with this state of contact it "
        "is singular.");
  }



  void
  UnsymmetricSystem::solve(const Terms &terms, dealii::Vector<double> &vector)
  {
    if (is_single)
      {
        if (solve_with_refinement(terms, vector))
          return;
        factorise(terms, false);
        made_again = true;
      }
    factors.solve(vector.data());
  }



  bool
  UnsymmetricSystem::solve_with_refinement(const Terms            &terms,
                                           dealii::Vector<double> &vector)
  {
    constexpr double   tolerance = 1e-10, slowest = .1;
    const unsigned int n      = terms.places.size();
    const double       wanted = tolerance * vector.linfty_norm();
    std::size_t        n_seen = 0;
    for (const FunctionalRow &row : terms.on_values)
      for (const auto &entry : row)
        n_seen = std::max<std::size_t>(n_seen, entry.first + 1);
    dealii::Vector<double> rest(vector);
    std::vector<float>     correction(n);
    std::vector<double>    solution(n, 0.), by_place(terms.columns.size(), 0.),
      seen;
    double size = rest.linfty_norm();
    while (size > wanted)
      {
        // Of the size of one, so that single precision can hold it.
        for (unsigned int i = 0; i < n; ++i)
          correction[i] = static_cast<float>(rest[i] / size);
        single_factors.solve(correction.data());
        for (unsigned int i = 0; i < n; ++i)
          {
            solution[i] += size * correction[i];
            by_place[terms.places[i]] = solution[i];
          }
        seen.assign(n_seen, 0.);
        add_columns(1., terms.columns, terms.places, solution, seen);
        for (unsigned int i = 0; i < n; ++i)
          {
            rest[i] = vector[i] - solution[i];
            for (const auto &[place, value] : terms.on_places[i])
              rest[i] -= value * by_place[place];
            for (const auto &[o, value] : terms.on_values[i])
              rest[i] -= value * seen[o];
          }
        const double new_size = rest.linfty_norm();
        if (!(new_size < slowest * size))
          return false;
        size = new_size;
      }
    std::copy(solution.begin(), solution.end(), vector.begin());
    return true;
  }
} // namespace Ricochet
