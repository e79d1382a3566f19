// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/nearby_body.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <algorithm>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  NearbyBody::NearbyBody(std::unique_ptr<Factorisation>       factorisation,
                         const ContactStructure::ActsThrough &contact,
                         TangentSolver::Costs                &spent)
    : FactoredBody(contact)
    , factorisation(std::move(factorisation))
    , functionals(contact.functionals)
    , products(functionals)
    , spent(spent)
    , places(places_in_order(contact.order))
    , functional_at(functionals.size())
  {
    for (unsigned int f = 0; f < places.size(); ++f)
      functional_at[places[f]] = f;
  }



  bool
  NearbyBody::factorise(const Tangent &tangent)
  {
    assemble(tangent);
    const Stopwatch stopwatch(spent.factorising);
    return factorise(matrix.trilinos_matrix());
  }



  bool
  NearbyBody::factorise(const Epetra_CrsMatrix &tangent_matrix)
  {
    ++spent.n_factorisations;
    halves.assign(functionals.size(), {});
    columns.assign(functionals.size(), {});
    region_places = 0;
    factor        = nullptr;
    if (!factorisation->factorise(tangent_matrix, false))
      throw NewtonFailure("The tangent of the body cannot be factored.");
    factor = factorisation->triangular_factor();
    if (factor)
      dense.resize(factor->n(), 0.);
    return factor;
  }



  const TriangularFactor<float>::Half &
  NearbyBody::half_at(const unsigned int place)
  {
    if (halves[place].blocks.empty())
      {
        const unsigned int f     = functional_at[place];
        const std::size_t  begin = functionals.begin[f];
        halves[place] = factor->go_forwards(&functionals.index[begin],
                                            &functionals.value[begin],
                                            functionals.begin[f + 1] - begin);
      }
    return halves[place];
  }



  const std::vector<double> &
  NearbyBody::column(const unsigned int place, const unsigned int n_rows)
  {
    std::vector<double> &column = columns[place];
    if (column.size() < n_rows)
      {
        const Stopwatch stopwatch(spent.factorising);
        const auto     &own = half_at(place);
        factor->add(1., own, dense);
        for (unsigned int row = column.size(); row < n_rows; ++row)
          column.push_back(factor->product(half_at(row), dense));
        factor->clear(own, dense);
      }
    return column;
  }



  void
  NearbyBody::begin(const Vector &right_hand_side)
  {
    const Stopwatch stopwatch(spent.substituting);
    ++spent.n_substitutions;
    factor->go_forwards(right_hand_side.trilinos_vector()[0], half);
  }



  void
  NearbyBody::observe(std::vector<double> &values)
  {
    const Stopwatch    stopwatch(spent.substituting);
    const unsigned int n = values.size();
    if (region_places != n)
      {
        std::vector<types::global_dof_index> unknowns;
        for (unsigned int place = 0; place < n; ++place)
          {
            const unsigned int f = functional_at[place];
            unknowns.insert(unknowns.end(),
                            functionals.index.begin() + functionals.begin[f],
                            functionals.index.begin() +
                              functionals.begin[f + 1]);
          }
        region        = factor->region_of(unknowns);
        region_places = n;
      }
    factor->go_backwards(half, region, partial_solution);
    for (unsigned int place = 0; place < n; ++place)
      {
        const unsigned int f   = functional_at[place];
        double             sum = 0.;
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          sum += functionals.value[k] *
            partial_solution[factor->place_of(functionals.index[k])];
        values[place] = sum;
      }
  }



  void
  NearbyBody::finish(const std::vector<double> &coefficients, Vector &solution)
  {
    const Stopwatch stopwatch(spent.substituting);
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        factor->add(-coefficients[f], half_at(places[f]), half);
    factor->go_backwards(half, solution.trilinos_vector()[0]);
  }



  void
  NearbyBody::add_functionals(const std::vector<double> &coefficients,
                              Vector                    &vector) const
  {
    double *values = vector.trilinos_vector()[0];
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          values[functionals.index[k]] +=
            coefficients[f] * functionals.value[k];
  }



  std::vector<double>
  NearbyBody::along_functionals(const Vector &vector)
  {
    const double       *values = vector.trilinos_vector()[0];
    std::vector<double> products(functionals.size(), 0.);
    for (unsigned int f = 0; f < functionals.size(); ++f)
      for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
           ++k)
        products[f] += functionals.value[k] * values[functionals.index[k]];
    return products;
  }



  void
  NearbyBody::add_compliance(const double               weight,
                             const std::vector<double> &coefficients,
                             std::vector<double>       &values)
  {
    for (unsigned int place = 0; place < coefficients.size(); ++place)
      if (coefficients[place] != 0.)
        {
          const std::vector<double> &compliance = column(place, values.size());
          for (unsigned int row = 0; row < values.size(); ++row)
            values[row] += weight * coefficients[place] * compliance[row];
        }
  }



  void
  NearbyBody::solve_contact(const std::vector<FunctionalRow> &change,
                            const std::vector<FunctionalRow> &excess_change,
                            std::vector<double>              &coefficients,
                            const std::vector<double>        &values)
  {
    // The rows that change, by place, and how far they look.
    std::vector<unsigned int> changed;
    unsigned int              n_seen = 0;
    for (unsigned int place = 0; place < change.size(); ++place)
      {
        const FunctionalRow &row = change[functional_at[place]];
        if (!row.empty() || !excess_change[functional_at[place]].empty())
          changed.push_back(place);
        for (const auto &entry : row)
          n_seen = std::max(n_seen, places[entry.first] + 1);
      }
    if (changed.empty())
      return;

    // What does not change is known, and seen by the rest.
    std::vector<double> known(coefficients), seen(values);
    for (const unsigned int place : changed)
      known[place] = 0.;
    seen.resize(n_seen);
    add_compliance(1., known, seen);

    const unsigned int       n = changed.size();
    LAPACKFullMatrix<double> small(n, n);
    dealii::Vector<double>   z(n);
    std::vector<int>         number(change.size(), -1);
    for (unsigned int i = 0; i < n; ++i)
      number[changed[i]] = i;
    for (unsigned int j = 0; j < n; ++j)
      {
        const std::vector<double> &compliance = column(changed[j], n_seen);
        for (unsigned int i = 0; i < n; ++i)
          {
            double sum = i == j ? 1. : 0.;
            for (const auto &[f, value] : change[functional_at[changed[i]]])
              sum += value * compliance[places[f]];
            small(i, j) = sum;
          }
      }
    for (unsigned int i = 0; i < n; ++i)
      {
        z[i] = coefficients[changed[i]];
        for (const auto &[f, value] : change[functional_at[changed[i]]])
          z[i] -= value * seen[places[f]];
        for (const auto &[f, value] :
             products.times(excess_change[functional_at[changed[i]]]))
          if (const int j = number[places[f]]; j >= 0)
            small(i, j) += value;
          else
            z[i] -= value * known[places[f]];
      }
    try
      {
        small.compute_lu_factorization();
      }
    catch (const LACExceptions::ExcSingular &)
      {
        throw NewtonFailure(
          "The tangent matrix cannot be factored: with this state of contact it "
          "is singular.");
      }
    small.solve(z);
    for (unsigned int i = 0; i < n; ++i)
      coefficients[changed[i]] = z[i];
  }
} // namespace Ricochet
