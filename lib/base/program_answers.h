// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_program_answers_h
#define ricochet_base_program_answers_h

#include <base/program_input.h>

namespace Ricochet
{
  /// The parameters of a program, or those of a @p section, with their documentation, for
  /// `--print-parameters`. @throws InputError where there is no such section.
  std::string
  table_of_parameters(const ProgramInput &input, const std::string &section);

  /// One line for each parameter, for `--list`.
  std::string
  list_of_parameters(const ProgramInput &input);

  /// The answer to `--completion` for a @p shell.
  std::string
  completion(const Program &program, const std::string &shell);

  /// A JSON Schema of the parameters; where the file chooses the dimension, for both.
  std::string
  schema_of_parameters(const Program &program, const ParameterText &text);

  /// The answer to `--validate`. Pictures may be written to @p output_dir, if that is not empty.
  std::string
  description(const Program                  &program,
              const std::vector<std::string> &notes,
              const std::string              &output_dir);
} // namespace Ricochet

#endif
