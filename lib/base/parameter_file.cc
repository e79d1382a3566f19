// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>

#include <deal.II/base/utilities.h>

#include <boost/property_tree/json_parser.hpp>
#include <boost/property_tree/ptree.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

namespace Ricochet
{
  namespace
  {
    using dealii::Utilities::trim;
    using Path = std::vector<std::string>;

    /// What is declared: the full name "Section/Name" of each parameter and
    /// the pattern that its value must match.
    struct Declaration
    {
      Path                                           path;
      std::unique_ptr<dealii::Patterns::PatternBase> pattern;
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

    /// ParameterHandler escapes blanks and special characters in its JSON keys
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
                            child.get<std::string>("pattern_description"))};
          else
            collect(child, name, declarations);
        }
    }

    /// ParameterHandler has no way to ask what is declared but its own output.
    Declarations
    declarations_of(const dealii::ParameterHandler &parameters)
    {
      std::ostringstream json;
      parameters.print_parameters(json, dealii::ParameterHandler::JSON);
      std::istringstream          in(json.str());
      boost::property_tree::ptree tree;
      boost::property_tree::read_json(in, tree);
      Declarations declarations;
      collect(tree, {}, declarations);
      return declarations;
    }

    unsigned int
    edit_distance(const std::string &a, const std::string &b)
    {
      const auto lower = [](const char c) {
        return std::tolower(static_cast<unsigned char>(c));
      };
      std::vector<unsigned int> row(b.size() + 1);
      for (unsigned int j = 0; j <= b.size(); ++j)
        row[j] = j;
      for (unsigned int i = 1; i <= a.size(); ++i)
        {
          unsigned int diagonal = row[0];
          row[0]                = i;
          for (unsigned int j = 1; j <= b.size(); ++j)
            {
              const unsigned int above = row[j];
              row[j] =
                std::min({above + 1,
                          row[j - 1] + 1,
                          diagonal + (lower(a[i - 1]) != lower(b[j - 1]))});
              diagonal = above;
            }
        }
      return row[b.size()];
    }

    void
    assign(const Path               &path,
           const std::string        &value,
           const std::string        &where,
           const Declarations       &declarations,
           dealii::ParameterHandler &parameters)
    {
      const auto entry = declarations.find(join(path));
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
            ? nearest_names(join(path), full_names)
            : same_last_part;
          std::string              message =
            where + ": there is no parameter '" + join(path) + "'.";
          if (!suggestions.empty())
            {
              message += "\nThe nearest valid names are:";
              for (const std::string &name : suggestions)
                message += "\n  " + name;
            }
          message += "\nAll of them: run the program with --print-parameters.";
          throw InputError(message);
        }

      if (!entry->second.pattern->match(value))
        throw InputError(where + ": the value '" + value + "' of '" +
                         join(path) + "' is not allowed.\nAllowed: " +
                         entry->second.pattern->description(
                           dealii::Patterns::PatternBase::OutputStyle::Text));

      for (unsigned int i = 0; i + 1 < path.size(); ++i)
        parameters.enter_subsection(path[i]);
      parameters.set(path.back(), value);
      for (unsigned int i = 0; i + 1 < path.size(); ++i)
        parameters.leave_subsection();
    }

    void
    read(const std::string        &file_name,
         const std::string        &included_from,
         std::vector<std::string> &open_files,
         const Declarations       &declarations,
         dealii::ParameterHandler &parameters)
    {
      namespace fs = std::filesystem;
      const std::string origin =
        included_from.empty() ? "" : included_from + ": ";
      std::error_code error;
      if (!fs::exists(file_name, error))
        throw InputError(origin + "the parameter file '" + file_name +
                         "' does not exist.");
      std::ifstream in(file_name);
      if (!in || fs::is_directory(file_name, error))
        throw InputError(origin + "the parameter file '" + file_name +
                         "' cannot be read.");
      const std::string canonical = fs::canonical(file_name).string();
      if (std::find(open_files.begin(), open_files.end(), canonical) !=
          open_files.end())
        throw InputError(origin + "the parameter file '" + file_name +
                         "' includes itself.");
      open_files.push_back(canonical);

      Path         section;
      std::string  line;
      unsigned int line_number = 0;
      while (std::getline(in, line))
        {
          ++line_number;
          const std::string where =
            file_name + ", line " + std::to_string(line_number);
          line = trim(line.substr(0, line.find('#')));
          while (!line.empty() && line.back() == '\\')
            {
              line.pop_back();
              std::string next;
              if (!std::getline(in, next))
                break;
              ++line_number;
              line += trim(next.substr(0, next.find('#')));
            }
          if (line.empty())
            continue;

          const std::string keyword = line.substr(0, line.find_first_of(" \t"));
          const std::string rest    = trim(line.substr(keyword.size()));
          if (keyword == "subsection" && !rest.empty())
            section.push_back(rest);
          else if (line == "end")
            {
              if (section.empty())
                throw InputError(where + ": this 'end' closes no subsection.");
              section.pop_back();
            }
          else if (keyword == "include" && !rest.empty())
            {
              if (!section.empty())
                throw InputError(where +
                                 ": 'include' must stand outside of all "
                                 "subsections.");
              const fs::path target(rest);
              read(target.is_absolute()
                     ? rest
                     : (fs::path(file_name).parent_path() / target).string(),
                   where,
                   open_files,
                   declarations,
                   parameters);
            }
          else if (keyword == "set" && rest.find('=') != std::string::npos)
            {
              const std::size_t equal = rest.find('=');
              Path              path  = section;
              path.push_back(trim(rest.substr(0, equal)));
              assign(path,
                     trim(rest.substr(equal + 1)),
                     where,
                     declarations,
                     parameters);
            }
          else
            throw InputError(where + ": cannot make sense of '" + line +
                             "'.\nA line is 'subsection NAME', 'set NAME = "
                             "VALUE', 'end', 'include FILE' or a comment that "
                             "starts with '#'.");
        }
      if (!section.empty())
        throw InputError(file_name + ": subsection '" + join(section) +
                         "' is never closed with 'end'.");
      open_files.pop_back();
    }
  } // namespace



  std::string
  to_text(const double number)
  {
    char text[40];
    std::snprintf(text, sizeof(text), "%.10g", number);
    return text;
  }



  std::vector<std::string>
  nearest_names(const std::string              &name,
                const std::vector<std::string> &candidates,
                const unsigned int              n_names)
  {
    std::vector<std::pair<unsigned int, std::string>> ranked;
    for (const std::string &candidate : candidates)
      {
        const unsigned int distance = edit_distance(name, candidate);
        if (2 * distance <= std::max(name.size(), candidate.size()))
          ranked.emplace_back(distance, candidate);
      }
    std::sort(ranked.begin(), ranked.end());
    std::vector<std::string> names;
    for (unsigned int i = 0; i < ranked.size() && i < n_names; ++i)
      names.push_back(ranked[i].second);
    return names;
  }



  void
  read_parameter_file(const std::string        &file_name,
                      dealii::ParameterHandler &parameters)
  {
    const Declarations       declarations = declarations_of(parameters);
    std::vector<std::string> open_files;
    read(file_name, "", open_files, declarations, parameters);
  }



  void
  set_parameter(const std::string        &assignment,
                dealii::ParameterHandler &parameters)
  {
    const std::string where = "--set \"" + assignment + "\"";
    const std::size_t equal = assignment.find('=');
    if (equal == std::string::npos)
      throw InputError(where +
                       ": expected the form --set \"Section/Name=value\".");
    Path path;
    for (const std::string &part :
         dealii::Utilities::split_string_list(assignment.substr(0, equal), '/'))
      path.push_back(trim(part));
    assign(path,
           trim(assignment.substr(equal + 1)),
           where,
           declarations_of(parameters),
           parameters);
  }
} // namespace Ricochet
