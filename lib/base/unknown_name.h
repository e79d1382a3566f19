// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_unknown_name_h
#define ricochet_base_unknown_name_h

#include <base/exceptions.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The names in @p candidates that are closest to @p name by edit distance,
   * best first, at most @p n_names, none that is further away than half of
   * its length.
   */
  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              n_names);

  /**
   * The refusal of a @p name that does not exist, with the nearest one that does:
   *
   *     throw unknown_name("there is no body '" + name + "'", name, names_of_bodies);
   *
   * @param sentence without its full stop.
   * @param candidates the names that exist.
   * @param rest what comes after the nearest name, such as a list of all.
   * @param code the kind of mistake, for programs: see InputError::Details.
   */
  InputError
  unknown_name(const std::string              &sentence,
               const std::string              &name,
               const std::vector<std::string> &candidates,
               const std::string              &rest = "",
               const std::string              &code = "unknown_name");
} // namespace Ricochet

#endif
