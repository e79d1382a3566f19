// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_make_folder_h
#define ricochet_output_make_folder_h

#include <base/run_folder.h>

#include <filesystem>

namespace Ricochet
{
  /// Make the folder @p name in that of a run, if need be. Collective. @throws ComputationError
  inline void
  make_folder(const RunFolder &run, const std::string &name)
  {
    on_first_rank(run.communicator, [&]() {
      std::error_code error;
      std::filesystem::create_directories(run.file(name), error);
      if (error)
        throw ComputationError("The folder '" + run.file(name) +
                               "' cannot be made: " + error.message() + ".");
    });
  }
} // namespace Ricochet

#endif
