// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_rigid_motion_h
#define ricochet_contact_obstacles_rigid_motion_h

#include <base/expressions.h>

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <optional>
#include <string>
#include <vector>

namespace Ricochet
{
  /// Position of a rigid obstacle: a point X of it is at rotation X +
  /// translation.
  struct Placement
  {
    dealii::Tensor<2, 3> rotation =
      dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
    dealii::Tensor<1, 3> translation;

    /// The point of the obstacle that is at @p x.
    dealii::Tensor<1, 3>
    pull_back(const dealii::Tensor<1, 3> &x) const
    {
      return (x - translation) * rotation;
    }

    /// Position of the point @p X of the obstacle.
    dealii::Tensor<1, 3>
    push_forward(const dealii::Tensor<1, 3> &X) const
    {
      return rotation * X + translation;
    }
  };

  /**
   * The prescribed motion of a rigid obstacle: a rotation about an axis through a
   * point of the obstacle, and a translation of that point, as expressions of the
   * time t. At t = 0 both may be anything.
   */
  class RigidMotion
  {
  public:
    /// At rest.
    RigidMotion() = default;

    /**
     * @param translation three expressions (m).
     * @param angle (rad)
     * @param centre the point about which the obstacle turns, in the given
     * position of the shape (m).
     * @param axis of any length but zero.
     * @throws InputError when an expression cannot be read.
     */
    RigidMotion(const std::vector<std::string> &translation,
                const std::string              &angle,
                const dealii::Tensor<1, 3>     &centre,
                const dealii::Tensor<1, 3>     &axis);

    /// Whether there is a motion.
    bool
    is_at_rest() const
    {
      return !expressions;
    }

    /// @throws ComputationError when the motion is not finite.
    Placement
    placement(const double time) const;

    /**
     * The work (J) of a force (N) and its moment about the origin (N m) on the
     * obstacle from @p begin to @p end (s), if both are constant: force times
     * the displacement of the centre, plus moment about the centre, in the
     * middle of its displacement, times angle.
     */
    double
    work(const dealii::Tensor<1, 3> &force,
         const dealii::Tensor<1, 3> &moment,
         const double                begin,
         const double                end) const;

  private:
    /// Translation and angle. @throws ComputationError
    std::pair<dealii::Tensor<1, 3>, double>
    values(const double time) const;

    // Translation and angle; none at rest.
    std::optional<Expressions> expressions;
    dealii::Tensor<1, 3>       centre, axis;
  };
} // namespace Ricochet

#endif
