// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_clearance_h
#define ricochet_problems_clearance_h

#include <contact/obstacles/rigid_obstacle.h>
#include <contact/surfaces/contact_pair.h>
#include <discretization/body.h>
#include <time_integration/scheme_traits.h>

namespace Ricochet
{
  /// Check that moving @p obstacles are supported by the time @p scheme.
  /// @throws InputError
  void
  check_motions(const SchemeTraits &scheme, const Obstacles &obstacles);

  /**
   * The undeformed @p body and the @p obstacles at time 0 do not overlap. The
   * check takes the vertices of the mesh, and the centre of each obstacle: an
   * initial overlap would persist with persistent contact, or push the body
   * away with an energy from nowhere.
   *
   * @param contact its name, for messages; empty where there is only one.
   * @param only_what_may_touch leave out parts of the body, see Body::part(), that
   * have none of the boundaries.
   * @throws InputError if they do, or a shape has a problem in a vertex.
   */
  template <int dim>
  void
  check_clearance(const Body<dim>   &body,
                  const Obstacles   &obstacles,
                  const std::string &contact             = "",
                  const bool         only_what_may_touch = false);

  /**
   * No facet of a surface of the @p pairs has a node or its middle within another
   * body, or a cell behind it: parts do not overlap before any displacement; they may
   * touch, and overlap by what facets that are chords of an arc are off it. This is set
   * in the pairs.
   *
   * @param takes_overlaps whether such an overlap is allowed.
   * @return what is wrong; empty if all is well. Collective.
   */
  template <int dim>
  std::string
  find_overlaps(const Body<dim>          &body,
                std::vector<ContactPair> &pairs,
                const bool                takes_overlaps);
} // namespace Ricochet

#endif
