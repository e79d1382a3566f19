// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <solvers/functional_places.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <numeric>

namespace Ricochet
{
  std::vector<unsigned int>
  places_in_order(const std::vector<double> &order)
  {
    std::vector<unsigned int> functional_at(order.size()), places(order.size());
    std::iota(functional_at.begin(), functional_at.end(), 0);
    std::stable_sort(functional_at.begin(),
                     functional_at.end(),
                     [&](const unsigned int a, const unsigned int b) {
                       return order[a] < order[b];
                     });
    for (unsigned int place = 0; place < places.size(); ++place)
      places[functional_at[place]] = place;
    return places;
  }



  Functionals
  functionals_of_all_ranks(const Functionals &own, const MPI_Comm communicator)
  {
    std::vector<std::size_t> n_entries;
    for (unsigned int f = 0; f < own.size(); ++f)
      n_entries.push_back(own.begin[f + 1] - own.begin[f]);
    Functionals all;
    for (const std::size_t n : of_all_ranks(n_entries, communicator))
      all.begin.push_back(all.begin.back() + n);
    all.index = of_all_ranks(own.index, communicator);
    all.value = of_all_ranks(own.value, communicator);
    return all;
  }



  FunctionalPlaces::FunctionalPlaces(
    const ContactStructure::ActsThrough &contact,
    const MPI_Comm                       communicator)
    : numbers(contact.functionals.size())
    , place_of_number(
        places_in_order(of_all_ranks(contact.order, communicator)))
  {
    std::vector<unsigned int> first(1, 0);
    for (const unsigned int n :
         of_all_ranks(std::vector<unsigned int>{contact.functionals.size()},
                      communicator))
      first.push_back(first.back() + n);
    std::iota(numbers.begin(),
              numbers.end(),
              first[dealii::Utilities::MPI::this_mpi_process(communicator)]);
    for (const auto &[rank, number] : contact.elsewhere)
      numbers.push_back(first[rank] + number);
  }
} // namespace Ricochet
