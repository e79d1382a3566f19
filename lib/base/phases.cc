// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/phases.h>
#include <base/unknown_name.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <filesystem>
#include <set>

namespace Ricochet
{
  namespace
  {
    using Path       = std::vector<std::string>;
    using Assignment = ParameterText::Assignment;

    bool
    is_of_phase(const Path &path)
    {
      return path.size() > 1 && boost::starts_with(path.front(), "Phase ");
    }

    /// Without the section of the phase.
    Assignment
    within_phase(Assignment assignment)
    {
      assignment.path.erase(assignment.path.begin());
      return assignment;
    }

    /// Whether it belongs to the start of the whole run.
    bool
    is_of_start(const Path &path)
    {
      return path == Path{"Start", "Advance"} ||
        (path.size() == 2 && boost::starts_with(path[0], "Body ") &&
         (path[1] == "Velocity" || path[1] == "Spin"));
    }

    /// The name in "Phase NAME". @throws InputError
    std::string
    name_in(const std::string &heading, const std::string &where)
    {
      const std::string name    = dealii::Utilities::trim(heading.substr(5));
      const bool        is_good = !name.empty() && name.size() <= 60 &&
        "Phase " + name == heading &&
        std::all_of(name.begin(), name.end(), [](const unsigned char c) {
          return std::isalnum(c) != 0 || c == ' ' || c == '_' || c == '-';
        });
      if (!is_good)
        throw InputError(where + ": '" + heading.substr(0, 100) +
                         "' should be 'Phase NAME', with a name of at most 60 "
                         "letters, digits, single blanks and _ -");
      return name;
    }

    /// The sections that a phase takes out of the file.
    std::set<std::string>
    sections_without(const std::vector<Assignment> &own,
                     const ParameterText           &text)
    {
      std::vector<std::string> known;
      for (const ParameterText::Section &one : text.sections)
        if (one.path.size() == 1 && !boost::starts_with(one.path[0], "Phase "))
          known.push_back(one.path[0]);
      std::set<std::string> out;
      for (const Assignment &assignment : own)
        if (assignment.path == Path{"Without"})
          {
            out.clear();
            for (const std::string &section :
                 dealii::Utilities::split_string_list(assignment.value, ';'))
              {
                if (std::find(known.begin(), known.end(), section) ==
                    known.end())
                  throw unknown_name(assignment.where +
                                       ": there is no section '" +
                                       section.substr(0, 100) +
                                       "' that this phase could be without",
                                     section,
                                     known,
                                     "",
                                     "unknown_section");
                out.insert(section);
              }
          }
      return out;
    }

    /// The settings of a phase. @param heading "Phase NAME".
    ParameterText
    text_of(const std::string   &heading,
            const bool           is_first,
            const ParameterText &text)
    {
      std::vector<Assignment> own;
      for (const Assignment &assignment : text.assignments)
        if (is_of_phase(assignment.path) && assignment.path[0] == heading)
          {
            own.push_back(within_phase(assignment));
            for (const Path &refused :
                 {Path{"Start", "From"}, Path{"Output", "Folder"}})
              if (own.back().path == refused)
                throw InputError(
                  assignment.where + ": " + refused[0] + "/" + refused[1] +
                  " cannot be set in a phase: it goes on from where the one before "
                  "it has ended, in a folder of its own within that of the run.");
          }
      const std::set<std::string> without = sections_without(own, text);
      const auto                  is_out  = [&](const Path &path) {
        return without.count(path[0]) > 0;
      };

      ParameterText result;
      // The command line counts more than the file.
      for (const bool on_command_line : {false, true})
        {
          for (const Assignment &assignment : text.assignments)
            if (assignment.on_command_line == on_command_line &&
                !is_of_phase(assignment.path) && !is_out(assignment.path) &&
                (is_first || !is_of_start(assignment.path)))
              result.assignments.push_back(assignment);
          for (const Assignment &assignment : own)
            if (assignment.on_command_line == on_command_line &&
                assignment.path != Path{"Without"})
              result.assignments.push_back(assignment);
        }
      std::set<Path> known;
      for (const bool is_own : {false, true})
        for (ParameterText::Section section : text.sections)
          {
            const bool is_here = section.path[0] == heading;
            if (is_own != is_here ||
                (!is_here && boost::starts_with(section.path[0], "Phase ")))
              continue;
            if (is_here)
              section.path.erase(section.path.begin());
            if (section.path.empty() || (!is_here && is_out(section.path)) ||
                (is_here && known.count(section.path) > 0))
              continue;
            known.insert(section.path);
            result.sections.push_back(section);
          }
      return result;
    }
  } // namespace



  std::vector<Phase>
  phases_of(const ParameterText &text)
  {
    std::vector<Phase>    phases;
    std::set<std::string> headings;
    for (const ParameterText::Section &section : text.sections)
      {
        const std::string &heading = section.path.front();
        if (section.path.size() > 1 ||
            (heading != "Phase" && !boost::starts_with(heading, "Phase ")))
          continue;
        Phase phase;
        phase.name = name_in(heading, section.where);
        if (!headings.insert(heading).second)
          throw InputError(section.where + ": '" + heading +
                           "' exists already. Give one of both another name, "
                           "or put them together.");
        std::string name = phase.name;
        std::replace(name.begin(), name.end(), ' ', '_');
        phase.folder = std::to_string(phases.size() + 1) + "_" + name;
        phase.text   = text_of(heading, phases.empty(), text);
        phases.push_back(phase);
      }
    for (const Assignment &assignment : text.assignments)
      if (is_of_phase(assignment.path) &&
          headings.count(assignment.path[0]) == 0)
        throw InputError(assignment.where + ": there is no section '" +
                         assignment.path[0].substr(0, 100) + "'.");
    if (phases.empty())
      phases.push_back({"", text, ""});
    return phases;
  }



  ParameterText
  text_of_phase(const std::vector<Phase> &phases,
                const unsigned int        k,
                const std::string        &output_dir)
  {
    ParameterText text = phases[k].text;
    if (phases.size() > 1)
      text.assignments.insert(text.assignments.begin(),
                              {{"Output", "Checkpoint every"},
                               "1000000000",
                               "Phase " + phases[k].name,
                               "."});
    if (k > 0)
      text.assignments.push_back(
        {{"Start", "From"},
         (std::filesystem::path(output_dir) / phases[k - 1].folder).string(),
         "Phase " + phases[k].name,
         "."});
    return text;
  }



  void
  in_phase(const std::string &name, const std::function<void()> &action)
  {
    if (name.empty())
      return action();
    try
      {
        action();
      }
    catch (const InputError &problem)
      {
        throw InputError("Phase " + name + ": " + problem.what(),
                         problem.details);
      }
  }
} // namespace Ricochet
