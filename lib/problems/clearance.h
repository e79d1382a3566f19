// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_clearance_h
#define ricochet_problems_clearance_h

#include <contact/obstacles/rigid_obstacle.h>
#include <discretization/body.h>

namespace Ricochet
{
  /**
   * The undeformed @p body and the @p obstacles at time 0 do not overlap. Vertices
   * of the mesh are looked at, and the centre of each obstacle: an overlap at the
   * start would be kept for ever by persistent contact, or push the body away
   * with an energy from nowhere.
   *
   * @throws InputError if they do, or a shape has a problem in a vertex.
   */
  template <int dim>
  void
  check_clearance(const Body<dim> &body, const Obstacles &obstacles);
} // namespace Ricochet

#endif
