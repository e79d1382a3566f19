// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_size_limit_h
#define ricochet_problems_size_limit_h

#include <deal.II/base/parameter_handler.h>

namespace Ricochet
{
  /// Limit on the memory of a run. A misprint in a mesh size should end in a
  /// message, and not in a machine that only swaps.
  struct SizeLimit
  {
    /// GB on all ranks together; 0 for four fifths of the machines' memory.
    double memory = 0.;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /**
     * @param n_unknowns number of displacements.
     * @param dim dimension of the body.
     * @param n_steps number of time steps, each a row of the energy table.
     * @param more further memory that is known to be needed (bytes).
     * @throws InputError that names the number of unknowns and the memory, when
     * even a lower bound of it is beyond the limit. Collective.
     */
    void
    check(const double       n_unknowns,
          const unsigned int dim,
          const double       n_steps,
          const double       more = 0.) const;
  };
} // namespace Ricochet

#endif
