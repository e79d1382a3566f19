// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_own_facets_h
#define ricochet_contact_surfaces_own_facets_h

#include <contact/surfaces/facet_search.h>

namespace Ricochet
{
  /**
   * Which facets of its own surface a point can touch, in space.
   *
   * Not those around it: those that it hangs together with, and of its own body those
   * nearby that it was not in front of before any displacement, which are on the far
   * side of its wall or round a corner. Of the others those that do not face the same
   * way as its own surface, and are before that, not behind it. Behind a facet a point
   * can only be as far as it can have been pressed in: no deeper than half of the wall
   * there, so that it is not before what is beyond the wall opposite.
   */
  class OwnFacets
  {
  public:
    using Position = std::array<double, 3>;

    /// @p surface is kept by reference.
    OwnFacets(const ContactSurface<3> &surface);

    /// The facets around a point that is at @p reference before any displacement (m)
    /// and on @p own facets, which it can never touch; in ascending order.
    std::vector<unsigned int>
    around(const dealii::Point<3>          &reference,
           const std::vector<unsigned int> &own) const;

    /// Whether facet @p f can touch a point at @p y whose outward @p normal has any
    /// length, with nodes at @p positions (m): for facets that are not around it.
    bool
    can_touch(const Position              &y,
              const Position              &normal,
              const unsigned int           f,
              const std::vector<Position> &positions) const;

  private:
    /// The nodes that the corners of facet @p f move with.
    std::vector<unsigned int>
    nodes_of(const unsigned int f) const;

    const ContactSurface<3>               &surface;
    std::vector<std::vector<unsigned int>> facets_at_node;
    std::vector<Position>                  reference_positions;
    FacetSearch<3>                         reference_search;
    /// Of each facet, how deep a point may be behind it, and its longest edge (m).
    std::vector<double> largest_depth, longest_edge;
  };
} // namespace Ricochet

#endif
