// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/stop_request.h>

#include <deal.II/base/mpi.h>

namespace Ricochet
{
  namespace
  {
    volatile std::sig_atomic_t signal_that_came = 0;

    void
    remember(const int signal)
    {
      if (signal_that_came != 0)
        {
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      signal_that_came = signal;
    }

    void
    remember_unless_ignored(const int signal, struct sigaction &old_action)
    {
      sigaction(signal, nullptr, &old_action);
      if (old_action.sa_handler == SIG_IGN)
        return;
      struct sigaction action = {};
      action.sa_handler       = remember;
      // Files are written to their end.
      action.sa_flags = SA_RESTART;
      sigaction(signal, &action, nullptr);
    }
  } // namespace



  StopRequest::StopRequest()
  {
    signal_that_came = 0;
    remember_unless_ignored(SIGINT, old_interrupt);
    remember_unless_ignored(SIGTERM, old_terminate);
  }



  StopRequest::~StopRequest()
  {
    sigaction(SIGINT, &old_interrupt, nullptr);
    sigaction(SIGTERM, &old_terminate, nullptr);
  }



  int
  StopRequest::signal(const MPI_Comm communicator)
  {
    return dealii::Utilities::MPI::max(static_cast<int>(signal_that_came),
                                       communicator);
  }



  std::string
  StopRequest::name_of(const int signal)
  {
    return signal == SIGINT ? "SIGINT" : "SIGTERM";
  }
} // namespace Ricochet
