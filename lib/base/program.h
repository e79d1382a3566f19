// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_program_h
#define ricochet_base_program_h

#include <deal.II/base/mpi.h>
#include <deal.II/base/parameter_handler.h>

#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace Ricochet
{
  /// What was given on the command line. See run_program() for the options.
  struct CommandLine
  {
    std::string              parameter_file;
    std::vector<std::string> assignments;
    std::string              output_dir;
    bool                     resume           = false;
    bool                     validate_only    = false;
    bool                     print_parameters = false;
    bool                     help             = false;
    bool                     version          = false;
    bool                     quiet            = false;
  };

  /// Parse the arguments of main(). @throws InputError on an unknown option.
  CommandLine
  parse_command_line(const int argc, char **argv);

  /**
   * The folder a run writes to, and its log. It holds `log.txt`, the parameter
   * file as it was given, `parameters.prm` with the values of all parameters,
   * and what the output classes add. All members may be called on all ranks;
   * only rank 0 touches files.
   */
  class RunFolder
  {
  public:
    /**
     * Create the folder @p path if need be.
     * @throws InputError on all ranks when it cannot be created or written to.
     */
    RunFolder(const std::string &path,
              const MPI_Comm     communicator,
              const bool         resume,
              const bool         quiet);

    /// Print one line on the console and into `log.txt`, on rank 0 only.
    void
    log(const std::string &line);

    /// Path of @p name inside the folder.
    std::string
    file(const std::string &name) const;

    const MPI_Comm communicator;
    const bool     is_root;
    const bool     resume;

    /// All parameters that change the results of a step, as text: a run can be
    /// resumed only with the same. Output, final time and the settings of the
    /// solvers are not among them.
    std::string parameters_that_matter;

  private:
    const std::string path;
    const bool        quiet;
    std::ofstream     log_file;
  };

  /// What run_program() needs to know about one of the programs in steps/.
  struct Program
  {
    /// Name of the executable.
    std::string name;
    /// A paragraph for `--help`.
    std::string description;
    /// Declare all parameters.
    std::function<void(dealii::ParameterHandler &)> add_parameters;
    /// Refuse what has no meaning, before any time is spent (InputError).
    std::function<void()> validate;
    /// Do the work.
    std::function<void(RunFolder &)> run;
  };

  /**
   * The main() of every step: read the command line and the parameter file,
   * then validate and run.
   *
   *     NAME [FILE.prm] [--set "Section/Name=value"]... [--output-dir DIR]
   *          [--resume] [--validate] [--print-parameters] [--quiet]
   *          [--help] [--version]
   *
   * Errors are printed once, by rank 0, without a stack trace.
   *
   * @return the exit code: 0 success, 1 InputError, 2 ComputationError,
   * 3 anything else (a bug).
   */
  int
  run_program(const int argc, char **argv, const Program &program);
} // namespace Ricochet

#endif
