// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_caution_h
#define ricochet_contact_surfaces_caution_h

namespace Ricochet
{
  /// Other derivatives of the part of the way behind a vertex, with which Newton's
  /// method does not go to and fro over it.
  enum class Caution
  {
    none,
    /// None behind a convex vertex, which gives a pressed point a negative stiffness.
    at_convex_vertices,
    /// Behind a concave vertex, in which a point may come to rest, the secant instead
    /// of the tangent, which falls off soon behind the vertex.
    at_all_vertices
  };
} // namespace Ricochet

#endif
