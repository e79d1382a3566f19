// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/closing_functionals.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  ContactPointTangent
  open_tangent(const ContactLaw &law, const double cell_diameter)
  {
    ContactPointState<> open;
    open.gap = cell_diameter;
    return law.tangent(open, open, cell_diameter);
  }



  std::optional<Closing>
  closing_directions(const ContactLaw &law, const double cell_diameter)
  {
    ContactPointState<> open, closed;
    open.gap   = cell_diameter;
    closed.gap = -cell_diameter;
    const ContactPointTangent change =
      law.tangent(closed, open, cell_diameter) -
      open_tangent(law, cell_diameter);
    Closing closing;
    while (closing.row < 2 && change[closing.row].norm() == 0.)
      ++closing.row;
    while (closing.column < 2 && change[closing.row][closing.column] == 0.)
      ++closing.column;
    const double entry = change[closing.row][closing.column];
    if (entry == 0.)
      return {};
    // In the same way, so that they are equal to the last digit where the law is
    // symmetric.
    for (unsigned int c = 0; c < 3; ++c)
      {
        closing.trial[c] = change[closing.row][c] / entry;
        closing.test[c]  = change[c][closing.column] / entry;
      }
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(change[c][d] -
                     entry * closing.test[c] * closing.trial[d]) >
            1e-12 * std::abs(change[c][d]))
          return {};
    return closing;
  }



  std::vector<dealii::Tensor<1, 3>>
  directions_along_plane(const dealii::Tensor<1, 3> &normal,
                         const unsigned int          n_axes)
  {
    // The longest projections of the axes.
    dealii::Tensor<2, 3> plane = tangent_plane(normal);
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      for (unsigned int c = n_axes; c < 3; ++c)
        plane[axis][c] = plane[c][axis] = 0.;
    std::vector<dealii::Tensor<1, 3>> directions;
    for (unsigned int t = 0; t + 1 < n_axes; ++t)
      {
        unsigned int longest = 0;
        for (unsigned int axis = 1; axis < n_axes; ++axis)
          if (plane[axis].norm() > plane[longest].norm())
            longest = axis;
        directions.push_back(plane[longest] / plane[longest].norm());
        plane -= outer_product(directions.back(), directions.back());
      }
    return directions;
  }



  ClosingFunctionals::ClosingFunctionals(const ContactLaw    &law,
                                         const bool           with_friction,
                                         const ContactPoints &contact_points)
  {
    Functionals &functionals = acts_through.functionals;
    for (const ContactPoint &point : contact_points.points)
      {
        const auto add = [&](const auto &coefficient) {
          for (unsigned int k = point.begin; k < point.end; ++k)
            if (const double value = coefficient(k); value != 0.)
              functionals.add(contact_points.index[k], value);
          functionals.end_functional();
          acts_through.order.push_back(point.initial_gap);
          return functionals.size() - 1;
        };
        const auto add_law = [&](const dealii::Tensor<1, 3> &direction) {
          return add([&](const unsigned int k) {
            return direction[0] * contact_points.gap_coefficient[k] +
              direction[1] * contact_points.stress_pressure_coefficient[k] +
              direction[2] * contact_points.multiplier_coefficient[k];
          });
        };
        Point own;
        own.closing          = *closing_directions(law, point.cell_diameter);
        own.open_tangent     = open_tangent(law, point.cell_diameter);
        own.test             = add_law(own.closing.test);
        own.trial            = own.closing.trial == own.closing.test
                     ? own.test
                     : add_law(own.closing.trial);
        own.first_tangential = functionals.size();
        if (with_friction)
          {
            unsigned int n_axes = 0;
            for (unsigned int k = point.begin; k < point.end; ++k)
              n_axes = std::max(n_axes, contact_points.component[k] + 1);
            own.tangential =
              directions_along_plane(point.obstacle_normal, n_axes);
            for (const dealii::Tensor<1, 3> &tangential : own.tangential)
              add([&](const unsigned int k) {
                return tangential[contact_points.component[k]] *
                  contact_points.shape_value[k];
              });
          }
        points.push_back(own);
      }
  }
} // namespace Ricochet
