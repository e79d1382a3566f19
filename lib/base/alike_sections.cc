// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/alike_sections.h>
#include <base/exceptions.h>
#include <base/unknown_name.h>

#include <algorithm>
#include <map>
#include <set>

namespace Ricochet
{
  namespace
  {
    using Assignment = ParameterText::Assignment;

    bool
    is_like(const Assignment &assignment)
    {
      return assignment.path.size() == 2 && assignment.path[1] == "Like" &&
        assignment.path[0].find(' ') != std::string::npos;
    }

    /// "Body" of "Body ball".
    std::string
    kind_of(const std::string &section)
    {
      return section.substr(0, section.find(' '));
    }

    /// The section @p name, its model, that one's model and so on. @throws InputError
    std::vector<std::string>
    chain_of(const std::string                               &name,
             const std::map<std::string, const Assignment *> &models,
             const std::set<std::string>                     &sections)
    {
      // Far beyond any use, except for sections that are like each other.
      const std::size_t longest = std::min<std::size_t>(models.size(), 100);
      std::vector<std::string> chain = {name};
      while (models.count(chain.back()) > 0)
        {
          const Assignment &like = *models.at(chain.back());
          const std::string kind = kind_of(like.path[0]);
          chain.push_back(kind + " " + like.value);
          if (sections.count(chain.back()) == 0)
            {
              std::vector<std::string> candidates;
              for (const std::string &section : sections)
                if (kind_of(section) == kind)
                  candidates.push_back(section);
              throw unknown_name(like.where + ": there is no section '" +
                                   chain.back().substr(0, 100) +
                                   "' that this one could be like",
                                 chain.back(),
                                 candidates,
                                 "",
                                 "unknown_section");
            }
          if (chain.size() > longest + 1)
            throw InputError(like.where + ": '" + name +
                             "' is like itself, or like too many in a row.");
        }
      return chain;
    }
  } // namespace



  ParameterText
  with_alike_sections(const ParameterText &text)
  {
    std::map<std::string, const Assignment *>      models;
    std::map<std::string, std::vector<Assignment>> settings;
    for (const Assignment &assignment : text.assignments)
      if (is_like(assignment))
        models[assignment.path[0]] = &assignment;
      else
        settings[assignment.path[0]].push_back(assignment);
    if (models.empty())
      return text;
    std::set<std::string> sections;
    for (const ParameterText::Section &section : text.sections)
      sections.insert(section.path[0]);

    ParameterText result;
    result.sections = text.sections;
    // Settings of sections that are like none come first, so that a mistake in them is found there.
    for (const Assignment &assignment : text.assignments)
      if (models.count(assignment.path[0]) == 0)
        result.assignments.push_back(assignment);
    // Settings of a section itself follow, and count.
    for (const auto &entry : models)
      {
        const auto chain = chain_of(entry.first, models, sections);
        for (auto model = chain.rbegin(); model + 1 != chain.rend(); ++model)
          for (Assignment assignment : settings[*model])
            {
              assignment.path[0] = entry.first;
              result.assignments.push_back(assignment);
            }
      }
    for (const Assignment &assignment : text.assignments)
      if (models.count(assignment.path[0]) > 0 && !is_like(assignment))
        result.assignments.push_back(assignment);
    return result;
  }
} // namespace Ricochet
