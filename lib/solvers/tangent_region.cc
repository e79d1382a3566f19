// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/matrix_entries.h>
#include <solvers/tangent_region.h>

#include <Eigen/KLUSupport>

#include <algorithm>
#include <array>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Size of the region relative to all unknowns. A region of twice the size
    /// saves few iterations, and takes longer.
    constexpr double region_share = .05;

    constexpr unsigned int not_there = numbers::invalid_unsigned_int;

    /// An entry of a matrix.
    struct Entry
    {
      unsigned int row, column;
      double       value;
    };

    /// Index of each unknown in the ascending @p region.
    class Places
    {
    public:
      explicit Places(const UnknownList &region)
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
    sort_and_unite(UnknownList &unknowns)
    {
      std::sort(unknowns.begin(), unknowns.end());
      unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                     unknowns.end());
    }

    /// The unknowns of the largest entries.
    UnknownList
    largest(const Vector &vector)
    {
      std::vector<double> sizes(vector.begin(), vector.end());
      for (double &size : sizes)
        size = std::abs(size);
      std::vector<double> sorted(sizes);
      const auto          last = sorted.begin() +
        static_cast<std::ptrdiff_t>(region_share * sizes.size());
      std::nth_element(sorted.begin(), last, sorted.end(), std::greater<>());
      UnknownList unknowns;
      for (std::size_t i = 0; i < sizes.size(); ++i)
        if (sizes[i] > *last)
          unknowns.push_back(i);
      return unknowns;
    }

    /// Call @p action with each unknown of a row of the contact Jacobian, and
    /// its coefficient.
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

    /// The derivatives C and E of contact, by row.
    using ContactRows = std::array<std::vector<FunctionalRow>, 2>;

    /// Add the unknowns that are coupled to those of the @p region by
    /// @p contact.
    void
    add_contact(const ContactRows &contact,
                const Functionals &functionals,
                UnknownList       &region)
    {
      const Places places(region);
      UnknownList  coupled;
      for (unsigned int f = 0; f < functionals.size(); ++f)
        {
          if (contact[0][f].empty() && contact[1][f].empty())
            continue;
          coupled.clear();
          bool       touches = false;
          const auto add     = [&](const auto unknown, const double) {
            coupled.push_back(unknown);
            touches = touches || places(unknown) != not_there;
          };
          for_each_unknown(functionals, f, add);
          for (const std::vector<FunctionalRow> &rows : contact)
            for (const auto &entry : rows[f])
              for_each_unknown(functionals, entry.first, add);
          if (touches)
            region.insert(region.end(), coupled.begin(), coupled.end());
        }
      sort_and_unite(region);
    }

    /// The entries of a matrix between rows of contact that are between unknowns of a
    /// region.
    std::vector<Entry>
    entries_of(const std::vector<FunctionalRow> &rows,
               const Functionals                &functionals,
               const Places                     &places)
    {
      std::vector<Entry> entries;
      for (unsigned int f = 0; f < functionals.size(); ++f)
        for (const auto &[other, change] : rows[f])
          for_each_unknown(
            functionals,
            f,
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
      return entries;
    }

    Eigen::SparseMatrix<double>
    sparse_matrix(const std::vector<Entry> &entries, const Eigen::Index n)
    {
      std::vector<Eigen::Triplet<double>> triplets;
      triplets.reserve(entries.size());
      for (const Entry &entry : entries)
        triplets.emplace_back(entry.row, entry.column, entry.value);
      Eigen::SparseMatrix<double> matrix(n, n);
      matrix.setFromTriplets(triplets.begin(), triplets.end());
      return matrix;
    }
  } // namespace



  struct TangentRegion::SmallSystem
  {
    Eigen::KLU<Eigen::SparseMatrix<double>> factors;
    Eigen::Index                            n = 0;

    /// An unknown in the region: its index there and on this rank, and the
    /// scaling of its equation to forces.
    struct Own
    {
      unsigned int place, local;
      double       scaling;
    };
    std::vector<Own> own;

    /// K - T: rows by local number, columns by index in the region.
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



  void
  TangentRegion::find(
    const Vector                                             &residual,
    const Tangent                                            &contact,
    const ContactSchurComplement                             &kept,
    const std::function<void(const UnknownList &, Matrix &)> &add_difference)
  {
    forget();
    const Functionals &functionals = kept.rows();
    ContactRows        of_contact;
    of_contact.fill(std::vector<FunctionalRow>(kept.n_rows()));
    contact.differentiate_contact(of_contact[0], of_contact[1]);
    UnknownList region = largest(residual);
    add_contact(of_contact, functionals, region);
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
    const MatrixEntries change(difference), old(kept.body_matrix());
    AssertThrow(change.size() == old.size(),
                ExcMessage("The matrices have the same pattern."));
    for (unsigned int row = 0; row < change.n_rows(); ++row)
      {
        const unsigned int place = places(change.row_index(row));
        if (place != not_there)
          system->own.push_back(
            {place, row, local_values(*contact.row_scaling)[row]});
        for (int k = change.begin[row]; k < change.begin[row + 1]; ++k)
          {
            if (place == not_there && change.value[k] == 0.)
              continue;
            const unsigned int column =
              places(change.column_index(change.column[k]));
            if (column == not_there)
              continue;
            if (change.value[k] != 0.)
              system->difference.push_back({row, column, change.value[k]});
            if (place != not_there)
              entries.push_back(
                {place, column, old.value[k] + change.value[k]});
          }
      }
    const Eigen::SparseMatrix<double>
      body  = sparse_matrix(entries, system->n),
      put   = sparse_matrix(entries_of(of_contact[0], functionals, places),
                          system->n),
      taken = sparse_matrix(entries_of(of_contact[1], functionals, places),
                            system->n);
    const Eigen::SparseMatrix<double> matrix = body + taken * body + put;
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
    const Eigen::VectorXd displacement = small->factors.solve(
      Eigen::Map<const Eigen::VectorXd>(residual.data(), small->n));
    for (const Entry &entry : small->difference)
      force[entry.row] -= entry.value * displacement[entry.column];
  }
} // namespace Ricochet
