// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_field_list_h
#define ricochet_output_field_list_h

#include <base/run_folder.h>

#include <map>
#include <string>

namespace Ricochet
{
  /**
   * A series of files with their times, as a file for ParaView (`.pvd`). One that is
   * appended costs the same, however many there are.
   *
   * Collective: all ranks append the same, rank 0 writes.
   */
  class FieldList
  {
  public:
    /**
     * @param name of the list, such as "solution.pvd".
     * @param files that the list is of, such as "solution/step-": their names without the
     * number of the step and ".vtu". A run that is resumed takes over those that are
     * whole, and notes others in its log.
     */
    FieldList(RunFolder         &folder,
              const std::string &name,
              const std::string &files);

    /// The file of a @p step.
    std::string
    file_of(const unsigned int step) const;

    /// List the file of @p step, and drop those of later steps, which a resumed
    /// run repeats. @param time s. @throws ComputationError
    void
    append(const unsigned int step, const double time);

  private:
    const RunFolder  &folder;
    const std::string name;
    const std::string files;
    // Times by step.
    std::map<unsigned int, double> times;
    // Whether the list on the disk has these times.
    bool is_written = false;
  };
} // namespace Ricochet

#endif
