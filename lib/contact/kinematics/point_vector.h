// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_point_vector_h
#define ricochet_contact_kinematics_point_vector_h

#include <deal.II/base/tensor.h>

namespace Ricochet
{
  /// Observables of a contact point: three components of its displacement (m, on cut
  /// faces relative to the other body), the pressure of the body's own stress, and its
  /// multiplier (Pa); or a generalised force per area on each of them, in the same
  /// order.
  using PointVector = dealii::Tensor<1, 5>;

  /// Derivatives of the generalised forces (rows) with respect to the observables.
  using PointMatrix = dealii::Tensor<2, 5>;

  /// Indices in PointVector behind the displacement.
  namespace PointPlace
  {
    constexpr unsigned int stress_pressure = 3, multiplier = 4;
  }

  /// The displacement in @p observables, or the force on it.
  inline dealii::Tensor<1, 3>
  displacement_of(const PointVector &observables)
  {
    dealii::Tensor<1, 3> displacement;
    for (unsigned int c = 0; c < 3; ++c)
      displacement[c] = observables[c];
    return displacement;
  }

  /// A @p force on the displacement alone, or a displacement.
  inline PointVector
  on_displacement(const dealii::Tensor<1, 3> &force)
  {
    PointVector result;
    for (unsigned int c = 0; c < 3; ++c)
      result[c] = force[c];
    return result;
  }

  /// Derivatives of a force on the displacement with respect to it.
  inline PointMatrix
  on_displacement(const dealii::Tensor<2, 3> &tangent)
  {
    PointMatrix result;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        result[c][d] = tangent[c][d];
    return result;
  }
} // namespace Ricochet

#endif
