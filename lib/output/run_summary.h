// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_run_summary_h
#define ricochet_output_run_summary_h

#include <base/error_bars.h>
#include <base/units.h>
#include <output/energy_check.h>
#include <output/energy_ledger.h>
#include <output/field_extremes.h>

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
      /// Whether a condition may end the run before.
      bool may_end_earlier = false;
      /// Wall time of the steps of this start of the program (s), and the time that the
      /// processors of all ranks have spent in them.
      double       wall_seconds = 0., processor_seconds = 0.;
      unsigned int n_ranks = 1;
      std::string  mesh_checksum, linear_solver;
      /// How many steps were solved in which way.
      std::string solved_by;
    };

    /// A contact by which bodies fly apart: its restitution follows from their momenta.
    struct Rebound
    {
      struct Body
      {
        /// End of the names of its columns: "momentum_x" and this.
        std::string suffix;
        /// kg
        double mass;
      };

      std::string contact;
      /// One body against an obstacle at rest, or two.
      std::vector<Body> bodies;
    };

    /// @param rebounds and @param field_extremes may be empty.
    RunSummary(const EnergyLedger              &ledger,
               const std::vector<std::string>  &contacts,
               const EnergyCheck               &check,
               const Units                     &units,
               const std::vector<Rebound>      &rebounds,
               const std::vector<FieldExtreme> &field_extremes)
      : ledger(ledger)
      , contacts(contacts)
      , check(check)
      , units(units)
      , rebounds(rebounds)
      , field_extremes(field_extremes)
    {}

    /// For the log: one line on the energy, and one on each contact that was felt.
    std::vector<std::string>
    lines() const;

    /// The numbers that a certificate has bars for, each with its place in `summary.json`.
    std::vector<RunResult>
    results(const Circumstances &circumstances) const;

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
      /// Largest means over #n_of_mean rows (N, m).
      double force_of_means, depth_of_means;
      /// First and last row with a force (s); not numbers without.
      double first_touch, last_touch;
      /// Time in all rows with a force (s).
      double touching = 0.;
      /// Integral of the force over time (N s), and restitution; not a number without.
      double impulse_of_force, restitution;
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

    /// The largest mean over #n_of_mean rows of column @p number.
    static constexpr unsigned int n_of_mean = 9;
    double
    largest_of_means(const unsigned int number) const;

    /// Velocity with which the bodies of a rebound part after the last row with a force, over that
    /// with which they come before the first one, along the direction in which it has
    /// changed. Not a number where one of the rows is missing, or the bodies do not come.
    double
    restitution(const Rebound     &rebound,
                const unsigned int row_before,
                const unsigned int row_after) const;

    OfContact
    of_contact(const std::string &name) const;

    /// Energy that contact has taken, also from obstacles that move, and does not store (J).
    double
    lost_in_contact() const;

    const EnergyLedger             &ledger;
    const std::vector<std::string>  contacts;
    const EnergyCheck              &check;
    const Units                    &units;
    const std::vector<Rebound>      rebounds;
    const std::vector<FieldExtreme> field_extremes;
  };
} // namespace Ricochet

#endif
