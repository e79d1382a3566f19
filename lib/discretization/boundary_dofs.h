// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_boundary_dofs_h
#define ricochet_discretization_boundary_dofs_h

#include <deal.II/base/index_set.h>
#include <deal.II/dofs/dof_tools.h>

#include <set>

namespace Ricochet
{
  /// The unknowns of the nodes on boundaries with these @p ids.
  template <int dim>
  dealii::IndexSet
  boundary_dofs(const dealii::DoFHandler<dim>              &dofs,
                const std::set<dealii::types::boundary_id> &ids)
  {
    // An empty set of ids means "all boundaries" to deal.II.
    return ids.empty()
      ? dealii::IndexSet(dofs.n_dofs())
      : dealii::DoFTools::extract_boundary_dofs(dofs,
                                                dealii::ComponentMask(),
                                                ids);
  }
} // namespace Ricochet

#endif
