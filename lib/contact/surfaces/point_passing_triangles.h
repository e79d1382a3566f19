// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_point_passing_triangles_h
#define ricochet_contact_surfaces_point_passing_triangles_h

#include <contact/surfaces/caution.h>
#include <contact/surfaces/point_before_triangle.h>

#include <optional>
#include <type_traits>

namespace Ricochet
{
  /// The common edge of two triangles, by numbers of their corners (0 to 2).
  struct SharedEdge
  {
    /// Corner of the first triangle at which the edge begins.
    unsigned int begin = 0;
    /// Corner of the second triangle that is not on the edge.
    unsigned int opposite = 0;
  };

  /**
   * Contact of a point that faces one triangle at the beginning of a step and
   * another one at its end: the gap, and the directions along which forces have
   * to act over the step, so that its increment is the new gap to the second
   * triangle less the old gap to the first (in 2D: FacetChain).
   *
   * The planes of triangles with a common edge are equally far from a point on
   * the bisector of their angle. With the unit normals n_1, n_2, the unit
   * vector e along the edge and the bisector's coordinate t = (e x (n_1 + n_2))
   * . (y - a) / (1 + n_1 . n_2), negative on the side of the first triangle,
   * the distances differ by g_2 - g_1 = -sine t, where sine is that of the
   * angle by which the surface turns (positive at a concave edge). With theta =
   * t_1 / (t_1 - t_0), the part of the displacement behind the bisector, and
   * the rows D_1, D_2 of both triangles (see PointBeforeTriangle),
   *
   *     D = D_1 + theta (D_2 - D_1) + t_0 theta D_sine
   *
   * has D . change = g_2(new) - g_1(old), exactly, where D_sine is the discrete gradient
   * of sine = |edge| V / (|N_1| |N_2|), V the volume between both triangles.
   *
   * Triangles with no more than a node in common have no such bisector; where
   * the difference h = g_2 - g_1 changes its sign during the step, theta = h_1
   * / (h_1 - h_0) does without the last term.
   *
   * @tparam Number type of the new values: double, or one for automatic
   * differentiation.
   */
  template <typename Number>
  class PointPassingTriangles
  {
  public:
    static constexpr unsigned int n_points      = 7;
    static constexpr unsigned int n_coordinates = 3 * n_points;

    /// The point, the corners of the first triangle and those of the second.
    template <typename T>
    using Points = std::array<std::array<T, 3>, n_points>;

    using Rows = RowsOfPoint<Number, n_coordinates>;

    /**
     * Positions at the beginning of a step and at its end (m).
     *
     * @param edge none if the triangles have no common edge.
     */
    static void
    evaluate(const Points<double>            &old_x,
             const Points<Number>            &new_x,
             const std::optional<SharedEdge> &edge,
             const Caution                    caution,
             Rows                            &rows)
    {
      rows = {};
      typename Single::Rows first, second;
      Single::evaluate(before(old_x, 0), before(new_x, 0), first);
      Single::evaluate(before(old_x, 1), before(new_x, 1), second);

      const double old_way = edge ? past_edge(old_x, *edge) : difference(old_x);
      const Number new_way = edge ? past_edge(new_x, *edge) : difference(new_x);
      Number       part    = new_way / (new_way - old_way);
      if constexpr (!std::is_same<Number, double>::value)
        {
          // See FacetChain.
          const bool is_convex =
            difference(old_x) * (edge ? old_way : 1.) > 0. || !edge;
          if (is_convex && caution != Caution::none)
            part = Number(part.val());
          else if (!is_convex && caution == Caution::at_all_vertices)
            part =
              Number(part.val() +
                     (new_way - new_way.val()) / (new_way.val() - old_way));
        }
      add(first.normal, 1. - part, {{0, 1, 2, 3}}, rows.normal);
      add(second.normal, part, {{0, 4, 5, 6}}, rows.normal);
      if (edge)
        {
          const std::array<unsigned int, 4> places = around_edge(*edge);
          add(Single::sine(pick(old_x, places), pick(new_x, places)).row,
              old_way * part,
              places,
              rows.normal);
        }
      for (unsigned int d = 0; d < 2; ++d)
        add(first.tangential[d],
            Number(1.),
            {{0, 1, 2, 3}},
            rows.tangential[d]);

      rows.slip          = first.slip;
      rows.new_gap       = second.new_gap;
      rows.gap_increment = 0.;
      for (unsigned int i = 0; i < n_coordinates; ++i)
        rows.gap_increment +=
          rows.normal[i] * (new_x[i / 3][i % 3] - old_x[i / 3][i % 3]);
    }

    /// t (m), see above: negative on the side of the first triangle.
    template <typename T>
    static T
    past_edge(const Points<T> &x, const SharedEdge &edge)
    {
      using std::sqrt;
      using Geometry    = PointBeforeTriangle<T>;
      const auto places = around_edge(edge);
      const auto w      = Geometry::edges(pick(x, places));
      const auto n1     = Geometry::cross(w[0], w[1]),
                 n2     = Geometry::cross(w[2], w[0]);
      const T area1     = sqrt(Geometry::dot(n1, n1)),
              area2     = sqrt(Geometry::dot(n2, n2));
      typename std::array<T, 3> sum, r;
      for (unsigned int c = 0; c < 3; ++c)
        {
          sum[c] = n1[c] / area1 + n2[c] / area2;
          r[c]   = x[0][c] - x[places[1]][c];
        }
      return Geometry::dot(Geometry::cross(w[0], sum), r) /
        (sqrt(Geometry::dot(w[0], w[0])) *
         (1. + Geometry::dot(n1, n2) / (area1 * area2)));
    }

    /// The distance from the plane of the second triangle less that from the first's
    /// (m).
    template <typename T>
    static T
    difference(const Points<T> &x)
    {
      using Geometry = PointBeforeTriangle<T>;
      return Geometry::gap(before(x, 1)) - Geometry::gap(before(x, 0));
    }

  private:
    using Single = PointBeforeTriangle<Number>;

    template <typename T>
    static std::array<std::array<T, 3>, 4>
    pick(const Points<T> &x, const std::array<unsigned int, 4> &places)
    {
      return {{x[places[0]], x[places[1]], x[places[2]], x[places[3]]}};
    }

    template <typename T>
    static std::array<std::array<T, 3>, 4>
    before(const Points<T> &x, const unsigned int triangle)
    {
      return pick<T>(
        x,
        {{0, 1 + 3 * triangle, 2 + 3 * triangle, 3 + 3 * triangle}});
    }

    /// The corner of the second triangle that is off the first one, then the first
    /// one's, beginning with the edge.
    static std::array<unsigned int, 4>
    around_edge(const SharedEdge &edge)
    {
      return {{4 + edge.opposite,
               1 + edge.begin,
               1 + (edge.begin + 1) % 3,
               1 + (edge.begin + 2) % 3}};
    }

    /// Add @p factor times the @p row on four points at the positions @p
    /// places.
    static void
    add(const typename Single::Row        &row,
        const Number                      &factor,
        const std::array<unsigned int, 4> &places,
        std::array<Number, n_coordinates> &sum)
    {
      for (unsigned int p = 0; p < 4; ++p)
        for (unsigned int c = 0; c < 3; ++c)
          sum[3 * places[p] + c] += factor * row[3 * p + c];
    }
  };
} // namespace Ricochet

#endif
