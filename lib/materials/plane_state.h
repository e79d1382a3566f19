// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_plane_state_h
#define ricochet_materials_plane_state_h

namespace Ricochet
{
  /// Meaning of a body in 2D: the section of a long one (plane strain), or a
  /// thin sheet (plane stress).
  enum class PlaneState
  {
    plane_strain,
    plane_stress
  };
} // namespace Ricochet

#endif
