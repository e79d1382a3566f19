// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_facet_search_h
#define ricochet_contact_surfaces_facet_search_h

#include <contact/surfaces/contact_surface.h>

#include <functional>
#include <limits>
#include <memory>

namespace Ricochet
{
  /// Where the facets of a surface are at an instant: closest points.
  template <int dim>
  class FacetSearch
  {
  public:
    /// @param positions of the nodes of @p surface (m).
    FacetSearch(const ContactSurface<dim>                  &surface,
                const std::vector<std::array<double, dim>> &positions);

    /// The same with only some of its @p facets, whose nodes alone need to have
    /// positions.
    FacetSearch(const ContactSurface<dim>                  &surface,
                const std::vector<std::array<double, dim>> &positions,
                const std::vector<unsigned int>            &facets);

    ~FacetSearch();

    /// The facet that is closest to @p y among those whose outward normal points
    /// against @p normal (of any length), the outward one at y; none if there is no
    /// such facet. Of several the first.
    ///
    /// @param accept whether a facet may be it at all; empty for all of them.
    /// @param largest_distance facets farther from y are not looked at (m).
    std::optional<unsigned int>
    closest_facing(const std::array<double, dim>                   &y,
                   const std::array<double, dim>                   &normal,
                   const std::function<bool(const unsigned int f)> &accept = {},
                   const double largest_distance =
                     std::numeric_limits<double>::infinity()) const;

    /// Facets whose bounding box meets that between @p lower and @p upper, in
    /// ascending order.
    std::vector<unsigned int>
    near(const std::array<double, dim> &lower,
         const std::array<double, dim> &upper) const;

  private:
    struct Groups;
    std::unique_ptr<Groups> all;
  };

  /// As FacetSearch::closest_facing(), but only of @p facets.
  template <int dim>
  std::optional<unsigned int>
  closest_facing_of(const std::vector<unsigned int>            &facets,
                    const ContactSurface<dim>                  &surface,
                    const std::vector<std::array<double, dim>> &positions,
                    const std::array<double, dim>              &y,
                    const std::array<double, dim>              &normal);

  /// Outward normal of facet @p f, as long as the facet; in space, twice its area.
  template <int dim>
  std::array<double, dim>
  facet_normal(const ContactSurface<dim>                  &surface,
               const std::vector<std::array<double, dim>> &positions,
               const unsigned int                          f);
} // namespace Ricochet

#endif
