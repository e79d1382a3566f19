// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/files.h>
#include <base/program_input.h>

#include <sstream>

namespace Ricochet
{
  namespace
  {
    /// Refuse or note parameters without effect. @return the notes.
    std::vector<std::string>
    check_unused(const Program &program, const std::vector<Setting> &settings)
    {
      std::vector<std::string> notes;
      if (!program.unused_parameters)
        return notes;
      for (const UnusedParameter &unused : program.unused_parameters())
        {
          // The last setting is the one that counts.
          const Setting *last = nullptr;
          for (const Setting &setting : settings)
            if (setting.name == unused.name)
              last = &setting;
          if (!last || !last->changes_default)
            continue;
          const std::string text = "'" + unused.name + "' is set to '" +
            last->value + "' and has no effect: it belongs to " +
            unused.belongs_to + ".";
          if (last->on_command_line)
            throw InputError(last->where + ": " + text,
                             {"no_effect", unused.name});
          notes.push_back("note: " + last->where + ": " + text);
        }
      return notes;
    }
  } // namespace



  ProgramInput::ProgramInput(const Program &program, const ParameterText &text)
    : program_name(program.name)
  {
    parameters.add_parameter("Program",
                             program_name,
                             "The program that this file is for; others "
                             "refuse it.");
    parameters.enter_subsection("Output");
    parameters.add_parameter("Folder",
                             output_dir,
                             "Folder for all output of the run; empty for "
                             "output/PROGRAM/FILE, from the names of program "
                             "and parameter file. On the command line: "
                             "--output-dir.",
                             dealii::Patterns::DirectoryName());
    parameters.leave_subsection();
    if (program.prepare)
      program.prepare(text);
    program.add_parameters(parameters);
    settings = apply(text, parameters);
    std::ostringstream all;
    parameters.print_parameters(all, dealii::ParameterHandler::Text);
    all_parameters = all.str();
  }



  std::vector<std::string>
  ProgramInput::validate(const Program &program) const
  {
    program.validate();
    return check_unused(program, settings);
  }



  std::string
  ProgramInput::parameters_that_matter() const
  {
    std::string text;
    for (const ParameterValue &parameter : list_parameters(parameters))
      {
        const std::string &name        = parameter.name;
        const auto         begins_with = [&](const std::string &beginning) {
          return name.compare(0, beginning.size(), beginning) == 0;
        };
        if (begins_with("Output/") || begins_with("Newton/") ||
            begins_with("Linear solver/") || begins_with("Limits/") ||
            name == "Program" || name == "Time/Final time" ||
            name == "Time/Until" || name == "Time/Maximum halvings")
          continue;
        if (parameter.is_input_file && !parameter.value.empty())
          text += name + " = a file with the checksum " +
            std::to_string(checksum(read_file(parameter.value))) + "\n";
        else
          text += name + " = " + parameter.value + "\n";
      }
    return text;
  }
} // namespace Ricochet
