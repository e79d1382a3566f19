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
   * the origin. Where both vectors cancel, it is a unit vector perpendicular to
   * them, or any one at the origin: its product with the step is zero.
   */
  namespace RadialDistance
  {
    inline dealii::Tensor<1, 3>
    discrete_gradient(const dealii::Tensor<1, 3> &begin,
                      const dealii::Tensor<1, 3> &end)
    {
      const dealii::Tensor<1, 3> sum = begin + end;
      if (sum != dealii::Tensor<1, 3>())
        return sum / (begin.norm() + end.norm());
      dealii::Tensor<1, 3> across({-end[1], end[0], 0.});
      if (across == dealii::Tensor<1, 3>())
        across[0] = 1.;
      return across / across.norm();
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
      if (length == 0.)
        return {};
      const dealii::Tensor<1, 3> outwards =
        end.norm() > 0. ? end / end.norm() : dealii::Tensor<1, 3>();
      return projection / length -
        outer_product(begin + end, outwards) / (length * length);
    }
  } // namespace RadialDistance
} // namespace Ricochet

#endif
