// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_certificate_h
#define ricochet_base_certificate_h

#include <base/error_bars.h>
#include <base/refinement.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// The runs of a certificate: the run itself, all halved once and twice, and each of both
  /// alone, for their parts of the error.
  extern const std::vector<Refinement> refinements_of_certificate;

  /// The text of `certificate.json`. @param results of these runs.
  std::string
  certificate_as_json(const std::vector<ErrorBar>               &bars,
                      const std::vector<std::vector<RunResult>> &results);

  /// The lines of a certificate for the log, without works that do not exist.
  std::vector<std::string>
  lines_of_certificate(const std::vector<ErrorBar> &bars);
} // namespace Ricochet

#endif
