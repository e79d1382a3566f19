// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_all_ranks_h
#define ricochet_base_all_ranks_h

#include <deal.II/base/exceptions.h>
#include <deal.II/base/mpi.h>

#include <limits>
#include <numeric>
#include <type_traits>
#include <vector>

namespace Ricochet
{
  /// The lists of all ranks, concatenated. (deal.II's all_gather() compresses
  /// what it sends, which takes longer than all that is done with it.)
  /// Collective.
  template <typename T>
  std::vector<T>
  of_all_ranks(const std::vector<T> &own, const MPI_Comm communicator)
  {
    const unsigned int n_ranks =
      dealii::Utilities::MPI::n_mpi_processes(communicator);
    if (n_ranks == 1)
      return own;
    static_assert(std::is_trivially_copyable<T>::value,
                  "It is sent byte by byte.");
    const auto       n_own = static_cast<int>(own.size() * sizeof(T));
    std::vector<int> n_bytes(n_ranks), begin(n_ranks, 0);
    int              error = MPI_Allgather(&n_own,
                              1,
                              MPI_INT,
                              n_bytes.data(),
                              1,
                              MPI_INT,
                              communicator);
    AssertThrowMPI(error);
    for (unsigned int rank = 1; rank < n_ranks; ++rank)
      begin[rank] = begin[rank - 1] + n_bytes[rank - 1];
    AssertThrow(std::accumulate(n_bytes.begin(), n_bytes.end(), 0.) <
                  std::numeric_limits<int>::max(),
                dealii::ExcMessage("Too much for one message."));
    std::vector<T> all((begin.back() + n_bytes.back()) / sizeof(T));
    error = MPI_Allgatherv(own.data(),
                           n_own,
                           MPI_BYTE,
                           all.data(),
                           n_bytes.data(),
                           begin.data(),
                           MPI_BYTE,
                           communicator);
    AssertThrowMPI(error);
    return all;
  }
} // namespace Ricochet

#endif
