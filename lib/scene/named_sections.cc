// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/unknown_name.h>
#include <scene/named_sections.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <map>

namespace Ricochet
{
  std::string
  NamedSection::column_name() const
  {
    std::string text = name;
    std::replace(text.begin(), text.end(), ' ', '_');
    return text;
  }



  namespace
  {
    /// The name of the file in "file.prm, line 3".
    std::string
    file_of(const std::string &where)
    {
      return where.substr(0, where.rfind(", line "));
    }

    bool
    is_good_name(const std::string &name)
    {
      return !name.empty() && name.size() <= 60 &&
        std::all_of(name.begin(), name.end(), [](const char c) {
          return std::isalnum(static_cast<unsigned char>(c)) || c == ' ' ||
            c == '_' || c == '-' || c == '.';
        });
    }
  } // namespace



  std::vector<NamedSection>
  find_named_sections(const ParameterText            &text,
                      const std::vector<std::string> &kinds,
                      const std::vector<std::string> &plain)
  {
    std::vector<NamedSection>          sections;
    std::map<std::string, std::string> known, columns;
    for (const ParameterText::Section &section : text.sections)
      {
        const std::string &full = section.path.front();
        if (section.path.size() > 1)
          throw InputError(section.where + ": there is no subsection '" +
                           section.path.back().substr(0, 100) +
                           "' within another one.");
        if (std::find(plain.begin(), plain.end(), full) != plain.end())
          continue;
        const std::string kind = full.substr(0, full.find(' '));
        if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end())
          {
            std::vector<std::string> candidates = plain;
            for (const std::string &one : kinds)
              candidates.push_back(one + full.substr(kind.size()));
            throw unknown_name(section.where + ": there is no section '" +
                                 full.substr(0, 100) + "'",
                               full,
                               candidates,
                               "\nSections are " +
                                 boost::algorithm::join(plain, ", ") +
                                 ", and with a name of your own: " +
                                 boost::algorithm::join(kinds, ", ") + ".",
                               "unknown_section");
          }
        const std::string name =
          dealii::Utilities::trim(full.substr(kind.size()));
        if (!is_good_name(name) || kind + " " + name != full)
          throw InputError(
            section.where + ": '" + full.substr(0, 100) + "' should be '" +
            kind +
            " NAME', with a name of at most 60 letters, digits, single "
            "blanks and . _ -");
        if (name == "itself" && (kind == "Body" || kind == "Obstacle"))
          throw InputError(section.where +
                           ": 'itself' means something else in contacts; "
                           "choose another name than '" +
                           full + "'.");
        const auto [first, is_first] = known.emplace(full, section.where);
        if (!is_first)
          {
            if (file_of(first->second) == file_of(section.where))
              throw InputError(
                section.where + ": '" + full + "' exists already, in " +
                first->second +
                ". Give one of both another name, or put them together.");
            continue;
          }
        const NamedSection found{kind, name, section.where};
        const auto [other, is_new] =
          columns.emplace(kind + " " + found.column_name(), full);
        if (!is_new)
          throw InputError(section.where + ": '" + full + "' and '" +
                           other->second +
                           "' would be the same in the energy table; give "
                           "them names that differ more.");
        sections.push_back(found);
      }
    return sections;
  }
} // namespace Ricochet
