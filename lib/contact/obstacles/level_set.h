// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_level_set_h
#define ricochet_contact_obstacles_level_set_h

#include <base/expressions.h>
#include <contact/obstacles/obstacle_shape.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The surface on which a function phi is zero, with phi > 0 where bodies may
   * be, given by expressions for it and its gradient. The gap is phi / |grad phi|,
   * which is the distance up to terms of second order in the distance, and so as
   * good as one near the surface.
   *
   * The discrete gradient is that of Gonzalez (J. Nonlinear Sci. 6, 1996): the
   * gradient in the middle, corrected along the step. It keeps energy exactly;
   * a surface of revolution given in this way keeps angular momentum only up to
   * terms of the third order in the step. Second derivatives of phi are
   * differences of the gradient.
   */
  class LevelSet : public ObstacleShape
  {
  public:
    /**
     * @param dim number of coordinates of the expressions, from x, y, z.
     * @param function phi.
     * @param gradient its @p dim derivatives.
     * @param length over which the gradient changes noticeably (m); differences
     * are taken over a thousandth of it.
     * @throws InputError when an expression cannot be read.
     */
    LevelSet(const unsigned int              dim,
             const std::string              &function,
             const std::vector<std::string> &gradient,
             const double                    length);

    double
    gap(const dealii::Tensor<1, 3> &x) const override;

    dealii::Tensor<1, 3>
    discrete_normal(const dealii::Tensor<1, 3> &begin,
                    const dealii::Tensor<1, 3> &end) const override;

    dealii::Tensor<2, 3>
    discrete_normal_derivative(const dealii::Tensor<1, 3> &begin,
                               const dealii::Tensor<1, 3> &end) const override;

    /// Whether the gradient is that of phi, and not zero.
    std::string
    problem_at(const dealii::Tensor<1, 3> &x) const override;

  private:
    /// The gradient as it was given.
    dealii::Tensor<1, 3>
    given_gradient(const dealii::Tensor<1, 3> &x) const;

    /// Gradient of the gap.
    dealii::Tensor<1, 3>
    gap_gradient(const dealii::Tensor<1, 3> &x) const;

    /// Whether the gradient in the middle of a @p step has to be corrected. Its
    /// error falls with the cube of the step and is soon less than round-off,
    /// which the correction divides by the step: a sticking point would be
    /// moved at random.
    bool
    needs_correction(const dealii::Tensor<1, 3> &step) const;

    /// Second derivatives of the gap.
    dealii::Tensor<2, 3>
    gap_hessian(const dealii::Tensor<1, 3> &x) const;

    const unsigned int dim;
    const double       difference_step;
    // phi and its derivatives.
    const Expressions expressions;
  };
} // namespace Ricochet

#endif
