// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <output/energy_ledger.h>
#include <output/phase_ledger.h>
#include <output/xdmf_list.h>

#include <deal.II/base/data_out_base.h>

#include <boost/algorithm/string/replace.hpp>

#include <cmath>
#include <filesystem>
#include <limits>
#include <regex>
#include <set>
#include <sstream>
#include <utility>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    std::string
    file_of(const PhaseResult &phase, const std::string &name)
    {
      return (std::filesystem::path(phase.path) / name).string();
    }

    /// Files of fields and their times (s).
    using FieldFiles = std::vector<std::pair<double, std::string>>;

    /// Add those that a phase lists, which begins at the time @p begin (s).
    void
    add_fields(const PhaseResult &phase,
               const std::string &list,
               const double       begin,
               FieldFiles        &files)
    {
      const std::string file = file_of(phase, list);
      if (!std::filesystem::exists(file))
        return;
      static const std::regex entry(
        "timestep=\"([^\"]*)\"[^>]*file=\"([^\"]*)\"");
      const std::string text   = read_file(file);
      const std::string folder = std::filesystem::path(phase.path).filename();
      for (std::sregex_iterator match(text.begin(), text.end(), entry), end;
           match != end;
           ++match)
        files.emplace_back(begin + std::stod((*match)[1]),
                           folder + "/" + (*match)[2].str());
    }

    /// Add the entries of the HDF5 files of a phase, which begins at the time @p begin (s).
    void
    add_entries(const PhaseResult        &phase,
                const double              begin,
                std::vector<std::string> &entries)
    {
      static const std::regex time("<Time Value=\"([^\"]*)\"");
      const std::string folder = std::filesystem::path(phase.path).filename();
      for (std::string entry : XdmfList::read(file_of(phase, XdmfList::name)))
        {
          std::smatch match;
          if (std::regex_search(entry, match, time))
            {
              std::ostringstream now;
              now.precision(17);
              now << begin + std::stod(match[1]);
              entry.replace(match.position(1), match.length(1), now.str());
            }
          boost::replace_all(entry,
                             "solution/step-",
                             folder + "/solution/step-");
          entries.push_back(entry);
        }
    }

    void
    write_list(const RunFolder   &whole,
               const std::string &list,
               const FieldFiles  &files)
    {
      if (files.empty())
        return;
      std::ostringstream text;
      DataOutBase::write_pvd_record(text, files);
      write_atomically(whole.file(list), text.str());
    }
  } // namespace



  void
  join_phases(RunFolder &whole, const std::vector<PhaseResult> &phases)
  {
    std::vector<EnergyTable> tables;
    for (const PhaseResult &phase : phases)
      tables.push_back(EnergyTable::read(file_of(phase, "energy.csv")));

    EnergyLedger       ledger(whole);
    const unsigned int time =
      ledger.add_column("time", tables.front().columns.front().unit);
    const unsigned int number = ledger.add_column("phase", "1");
    const unsigned int change =
      ledger.add_column("phase_change",
                        tables.front().columns[1].unit,
                        /* may be empty */ false,
                        /* is sum */ true);
    for (unsigned int p = 0; p < phases.size(); ++p)
      {
        const std::set<std::string> sums(phases[p].sums.begin(),
                                         phases[p].sums.end());
        for (const EnergyLedger::Column &column : tables[p].columns)
          if (!ledger.find_column(column.name))
            ledger.add_column(column.name,
                              column.unit,
                              /* may be empty */ true,
                              /* is sum */ sums.count(column.name) > 0);
      }
    ledger.start();

    // Time and sums at the end of the phases before; no other values go on.
    constexpr double    nothing = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> carried(ledger.columns().size(), nothing);
    carried[time] = carried[change]      = 0.;
    double                   last_energy = nothing;
    FieldFiles               solution, obstacles;
    std::vector<std::string> entries;
    for (unsigned int p = 0; p < phases.size(); ++p)
      {
        const EnergyTable &table  = tables[p];
        const unsigned int energy = table.column_number("energy");
        add_fields(phases[p], "solution.pvd", carried[time], solution);
        add_fields(phases[p], "obstacles.pvd", carried[time], obstacles);
        add_entries(phases[p], carried[time], entries);
        carried[number] = p + 1;
        if (p > 0)
          carried[change] += table.rows.front()[energy] - last_energy;
        last_energy = table.rows.back()[energy];
        std::vector<unsigned int> place;
        for (const EnergyLedger::Column &column : table.columns)
          place.push_back(ledger.column_number(column.name));
        std::vector<double> row;
        for (const std::vector<double> &own : table.rows)
          {
            row = carried;
            for (unsigned int i = 0; i < own.size(); ++i)
              row[place[i]] =
                own[i] + (std::isnan(row[place[i]]) ? 0. : row[place[i]]);
            ledger.add_row(row);
          }
        for (unsigned int i = 0; i < row.size(); ++i)
          if (i == time || ledger.columns()[i].is_sum)
            carried[i] = row[i];
      }
    ledger.seal();
    ledger.write_hdf5();
    on_first_rank(whole.communicator, [&]() {
      write_list(whole, "solution.pvd", solution);
      write_list(whole, "obstacles.pvd", obstacles);
      if (!entries.empty())
        write_atomically(whole.file(XdmfList::name),
                         XdmfList::text_of(entries));
    });
  }
} // namespace Ricochet
