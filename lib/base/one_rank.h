// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_one_rank_h
#define ricochet_base_one_rank_h

#include <mpi.h>

#include <cstddef>

namespace Ricochet
{
  /// A run on several MPI ranks is faster on one of them: thrown on all ranks while it is
  /// set up, and taken by run_program(), which begins anew on the first one.
  struct OneRankSuffices
  {
    explicit OneRankSuffices(const std::size_t n_unknowns)
      : n_unknowns(n_unknowns)
    {}

    std::size_t n_unknowns;
  };

  /// A run that the first one of several ranks makes alone, while the others wait.
  class OneRank
  {
  public:
    /// All ranks of the run: MPI_COMM_WORLD, or MPI_COMM_SELF on the first one when it is
    /// alone.
    static MPI_Comm
    communicator();

    /// The first rank is alone from here on. Collective.
    static void
    begin();

    /// Whether this is the rank that is alone.
    static bool
    is_alone();

    /// On the first rank: the others end, with this exit @p code.
    static void
    release(const int code);

    /// On the others: wait for it, asleep. Signals are left to the first rank.
    static int
    wait();
  };
} // namespace Ricochet

#endif
