// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_scene_named_sections_h
#define ricochet_scene_named_sections_h

#include <base/parameter_file.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// A section of a parameter file with a name given by the user: `subsection
  /// Body ball` is of the kind "Body" and has the name "ball".
  struct NamedSection
  {
    std::string kind;
    std::string name;
    /// "file.prm, line 3"
    std::string where;

    /// Heading in the file: "Body ball".
    std::string
    full_name() const
    {
      return kind + " " + name;
    }

    /// For columns of the ledger: blanks become underscores.
    std::string
    column_name() const;
  };

  /**
   * The named sections of @p text, each once, in the order in which they appear first.
   * A file may go on with a section of one that it includes.
   *
   * @param kinds of sections with names.
   * @param plain other sections.
   * @throws InputError for a section of neither kind, with the nearest names; for a
   * name that is missing or has characters that mean something else; and for two names
   * of one kind in one file that are the same or differ by blanks and underscores only.
   */
  std::vector<NamedSection>
  find_named_sections(const ParameterText            &text,
                      const std::vector<std::string> &kinds,
                      const std::vector<std::string> &plain);
} // namespace Ricochet

#endif
