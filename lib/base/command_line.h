// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_command_line_h
#define ricochet_base_command_line_h

#include <string>
#include <vector>

namespace Ricochet
{
  struct Program;

  /// The arguments of the command line. See run_program() for the options.
  struct CommandLine
  {
    std::string              parameter_file;
    std::vector<std::string> assignments;
    std::string              output_dir;
    bool                     resume           = false;
    bool                     overwrite        = false;
    bool                     certify          = false;
    bool                     validate_only    = false;
    bool                     print_parameters = false;
    /// The section that --print-parameters is restricted to; empty for all of them.
    std::string section;
    bool        list    = false;
    bool        help    = false;
    bool        version = false;
    bool        manual  = false;
    /// "bash" or "zsh"; empty for none.
    std::string completion;
    bool        quiet = false;
    bool        json  = false;
    /// Lines of JSON on the progress of the run, in place of the log, on the console.
    bool json_progress = false;
    /// An option of Program::tables; empty for none.
    std::string table;
  };

  /// Parse the arguments of main(). @throws InputError on an unknown option, a missing value and
  /// two options that exclude each other.
  CommandLine
  parse_command_line(const int argc, char **argv);

  /// The answer to `--help`: options, examples, environment and exit codes.
  std::string
  help_text(const Program &program);

  /// The same as a manual page (section 1, in the macros of man).
  std::string
  manual_page(const Program &program);

  /**
   * A script by which a shell completes options, their values, and parameters after `--set`.
   *
   * @param shell "bash" or "zsh".
   * @param parameters their names, "Section/Name".
   * @param sections that --print-parameters may be restricted to.
   */
  std::string
  completion_script(const Program                  &program,
                    const std::string              &shell,
                    const std::vector<std::string> &parameters,
                    const std::vector<std::string> &sections);
} // namespace Ricochet

#endif
