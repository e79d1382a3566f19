// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_ghost_flags_h
#define ricochet_discretization_ghost_flags_h

#include <base/types.h>

#include <deal.II/base/index_set.h>

namespace Ricochet
{
  /// Set @p ghosted, a vector with ghost values, to 1 in the unknowns @p mine of
  /// all their owners and to 0 elsewhere. Ghosts must be asked for: the boundary
  /// face of an unknown of a ghost cell may be that of a cell which this rank does
  /// not know. Collective.
  inline void
  flag_with_ghosts(const dealii::IndexSet &mine, Vector &ghosted)
  {
    Vector flags(ghosted.locally_owned_elements(),
                 ghosted.get_mpi_communicator());
    for (const auto i : mine)
      flags(i) = 1.;
    flags.compress(dealii::VectorOperation::insert);
    ghosted = flags;
  }
} // namespace Ricochet

#endif
