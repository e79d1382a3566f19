// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/command_line.h>
#include <base/exceptions.h>
#include <base/json_writer.h>
#include <base/parameter_schema.h>
#include <base/program_answers.h>
#include <base/unknown_name.h>

#include <algorithm>
#include <sstream>

namespace Ricochet
{
  namespace
  {
    /// Names of the sections of @p parameters, each once.
    std::vector<std::string>
    names_of_sections(const std::vector<ParameterValue> &parameters)
    {
      std::vector<std::string> names;
      for (const ParameterValue &parameter : parameters)
        if (parameter.path.size() > 1 &&
            (names.empty() || names.back() != parameter.path[0]))
          names.push_back(parameter.path[0]);
      return names;
    }



    /// Whether @p name is a section that @p wanted means: "Contact" means "Contact NAME", too.
    bool
    is_meant(const std::string &name, const std::string &wanted)
    {
      return wanted.empty() || name == wanted ||
        name.compare(0, wanted.size() + 1, wanted + " ") == 0;
    }



    /// The subsections of a parameter file @p text with @p name.
    std::string
    only_section(const std::string &text, const std::string &name)
    {
      std::istringstream lines(text);
      std::string        line, result;
      bool               is_inside = false;
      while (std::getline(lines, line))
        {
          const std::string begin = "subsection ";
          if (line.compare(0, begin.size(), begin) == 0)
            is_inside = is_meant(line.substr(begin.size()), name);
          if (is_inside)
            result += line + "\n";
          if (is_inside && line == "end")
            result += "\n";
          is_inside = is_inside && line != "end";
        }
      return result;
    }
  } // namespace



  std::string
  table_of_parameters(const ProgramInput &input, const std::string &section)
  {
    const auto parameters = list_parameters(input.parameters);
    const auto names      = names_of_sections(parameters);
    if (std::none_of(names.begin(), names.end(), [&](const auto &name) {
          return is_meant(name, section);
        }))
      throw unknown_name("There is no section '" + section + "'",
                         section,
                         names,
                         "",
                         "unknown_section");
    std::string allowed;
    for (const ParameterValue &parameter : parameters)
      if (!parameter.allowed.empty() && is_meant(parameter.path[0], section))
        allowed += "#   " + parameter.name + ": " + parameter.allowed + "\n";
    return (section.empty() ? input.all_parameters + "\n"
                            : only_section(input.all_parameters, section)) +
      "# What is allowed:\n" + allowed;
  }



  std::string
  list_of_parameters(const ProgramInput &input)
  {
    std::string lines;
    for (const ParameterValue &parameter : list_parameters(input.parameters))
      lines += parameter.name + " = " + parameter.value +
        (parameter.allowed.empty() ? "" : "  (" + parameter.allowed + ")") +
        "\n";
    return lines;
  }



  std::string
  completion(const Program &program, const std::string &shell)
  {
    const auto parameters =
      list_parameters(ProgramInput(program, ParameterText()).parameters);
    std::vector<std::string> names;
    for (const ParameterValue &parameter : parameters)
      names.push_back(parameter.name);
    return completion_script(program,
                             shell,
                             names,
                             names_of_sections(parameters));
  }



  std::string
  schema_of_parameters(const Program &program, const ParameterText &text)
  {
    const auto in_dimension = [&](const std::string &dimension) {
      ParameterText own = text;
      own.assignments.push_back({{"Dimension"}, dimension, "", "."});
      return ProgramInput(program, own);
    };
    JsonWriter json;
    json.add("$schema", "https://json-schema.org/draft/2020-12/schema");
    json.add("title", "parameters of " + program.name);
    const ProgramInput any(program, text);
    const auto         all = list_parameters(any.parameters);
    if (std::none_of(all.begin(), all.end(), [](const ParameterValue &one) {
          return one.name == "Dimension";
        }))
      {
        add_schema(any.parameters, json);
        return json.finished();
      }
    json.begin_object("if");
    json.begin_object("properties");
    json.begin_object("Dimension");
    json.add("const", "3");
    json.end_object();
    json.end_object();
    json.add("required", std::vector<std::string>{"Dimension"});
    json.end_object();
    for (const auto &[name, dimension] :
         {std::pair<std::string, std::string>{"then", "3"}, {"else", "2"}})
      {
        json.begin_object(name);
        add_schema(in_dimension(dimension).parameters, json);
        json.end_object();
      }
    return json.finished();
  }



  std::string
  description(const Program                  &program,
              const std::vector<std::string> &notes,
              const std::string              &output_dir)
  {
    std::string lines;
    if (program.description_of_input)
      try
        {
          lines += program.description_of_input(output_dir);
        }
      catch (const ComputationError &error)
        {
          // Exceptions here mean a load that is not finite at the start,
          // or a folder that cannot be written to; no other computation
          // has begun.
          throw InputError(error.what());
        }
    for (const std::string &note : notes)
      lines += note + "\n";
    return lines;
  }
} // namespace Ricochet
