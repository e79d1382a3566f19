// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_refinement_h
#define ricochet_base_refinement_h

#include <base/parameter_file.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// How often cells and steps of a run are halved.
  struct Refinement
  {
    /// Name of a folder: "cells_2_steps_2".
    std::string  name;
    unsigned int n_of_cells = 0, n_of_steps = 0;
  };

  /**
   * Settings by which a run has cells and steps that are halved, without fields and checkpoints:
   * of each parameter by which a program gives its mesh, and of `Time/Time step`. Also with
   * none to halve, they name each parameter that another refinement changes.
   *
   * @param parameters of the run as it is.
   * @param unused those of them that have no effect.
   * @throws InputError where the program has no time loop, no parameter gives the mesh, or steps
   * are chosen by tolerances.
   */
  std::vector<ParameterText::Assignment>
  refined_parameters(const std::vector<ParameterValue>  &parameters,
                     const std::vector<UnusedParameter> &unused,
                     const Refinement                   &refinement);
} // namespace Ricochet

#endif
