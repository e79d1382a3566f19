// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_time_loop_h
#define ricochet_problems_time_loop_h

#include <base/expressions.h>
#include <base/run_folder.h>
#include <base/units.h>
#include <output/checkpoint.h>
#include <output/energy_check.h>
#include <output/energy_ledger.h>
#include <output/field_format.h>
#include <output/run_summary.h>
#include <time_integration/time_scheme.h>

#include <deal.II/base/timer.h>

#include <functional>
#include <map>
#include <optional>
#include <sstream>

namespace Ricochet
{
  /**
   * From the initial state to the final time: steps, halved when Newton's
   * method fails; the energy ledger; fields; checkpoints. After a failure, all
   * that was computed is on disk.
   */
  class TimeLoop
  {
  public:
    struct Parameters
    {
      double final_time = 12.;
      /// See Condition; of the columns of the ledger.
      std::string  until        = "";
      double       time_step    = .05;
      unsigned int max_halvings = 4;
      unsigned int fields_every = 10;
      /// Fields are also due at the end of the step that reaches one of these times (s),
      std::vector<double> fields_at = {};
      /// and of each step at whose end this is true; see Condition.
      std::string  fields_when      = "";
      std::string  fields_format    = "vtu";
      unsigned int contact_every    = 0;
      unsigned int checkpoint_every = 0;
      /// min
      double       checkpoint_minutes = 10.;
      unsigned int log_every          = 1;
      bool         newton_table       = false;
      bool         timing             = true;

      void
      add_parameters(dealii::ParameterHandler &parameters);

      /// @throws InputError for conditions that cannot be read, and times and steps that do not
      /// go with each other.
      void
      validate() const;

      FieldFormat
      field_format() const
      {
        return fields_format == "hdf5" ? FieldFormat::hdf5 : FieldFormat::vtu;
      }

      /// Whether fields are ever due.
      bool
      wants_fields() const
      {
        return fields_every > 0 || !fields_at.empty() || !fields_when.empty();
      }
    };

    /**
     * @param contact_names names of the contact boundaries for the columns of
     * the ledger; those with the same name have common columns.
     * @param units of the ledger.
     */
    TimeLoop(
      const Parameters                                        &parameters,
      RunFolder                                               &folder,
      SemiDiscreteSystem                                      &system,
      TimeScheme                                              &scheme,
      const std::map<dealii::types::boundary_id, std::string> &contact_names,
      const Units                                             &units = {});

    /// Add a column of the benchmark's own to the ledger.
    void
    add_column(const std::string                          &name,
               const std::string                          &unit,
               const std::function<double(const State &)> &value);

    /// As above for several columns, all of which @p values computes at once.
    void
    add_columns(
      const std::vector<std::string>                          &names,
      const std::string                                       &unit,
      const std::function<std::vector<double>(const State &)> &values);

    /// Add a column with the sum over the run of the contributions of each
    /// step, or each part of a halved one, from its beginning to its end.
    void
    add_sum(const std::string &name,
            const std::string &unit,
            const std::function<double(const State &begin, const State &end)>
              &increment);

    /// As above for a value that the scheme reports for each step, or part of a
    /// halved one; a value that is not a number leaves the column empty from
    /// then on.
    void
    add_reported_sum(
      const std::string                               &name,
      const std::string                               &unit,
      const std::function<double(const StepReport &)> &increment);

    /// Add a column with the mean over the last step of the quantity whose
    /// integral over each step, or each part of a halved one, is @p increment;
    /// zero at the start.
    void
    add_mean(const std::string &name,
             const std::string &unit,
             const std::function<double(const State &begin, const State &end)>
               &increment);

    /// Names of the bodies for messages on points; by ContactStep::part.
    std::vector<std::string> part_names;

    /// Called with the state and the number of the step when fields are due.
    std::function<void(const State &, const unsigned int)> write_fields;

    /// Called with the state and the number of the step when contact is due.
    std::function<void(const State &, const unsigned int)> write_contact;

    /// See RunSummary.
    std::vector<RunSummary::Rebound>                   rebounds;
    std::function<const std::vector<FieldExtreme> &()> field_extremes;

    /// The work of moving obstacles on the body from one state to the next, see
    /// ObstacleWork; the column obstacle_work is zero without. The contact
    /// forces are the means over the step of each of several contacts, or that
    /// of the only one (N).
    std::function<double(const Vector              &old_solution,
                         const Vector              &new_solution,
                         const std::vector<Vector> &contact_forces,
                         const double               begin,
                         const double               end)>
      obstacle_work;

    /**
     * Run from @p initial_state, or from the checkpoint if the folder is to be
     * resumed, to the final time.
     *
     * @return the state at the end.
     * @throws ComputationError after the last halving has failed.
     * @throws StoppedBySignal after a complete step, see StopRequest.
     */
    State
    run(const State &initial_state);

    /// The ledger with all its rows, for sums over the run.
    const EnergyLedger &
    energy_ledger() const
    {
      return ledger;
    }

  private:
    /// One step of the scheme, or of its last resort where it may not be halved.
    /// @throws NewtonFailure
    StepReport
    step(const State       &old_state,
         const double       time_step,
         const unsigned int n_halvings_so_far,
         State             &new_state);

    /// One step of length @p time_step, as two of half the length if need be.
    StepReport
    advance(const State       &old_state,
            const double       time_step,
            const unsigned int n_halvings_so_far,
            State             &new_state);

    /// J
    struct Energies
    {
      double kinetic = 0.;
      double stored  = 0.;

      double
      total() const
      {
        return kinetic + stored;
      }
    };

    Energies
    energies_of(const State &state) const;

    /// @param balance the residual of the balance of the step (J).
    void
    add_row(const State      &state,
            const Energies   &energies,
            const StepReport &report,
            const double      balance);

    /// The values of a @p row of the ledger that are checked, for a run that is
    /// resumed.
    EnergyCheck::Terms
    terms_of(const std::vector<double> &row) const;

    /// Say in the log which contact has broken its promise in a step, where, and what may
    /// help.
    void
    log_broken_promise(const StepReport &report, const double time);

    /// Energy gained by the contacts of the ledger over the step that was
    /// solved last.
    std::vector<ContactStep>
    contact_steps(const State &old_state, const State &new_state) const;

    /// "(x, y)"
    std::string
    place_text(const dealii::Point<3> &place) const;

    /// Refuse a step in which points pass through bodies or obstacles without
    /// contact, as long as it may be halved. @throws StepTooLong
    void
    check_passing(const State                    &old_state,
                  const double                    time_step,
                  const unsigned int              n_halvings_so_far,
                  const std::vector<ContactStep> &steps) const;

    /// The head of the lines of log_row(), with units.
    std::string
    log_head() const;

    /// @param first_step that of this run. @param seconds since then.
    void
    log_row(const unsigned int step,
            const unsigned int n_steps,
            const unsigned int first_step,
            const double       seconds) const;

    /// Begin the ledger with @p state, or take both from the checkpoint.
    /// @return the number of the step whose end the state is.
    unsigned int
    begin(State &state, const unsigned int n_steps);

    /// Whether @p condition is true in the last row of the ledger.
    /// @throws InputError when it names other columns.
    bool
    is_true_now(const Condition &condition) const;

    bool
    are_fields_due(const State &state, const unsigned int step) const;

    /// Fields and contact.
    void
    write_fields_if_due(const State &state, const unsigned int step);

    void
    log_newton_tables();

    using Increment = std::function<
      double(const State &begin, const State &end, const StepReport &report)>;

    /// See add_sum(). @return its number.
    unsigned int
    add_own_sum(const Increment &increment);

    /// The column of own sum number @p k.
    void
    add_column_of_sum(const std::string &name,
                      const std::string &unit,
                      const bool         may_be_empty,
                      const unsigned int k);

    /// Enter a step into sums and ledger. @p energy is that of the state before,
    /// and becomes that of @p new_state (J).
    void
    account(const State &new_state, const StepReport &report, double &energy);

    RunSummary
    summary() const;

    RunSummary::Circumstances
    circumstances(const std::string   &state,
                  const std::string   &reason,
                  const dealii::Timer &stopwatch) const;

    /// Write summary.json, see RunSummary. @param state "complete", "stopped" or "failed", and
    /// the @p reason. @throws ComputationError Collective.
    void
    write_summary(const std::string   &state,
                  const std::string   &reason,
                  const dealii::Timer &stopwatch);

    /// How the steps were solved, in words; empty where nothing is to say.
    std::string
    how_solved() const;

    /// Summary at the end: the balance, and the timings.
    void
    conclude(dealii::TimerOutput &timer, std::ostringstream &timing_table);

    const Parameters    parameters;
    const Condition     until, fields_when;
    RunFolder          &folder;
    SemiDiscreteSystem &system;
    TimeScheme         &scheme;
    // The boundaries of each contact, by name, in the order of the ledger.
    const std::vector<
      std::pair<std::string, std::vector<dealii::types::boundary_id>>>
                contact_names;
    const Units units;
    // Values of the benchmark's own columns, in the order of the ledger.
    std::vector<std::function<std::vector<double>(const State &)>> own_columns;
    std::vector<Increment>                                         own_sums;
    // The mean of each of them over the last step.
    std::vector<double> own_means;
    EnergyLedger        ledger;
    EnergyCheck         check;
    // Whether an inverted corner is already noted in the log.
    bool has_inverted_corner = false;

    /// Sums over the run (J), part of a checkpoint.
    struct Sums
    {
      double       external_work         = 0.;
      double       contact_work          = 0.;
      double       friction_work         = 0.;
      double       viscous_dissipation   = 0.;
      double       numerical_dissipation = 0.;
      unsigned int n_halvings            = 0;
      /// Halvings because points passed through something.
      unsigned int n_passing_halvings = 0;
      double       obstacle_work      = 0.;
      double       imposed_work       = 0.;
      /// Energy gained by each contact, where the scheme computes it.
      std::vector<ContactStep> contacts = {};
      /// Sums of add_sum().
      std::vector<double> own = {};

      std::vector<double>
      to_list() const;

      static Sums
      from_list(const std::vector<double> &list, const unsigned int n_contacts);
    };
    Sums sums;

    /// Write the checkpoint of @p state, the end of step number @p step.
    void
    save(const State       &state,
         const unsigned int step,
         const Sums        &sums_of_state);

    /// After a failure, write checkpoint, table and fields. @return a sentence,
    /// on a line of its own, for each file that could not be written and is not
    /// part of @p known_problem.
    std::string
    save_what_there_is(const State         &state,
                       const unsigned int   step,
                       const Sums          &sums_of_state,
                       const std::string   &known_problem,
                       const dealii::Timer &stopwatch);

    // For checkpoints, known when first needed.
    std::optional<CheckpointMesh> mesh;
  };
} // namespace Ricochet

#endif
