// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_run_summary_h
#define ricochet_output_run_summary_h

#include <base/units.h>
#include <output/energy_check.h>
#include <output/energy_ledger.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The result of a run in a few numbers, from its energy table and the checks of it: what was
   * lost and to what, what each contact did, the least and the largest value of each
   * column, the promises, the steps. It goes to `summary.json` for scripts and in a few
   * lines to the log.
   */
  class RunSummary
  {
  public:
    /// How the run ended, and by what.
    struct Circumstances
    {
      /// "complete", "stopped" or "failed", and why, if it is not complete.
      std::string state = "complete", reason;
      /// Final time that was asked for, and the length of a step (s).
      double final_time = 0., time_step = 0.;
      /// Wall time of the steps of this start of the program (s), and the time of the
      /// processors of all ranks.
      double       wall_seconds = 0., processor_seconds = 0.;
      unsigned int n_ranks = 1;
      std::string  mesh_checksum, linear_solver;
      /// How many steps were solved in which way.
      std::string solved_by;
    };

    RunSummary(const EnergyLedger             &ledger,
               const std::vector<std::string> &contacts,
               const EnergyCheck              &check,
               const Units                    &units)
      : ledger(ledger)
      , contacts(contacts)
      , check(check)
      , units(units)
    {}

    /// For the log: one line on the energy, and one on each contact that was felt.
    std::vector<std::string>
    lines() const;

    /// The text of `summary.json`.
    std::string
    json(const Circumstances &circumstances, const RunFolder &folder) const;

  private:
    /// A value of a column and when it was.
    struct At
    {
      double value, time;
    };

    /// Results for one contact.
    struct OfContact
    {
      At force, depth;
      /// First and last row with a force (s); not numbers without.
      double first_touch, last_touch;
      /// Time in all rows with a force (s).
      double touching = 0.;
      /// By components (N s); empty if the run has no such columns.
      std::vector<double> impulse;
    };

    /// The value of a column in the first and the last row; 0 without it.
    double
    first(const std::string &name) const;
    double
    last(const std::string &name) const;

    /// The largest value of column @p number, times @p sign; not a number if it has none.
    At
    largest(const unsigned int number, const double sign = 1.) const;

    OfContact
    of_contact(const std::string &name) const;

    /// Energy that contact has taken, also from obstacles that move, and does not store (J).
    double
    lost_in_contact() const;

    const EnergyLedger            &ledger;
    const std::vector<std::string> contacts;
    const EnergyCheck             &check;
    const Units                   &units;
  };
} // namespace Ricochet

#endif
