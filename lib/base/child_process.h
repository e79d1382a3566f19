// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_child_process_h
#define ricochet_base_child_process_h

#include <functional>
#include <string>

namespace Ricochet
{
  /**
   * Run @p task in a process of its own, for a library that may crash, end the program
   * or take all memory with what a user gives it. The task must not use MPI; what it
   * leaves behind are files.
   *
   * The process may take four fifths of the machine's memory, prints nothing, and ends
   * with its parent.
   *
   * @param who does the task, such as "Gmsh", for messages.
   * @param seconds of wall time after which the process is ended; 0 for never.
   * @throws InputError with the message of an exception in the task, or saying how the
   * process ended otherwise.
   */
  void
  run_apart(const std::string           &who,
            const std::function<void()> &task,
            const unsigned int           seconds = 0);
} // namespace Ricochet

#endif
