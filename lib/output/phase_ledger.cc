// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/energy_ledger.h>
#include <output/phase_ledger.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The time, the changes of the energy between phases (J) and the sums so far.
    struct Offsets
    {
      double                        time   = 0.;
      double                        change = 0.;
      std::map<std::string, double> sums;
    };

    std::string
    file_of(const PhaseResult &phase, const std::string &name)
    {
      return (std::filesystem::path(phase.path) / name).string();
    }

    /// The entries of a phase's solution.pvd, for that of the whole.
    std::string
    fields_of(const PhaseResult &phase,
              const std::string &name,
              const double       begin)
    {
      const std::string file = file_of(phase, name);
      if (!std::filesystem::exists(file))
        return {};
      static const std::regex entry(
        "timestep=\"([^\"]*)\"([^>]*)file=\"([^\"]*)\"");
      const std::string text   = read_file(file);
      const std::string folder = std::filesystem::path(phase.path).filename();
      std::string       lines;
      for (std::sregex_iterator match(text.begin(), text.end(), entry), end;
           match != end;
           ++match)
        {
          std::ostringstream time;
          time.precision(12);
          time << begin + std::stod((*match)[1]);
          lines += "    <DataSet timestep=\"" + time.str() + "\"" +
            (*match)[2].str() + "file=\"" + folder + "/" + (*match)[3].str() +
            "\"/>\n";
        }
      return lines;
    }

    /// Write a list of fields in the format of ParaView; none if there are none.
    void
    write_fields(const RunFolder   &whole,
                 const std::string &name,
                 const std::string &lines)
    {
      if (!lines.empty())
        write_atomically(
          whole.file(name),
          "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" "
          "version=\"0.1\" ByteOrder=\"LittleEndian\">\n  <Collection>\n" +
            lines + "  </Collection>\n</VTKFile>\n");
    }
  } // namespace



  void
  join_phases(RunFolder &whole, const std::vector<PhaseResult> &phases)
  {
    std::vector<EnergyTable> tables;
    for (const PhaseResult &phase : phases)
      tables.push_back(EnergyTable::read(file_of(phase, "energy.csv")));

    EnergyLedger ledger(whole);
    ledger.add_column("time", tables.front().columns.front().unit);
    ledger.add_column("phase", "1");
    ledger.add_column("phase_change",
                      tables.front().columns[1].unit,
                      /* may be empty */ false,
                      /* is sum */ true);
    std::set<std::string> sums;
    for (unsigned int p = 0; p < phases.size(); ++p)
      {
        sums.insert(phases[p].sums.begin(), phases[p].sums.end());
        for (const EnergyLedger::Column &column : tables[p].columns)
          if (!ledger.find_column(column.name))
            ledger.add_column(column.name,
                              column.unit,
                              /* may be empty */ true);
      }
    ledger.start();

    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
    Offsets          offsets;
    double           last_energy = nothing;
    std::string      solution, obstacles;
    for (unsigned int p = 0; p < phases.size(); ++p)
      {
        const EnergyTable  &table  = tables[p];
        const unsigned int  energy = table.column_number("energy");
        std::vector<double> row;
        if (p > 0)
          offsets.change += table.rows.front()[energy] - last_energy;
        for (const std::vector<double> &own : table.rows)
          {
            row.assign(ledger.columns().size(), nothing);
            for (const auto &[name, value] : offsets.sums)
              row[ledger.column_number(name)] = value;
            for (unsigned int i = 0; i < own.size(); ++i)
              {
                const std::string &name   = table.columns[i].name;
                double            &value  = row[ledger.column_number(name)];
                const bool         is_sum = sums.count(name) > 0;
                value = own[i] + (is_sum && !std::isnan(value) ? value : 0.);
              }
            row[ledger.column_number("time")]  = offsets.time + own.front();
            row[ledger.column_number("phase")] = p + 1;
            row[ledger.column_number("phase_change")] = offsets.change;
            ledger.add_row(row);
          }
        solution += fields_of(phases[p], "solution.pvd", offsets.time);
        obstacles += fields_of(phases[p], "obstacles.pvd", offsets.time);
        offsets.time = row.front();
        last_energy  = table.rows.back()[energy];
        for (const std::string &name : sums)
          if (ledger.find_column(name))
            offsets.sums[name] = row[ledger.column_number(name)];
      }
    ledger.seal();
    ledger.write_hdf5();
    on_first_rank(whole.communicator, [&]() {
      write_fields(whole, "solution.pvd", solution);
      write_fields(whole, "obstacles.pvd", obstacles);
    });
  }
} // namespace Ricochet
