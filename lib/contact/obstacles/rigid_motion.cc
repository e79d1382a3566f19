// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/obstacles/rigid_motion.h>

#include <deal.II/physics/transformations.h>

#include <cmath>

namespace Ricochet
{
  using dealii::Tensor;

  RigidMotion::RigidMotion(const std::vector<std::string> &translation,
                           const std::string              &angle,
                           const Tensor<1, 3>             &centre,
                           const Tensor<1, 3>             &axis)
    : centre(centre)
    , axis(axis / axis.norm())
  {
    std::vector<std::string> all = translation;
    all.push_back(angle);
    bool at_rest = true;
    for (const std::string &expression : all)
      at_rest = at_rest && dealii::Utilities::trim(expression) == "0";
    if (!at_rest)
      expressions.emplace("t", all, "an obstacle's motion");
  }



  std::pair<Tensor<1, 3>, double>
  RigidMotion::values(const double time) const
  {
    const Tensor<1, 3> t({time, 0., 0.});
    Tensor<1, 4>       numbers;
    for (unsigned int c = 0; c < 4; ++c)
      {
        numbers[c] = expressions->value(c, t);
        if (!std::isfinite(numbers[c]))
          throw ComputationError(
            "The motion of an obstacle is not finite at t = " + to_text(time) +
            ".");
      }
    return {Tensor<1, 3>({numbers[0], numbers[1], numbers[2]}), numbers[3]};
  }



  Placement
  RigidMotion::placement(const double time) const
  {
    Placement placement;
    if (is_at_rest())
      return placement;
    const auto [translation, angle] = values(time);
    if (angle != 0.)
      placement.rotation =
        dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
          dealii::Point<3>(axis),
          angle);
    placement.translation =
      translation + (centre - placement.rotation * centre);
    return placement;
  }



  double
  RigidMotion::work(const Tensor<1, 3> &force,
                    const Tensor<1, 3> &moment,
                    const double        begin,
                    const double        end) const
  {
    if (is_at_rest())
      return 0.;
    const auto [old_translation, old_angle] = values(begin);
    const auto [new_translation, new_angle] = values(end);
    const Tensor<1, 3> middle =
      centre + .5 * (old_translation + new_translation);
    return force * (new_translation - old_translation) +
      (moment - cross_product_3d(middle, force)) * axis *
      (new_angle - old_angle);
  }
} // namespace Ricochet
