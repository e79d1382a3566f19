// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_own_facets_h
#define ricochet_contact_surfaces_own_facets_h

#include <contact/surfaces/contact_surface.h>

namespace Ricochet
{
  /**
   * Which facets of its own surface a point can touch, in space.
   *
   * Not those that it hangs together with. Of the others those before which it is and
   * that do not face the same way as its own surface; they are before it as well, not
   * behind it, where its own wall is. Behind a facet it can only be as far as it can
   * have been pressed in: no deeper than half of the wall there, so that nothing is
   * before the far side of the wall that it is on, nor, where a tube is pressed flat,
   * before what is beyond the wall opposite.
   */
  class OwnFacets
  {
  public:
    using Position = std::array<double, 3>;

    /// A point of the surface, in the course of a search.
    struct Observer
    {
      /// Before any displacement (m).
      dealii::Point<3> reference;
      /// One of the facets that it is on.
      unsigned int facet;
      /// From beside(): kept by reference.
      const std::vector<unsigned int> &beside;
      /// Now (m), and the outward normal there, of any length.
      const Position &y, &normal;
    };

    /// @p surface is kept by reference.
    OwnFacets(const ContactSurface<3> &surface);

    /// The facets that hang together with the @p facets, and these, in ascending
    /// order. Those around the mean of a quadrilateral are one.
    std::vector<unsigned int>
    beside(const std::vector<unsigned int> &facets) const;

    /// Whether facet @p f can touch the @p point, with nodes at @p positions (m).
    bool
    can_touch(const Observer              &point,
              const unsigned int           f,
              const std::vector<Position> &positions) const;

  private:
    /// The nodes that the corners of facet @p f move with.
    std::vector<unsigned int>
    nodes_of(const unsigned int f) const;

    const ContactSurface<3>               &surface;
    std::vector<std::vector<unsigned int>> facets_at_node;
    std::vector<Position>                  reference_positions;
    /// Of each facet, how deep a point may be behind it (m).
    std::vector<double> largest_depth;
  };
} // namespace Ricochet

#endif
