// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_parameter_file_h
#define ricochet_base_parameter_file_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Read the .prm file @p file_name into @p parameters, in the syntax of
   * dealii::ParameterHandler, with two additions that users of many small files
   * need: the path after an `include` counts from the folder of the file that
   * holds it, and each mistake is reported with file, line and, for a
   * misspelt name, the nearest valid names.
   *
   * @throws InputError file missing or unreadable, unknown section or
   * parameter, value that does not match its pattern, `include` circle,
   * unbalanced `subsection`/`end`.
   */
  void
  read_parameter_file(const std::string        &file_name,
                      dealii::ParameterHandler &parameters);

  /**
   * Set one parameter from a text of the form "Section/Name=value", as given to
   * `--set` on the command line. Sections nest: "A/B/Name=value".
   *
   * @throws InputError as read_parameter_file(), with @p assignment in place of
   * file and line.
   */
  void
  set_parameter(const std::string        &assignment,
                dealii::ParameterHandler &parameters);

  /// A number as a person would write it: 0.05, 1e-12.
  std::string
  to_text(const double number);

  /**
   * The names in @p candidates that are closest to @p name by edit distance,
   * best first, at most @p n_names, none that is further away than half of
   * its length.
   */
  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              n_names = 3);
} // namespace Ricochet

#endif
