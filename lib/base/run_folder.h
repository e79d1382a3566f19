// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_run_folder_h
#define ricochet_base_run_folder_h

#include <base/error_bars.h>
#include <base/files.h>

#include <string>
#include <vector>

namespace Ricochet
{
  class JsonWriter;

  /**
   * The folder a run writes to, and its log. It holds `log.txt`, the parameter
   * file as it was given, `parameters.prm` with the values of all parameters,
   * `run.txt` that says whose run it is, and what the output classes add. All
   * members are called on all ranks; only rank 0 touches files.
   *
   * One process at a time writes to a folder. Results of an earlier run are
   * untouched until begin(): a run that is refused while it is set up leaves
   * everything as it was. Files that do not belong to a run of Ricochet stay as
   * they are.
   */
  class RunFolder
  {
  public:
    struct Options
    {
      std::string path;
      /// Name of the program.
      std::string program;
      /// Empty for none.
      std::string parameter_file;
      bool        resume    = false;
      bool        overwrite = false;
      bool        quiet     = false;
      /// See report_progress().
      bool json_progress = false;
      /// For the summary: that of Ricochet and deal.II, and how the program was called.
      std::string              version      = "";
      std::vector<std::string> command_line = {};
    };

    /**
     * Create the folder if need be, and lock it.
     * @throws InputError on all ranks when it cannot be created or written to,
     * is in use, holds nothing that can be resumed although that is asked for, or, unless
     * it is to be overwritten, holds the run of another program or parameter file or one
     * that can be resumed.
     */
    RunFolder(const Options &options, const MPI_Comm communicator);

    /// Remove the files of an earlier run, unless it is resumed, and begin the
    /// log. Called when the set-up has succeeded; further calls do nothing.
    void
    begin();

    /// Record that the run is complete. Called at its end.
    void
    end();

    /// Print one line on the console and into `log.txt`.
    /// @throws ComputationError when the disk is full.
    void
    log(const std::string &line);

    /// With Options::json_progress, print @p json on the console, which then has no other
    /// lines.
    void
    report_progress(const JsonWriter &json) const;

    /// The run is complete, but the checks that @p lines describe have failed:
    /// the program ends with code 4.
    void
    leave_open(const std::vector<std::string> &lines)
    {
      open_lines = lines;
    }

    /// See leave_open(); empty if nothing is open.
    const std::vector<std::string> &
    what_is_open() const
    {
      return open_lines;
    }

    /// Whether there is a checkpoint in the folder @p path.
    static bool
    has_checkpoint(const std::string &path);

    /// The file with the mesh of a body that Gmsh has made: "mesh_of_NAME.msh".
    static std::string
    name_of_mesh(const std::string &body);

    /// Path of @p name inside the folder.
    std::string
    file(const std::string &name) const;

    const MPI_Comm communicator;
    const bool     is_root;
    const bool     resume;
    const Options  options;

    /// All parameters that change the results of a step, as text: a run can be
    /// resumed only with the same. Output, final time and the settings of the
    /// solvers are not among them.
    std::string parameters_that_matter;

    /// All parameters, for `parameters.prm`.
    std::string all_parameters;

    /// The columns of the energy table that are sums over the run.
    std::vector<std::string> sums;

    /// Set at the end of a run: the numbers of its summary, and the time of its end with all
    /// digits.
    std::vector<RunResult> results;
    std::string            end_time;

  private:
    /// @throws InputError where the parameter file is one of the files that the run writes.
    void
    check_parameter_file() const;

    /// Whether a copy of the parameter file goes into the folder: not if the
    /// file is there itself, or has the name of a result.
    bool
    has_copy() const;

    void
    check_whose_run_it_holds() const;

    void
    remove_earlier_results() const;

    /// Write run.txt.
    void
    write_identity(const std::string &state) const;

    FolderLock lock;
    // The identity of this run in run.txt: its program and parameter file.
    std::string identity;
    bool        begun = false;
    GrowingFile log_file;
    // Lines logged before begin().
    std::string              early_lines;
    std::vector<std::string> open_lines;
  };
} // namespace Ricochet

#endif
