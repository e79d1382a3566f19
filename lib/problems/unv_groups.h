// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_unv_groups_h
#define ricochet_problems_unv_groups_h

#include <cstddef>
#include <map>
#include <string>

namespace Ricochet
{
  /// Groups of elements in a universal file (.unv), which Gmsh does not read.
  struct UnvGroups
  {
    /// Number of the group of each element that is in one.
    std::map<std::size_t, int> group_of_element;
    std::map<int, std::string> names;
  };

  /**
   * Read the datasets 2452, 2467 and 2477 of a universal file: for each group a line of eight numbers, of
   * which the first one is that of the group and the last one the number of its members; its
   * name; and its members, two on a line with four numbers each: 8 for an element (7 for a node),
   * its number, and two that have no meaning here.
   *
   * @throws std::runtime_error for an element that is in two groups, and a group that ends early.
   */
  UnvGroups
  read_unv_groups(const std::string &text);
} // namespace Ricochet

#endif
