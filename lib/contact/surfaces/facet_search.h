// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_facet_search_h
#define ricochet_contact_surfaces_facet_search_h

#include <contact/surfaces/contact_surface.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>

namespace Ricochet
{
  /// The facets of a surface at an instant: closest points.
  template <int dim>
  class FacetSearch
  {
  public:
    /// @param positions of the nodes of @p surface (m).
    FacetSearch(const ContactSurface<dim>                  &surface,
                const std::vector<std::array<double, dim>> &positions);

    /// The same with only some of its @p facets, ascending, whose nodes alone need to
    /// have positions.
    FacetSearch(const ContactSurface<dim>                  &surface,
                const std::vector<std::array<double, dim>> &positions,
                const std::vector<unsigned int>            &facets);

    ~FacetSearch();

    /// The facet that is closest to @p y among those whose outward normal points
    /// against @p normal (of any length), the outward one at y; none if there
    /// is no such facet; the first of several.
    ///
    /// @param accept whether a facet may be it at all; empty for all of them.
    /// @param largest_distance facets farther from y are not considered (m).
    /// @param likely is tried first, if it is among the facets: if it is the
    /// closest one, or near to it, few others have to be tried. The result does
    /// not depend on it.
    std::optional<unsigned int>
    closest_facing(
      const std::array<double, dim>                   &y,
      const std::array<double, dim>                   &normal,
      const std::function<bool(const unsigned int f)> &accept = {},
      const double largest_distance = std::numeric_limits<double>::infinity(),
      const std::optional<unsigned int> likely = {}) const;

    /// Facets whose bounding box meets that between @p lower and @p upper, in
    /// ascending order.
    std::vector<unsigned int>
    near(const std::array<double, dim> &lower,
         const std::array<double, dim> &upper) const;

  private:
    struct Groups;
    std::unique_ptr<Groups> all;
  };

  /// Positions of facets of a surface at an instant, each computed at its first
  /// use: closest ones of a few.
  template <int dim>
  class FacetsAround
  {
  public:
    /// @param positions of the nodes of @p surface (m). Both have to outlive this.
    FacetsAround(const ContactSurface<dim>                  &surface,
                 const std::vector<std::array<double, dim>> &positions);

    ~FacetsAround();

    /// As FacetSearch::closest_facing(), but only of @p facets.
    /// @param likely is tried first, if it is one of them.
    std::optional<unsigned int>
    closest_facing(const std::vector<unsigned int>  &facets,
                   const std::array<double, dim>    &y,
                   const std::array<double, dim>    &normal,
                   const std::optional<unsigned int> likely = {});

  private:
    struct Known;
    std::unique_ptr<Known> known;
  };

  /// Outward normal of facet @p f, as long as the facet; in 3D, twice its area.
  template <int dim>
  std::array<double, dim>
  facet_normal(const ContactSurface<dim>                  &surface,
               const std::vector<std::array<double, dim>> &positions,
               const unsigned int                          f);
} // namespace Ricochet

#endif
