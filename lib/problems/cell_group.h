// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_cell_group_h
#define ricochet_problems_cell_group_h

#include <discretization/curved_geometry.h>

#include <deal.II/grid/tria.h>

namespace Ricochet
{
  /// Take all cells but those with the material id @p id out of @p cells, which are not refined,
  /// and out of @p nodes (empty for straight cells). Faces where the others were have the
  /// boundary id 0; nodes that both had are those of the group alone.
  template <int dim>
  void
  keep_cells_of(const dealii::types::material_id id,
                dealii::Triangulation<dim>      &cells,
                CellNodes<dim>                  &nodes);
} // namespace Ricochet

#endif
