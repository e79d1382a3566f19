// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/active_set_signature.h>

#include <deal.II/base/mpi.h>

namespace Ricochet
{
  std::string
  count_active(const std::vector<int> &values, const MPI_Comm communicator)
  {
    unsigned int n_active = 0;
    for (const int value : values)
      n_active += value != 0;
    const std::vector<unsigned int> my_counts = {n_active,
                                                 static_cast<unsigned int>(
                                                   values.size())};
    std::vector<unsigned int>       counts(2);
    dealii::Utilities::MPI::sum(my_counts, communicator, counts);
    return std::to_string(counts[0]) + " of " + std::to_string(counts[1]);
  }



  std::uint64_t
  global_hash(const std::vector<int> &values, const MPI_Comm communicator)
  {
    // A chain of full mixings (splitmix64) over rank, number of values and
    // values on each rank; the sum over the ranks is then practically a random
    // number. Without the mixing, changes on two ranks could cancel.
    const auto mix = [](std::uint64_t x) {
      x += 0x9e3779b97f4a7c15ull;
      x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
      x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
      return x ^ (x >> 31);
    };
    std::uint64_t hash =
      mix(dealii::Utilities::MPI::this_mpi_process(communicator) + 1);
    hash = mix(hash ^ values.size());
    for (const int value : values)
      hash = mix(hash ^ static_cast<std::uint64_t>(value));
    return dealii::Utilities::MPI::sum(hash, communicator);
  }
} // namespace Ricochet
