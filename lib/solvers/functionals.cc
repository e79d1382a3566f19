// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/all_ranks.h>
#include <solvers/functionals.h>

#include <algorithm>
#include <limits>
#include <map>

namespace Ricochet
{
  namespace
  {
    /// Add @p part to @p row, which gets each column once, ascending.
    void
    add_row(const FunctionalRow &part, FunctionalRow &row)
    {
      if (part.empty())
        return;
      std::map<unsigned int, double> sums;
      for (const auto &[column, value] : row)
        sums[column] += value;
      for (const auto &[column, value] : part)
        sums[column] += value;
      row.assign(sums.begin(), sums.end());
    }



    /// One rank's behind another's.
    std::vector<NumberedRows>
    list_of_all_ranks(const std::vector<NumberedRows> &own,
                      const MPI_Comm                   communicator)
    {
      struct Header
      {
        unsigned int                number;
        std::array<unsigned int, 3> n_entries;
      };
      struct Entry
      {
        unsigned int column;
        double       value;
      };
      std::vector<Header> headers;
      std::vector<Entry>  entries;
      for (const auto &[number, rows] : own)
        {
          headers.push_back({number, {}});
          for (unsigned int k = 0; k < rows.size(); ++k)
            {
              headers.back().n_entries[k] = rows[k].size();
              for (const auto &[column, value] : rows[k])
                entries.push_back({column, value});
            }
        }
      headers = of_all_ranks(headers, communicator);
      entries = of_all_ranks(entries, communicator);
      std::vector<NumberedRows> all;
      auto                      entry = entries.begin();
      for (const Header &header : headers)
        {
          all.push_back({header.number, {}});
          for (unsigned int k = 0; k < header.n_entries.size(); ++k)
            for (unsigned int e = 0; e < header.n_entries[k]; ++e, ++entry)
              all.back().rows[k].emplace_back(entry->column, entry->value);
        }
      return all;
    }
  } // namespace



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



  std::vector<NumberedRows>
  sum_of_all_ranks(std::vector<NumberedRows> rows, const MPI_Comm communicator)
  {
    if (dealii::Utilities::MPI::n_mpi_processes(communicator) > 1)
      rows = list_of_all_ranks(rows, communicator);
    // Those with the same number stay in the order of ranks.
    std::stable_sort(rows.begin(),
                     rows.end(),
                     [](const NumberedRows &a, const NumberedRows &b) {
                       return a.number < b.number;
                     });
    std::vector<NumberedRows> sums;
    for (NumberedRows &own : rows)
      if (!sums.empty() && sums.back().number == own.number)
        for (unsigned int k = 0; k < own.rows.size(); ++k)
          add_row(own.rows[k], sums.back().rows[k]);
      else
        sums.push_back(std::move(own));
    return sums;
  }



  std::vector<NumberedRows>
  rows_of_all_ranks(const std::vector<FunctionalRow> &first,
                    const std::vector<FunctionalRow> &second,
                    const std::vector<unsigned int>  &numbers,
                    const MPI_Comm                    communicator)
  {
    std::vector<NumberedRows> rows;
    for (unsigned int f = 0; f < first.size(); ++f)
      if (!first[f].empty() || !second[f].empty())
        {
          rows.push_back({numbers[f], {{first[f], second[f], {}}}});
          for (FunctionalRow &row : rows.back().rows)
            for (auto &entry : row)
              entry.first = numbers[entry.first];
        }
    return sum_of_all_ranks(std::move(rows), communicator);
  }
} // namespace Ricochet
