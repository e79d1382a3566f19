// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_parameter_file_h
#define ricochet_base_parameter_file_h

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// A parameter as it was set by a file or on the command line.
  struct Setting
  {
    /// "Section/Name".
    std::string name;
    std::string value;
    /// Where: "file.prm, line 3" or the option of the command line.
    std::string where;
    bool        on_command_line = false;
    /// Whether it differs from the program's own default.
    bool changes_default = false;
  };

  /// A parameter that has no effect with the others as they are.
  struct UnusedParameter
  {
    /// "Section/Name".
    std::string name;
    /// Its owner: "the time scheme HHT; Time/Scheme is midpoint".
    std::string belongs_to;
  };

  /// A parameter as it is declared, with its value now.
  struct ParameterValue
  {
    /// "Section/Name".
    std::string name;
    std::string value;
    /// Whether it is the name of a file that is read.
    bool is_input_file = false;
    /// Allowed values, in deal.II's words; empty if any value is allowed.
    std::string allowed = {};
    /// The names of its sections and its own.
    std::vector<std::string> path          = {};
    std::string              documentation = {};
    /// Description of its pattern as dealii::Patterns::pattern_factory() reads it.
    std::string pattern = {};
  };

  /// Contents of parameter files and command line, before any parameter is
  /// declared: for programs whose sections depend on them.
  struct ParameterText
  {
    /// A value for a parameter.
    struct Assignment
    {
      /// Names of the sections, then that of the parameter.
      std::vector<std::string> path;
      std::string              value;
      /// "file.prm, line 3" or the option of the command line.
      std::string where;
      /// Where a relative name of a file to be read counts from.
      std::string folder;
      bool        on_command_line = false;
    };

    /// A subsection that a file opens, also if nothing is set in it.
    struct Section
    {
      std::vector<std::string> path;
      std::string              where;
    };

    /// In their order; the last one for a parameter counts.
    std::vector<Assignment> assignments;
    std::vector<Section>    sections;

    /// The last value for the parameter @p name outside of all sections, with where
    /// it stands; null if there is none.
    const Assignment *
    find(const std::string &name) const;
  };

  /**
   * Read the .prm file @p file_name, see read_parameter_file().
   * @throws InputError file missing or unreadable, `include` circle, unbalanced
   * `subsection`/`end`, a line without meaning.
   */
  ParameterText
  parse_parameter_file(const std::string &file_name);

  /// Read a text of the form "Section/Name=value", see set_parameter().
  /// @throws InputError when it has another form.
  ParameterText::Assignment
  parse_assignment(const std::string &assignment);

  /// Set the parameters as given in @p text. @return all settings, in their
  /// order.
  /// @throws InputError unknown parameter, value that does not match its pattern, file
  /// of another program.
  std::vector<Setting>
  apply(const ParameterText &text, dealii::ParameterHandler &parameters);

  /// All parameters, in an order that does not depend on where they were set.
  std::vector<ParameterValue>
  list_parameters(const dealii::ParameterHandler &parameters);

  /**
   * Read the .prm file @p file_name into @p parameters, in the syntax of
   * dealii::ParameterHandler, with these additions that users of many small files
   * need: the path after an `include`, and the value of a parameter that names a
   * file to be read, count from the folder of the file that holds them; a
   * parameter `Program`, if declared, must have its default value, which is the
   * name of the program; and each mistake is reported with file, line and, for a
   * misspelt name, the nearest valid names.
   *
   * @return all settings, in their order.
   * @throws InputError file missing or unreadable, unknown section or
   * parameter, value that does not match its pattern, `include` circle,
   * unbalanced `subsection`/`end`, file of another program.
   */
  std::vector<Setting>
  read_parameter_file(const std::string        &file_name,
                      dealii::ParameterHandler &parameters);

  /**
   * Set one parameter from a text of the form "Section/Name=value", as given to
   * `--set` on the command line. Sections nest: "A/B/Name=value". Files to be
   * read count from the working directory.
   *
   * @throws InputError as read_parameter_file(), with @p assignment in place of
   * file and line.
   */
  Setting
  set_parameter(const std::string        &assignment,
                dealii::ParameterHandler &parameters);

  /// A number as a person would write it: 0.05, 1e-12.
  std::string
  to_text(const double number);

  /// The shortest text that is read as the same number.
  std::string
  exact_text(const double number);
} // namespace Ricochet

#endif
