// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_torus_shape_h
#define ricochet_contact_obstacles_torus_shape_h

#include <contact/obstacles/radial_distance.h>

#include <cmath>

namespace Ricochet
{
  /**
   * A ring: all points that are nearer than the tube's radius to a circle.
   *
   * With the distance rho from the axis and the height z along it, a point is
   * d = sqrt((rho - ring_radius)^2 + z^2) away from the circle. The discrete
   * gradient goes through rho and z and keeps their symmetry:
   *
   *     d_1^2 - d_0^2 = (rho_0 + rho_1 - 2 ring_radius) (rho_1 - rho_0)
   *                     + (z_0 + z_1) (z_1 - z_0).
   */
  class TorusShape : public ObstacleShape
  {
  public:
    /// @param direction of the axis, of any length but zero.
    /// @param ring_radius of the circle (m).
    /// @param tube_radius m
    TorusShape(const dealii::Tensor<1, 3> &centre_point,
               const dealii::Tensor<1, 3> &direction,
               const double                ring_radius,
               const double                tube_radius)
      : centre_point(centre_point)
      , direction(direction / direction.norm())
      , across(tangent_plane(this->direction))
      , ring_radius(ring_radius)
      , tube_radius(tube_radius)
    {}

    double
    gap(const dealii::Tensor<1, 3> &x) const override
    {
      return Place(*this, x).distance - tube_radius;
    }

    dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> &begin,
                    const dealii::Tensor<1, 3> &end) const override
    {
      const Place old_place(*this, begin), new_place(*this, end);
      return ((old_place.excess + new_place.excess) *
                RadialDistance::discrete_gradient(old_place.radial,
                                                  new_place.radial) +
              (old_place.height + new_place.height) * direction) /
        (old_place.distance + new_place.distance);
    }

    dealii::Tensor<2, 3>
    discrete_normal_derivative(const dealii::Tensor<1, 3> &begin,
                               const dealii::Tensor<1, 3> &end) const override
    {
      const Place                old_place(*this, begin), new_place(*this, end);
      const dealii::Tensor<1, 3> radial_normal =
        new_place.radial / new_place.radial.norm();
      const dealii::Tensor<1, 3> end_normal =
        (new_place.excess * radial_normal + new_place.height * direction) /
        new_place.distance;
      return (outer_product(RadialDistance::discrete_gradient(old_place.radial,
                                                              new_place.radial),
                            radial_normal) +
              (old_place.excess + new_place.excess) *
                RadialDistance::derivative(old_place.radial,
                                           new_place.radial,
                                           across) +
              outer_product(direction, direction) -
              outer_product(discrete_normal(begin, end), end_normal)) /
        (old_place.distance + new_place.distance);
    }

    Symmetry
    symmetry() const override
    {
      return Symmetry::axis;
    }

    dealii::Tensor<1, 3>
    centre() const override
    {
      return centre_point;
    }

    dealii::Tensor<1, 3>
    axis() const override
    {
      return direction;
    }

  private:
    /// Position of a point with respect to the circle.
    struct Place
    {
      Place(const TorusShape &torus, const dealii::Tensor<1, 3> &x)
        : radial(torus.across * (x - torus.centre_point))
        , excess(radial.norm() - torus.ring_radius)
        , height(torus.direction * (x - torus.centre_point))
        , distance(std::hypot(excess, height))
      {}

      /// From the axis to the point (m).
      dealii::Tensor<1, 3> radial;
      /// rho - ring_radius (m).
      double excess;
      /// z (m)
      double height;
      /// From the circle (m).
      double distance;
    };

    const dealii::Tensor<1, 3> centre_point, direction;
    const dealii::Tensor<2, 3> across;
    const double               ring_radius, tube_radius;
  };
} // namespace Ricochet

#endif
