// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_boundary_load_h
#define ricochet_discretization_boundary_load_h

#include <discretization/body.h>

#include <functional>

namespace Ricochet
{
  /// Functor that adds the forces (N) of the @p traction (Pa), at a time (s)
  /// and a position (m), on the undeformed boundary @p id to a vector.
  /// Collective.
  template <int dim>
  std::function<void(const double time, Vector &load)>
  boundary_load(
    const Body<dim>                 &body,
    const dealii::types::boundary_id id,
    const std::function<dealii::Tensor<1, dim>(const double              time,
                                               const dealii::Point<dim> &place)>
      &traction);
} // namespace Ricochet

#endif
