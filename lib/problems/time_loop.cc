// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/json_writer.h>
#include <base/last_meeting.h>
#include <base/parameter_file.h>
#include <base/stop_request.h>
#include <problems/time_loop.h>

#include <deal.II/base/timer.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  void
  TimeLoop::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Time");
    parameters.add_parameter("Final time",
                             final_time,
                             "End of the run (s); the last step reaches or "
                             "passes it.",
                             Patterns::Double(1e-30));
    parameters.add_parameter(
      "Until",
      until,
      "End of the run before that: after the first step at whose end this condition on "
      "columns of energy.csv is true, such as 'kinetic_energy < 1e-6 && time > 0.1'. Other "
      "characters than letters and digits of a column are _ here. Empty: the final time.",
      Patterns::Anything());
    parameters.add_parameter("Time step",
                             time_step,
                             "Length of a step (s).",
                             Patterns::Double(1e-30));
    parameters.add_parameter(
      "Maximum halvings",
      max_halvings,
      "How often a step may be halved when Newton's method fails, before the "
      "run stops.",
      Patterns::Integer(0, 20));
    parameters.leave_subsection();

    parameters.enter_subsection("Output");
    parameters.add_parameter("Fields every",
                             fields_every,
                             "Number of steps between VTU files; 0 for "
                             "none.",
                             Patterns::Integer(0));
    parameters.add_parameter(
      "Fields at",
      fields_at,
      "Write VTU files also at these times (s), separated by commas: "
      "at the end of the step that reaches each of them.");
    parameters.add_parameter(
      "Fields when",
      fields_when,
      "Write VTU files also at the end of each step at which this condition on columns of "
      "energy.csv is true (see Time/Until), such as 'contact_force_floor > 0'.",
      Patterns::Anything());
    parameters.add_parameter(
      "Fields format",
      fields_format,
      "vtu: a VTU file for each time. hdf5: an HDF5 file for each, and solution.xdmf for "
      "ParaView; sooner written, not compressed. Both have seven digits.",
      Patterns::Selection("vtu|hdf5"));
    parameters.add_parameter(
      "Contact every",
      contact_every,
      "Write gap and force of each contact point, and the nodal forces of each contact, to "
      "contact/step-NNNNNN.h5 with this number of steps between; 0 for never.",
      Patterns::Integer(0));
    parameters.add_parameter(
      "Checkpoint every",
      checkpoint_every,
      "Number of steps between checkpoints, of which one "
      "is at the end; 0 for none except by wall time, after "
      "a failure or a signal.",
      Patterns::Integer(0));
    parameters.add_parameter(
      "Checkpoint every minutes",
      checkpoint_minutes,
      "Wall time between checkpoints (min), of which one is "
      "then at the end, too; 0 for none.",
      Patterns::Double(0.));
    parameters.add_parameter(
      "Log every",
      log_every,
      "Number of steps between lines of the log; 0 for none.",
      Patterns::Integer(0));
    parameters.add_parameter("Newton table",
                             newton_table,
                             "Print each Newton iteration: residual over the "
                             "forces that make it up, length of the step, "
                             "active contact points.");
    parameters.add_parameter("Timing",
                             timing,
                             "At the end, print where the time was spent.");
    parameters.leave_subsection();
  }



  void
  TimeLoop::Parameters::validate() const
  {
    // Refuses what cannot be read.
    Condition(until, "Time/Until");
    Condition(fields_when, "Output/Fields when");
    if (final_time > 1e8 * time_step)
      throw InputError("The final time " + to_text(final_time) +
                       " is more than 1e8 time steps of " + to_text(time_step) +
                       " away.");
    if (time_step > (1. + 1e-9) * final_time)
      throw InputError("The time step " + to_text(time_step) +
                       " is longer than the whole run of " +
                       to_text(final_time) + ".");
    for (const double time : fields_at)
      if (time < 0. || time > final_time + time_step)
        throw InputError("Output/Fields at has the time " + to_text(time) +
                         ", which is not in the run from 0 to " +
                         to_text(final_time) + ".");
  }



  namespace
  {
    std::vector<std::pair<std::string, std::vector<types::boundary_id>>>
    boundaries_by_name(const std::map<types::boundary_id, std::string> &names)
    {
      std::vector<std::pair<std::string, std::vector<types::boundary_id>>> list;
      for (const auto &[id, name] : names)
        {
          const auto known = std::find_if(list.begin(),
                                          list.end(),
                                          [&name = name](const auto &entry) {
                                            return entry.first == name;
                                          });
          if (known == list.end())
            list.push_back({name, {id}});
          else
            known->second.push_back(id);
        }
      return list;
    }

    /// The contacts with their promises: of boundaries with one name the weakest.
    std::vector<EnergyCheck::Contact>
    checked_contacts(
      const ContactOperator &contact,
      const std::vector<std::pair<std::string, std::vector<types::boundary_id>>>
        &names)
    {
      std::vector<EnergyCheck::Contact> list;
      for (const auto &[name, ids] : names)
        {
          EnergyPromise promise = contact.promise_at(ids.front());
          for (const types::boundary_id id : ids)
            promise = promise.and_also(contact.promise_at(id));
          list.push_back({name, promise});
        }
      return list;
    }
  } // namespace



  TimeLoop::TimeLoop(
    const Parameters                                        &parameters,
    RunFolder                                               &folder,
    SemiDiscreteSystem                                      &system,
    TimeScheme                                              &scheme,
    const std::map<dealii::types::boundary_id, std::string> &contact_names,
    const Units                                             &units)
    : parameters(parameters)
    , until(parameters.until, "Time/Until")
    , fields_when(parameters.fields_when, "Output/Fields when")
    , folder(folder)
    , system(system)
    , scheme(scheme)
    , contact_names(boundaries_by_name(contact_names))
    , units(units)
    , ledger(folder)
    , check(system.contact.promise,
            checked_contacts(system.contact, this->contact_names),
            system.contact.traits().has_moving_obstacles &&
              scheme.contact_force_is_of_step())
  {
    sums.contacts.resize(this->contact_names.size());
    const auto add = [this](const std::string &name,
                            const std::string &unit,
                            const bool         may_be_empty = false) {
      ledger.add_column(name, this->units.name(unit), may_be_empty);
    };
    const auto add_total = [this](const std::string &name,
                                  const std::string &unit) {
      ledger.add_column(name,
                        this->units.name(unit),
                        /* may be empty */ false,
                        /* is sum */ true);
    };
    add("time", "s");
    add("kinetic_energy", "J");
    add("elastic_energy", "J");
    add("energy", "J");
    add("modified_energy",
        "J",
        /* may be empty */ !system.contact.traits().has_modified_energy);
    add("total_energy",
        "J",
        /* may be empty */ !system.contact.traits().has_modified_energy);
    add_total("external_work", "J");
    add_total("contact_work", "J");
    add_total("friction_work", "J");
    add_total("viscous_dissipation", "J");
    add_total("numerical_dissipation", "J");
    if (system.contact.traits().has_moving_obstacles)
      add_total("obstacle_work", "J");
    if (system.has_imposed_displacements())
      add_total("imposed_work", "J");
    add("balance_residual", "1");
    add("promise_residual",
        "1",
        /* may be empty */ !system.contact.traits().has_modified_energy);
    add("round_off", "J");
    add("newton_iterations", "1");
    add("linear_solves", "1");
    add("solver", "1");
    add("outer_iterations", "1");
    add("inner_iterations", "1");
    add("tangents", "1");
    add_total("step_halvings", "1");
    add_total("passing_halvings", "1");
    for (const auto &[name, ids] : this->contact_names)
      {
        const bool may_be_empty = system.contact.traits().gaps_may_be_unknown;
        add("mean_gap_" + name, "m", may_be_empty);
        add("smallest_gap_" + name, "m", may_be_empty);
        add("penetration_" + name, "m");
        add("contact_force_" + name, "N");
        add("contact_pressure_" + name, "Pa");
        if (system.contact.traits().knows_stress_pressure)
          add("stress_pressure_" + name, "Pa");
        add("active_points_" + name, "1");
        add_total("passed_points_" + name, "1");
        if (scheme.contact_force_is_of_step())
          add_total("contact_gain_" + name, "J");
        if (scheme.contact_force_is_of_step() && may_be_empty)
          {
            add_total("dropped_points_" + name, "1");
            add_total("entered_points_" + name, "1");
          }
      }
    if (system.contact.traits().knows_work)
      for (const auto &contact : this->contact_names)
        {
          const auto &[name, ids] = contact;
          const auto work_of      = [this, ids = ids]() {
            ContactWork sum;
            for (const auto id : ids)
              {
                const ContactWork work = this->system.contact.contact_work(id);
                sum.normal += work.normal;
                sum.friction += work.friction;
              }
            return sum;
          };
          add_sum("normal_work_" + name,
                  "J",
                  [work_of](const State &, const State &) {
                    return work_of().normal;
                  });
          add_sum("friction_work_" + name,
                  "J",
                  [work_of](const State &, const State &) {
                    return work_of().friction;
                  });
        }
  }



  void
  TimeLoop::add_column(const std::string                          &name,
                       const std::string                          &unit,
                       const std::function<double(const State &)> &value)
  {
    add_columns({name}, unit, [value](const State &state) {
      return std::vector<double>{value(state)};
    });
  }



  void
  TimeLoop::add_columns(
    const std::vector<std::string>                          &names,
    const std::string                                       &unit,
    const std::function<std::vector<double>(const State &)> &values)
  {
    for (const std::string &name : names)
      ledger.add_column(name, units.name(unit));
    own_columns.push_back(values);
  }



  unsigned int
  TimeLoop::add_own_sum(const Increment &increment)
  {
    own_sums.push_back(increment);
    sums.own.push_back(0.);
    own_means.push_back(0.);
    return own_sums.size() - 1;
  }



  void
  TimeLoop::add_column_of_sum(const std::string &name,
                              const std::string &unit,
                              const bool         may_be_empty,
                              const unsigned int k)
  {
    ledger.add_column(name, units.name(unit), may_be_empty, /* is sum */ true);
    own_columns.push_back(
      [this, k](const State &) { return std::vector<double>{sums.own[k]}; });
  }



  void
  TimeLoop::add_sum(
    const std::string                                         &name,
    const std::string                                         &unit,
    const std::function<double(const State &, const State &)> &increment)
  {
    const unsigned int k = add_own_sum(
      [increment](const State &begin, const State &end, const StepReport &) {
        return increment(begin, end);
      });
    add_column_of_sum(name, unit, /* may be empty */ false, k);
  }



  void
  TimeLoop::add_reported_sum(
    const std::string                               &name,
    const std::string                               &unit,
    const std::function<double(const StepReport &)> &increment)
  {
    const unsigned int k = add_own_sum(
      [increment](const State &, const State &, const StepReport &report) {
        return increment(report);
      });
    add_column_of_sum(name, unit, /* may be empty */ true, k);
  }



  void
  TimeLoop::add_mean(
    const std::string                                         &name,
    const std::string                                         &unit,
    const std::function<double(const State &, const State &)> &increment)
  {
    const unsigned int k = add_own_sum(
      [increment](const State &begin, const State &end, const StepReport &) {
        return increment(begin, end);
      });
    add_column(name, unit, [this, k](const State &) { return own_means[k]; });
  }



  StepReport
  TimeLoop::step(const State       &old_state,
                 const double       time_step,
                 const unsigned int n_halvings_so_far,
                 State             &new_state)
  {
    try
      {
        return scheme.step(system, old_state, time_step, new_state);
      }
    catch (const NewtonFailure &)
      {
        if (!scheme.has_last_resort() ||
            n_halvings_so_far < parameters.max_halvings)
          throw;
      }
    const StepReport report =
      scheme.step_of_last_resort(system, old_state, time_step, new_state);
    folder.log(
      "note: Newton's method found no equilibrium at t = " +
      units.text(new_state.time, "s") +
      ", pseudo-transient continuation did; a motion to it would lose " +
      units.text(report.numerical_dissipation, "J"));
    return report;
  }



  StepReport
  TimeLoop::advance(const State       &old_state,
                    const double       time_step,
                    const unsigned int n_halvings_so_far,
                    State             &new_state)
  {
    try
      {
        StepReport report =
          step(old_state, time_step, n_halvings_so_far, new_state);
        if (obstacle_work && system.contact.traits().has_moving_obstacles)
          {
            const auto forces_of = [](const State &state) {
              return state.contact_shares.empty()
                ? std::vector<Vector>{state.contact_force}
                : state.contact_shares;
            };
            std::vector<Vector> forces = forces_of(new_state);
            if (!scheme.contact_force_is_of_step())
              {
                const std::vector<Vector> old_forces = forces_of(old_state);
                for (unsigned int k = 0; k < forces.size(); ++k)
                  forces[k].sadd(.5, .5, old_forces[k]);
              }
            report.obstacle_work = obstacle_work(old_state.solution,
                                                 new_state.solution,
                                                 forces,
                                                 old_state.time,
                                                 new_state.time);
          }
        for (const auto &increment : own_sums)
          report.own_sums.push_back(increment(old_state, new_state, report));
        report.round_off = system.round_off_force() *
            system.distance(old_state.solution, new_state.solution) +
          system.bulk.energy_round_off();
        // ARKODE has steps of its own.
        if (!scheme.integrates_by_itself())
          {
            report.contact_steps = contact_steps(old_state, new_state);
            check_passing(old_state,
                          time_step,
                          n_halvings_so_far,
                          report.contact_steps);
          }
        return report;
      }
    catch (const StepTooLong &)
      {
        ++sums.n_passing_halvings;
      }
    catch (const NewtonFailure &failure)
      {
        if (n_halvings_so_far == parameters.max_halvings)
          throw NewtonFailure(
            "The step from t = " + units.text(old_state.time, "s") +
            " of length " + units.text(time_step, "s") +
            " cannot be made, after " + std::to_string(n_halvings_so_far) +
            " halvings.\n" + Utilities::trim(failure.what()) +
            "\nAll results up to then are in the output folder.");
        ++sums.n_halvings;
      }
    State      middle;
    StepReport report =
      advance(old_state, .5 * time_step, n_halvings_so_far + 1, middle);
    report += advance(middle, .5 * time_step, n_halvings_so_far + 1, new_state);
    // A force or acceleration over the step is the mean of those over its halves.
    if (scheme.contact_force_is_of_step())
      {
        new_state.acceleration.sadd(.5, .5, middle.acceleration);
        new_state.contact_force.sadd(.5, .5, middle.contact_force);
        for (unsigned int k = 0; k < new_state.contact_shares.size(); ++k)
          new_state.contact_shares[k].sadd(.5, .5, middle.contact_shares[k]);
      }
    return report;
  }



  std::vector<double>
  TimeLoop::Sums::to_list() const
  {
    std::vector<double> list = {external_work,
                                contact_work,
                                friction_work,
                                viscous_dissipation,
                                numerical_dissipation,
                                static_cast<double>(n_halvings),
                                static_cast<double>(n_passing_halvings),
                                obstacle_work,
                                imposed_work};
    for (const ContactStep &contact : contacts)
      list.insert(list.end(),
                  {contact.made,
                   static_cast<double>(contact.n_dropped),
                   static_cast<double>(contact.n_entered),
                   static_cast<double>(contact.n_passed)});
    list.insert(list.end(), own.begin(), own.end());
    return list;
  }



  TimeLoop::Sums
  TimeLoop::Sums::from_list(const std::vector<double> &list,
                            const unsigned int         n_contacts)
  {
    constexpr unsigned int   first = 9, n_of_contact = 4;
    const unsigned int       first_own = first + n_of_contact * n_contacts;
    std::vector<ContactStep> contacts(n_contacts);
    for (unsigned int k = 0; k < n_contacts; ++k)
      {
        const double *values  = &list[first + n_of_contact * k];
        contacts[k].made      = values[0];
        contacts[k].n_dropped = static_cast<unsigned int>(values[1]);
        contacts[k].n_entered = static_cast<unsigned int>(values[2]);
        contacts[k].n_passed  = static_cast<unsigned int>(values[3]);
      }
    return {list[0],
            list[1],
            list[2],
            list[3],
            list[4],
            static_cast<unsigned int>(list[5]),
            static_cast<unsigned int>(list[6]),
            list[7],
            list[8],
            contacts,
            {list.begin() + first_own, list.end()}};
  }



  std::vector<ContactStep>
  TimeLoop::contact_steps(const State &old_state, const State &new_state) const
  {
    const ContactSteps by_boundary = system.contact.end_step(old_state.solution,
                                                             new_state.solution,
                                                             old_state.time,
                                                             new_state.time);
    std::vector<ContactStep> steps(contact_names.size());
    for (unsigned int k = 0; k < contact_names.size(); ++k)
      for (const types::boundary_id id : contact_names[k].second)
        if (const auto found = by_boundary.find(id); found != by_boundary.end())
          steps[k].unite(found->second);
    return steps;
  }



  void
  TimeLoop::check_passing(const State                    &old_state,
                          const double                    time_step,
                          const unsigned int              n_halvings_so_far,
                          const std::vector<ContactStep> &steps) const
  {
    for (unsigned int k = 0; k < steps.size(); ++k)
      {
        // Passages that remain with the shortest step are counted.
        if (steps[k].n_passed == 0 ||
            (n_halvings_so_far == parameters.max_halvings &&
             parameters.max_halvings > 0))
          continue;
        const std::string text =
          "In the step from t = " + units.text(old_state.time, "s") +
          " of length " + units.text(time_step, "s") + " " +
          std::to_string(steps[k].n_passed) +
          " points go through the contact '" + contact_names[k].first +
          "' without touching it, one of them at " +
          place_text(steps[k].place_passed) +
          " of the undeformed body. Take a smaller Time/Time step, or allow "
          "Time/Maximum halvings.\n";
        if (parameters.max_halvings == 0)
          throw ComputationError(text +
                                 "All results up to then are in the "
                                 "output folder.");
        throw StepTooLong(text);
      }
  }



  std::string
  TimeLoop::place_text(const Point<3> &place) const
  {
    std::string text = "(";
    for (unsigned int c = 0; c < system.unknowns.dim; ++c)
      text += (c == 0 ? "" : ", ") + to_text(place[c]);
    return text + ")";
  }



  TimeLoop::Energies
  TimeLoop::energies_of(const State &state) const
  {
    return {system.kinetic_energy(state.velocity),
            system.bulk.energy(state.solution)};
  }



  void
  TimeLoop::add_row(const State      &state,
                    const Energies   &energies,
                    const StepReport &report,
                    const double      balance)
  {
    const double       modified = system.contact.traits().has_modified_energy
            ? energies.total() + system.contact.potential(state.solution, state.time)
            : std::numeric_limits<double>::quiet_NaN();
    EnergyCheck::Terms terms;
    terms.time    = state.time;
    terms.kinetic = energies.kinetic;
    terms.stored  = energies.stored;
    // Equal to the last digit to the value that a resumed run reads from the
    // row.
    terms.potential             = modified - energies.total();
    terms.external_work         = sums.external_work;
    terms.imposed_work          = sums.imposed_work;
    terms.obstacle_work         = sums.obstacle_work;
    terms.contact_work          = sums.contact_work;
    terms.friction_work         = sums.friction_work;
    terms.viscous_dissipation   = sums.viscous_dissipation;
    terms.numerical_dissipation = sums.numerical_dissipation;
    if (scheme.contact_force_is_of_step())
      for (const ContactStep &contact : sums.contacts)
        terms.contact_gains.push_back(contact.made);
    terms.balance                     = balance;
    terms.round_off                   = report.round_off;
    const EnergyCheck::Values checked = check.add(terms);

    std::vector<double> row = {state.time,
                               energies.kinetic,
                               energies.stored,
                               energies.total(),
                               modified,
                               checked.total,
                               sums.external_work,
                               sums.contact_work,
                               sums.friction_work,
                               sums.viscous_dissipation,
                               sums.numerical_dissipation};
    if (system.contact.traits().has_moving_obstacles)
      row.push_back(sums.obstacle_work);
    if (system.has_imposed_displacements())
      row.push_back(sums.imposed_work);
    row.insert(row.end(),
               {checked.balance_residual,
                checked.promise_residual,
                report.round_off,
                static_cast<double>(report.solver.newton_iterations),
                static_cast<double>(report.solver.newton_iterations +
                                    report.other_linear_solves),
                static_cast<double>(report.solver.strategies),
                static_cast<double>(report.solver.outer_iterations),
                static_cast<double>(report.solver.inner_iterations),
                static_cast<double>(report.solver.n_tangents),
                static_cast<double>(sums.n_halvings),
                static_cast<double>(sums.n_passing_halvings)});
    const auto summaries = system.contact.summary(
      {state.solution, state.contact_force, state.time, &state.contact_shares});
    for (unsigned int k = 0; k < contact_names.size(); ++k)
      {
        const auto &entry = contact_names[k];
        // All nodes of a small boundary may count as its neighbours'.
        std::optional<ContactSummary> united;
        for (const types::boundary_id id : entry.second)
          if (const auto own = summaries.find(id); own != summaries.end())
            {
              if (united)
                united->unite(own->second);
              else
                united = own->second;
            }
        const ContactSummary contact = united.value_or(ContactSummary());
        row.insert(row.end(),
                   {contact.mean_gap,
                    contact.smallest_gap,
                    contact.max_penetration,
                    contact.force,
                    contact.contact_pressure});
        if (system.contact.traits().knows_stress_pressure)
          row.push_back(contact.stress_pressure);
        row.push_back(static_cast<double>(contact.active_points));
        row.push_back(static_cast<double>(sums.contacts[k].n_passed));
        if (scheme.contact_force_is_of_step())
          row.push_back(sums.contacts[k].made);
        if (scheme.contact_force_is_of_step() &&
            system.contact.traits().gaps_may_be_unknown)
          row.insert(row.end(),
                     {static_cast<double>(sums.contacts[k].n_dropped),
                      static_cast<double>(sums.contacts[k].n_entered)});
      }
    for (const auto &values : own_columns)
      {
        const std::vector<double> own = values(state);
        row.insert(row.end(), own.begin(), own.end());
      }
    for (unsigned int i = 0; i < row.size(); ++i)
      if (!std::isfinite(row[i]) && !ledger.columns()[i].may_be_empty)
        throw ComputationError(
          "The state at t = " + units.text(state.time, "s") +
          " is not finite, in the column '" + ledger.columns()[i].name +
          "' at first. All results up to then are "
          "in the output folder.");
    ledger.add_row(row);
    if (checked.breaks_promise)
      log_broken_promise(report, state.time);
    if (!has_inverted_corner)
      if (const std::string place = system.bulk.inverted_corner(state.solution);
          !place.empty())
        {
          has_inverted_corner = true;
          folder.log(
            "note: at t = " + units.text(state.time, "s") +
            " a cell is turned inside out in its corner at " + place +
            ", though not where stresses are evaluated: take a finer mesh "
            "there, or triangles or tetrahedra");
        }
  }



  EnergyCheck::Terms
  TimeLoop::terms_of(const std::vector<double> &row) const
  {
    const auto value = [&](const std::string &name) {
      return ledger.value(row, name);
    };
    EnergyCheck::Terms terms;
    terms.time                  = value("time");
    terms.kinetic               = value("kinetic_energy");
    terms.stored                = value("elastic_energy");
    terms.potential             = value("modified_energy") - value("energy");
    terms.external_work         = value("external_work");
    terms.imposed_work          = value("imposed_work");
    terms.obstacle_work         = value("obstacle_work");
    terms.contact_work          = value("contact_work");
    terms.friction_work         = value("friction_work");
    terms.viscous_dissipation   = value("viscous_dissipation");
    terms.numerical_dissipation = value("numerical_dissipation");
    terms.round_off             = value("round_off");
    if (scheme.contact_force_is_of_step())
      for (const auto &contact : contact_names)
        terms.contact_gains.push_back(value("contact_gain_" + contact.first));
    const double scale = check.scale_with(terms);
    terms.balance      = value("balance_residual") * (scale > 0. ? scale : 1.);
    return terms;
  }



  void
  TimeLoop::log_broken_promise(const StepReport &report, const double time)
  {
    const EnergyCheck::Contact *contact = check.worst_contact();
    std::string                 text =
      "note: the promise is broken at t = " + units.text(time, "s");
    if (!contact || report.contact_steps.empty())
      {
        folder.log(text + ": the total energy is not what it was.");
        return;
      }
    unsigned int k = 0;
    while (contact_names[k].first != contact->name)
      ++k;
    const ContactStep &step = report.contact_steps[k];
    text += " by the contact '" + contact->name + "', which " +
      contact->promise.verb() + ": in this step it has made " +
      units.text(step.made, "J") + ", " + units.text(step.made_at_point, "J") +
      " of it at the point " + place_text(step.place) +
      " of the undeformed body";
    if (step.part < part_names.size())
      text += " '" + part_names[step.part] + "'";
    text += ".";
    if (step.n_entered > 0)
      text += " Points that came in behind a facet: " +
        std::to_string(step.n_entered) + ".";
    if (step.n_dropped > 0)
      text += " Points that were pressed and face no facet any more: " +
        std::to_string(step.n_dropped) + ".";
    folder.log(
      text +
      " What may help: a smaller Time/Time step, a finer mesh there, the "
      "other surface as the first one of the contact, another Treatment (persistent "
      "contact does no work in any point) or, in 2D, Coupling = mortar.");
  }



  std::string
  TimeLoop::log_head() const
  {
    const auto with_unit = [this](const std::string &name,
                                  const std::string &unit) {
      return name + " [" + units.name(unit) + "]";
    };
    char line[200];
    std::snprintf(line,
                  sizeof(line),
                  "%8s/%-8s %12s %14s %14s %10s %12s %7s %7s  %s",
                  "step",
                  "of",
                  with_unit("time", "s").c_str(),
                  with_unit("energy", "J").c_str(),
                  with_unit("modified", "J").c_str(),
                  "balance",
                  with_unit("force", "N").c_str(),
                  "active",
                  "Newton",
                  "solver");
    return line;
  }



  void
  TimeLoop::log_row(const unsigned int step,
                    const unsigned int n_steps,
                    const unsigned int first_step,
                    const double       seconds) const
  {
    // Only for long runs: short ones need no estimate, and their logs can be
    // compared.
    char remaining[40] = "";
    if (parameters.timing && seconds > 10. && step < n_steps)
      std::snprintf(remaining,
                    sizeof(remaining),
                    "   %.0f s left",
                    seconds * (n_steps - step) / (step - first_step));
    const std::vector<double> &row   = ledger.rows().back();
    const auto                 value = [&](const std::string &name) {
      return row[ledger.column_number(name)];
    };
    double force = 0., active = 0.;
    for (const auto &entry : contact_names)
      {
        force += value("contact_force_" + entry.first);
        active += value("active_points_" + entry.first);
      }
    if (folder.options.json_progress)
      {
        JsonWriter json(/* on one line */ true);
        json.add("event", "step");
        json.add("step", step);
        json.add("of", n_steps);
        for (const char *const name :
             {"time", "energy", "balance_residual", "newton_iterations"})
          json.add(name, value(name));
        json.add("contact_force", force);
        json.add("seconds_left",
                 seconds * (n_steps - step) / (step - first_step));
        folder.report_progress(json);
      }
    char modified_energy[40] = "-";
    if (system.contact.traits().has_modified_energy)
      std::snprintf(modified_energy,
                    sizeof(modified_energy),
                    "%.7e",
                    value("modified_energy"));
    char line[200];
    std::snprintf(line,
                  sizeof(line),
                  "%8u/%-8u %12.6g %14.7e %14s %10.2e %12.4e %7.0f %7.0f  %s%s",
                  step,
                  n_steps,
                  value("time"),
                  value("energy"),
                  modified_energy,
                  value("balance_residual"),
                  force,
                  active,
                  value("newton_iterations"),
                  SolverReport::short_text(
                    static_cast<unsigned int>(value("solver")))
                    .c_str(),
                  remaining);
    folder.log(line);
  }



  void
  TimeLoop::save(const State       &state,
                 const unsigned int step,
                 const Sums        &sums_of_state)
  {
    if (!mesh)
      mesh.emplace(system.unknowns, folder.communicator);
    Checkpoint{step,
               sums_of_state.to_list(),
               ledger.seal(),
               state,
               system.frozen_tangent}
      .write(folder, *mesh);
  }



  std::string
  TimeLoop::save_what_there_is(const State       &state,
                               const unsigned int step,
                               const Sums        &sums_of_state,
                               const std::string &known_problem,
                               const Timer       &stopwatch)
  {
    // The checkpoint first: the rest can be made again from it.
    std::string problems;
    const auto  careful = [&](const std::function<void()> &action) {
      try
        {
          action();
        }
      catch (const ComputationError &problem)
        {
          if (known_problem.find(problem.what()) == std::string::npos)
            problems += std::string("\n") + problem.what();
        }
    };
    careful([&]() { save(state, step, sums_of_state); });
    careful([&]() { ledger.write_hdf5(); });
    careful([&]() { write_summary("failed", known_problem, stopwatch); });
    if (write_fields && parameters.wants_fields())
      careful([&]() { write_fields(state, step); });
    return problems;
  }



  unsigned int
  TimeLoop::begin(State &state, const unsigned int n_steps)
  {
    if (folder.resume)
      {
        mesh.emplace(system.unknowns, folder.communicator);
        const Checkpoint   checkpoint = Checkpoint::read(folder, state, *mesh);
        const unsigned int step       = checkpoint.step;
        const double       time = state.time + step * parameters.time_step;
        if (checkpoint.sums.size() != sums.to_list().size() ||
            checkpoint.ledger.n_rows != step + 1 ||
            std::abs(checkpoint.state.time - time) >
              1e-6 * parameters.time_step)
          throw InputError(
            "The run cannot be resumed: its checkpoint is damaged, "
            "with other sums, rows or times than this run has.");
        state                 = checkpoint.state;
        system.frozen_tangent = checkpoint.tangent;
        sums = Sums::from_list(checkpoint.sums, contact_names.size());
        if (step > n_steps)
          throw InputError(
            "The run cannot be resumed: its checkpoint is at t "
            "= " +
            units.text(state.time, "s") + ", after the final time " +
            units.text(parameters.final_time, "s") + ".");
        ledger.resume(checkpoint.ledger);
        for (const auto &row : ledger.rows())
          check.add(terms_of(row));
        folder.log("resumed after step " + std::to_string(step) +
                   ", t = " + units.text(state.time, "s"));
        // Fields of this step may be missing, if the run was killed.
        write_fields_if_due(state, step);
        return step;
      }
    ledger.start();
    add_row(state, energies_of(state), StepReport(), 0.);
    write_fields_if_due(state, 0);
    return 0;
  }



  bool
  TimeLoop::is_true_now(const Condition &condition) const
  {
    if (!condition.exists())
      return false;
    std::map<std::string, double> values;
    for (unsigned int i = 0; i < ledger.columns().size(); ++i)
      {
        std::string name = ledger.columns()[i].name;
        std::replace_if(
          name.begin(),
          name.end(),
          [](const unsigned char c) { return std::isalnum(c) == 0; },
          '_');
        values.emplace(name, ledger.rows().back()[i]);
      }
    return condition.is_true(values);
  }



  bool
  TimeLoop::are_fields_due(const State &state, const unsigned int step) const
  {
    const double begin = state.time - parameters.time_step,
                 slack = 1e-9 * parameters.time_step;
    // The condition is looked at in any case: at the start it is refused if it names what is
    // not there.
    return is_true_now(fields_when) ||
      (parameters.fields_every > 0 && step % parameters.fields_every == 0) ||
      std::any_of(parameters.fields_at.begin(),
                  parameters.fields_at.end(),
                  [&](const double time) {
                    return time > begin + slack && time <= state.time + slack;
                  });
  }



  void
  TimeLoop::write_fields_if_due(const State &state, const unsigned int step)
  {
    if (write_fields && are_fields_due(state, step))
      write_fields(state, step);
    if (write_contact && parameters.contact_every > 0 &&
        step % parameters.contact_every == 0)
      write_contact(state, step);
  }



  void
  TimeLoop::log_newton_tables()
  {
    system.newton_observer =
      [this](const std::vector<NewtonSolver::Iteration>  &history,
             const std::optional<SolverReport::Strategy> &strategy) {
        const std::string suffix =
          strategy ? "   " + SolverReport::short_text(*strategy) : "";
        for (unsigned int k = 0; k < history.size(); ++k)
          {
            char line[160];
            std::snprintf(line,
                          sizeof(line),
                          "      Newton %3u   residual %10.3e   step %6.4f   "
                          "active %s%s",
                          k,
                          history[k].relative_residual,
                          history[k].step_length,
                          history[k].active_set.c_str(),
                          suffix.c_str());
            folder.log(line);
          }
      };
  }



  void
  TimeLoop::account(const State      &new_state,
                    const StepReport &report,
                    double           &energy)
  {
    sums.external_work += report.external_work;
    sums.contact_work += report.contact_work;
    sums.friction_work += report.friction_work;
    sums.viscous_dissipation += report.viscous_dissipation;
    sums.numerical_dissipation += report.numerical_dissipation;
    sums.obstacle_work += report.obstacle_work;
    sums.imposed_work += report.imposed_work;
    for (unsigned int k = 0; k < report.contact_steps.size(); ++k)
      sums.contacts[k].unite(report.contact_steps[k]);
    for (unsigned int k = 0; k < report.own_sums.size(); ++k)
      {
        sums.own[k] += report.own_sums[k];
        own_means[k] = report.own_sums[k] / parameters.time_step;
      }
    const double   old_energy = energy;
    const Energies energies   = energies_of(new_state);
    energy                    = energies.total();
    const double residual     = energy - old_energy - report.external_work -
      report.imposed_work + report.contact_work + report.friction_work +
      report.viscous_dissipation + report.numerical_dissipation;
    add_row(new_state, energies, report, residual);
  }



  std::string
  TimeLoop::how_solved() const
  {
    // The first row is that of the initial state.
    std::vector<unsigned int> steps;
    const unsigned int        column = ledger.column_number("solver");
    for (std::size_t k = 1; k < ledger.rows().size(); ++k)
      steps.push_back(static_cast<unsigned int>(ledger.rows()[k][column]));
    return SolverReport::summary(steps);
  }



  RunSummary
  TimeLoop::summary() const
  {
    std::vector<std::string> names;
    for (const auto &entry : contact_names)
      names.push_back(entry.first);
    return {ledger,
            names,
            check,
            units,
            rebounds,
            field_extremes ? field_extremes() : std::vector<FieldExtreme>()};
  }



  RunSummary::Circumstances
  TimeLoop::circumstances(const std::string &state,
                          const std::string &reason,
                          const Timer       &stopwatch) const
  {
    const std::uint64_t mesh_checksum = system.unknowns.mesh_checksum();
    char                text[24];
    std::snprintf(text,
                  sizeof(text),
                  "%016llx",
                  static_cast<unsigned long long>(mesh_checksum));
    return {state,
            reason,
            parameters.final_time,
            parameters.time_step,
            until.exists(),
            stopwatch.wall_time(),
            Utilities::MPI::sum(stopwatch.cpu_time(), folder.communicator),
            Utilities::MPI::n_mpi_processes(folder.communicator),
            text,
            system.linear_solver_description(),
            how_solved()};
  }



  void
  TimeLoop::write_summary(const std::string &state,
                          const std::string &reason,
                          const Timer       &stopwatch)
  {
    const auto       how     = circumstances(state, reason, stopwatch);
    const RunSummary results = summary();
    folder.results           = results.results(how);
    folder.end_time = exact_text(ledger.value(ledger.rows().back(), "time"));
    on_first_rank(folder.communicator, [&]() {
      write_atomically(folder.file("summary.json"), results.json(how, folder));
    });
  }



  void
  TimeLoop::conclude(TimerOutput &timer, std::ostringstream &timing_table)
  {
    for (const std::string &line : check.verdict())
      folder.log(line);
    for (const auto &[name, ids] : contact_names)
      for (const auto &[column, text] :
           {std::pair<std::string, std::string>{
              "passed_points_",
              "points that went through it without touching it"},
            {"dropped_points_",
             "points that were pressed and then faced no facet"},
            {"entered_points_", "points that came in behind a facet"}})
        if (const double n = ledger.value(ledger.rows().back(), column + name);
            n > 0.)
          folder.log("contact " + name + ": " + to_text(n) + " " + text);
    for (const std::string &line : summary().lines())
      folder.log(line);
    if (const std::string text = how_solved(); !text.empty())
      folder.log("steps by how they were solved: " + text);
    if (const unsigned int n = system.n_multigrid_failures())
      folder.log("note: multigrid did not converge for " + std::to_string(n) +
                 " linear systems, which were factored instead");
    if (check.is_open())
      folder.leave_open(check.verdict());
    if (!parameters.timing)
      return;
    timer.print_summary();
    folder.log(timing_table.str());
    const SemiDiscreteSystem::Shares shares = system.shares();
    char                             line[160];
    std::snprintf(line,
                  sizeof(line),
                  "of the steps: residuals %.3g s, tangents %.3g s, %u "
                  "factorisations %.3g s, back-substitutions %.3g s (%u)",
                  shares.residual,
                  shares.tangent,
                  system.n_factorisations(),
                  shares.factorisation,
                  shares.back_substitution,
                  system.n_back_substitutions());
    folder.log(line);
    folder.log("linear solver: " + system.linear_solver_description());
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    const std::uint64_t all_ranks =
      Utilities::MPI::sum(static_cast<std::uint64_t>(memory.VmHWM),
                          folder.communicator);
    folder.log("memory at most: " + std::to_string(all_ranks / 1024) + " MB");
  }



  namespace
  {
    /// Wall time since the last checkpoint, as measured on the first rank.
    class CheckpointClock
    {
    public:
      CheckpointClock(const double minutes, const MPI_Comm communicator)
        : minutes(minutes)
        , communicator(communicator)
      {}

      /// Whether a checkpoint is due; at the end of a run if there was one
      /// before. Collective.
      bool
      is_due(const bool is_end)
      {
        if (minutes == 0.)
          return false;
        const bool has_passed =
          Utilities::MPI::broadcast(communicator,
                                    since_last.wall_time() > 60. * minutes);
        if (!has_passed)
          return is_end && has_begun;
        has_begun = true;
        since_last.restart();
        return true;
      }

    private:
      const double   minutes;
      const MPI_Comm communicator;
      Timer          since_last;
      bool           has_begun = false;
    };
  } // namespace



  State
  TimeLoop::run(const State &initial_state)
  {
    const double       first_time = initial_state.time;
    const unsigned int n_steps    = static_cast<unsigned int>(std::ceil(
      (parameters.final_time - first_time) / parameters.time_step - 1e-9));

    State        state = initial_state;
    unsigned int step  = begin(state, n_steps);
    // Also at the start, where it must be readable and need not be false.
    bool is_over = is_true_now(until) && step > 0;
    folder.log(log_head());
    if (parameters.newton_table)
      log_newton_tables();

    std::ostringstream timing_table;
    TimerOutput        timer(timing_table,
                      TimerOutput::never,
                      TimerOutput::wall_times);
    State              new_state;
    const Timer        stopwatch;
    const unsigned int first_step = step;
    double             energy     = energies_of(state).total();
    // Sums up to the last complete step.
    Sums              complete_sums = sums;
    CheckpointClock   checkpoint_clock(parameters.checkpoint_minutes,
                                     folder.communicator);
    const StopRequest stop_request;
    int               signal = 0;
    try
      {
        while (step < n_steps && !is_over && signal == 0)
          {
            timer.enter_subsection("steps");
            const StepReport report =
              advance(state, parameters.time_step, 0, new_state);
            timer.leave_subsection();
            // Not a sum of many steps, so that no round-off piles up.
            new_state.time = first_time + (step + 1) * parameters.time_step;

            timer.enter_subsection("energy ledger");
            account(new_state, report, energy);
            // Only now is the step complete.
            std::swap(state, new_state);
            ++step;
            complete_sums = sums;
            timer.leave_subsection();

            if (parameters.log_every > 0 && step % parameters.log_every == 0)
              log_row(step, n_steps, first_step, stopwatch.wall_time());
            const TimerOutput::Scope scope(timer, "fields and checkpoints");
            write_fields_if_due(state, step);
            signal             = StopRequest::signal(folder.communicator);
            is_over            = is_true_now(until);
            const bool is_last = step == n_steps || is_over || signal != 0;
            if ((parameters.checkpoint_every > 0 &&
                 (step % parameters.checkpoint_every == 0 || is_last)) ||
                signal != 0 || checkpoint_clock.is_due(is_last))
              save(state, step, complete_sums);
          }
      }
    catch (const ComputationError &failure)
      {
        // A failure on this rank only cannot be followed by a collective save.
        if (!LastMeeting::is_complete())
          throw;
        // A step that was not completed leaves no trace.
        const std::string text = failure.what();
        throw ComputationError(
          text +
          save_what_there_is(state, step, complete_sums, text, stopwatch));
      }
    catch (const std::exception &failure)
      {
        // Out of memory, or an error in a library: perhaps on this rank only,
        // so that a collective save is impossible. The last checkpoint remains.
        if (Utilities::MPI::n_mpi_processes(folder.communicator) == 1)
          save_what_there_is(state,
                             step,
                             complete_sums,
                             failure.what(),
                             stopwatch);
        throw;
      }
    ledger.write_hdf5();
    if (is_over)
      folder.log("ends at t = " + units.text(state.time, "s") + ", where " +
                 parameters.until);
    else if (until.exists() && step == n_steps)
      folder.log("note: up to the final time it was never so that " +
                 parameters.until);
    conclude(timer, timing_table);
    std::string reason;
    if (step < n_steps && !is_over)
      reason = StopRequest::name_of(signal) + " came in step " +
        std::to_string(step) + " of " + std::to_string(n_steps) +
        ", which is complete: t = " + units.text(state.time, "s") +
        ". With --resume the run goes on from there.";
    write_summary(reason.empty() ? "complete" : "stopped", reason, stopwatch);
    if (!reason.empty())
      throw StoppedBySignal(signal, reason);
    return state;
  }
} // namespace Ricochet
