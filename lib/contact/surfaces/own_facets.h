// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_own_facets_h
#define ricochet_contact_surfaces_own_facets_h

#include <contact/surfaces/facet_search.h>

namespace Ricochet
{
  /**
   * The facets of its own surface that a point can touch, in 3D.
   *
   * Excluded are the facets around it: the connected ones, and of its own body
   * those nearby that it was not in front of before any displacement, which are
   * on the far side of its wall or round a corner. Of the others it can touch
   * those that are not oriented as its own surface, and are in front of that,
   * not behind it. Behind a facet a point can only be as far as it can have
   * been pressed in: no deeper than half of the wall there, so that it does not
   * face facets beyond the opposite wall.
   */
  class OwnFacets
  {
  public:
    using Position = std::array<double, 3>;

    /// @p surface is held by reference.
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
    /// For each facet, the largest depth of a point behind it, and its longest
    /// edge (m).
    std::vector<double> largest_depth, longest_edge;
  };
} // namespace Ricochet

#endif
