// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/surface_features.h>

#include <deal.II/base/numbers.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  SurfaceFeatures
  features_of(const ContactSurface<dim> &surface)
  {
    // Coarse circles of nine facets have none.
    const double smallest_cosine = std::cos(40. / 180. * numbers::PI);
    const auto   is_convex_edge =
      [&](const unsigned int a, const unsigned int b, const unsigned int at) {
        const auto &facet = surface.facets[a];
        double      front = 0.;
        for (const unsigned int n : surface.facets[b].nodes)
          front += facet.normal *
            (surface.nodes[n].reference_position -
             surface.nodes[at].reference_position);
        return facet.normal * surface.facets[b].normal < smallest_cosine &&
          front < 0.;
      };
    SurfaceFeatures features;
    features.is_on.assign(surface.nodes.size(), false);
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      {
        const auto &facet = surface.facets[f];
        const auto  mark  = [&](const std::optional<unsigned int> &neighbour,
                              const unsigned int                 first,
                              const unsigned int                 second) {
          const unsigned int a = facet.nodes[first], b = facet.nodes[second];
          if (neighbour && !is_convex_edge(f, *neighbour, a))
            return;
          features.is_on[a] = features.is_on[b] = true;
          if (a != b && (!neighbour || f < *neighbour))
            features.edges.push_back({{a, b}});
        };
        if constexpr (dim == 2)
          {
            mark(facet.previous, 0, 0);
            mark(facet.next, 1, 1);
          }
        else if constexpr (dim == 3)
          for (unsigned int e = 0; e < 3; ++e)
            mark(facet.neighbours[e], e, (e + 1) % 3);
      }
    return features;
  }

  template SurfaceFeatures
  features_of(const ContactSurface<1> &);
  template SurfaceFeatures
  features_of(const ContactSurface<2> &);
  template SurfaceFeatures
  features_of(const ContactSurface<3> &);
} // namespace Ricochet
