// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/commit.h>
#include <base/files.h>
#include <base/json_writer.h>
#include <base/parameter_file.h>
#include <output/run_summary.h>

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <limits>

#include <unistd.h>

namespace Ricochet
{
  namespace
  {
    constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

    std::string
    hexadecimal(const std::uint32_t number)
    {
      char text[16];
      std::snprintf(text, sizeof(text), "%08x", number);
      return text;
    }

    /// Now, in the form of ISO 8601.
    std::string
    now()
    {
      const std::time_t time = std::time(nullptr);
      std::tm           parts{};
      char              text[32];
      ::gmtime_r(&time, &parts);
      std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", &parts);
      return text;
    }

    /// Name of this machine.
    std::string
    host()
    {
      char name[256] = "";
      ::gethostname(name, sizeof(name) - 1);
      return name;
    }
  } // namespace



  double
  RunSummary::first(const std::string &name) const
  {
    return ledger.value(ledger.rows().front(), name);
  }



  double
  RunSummary::last(const std::string &name) const
  {
    return ledger.value(ledger.rows().back(), name);
  }



  RunSummary::At
  RunSummary::largest(const unsigned int number, const double sign) const
  {
    const unsigned int time = ledger.column_number("time");
    At                 result{nothing, nothing};
    for (const auto &row : ledger.rows())
      if (std::isfinite(row[number]) &&
          !(sign * row[number] <= sign * result.value))
        result = {row[number], row[time]};
    return result;
  }



  double
  RunSummary::largest_of_means(const unsigned int number) const
  {
    const auto &rows   = ledger.rows();
    double      result = nothing;
    for (std::size_t end = n_of_mean; end <= rows.size(); ++end)
      {
        double sum = 0.;
        for (std::size_t k = end - n_of_mean; k < end; ++k)
          sum += rows[k][number];
        if (std::isfinite(sum) && !(sum / n_of_mean <= result))
          result = sum / n_of_mean;
      }
    return result;
  }



  double
  RunSummary::restitution(const Rebound     &rebound,
                          const unsigned int row_before,
                          const unsigned int row_after) const
  {
    double     scale    = 0.;
    const auto velocity = [&](const unsigned int row) {
      dealii::Tensor<1, 3> result;
      for (unsigned int b = 0; b < rebound.bodies.size(); ++b)
        {
          dealii::Tensor<1, 3> own;
          for (unsigned int c = 0; c < 3; ++c)
            own[c] = ledger.value(ledger.rows()[row],
                                  std::string("momentum_") + "xyz"[c] +
                                    rebound.bodies[b].suffix) /
              rebound.bodies[b].mass;
          result += (b == 0 ? 1. : -1.) * own;
          scale = std::max(scale, own.norm());
        }
      return result;
    };
    const auto   before = velocity(row_before), after = velocity(row_after);
    const auto   change = after - before;
    const double coming = -(before * change);
    // Bodies with the same velocity do not come, except for round-off.
    const double round_off = 1e-10 * scale * change.norm();
    return coming > round_off ? (after * change) / coming : nothing;
  }



  RunSummary::OfContact
  RunSummary::of_contact(const std::string &name) const
  {
    const unsigned int time  = ledger.column_number("time"),
                       force = ledger.column_number("contact_force_" + name);
    const unsigned int depth = ledger.column_number("penetration_" + name);
    OfContact          result{largest(force),
                     largest(depth),
                     largest_of_means(force),
                     largest_of_means(depth),
                     nothing,
                     nothing,
                     0.,
                     0.,
                     nothing,
                     {}};
    double             before    = nothing;
    unsigned int       first_row = 0, last_row = 0;
    for (unsigned int k = 0; k < ledger.rows().size(); ++k)
      {
        const auto &row = ledger.rows()[k];
        if (!std::isnan(before) && std::isfinite(row[force]))
          result.impulse_of_force += row[force] * (row[time] - before);
        if (row[force] > 0.)
          {
            if (std::isnan(result.first_touch))
              {
                result.first_touch = row[time];
                first_row          = k;
              }
            result.last_touch = row[time];
            last_row          = k;
            if (!std::isnan(before))
              result.touching += row[time] - before;
          }
        before = row[time];
      }
    for (const char *component : {"x", "y", "z"})
      if (const auto column = std::string("impulse_") + component + "_" + name;
          ledger.find_column(column))
        result.impulse.push_back(last(column));
    for (const Rebound &rebound : rebounds)
      if (rebound.contact == name && first_row > 0 &&
          last_row + 1 < ledger.rows().size())
        result.restitution = restitution(rebound, first_row - 1, last_row + 1);
    return result;
  }



  double
  RunSummary::lost_in_contact() const
  {
    // A method without a potential stores nothing that it could give back.
    const auto stored = [](const double modified, const double energy) {
      return std::isfinite(modified) ? modified - energy : 0.;
    };
    return last("contact_work") + last("obstacle_work") -
      (stored(last("modified_energy"), last("energy")) -
       stored(first("modified_energy"), first("energy")));
  }



  std::vector<std::string>
  RunSummary::lines() const
  {
    // Less than the checks can see is round-off.
    double scale = 0.;
    for (const double value : {largest(ledger.column_number("energy")).value,
                               last("contact_work"),
                               last("friction_work"),
                               last("external_work")})
      scale = std::max(scale, std::abs(value));
    const auto energy = [&](const double value) {
      return units.text(std::abs(value) < EnergyCheck::bound * scale ? 0.
                                                                     : value,
                        "J");
    };
    std::vector<std::string> lines;
    std::string              lost;
    for (const auto &[name, value] :
         {std::pair<std::string, double>{"contact", lost_in_contact()},
          {"friction", last("friction_work")},
          {"viscosity", last("viscous_dissipation")},
          {"the time scheme", last("numerical_dissipation")}})
      lost += (lost.empty() ? "" : ", ") + name + " " + energy(value);
    lines.push_back("energy " + energy(first("energy")) + " -> " +
                    energy(last("energy")) + "; lost to " + lost);
    for (const std::string &name : contacts)
      {
        const OfContact contact = of_contact(name);
        if (std::isnan(contact.first_touch))
          continue;
        lines.push_back("contact " + name + ": largest force " +
                        units.text(contact.force.value, "N") +
                        " at t = " + units.text(contact.force.time, "s") +
                        ", touches for " + units.text(contact.touching, "s") +
                        " from t = " + units.text(contact.first_touch, "s") +
                        " to " + units.text(contact.last_touch, "s") +
                        ", deepest penetration " +
                        units.text(contact.depth.value, "m") +
                        (std::isnan(contact.restitution)
                           ? ""
                           : ", restitution " + to_text(contact.restitution)));
      }
    return lines;
  }



  std::vector<RunResult>
  RunSummary::results(const Circumstances &circumstances) const
  {
    std::vector<RunResult> list;
    // Energies are exact to this.
    const double energy_scale =
      EnergyCheck::bound * largest(ledger.column_number("energy")).value;
    const auto energy = [&](const std::string &name, const double value) {
      list.push_back(
        {"energy." + name, units.name("J"), value, nothing, energy_scale});
    };
    energy("at_end.kinetic", last("kinetic_energy"));
    energy("at_end.elastic", last("elastic_energy"));
    energy("at_end.all", last("energy"));
    energy("work_from_outside.loads", last("external_work"));
    energy("work_from_outside.imposed_displacements", last("imposed_work"));
    energy("work_from_outside.obstacles", last("obstacle_work"));
    energy("lost.contact", lost_in_contact());
    energy("lost.friction", last("friction_work"));
    energy("lost.viscosity", last("viscous_dissipation"));
    energy("lost.time_scheme", last("numerical_dissipation"));
    for (const std::string &name : contacts)
      {
        const OfContact   contact = of_contact(name);
        const std::string begin   = "contacts." + name + ".";
        list.push_back({begin + "largest_force",
                        units.name("N"),
                        contact.force.value,
                        contact.force_of_means});
        list.push_back({begin + "deepest_penetration",
                        units.name("m"),
                        contact.depth.value,
                        contact.depth_of_means});
        list.push_back({begin + "impulse_of_force",
                        units.name("N s"),
                        contact.impulse_of_force});
        list.push_back({begin + "restitution", "1", contact.restitution});
        for (const auto &[what, value] :
             {std::pair<std::string, double>{"first_touch",
                                             contact.first_touch},
              {"last_touch", contact.last_touch},
              {"time_in_touch", contact.touching}})
          list.push_back({begin + what,
                          units.name("s"),
                          value,
                          nothing,
                          circumstances.time_step});
      }
    if (circumstances.may_end_earlier)
      list.push_back({"steps.end",
                      units.name("s"),
                      last("time"),
                      nothing,
                      circumstances.time_step});
    // A number that does not exist needs no bar.
    list.erase(std::remove_if(list.begin(),
                              list.end(),
                              [](const RunResult &result) {
                                return std::isnan(result.value);
                              }),
               list.end());
    return list;
  }



  std::string
  RunSummary::json(const Circumstances &circumstances,
                   const RunFolder     &folder) const
  {
    JsonWriter                json;
    const RunFolder::Options &options = folder.options;
    json.add("format", 1U);
    json.add("program", options.program);
    json.add("version", options.version);
    json.add("commit", commit());
    json.add("command_line", options.command_line);
    json.begin_object("input");
    json.add("parameter_file", options.parameter_file);
    json.add("checksum_of_parameters",
             hexadecimal(checksum(folder.all_parameters)));
    json.add("checksum_of_mesh", circumstances.mesh_checksum);
    json.add("checksum_of_program", checksum_of_library());
    json.end_object();

    json.begin_object("run");
    json.add("state", circumstances.state);
    if (!circumstances.reason.empty())
      json.add("reason", circumstances.reason);
    json.add("finished", now());
    json.add("wall_seconds", circumstances.wall_seconds);
    json.add("processor_seconds", circumstances.processor_seconds);
    json.add("host", host());
    json.add("ranks", circumstances.n_ranks);
    json.add("linear_solver", circumstances.linear_solver);
    json.end_object();

    const auto &rows = ledger.rows();
    json.begin_object("steps");
    json.add("number", static_cast<unsigned int>(rows.size() - 1));
    json.add("length", circumstances.time_step);
    json.add("begin", first("time"));
    json.add("end", last("time"));
    json.add("asked_end", circumstances.final_time);
    json.add("unit", units.name("s"));
    json.add("halvings", last("step_halvings"));
    json.add("passing_halvings", last("passing_halvings"));
    const unsigned int newton = ledger.column_number("newton_iterations");
    double             sum    = 0.;
    for (unsigned int k = 1; k < rows.size(); ++k)
      sum += rows[k][newton];
    json.add("newton_iterations_in_the_mean",
             rows.size() > 1 ? sum / (rows.size() - 1) : nothing);
    json.add("newton_iterations_at_most", largest(newton).value);
    json.add("solved_by", circumstances.solved_by);
    json.end_object();

    json.begin_object("energy");
    json.add("unit", units.name("J"));
    for (const auto &[when, row] :
         {std::pair<std::string,
                    double (RunSummary::*)(const std::string &) const>{
            "at_start",
            &RunSummary::first},
          {"at_end", &RunSummary::last}})
      {
        json.begin_object(when);
        json.add("kinetic", (this->*row)("kinetic_energy"));
        json.add("elastic", (this->*row)("elastic_energy"));
        json.add("all", (this->*row)("energy"));
        json.end_object();
      }
    json.begin_object("work_from_outside");
    json.add("loads", last("external_work"));
    json.add("imposed_displacements", last("imposed_work"));
    json.add("obstacles", last("obstacle_work"));
    json.end_object();
    json.begin_object("lost");
    json.add("contact", lost_in_contact());
    json.add("friction", last("friction_work"));
    json.add("viscosity", last("viscous_dissipation"));
    json.add("time_scheme", last("numerical_dissipation"));
    json.end_object();
    json.end_object();

    const EnergyCheck::Result result = check.result();
    json.begin_object("checks");
    json.add("bound", EnergyCheck::bound);
    json.begin_object("balance");
    json.add("largest", result.balance);
    json.add("closes", result.balance_closes);
    json.end_object();
    json.begin_object("total_energy");
    json.add("promise", result.promise);
    json.add("largest_deviation", result.deviation);
    if (result.is_promised)
      json.add("kept", !result.is_broken);
    json.end_object();
    json.end_object();

    json.begin_object("contacts");
    for (const std::string &name : contacts)
      {
        const OfContact contact = of_contact(name);
        json.begin_object(name);
        const auto add =
          [&](const std::string &what, const At &at, const std::string &unit) {
            json.begin_object(what);
            json.add("value", at.value);
            json.add("unit", units.name(unit));
            json.add("time", at.time);
            json.end_object();
          };
        add("largest_force", contact.force, "N");
        add("deepest_penetration", contact.depth, "m");
        json.add("first_touch", contact.first_touch);
        json.add("last_touch", contact.last_touch);
        json.add("time_in_touch", contact.touching);
        json.add("impulse_of_force", contact.impulse_of_force);
        json.add("restitution", contact.restitution);
        if (!contact.impulse.empty())
          {
            json.begin_object("impulse");
            for (unsigned int c = 0; c < contact.impulse.size(); ++c)
              json.add(std::string(1, "xyz"[c]), contact.impulse[c]);
            json.add("unit", units.name("N s"));
            json.end_object();
          }
        for (const std::string what : {"contact_gain",
                                       "passed_points",
                                       "dropped_points",
                                       "entered_points"})
          if (ledger.find_column(what + "_" + name))
            json.add(what, last(what + "_" + name));
        json.end_object();
      }
    json.end_object();

    json.begin_object("largest_of_written_fields");
    for (const FieldExtreme &extreme : field_extremes)
      {
        json.begin_object(extreme.name);
        json.add("value", extreme.value);
        json.add("unit", units.name(extreme.unit));
        json.add("time", extreme.time);
        json.add("place", extreme.place);
        json.end_object();
      }
    json.end_object();

    json.begin_object("columns");
    for (unsigned int k = 0; k < ledger.columns().size(); ++k)
      {
        const EnergyLedger::Column &column = ledger.columns()[k];
        json.begin_object(column.name);
        json.add("unit", column.unit);
        json.add("first", rows.front()[k]);
        json.add("last", rows.back()[k]);
        for (const auto &[what, sign] :
             {std::pair<std::string, double>{"least", -1.}, {"largest", 1.}})
          {
            const At at = largest(k, sign);
            json.begin_object(what);
            json.add("value", at.value);
            json.add("time", at.time);
            json.end_object();
          }
        json.end_object();
      }
    json.end_object();
    return json.finished();
  }
} // namespace Ricochet
