// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_program_h
#define ricochet_base_program_h

#include <base/command_line.h>
#include <base/parameter_file.h>
#include <base/phases.h>
#include <base/run_folder.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>
#include <deal.II/base/template_constraints.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Ricochet
{
  /// The results of a phase of a run.
  struct PhaseResult
  {
    std::string name;
    /// Its folder.
    std::string path;
    /// RunFolder::sums
    std::vector<std::string> sums;
  };

  /// Description of one of the programs in steps/ for run_program().
  struct Program
  {
    /// Name of the executable.
    std::string name;
    /// A paragraph for `--help`.
    std::string description;
    /// Declare all parameters.
    std::function<void(dealii::ParameterHandler &)> add_parameters;
    /// Refuse meaningless input before any time is spent (InputError).
    std::function<void()> validate;
    /// Do the work.
    std::function<void(RunFolder &)> run;
    /// The parameters without effect; may be left out.
    std::function<std::vector<UnusedParameter>()> unused_parameters = {};
    /// Called before #add_parameters with the settings of the user, on which
    /// the declarations may depend; may be left out.
    std::function<void(const ParameterText &)> prepare = {};
    /// Lines that `--validate` prints besides, after #validate; may be left
    /// out. Pictures may be written to the folder, if its name is not empty.
    std::function<std::string(const std::string &folder)> description_of_input =
      {};
    /// A table that an option prints.
    struct Table
    {
      std::string                  option, description;
      std::function<std::string()> text;
    };
    std::vector<Table> tables = {};
    /// Joins the results of the phases of a run, see phases_of(), in the folder of the
    /// whole; called after each of them. Left out by programs without phases.
    std::function<void(RunFolder &whole, const std::vector<PhaseResult> &)>
      join_phases = {};
    /// Called before #validate with the folder of a run that is to be resumed, where meshes
    /// may be kept; may be left out.
    std::function<void(const std::string &folder)> take_meshes = {};
    /// The checksum of the bodies, after #validate, which is to be the same in all phases; left out by
    /// programs without phases.
    std::function<std::uint32_t()> checksum_of_bodies = {};
  };

  /**
   * The main() of every step: read the command line and the parameter file,
   * then validate and run.
   *
   *     NAME [FILE.prm] [--set "Section/Name=value"]... [--output-dir DIR]
   *          [--overwrite] [--resume] [--certify] [--validate]
   *          [--print-parameters [SECTION]] [--list] [--quiet] [--progress json]
   *          [--json] [--completion SHELL] [--manual] [--help] [--version]
   *
   * A parameter without effect is refused when it is set on the command line, and
   * noted in the log when a file sets it: files set what belongs together.
   *
   * Errors are printed once, by rank 0, without a stack trace. With `--json` they are as
   * refusal_as_json() has them, and so are the answers to `--validate` and
   * `--print-parameters`.
   *
   * @return the exit code: 0 success, 1 InputError, 2 ComputationError,
   * 3 anything else (a bug), 4 a complete run whose balance or promise is open, see
   * RunFolder::leave_open().
   */
  int
  run_program(const int argc, char **argv, const Program &program);

  /// Optional member of a step.
  template <typename Step>
  using unused_parameters_of =
    decltype(std::declval<const Step &>().unused_parameters());

  /**
   * The same for a class with the members `add_parameters(ParameterHandler &)`,
   * `validate()`, `run(RunFolder &)` and, if some parameters may have no effect,
   * `unused_parameters()`.
   */
  template <typename Step>
  int
  run_program(const int          argc,
              char             **argv,
              const std::string &name,
              const std::string &description)
  {
    Step    step;
    Program program;
    program.name           = name;
    program.description    = description;
    program.add_parameters = [&](dealii::ParameterHandler &parameters) {
      step.add_parameters(parameters);
    };
    program.validate = [&]() { step.validate(); };
    program.run      = [&](RunFolder &folder) { step.run(folder); };
    if constexpr (dealii::internal::is_supported_operation<unused_parameters_of,
                                                           Step>)
      program.unused_parameters = [&]() { return step.unused_parameters(); };
    return run_program(argc, argv, program);
  }
} // namespace Ricochet

#endif
