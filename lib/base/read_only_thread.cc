// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/read_only_thread.h>

#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>

#include <cerrno>
#include <csignal>
#include <cstddef>
#include <exception>
#include <fcntl.h>
#include <sched.h>
#include <stdexcept>
#include <thread>
#include <vector>

namespace Ricochet
{
  namespace
  {
    // Instructions (BPF) that the kernel follows at each system call.
    using Filter = std::vector<sock_filter>;

    sock_filter
    load(const std::size_t place)
    {
      return BPF_STMT(BPF_LD | BPF_W | BPF_ABS,
                      static_cast<unsigned int>(place));
    }

    sock_filter
    answer(const unsigned int value)
    {
      return BPF_STMT(BPF_RET | BPF_K, value);
    }

    /// The lower half of an argument, on machines that store it first.
    std::size_t
    place_of_argument(const unsigned int n)
    {
      return offsetof(seccomp_data, args) + 8 * n;
    }

    /// Give the @p value for an answer to the system call @p number.
    void
    forbid(Filter            &filter,
           const unsigned int number,
           const unsigned int value = SECCOMP_RET_KILL_PROCESS)
    {
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1));
      filter.push_back(answer(value));
    }

    /// Forbid the system call @p number if its argument has one of @p flags, or, with
    /// @p unless, if it has none.
    void
    forbid_with(Filter            &filter,
                const unsigned int number,
                const unsigned int argument,
                const unsigned int flags,
                const bool         unless = false)
    {
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 4));
      filter.push_back(load(place_of_argument(argument)));
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JSET | BPF_K,
                                flags,
                                static_cast<unsigned char>(unless ? 1 : 0),
                                static_cast<unsigned char>(unless ? 0 : 1)));
      filter.push_back(answer(SECCOMP_RET_KILL_PROCESS));
      filter.push_back(answer(SECCOMP_RET_ALLOW));
    }

    Filter
    read_only_filter()
    {
#if defined(__x86_64__)
      constexpr unsigned int machine = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
      constexpr unsigned int machine = AUDIT_ARCH_AARCH64;
#else
#  error "Which numbers system calls have on this machine is not known."
#endif
      Filter filter = {load(offsetof(seccomp_data, arch)),
                       BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0),
                       answer(SECCOMP_RET_KILL_PROCESS),
                       load(offsetof(seccomp_data, nr))};
      // Other numbers of the same machine (x32).
      filter.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, 0x40000000U, 0, 1));
      filter.push_back(answer(SECCOMP_RET_KILL_PROCESS));
      for (const unsigned int number : {
#ifdef __NR_fork
             __NR_fork,          __NR_vfork,
             __NR_creat,         __NR_unlink,
             __NR_rename,        __NR_mkdir,
             __NR_rmdir,         __NR_link,
             __NR_symlink,       __NR_mknod,
             __NR_chmod,         __NR_chown,
             __NR_lchown,        __NR_utime,
             __NR_utimes,        __NR_futimesat,
             __NR_renameat,
#endif
             __NR_execve,        __NR_execveat,
             __NR_unlinkat,      __NR_renameat2,
             __NR_mkdirat,       __NR_linkat,
             __NR_symlinkat,     __NR_mknodat,
             __NR_fchmodat,      __NR_fchownat,
             __NR_utimensat,     __NR_truncate,
             __NR_setxattr,      __NR_lsetxattr,
             __NR_removexattr,   __NR_lremovexattr,
             __NR_kill,          __NR_tkill,
             __NR_ptrace,        __NR_process_vm_writev,
             __NR_socket,        __NR_mount,
             __NR_io_uring_setup})
        forbid(filter, number);
      constexpr unsigned int writing =
        O_WRONLY | O_RDWR | O_CREAT | O_TRUNC | O_APPEND;
#ifdef __NR_open
      forbid_with(filter, __NR_open, 1, writing);
#endif
      forbid_with(filter, __NR_openat, 2, writing);
      // A process is not made, a thread is.
      forbid_with(filter, __NR_clone, 0, CLONE_THREAD, true);
      // Their arguments lie in memory, where they cannot be looked at. The C library takes
      // the calls above if there are none of these.
      for (const unsigned int number : {__NR_clone3, __NR_openat2})
        forbid(filter, number, SECCOMP_RET_ERRNO | ENOSYS);
      filter.push_back(answer(SECCOMP_RET_ALLOW));
      return filter;
    }

    void
    forbid_all_but_reading()
    {
      Filter           filter = read_only_filter();
      const sock_fprog text{static_cast<unsigned short>(filter.size()),
                            filter.data()};
      if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0 ||
          prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &text) != 0)
        throw std::runtime_error(
          "this machine cannot forbid it to start programs and to write files "
          "(seccomp)");
    }
  } // namespace



  void
  run_read_only(const std::function<void()> &task)
  {
    std::exception_ptr problem;
    std::thread        thread([&]() {
      try
        {
          forbid_all_but_reading();
          task();
        }
      catch (...)
        {
          problem = std::current_exception();
        }
    });
    thread.join();
    if (problem)
      std::rethrow_exception(problem);
  }
} // namespace Ricochet
