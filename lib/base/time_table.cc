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
    struct Line
    {
      std::vector<double> numbers;
      /// Whether each word is a number, and whether none is.
      bool is_row = true, is_heading = true;
    };

    Line
    read(std::string text)
    {
      std::replace_if(
        text.begin(),
        text.end(),
        [](const char c) { return c == ',' || c == ';' || c == '\t'; },
        ' ');
      Line               line;
      std::istringstream words(text);
      for (std::string word; words >> word;)
        {
          char        *end    = nullptr;
          const double number = std::strtod(word.c_str(), &end);
          // A word may have zeros in it, at which it does not end.
          const bool is_number =
            end == word.c_str() + word.size() && std::isfinite(number);
          line.numbers.push_back(number);
          line.is_row     = line.is_row && is_number;
          line.is_heading = line.is_heading && !is_number;
        }
      return line;
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
        // Spreadsheets begin a file with a mark of its encoding.
        if (number == 1 && line.compare(0, 3, "\xEF\xBB\xBF") == 0)
          line.erase(0, 3);
        line = dealii::Utilities::trim(line);
        if (line.empty() || line[0] == '#')
          continue;
        const Line found = read(line);
        if (found.is_heading && times.empty())
          continue;
        const std::vector<double> &row = found.numbers;
        if (!found.is_row || row.size() < 2)
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
