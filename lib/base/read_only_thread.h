// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_read_only_thread_h
#define ricochet_base_read_only_thread_h

#include <csignal>
#include <functional>

namespace Ricochet
{
  /// The signal by which Linux ends a process for a forbidden system call.
  constexpr int forbidden_call = SIGSYS;

  /**
   * Run @p task in a thread that can read files, but neither write, make nor remove any,
   * nor start programs, nor reach a network: for libraries that execute what a stranger's
   * file says. A script that tries ends the whole process with the signal
   * #forbidden_call, so that it belongs into a child, see run_apart(). Other
   * threads of the process are not restricted; all have the same memory.
   *
   * The kernel enforces this (seccomp(2)): a list of the library's many
   * statements would not be complete.
   *
   * @throws std::runtime_error where the kernel cannot do it, and the
   * exceptions of the task.
   */
  void
  run_read_only(const std::function<void()> &task);
} // namespace Ricochet

#endif
