// SPDX-License-Identifier: LGPL-2.1-or-later
#include <problems/unv_groups.h>

#include <deal.II/base/utilities.h>

#include <sstream>
#include <stdexcept>
#include <vector>

namespace Ricochet
{
  UnvGroups
  read_unv_groups(const std::string &text)
  {
    using dealii::Utilities::trim;
    UnvGroups          groups;
    std::istringstream lines(text);
    std::string        line;
    const auto         is_mark = [&]() { return trim(line) == "-1"; };
    while (std::getline(lines, line))
      {
        // A dataset is between two marks and begins with its number.
        if (!is_mark() || !std::getline(lines, line))
          continue;
        const std::string dataset = trim(line);
        const bool        is_list =
          dataset == "2452" || dataset == "2467" || dataset == "2477";
        while (std::getline(lines, line) && !is_mark())
          {
            if (!is_list)
              continue;
            std::istringstream head(line);
            std::vector<long>  numbers;
            for (long number; head >> number;)
              numbers.push_back(number);
            std::string name;
            if (numbers.size() != 8 || !std::getline(lines, name))
              throw std::runtime_error("a group of dataset " + dataset +
                                       " is damaged.");
            const int group     = static_cast<int>(numbers[0]);
            groups.names[group] = trim(name);
            for (long k = 0; k < numbers[7];)
              {
                if (!std::getline(lines, line) || is_mark())
                  throw std::runtime_error("the group '" + groups.names[group] +
                                           "' ends early.");
                std::istringstream members(line);
                constexpr long     element = 8;
                for (long kind, number, a, b;
                     members >> kind >> number >> a >> b;
                     ++k)
                  if (kind == element && number > 0 &&
                      !groups.group_of_element.emplace(number, group).second)
                    throw std::runtime_error(
                      "element " + std::to_string(number) +
                      " is in two groups, of which it can be in one.");
              }
          }
      }
    return groups;
  }
} // namespace Ricochet
