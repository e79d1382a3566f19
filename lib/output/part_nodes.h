// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_part_nodes_h
#define ricochet_output_part_nodes_h

#include <discretization/body.h>

#include <array>
#include <vector>

namespace Ricochet
{
  /// A node of the displacement that this rank owns.
  template <int dim>
  struct PartNode
  {
    /// System indices of its displacements.
    std::array<dealii::types::global_dof_index, dim> indices;
    /// Position in the undeformed body (m).
    dealii::Point<dim> position;
  };

  /// The owned nodes of those of the @p n_parts of @p body from @p begin to before @p end,
  /// see Body::part(); nodes that they share count once.
  template <int dim>
  std::vector<PartNode<dim>>
  nodes_of_parts(const Body<dim>   &body,
                 const unsigned int n_parts,
                 const unsigned int begin,
                 const unsigned int end);
} // namespace Ricochet

#endif
