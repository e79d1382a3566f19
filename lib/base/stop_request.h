// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_stop_request_h
#define ricochet_base_stop_request_h

#include <mpi.h>

#include <csignal>
#include <string>

namespace Ricochet
{
  /**
   * Signals by which a user or a batch system asks a run to end: SIGINT (Ctrl-C) and
   * SIGTERM. While an object of this class lives, the first one is remembered, and a
   * second one ends the process at once. A signal that was ignored when the program was
   * started, as nohup and shells in the background do, stays ignored.
   */
  class StopRequest
  {
  public:
    StopRequest();

    /// Signals act again as they did before.
    ~StopRequest();

    StopRequest(const StopRequest &) = delete;
    StopRequest &
    operator=(const StopRequest &) = delete;

    /// The signal that has come to one of the ranks, or zero. Collective.
    static int
    signal(const MPI_Comm communicator);

    /// "SIGINT" or "SIGTERM"
    static std::string
    name_of(const int signal);

  private:
    struct sigaction old_interrupt = {};
    struct sigaction old_terminate = {};
  };
} // namespace Ricochet

#endif
