// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_program_runs_h
#define ricochet_base_program_runs_h

#include <base/phases.h>
#include <base/program.h>
#include <base/program_input.h>
#include <base/run_folder.h>

#include <string>
#include <utility>
#include <vector>

namespace Ricochet
{
  /// The settings of the runs of a certificate. @throws InputError where one of them is not valid.
  std::vector<ParameterText>
  texts_of_certificate(const Program &program, const ParameterText &text);



  /// The program with all that is the same in each phase of a run.
  class ProgramRuns
  {
  public:
    ProgramRuns(const Program            &program,
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
    run_only(const ProgramInput             &input,
             const std::vector<std::string> &notes,
             const std::string              &note_of_ranks);

    /// The phases that are still to be made.
    /// @return what is open. @throws OneRankSuffices to be called again.
    std::vector<std::string>
    run_phases(const std::string &note_of_ranks);

    /// The runs of a certificate, of which @p texts are the settings, and the certificate.
    /// @return what is open. @throws OneRankSuffices to be called again.
    std::vector<std::string>
    run_certified(const std::vector<ParameterText> &texts,
                  const std::vector<std::string>   &notes,
                  const std::string                &note_of_ranks);

  private:
    void
    run(const ProgramInput             &input,
        const std::vector<std::string> &notes,
        const std::string              &note_of_ranks,
        RunFolder                      &folder);

    void
    run_next(const std::string &note_of_ranks, RunFolder &whole);

    const Program            &program;
    const std::vector<Phase> &phases;
    const RunFolder::Options  options;
    std::vector<PhaseResult>  results;
    std::vector<std::string>  open;
  };
} // namespace Ricochet

#endif
