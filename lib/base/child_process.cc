// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/child_process.h>
#include <base/exceptions.h>
#include <base/read_only_thread.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <new>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace Ricochet
{
  namespace
  {
    enum ExitCode
    {
      failed        = 1,
      out_of_memory = 2,
      // Exit code that a library's own exit() does not use.
      good_end = 77
    };

    /// @param parent must still be there.
    void
    prepare_child(const pid_t parent)
    {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      if (getppid() != parent)
        _exit(failed);
      // Exceptions end here, before std::terminate().
      std::set_new_handler([]() { _exit(out_of_memory); });
      // MPI's handlers would print pages about a crash.
      for (const int signal :
           {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGALRM})
        std::signal(signal, SIG_DFL);
      const rlimit no_core = {0, 0};
      setrlimit(RLIMIT_CORE, &no_core);
      // The user's limit may be lower.
      const rlim_t memory = static_cast<rlim_t>(sysconf(_SC_PHYS_PAGES)) *
        sysconf(_SC_PAGE_SIZE) / 5 * 4;
      rlimit most = {memory, memory};
      getrlimit(RLIMIT_AS, &most);
      most.rlim_cur = std::min(most.rlim_cur, memory);
      setrlimit(RLIMIT_AS, &most);
      const int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, STDOUT_FILENO);
      dup2(nowhere, STDERR_FILENO);
    }

    /// @return the message of an exception, in a few kilobytes at most.
    ExitCode
    run_task(const std::function<void()> &task, std::string &message)
    {
      try
        {
          task();
          return good_end;
        }
      catch (const std::bad_alloc &)
        {
          return out_of_memory;
        }
      catch (const std::exception &problem)
        {
          message = std::string(problem.what()).substr(0, 4000);
          return failed;
        }
    }

    std::string
    read_all(const int file)
    {
      std::string            text;
      std::array<char, 4096> buffer;
      while (true)
        {
          const ssize_t n = read(file, buffer.data(), buffer.size());
          if (n > 0)
            text.append(buffer.data(), n);
          else if (n == 0 || errno != EINTR)
            return text;
        }
    }
  } // namespace



  void
  run_apart(const std::string           &who,
            const std::function<void()> &task,
            const unsigned int           seconds)
  {
    std::array<int, 2> pipe_ends;
    if (pipe2(pipe_ends.data(), O_CLOEXEC) != 0)
      throw ComputationError("No pipe can be made for " + who + ": " +
                             std::strerror(errno) + ".");
    const pid_t parent = getpid();
    const pid_t child  = fork();
    if (child < 0)
      {
        close(pipe_ends[0]);
        close(pipe_ends[1]);
        throw ComputationError("No process can be made for " + who + ": " +
                               std::strerror(errno) + ".");
      }
    if (child == 0)
      {
        close(pipe_ends[0]);
        prepare_child(parent);
        alarm(seconds);
        std::string    message;
        const ExitCode code = run_task(task, message);
        const ssize_t  written =
          write(pipe_ends[1], message.data(), message.size());
        // No finalisation of MPI and of static objects: both belong to the
        // parent.
        _exit(written == static_cast<ssize_t>(message.size()) ? code : failed);
      }
    close(pipe_ends[1]);
    const std::string message = read_all(pipe_ends[0]);
    close(pipe_ends[0]);
    int status = 0;
    while (waitpid(child, &status, 0) < 0 && errno == EINTR)
      ;

    if (WIFSIGNALED(status) && WTERMSIG(status) == forbidden_call)
      throw InputError(
        who +
        " was to start a program, or to write or remove a file, which a script of "
        "geometry may not do here. If you trust it, run it by itself and name the "
        "mesh that it makes.");
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
      throw InputError(who + " did not come to an end within " +
                       std::to_string(seconds) +
                       " s; Limits/Meshing time allows more.");
    if (WIFSIGNALED(status))
      throw InputError(who + " crashed (" + strsignal(WTERMSIG(status)) + ").");
    switch (WEXITSTATUS(status))
      {
        case good_end:
          return;
        case out_of_memory:
          throw InputError(who +
                           " ran out of memory: the mesh would be too fine.");
        case failed:
          if (!message.empty())
            throw InputError(message);
          [[fallthrough]];
        default:
          throw InputError(who + " ended before the work was done.");
      }
  }
} // namespace Ricochet
