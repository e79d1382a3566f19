// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_program_input_h
#define ricochet_base_program_input_h

#include <base/parameter_file.h>
#include <base/program.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// A program with the settings of one phase.
  struct ProgramInput
  {
    /// @throws InputError where they cannot be read.
    ProgramInput(const Program &program, const ParameterText &text);

    /// @return notes. @throws InputError where they have no meaning, or one of the command line
    /// has no effect.
    std::vector<std::string>
    validate(const Program &program) const;

    /// The parameters except for those of output, final time and solvers. A
    /// file counts by its contents.
    std::string
    parameters_that_matter() const;

    dealii::ParameterHandler parameters;
    std::string              program_name, output_dir;
    std::vector<Setting>     settings;
    std::string              all_parameters;
  };
} // namespace Ricochet

#endif
