// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_wait_asleep_h
#define ricochet_base_wait_asleep_h

#include <mpi.h>

#include <chrono>
#include <optional>
#include <thread>

namespace Ricochet
{
  /// Wait until @p request is complete, or @p patience is at an end, without taking a core
  /// as MPI's own waiting does. @return whether it is complete.
  inline bool
  wait_asleep(MPI_Request                              &request,
              const std::optional<std::chrono::seconds> patience = {})
  {
    const auto begin = std::chrono::steady_clock::now();
    while (true)
      {
        int done = 0;
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        if (done != 0)
          return true;
        if (patience && std::chrono::steady_clock::now() - begin > *patience)
          return false;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
  }
} // namespace Ricochet

#endif
