// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <solvers/functional_places.h>
#include <solvers/tangent_region.h>

#include <deal.II/base/mpi.h>

#include <Eigen/KLUSupport>
#include <Epetra_CrsMatrix.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Of all unknowns. Twice as many save few iterations more, and take longer.
    constexpr double region_share = .05;

    constexpr unsigned int not_there = numbers::invalid_unsigned_int;

    /// An entry of a matrix.
    struct Entry
    {
      unsigned int row, column;
      double       value;
    };

    /// This rank's rows of a matrix, one behind the other.
    struct Rows
    {
      explicit Rows(const Matrix &of)
        : matrix(of.trilinos_matrix())
      {
        const int error = matrix.ExtractCrsDataPointers(begin, column, value);
        AssertThrow(error == 0, ExcTrilinosError(error));
      }

      unsigned int
      size() const
      {
        return matrix.NumMyRows();
      }

      const Epetra_CrsMatrix &matrix;
      int                    *begin = nullptr, *column = nullptr;
      double                 *value = nullptr;
    };

    /// Place of each unknown in the ascending @p region.
    class Places
    {
    public:
      explicit Places(const TangentRegion::Unknowns &region)
        : places(region.empty() ? 0 : region.back() + 1, not_there)
      {
        for (unsigned int place = 0; place < region.size(); ++place)
          places[region[place]] = place;
      }

      unsigned int
      operator()(const types::global_dof_index unknown) const
      {
        return unknown < places.size() ? places[unknown] : not_there;
      }

    private:
      std::vector<unsigned int> places;
    };

    void
    sort_and_unite(TangentRegion::Unknowns &unknowns)
    {
      std::sort(unknowns.begin(), unknowns.end());
      unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                     unknowns.end());
    }

    /// The unknowns of the largest entries.
    TangentRegion::Unknowns
    largest(const Vector &vector)
    {
      const MPI_Comm      communicator = vector.get_mpi_communicator();
      const double       *own          = vector.trilinos_vector()[0];
      const std::size_t   n_own        = vector.locally_owned_size();
      std::vector<double> sizes(own, own + n_own);
      for (double &size : sizes)
        size = std::abs(size);
      std::vector<double> all = of_all_ranks(sizes, communicator);
      const auto          last =
        all.begin() + static_cast<std::ptrdiff_t>(region_share * all.size());
      std::nth_element(all.begin(), last, all.end(), std::greater<>());
      const IndexSet          indices = vector.locally_owned_elements();
      TangentRegion::Unknowns unknowns;
      for (std::size_t i = 0; i < n_own; ++i)
        if (sizes[i] > *last)
          unknowns.push_back(indices.nth_index_in_set(i));
      unknowns = of_all_ranks(unknowns, communicator);
      sort_and_unite(unknowns);
      return unknowns;
    }

    /// Call @p action with each unknown of a functional, and its coefficient.
    template <typename Action>
    void
    for_each_unknown(const Functionals &functionals,
                     const unsigned int number,
                     const Action      &action)
    {
      for (std::size_t k = functionals.begin[number];
           k < functionals.begin[number + 1];
           ++k)
        action(functionals.index[k], functionals.value[k]);
    }

    /// Add the unknowns that @p contact couples with those of the @p region.
    void
    add_contact(const std::vector<NumberedRows> &contact,
                const Functionals               &functionals,
                TangentRegion::Unknowns         &region)
    {
      const Places            places(region);
      TangentRegion::Unknowns coupled;
      for (const NumberedRows &row : contact)
        {
          coupled.clear();
          bool       touches = false;
          const auto add     = [&](const auto unknown, const double) {
            coupled.push_back(unknown);
            touches = touches || places(unknown) != not_there;
          };
          for_each_unknown(functionals, row.number, add);
          for (const FunctionalRow &of_row : row.rows)
            for (const auto &entry : of_row)
              for_each_unknown(functionals, entry.first, add);
          if (touches)
            region.insert(region.end(), coupled.begin(), coupled.end());
        }
      sort_and_unite(region);
    }

    /// Append the entries between unknowns of a region of one of the matrices of @p contact.
    void
    add_entries(const std::vector<NumberedRows> &contact,
                const unsigned int               which,
                const Functionals               &functionals,
                const Places                    &places,
                std::vector<Entry>              &entries)
    {
      for (const NumberedRows &row : contact)
        for (const auto &[other, change] : row.rows[which])
          for_each_unknown(
            functionals,
            row.number,
            [&, other = other, change = change](const auto   i,
                                                const double along_i) {
              const unsigned int place = places(i);
              if (place != not_there)
                for_each_unknown(functionals,
                                 other,
                                 [&](const auto j, const double along_j) {
                                   const unsigned int column = places(j);
                                   if (column != not_there)
                                     entries.push_back(
                                       {place,
                                        column,
                                        along_i * change * along_j});
                                 });
            });
    }
  } // namespace



  struct TangentRegion::SmallSystem
  {
    Eigen::KLU<Eigen::SparseMatrix<double>> factors;
    Eigen::Index                            n = 0;

    /// An unknown of this rank in the region: its place there and here, and what makes its
    /// equation one of forces.
    struct Own
    {
      unsigned int place, local;
      double       scaling;
    };
    std::vector<Own> own;

    /// K - T: rows of this rank, columns by place.
    std::vector<Entry> difference;
  };



  TangentRegion::TangentRegion() = default;



  TangentRegion::~TangentRegion() = default;



  void
  TangentRegion::forget()
  {
    small.reset();
  }



  bool
  TangentRegion::exists() const
  {
    return small != nullptr;
  }



  const Functionals &
  TangentRegion::functionals(const CondensedSystem &system)
  {
    const auto &contact = system.acts_through();
    if (numbers.empty())
      numbers = FunctionalPlaces(contact, communicator).numbers;
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return contact.functionals;
    if (!all_functionals)
      all_functionals =
        functionals_of_all_ranks(contact.functionals, communicator);
    return *all_functionals;
  }



  std::vector<NumberedRows>
  TangentRegion::rows_of_contact(const Tangent         &contact,
                                 const CondensedSystem &system)
  {
    std::vector<FunctionalRow> change(system.n_known()),
      excess_change(system.n_known());
    contact.contact_change(change);
    contact.contact_excess_change(excess_change);
    return rows_of_all_ranks(std::move(change),
                             std::move(excess_change),
                             numbers,
                             communicator);
  }



  void
  TangentRegion::find(
    const Vector                                          &residual,
    const Tangent                                         &contact,
    const CondensedSystem                                 &kept,
    const std::function<void(const Unknowns &, Matrix &)> &add_difference)
  {
    forget();
    communicator                  = residual.get_mpi_communicator();
    const Functionals &all        = functionals(kept);
    const auto         of_contact = rows_of_contact(contact, kept);
    Unknowns           region     = largest(residual);
    add_contact(of_contact, all, region);
    if (region.empty())
      return;
    const Places places(region);

    if (difference.m() != kept.body_matrix().m())
      difference.reinit(kept.body_matrix());
    difference = 0.;
    add_difference(region, difference);

    auto               system = std::make_unique<SmallSystem>();
    std::vector<Entry> entries;
    system->n = region.size();
    const Rows change(difference), old(kept.body_matrix());
    const int *columns = change.matrix.ColMap().MyGlobalElements();
    for (unsigned int row = 0; row < change.size(); ++row)
      {
        const unsigned int place = places(change.matrix.GRID(row));
        if (place != not_there)
          system->own.push_back(
            {place, row, contact.row_scaling->trilinos_vector()[0][row]});
        for (int k = change.begin[row]; k < change.begin[row + 1]; ++k)
          {
            if (place == not_there && change.value[k] == 0.)
              continue;
            const unsigned int column = places(columns[change.column[k]]);
            if (column == not_there)
              continue;
            if (change.value[k] != 0.)
              system->difference.push_back({row, column, change.value[k]});
            if (place != not_there)
              entries.push_back(
                {place, column, old.value[k] + change.value[k]});
          }
      }
    entries           = of_all_ranks(entries, communicator);
    const auto sparse = [&](const std::vector<Entry> &of) {
      std::vector<Eigen::Triplet<double>> triplets;
      triplets.reserve(of.size());
      for (const Entry &entry : of)
        triplets.emplace_back(entry.row, entry.column, entry.value);
      Eigen::SparseMatrix<double> matrix(system->n, system->n);
      matrix.setFromTriplets(triplets.begin(), triplets.end());
      return matrix;
    };
    std::vector<Entry> taken;
    add_entries(of_contact, 1, all, places, taken);
    Eigen::SparseMatrix<double> matrix;
    if (taken.empty())
      {
        add_entries(of_contact, 0, all, places, entries);
        matrix = sparse(entries);
      }
    else
      {
        std::vector<Entry> put;
        add_entries(of_contact, 0, all, places, put);
        const Eigen::SparseMatrix<double> body = sparse(entries);
        matrix = body + sparse(taken) * body + sparse(put);
      }
    system->factors.compute(matrix);
    if (system->factors.info() == Eigen::Success)
      small = std::move(system);
  }



  void
  TangentRegion::complete(std::vector<double> &force) const
  {
    std::vector<double> residual(small->n, 0.);
    for (const auto &own : small->own)
      residual[own.place] = force[own.local] / own.scaling;
    Utilities::MPI::sum(residual, communicator, residual);
    const Eigen::VectorXd displacement = small->factors.solve(
      Eigen::Map<const Eigen::VectorXd>(residual.data(), small->n));
    for (const Entry &entry : small->difference)
      force[entry.row] -= entry.value * displacement[entry.column];
  }
} // namespace Ricochet
