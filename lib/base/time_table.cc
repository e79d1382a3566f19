// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/files.h>
#include <base/time_table.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <sstream>

namespace Ricochet
{
  namespace
  {
    /// The numbers in a @p line; empty if it has something else.
    std::vector<double>
    numbers_in(std::string line)
    {
      std::replace_if(
        line.begin(),
        line.end(),
        [](const char c) { return c == ',' || c == ';' || c == '\t'; },
        ' ');
      std::vector<double> numbers;
      std::istringstream  words(line);
      for (std::string word; words >> word;)
        {
          char *end = nullptr;
          numbers.push_back(std::strtod(word.c_str(), &end));
          if (*end != '\0' || !std::isfinite(numbers.back()))
            return {};
        }
      return numbers;
    }
  } // namespace



  TimeTable::TimeTable(const std::string &file, const std::string &name)
  {
    constexpr std::size_t            max_bytes = 1 << 26;
    std::istringstream               lines(read_file(file, max_bytes));
    std::vector<double>              times;
    std::vector<std::vector<double>> values;
    unsigned int                     number = 0;
    const auto                       refuse = [&](const std::string &why) {
      throw InputError(name + ": the table '" + file +
                       "' cannot be read: " + why);
    };
    for (std::string line; std::getline(lines, line);)
      {
        const std::string where = "line " + std::to_string(++number);
        line                    = dealii::Utilities::trim(line);
        if (line.empty() || line[0] == '#')
          continue;
        const std::vector<double> row = numbers_in(line);
        if (row.empty() && number == 1)
          continue;
        if (row.size() < 2)
          refuse(where + " should have a time and its values.");
        if (!times.empty() && row.size() != values.size() + 1)
          refuse(where + " has another number of values than those above.");
        if (!times.empty() && row[0] <= times.back())
          refuse(where + ": times have to grow.");
        values.resize(row.size() - 1);
        times.push_back(row[0]);
        for (unsigned int k = 0; k < values.size(); ++k)
          values[k].push_back(row[k + 1]);
      }
    if (times.size() < 2)
      refuse("it has fewer than two rows.");
    for (const std::vector<double> &column : values)
      functions.emplace_back(std::array<std::vector<double>, 1>{{times}},
                             dealii::Table<1, double>(column.size(),
                                                      column.begin()));
  }
} // namespace Ricochet
