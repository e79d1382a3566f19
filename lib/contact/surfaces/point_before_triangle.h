// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_point_before_triangle_h
#define ricochet_contact_surfaces_point_before_triangle_h

#include <contact/surfaces/discrete_scalar.h>

#include <array>
#include <cmath>

namespace Ricochet
{
  /// Gap and slip of a point over a step, with their rows on @p n coordinates.
  template <typename Number, unsigned int n>
  struct RowsOfPoint
  {
    /// Gap at the end of the step (m).
    Number new_gap{};
    /// D . change, which is new gap - old gap (m).
    Number gap_increment{};
    /// T . change: sliding distance of the point along the initial triangle
    /// (m).
    std::array<Number, 2> slip{};
    /// D and T, 1.
    std::array<Number, n>                normal{};
    std::array<std::array<Number, n>, 2> tangential{};
  };

  /**
   * Contact of a point y with a triangle (a, b, c), all of which move: the gap, and the
   * directions along which forces on them have to act over a step.
   *
   * With e_1 = b - a, e_2 = c - a, r = y - a the gap is the distance from the
   * triangle's plane, g = V / sqrt(B), where V = det(e_1, e_2, r) and
   * B = q_11 q_22 - q_12^2, and the projection of the point on the plane is a +
   * xi_1 e_1 + xi_2 e_2, where xi follows from the products q_ij = w_i . w_j of
   * w = (e_1, e_2, r). These are quadratic, so that their gradients in the
   * middle of a step are their quotients of differences; V is cubic, and
   * det(change of w) / 4 is missing:
   *
   *     D_V = grad V + det(change of w)/4 (sum change(q_ij) grad q_ij + v grad V / l^2)
   *                                       / (sum change(q_ij)^2 + v^2 / l^2),
   *
   * with v = grad V . change and l^2 = mean sqrt(B); gradients in the middle of the step.
   * The terms with v keep it bounded when a point passes to its mirror image while the
   * triangle turns. By the rules for products, quotients and roots there are then rows D
   * and T_1, T_2 with D . change = g_1 - g_0 and T . change = sqrt(metric) (xi_1 - xi_0),
   * exactly. All functions are invariant under a rigid motion of all points
   * together: the sum of the forces along a row is zero, and so is that of
   * their moments.
   *
   * @tparam Number type of the new values: double, or one for automatic
   * differentiation.
   */
  template <typename Number>
  class PointBeforeTriangle
  {
  public:
    /// Coordinates of y, a, b, c, one point after the other.
    static constexpr unsigned int n_coordinates = 12;

    template <typename T>
    using Points = std::array<std::array<T, 3>, 4>;

    /// Rows on the coordinates.
    using Row = std::array<Number, n_coordinates>;

    using Rows = RowsOfPoint<Number, n_coordinates>;

    /// Positions of y, a, b, c at the beginning of a step and at its end (m).
    /// @param needs_slip otherwise slip and T are left as they are.
    static void
    evaluate(const Points<double> &old_x,
             const Points<Number> &new_x,
             Rows                 &rows,
             const bool            needs_slip = true)
    {
      const Step   step(old_x, new_x);
      const Scalar q11 = step.product(0, 0), q12 = step.product(0, 1),
                   q22 = step.product(1, 1), q13 = step.product(0, 2),
                   q23 = step.product(1, 2), q33 = step.product(2, 2);
      const Scalar square_of_area = q11 * q22 - q12 * q12;
      const Scalar area           = sqrt(square_of_area);
      const Scalar volume =
        step.volume({{&q11, &q12, &q22, &q13, &q23, &q33}}, area);
      const Scalar gap   = volume / area;
      rows.normal        = gap.row;
      rows.new_gap       = gap.new_value;
      rows.gap_increment = step.times_change(rows.normal);
      if (!needs_slip)
        return;

      const Scalar first  = (q22 * q13 - q12 * q23) / square_of_area;
      const Scalar second = (q11 * q23 - q12 * q13) / square_of_area;
      const auto   metric = step.root_of_metric();
      for (unsigned int i = 0; i < n_coordinates; ++i)
        for (unsigned int d = 0; d < 2; ++d)
          rows.tangential[d][i] =
            metric[d] * first.row[i] + metric[d + 1] * second.row[i];

      for (unsigned int d = 0; d < 2; ++d)
        rows.slip[d] = step.times_change(rows.tangential[d]);
    }

    using Scalar = DiscreteScalar<Number, n_coordinates>;

    /// The distance from the plane, and those of the projection on it from the lines of the
    /// edges ab, bc and ca, positive inside of the triangle (m).
    static void
    distances(const Points<double>  &old_x,
              const Points<Number>  &new_x,
              Scalar                &gap,
              std::array<Scalar, 3> &from_edges)
    {
      const Step   step(old_x, new_x);
      const Scalar q11 = step.product(0, 0), q12 = step.product(0, 1),
                   q22 = step.product(1, 1), q13 = step.product(0, 2),
                   q23 = step.product(1, 2), q33 = step.product(2, 2);
      const Scalar square_of_area = q11 * q22 - q12 * q12;
      const Scalar area           = sqrt(square_of_area);
      gap = step.volume({{&q11, &q12, &q22, &q13, &q23, &q33}}, area) / area;
      // Products of area and twice the area between an edge and the projection.
      const Scalar at_ca = q22 * q13 - q12 * q23, at_ab = q11 * q23 - q12 * q13;
      from_edges[0] = at_ab / (area * sqrt(q11));
      from_edges[1] =
        (square_of_area - at_ab - at_ca) / (area * sqrt(q11 + q22 - q12 - q12));
      from_edges[2] = at_ca / (area * sqrt(q22));
    }

    /// The distances from the edges, as of distances(), at one state (m).
    static std::array<double, 3>
    distances_from_edges(const Points<double> &x)
    {
      const auto            w      = edges(x);
      const auto            normal = cross(w[0], w[1]);
      const double          area   = std::sqrt(dot(normal, normal));
      std::array<double, 3> result;
      for (unsigned int k = 0; k < 3; ++k)
        {
          Vector3<double> edge, r;
          for (unsigned int c = 0; c < 3; ++c)
            {
              edge[c] = x[1 + (k + 1) % 3][c] - x[1 + k][c];
              r[c]    = x[0][c] - x[1 + k][c];
            }
          result[k] =
            dot(normal, cross(edge, r)) / (area * std::sqrt(dot(edge, edge)));
        }
      return result;
    }

    /// The distance from the plane (m).
    template <typename T>
    static T
    gap(const Points<T> &x)
    {
      using std::sqrt;
      const auto w      = edges(x);
      const auto normal = cross(w[0], w[1]);
      return dot(normal, w[2]) / sqrt(dot(normal, normal));
    }

    /// The sine of the angle by which the surface turns from the triangle (a, b, c) to
    /// (b, a, y), beyond the edge from a to b: positive at a concave edge.
    static DiscreteScalar<Number, n_coordinates>
    sine(const Points<double> &old_x, const Points<Number> &new_x)
    {
      const Step   step(old_x, new_x);
      const Scalar q11 = step.product(0, 0), q12 = step.product(0, 1),
                   q22 = step.product(1, 1), q13 = step.product(0, 2),
                   q23 = step.product(1, 2), q33 = step.product(2, 2);
      const Scalar first  = sqrt(q11 * q22 - q12 * q12),
                   second = sqrt(q11 * q33 - q13 * q13);
      return sqrt(q11) *
        step.volume({{&q11, &q12, &q22, &q13, &q23, &q33}}, first) /
        (first * second);
    }

    template <typename T>
    using Vector3 = std::array<T, 3>;

    template <typename T>
    static T
    dot(const Vector3<T> &a, const Vector3<T> &b)
    {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    }

    template <typename T>
    static Vector3<T>
    cross(const Vector3<T> &a, const Vector3<T> &b)
    {
      return {{a[1] * b[2] - a[2] * b[1],
               a[2] * b[0] - a[0] * b[2],
               a[0] * b[1] - a[1] * b[0]}};
    }

    /// e_1, e_2, r.
    template <typename T>
    static std::array<Vector3<T>, 3>
    edges(const Points<T> &x)
    {
      std::array<Vector3<T>, 3> w;
      for (unsigned int c = 0; c < 3; ++c)
        {
          w[0][c] = x[2][c] - x[1][c];
          w[1][c] = x[3][c] - x[1][c];
          w[2][c] = x[0][c] - x[1][c];
        }
      return w;
    }

  private:
    /// Terms of the functions.
    struct Step
    {
      Step(const Points<double> &old_x, const Points<Number> &new_x)
        : old_x(old_x)
        , new_x(new_x)
        , old_w(edges(old_x))
        , new_w(edges(new_x))
      {
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int c = 0; c < 3; ++c)
            {
              mean_w[i][c]   = .5 * (old_w[i][c] + new_w[i][c]);
              change_w[i][c] = new_w[i][c] - old_w[i][c];
            }
      }

      /// Add the derivative with respect to w_i in the direction of @p row.
      static void
      add(Row &row, const unsigned int i, const Vector3<Number> &derivative)
      {
        // w_0, w_1, w_2 go from a to b, c, y.
        const unsigned int to = i == 2 ? 0 : 3 * (i + 2);
        for (unsigned int c = 0; c < 3; ++c)
          {
            row[to + c] += derivative[c];
            row[3 + c] -= derivative[c];
          }
      }

      /// q_ij
      DiscreteScalar<Number, n_coordinates>
      product(const unsigned int i, const unsigned int j) const
      {
        DiscreteScalar<Number, n_coordinates> q;
        q.old_value = dot(old_w[i], old_w[j]);
        q.new_value = dot(new_w[i], new_w[j]);
        add(q.row, i, mean_w[j]);
        add(q.row, j, mean_w[i]);
        return q;
      }

      /// V
      DiscreteScalar<Number, n_coordinates>
      volume(
        const std::array<const DiscreteScalar<Number, n_coordinates> *, 6> &q,
        const DiscreteScalar<Number, n_coordinates> &area) const
      {
        DiscreteScalar<Number, n_coordinates> result;
        result.old_value = dot(cross(old_w[0], old_w[1]), old_w[2]);
        result.new_value = dot(cross(new_w[0], new_w[1]), new_w[2]);
        Row gradient{};
        add(gradient, 0, cross(mean_w[1], mean_w[2]));
        add(gradient, 1, cross(mean_w[2], mean_w[0]));
        add(gradient, 2, cross(mean_w[0], mean_w[1]));
        const Number v = times_change(gradient);
        const Number missing =
          .25 * dot(cross(change_w[0], change_w[1]), change_w[2]);
        const Number per_length = 1. / (.5 * (area.old_value + area.new_value));
        Number       sum        = v * v * per_length;
        for (const auto *one : q)
          sum += one->change() * one->change();
        result.row = gradient;
        if (sum > 0.)
          {
            const Number factor      = missing / sum;
            const Number of_gradient = factor * v * per_length;
            for (unsigned int i = 0; i < n_coordinates; ++i)
              {
                result.row[i] += of_gradient * gradient[i];
                for (const auto *one : q)
                  result.row[i] += factor * one->change() * one->row[i];
              }
          }
        return result;
      }

      /// The root of the matrix e_a . e_b in the middle of the step: entries 11, 12,
      /// 22.
      std::array<Number, 3>
      root_of_metric() const
      {
        using std::sqrt;
        const Number a11   = dot(mean_w[0], mean_w[0]),
                     a12   = dot(mean_w[0], mean_w[1]),
                     a22   = dot(mean_w[1], mean_w[1]);
        const Number root  = sqrt(a11 * a22 - a12 * a12);
        const Number scale = 1. / sqrt(a11 + a22 + 2. * root);
        return {{(a11 + root) * scale, a12 * scale, (a22 + root) * scale}};
      }

      Number
      times_change(const Row &row) const
      {
        Number sum = 0.;
        for (unsigned int p = 0; p < 4; ++p)
          for (unsigned int c = 0; c < 3; ++c)
            sum += row[3 * p + c] * (new_x[p][c] - old_x[p][c]);
        return sum;
      }

      const Points<double>                &old_x;
      const Points<Number>                &new_x;
      const std::array<Vector3<double>, 3> old_w;
      const std::array<Vector3<Number>, 3> new_w;
      std::array<Vector3<Number>, 3>       mean_w, change_w;
    };
  };
} // namespace Ricochet

#endif
