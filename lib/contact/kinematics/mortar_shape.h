// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_mortar_shape_h
#define ricochet_contact_kinematics_mortar_shape_h

namespace Ricochet
{
  /// The weights psi_j with which mortar methods average the gap around a node.
  enum class MortarShape
  {
    /// psi_j is the hat function of the node.
    standard,
    /// psi_j is orthogonal to the hat functions of other nodes (on facets that
    /// face the master as a whole).
    dual
  };
} // namespace Ricochet

#endif
