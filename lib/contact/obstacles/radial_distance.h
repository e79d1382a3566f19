// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_radial_distance_h
#define ricochet_contact_obstacles_radial_distance_h

#include <contact/obstacles/obstacle_shape.h>

namespace Ricochet
{
  /**
   * The length |r| of a vector, over a step from @p begin to @p end: since
   * |end|^2 - |begin|^2 = (end + begin) . (end - begin), the direction
   *
   *     (begin + end) / (|begin| + |end|)
   *
   * is a discrete gradient of it without any division by the step. It points
   * along the mean of both vectors, so that a force along it has no moment about
   * the origin.
   */
  namespace RadialDistance
  {
    inline dealii::Tensor<1, 3>
    discrete_gradient(const dealii::Tensor<1, 3> &begin,
                      const dealii::Tensor<1, 3> &end)
    {
      return (begin + end) / (begin.norm() + end.norm());
    }

    /// Derivative of discrete_gradient() with respect to a point of which
    /// @p end is the projection by @p projection (the identity, or across an
    /// axis).
    inline dealii::Tensor<2, 3>
    derivative(const dealii::Tensor<1, 3> &begin,
               const dealii::Tensor<1, 3> &end,
               const dealii::Tensor<2, 3> &projection)
    {
      const double length = begin.norm() + end.norm();
      return projection / length -
        outer_product(begin + end, end / end.norm()) / (length * length);
    }
  } // namespace RadialDistance
} // namespace Ricochet

#endif
