// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_half_space_h
#define ricochet_contact_obstacles_half_space_h

#include <contact/obstacles/rigid_obstacle.h>

namespace Ricochet
{
  /// The half space behind a plane.
  class HalfSpace : public ObstacleShape
  {
  public:
    /// @param point on the plane (m). @param normal towards the body, of any
    /// length but zero.
    HalfSpace(const dealii::Tensor<1, 3> &point,
              const dealii::Tensor<1, 3> &normal)
      : point(point)
      , unit_normal(normal / normal.norm())
    {}

    double
    gap(const dealii::Tensor<1, 3> &x) const override
    {
      return unit_normal * (x - point);
    }

    dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> & /*begin*/,
                    const dealii::Tensor<1, 3> & /*end*/) const override
    {
      return unit_normal;
    }

    dealii::Tensor<2, 3>
    discrete_normal_derivative(
      const dealii::Tensor<1, 3> & /*begin*/,
      const dealii::Tensor<1, 3> & /*end*/) const override
    {
      return {};
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
      return unit_normal;
    }

    bool
    is_plane() const override
    {
      return true;
    }

  private:
    const dealii::Tensor<1, 3> point, unit_normal;
  };

  /// A half space that does not move: behind the plane through @p point with
  /// @p normal.
  template <int dim>
  std::shared_ptr<const RigidObstacle>
  half_space_at_rest(const dealii::Tensor<1, dim> &point,
                     const dealii::Tensor<1, dim> &normal)
  {
    return std::make_shared<RigidObstacle>(
      std::make_shared<HalfSpace>(in_space(point), in_space(normal)));
  }
} // namespace Ricochet

#endif
