// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/files.h>
#include <base/parameter_file.h>
#include <base/unknown_name.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdio>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <sstream>

namespace Ricochet
{
  namespace
  {
    using dealii::Utilities::trim;
    using Path = std::vector<std::string>;

    /// The declared parameters: the full name "Section/Name" of each parameter
    /// and the pattern that its value must match.
    struct Declaration
    {
      Path                                           path;
      std::unique_ptr<dealii::Patterns::PatternBase> pattern;
      std::string                                    value;
      std::string                                    documentation;
      std::string                                    pattern_text;
    };
    using Declarations = std::map<std::string, Declaration>;

    std::string
    join(const Path &path)
    {
      std::string text;
      for (const std::string &part : path)
        text += (text.empty() ? "" : "/") + part;
      return text;
    }

    /// ParameterHandler escapes blanks and special characters in its XML names
    /// as "_20" and the like.
    std::string
    unescape(const std::string &key)
    {
      std::string text;
      for (std::size_t i = 0; i < key.size(); ++i)
        if (key[i] == '_' && i + 2 < key.size())
          {
            text += static_cast<char>(std::stoi(key.substr(i + 1, 2), 0, 16));
            i += 2;
          }
        else
          text += key[i];
      return text;
    }

    void
    collect(const boost::property_tree::ptree &tree,
            const Path                        &path,
            Declarations                      &declarations)
    {
      for (const auto &[key, child] : tree)
        {
          Path name = path;
          name.push_back(unescape(key));
          if (child.find("value") != child.not_found())
            declarations[join(name)] =
              Declaration{name,
                          dealii::Patterns::pattern_factory(
                            child.get<std::string>("pattern_description")),
                          child.get<std::string>("value"),
                          child.get<std::string>("documentation", ""),
                          child.get<std::string>("pattern_description")};
          else
            collect(child, name, declarations);
        }
    }

    /// ParameterHandler has no way to ask what is declared but its own output.
    Declarations
    declarations_of(const dealii::ParameterHandler &parameters)
    {
      // In its JSON a dot in a name is taken for the end of a section.
      std::ostringstream xml;
      parameters.print_parameters(xml, dealii::ParameterHandler::XML);
      std::istringstream          in(xml.str());
      boost::property_tree::ptree tree;
      boost::property_tree::read_xml(in, tree);
      Declarations declarations;
      collect(tree.get_child("ParameterHandler"), {}, declarations);
      return declarations;
    }

    bool
    is_input_file(const Declaration &declaration)
    {
      const auto *file = dynamic_cast<const dealii::Patterns::FileName *>(
        declaration.pattern.get());
      return file && file->file_type == dealii::Patterns::FileName::input;
    }

    /// The beginning of a text that may be anything.
    std::string
    shortened(const std::string &text)
    {
      constexpr unsigned int length = 120;
      std::string            printable;
      for (const char c : text.substr(0, length))
        printable += static_cast<unsigned char>(c) < 32 ? '?' : c;
      return text.size() > length ? printable + "..." : printable;
    }

    /// The values that a pattern allows, without words and numbers of compilers.
    std::string
    allowed_values(const dealii::Patterns::PatternBase &pattern)
    {
      static const std::vector<std::pair<std::regex, std::string>> words = {
        {std::regex("A floating point number v such that -MAX_DOUBLE <= v <= "
                    "MAX_DOUBLE"),
         "A number"},
        {std::regex(
           "A floating point number v such that 1e-30 <= v <= MAX_DOUBLE"),
         "A number above 0"},
        {std::regex(
           "A floating point number v such that (\\S+) <= v <= MAX_DOUBLE"),
         "A number, at least $1"},
        {std::regex("A floating point number v such that (\\S+) <= v <= "
                    "([^\\s\\]]+)"),
         "A number from $1 to $2"},
        {std::regex("An integer n such that -2147483648 <= n <= 2147483647"),
         "A whole number"},
        {std::regex("An integer n such that (\\S+) <= n <= 2147483647"),
         "A whole number, at least $1"},
        {std::regex("An integer n such that (\\S+) <= n <= ([^\\s\\]]+)"),
         "A whole number from $1 to $2"},
        {std::regex("A list of ([0-9]+) to \\1 elements where each element is "
                    "\\[A(.*)\\]"),
         "$1 values, each a$2"},
        {std::regex("A list of 0 to 4294967295 elements where each element is "
                    "\\[A(.*)\\]"),
         "Any number of values, each a$1"},
        {std::regex(
           "A list of ([0-9]+) to 4294967295 elements where each element is "
           "\\[A(.*)\\]"),
         "At least $1 values, each a$2"},
        {std::regex(
           "A list of ([0-9]+) to ([0-9]+) elements where each element is "
           "\\[A(.*)\\]"),
         "$1 to $2 values, each a$3"}};
      std::string text =
        pattern.description(dealii::Patterns::PatternBase::OutputStyle::Text);
      for (const auto &[expression, ours] : words)
        text = std::regex_replace(text, expression, ours);
      return text;
    }

    /// The beginning of a @p line, up to a '#'. @throws InputError where that may be part
    /// of a word.
    std::string
    without_comment(const std::string &line, const std::string &where)
    {
      const std::size_t begin = line.find('#');
      if (begin != std::string::npos && begin > 0 &&
          std::isspace(static_cast<unsigned char>(line[begin - 1])) == 0)
        throw InputError(
          where +
          ": a '#' begins a comment, and has a space before it; what is "
          "named with one cannot be given here.");
      return line.substr(0, begin);
    }

    Setting
    assign(const ParameterText::Assignment &assignment,
           const Declarations              &declarations,
           dealii::ParameterHandler        &parameters)
    {
      const Path        &path        = assignment.path;
      const std::string &given_value = assignment.value;
      const std::string &where       = assignment.where;
      const std::string &folder      = assignment.folder;
      const auto         entry       = declarations.find(join(path));
      if (entry == declarations.end())
        {
          // Compare whole names as well as last parts: a user mistypes the
          // name, or puts the right name in the wrong section.
          std::vector<std::string> full_names;
          std::vector<std::string> same_last_part;
          for (const auto &[name, declaration] : declarations)
            {
              full_names.push_back(name);
              if (declaration.path.back() == path.back())
                same_last_part.push_back(name);
            }
          std::vector<std::string> suggestions = same_last_part.empty()
            ? nearest_names(join(path), full_names, 3)
            : same_last_part;
          std::string              message =
            where + ": there is no parameter '" + shortened(join(path)) + "'.";
          if (!suggestions.empty())
            {
              message += "\nThe nearest valid names are:";
              for (const std::string &name : suggestions)
                message += "\n  " + name;
            }
          message += "\nAll of them: run the program with --print-parameters.";
          throw InputError(message,
                           {"unknown_parameter", join(path), suggestions});
        }

      const Declaration &declaration = entry->second;
      if (path == Path{"Program"} && given_value != declaration.value)
        throw InputError(where + ": this file is for the program '" +
                           shortened(given_value) + "', not for '" +
                           declaration.value + "'.",
                         {"wrong_program", "Program", {given_value}});

      std::string value = given_value;
      if (is_input_file(declaration) && !value.empty())
        value =
          (std::filesystem::absolute(folder.empty() ? "." : folder) / value)
            .lexically_normal()
            .string();

      if (!declaration.pattern->match(value))
        throw InputError(where + ": the value '" + shortened(value) + "' of '" +
                           join(path) + "' is not allowed.\nAllowed: " +
                           allowed_values(*declaration.pattern),
                         {"value_not_allowed", join(path)});

      for (unsigned int i = 0; i + 1 < path.size(); ++i)
        parameters.enter_subsection(path[i]);
      parameters.set(path.back(), value);
      for (unsigned int i = 0; i + 1 < path.size(); ++i)
        parameters.leave_subsection();
      return {join(path),
              value,
              where,
              assignment.on_command_line,
              value != declaration.value};
    }

    /// State while a file and those that it includes are read.
    struct Reading
    {
      // A bound far beyond any use: files that include each other twice each
      // would never end.
      static constexpr std::size_t max_depth = 100, max_files = 1000,
                                   max_bytes = 1 << 24;

      std::vector<std::string> open_files;
      std::size_t              n_files = 0, n_bytes = 0;
      ParameterText            text;
    };

    /// @throws InputError where a name has the sign that is between names in messages
    /// and on the command line.
    void
    check_name(const std::string &name, const std::string &where)
    {
      const std::size_t slash = name.find('/');
      if (slash != std::string::npos)
        throw InputError(where + ": the name '" + shortened(name) +
                         "' has a '/'. What is in a section is set between "
                         "'subsection " +
                         shortened(name.substr(0, slash)) + "' and 'end'.");
    }

    void
    read(const std::string &file_name,
         const std::string &included_from,
         Reading           &reading)
    {
      namespace fs = std::filesystem;
      const std::string origin =
        included_from.empty() ? "" : included_from + ": ";
      const auto refuse = [&](const std::string &why) {
        throw InputError(origin + "the parameter file '" +
                           shortened(file_name) + "' " + why + ".",
                         {"unreadable_file"});
      };
      std::error_code error;
      if (!fs::exists(file_name, error))
        refuse("does not exist");
      if (fs::is_directory(file_name, error))
        refuse("cannot be read: it is a folder");
      const std::string canonical = fs::canonical(file_name, error).string();
      if (std::find(reading.open_files.begin(),
                    reading.open_files.end(),
                    canonical) != reading.open_files.end())
        refuse("includes itself");
      reading.open_files.push_back(canonical);
      if (reading.open_files.size() > Reading::max_depth)
        refuse("is included by more than " +
               std::to_string(Reading::max_depth) + " files in each other");
      if (++reading.n_files > Reading::max_files)
        refuse("is one of more than " + std::to_string(Reading::max_files) +
               " that are included");
      std::string text;
      try
        {
          text = read_file(file_name, Reading::max_bytes - reading.n_bytes);
          reading.n_bytes += text.size();
        }
      catch (const InputError &problem)
        {
          throw InputError(origin + "the parameter file " + problem.what(),
                           {"unreadable_file"});
        }
      // Some editors begin a file with a mark of its encoding.
      if (text.compare(0, 3, "\xEF\xBB\xBF") == 0)
        text.erase(0, 3);

      const std::string  folder = fs::path(file_name).parent_path().string();
      std::istringstream in(text);
      Path               section;
      std::string        line;
      unsigned int       line_number = 0;
      while (std::getline(in, line))
        {
          ++line_number;
          const std::string where =
            file_name + ", line " + std::to_string(line_number);
          line = trim(without_comment(line, where));
          while (!line.empty() && line.back() == '\\')
            {
              line.pop_back();
              std::string next;
              if (!std::getline(in, next))
                break;
              ++line_number;
              line += trim(without_comment(next, where));
            }
          if (line.empty())
            continue;

          const std::string keyword = line.substr(0, line.find_first_of(" \t"));
          const std::string rest    = trim(line.substr(keyword.size()));
          constexpr std::size_t max_name = 200;
          if (keyword == "subsection" && rest.size() > max_name)
            throw InputError(where + ": the name of the section has " +
                               std::to_string(rest.size()) +
                               " characters; there may be " +
                               std::to_string(max_name) + ".",
                             {"syntax"});
          if (keyword == "subsection" && !rest.empty())
            {
              section.push_back(rest);
              if (section.size() > 10)
                throw InputError(where +
                                 ": more than ten subsections in each other.");
              reading.text.sections.push_back({section, where});
            }
          else if (line == "end")
            {
              if (section.empty())
                throw InputError(where + ": this 'end' closes no subsection.",
                                 {"syntax"});
              section.pop_back();
            }
          else if (keyword == "include" && !rest.empty())
            {
              if (!section.empty())
                throw InputError(where +
                                 ": 'include' must stand outside of all "
                                 "subsections.");
              read((fs::path(folder) / rest).string(), where, reading);
            }
          else if (keyword == "set" && rest.find('=') != std::string::npos)
            {
              const std::size_t equal = rest.find('=');
              Path              path  = section;
              path.push_back(trim(rest.substr(0, equal)));
              check_name(path.back(), where);
              reading.text.assignments.push_back(
                {path, trim(rest.substr(equal + 1)), where, folder});
            }
          else
            throw InputError(
              where + ": cannot make sense of '" + shortened(line) +
                "'.\nA line is 'subsection NAME', 'set NAME = "
                "VALUE', 'end', 'include FILE' or a comment that "
                "starts with '#'.",
              {"syntax"});
        }
      if (!section.empty())
        {
          // The last of several sections with this name is open.
          const auto opened =
            std::find_if(reading.text.sections.rbegin(),
                         reading.text.sections.rend(),
                         [&](const auto &one) { return one.path == section; });
          throw InputError(opened->where + ": the subsection '" +
                             shortened(join(section)) +
                             "' is never closed with 'end'.",
                           {"syntax"});
        }
      reading.open_files.pop_back();
    }
  } // namespace



  std::string
  to_text(const double number)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.10g", number);
    return text;
  }



  std::string
  exact_text(const double number)
  {
    char text[32];
    return {text, std::to_chars(text, text + sizeof(text), number).ptr};
  }



  std::vector<ParameterValue>
  list_parameters(const dealii::ParameterHandler &parameters)
  {
    std::vector<ParameterValue> list;
    for (const auto &[name, declaration] : declarations_of(parameters))
      {
        list.push_back({name, declaration.value, is_input_file(declaration)});
        list.back().path          = declaration.path;
        list.back().documentation = declaration.documentation;
        list.back().pattern       = declaration.pattern_text;
        if (!dynamic_cast<const dealii::Patterns::Anything *>(
              declaration.pattern.get()))
          list.back().allowed = allowed_values(*declaration.pattern);
      }
    return list;
  }



  const ParameterText::Assignment *
  ParameterText::find(const std::string &name) const
  {
    const Assignment *last = nullptr;
    for (const Assignment &assignment : assignments)
      if (assignment.path == Path{name})
        last = &assignment;
    return last;
  }



  ParameterText
  parse_parameter_file(const std::string &file_name)
  {
    Reading reading;
    read(file_name, "", reading);
    return reading.text;
  }



  ParameterText::Assignment
  parse_assignment(const std::string &assignment)
  {
    const std::string where = "--set \"" + shortened(assignment) + "\"";
    const std::size_t equal = assignment.find('=');
    const auto        fail  = [&](const std::string &why) {
      throw InputError(where + ": " + why +
                       " Expected the form --set \"Section/Name=value\".");
    };
    if (equal == std::string::npos)
      fail("there is no '='.");
    Path path;
    for (std::size_t begin = 0; begin <= equal;)
      {
        const std::size_t end = std::min(assignment.find('/', begin), equal);
        path.push_back(trim(assignment.substr(begin, end - begin)));
        begin = end + 1;
      }
    for (const std::string &part : path)
      if (part.empty())
        fail("a section or the name is empty.");
    return {path,
            trim(assignment.substr(equal + 1)),
            where,
            ".",
            /* on command line */ true};
  }



  std::vector<Setting>
  apply(const ParameterText &text, dealii::ParameterHandler &parameters)
  {
    const Declarations   declarations = declarations_of(parameters);
    std::vector<Setting> settings;
    for (const ParameterText::Assignment &assignment : text.assignments)
      settings.push_back(assign(assignment, declarations, parameters));
    return settings;
  }



  std::vector<Setting>
  read_parameter_file(const std::string        &file_name,
                      dealii::ParameterHandler &parameters)
  {
    return apply(parse_parameter_file(file_name), parameters);
  }



  Setting
  set_parameter(const std::string        &assignment,
                dealii::ParameterHandler &parameters)
  {
    return assign(parse_assignment(assignment),
                  declarations_of(parameters),
                  parameters);
  }
} // namespace Ricochet
