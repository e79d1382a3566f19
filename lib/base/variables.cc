// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/expressions.h>
#include <base/parameter_file.h>
#include <base/unknown_name.h>
#include <base/variables.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <set>
#include <vector>

namespace Ricochet
{
  namespace
  {
    using Assignment = ParameterText::Assignment;

    constexpr char section_name[] = "Variables";

    bool
    is_variable(const Assignment &assignment)
    {
      return assignment.path.size() == 2 && assignment.path[0] == section_name;
    }

    /// The variables of a text, each computed when it is first needed.
    class Variables
    {
    public:
      explicit Variables(const ParameterText &text)
      {
        for (const Assignment &assignment : text.assignments)
          if (is_variable(assignment))
            {
              const std::string &name = assignment.path[1];
              if (assignment.on_command_line && definitions.count(name) == 0)
                throw InputError(assignment.where +
                                 ": the file has no variable '" +
                                 name.substr(0, 100) + "'." + list());
              check_name(name, assignment.where);
              definitions[name] = &assignment;
            }
        for (const auto &definition : definitions)
          value(definition.first, definition.second->where);
      }

      /// The number that an expression stands for.
      double
      compute(const std::string &expression, const std::string &where)
      {
        std::map<std::string, double> numbers;
        for (const std::string &name : names_in(expression))
          if (name != "pi")
            numbers[name] = value(name, where);
        const double result =
          value_of(expression, numbers, where + ": the expression");
        if (!std::isfinite(result))
          throw InputError(where + ": the expression '" +
                           expression.substr(0, 100) + "' is not finite.");
        return result;
      }

    private:
      static void
      check_name(const std::string &name, const std::string &where)
      {
        const bool is_good = names_in(name) == std::vector<std::string>{name} &&
          std::isdigit(static_cast<unsigned char>(name[0])) == 0;
        // Names of positions and the time mean those in expressions.
        if (!is_good ||
            std::set<std::string>{"x", "y", "z", "t", "pi"}.count(name))
          throw InputError(
            where + ": '" + name.substr(0, 100) +
            "' cannot be the name of a variable: letters, digits and _, a "
            "letter first, and not x, y, z, t or pi.");
      }

      double
      value(const std::string &name, const std::string &where)
      {
        if (const auto found = values.find(name); found != values.end())
          return found->second;
        const auto definition = definitions.find(name);
        if (definition == definitions.end())
          throw unknown_name(where + ": there is no variable '" +
                               name.substr(0, 100) + "'",
                             name,
                             names(),
                             list());
        if (std::find(open.begin(), open.end(), name) != open.end())
          throw InputError(where + ": the variable '" + name +
                           "' needs itself.");
        open.push_back(name);
        if (open.size() > max_depth)
          throw InputError(where + ": more than " + std::to_string(max_depth) +
                           " variables need each other one after another.");
        const Assignment &own    = *definition->second;
        const double      result = compute(own.value, own.where);
        open.pop_back();
        return values[name] = result;
      }

      std::vector<std::string>
      names() const
      {
        std::vector<std::string> all;
        for (const auto &definition : definitions)
          all.push_back(definition.first);
        return all;
      }

      /// All variables, in a sentence.
      std::string
      list() const
      {
        return definitions.empty()
          ? ""
          : " There is: " + boost::algorithm::join(names(), ", ") + ".";
      }

      std::map<std::string, const Assignment *> definitions;
      std::map<std::string, double>             values;
      // A bound far beyond any use: each one needs a part of the stack.
      static constexpr std::size_t max_depth = 100;
      /// Names that are being computed, each of which needs the next one.
      std::vector<std::string> open;
    };
  } // namespace



  ParameterText
  with_variables(const ParameterText &text)
  {
    Variables     variables(text);
    ParameterText result;
    for (const ParameterText::Section &section : text.sections)
      if (section.path != std::vector<std::string>{section_name})
        result.sections.push_back(section);
    for (Assignment assignment : text.assignments)
      {
        if (is_variable(assignment))
          continue;
        std::string value;
        for (std::size_t at = 0; at < assignment.value.size();)
          {
            const std::size_t open = assignment.value.find_first_of("{}", at);
            value += assignment.value.substr(at, open - at);
            if (open == std::string::npos)
              break;
            const std::size_t close =
              assignment.value.find_first_of("{}", open + 1);
            if (assignment.value[open] == '}' || close == std::string::npos ||
                assignment.value[close] == '{')
              throw InputError(
                assignment.where +
                ": a brace is alone. In braces stands an expression of "
                "variables: {2*height}.");
            value += exact_text(variables.compute(
              assignment.value.substr(open + 1, close - open - 1),
              assignment.where));
            at = close + 1;
          }
        assignment.value = value;
        result.assignments.push_back(assignment);
      }
    return result;
  }
} // namespace Ricochet
