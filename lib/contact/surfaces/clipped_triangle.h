// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_clipped_triangle_h
#define ricochet_contact_surfaces_clipped_triangle_h

#include <algorithm>
#include <array>
#include <cmath>

namespace Ricochet
{
  /**
   * The part of the triangle (0, 0), (1, 0), (0, 1) that another triangle covers: a
   * convex polygon of up to six corners, found by cutting off what is beyond one edge
   * after the other (I. Sutherland, G. Hodgman, Reentrant polygon clipping, Comm. ACM
   * 17 (1974)).
   *
   * The parts on both sides of a common edge of two triangles fit together to
   * round-off.
   */
  class ClippedTriangle
  {
  public:
    using Point = std::array<double, 2>;

    /// @param corners of the other triangle, in either orientation.
    explicit ClippedTriangle(const std::array<Point, 3> &corners)
    {
      for (const Point &corner : corners)
        polygon[n_corners++] = corner;
      cut_off([](const Point &x) { return x[0]; });
      cut_off([](const Point &x) { return x[1]; });
      cut_off([](const Point &x) { return 1. - x[0] - x[1]; });
      find_moments();
    }

    /// 1; that of the whole triangle is 1/2.
    double
    area() const
    {
      return total;
    }

    /// Only for an #area() that is not zero.
    const Point &
    middle() const
    {
      return centre;
    }

    /**
     * Three points that integrate polynomials of degree 2 exactly over the polygon,
     * each with a third of its area as weight: the corners of the equilateral triangle
     * that has the polygon's moments of inertia once both are stretched to have the same
     * ones in all directions. In a triangle they are on the largest ellipse inside.
     */
    std::array<Point, 3>
    quadrature_points() const
    {
      // The root of the matrix of second moments (Cholesky).
      const double         l11 = std::sqrt(std::max(0., second[0]));
      const double         l21 = l11 > 0. ? second[1] / l11 : 0.;
      const double         l22 = std::sqrt(std::max(0., second[2] - l21 * l21));
      constexpr double     cosine[3] = {1., -.5, -.5};
      const double         sine[3]   = {0., std::sqrt(.75), -std::sqrt(.75)};
      std::array<Point, 3> points;
      for (unsigned int q = 0; q < 3; ++q)
        points[q] = {
          {centre[0] + std::sqrt(2.) * l11 * cosine[q],
           centre[1] + std::sqrt(2.) * (l21 * cosine[q] + l22 * sine[q])}};
      return points;
    }

    /// Whether the point @p x is in the polygon.
    bool
    contains(const Point &x) const
    {
      double least = 0., most = 0.;
      for (unsigned int n = 0; n < n_corners; ++n)
        {
          const Point &a = polygon[n], &b = polygon[(n + 1) % n_corners];
          const double side =
            (b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]);
          least = std::min(least, side);
          most  = std::max(most, side);
        }
      return total > 0. && (least == 0. || most == 0.);
    }

  private:
    /// Keep the part where @p inside, which is linear, is not negative.
    template <typename Linear>
    void
    cut_off(const Linear &inside)
    {
      std::array<Point, most_corners> kept;
      unsigned int                    n_kept = 0;
      for (unsigned int n = 0; n < n_corners; ++n)
        {
          const Point &a = polygon[n], &b = polygon[(n + 1) % n_corners];
          const double at_a = inside(a), at_b = inside(b);
          if (at_a >= 0.)
            kept[n_kept++] = a;
          if ((at_a >= 0.) != (at_b >= 0.))
            {
              // The same for both triangles at an edge: always from the inside.
              const bool   from_a = at_a >= 0.;
              const Point &from = from_a ? a : b, &to = from_a ? b : a;
              const double in   = from_a ? at_a : at_b,
                           out  = from_a ? at_b : at_a;
              const double part = in / (in - out);
              kept[n_kept++]    = {{from[0] + part * (to[0] - from[0]),
                                    from[1] + part * (to[1] - from[1])}};
            }
        }
      polygon   = kept;
      n_corners = n_kept;
    }

    /// Area, centre and second moments about it, of triangles from one corner.
    void
    find_moments()
    {
      double     signed_area = 0.;
      Point      first{};
      const auto for_each_triangle = [&](const auto &action) {
        for (unsigned int n = 2; n < n_corners; ++n)
          {
            const Point &a = polygon[0], &b = polygon[n - 1], &c = polygon[n];
            action(a,
                   b,
                   c,
                   .5 *
                     ((b[0] - a[0]) * (c[1] - a[1]) -
                      (b[1] - a[1]) * (c[0] - a[0])));
          }
      };
      for_each_triangle(
        [&](const Point &a, const Point &b, const Point &c, const double area) {
          signed_area += area;
          for (unsigned int d = 0; d < 2; ++d)
            first[d] += area * (a[d] + b[d] + c[d]) / 3.;
        });
      total = std::abs(signed_area);
      if (!(total > 0.))
        return;
      for (unsigned int d = 0; d < 2; ++d)
        centre[d] = first[d] / signed_area;
      for_each_triangle(
        [&](const Point &a, const Point &b, const Point &c, const double area) {
          const auto moment = [&](const unsigned int d, const unsigned int e) {
            double sum = 0., sum_d = 0., sum_e = 0.;
            for (const Point *x : {&a, &b, &c})
              {
                sum += ((*x)[d] - centre[d]) * ((*x)[e] - centre[e]);
                sum_d += (*x)[d] - centre[d];
                sum_e += (*x)[e] - centre[e];
              }
            return area / 12. * (sum + sum_d * sum_e) / signed_area;
          };
          second[0] += moment(0, 0);
          second[1] += moment(0, 1);
          second[2] += moment(1, 1);
        });
    }

    /// A corner more for each cut, and some for round-off.
    static constexpr unsigned int most_corners = 12;

    std::array<Point, most_corners> polygon;
    unsigned int                    n_corners = 0;
    double                          total     = 0.;
    Point                           centre{};
    /// Entries 11, 12, 22 of the matrix of second moments, over the area.
    std::array<double, 3> second{};
  };
} // namespace Ricochet

#endif
