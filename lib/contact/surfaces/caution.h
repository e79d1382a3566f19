// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_caution_h
#define ricochet_contact_surfaces_caution_h

namespace Ricochet
{
  /// Modified derivatives of the part of the displacement behind a vertex, with
  /// which Newton's method does not oscillate across it.
  enum class Caution
  {
    none,
    /// None behind a convex vertex, which gives a pressed point a negative stiffness, nor of the
    /// weights at rounded vertices and edges.
    at_convex_vertices,
    /// Secant behind a concave vertex, in which a point may come to rest,
    /// instead of the tangent, which decays soon behind the vertex.
    at_all_vertices
  };
} // namespace Ricochet

#endif
