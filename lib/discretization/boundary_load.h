// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_boundary_load_h
#define ricochet_discretization_boundary_load_h

#include <discretization/body.h>

namespace Ricochet
{
  /// The forces (N) of a traction of 1 Pa in direction @p component on the undeformed
  /// boundary @p id. Collective.
  template <int dim>
  Vector
  boundary_load(const Body<dim>                 &body,
                const dealii::types::boundary_id id,
                const unsigned int               component);
} // namespace Ricochet

#endif
