// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/certificate.h>
#include <base/exceptions.h>
#include <base/files.h>
#include <base/json_writer.h>
#include <base/one_rank.h>
#include <base/program_runs.h>
#include <base/refinement.h>

#include <deal.II/base/mpi.h>

#include <filesystem>

namespace Ricochet
{
  std::vector<ParameterText>
  texts_of_certificate(const Program &program, const ParameterText &text)
  {
    const ProgramInput input(program, text);
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
        ProgramInput(program, texts.back()).validate(program);
      }
    return texts;
  }



  std::vector<std::string>
  ProgramRuns::run_only(const ProgramInput             &input,
                        const std::vector<std::string> &notes,
                        const std::string              &note_of_ranks)
  {
    RunFolder folder(options, OneRank::communicator());
    run(input, notes, note_of_ranks, folder);
    return folder.what_is_open();
  }



  std::vector<std::string>
  ProgramRuns::run_phases(const std::string &note_of_ranks)
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



  std::vector<std::string>
  ProgramRuns::run_certified(const std::vector<ParameterText> &texts,
                             const std::vector<std::string>   &notes,
                             const std::string                &note_of_ranks)
  {
    RunFolder          folder(options, OneRank::communicator());
    const ProgramInput first(program, texts[0]);
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
          (std::filesystem::path(options.path) / "certificate" / name).string();
        own.resume    = false;
        own.overwrite = true;
        own.quiet     = true;
        const ProgramInput input(program, text);
        input.validate(program);
        RunFolder finer(own, OneRank::communicator());
        folder.log("certificate: run " + std::to_string(k) + " of " +
                   std::to_string(texts.size() - 1) +
                   ", in the folder certificate/" + name);
        try
          {
            run(input, {}, note_of_ranks, finer);
          }
        catch (const StoppedBySignal &stop)
          {
            throw StoppedBySignal(
              stop.signal,
              "The run itself is complete, its certificate is not: the same command "
              "makes all runs again.");
          }
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



  void
  ProgramRuns::run(const ProgramInput             &input,
                   const std::vector<std::string> &notes,
                   const std::string              &note_of_ranks,
                   RunFolder                      &folder)
  {
    folder.all_parameters = input.all_parameters;
    folder.parameters_that_matter += input.parameters_that_matter();
    folder.log(program.name + ", " + options.version + ", " +
               std::to_string(
                 dealii::Utilities::MPI::n_mpi_processes(folder.communicator)) +
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
  ProgramRuns::run_next(const std::string &note_of_ranks, RunFolder &whole)
  {
    const unsigned int k     = results.size();
    const Phase       &phase = phases[k];
    const ProgramInput input(program, text_of_phase(phases, k, options.path));
    const auto         notes = input.validate(program);
    RunFolder::Options own   = options;
    own.path = (std::filesystem::path(options.path) / phase.folder).string();
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
} // namespace Ricochet
