// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/json_writer.h>
#include <base/parameter_file.h>
#include <base/parameter_schema.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>

#include <cstdlib>
#include <limits>
#include <regex>

namespace Ricochet
{
  namespace
  {
    using dealii::Utilities::split_string_list;

    /// The unit in parentheses in a documentation, such as "m/s^2"; empty without.
    std::string
    unit_in(const std::string &documentation)
    {
      const std::string unit =
        "(?:Pa|kg|rad|GB|min|m|s|N|J)"
        "(?:\\^(?:[0-9a-z]+|\\([^()]*\\)))?";
      static const std::regex in_parentheses(
        "\\(((?:1/)?" + unit + "(?:[ /](?:" + unit + "|\\(" + unit +
        "(?: " + unit + ")*\\)))*)\\)");
      std::smatch match;
      return std::regex_search(documentation, match, in_parentheses)
        ? match[1].str()
        : "";
    }

    /// Bounds of a number as deal.II writes them, "0...MAX_DOUBLE (inclusive)".
    void
    add_bounds(const std::string &pattern, JsonWriter &json)
    {
      static const std::regex range("(\\S+)\\.\\.\\.(\\S+) \\(inclusive\\)");
      std::smatch             match;
      if (!std::regex_search(pattern, match, range))
        return;
      const auto is_number = [](const std::string &text) {
        return text.find("MAX") == std::string::npos && text != "-2147483648" &&
          text != "2147483647";
      };
      // Parameters that have to be positive are at least this.
      if (match[1] == "1e-30")
        json.add("exclusiveMinimum", 0.);
      else if (is_number(match[1]))
        json.add("minimum", std::strtod(match[1].str().c_str(), nullptr));
      if (is_number(match[2]))
        json.add("maximum", std::strtod(match[2].str().c_str(), nullptr));
    }

    /// The type of values of a @p pattern.
    void
    add_type(const std::string &pattern, JsonWriter &json)
    {
      if (boost::starts_with(pattern, "[Double") ||
          boost::starts_with(pattern, "[Integer"))
        {
          json.add("type",
                   boost::starts_with(pattern, "[Double") ? "number"
                                                          : "integer");
          add_bounds(pattern, json);
        }
      else if (boost::starts_with(pattern, "[Bool"))
        json.add("type", "boolean");
      else if (boost::starts_with(pattern, "[Selection"))
        {
          const std::string words = pattern.substr(11, pattern.rfind(']') - 11);
          json.add("enum", split_string_list(words, '|'));
        }
      else if (boost::starts_with(pattern, "[List"))
        {
          static const std::regex length("of length ([0-9]+)\\.\\.\\.([0-9]+)");
          std::smatch             match;
          json.add("type", "array");
          const std::size_t begin = pattern.find('<'),
                            end   = pattern.rfind("> of length");
          json.begin_object("items");
          add_type(pattern.substr(begin + 1, end - begin - 1), json);
          json.end_object();
          if (std::regex_search(pattern, match, length))
            {
              json.add("minItems",
                       static_cast<unsigned int>(std::stoul(match[1])));
              if (std::stoul(match[2]) <
                  std::numeric_limits<unsigned int>::max())
                json.add("maxItems",
                         static_cast<unsigned int>(std::stoul(match[2])));
            }
        }
      else
        {
          json.add("type", "string");
          if (boost::starts_with(pattern, "[FileName"))
            json.add("format", "file");
          else if (boost::starts_with(pattern, "[DirectoryName"))
            json.add("format", "folder");
        }
    }

    void
    add_default(const ParameterValue &parameter, JsonWriter &json)
    {
      const std::string &pattern = parameter.pattern, &value = parameter.value;
      if (boost::starts_with(pattern, "[Double") ||
          boost::starts_with(pattern, "[Integer"))
        json.add("default", std::strtod(value.c_str(), nullptr));
      else if (boost::starts_with(pattern, "[Bool"))
        json.add("default", value == "true");
      else if (boost::starts_with(pattern, "[List"))
        {
          std::vector<double> numbers;
          for (const std::string &number : split_string_list(value, ','))
            numbers.push_back(std::strtod(number.c_str(), nullptr));
          json.add("default", numbers);
        }
      else
        json.add("default", value);
    }
  } // namespace



  void
  add_schema(const dealii::ParameterHandler &parameters, JsonWriter &json)
  {
    const auto all = list_parameters(parameters);
    const auto add = [&](const ParameterValue &parameter) {
      json.begin_object(parameter.path.back());
      add_type(parameter.pattern, json);
      add_default(parameter, json);
      json.add("description", parameter.documentation);
      if (const std::string unit = unit_in(parameter.documentation);
          !unit.empty())
        json.add("unit", unit);
      json.end_object();
    };
    // Parameters of a section follow each other.
    const auto add_sections = [&](const bool with_names) {
      std::string open;
      for (const ParameterValue &parameter : all)
        {
          const std::string section =
            parameter.path.size() > 1 ? parameter.path[0] : "";
          static const std::string any_name = " NAME";
          const bool has_name = section.size() > any_name.size() &&
            section.substr(section.size() - any_name.size()) == any_name;
          if (section.empty() || has_name != with_names)
            continue;
          if (section != open)
            {
              if (!open.empty())
                {
                  json.end_object();
                  json.end_object();
                }
              open = section;
              json.begin_object(
                has_name ? "^" +
                    section.substr(0, section.size() - any_name.size()) + " .+$"
                         : section);
              json.add("type", "object");
              json.add("additionalProperties", false);
              json.begin_object("properties");
            }
          add(parameter);
        }
      if (!open.empty())
        {
          json.end_object();
          json.end_object();
        }
    };
    json.add("type", "object");
    json.add("additionalProperties", false);
    json.begin_object("properties");
    for (const ParameterValue &parameter : all)
      if (parameter.path.size() == 1)
        add(parameter);
    add_sections(false);
    json.end_object();
    json.begin_object("patternProperties");
    add_sections(true);
    json.end_object();
  }



  std::string
  refusal_as_json(const std::string         &sentence,
                  const InputError::Details &details,
                  const unsigned int         exit_code)
  {
    static const std::regex place(
      "^(?:Phase [^:\n]*: )?([^\n]*?), line ([0-9]+)\\b");
    std::smatch match;
    JsonWriter  json;
    json.add("code", details.code);
    json.add("exit", exit_code);
    if (std::regex_search(sentence, match, place))
      {
        json.add("file", match[1].str());
        json.add("line", static_cast<unsigned int>(std::stoul(match[2])));
      }
    else
      for (const char *const name : {"file", "line"})
        json.add_null(name);
    if (details.key.empty())
      json.add_null("key");
    else
      json.add("key", details.key);
    json.add("nearest", details.nearest);
    json.add("sentence", sentence);
    return json.finished();
  }
} // namespace Ricochet
