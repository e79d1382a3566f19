// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_cylinder_shape_h
#define ricochet_contact_obstacles_cylinder_shape_h

#include <contact/obstacles/radial_distance.h>

namespace Ricochet
{
  /// An infinite round bar, or its complement: a tube or a drum.
  class CylinderShape : public ObstacleShape
  {
  public:
    /// @param point on the axis (m).
    /// @param direction of the axis, of any length but zero.
    /// @param radius m
    /// @param hollow the body is inside.
    CylinderShape(const dealii::Tensor<1, 3> &point,
                  const dealii::Tensor<1, 3> &direction,
                  const double                radius,
                  const bool                  hollow)
      : point(point)
      , direction(direction / direction.norm())
      , across(tangent_plane(this->direction))
      , radius(radius)
      , sign(hollow ? -1. : 1.)
    {}

    double
    gap(const dealii::Tensor<1, 3> &x) const override
    {
      return sign * ((across * (x - point)).norm() - radius);
    }

    dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> &begin,
                    const dealii::Tensor<1, 3> &end) const override
    {
      return sign *
        RadialDistance::discrete_gradient(across * (begin - point),
                                          across * (end - point));
    }

    dealii::Tensor<2, 3>
    discrete_normal_derivative(const dealii::Tensor<1, 3> &begin,
                               const dealii::Tensor<1, 3> &end) const override
    {
      return sign *
        RadialDistance::derivative(across * (begin - point),
                                   across * (end - point),
                                   across);
    }

    Symmetry
    symmetry() const override
    {
      return Symmetry::axis;
    }

    dealii::Tensor<1, 3>
    centre() const override
    {
      return point;
    }

    dealii::Tensor<1, 3>
    axis() const override
    {
      return direction;
    }

  private:
    const dealii::Tensor<1, 3> point, direction;
    const dealii::Tensor<2, 3> across;
    const double               radius, sign;
  };
} // namespace Ricochet

#endif
