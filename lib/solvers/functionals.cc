// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/functionals.h>

#include <algorithm>
#include <limits>

namespace Ricochet
{
  void
  sum_columns(std::vector<FunctionalRow> &rows)
  {
    constexpr unsigned int no_place = std::numeric_limits<unsigned int>::max();
    std::vector<unsigned int> place_in_row(rows.size(), no_place);
    for (FunctionalRow &row : rows)
      {
        unsigned int n_columns = 0;
        for (const auto &[column, value] : row)
          if (unsigned int &place = place_in_row[column]; place == no_place)
            {
              place            = n_columns;
              row[n_columns++] = {column, value};
            }
          else
            row[place].second += value;
        row.resize(n_columns);
        for (const auto &entry : row)
          place_in_row[entry.first] = no_place;
        row.erase(std::remove_if(row.begin(),
                                 row.end(),
                                 [](const auto &entry) {
                                   return entry.second == 0.;
                                 }),
                  row.end());
        std::sort(row.begin(), row.end());
      }
  }
} // namespace Ricochet
