// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/alike_sections.h>
#include <base/command_line.h>
#include <base/commit.h>
#include <base/exceptions.h>
#include <base/json_writer.h>
#include <base/last_meeting.h>
#include <base/one_rank.h>
#include <base/parameter_file.h>
#include <base/parameter_schema.h>
#include <base/program.h>
#include <base/program_answers.h>
#include <base/program_runs.h>
#include <base/threads.h>
#include <base/variables.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <optional>

#include <sys/resource.h>
#include <unistd.h>

namespace Ricochet
{
  namespace
  {
    /// Print the requested text, on rank 0. @throws ComputationError
    void
    print(const std::string &text)
    {
      on_first_rank(MPI_COMM_WORLD, [&]() {
        std::cout << text << std::flush;
        if (!std::cout)
          throw ComputationError("The standard output cannot be written to.");
      });
    }



    /// The answer to an option that asks about the program itself; nothing without one.
    std::optional<std::string>
    answer_without_input(const CommandLine &command_line,
                         const Program     &program)
    {
      if (command_line.help)
        return help_text(program);
      if (command_line.manual)
        return manual_page(program);
      if (!command_line.completion.empty())
        return completion(program, command_line.completion);
      if (command_line.version)
        return program.name + " of Ricochet " + RICOCHET_VERSION + " (" +
          RICOCHET_BUILD_TYPE + "), commit " + commit() + ", deal.II " +
          DEAL_II_PACKAGE_VERSION + "\n";
      if (command_line.table.empty())
        return {};
      for (const Program::Table &table : program.tables)
        if (table.option == command_line.table)
          return table.text();
      throw InputError("There is no option '" + command_line.table + "' of " +
                       program.name + "; ricochet has it.");
    }



    /// @return what is open at the end of the run, see RunFolder::leave_open(); nothing on
    /// ranks that leave the run to the first one.
    std::optional<std::vector<std::string>>
    execute(const int argc, char **argv, const Program &program)
    {
      namespace fs = std::filesystem;
      const std::vector<std::string> no_run;

      const CommandLine command_line = parse_command_line(argc, argv);
      if (const auto text = answer_without_input(command_line, program))
        {
          print(*text);
          return no_run;
        }
      if (command_line.json && command_line.print_parameters &&
          !(command_line.parameter_file + command_line.section).empty())
        throw InputError(
          "--print-parameters --json describes all sections that a file may "
          "have, and takes neither a file nor a section.");
      ParameterText text;
      if (!command_line.parameter_file.empty())
        text = parse_parameter_file(command_line.parameter_file);
      for (const std::string &assignment : command_line.assignments)
        text.assignments.push_back(parse_assignment(assignment));
      std::vector<Phase> phases = program.join_phases
        ? phases_of(text)
        : std::vector<Phase>{{"", text, ""}};
      for (Phase &phase : phases)
        in_phase(phase.name, [&phase]() {
          phase.text = with_alike_sections(with_variables(phase.text));
        });

      // Every phase is checked before any time is spent.
      std::unique_ptr<ProgramInput> checked;
      std::vector<std::string>      notes;
      std::string   answer, output_dir = command_line.output_dir;
      std::uint32_t bodies_of_all = 0;
      JsonWriter    json_answer;
      json_answer.add("valid", true);
      json_answer.begin_object("phases");
      for (unsigned int k = 0; k < phases.size(); ++k)
        in_phase(phases[k].name, [&]() {
          checked = std::make_unique<ProgramInput>(program,
                                                   text_of_phase(phases,
                                                                 k,
                                                                 output_dir));
          if (output_dir.empty())
            output_dir = checked->output_dir;
          // Runs of different files have different default folders.
          if (output_dir.empty())
            output_dir = "output/" + program.name + "/" +
              (command_line.parameter_file.empty()
                 ? "without_file"
                 : fs::path(command_line.parameter_file).stem().string());
          // All phases have the same meshes.
          if (k == 0 && command_line.resume && program.take_meshes)
            program.take_meshes(
              (fs::path(output_dir) / phases[k].folder).string());
          if (!phases[k].name.empty() && !command_line.json)
            answer += std::string(k > 0 ? "\n" : "") +
              (command_line.print_parameters || command_line.list ? "# " : "") +
              "Phase " + phases[k].name + "\n";
          if (command_line.print_parameters)
            {
              answer += command_line.json
                ? schema_of_parameters(program, phases[k].text)
                : table_of_parameters(*checked, command_line.section);
              return;
            }
          if (command_line.list)
            {
              answer += list_of_parameters(*checked);
              return;
            }
          notes = checked->validate(program);
          if (phases.size() > 1 && program.checksum_of_bodies)
            {
              const std::uint32_t bodies = program.checksum_of_bodies();
              if (k == 0)
                bodies_of_all = bodies;
              if (bodies != bodies_of_all)
                throw InputError(
                  "it has other bodies than the first phase, or bodies with another mesh "
                  "or place, while it goes on from where the phase before it ends. Set "
                  "what makes or moves a body (Shape, Size, Translation, ...) outside of "
                  "the phases; a Condition moves it within one.");
            }
          if (phases.size() > 1 &&
              checked->parameters.get({"Output"}, "Checkpoint every") == "0")
            throw InputError(
              "Output/Checkpoint every = 0 cannot be combined "
              "with phases, each of which begins at the last "
              "checkpoint of the one before.");
          if (!command_line.validate_only)
            return;
          const std::string lines =
            description(program, notes, command_line.output_dir);
          answer += lines;
          json_answer.begin_object(phases[k].name.empty() ? program.name
                                                          : phases[k].name);
          json_answer.add("lines",
                          dealii::Utilities::split_string_list(lines, '\n'));
          json_answer.add("notes", notes);
          json_answer.end_object();
        });
      json_answer.end_object();
      const bool                 has_phases = !phases.front().name.empty();
      std::vector<ParameterText> certified;
      if (command_line.certify && has_phases)
        throw InputError(
          "--certify is for runs without phases, each of which begins where the one before it "
          "has ended: certify each as a run of its own, with Start/From.");
      if (command_line.certify)
        certified = texts_of_certificate(program, phases.front().text);
      if (command_line.validate_only)
        answer = command_line.json ? json_answer.finished()
                                   : "The parameters are valid.\n" + answer;
      if (command_line.validate_only || command_line.print_parameters ||
          command_line.list)
        {
          print(answer);
          return no_run;
        }

      // A closed console does not stop the run.
      std::signal(SIGPIPE, SIG_IGN);
      const std::string version = std::string("Ricochet ") + RICOCHET_VERSION +
        " (" + RICOCHET_BUILD_TYPE + "), deal.II " + DEAL_II_PACKAGE_VERSION;
      ProgramRuns runs(program,
                       phases,
                       {output_dir,
                        program.name,
                        command_line.parameter_file,
                        command_line.resume,
                        command_line.overwrite,
                        command_line.quiet,
                        command_line.json_progress,
                        version,
                        {argv, argv + argc}});
      const auto  run = [&](const std::string &note_of_ranks) {
        if (has_phases)
          return runs.run_phases(note_of_ranks);
        if (!certified.empty())
          return runs.run_certified(certified, notes, note_of_ranks);
        return runs.run_only(*checked, notes, note_of_ranks);
      };
      try
        {
          return run("");
        }
      catch (const OneRankSuffices &one_rank)
        {
          OneRank::begin();
          if (!OneRank::is_alone())
            return std::nullopt;
          Threads::begin();
          return run(": the others wait, as one is faster than several with " +
                     std::to_string(one_rank.n_unknowns) +
                     " unknowns (Linear solver/Distribute = true takes all)");
        }
    }



    // Without mpirun, Open MPI would start a process that could start others, which takes
    // a third of all start-up and which nobody asks for. Processes that are alone in this
    // way all call themselves job 0, so that they would share a folder of temporary files
    // and one that ends would take it from under one that starts: none has such a folder.
    // Other MPIs do not know these names. Started by a launcher (mpirun, srun), Open MPI
    // is left as it is.
    void
    start_alone_unless_launched()
    {
      for (const char *const rank :
           {"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID"})
        if (std::getenv(rank) != nullptr)
          return;
      ::setenv("OMPI_MCA_ess_singleton_isolated", "1", /* overwrite */ 0);
      ::setenv("OMPI_MCA_orte_create_session_dirs", "0", /* overwrite */ 0);
      // In this folder would be the common pointer of files that MPI writes; HDF5 needs none.
      ::setenv("OMPI_MCA_sharedfp", "^sm", /* overwrite */ 0);
    }
  } // namespace



  namespace
  {
    // OpenBLAS starts threads when it is loaded. Where memory is limited (ulimit -v), it
    // has less than it wants, and waits for them for ever at the end of the process: then
    // the program is started once more with one thread, which is all that we use of it.
    void
    start_again_if_memory_is_limited(char **argv)
    {
      rlimit     space = {}, data = {};
      const bool is_limited = (getrlimit(RLIMIT_AS, &space) == 0 &&
                               space.rlim_cur != RLIM_INFINITY) ||
        (getrlimit(RLIMIT_DATA, &data) == 0 && data.rlim_cur != RLIM_INFINITY);
      if (!is_limited || std::getenv("OPENBLAS_NUM_THREADS") != nullptr)
        return;
      ::setenv("OPENBLAS_NUM_THREADS", "1", /* overwrite */ 1);
      ::execv("/proc/self/exe", argv);
    }
  } // namespace



  int
  run_program(const int argc, char **argv, const Program &program)
  {
    start_again_if_memory_is_limited(argv);

    // Beyond the limit on the size of files, writing fails as on a full disk.
    std::signal(SIGXFSZ, SIG_IGN);

    start_alone_unless_launched();

    // deal.II itself has one thread per rank. Our options are not shown to its libraries:
    // PETSc would warn that it does not know them.
    int                                      mpi_argc = std::min(argc, 1);
    char                                   **mpi_argv = argv;
    dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, mpi_argv, 1);
    Threads::begin();
    const bool is_root =
      dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

    // Users of a finished program have no use for the stack trace of an
    // assertion.
    dealii::deal_II_exceptions::suppress_stacktrace_in_exceptions();

    const LastMeeting meeting;
    const bool        as_json =
      std::any_of(argv + 1, argv + argc, [](const char *word) {
        return std::string(word) == "--json";
      });
    const auto report = [&](const std::string         &kind,
                            const std::string         &text,
                            const int                  code,
                            const InputError::Details &details) {
      if (as_json)
        std::cerr << refusal_as_json(text, details, code) << std::flush;
      else
        std::cerr << "\n"
                  << program.name << ": " << kind << "\n"
                  << text << "\n"
                  << std::endl;
    };
    // Possibly on one rank only: the others must not wait for ever.
    const auto stop_all_ranks = [](const int code) {
      if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
        MPI_Abort(MPI_COMM_WORLD, code);
      return code;
    };
    // Where all ranks have failed, one of them says so and each of them ends.
    const auto fail = [&](const int                  code,
                          const std::string         &kind,
                          const std::string         &text,
                          const InputError::Details &details) {
      const bool all_failed = LastMeeting::is_complete();
      if (is_root || !all_failed)
        report(kind, text, code, details);
      return all_failed ? code : stop_all_ranks(code);
    };
    const auto run = [&]() {
      try
        {
          const auto open = execute(argc, argv, program);
          if (!open)
            return OneRank::wait();
          if (!open->empty())
            {
              std::string lines;
              for (const std::string &line : *open)
                lines += (lines.empty() ? "" : "\n") + line;
              if (is_root)
                report(
                  "the run is complete, but its energy is not what it says.",
                  lines,
                  4,
                  {"open_energy"});
              return 4;
            }
        }
      catch (const StoppedBySignal &stop)
        {
          if (is_root)
            report("stopped by a signal.",
                   stop.what(),
                   128 + stop.signal,
                   {"signal"});
          return 128 + stop.signal;
        }
      catch (const InputError &error)
        {
          return fail(1,
                      "the input is not valid.",
                      error.what(),
                      error.details);
        }
      catch (const ComputationError &error)
        {
          return fail(2,
                      "the computation stopped.",
                      error.what(),
                      {"computation"});
        }
      catch (const std::bad_alloc &)
        {
          report("the computation stopped.",
                 "There is not enough memory.",
                 2,
                 {"memory"});
          return stop_all_ranks(2);
        }
      catch (const std::exception &error)
        {
          std::cerr << program.name << ": an error that should not happen.\n"
                    << error.what() << std::endl;
          return stop_all_ranks(3);
        }
      return 0;
    };
    const int code = run();
    if (OneRank::is_alone())
      OneRank::release(code);
    return code;
  }
} // namespace Ricochet
