// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <solvers/body_matrix.h>
#include <solvers/contact_subspace.h>

#include <deal.II/base/mpi.h>

#include <Eigen/CholmodSupport>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Contact is stiff where its part of an entry on the diagonal exceeds this one.
    /// With less, multigrid alone takes about as many iterations.
    constexpr double stiff_part = .99;

    template <typename T>
    void
    sort_and_make_unique(std::vector<T> &list)
    {
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
    }
  } // namespace



  struct ContactSubspace::Factor
  {
    Eigen::CholmodDecomposition<Eigen::SparseMatrix<double>, Eigen::Lower>
      cholesky;
  };



  ContactSubspace::ContactSubspace() = default;



  ContactSubspace::~ContactSubspace() = default;



  bool
  ContactSubspace::is_stiff(const TangentOperator &tangent)
  {
    const Functionals &functionals = tangent.functionals();
    const Vector       diagonal    = tangent.diagonal();
    Vector             of_contact(diagonal);
    of_contact = 0.;
    for (unsigned int f = 0; f < tangent.change().size(); ++f)
      for (const auto &[other, factor] : tangent.change()[f])
        if (other == f)
          for (std::size_t k = functionals.begin[f];
               k < functionals.begin[f + 1];
               ++k)
            of_contact(functionals.index[k]) +=
              factor * functionals.value[k] * functionals.value[k];
    of_contact.compress(VectorOperation::add);
    bool is_stiff = false;
    for (const auto i : diagonal.locally_owned_elements())
      is_stiff = is_stiff || of_contact(i) > stiff_part * diagonal(i);
    return Utilities::MPI::max(is_stiff ? 1 : 0, tangent.communicator) == 1;
  }



  std::vector<ContactSubspace::Index>
  ContactSubspace::unknowns_of_contact(const TangentOperator &tangent)
  {
    const Functionals &functionals = tangent.functionals();
    std::vector<Index> list;
    const auto         add = [&](const unsigned int f) {
      list.insert(list.end(),
                  functionals.index.begin() + functionals.begin[f],
                  functionals.index.begin() + functionals.begin[f + 1]);
    };
    for (unsigned int f = 0; f < tangent.change().size(); ++f)
      for (const auto &entry : tangent.change()[f])
        {
          add(f);
          add(entry.first);
        }
    sort_and_make_unique(list);
    return list;
  }



  int
  ContactSubspace::place_of(const Index unknown) const
  {
    const auto place =
      std::lower_bound(unknowns.begin(), unknowns.end(), unknown);
    return place != unknowns.end() && *place == unknown
      ? static_cast<int>(place - unknowns.begin())
      : -1;
  }



  std::vector<ContactSubspace::Entry>
  ContactSubspace::own_entries(const TangentOperator &tangent) const
  {
    std::vector<Entry> entries;
    const auto add = [&](const int row, const int column, const double value) {
      if (row >= 0 && column >= 0)
        entries.push_back({row, column, value});
    };
    std::vector<unsigned int> numbers;
    for (const Own &unknown : own)
      numbers.push_back(unknown.number);
    for (const MatrixTerm &term : tangent.terms())
      {
        std::size_t k = 0;
        term.matrix->for_each_row(
          [&]([[maybe_unused]] const unsigned int row,
              const std::vector<Index>           &columns,
              const std::vector<double>          &values) {
            Assert(own[k].number == row, ExcInternalError());
            const unsigned int place = own[k++].place;
            for (unsigned int c = 0; c < columns.size(); ++c)
              add(place, place_of(columns[c]), term.weight * values[c]);
          },
          &numbers);
      }
    const Functionals            &functionals = tangent.functionals();
    std::vector<std::vector<int>> places(functionals.size());
    const auto                    places_of = [&](const unsigned int f) {
      std::vector<int> &list = places[f];
      if (list.empty())
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          list.push_back(place_of(functionals.index[k]));
      return list.data();
    };
    for (unsigned int f = 0; f < tangent.change().size(); ++f)
      for (const auto &[g, factor] : tangent.change()[f])
        {
          const int    *rows = places_of(f), *columns = places_of(g);
          const double *row_values = &functionals.value[functionals.begin[f]];
          const double *column_values =
            &functionals.value[functionals.begin[g]];
          const unsigned int n_rows    = places[f].size(),
                             n_columns = places[g].size();
          for (unsigned int k = 0; k < n_rows; ++k)
            for (unsigned int l = 0; l < n_columns; ++l)
              add(rows[k],
                  columns[l],
                  factor * row_values[k] * column_values[l]);
        }
    return entries;
  }



  void
  ContactSubspace::update(const TangentOperator &tangent)
  {
    communicator = tangent.communicator;
    unknowns.clear();
    own.clear();
    if (!is_stiff(tangent))
      return;
    unknowns = of_all_ranks(unknowns_of_contact(tangent), communicator);
    sort_and_make_unique(unknowns);
    std::vector<Index> clamped;
    for (const Index unknown : unknowns)
      if (tangent.clamped_unknowns().is_element(unknown))
        clamped.push_back(unknown);
    clamped = of_all_ranks(clamped, communicator);
    std::sort(clamped.begin(), clamped.end());
    unknowns.erase(std::remove_if(unknowns.begin(),
                                  unknowns.end(),
                                  [&](const Index unknown) {
                                    return std::binary_search(clamped.begin(),
                                                              clamped.end(),
                                                              unknown);
                                  }),
                   unknowns.end());
    for (unsigned int place = 0; place < unknowns.size(); ++place)
      if (tangent.owned_unknowns().is_element(unknowns[place]))
        own.push_back(
          {static_cast<unsigned int>(
             tangent.owned_unknowns().index_within_set(unknowns[place])),
           place});

    // CHOLMOD reads the lower triangle.
    std::vector<Eigen::Triplet<double>> triplets;
    for (const auto &[row, column, value] :
         of_all_ranks(own_entries(tangent), communicator))
      triplets.emplace_back(std::max(row, column),
                            std::min(row, column),
                            row == column ? value : .5 * value);
    Eigen::SparseMatrix<double> matrix(unknowns.size(), unknowns.size());
    matrix.setFromTriplets(triplets.begin(), triplets.end());
    factor = std::make_unique<Factor>();
    factor->cholesky.compute(matrix);
    if (factor->cholesky.info() != Eigen::Success)
      {
        unknowns.clear();
        own.clear();
      }
  }



  void
  ContactSubspace::solve(std::vector<double> &values) const
  {
    Utilities::MPI::sum(values, communicator, values);
    Eigen::Map<Eigen::VectorXd> vector(values.data(), values.size());
    vector = factor->cholesky.solve(vector).eval();
  }
} // namespace Ricochet
