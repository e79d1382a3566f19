// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_sphere_shape_h
#define ricochet_contact_obstacles_sphere_shape_h

#include <contact/obstacles/radial_distance.h>

namespace Ricochet
{
  /// A ball, or its complement: in 2D, a disk or a bowl.
  class SphereShape : public ObstacleShape
  {
  public:
    /// @param radius m
    /// @param hollow the body is inside.
    SphereShape(const dealii::Tensor<1, 3> &centre_point,
                const double                radius,
                const bool                  hollow)
      : centre_point(centre_point)
      , radius(radius)
      , sign(hollow ? -1. : 1.)
    {}

    double
    gap(const dealii::Tensor<1, 3> &x) const override
    {
      return sign * ((x - centre_point).norm() - radius);
    }

    dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> &begin,
                    const dealii::Tensor<1, 3> &end) const override
    {
      return sign *
        RadialDistance::discrete_gradient(begin - centre_point,
                                          end - centre_point);
    }

    dealii::Tensor<2, 3>
    discrete_normal_derivative(const dealii::Tensor<1, 3> &begin,
                               const dealii::Tensor<1, 3> &end) const override
    {
      return sign *
        RadialDistance::derivative(begin - centre_point,
                                   end - centre_point,
                                   dealii::Tensor<2, 3>(
                                     dealii::unit_symmetric_tensor<3>()));
    }

    Symmetry
    symmetry() const override
    {
      return Symmetry::point;
    }

    dealii::Tensor<1, 3>
    centre() const override
    {
      return centre_point;
    }

  private:
    const dealii::Tensor<1, 3> centre_point;
    const double               radius, sign;
  };
} // namespace Ricochet

#endif
