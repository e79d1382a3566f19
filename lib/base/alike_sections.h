// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_alike_sections_h
#define ricochet_base_alike_sections_h

#include <base/parameter_file.h>

namespace Ricochet
{
  /**
   * The settings of @p text, in which sections may be like others of their kind:
   *
   *     subsection Body second
   *       set Like        = first
   *       set Translation = 0.1, 0
   *     end
   *
   * has all settings of `Body first` but those that it has itself. That one may be like a
   * third one.
   *
   * @throws InputError for a section that is not there, and for sections that are like
   * each other.
   */
  ParameterText
  with_alike_sections(const ParameterText &text);
} // namespace Ricochet

#endif
