// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_plane_state_h
#define ricochet_materials_plane_state_h

namespace Ricochet
{
  /// What a body in two dimensions stands for: the section of a long one, or a
  /// thin sheet.
  enum class PlaneState
  {
    plane_strain,
    plane_stress
  };
} // namespace Ricochet

#endif
