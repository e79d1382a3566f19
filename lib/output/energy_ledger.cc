// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/energy_ledger.h>

#include <deal.II/base/hdf5.h>
#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cstdio>
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
      for (const double value : row)
        {
          std::snprintf(number, sizeof(number), "%.16e", value);
          line += (line.empty() ? "" : ",") + std::string(number);
        }
      return line;
    }
  } // namespace



  unsigned int
  EnergyLedger::add_column(const std::string &name, const std::string &unit)
  {
    AssertThrow(row_list.empty(), ExcMessage("Columns come before rows."));
    column_list.push_back({name, unit});
    return column_list.size() - 1;
  }



  unsigned int
  EnergyLedger::column_number(const std::string &name) const
  {
    for (unsigned int i = 0; i < column_list.size(); ++i)
      if (column_list[i].name == name)
        return i;
    AssertThrow(false, ExcMessage("The ledger has no column " + name));
    return 0;
  }



  std::string
  EnergyLedger::header() const
  {
    std::string line;
    for (const Column &column : column_list)
      line +=
        (line.empty() ? "" : ",") + column.name + " [" + column.unit + "]";
    return line;
  }



  void
  EnergyLedger::start()
  {
    if (!folder.is_root)
      return;
    csv.open(folder.file("energy.csv"), std::ios::trunc);
    csv << header() << std::endl;
  }



  void
  EnergyLedger::resume(const unsigned int n_rows)
  {
    // Every rank reads: the rows are also needed for sums over the whole run.
    const std::string file = folder.file("energy.csv");
    std::string       problem;
    std::string       line;
    {
      std::ifstream in(file);
      if (!in)
        problem = "it cannot be read";
      else if (!std::getline(in, line) || line != header())
        problem = "it has other columns than this run";
      while (problem.empty() && row_list.size() < n_rows)
        {
          if (!std::getline(in, line) || in.eof())
            {
              problem = "it ends after " + std::to_string(row_list.size()) +
                " of the " + std::to_string(n_rows) +
                " rows that the checkpoint counts";
              break;
            }
          std::vector<double> row;
          for (const std::string &value :
               Utilities::split_string_list(line, ','))
            row.push_back(std::strtod(value.c_str(), nullptr));
          if (row.size() != column_list.size())
            {
              problem = "row " + std::to_string(row_list.size() + 1) + " has " +
                std::to_string(row.size()) + " of " +
                std::to_string(column_list.size()) + " columns";
              break;
            }
          row_list.push_back(row);
        }
    }
    if (!problem.empty())
      throw InputError("The run cannot be resumed from '" + file +
                       "': " + problem + ".");

    MPI_Barrier(folder.communicator);
    if (!folder.is_root)
      return;
    csv.open(file, std::ios::trunc);
    csv << header() << "\n";
    for (const std::vector<double> &row : row_list)
      csv << format_row(row) << "\n";
    csv.flush();
  }



  void
  EnergyLedger::add_row(const std::vector<double> &row)
  {
    AssertDimension(row.size(), column_list.size());
    row_list.push_back(row);
    bool written = true;
    if (folder.is_root)
      {
        csv << format_row(row) << std::endl;
        written = csv.good();
      }
    if (!Utilities::MPI::broadcast(folder.communicator, written, 0))
      throw ComputationError("'" + folder.file("energy.csv") +
                             "' cannot be written any more: is the disk "
                             "full?");
  }



  void
  EnergyLedger::write_hdf5() const
  {
    if (!folder.is_root)
      return;
    HDF5::File          file(folder.file("energy.h5"),
                    HDF5::File::FileAccessMode::create);
    std::vector<double> values(row_list.size());
    for (unsigned int i = 0; i < column_list.size(); ++i)
      {
        for (unsigned int r = 0; r < row_list.size(); ++r)
          values[r] = row_list[r][i];
        HDF5::DataSet data =
          file.create_dataset<double>(column_list[i].name, {values.size()});
        data.write(values);
        data.set_attribute<std::string>("unit", column_list[i].unit);
      }
  }
} // namespace Ricochet
