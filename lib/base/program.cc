// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/alike_sections.h>
#include <base/commit.h>
#include <base/certificate.h>
#include <base/json_writer.h>
#include <base/last_meeting.h>
#include <base/parameter_file.h>
#include <base/parameter_schema.h>
#include <base/one_rank.h>
#include <base/program.h>
#include <base/refinement.h>
#include <base/threads.h>
#include <base/variables.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <memory>
#include <new>
#include <optional>
#include <sstream>

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



    /// The parameters except for those of output, final time and solvers. A
    /// file counts by its contents.
    std::string
    parameters_that_matter(const dealii::ParameterHandler &parameters)
    {
      std::string text;
      for (const ParameterValue &parameter : list_parameters(parameters))
        {
          const std::string &name        = parameter.name;
          const auto         begins_with = [&](const std::string &beginning) {
            return name.compare(0, beginning.size(), beginning) == 0;
          };
          if (begins_with("Output/") || begins_with("Newton/") ||
              begins_with("Linear solver/") || begins_with("Limits/") ||
              name == "Program" || name == "Time/Final time" ||
              name == "Time/Until" || name == "Time/Maximum halvings")
            continue;
          if (parameter.is_input_file && !parameter.value.empty())
            text += name + " = a file with the checksum " +
              std::to_string(checksum(read_file(parameter.value))) + "\n";
          else
            text += name + " = " + parameter.value + "\n";
        }
      return text;
    }



    /// Refuse or note parameters without effect. @return the notes.
    std::vector<std::string>
    check_unused(const Program &program, const std::vector<Setting> &settings)
    {
      std::vector<std::string> notes;
      if (!program.unused_parameters)
        return notes;
      for (const UnusedParameter &unused : program.unused_parameters())
        {
          // The last setting is the one that counts.
          const Setting *last = nullptr;
          for (const Setting &setting : settings)
            if (setting.name == unused.name)
              last = &setting;
          if (!last || !last->changes_default)
            continue;
          const std::string text = "'" + unused.name + "' is set to '" +
            last->value + "' and has no effect: it belongs to " +
            unused.belongs_to + ".";
          if (last->on_command_line)
            throw InputError(last->where + ": " + text,
                             {"no_effect", unused.name});
          notes.push_back("note: " + last->where + ": " + text);
        }
      return notes;
    }



    /// A program with the settings of one phase.
    struct Input
    {
      /// @throws InputError
      Input(const Program &program, const ParameterText &text)
        : program_name(program.name)
      {
        parameters.add_parameter("Program",
                                 program_name,
                                 "The program that this file is for; others "
                                 "refuse it.");
        parameters.enter_subsection("Output");
        parameters.add_parameter(
          "Folder",
          output_dir,
          "Folder for all output of the run; empty for "
          "output/PROGRAM/FILE, from the names of program "
          "and parameter file. On the command line: "
          "--output-dir.",
          dealii::Patterns::DirectoryName());
        parameters.leave_subsection();
        if (program.prepare)
          program.prepare(text);
        program.add_parameters(parameters);
        settings = apply(text, parameters);
        std::ostringstream all;
        parameters.print_parameters(all, dealii::ParameterHandler::Text);
        all_parameters = all.str();
      }

      /// @return notes. @throws InputError
      std::vector<std::string>
      validate(const Program &program) const
      {
        program.validate();
        return check_unused(program, settings);
      }

      dealii::ParameterHandler parameters;
      std::string              program_name, output_dir;
      std::vector<Setting>     settings;
      std::string              all_parameters;
    };



    /// Names of the sections of @p parameters, each once.
    std::vector<std::string>
    names_of_sections(const std::vector<ParameterValue> &parameters)
    {
      std::vector<std::string> names;
      for (const ParameterValue &parameter : parameters)
        if (parameter.path.size() > 1 &&
            (names.empty() || names.back() != parameter.path[0]))
          names.push_back(parameter.path[0]);
      return names;
    }



    /// Whether @p name is a section that @p wanted means: "Contact" means "Contact NAME", too.
    bool
    is_meant(const std::string &name, const std::string &wanted)
    {
      return wanted.empty() || name == wanted ||
        name.compare(0, wanted.size() + 1, wanted + " ") == 0;
    }



    /// The subsections of a parameter file @p text with @p name.
    std::string
    only_section(const std::string &text, const std::string &name)
    {
      std::istringstream lines(text);
      std::string        line, result;
      bool               is_inside = false;
      while (std::getline(lines, line))
        {
          const std::string begin = "subsection ";
          if (line.compare(0, begin.size(), begin) == 0)
            is_inside = is_meant(line.substr(begin.size()), name);
          if (is_inside)
            result += line + "\n";
          if (is_inside && line == "end")
            result += "\n";
          is_inside = is_inside && line != "end";
        }
      return result;
    }



    /// All parameters, or those of a @p section, with their documentation, for
    /// `--print-parameters`. @throws InputError where there is no such section.
    std::string
    table_of_parameters(const Input &input, const std::string &section)
    {
      const auto parameters = list_parameters(input.parameters);
      const auto names      = names_of_sections(parameters);
      if (std::none_of(names.begin(), names.end(), [&](const auto &name) {
            return is_meant(name, section);
          }))
        {
          const auto  nearest = nearest_names(section, names, 1);
          std::string message = "There is no section '" + section + "'.";
          if (!nearest.empty())
            message += " Is '" + nearest[0] + "' meant?";
          throw InputError(message, {"unknown_section", section, nearest});
        }
      std::string allowed;
      for (const ParameterValue &parameter : parameters)
        if (!parameter.allowed.empty() && is_meant(parameter.path[0], section))
          allowed += "#   " + parameter.name + ": " + parameter.allowed + "\n";
      return (section.empty() ? input.all_parameters + "\n"
                              : only_section(input.all_parameters, section)) +
        "# What is allowed:\n" + allowed;
    }



    /// One line for each parameter, for `--list`.
    std::string
    list_of_parameters(const Input &input)
    {
      std::string lines;
      for (const ParameterValue &parameter : list_parameters(input.parameters))
        lines += parameter.name + " = " + parameter.value +
          (parameter.allowed.empty() ? "" : "  (" + parameter.allowed + ")") +
          "\n";
      return lines;
    }



    /// The answer to `--completion`.
    std::string
    completion(const Program &program, const std::string &shell)
    {
      const auto parameters =
        list_parameters(Input(program, ParameterText()).parameters);
      std::vector<std::string> names;
      for (const ParameterValue &parameter : parameters)
        names.push_back(parameter.name);
      return completion_script(program,
                               shell,
                               names,
                               names_of_sections(parameters));
    }



    /// The same as a JSON Schema; where the file chooses the dimension, for both.
    std::string
    schema_of_parameters(const Program &program, const ParameterText &text)
    {
      const auto in_dimension = [&](const std::string &dimension) {
        ParameterText own = text;
        own.assignments.push_back({{"Dimension"}, dimension, "", "."});
        return Input(program, own);
      };
      JsonWriter json;
      json.add("$schema", "https://json-schema.org/draft/2020-12/schema");
      json.add("title", "parameters of " + program.name);
      const Input any(program, text);
      const auto  all = list_parameters(any.parameters);
      if (std::none_of(all.begin(), all.end(), [](const ParameterValue &one) {
            return one.name == "Dimension";
          }))
        {
          add_schema(any.parameters, json);
          return json.finished();
        }
      json.begin_object("if");
      json.begin_object("properties");
      json.begin_object("Dimension");
      json.add("const", "3");
      json.end_object();
      json.end_object();
      json.add("required", std::vector<std::string>{"Dimension"});
      json.end_object();
      for (const auto &[name, dimension] :
           {std::pair<std::string, std::string>{"then", "3"}, {"else", "2"}})
        {
          json.begin_object(name);
          add_schema(in_dimension(dimension).parameters, json);
          json.end_object();
        }
      return json.finished();
    }



    /// The answer to `--validate`.
    std::string
    description(const Program                  &program,
                const std::vector<std::string> &notes,
                const std::string              &output_dir)
    {
      std::string lines;
      if (program.description_of_input)
        try
          {
            lines += program.description_of_input(output_dir);
          }
        catch (const ComputationError &error)
          {
            // Exceptions here mean a load that is not finite at the start,
            // or a folder that cannot be written to; no other computation
            // has begun.
            throw InputError(error.what());
          }
      for (const std::string &note : notes)
        lines += note + "\n";
      return lines;
    }



    /// Do what may refuse the input of a phase, whose name is then said.
    /// @throws InputError
    void
    in_phase(const std::string &name, const std::function<void()> &action)
    {
      if (name.empty())
        return action();
      try
        {
          action();
        }
      catch (const InputError &problem)
        {
          throw InputError("Phase " + name + ": " + problem.what(),
                           problem.details);
        }
    }



    /// The settings of phase number @p k, which begins where the one before it has ended.
    /// @param output_dir folder of the whole run.
    ParameterText
    text_of_phase(const std::vector<Phase> &phases,
                  const unsigned int        k,
                  const std::string        &output_dir)
    {
      ParameterText text = phases[k].text;
      if (phases.size() > 1)
        text.assignments.insert(text.assignments.begin(),
                                {{"Output", "Checkpoint every"},
                                 "1000000000",
                                 "Phase " + phases[k].name,
                                 "."});
      if (k > 0)
        text.assignments.push_back(
          {{"Start", "From"},
           (std::filesystem::path(output_dir) / phases[k - 1].folder).string(),
           "Phase " + phases[k].name,
           "."});
      return text;
    }



    /// The settings of these runs. @throws InputError where one of them is not valid.
    std::vector<ParameterText>
    texts_of_certificate(const Program &program, const ParameterText &text)
    {
      const Input input(program, text);
      input.validate(program);
      const auto                 unused = program.unused_parameters
                        ? program.unused_parameters()
                        : std::vector<UnusedParameter>();
      std::vector<ParameterText> texts;
      for (const Refinement &refinement : refinements_of_certificate)
        {
          texts.push_back(text);
          for (const auto &setting :
               refined_parameters(list_parameters(input.parameters),
                                  unused,
                                  refinement))
            texts.back().assignments.push_back(setting);
          Input(program, texts.back()).validate(program);
        }
      return texts;
    }



    /// The program with all that is the same in each phase of a run.
    class Runs
    {
    public:
      Runs(const Program            &program,
           const std::vector<Phase> &phases,
           RunFolder::Options        options)
        : program(program)
        , phases(phases)
        , options(std::move(options))
      {}

      /// A run of one phase, whose @p input has been validated.
      /// @return what is open, see RunFolder::leave_open().
      /// @throws OneRankSuffices to be called again.
      std::vector<std::string>
      run_only(const Input                    &input,
               const std::vector<std::string> &notes,
               const std::string              &note_of_ranks)
      {
        RunFolder folder(options, OneRank::communicator());
        run(input, notes, note_of_ranks, folder);
        return folder.what_is_open();
      }

      /// The phases that are still to be made.
      /// @return what is open. @throws OneRankSuffices to be called again.
      std::vector<std::string>
      run_phases(const std::string &note_of_ranks)
      {
        // The folder of the whole has no checkpoint: its table is made anew.
        RunFolder::Options of_whole = options;
        of_whole.resume             = false;
        of_whole.overwrite          = options.overwrite || options.resume;
        RunFolder whole(of_whole, OneRank::communicator());
        whole.all_parameters = "# Each phase has its own, in its folder.\n";
        while (results.size() < phases.size())
          in_phase(phases[results.size()].name,
                   [&]() { run_next(note_of_ranks, whole); });
        whole.end();
        return open;
      }

      /// The runs of a certificate, of which @p texts are the settings, and the certificate.
      /// @return what is open. @throws OneRankSuffices to be called again.
      std::vector<std::string>
      run_certified(const std::vector<ParameterText> &texts,
                    const std::vector<std::string>   &notes,
                    const std::string                &note_of_ranks)
      {
        RunFolder   folder(options, OneRank::communicator());
        const Input first(program, texts[0]);
        first.validate(program);
        run(first, notes, note_of_ranks, folder);
        open                                            = folder.what_is_open();
        std::vector<std::vector<RunResult>> all_results = {folder.results};
        for (unsigned int k = 1; k < texts.size(); ++k)
          {
            const std::string name = refinements_of_certificate[k].name;
            ParameterText     text = texts[k];
            // The last step may pass the final time, by less if it is shorter.
            if (first.parameters.get({"Time"}, "Until").empty())
              text.assignments.push_back(
                {{"Time", "Final time"}, folder.end_time, "--certify", "."});
            RunFolder::Options own = options;
            own.path =
              (std::filesystem::path(options.path) / "certificate" / name)
                .string();
            own.resume    = false;
            own.overwrite = true;
            own.quiet     = true;
            const Input input(program, text);
            input.validate(program);
            RunFolder finer(own, OneRank::communicator());
            folder.log("certificate: run " + std::to_string(k) + " of " +
                       std::to_string(texts.size() - 1) +
                       ", in the folder certificate/" + name);
            run(input, {}, note_of_ranks, finer);
            for (const std::string &line : finer.what_is_open())
              open.push_back("certificate, " + name + ": " + line);
            all_results.push_back(finer.results);
          }
        const auto bars =
          error_bars({{all_results[0], all_results[1], all_results[2]}});
        for (const std::string &line : lines_of_certificate(bars))
          folder.log(line);
        on_first_rank(folder.communicator, [&]() {
          write_atomically(folder.file("certificate.json"),
                           certificate_as_json(bars, all_results));
        });
        return open;
      }

    private:
      void
      run(const Input                    &input,
          const std::vector<std::string> &notes,
          const std::string              &note_of_ranks,
          RunFolder                      &folder)
      {
        folder.all_parameters = input.all_parameters;
        folder.parameters_that_matter +=
          parameters_that_matter(input.parameters);
        folder.log(program.name + ", " + options.version + ", " +
                   std::to_string(dealii::Utilities::MPI::n_mpi_processes(
                     folder.communicator)) +
                   " MPI rank(s)" + note_of_ranks);
        for (const std::string &note : notes)
          folder.log(note);
        const auto event = [&](const std::string &name) {
          JsonWriter json(/* on one line */ true);
          json.add("event", name);
          json.add("program", program.name);
          json.add("folder", folder.options.path);
          folder.report_progress(json);
        };
        event("begin");
        program.run(folder);
        folder.end();
        event("end");
      }

      void
      run_next(const std::string &note_of_ranks, RunFolder &whole)
      {
        const unsigned int k     = results.size();
        const Phase       &phase = phases[k];
        const Input input(program, text_of_phase(phases, k, options.path));
        const auto  notes      = input.validate(program);
        RunFolder::Options own = options;
        own.path =
          (std::filesystem::path(options.path) / phase.folder).string();
        // Phases that are complete are resumed at their end.
        own.resume =
          options.resume && (k == 0 || RunFolder::has_checkpoint(own.path));
        RunFolder folder(own, OneRank::communicator());
        if (k > 0)
          folder.parameters_that_matter =
            "the phase before it ended with the checkpoint of checksum " +
            std::to_string(
              checksum(read_file(results.back().path + "/checkpoint.bin"))) +
            "\n";
        const std::string what = "phase " + std::to_string(k + 1) + " of " +
          std::to_string(phases.size()) + ": " + phase.name;
        whole.log(what + ", in the folder " + phase.folder);
        const auto add_result = [&]() {
          whole.begin();
          results.push_back({phase.name, own.path, folder.sums});
          program.join_phases(whole, results);
          for (const std::string &line : folder.what_is_open())
            open.push_back(what + ": " + line);
        };
        try
          {
            run(input, notes, note_of_ranks, folder);
          }
        catch (const StoppedBySignal &)
          {
            add_result();
            throw;
          }
        add_result();
      }

      const Program            &program;
      const std::vector<Phase> &phases;
      const RunFolder::Options  options;
      std::vector<PhaseResult>  results;
      std::vector<std::string>  open;
    };



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
      std::unique_ptr<Input>   checked;
      std::vector<std::string> notes;
      std::string              answer, output_dir = command_line.output_dir;
      JsonWriter               json_answer;
      json_answer.add("valid", true);
      json_answer.begin_object("phases");
      for (unsigned int k = 0; k < phases.size(); ++k)
        in_phase(phases[k].name, [&]() {
          checked =
            std::make_unique<Input>(program,
                                    text_of_phase(phases, k, output_dir));
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
          if (phases.size() > 1 &&
              checked->parameters.get({"Output"}, "Checkpoint every") == "0")
            throw InputError(
              "Output/Checkpoint every = 0 cannot be combined "
              "with phases, each of which begins at the last "
              "checkpoint of the one before.");
          if (!command_line.validate_only)
            return;
          const std::string text =
            description(program, notes, command_line.output_dir);
          answer += text;
          json_answer.begin_object(phases[k].name.empty() ? program.name
                                                          : phases[k].name);
          json_answer.add("lines",
                          dealii::Utilities::split_string_list(text, '\n'));
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
      Runs       runs(program,
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
      const auto run = [&](const std::string &note_of_ranks) {
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
