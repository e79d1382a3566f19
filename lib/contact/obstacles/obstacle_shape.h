// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_obstacle_shape_h
#define ricochet_contact_obstacles_obstacle_shape_h

#include <deal.II/base/symmetric_tensor.h>
#include <deal.II/base/tensor.h>

#include <string>

namespace Ricochet
{
  /// The projection on the plane with the unit normal @p normal.
  inline dealii::Tensor<2, 3>
  tangent_plane(const dealii::Tensor<1, 3> &normal)
  {
    return dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) -
      outer_product(normal, normal);
  }

  /// A vector of dim components as one of three.
  template <int dim>
  dealii::Tensor<1, 3>
  in_space(const dealii::Tensor<1, dim> &vector)
  {
    dealii::Tensor<1, 3> result;
    for (unsigned int c = 0; c < dim; ++c)
      result[c] = vector[c];
    return result;
  }

  /**
   * The surface of a rigid obstacle, in a frame that moves with it. Points have
   * three coordinates, of which those beyond the dimension of the problem are
   * zero: a circle is the section of a sphere.
   *
   * Shapes are listed in obstacle_table.cc.
   */
  class ObstacleShape
  {
  public:
    virtual ~ObstacleShape() = default;

    /// Signed distance of @p x to the surface (m), positive where bodies may be.
    virtual double
    gap(const dealii::Tensor<1, 3> &x) const = 0;

    /**
     * A discrete gradient of the gap: a direction with
     *
     *     direction . (end - begin) = gap(end) - gap(begin)
     *
     * to round-off, the same if both points change places, that tends to the
     * gradient where they meet. A contact force along it does the work that
     * belongs to the change of the gap, and has no moment about an axis of
     * symmetry through the obstacle, with the arm in the middle of both points.
     */
    virtual dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> &begin,
                    const dealii::Tensor<1, 3> &end) const = 0;

    /// Derivative of discrete_normal() with respect to @p end (1/m): [i][j] is
    /// that of component i with coordinate j.
    virtual dealii::Tensor<2, 3>
    discrete_normal_derivative(const dealii::Tensor<1, 3> &begin,
                               const dealii::Tensor<1, 3> &end) const = 0;

    /// Gradient of the gap: the unit normal towards the body where the gap is a
    /// distance.
    dealii::Tensor<1, 3>
    normal(const dealii::Tensor<1, 3> &x) const
    {
      return discrete_normal(x, x);
    }

    /// Second derivatives of the gap (1/m). Half of them come from either point
    /// of the discrete gradient.
    dealii::Tensor<2, 3>
    curvature(const dealii::Tensor<1, 3> &x) const
    {
      return 2. * discrete_normal_derivative(x, x);
    }

    /// Rotations that leave the surface unchanged.
    enum class Symmetry
    {
      none,
      /// All rotations about axis() through centre().
      axis,
      /// All rotations about centre().
      point
    };

    virtual Symmetry
    symmetry() const
    {
      return Symmetry::none;
    }

    /// A reference point of the obstacle (m).
    virtual dealii::Tensor<1, 3>
    centre() const
    {
      return {};
    }

    /// Unit vector of the axis of symmetry, if there is one.
    virtual dealii::Tensor<1, 3>
    axis() const
    {
      return {};
    }

    /// The problem of the shape at @p x, as a sentence; empty if there is none.
    virtual std::string
    problem_at(const dealii::Tensor<1, 3> & /*x*/) const
    {
      return "";
    }

    /// The gap is an affine function: its gradient is the same everywhere.
    virtual bool
    is_plane() const
    {
      return false;
    }
  };
} // namespace Ricochet

#endif
