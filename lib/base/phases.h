// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_phases_h
#define ricochet_base_phases_h

#include <base/parameter_file.h>

#include <functional>
#include <string>
#include <vector>

namespace Ricochet
{
  /// A part of a run with settings of its own: it goes on from where the one before it
  /// has ended.
  struct Phase
  {
    /// Empty for a run of one phase.
    std::string name;
    /// All settings of this phase.
    ParameterText text;

    /// Name of its folder within that of the run: "2_release".
    std::string folder;
  };

  /**
   * The phases of @p text: for each `subsection Phase NAME`, in their order, the rest of
   * the file with what this section sets in its place; a file without such sections is
   * one phase. Within it are the sections of the file, of which it needs only the
   * changes, and
   *
   *     set Without = Condition lid; Contact press
   *
   * takes sections of the file out. Velocities of bodies, their spins and
   * Start/Advance count in a later phase only where that phase itself sets them: the bodies
   * have the velocities with which they come.
   *
   * @throws InputError for a name that is missing, strange or there twice, for a section
   * in Without that is not in the file, and for Start/From and Output/Folder in a phase.
   */
  std::vector<Phase>
  phases_of(const ParameterText &text);

  /// The settings of phase number @p k, which begins where the one before it has ended.
  /// @param output_dir folder of the whole run.
  ParameterText
  text_of_phase(const std::vector<Phase> &phases,
                const unsigned int        k,
                const std::string        &output_dir);

  /// Do what may refuse the input of the phase @p name, naming the phase in the refusal.
  /// @throws InputError
  void
  in_phase(const std::string &name, const std::function<void()> &action);
} // namespace Ricochet

#endif
