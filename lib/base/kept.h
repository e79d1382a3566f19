// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_kept_h
#define ricochet_base_kept_h

#include <algorithm>
#include <iterator>
#include <list>

namespace Ricochet
{
  /// Move the entry of @p kept that @p is_wanted to the front. @return whether there is
  /// one.
  template <typename Entry, typename Predicate>
  bool
  move_to_front(std::list<Entry> &kept, const Predicate &is_wanted)
  {
    const auto known = std::find_if(kept.begin(), kept.end(), is_wanted);
    if (known == kept.end())
      return false;
    kept.splice(kept.begin(), kept, known);
    return true;
  }

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
    if (!move_to_front(kept, is_wanted))
      {
        while (kept.size() >= n_kept)
          kept.pop_back();
        kept.emplace_front(make());
      }
    return kept.front();
  }

  /// The same, but @p fill, which has to succeed, overwrites the one not used for
  /// longest, whose memory serves again.
  template <typename Entry, typename Predicate, typename Fill>
  Entry &
  find_or_refill(std::list<Entry>  &kept,
                 const unsigned int n_kept,
                 const Predicate   &is_wanted,
                 const Fill        &fill)
  {
    if (!move_to_front(kept, is_wanted))
      {
        if (kept.size() < n_kept)
          kept.emplace_front();
        else
          kept.splice(kept.begin(), kept, std::prev(kept.end()));
        fill(kept.front());
      }
    return kept.front();
  }
} // namespace Ricochet

#endif
