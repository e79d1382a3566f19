// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/unknown_name.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cctype>
#include <utility>

namespace Ricochet
{
  namespace
  {
    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      const auto lower = [](const char c) {
        return std::tolower(static_cast<unsigned char>(c));
      };
      std::vector<unsigned int> row(b.size() + 1);
      for (unsigned int j = 0; j <= b.size(); ++j)
        row[j] = j;
      for (unsigned int i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (unsigned int j = 1; j <= b.size(); ++j)
            {
              const unsigned int above = row[j];
              row[j] =
                std::min({above + 1,
                          row[j - 1] + 1,
                          diagonal + (lower(a[i - 1]) != lower(b[j - 1]))});
              diagonal = above;
            }
        }
      return row[b.size()];
    }
  } // namespace



  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              n_names)
  {
    std::vector<std::pair<unsigned int, std::string>> ranked;
    constexpr unsigned int                            shortest_part = 3;
    for (const std::string &candidate : candidates)
      {
        // Names of this length are no misprints; the edit distance would take
        // long.
        const unsigned int distance =
          edit_distance(name.substr(0, 200), candidate);
        const bool is_part =
          name.size() >= shortest_part && boost::icontains(candidate, name);
        if (is_part)
          ranked.emplace_back(1, candidate);
        else if (2 * distance <= std::max(name.size(), candidate.size()))
          ranked.emplace_back(distance, candidate);
      }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::string> names;
    for (unsigned int i = 0; i < ranked.size() && i < n_names; ++i)
      names.push_back(ranked[i].second);
    return names;
  }



  InputError
  unknown_name(const std::string              &sentence,
               const std::string              &name,
               const std::vector<std::string> &candidates,
               const std::string              &rest,
               const std::string              &code)
  {
    const std::vector<std::string> nearest = nearest_names(name, candidates, 1);
    std::string                    message = sentence + ".";
    for (const std::string &one : nearest)
      message += " Is '" + one + "' meant?";
    return InputError(message + rest, {code, name, nearest});
  }
} // namespace Ricochet
