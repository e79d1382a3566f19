// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_nearest_vertex_h
#define ricochet_discretization_nearest_vertex_h

#include <discretization/body.h>

#include <vector>

namespace Ricochet
{
  /// Whether @p a is nearer than @p b to @p point or, where both are as near to nine digits,
  /// has the lower coordinates, of which x counts first: the same vertex on any mesh and
  /// any number of ranks.
  template <int dim>
  bool
  is_nearer(const dealii::Point<dim> &a,
            const dealii::Point<dim> &b,
            const dealii::Point<dim> &point);

  /// System indices of the displacements of the vertex that is nearest to @p point, by
  /// is_nearer(), among those of the parts from @p begin to before @p end, of @p n_parts (see
  /// Body::part()): on the rank that owns them, empty on all others. Collective.
  template <int dim>
  std::vector<dealii::types::global_dof_index>
  unknowns_of_nearest_vertex(const Body<dim>          &body,
                             const dealii::Point<dim> &point,
                             const unsigned int        n_parts,
                             const unsigned int        begin,
                             const unsigned int        end);
} // namespace Ricochet

#endif
