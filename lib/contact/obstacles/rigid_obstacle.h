// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_rigid_obstacle_h
#define ricochet_contact_obstacles_rigid_obstacle_h

#include <contact/obstacles/obstacle_shape.h>
#include <contact/obstacles/rigid_motion.h>

#include <deal.II/base/types.h>

#include <map>
#include <memory>

namespace Ricochet
{
  /**
   * A rigid obstacle: a surface and its prescribed motion.
   *
   * Over a step, with the points X = Q^T (x - c) of the obstacle at which a point
   * of the body begins and ends, the gap changes by D(X_0, X_1) . (X_1 - X_0), D
   * being the discrete gradient of the shape. With
   *
   *     X_1 - X_0 = Q_m^T (dx - dc) + dQ^T (x_m - c_m),
   *
   * m for the mean and d for the difference of both ends, the force acts along
   * Q_m D: its work on the body is that of the gap, and the rest is the work of
   * the obstacle's motion. Only those rotations count that change the surface:
   * a wheel that turns about its axis has the same gap at all angles.
   */
  class RigidObstacle
  {
  public:
    /// @param shape must not be null.
    explicit RigidObstacle(const std::shared_ptr<const ObstacleShape> &shape,
                           const RigidMotion &motion = {})
      : surface(shape)
      , rigid_motion(motion)
    {}

    const ObstacleShape &
    shape() const
    {
      return *surface;
    }

    const RigidMotion &
    motion() const
    {
      return rigid_motion;
    }

    /// Gaps are affine functions of the unknowns, constant in time.
    bool
    is_plane_at_rest() const
    {
      return surface->is_plane() && rigid_motion.is_at_rest();
    }

    /// Gap (m) of the point @p x at @p time (s).
    double
    gap(const dealii::Tensor<1, 3> &x, const double time) const
    {
      return surface->gap(rigid_motion.placement(time).pull_back(x));
    }

    /// Its gradient.
    dealii::Tensor<1, 3>
    normal(const dealii::Tensor<1, 3> &x, const double time) const
    {
      const Placement placement = rigid_motion.placement(time);
      return placement.rotation * surface->normal(placement.pull_back(x));
    }

    /// Positions of the obstacle during a step, common to all points.
    struct Step
    {
      /// Up to rotations that leave the surface as it is.
      Placement begin, end;
      /// Mean and change of these placements.
      dealii::Tensor<2, 3> mean_rotation, rotation_change;
      dealii::Tensor<1, 3> mean_translation, translation_change;
      /// Displacement of the obstacle's material, which drags sticking points.
      Placement            material_begin, material_end;
      dealii::Tensor<2, 3> material_rotation_change;
    };

    /// @throws ComputationError when the motion is not finite.
    Step
    step(const double begin, const double end) const;

    /// Data of a point over a step for contact.
    struct Rows
    {
      /// Direction of the contact force, towards the body; of length one except
      /// for terms of second order in the step.
      dealii::Tensor<1, 3> direction;
      /// Its derivative with respect to the point at the end (1/m).
      dealii::Tensor<2, 3> direction_derivative;
      /// Gradient of the gap at the end.
      dealii::Tensor<1, 3> gap_gradient;
      /// Change of the gap (m), from the displacement increment and not from
      /// both gaps, to avoid cancellation.
      double gap_increment = 0.;
      /// Displacement increment of the point less that of the obstacle's
      /// material there (m).
      dealii::Tensor<1, 3> relative_way;
      /// Its derivative with respect to the point at the end.
      dealii::Tensor<2, 3> relative_way_derivative;
    };

    /// The displacement (m) over @p step of the obstacle's material at a point that is at
    /// @p old_x at the beginning and at @p x at the end.
    dealii::Tensor<1, 3>
    material_displacement(const Step                 &step,
                          const dealii::Tensor<1, 3> &old_x,
                          const dealii::Tensor<1, 3> &x) const
    {
      return step.material_end.translation - step.material_begin.translation +
        step.material_rotation_change *
        (.5 *
         (step.material_begin.pull_back(old_x) +
          step.material_end.pull_back(x)));
    }

    /// Its derivative with respect to @p x.
    dealii::Tensor<2, 3>
    material_displacement_derivative(const Step &step) const
    {
      return .5 * step.material_rotation_change *
        transpose(step.material_end.rotation);
    }

    /// @param old_x the point at the beginning. @param x the point at the end.
    /// @param way displacement increment x - old_x, without the round-off of
    /// the difference.
    Rows
    rows(const Step                 &step,
         const dealii::Tensor<1, 3> &old_x,
         const dealii::Tensor<1, 3> &x,
         const dealii::Tensor<1, 3> &way) const;

  private:
    std::shared_ptr<const ObstacleShape> surface;
    RigidMotion                          rigid_motion;
  };

  /// The obstacle that a part of the boundary can touch, by boundary id.
  using Obstacles =
    std::map<dealii::types::boundary_id, std::shared_ptr<const RigidObstacle>>;
} // namespace Ricochet

#endif
