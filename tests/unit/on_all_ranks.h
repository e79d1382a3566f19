// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_on_all_ranks_h
#define ricochet_tests_unit_on_all_ranks_h

#include <problems/impact_parameters.h>

namespace Ricochet
{
  /// Parameters of an impact on all MPI ranks, also where one of them would be faster.
  inline ImpactParameters
  on_all_ranks()
  {
    ImpactParameters parameters;
    parameters.linear_solver.distribute = true;
    return parameters;
  }
} // namespace Ricochet

#endif
