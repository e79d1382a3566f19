// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_last_meeting_h
#define ricochet_base_last_meeting_h

#include <base/one_rank.h>
#include <base/wait_asleep.h>

#include <mpi.h>

#include <chrono>

namespace Ricochet
{
  /**
   * Ranks that end with an error. The error is thrown on all of them alike,
   * unless an input such as an expression fails on one rank only: then the
   * others wait for a message that never comes, and no collective operation is
   * possible any more. One object lives as long as a program runs.
   */
  class LastMeeting
  {
  public:
    /// Collective.
    LastMeeting()
    {
      MPI_Comm_dup(MPI_COMM_WORLD, &communicator);
      current = this;
    }

    ~LastMeeting()
    {
      current = nullptr;
      MPI_Comm_free(&communicator);
    }

    LastMeeting(const LastMeeting &) = delete;
    LastMeeting &
    operator=(const LastMeeting &) = delete;

    /// Whether all ranks come here within five seconds; those that wait for one that is
    /// alone need not. After one failed meeting there is no other.
    static bool
    is_complete()
    {
      return !current || OneRank::is_alone() || current->wait();
    }

  private:
    bool
    wait()
    {
      constexpr auto patience = std::chrono::seconds(5);
      if (has_failed)
        return false;
      MPI_Request request;
      MPI_Ibarrier(communicator, &request);
      has_failed = !wait_asleep(request, patience);
      return !has_failed;
    }

    inline static LastMeeting *current      = nullptr;
    MPI_Comm                   communicator = MPI_COMM_NULL;
    bool                       has_failed   = false;
  };
} // namespace Ricochet

#endif
