// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_surface_features_h
#define ricochet_contact_surfaces_surface_features_h

#include <contact/surfaces/contact_surface.h>

#include <array>
#include <vector>

namespace Ricochet
{
  /// Features of a surface: its open ends and edges, and where the undeformed surface turns
  /// away from its outside by more than 40 degrees. There a body may enter the facets of
  /// another one between their nodes.
  struct SurfaceFeatures
  {
    /// Whether each node lies on one.
    std::vector<bool> is_on;
    /// In 3D the nodes of the edges between facets, and open ones, that are features, each once.
    std::vector<std::array<unsigned int, 2>> edges;
  };

  template <int dim>
  SurfaceFeatures
  features_of(const ContactSurface<dim> &surface);
} // namespace Ricochet

#endif
