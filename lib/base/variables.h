// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_variables_h
#define ricochet_base_variables_h

#include <base/parameter_file.h>

namespace Ricochet
{
  /**
   * The settings of @p text with numbers in place of what stands in braces: expressions
   * (muParser) of the variables of the file,
   *
   *     subsection Variables
   *       set height = 0.02
   *       set speed  = sqrt(2*9.81*height)
   *     end
   *
   * so that `set Velocity = 0, {-speed}` is a number when it is read. A variable may need
   * others, in any order; one that is set again, in a phase or on the command line, changes
   * all that follow from it.
   *
   * @throws InputError for a name that cannot be one, an expression that cannot be read or
   * is not finite, variables that need each other, a brace that is alone, and a variable that
   * only the command line knows.
   */
  ParameterText
  with_variables(const ParameterText &text);
} // namespace Ricochet

#endif
