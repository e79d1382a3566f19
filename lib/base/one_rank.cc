// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/one_rank.h>
#include <base/stop_request.h>
#include <base/wait_asleep.h>

namespace Ricochet
{
  namespace
  {
    bool alone = false;
  }



  MPI_Comm
  OneRank::communicator()
  {
    return alone ? MPI_COMM_SELF : MPI_COMM_WORLD;
  }



  void
  OneRank::begin()
  {
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    alone = rank == 0;
  }



  bool
  OneRank::is_alone()
  {
    return alone;
  }



  void
  OneRank::release(const int code)
  {
    int         copy = code;
    MPI_Request request;
    MPI_Ibcast(&copy, 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
    MPI_Wait(&request, MPI_STATUS_IGNORE);
  }



  int
  OneRank::wait()
  {
    const StopRequest no_signals;
    int               code = 0;
    MPI_Request       request;
    MPI_Ibcast(&code, 1, MPI_INT, 0, MPI_COMM_WORLD, &request);
    wait_asleep(request);
    return code;
  }
} // namespace Ricochet
