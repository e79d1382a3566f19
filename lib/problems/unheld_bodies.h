// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_unheld_bodies_h
#define ricochet_problems_unheld_bodies_h

#include <problems/impact.h>

namespace Ricochet
{
  /// The bodies that conditions (zero or imposed displacements, springs) do not hold in
  /// each direction; parts that share nodes are one body. Whether a body can still turn is
  /// not looked at. Collective.
  template <int dim>
  SemiDiscreteSystem::Unknowns::Unheld
  find_unheld_bodies(const Body<dim> &body, const ImpactSetup<dim> &setup);
} // namespace Ricochet

#endif
