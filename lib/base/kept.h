// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_kept_h
#define ricochet_base_kept_h

#include <algorithm>
#include <list>

namespace Ricochet
{
  /**
   * The entry of @p kept that @p is_wanted, moved to the front; or a new one,
   * made by @p make, in place of the one not used for longest if there
   * are @p n_kept. If it cannot be made, nothing is kept of it.
   */
  template <typename Entry, typename Predicate, typename Make>
  Entry &
  find_or_make(std::list<Entry>  &kept,
               const unsigned int n_kept,
               const Predicate   &is_wanted,
               const Make        &make)
  {
    const auto known = std::find_if(kept.begin(), kept.end(), is_wanted);
    if (known != kept.end())
      kept.splice(kept.begin(), kept, known);
    else
      {
        while (kept.size() >= n_kept)
          kept.pop_back();
        kept.emplace_front(make());
      }
    return kept.front();
  }
} // namespace Ricochet

#endif
