// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/energy_ledger.h>
#include <output/hdf5_image.h>

#include <deal.II/base/utilities.h>


#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// 17 digits: a double read back is the double that was written.
    std::string
    format_row(const std::vector<double> &row)
    {
      std::string line;
      char        number[32];
      for (unsigned int i = 0; i < row.size(); ++i)
        {
          if (i > 0)
            line += ",";
          if (std::isnan(row[i]))
            continue;
          // Locales write other decimal points.
          const auto end = std::to_chars(number,
                                         number + sizeof(number),
                                         row[i],
                                         std::chars_format::scientific,
                                         16)
                             .ptr;
          line.append(number, end);
        }
      return line + "\n";
    }

    /// The values of a line. @throws InputError saying what is wrong.
    std::vector<double>
    parse_row(const std::string                       &line,
              const std::vector<EnergyLedger::Column> &column_list)
    {
      std::vector<double> row;
      for (std::size_t begin = 0; begin <= line.size();)
        {
          const std::size_t end  = std::min(line.find(',', begin), line.size());
          const char *const text = line.data() + begin;
          const char *const stop = line.data() + end;
          double            value = std::numeric_limits<double>::quiet_NaN();
          const bool        may_be_empty = row.size() < column_list.size() &&
            column_list[row.size()].may_be_empty;
          if (begin < end || !may_be_empty)
            {
              const auto result = std::from_chars(text, stop, value);
              if (result.ec != std::errc() || result.ptr != stop ||
                  !std::isfinite(value))
                throw InputError("holds '" +
                                 std::string(text, stop).substr(0, 40) +
                                 "' where a number is expected");
            }
          row.push_back(value);
          begin = end + 1;
        }
      if (row.size() != column_list.size())
        throw InputError("has " + std::to_string(row.size()) + " of " +
                         std::to_string(column_list.size()) + " columns");
      return row;
    }

  } // namespace



  unsigned int
  EnergyLedger::add_column(const std::string &name,
                           const std::string &unit,
                           const bool         may_be_empty,
                           const bool         is_sum)
  {
    AssertThrow(row_list.empty(), ExcMessage("Columns come before rows."));
    if (find_column(name))
      throw InputError("The energy table would have two columns '" + name +
                       "'. Give the body, contact or probe that it is of "
                       "another name.");
    column_list.push_back({name, unit, may_be_empty, is_sum});
    if (is_sum)
      folder.sums.push_back(name);
    return column_list.size() - 1;
  }



  std::optional<unsigned int>
  EnergyLedger::find_column(const std::string &name) const
  {
    for (unsigned int i = 0; i < column_list.size(); ++i)
      if (column_list[i].name == name)
        return i;
    return {};
  }



  unsigned int
  EnergyLedger::column_number(const std::string &name) const
  {
    const auto number = find_column(name);
    AssertThrow(number, ExcMessage("The energy table has no column " + name));
    return *number;
  }



  double
  EnergyLedger::value(const std::vector<double> &row,
                      const std::string         &name) const
  {
    const auto number = find_column(name);
    return number ? row[*number] : 0.;
  }



  std::string
  EnergyLedger::header() const
  {
    std::string line;
    for (const Column &column : column_list)
      line +=
        (line.empty() ? "" : ",") + column.name + " [" + column.unit + "]";
    return line + "\n";
  }



  void
  EnergyLedger::start()
  {
    folder.begin();
    csv_checksum = checksum(header());
    on_first_rank(folder.communicator, [&]() {
      csv.open(folder.file("energy.csv"), /* keep */ false);
      csv.append(header());
    });
  }



  void
  EnergyLedger::resume(const Seal &seal)
  {
    // Every rank reads: the rows are also needed for sums over the whole run.
    const std::string file = folder.file("energy.csv");
    const auto        fail = [&](const std::string &problem) {
      throw InputError("The run cannot be resumed from '" + file +
                       "': " + problem + ".");
    };
    std::string text;
    try
      {
        text = read_file(file);
      }
    catch (const InputError &)
      {
        fail("it cannot be read");
      }
    std::size_t position = header().size();
    if (text.compare(0, position, header()) != 0)
      fail("it has other columns than this run");
    while (row_list.size() < seal.n_rows)
      {
        // A row is complete when its line has an end.
        const std::size_t end = text.find('\n', position);
        if (end == std::string::npos)
          fail("it ends after " + std::to_string(row_list.size()) + " of the " +
               std::to_string(seal.n_rows) +
               " rows that the checkpoint counts");
        const std::string row_name =
          "row " + std::to_string(row_list.size() + 1);
        try
          {
            row_list.push_back(
              parse_row(text.substr(position, end - position), column_list));
          }
        catch (const InputError &problem)
          {
            fail(row_name + " " + problem.what());
          }
        if (row_list.size() > 1 &&
            !(row_list.back()[0] > row_list[row_list.size() - 2][0]))
          fail("the time of " + row_name + " is not later than the one before");
        position = end + 1;
      }
    text.resize(position);
    csv_checksum = checksum(text);
    if (csv_checksum != seal.checksum)
      fail("its rows are not those that were written before the checkpoint");

    folder.begin();
    on_first_rank(folder.communicator, [&]() {
      write_atomically(file, text);
      csv.open(file, /* keep */ true);
    });
  }



  void
  EnergyLedger::add_row(const std::vector<double> &row)
  {
    AssertDimension(row.size(), column_list.size());
    const std::string line = format_row(row);
    on_first_rank(folder.communicator, [&]() { csv.append(line); });
    csv_checksum = checksum(line, csv_checksum);
    row_list.push_back(row);
  }



  EnergyLedger::Seal
  EnergyLedger::seal()
  {
    on_first_rank(folder.communicator, [&]() { csv.sync(); });
    return {static_cast<unsigned int>(row_list.size()), csv_checksum};
  }



  void
  EnergyLedger::write_hdf5() const
  {
    on_first_rank(folder.communicator, [&]() {
      Hdf5Image           image;
      std::vector<double> values(row_list.size());
      for (unsigned int i = 0; i < column_list.size(); ++i)
        {
          for (unsigned int r = 0; r < row_list.size(); ++r)
            values[r] = row_list[r][i];
          image.add(column_list[i].name, values, 1, column_list[i].unit);
        }
      write_atomically(folder.file("energy.h5"), image.bytes());
    });
  }



  EnergyTable
  EnergyTable::read(const std::string &file)
  {
    std::istringstream lines(read_file(file));
    std::string        line;
    std::getline(lines, line);
    EnergyTable table;
    for (const std::string &heading : Utilities::split_string_list(line, ','))
      {
        const std::size_t unit = heading.find(" [");
        if (unit == std::string::npos || heading.back() != ']')
          throw InputError("'" + file + "' is no energy table.");
        table.columns.push_back(
          {heading.substr(0, unit),
           heading.substr(unit + 2, heading.size() - unit - 3),
           /* may be empty */ true});
      }
    while (std::getline(lines, line))
      try
        {
          table.rows.push_back(parse_row(line, table.columns));
        }
      catch (const InputError &problem)
        {
          throw InputError("Row " + std::to_string(table.rows.size() + 1) +
                           " of '" + file + "' " + problem.what() + ".");
        }
    if (table.rows.empty())
      throw InputError("'" + file + "' has no rows.");
    return table;
  }



  unsigned int
  EnergyTable::column_number(const std::string &name) const
  {
    for (unsigned int i = 0; i < columns.size(); ++i)
      if (columns[i].name == name)
        return i;
    throw InputError("An energy table has no column '" + name + "'.");
  }
} // namespace Ricochet
