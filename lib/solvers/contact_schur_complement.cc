// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <base/vector_operations.h>
#include <solvers/contact_schur_complement.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  ContactSchurComplement::ContactSchurComplement(
    const ContactStructure::ActsThrough &contact,
    const SparseCholesky::Kind           kind,
    TangentSolver::Costs                &spent)
    : jacobian(contact.functionals)
    , products(jacobian)
    , spent(spent)
    , cholesky(kind)
    , places(n_rows())
    , row_at(n_rows())
    , contact_dofs(jacobian.index.begin(), jacobian.index.end())
  {
    std::iota(row_at.begin(), row_at.end(), 0U);
    std::stable_sort(row_at.begin(),
                     row_at.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return contact.order[a] < contact.order[b];
                     });
    for (unsigned int place = 0; place < n_rows(); ++place)
      places[row_at[place]] = place;

    std::sort(contact_dofs.begin(), contact_dofs.end());
    contact_dofs.erase(std::unique(contact_dofs.begin(), contact_dofs.end()),
                       contact_dofs.end());
    for (const auto index : jacobian.index)
      dof_of_entry.push_back(
        std::lower_bound(contact_dofs.begin(), contact_dofs.end(), index) -
        contact_dofs.begin());
    dof_sum.resize(contact_dofs.size());
  }



  void
  ContactSchurComplement::factorise(const Tangent &tangent)
  {
    tangent.assemble_body(matrix);
    tangent.add_open_contact(matrix);
    const Stopwatch stopwatch(spent.factorising);
    ++spent.n_factorisations;
    forwards.assign((n_rows() + group_size - 1) / group_size, {});
    columns.assign(forwards.size() * group_size, {});
    region_places = 0;
    if (!cholesky.factorise(matrix))
      throw NewtonFailure("The matrix of the body cannot be factored.\n");
    solves = &cholesky.factor();
  }



  const TriangularSolves::ForwardColumns &
  ContactSchurComplement::forward_of(const unsigned int group)
  {
    if (forwards[group].blocks.empty())
      {
        const unsigned int begin = group * group_size,
                           end   = std::min(begin + group_size, n_rows());
        forwards[group] =
          solves->forward(jacobian,
                          {row_at.begin() + begin, row_at.begin() + end});
      }
    return forwards[group];
  }



  const std::vector<double> &
  ContactSchurComplement::column(const unsigned int place, const unsigned int n)
  {
    const unsigned int first = place - place % group_size,
                       group = place / group_size;
    while (columns[place].size() < n)
      {
        const Stopwatch    stopwatch(spent.factorising);
        const unsigned int row_group = columns[place].size() / group_size;
        // The order of two groups is independent of which of them was solved
        // for first.
        const bool is_transposed = group < row_group;
        solves->multiply(forward_of(std::min(group, row_group)),
                         forward_of(std::max(group, row_group)),
                         products_of_groups);
        for (unsigned int c = 0; c < group_size; ++c)
          for (unsigned int r = 0; r < group_size; ++r)
            columns[first + c].push_back(
              products_of_groups[is_transposed ? c * group_size + r
                                               : r * group_size + c]);
      }
    return columns[place];
  }



  void
  ContactSchurComplement::begin(const Vector &right_hand_side)
  {
    const Stopwatch stopwatch(spent.substituting);
    solves->forward(local_values(right_hand_side), forward);
  }



  void
  ContactSchurComplement::observe(std::vector<double> &values)
  {
    const Stopwatch    stopwatch(spent.substituting);
    const unsigned int n = values.size();
    if (region_places != n)
      {
        std::vector<TriangularSolves::Index> unknowns;
        for (unsigned int place = 0; place < n; ++place)
          unknowns.insert(unknowns.end(),
                          jacobian.index.begin() +
                            jacobian.begin[row_at[place]],
                          jacobian.index.begin() +
                            jacobian.begin[row_at[place] + 1]);
        region        = solves->region_of(unknowns);
        region_places = n;
      }
    solves->backward(forward, region, solution_in_region);
    for (unsigned int place = 0; place < n; ++place)
      {
        const unsigned int f   = row_at[place];
        double             sum = 0.;
        for (std::size_t k = jacobian.begin[f]; k < jacobian.begin[f + 1]; ++k)
          sum += jacobian.value[k] *
            solution_in_region[solves->place_of(jacobian.index[k])];
        values[place] = sum;
      }
  }



  void
  ContactSchurComplement::finish(const std::vector<double> &coefficients,
                                 Vector                    &solution)
  {
    const Stopwatch stopwatch(spent.substituting);
    for (unsigned int group = 0; group < forwards.size(); ++group)
      {
        std::array<double, group_size> of_group{};
        bool                           is_zero = true;
        for (unsigned int k = 0;
             k < group_size && group * group_size + k < n_rows();
             ++k)
          {
            of_group[k] = -coefficients[row_at[group * group_size + k]];
            is_zero     = is_zero && of_group[k] == 0.;
          }
        if (!is_zero)
          solves->add(forward_of(group), of_group.data(), forward);
      }
    ++spent.n_substitutions;
    solves->backward(forward, local_values(solution));
  }



  void
  ContactSchurComplement::add_rows(const std::vector<double> &coefficients,
                                   Vector                    &vector) const
  {
    double *values = local_values(vector);
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        for (std::size_t k = jacobian.begin[f]; k < jacobian.begin[f + 1]; ++k)
          values[jacobian.index[k]] += coefficients[f] * jacobian.value[k];
  }



  double
  ContactSchurComplement::norm_of_rows(const std::vector<double> &coefficients,
                                       const Vector              *scaling)
  {
    std::fill(dof_sum.begin(), dof_sum.end(), 0.);
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        for (std::size_t k = jacobian.begin[f]; k < jacobian.begin[f + 1]; ++k)
          dof_sum[dof_of_entry[k]] += coefficients[f] * jacobian.value[k];
    double square = 0.;
    for (unsigned int d = 0; d < dof_sum.size(); ++d)
      {
        const double entry = scaling
          ? dof_sum[d] * local_values(*scaling)[contact_dofs[d]]
          : dof_sum[d];
        square += entry * entry;
      }
    return std::sqrt(square);
  }



  std::vector<double>
  ContactSchurComplement::along_rows(const Vector &vector) const
  {
    const double       *values = local_values(vector);
    std::vector<double> result(n_rows(), 0.);
    for (unsigned int f = 0; f < n_rows(); ++f)
      for (std::size_t k = jacobian.begin[f]; k < jacobian.begin[f + 1]; ++k)
        result[f] += jacobian.value[k] * values[jacobian.index[k]];
    return result;
  }



  void
  ContactSchurComplement::add_compliance(
    const double               factor,
    const std::vector<double> &coefficients,
    std::vector<double>       &values)
  {
    for (unsigned int place = 0; place < coefficients.size(); ++place)
      if (coefficients[place] != 0.)
        {
          const std::vector<double> &compliance = column(place, values.size());
          const double               own        = factor * coefficients[place];
          for (unsigned int row = 0; row < values.size(); ++row)
            values[row] += own * compliance[row];
        }
  }



  void
  ContactSchurComplement::set_contact(
    const std::vector<FunctionalRow> &change,
    const std::vector<FunctionalRow> &excess_change)
  {
    contact_rows.clear();
    n_seen                 = 0;
    const auto with_places = [&](const FunctionalRow &row) {
      FunctionalRow result(row);
      for (auto &entry : result)
        entry.first = places[entry.first];
      return result;
    };
    for (unsigned int place = 0; place < n_rows(); ++place)
      {
        const unsigned int f = row_at[place];
        if (change[f].empty() && excess_change[f].empty())
          continue;
        contact_rows.push_back({place,
                                with_places(change[f]),
                                with_places(products.times(excess_change[f]))});
        for (const auto &entry : contact_rows.back().on_values)
          n_seen = std::max(n_seen, entry.first + 1);
      }
    const unsigned int n = contact_rows.size();
    if (n == 0)
      return;

    const Stopwatch stopwatch(spent.factorising);
    dense.reinit(n, n);
    std::vector<int> number(n_rows(), -1);
    for (unsigned int i = 0; i < n; ++i)
      number[contact_rows[i].place] = i;
    // The transposed matrix, whose columns are sums of rows of the compliance.
    std::vector<const double *> of_row(n);
    for (unsigned int j = 0; j < n; ++j)
      of_row[j] = column(contact_rows[j].place, n_seen).data();
    compliance.resize(n_seen * n);
    for (unsigned int place = 0; place < n_seen; ++place)
      for (unsigned int j = 0; j < n; ++j)
        compliance[place * n + j] = of_row[j][place];
    for (unsigned int i = 0; i < n; ++i)
      {
        double *const sum = &dense(0, i);
        sum[i]            = 1.;
        for (const auto &[place, value] : contact_rows[i].on_values)
          {
            const double *const row = &compliance[place * n];
            for (unsigned int j = 0; j < n; ++j)
              sum[j] += value * row[j];
          }
        for (const auto &[place, value] : contact_rows[i].on_coefficients)
          if (number[place] >= 0)
            sum[number[place]] += value;
      }
    try
      {
        dense.compute_lu_factorization();
      }
    catch (const LACExceptions::ExcSingular &)
      {
        throw NewtonFailure(
          "The tangent matrix cannot be factored: with this state of contact it "
          "is singular.\n");
      }
  }



  void
  ContactSchurComplement::solve_contact(std::vector<double>       &coefficients,
                                        const std::vector<double> &values)
  {
    const unsigned int n = contact_rows.size();
    if (n == 0)
      return;
    // Rows without derivatives have known coefficients, whose effect on the
    // values of the others is added first.
    std::vector<double> known(coefficients), seen(values);
    for (const ContactRow &row : contact_rows)
      known[row.place] = 0.;
    seen.resize(n_seen);
    add_compliance(1., known, seen);

    const Stopwatch        stopwatch(spent.factorising);
    dealii::Vector<double> z(n);
    for (unsigned int i = 0; i < n; ++i)
      {
        z[i] = coefficients[contact_rows[i].place];
        for (const auto &[place, value] : contact_rows[i].on_values)
          z[i] -= value * seen[place];
        for (const auto &[place, value] : contact_rows[i].on_coefficients)
          z[i] -= value * known[place];
      }
    dense.solve(z, /* transposed */ true);
    for (unsigned int i = 0; i < n; ++i)
      coefficients[contact_rows[i].place] = z[i];
  }
} // namespace Ricochet
