// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_closest_point_h
#define ricochet_contact_surfaces_closest_point_h

#include <deal.II/base/tensor.h>

#include <algorithm>
#include <array>

namespace Ricochet
{
  inline dealii::Tensor<1, 3>
  to_tensor(const std::array<double, 3> &x)
  {
    return dealii::Tensor<1, 3>({x[0], x[1], x[2]});
  }

  /// Barycentric coordinates of the point of the triangle (a, b, c) that is
  /// closest to @p y. A triangle without area is the longest of its edges.
  inline std::array<double, 3>
  closest_in_triangle(const dealii::Tensor<1, 3> &y,
                      const dealii::Tensor<1, 3> &a,
                      const dealii::Tensor<1, 3> &b,
                      const dealii::Tensor<1, 3> &c)
  {
    // Projection on the plane of the triangle, as a + first (b - a) + second (c
    // - a).
    const dealii::Tensor<1, 3> e1 = b - a, e2 = c - a, r = y - a;
    const double q11 = e1 * e1, q12 = e1 * e2, q22 = e2 * e2, q1 = e1 * r,
                 q2   = e2 * r;
    const double area = q11 * q22 - q12 * q12;
    if (area > 0.)
      {
        const double first  = (q22 * q1 - q12 * q2) / area;
        const double second = (q11 * q2 - q12 * q1) / area;
        if (first >= 0. && second >= 0. && first + second <= 1.)
          return {{1. - first - second, first, second}};
      }
    // Otherwise it is on the closest edge.
    const std::array<dealii::Tensor<1, 3>, 3> corners = {{a, b, c}};
    std::array<double, 3>                     best{};
    double                                    smallest = -1.;
    for (unsigned int v = 0; v < 3; ++v)
      {
        const auto  &from   = corners[v];
        const auto   edge   = corners[(v + 1) % 3] - from;
        const double square = edge.norm_square();
        const double along =
          square > 0. ? std::clamp(edge * (y - from) / square, 0., 1.) : 0.;
        const double distance = (y - from - along * edge).norm_square();
        if (smallest < 0. || distance < smallest)
          {
            smallest          = distance;
            best              = {};
            best[v]           = 1. - along;
            best[(v + 1) % 3] = along;
          }
      }
    return best;
  }
} // namespace Ricochet

#endif
