// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/obstacles/rigid_obstacle.h>

namespace Ricochet
{
  using dealii::Tensor;

  namespace
  {
    const Tensor<2, 3> identity(dealii::unit_symmetric_tensor<3>());

    /// The shortest rotation of the unit vector @p from to @p to.
    Tensor<2, 3>
    shortest_rotation(const Tensor<1, 3> &from, const Tensor<1, 3> &to)
    {
      // R = I + [w] + [w]^2/(1 + from.to) with w = from x to; in the limit of
      // opposite vectors half a turn about any axis across.
      const Tensor<1, 3> w      = cross_product_3d(from, to);
      const double       cosine = from * to;
      if (!(1. + cosine > 1e-12))
        {
          unsigned int smallest = 0;
          for (unsigned int c = 1; c < 3; ++c)
            if (std::abs(from[c]) < std::abs(from[smallest]))
              smallest = c;
          Tensor<1, 3> across;
          across[smallest] = 1.;
          across -= (across * from) * from;
          across /= across.norm();
          return 2. * outer_product(across, across) - identity;
        }
      Tensor<2, 3> cross;
      cross[0][1] = -w[2];
      cross[0][2] = w[1];
      cross[1][0] = w[2];
      cross[1][2] = -w[0];
      cross[2][0] = -w[1];
      cross[2][1] = w[0];
      return identity + cross + cross * cross / (1. + cosine);
    }
  } // namespace



  RigidObstacle::Step
  RigidObstacle::step(const double begin, const double end) const
  {
    Step step;
    step.material_begin = rigid_motion.placement(begin);
    step.material_end   = rigid_motion.placement(end);
    step.material_rotation_change =
      step.material_end.rotation - step.material_begin.rotation;
    step.begin = step.material_begin;
    step.end   = step.material_end;
    if (!rigid_motion.is_at_rest() &&
        surface->symmetry() != ObstacleShape::Symmetry::none)
      {
        const Tensor<1, 3> centre = surface->centre();
        step.end.rotation =
          surface->symmetry() == ObstacleShape::Symmetry::point
          ? step.begin.rotation
          : shortest_rotation(step.begin.rotation * surface->axis(),
                              step.end.rotation * surface->axis()) *
            step.begin.rotation;
        step.end.translation =
          step.material_end.push_forward(centre) - step.end.rotation * centre;
      }
    step.mean_rotation   = .5 * (step.begin.rotation + step.end.rotation);
    step.rotation_change = step.end.rotation - step.begin.rotation;
    step.mean_translation =
      .5 * (step.begin.translation + step.end.translation);
    step.translation_change = step.end.translation - step.begin.translation;
    return step;
  }



  RigidObstacle::Rows
  RigidObstacle::rows(const Step         &step,
                      const Tensor<1, 3> &old_x,
                      const Tensor<1, 3> &x,
                      const Tensor<1, 3> &way) const
  {
    const Tensor<1, 3> old_point = step.begin.pull_back(old_x);
    const Tensor<1, 3> new_point = step.end.pull_back(x);
    const Tensor<1, 3> discrete_normal =
      surface->discrete_normal(old_point, new_point);
    const Tensor<2, 3> back = transpose(step.end.rotation);

    Rows rows;
    rows.direction            = step.mean_rotation * discrete_normal;
    rows.direction_derivative = step.mean_rotation *
      surface->discrete_normal_derivative(old_point, new_point) * back;
    rows.gap_gradient  = step.end.rotation * surface->normal(new_point);
    rows.gap_increment = rows.direction * (way - step.translation_change) +
      (.5 * (old_x + x) - step.mean_translation) *
        (step.rotation_change * discrete_normal);

    rows.relative_way            = way;
    rows.relative_way_derivative = identity;
    if (!rigid_motion.is_at_rest())
      {
        rows.relative_way -= material_displacement(step, old_x, x);
        rows.relative_way_derivative -= material_displacement_derivative(step);
      }
    return rows;
  }
} // namespace Ricochet
