// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_facet_chain_h
#define ricochet_contact_surfaces_facet_chain_h

#include <contact/surfaces/caution.h>
#include <contact/surfaces/discrete_scalar.h>
#include <contact/surfaces/smooth_step.h>

#include <array>
#include <cmath>
#include <type_traits>
#include <vector>

namespace Ricochet
{
  /// Which ends of a chain of facets are open ends of the surface.
  struct OpenEnds
  {
    bool first = false, last = false;
    /// The overhang at which the coverage is 0 (m).
    double largest_overhang = 0.;
  };

  /**
   * Contact of a point with a chain of straight facets in 2D, all of which
   * move: the gap, and the directions along which forces on the point and on
   * the nodes of the chain have to act over a step.
   *
   * The point y faces the facet (a, b), whose outside is on its left, at the
   * distance g = A / |e| from its line, with e = b - a, r = y - a, A = e x r.
   * With P = e . r and B = e . e, all three are quadratic functions of the
   * positions, so that their gradients in the middle of a step are their
   * quotients of differences. By the rules for products and quotients so are
   *
   *     D = mean(1/L) grad A - (A_0 + A_1) / (2 L_0 L_1 (L_0 + L_1)) grad B,
   *     T = L_m [ mean(1/B) grad P - (P_0 + P_1) / (2 B_0 B_1) grad B ]
   *
   * for the gap and for L_m times the coordinate P/B along the facet (L = |e|;
   * gradients and L_m in the middle of the step): D . change = g_1 - g_0, exactly.
   * Since A, P, B are invariant under a rigid motion of all of the points
   * together, so are D and T: the sum of the forces is zero, and so is that of
   * their moments.
   *
   * Neighbouring facets meet where the bisector of their angle is. There the
   * distances from both lines are the same: with the unit vectors e_1, e_2 along
   * them, and the bisector's coordinate t = (e_1 + e_2) . (y - b) / (1 + e_1 . e_2),
   * the difference is -(e_1 x e_2) t. For a point that passes the vertex b during
   * the step, D becomes the mean of both facets', weighted by the part of the
   * displacement on each, and a small couple for the change of the angle, so
   * that D . change is still exactly g_1 - g_0.
   *
   * These weights jump where a step begins exactly on a bisector, as it does for nodes
   * that meet nodes: Newton's method then has nothing to converge to. So a vertex may be
   * rounded: within w of the bisector the gap is the mean of both distances, g = g_1 +
   * sigma (g_2 - g_1), with the weight sigma(t/w) of SmoothStep, which rises from 0 to 1. It is
   * a differentiable function of the positions alone. With psi = t sigma, tau for the
   * change of psi over that of t, and the discrete gradient D_sine of e_1 x e_2,
   *
   *     D = D_1 + tau (D_2 - D_1) + (tau mean(t) - mean(psi)) D_sine,
   *
   * which is the formula above where w = 0, tau the part behind the vertex.
   *
   * Beyond an open end by the overhang s, P/L - L or -P/L, the coverage (see SurfacePair) falls
   * smoothly from 1 at s = 0 to 0 at the largest overhang s_0: W = sigma(1 - 2 s/s_0).
   *
   * @tparam Number type of the new values: double, or one for automatic
   * differentiation.
   */
  template <typename Number>
  class FacetChain
  {
  public:
    template <typename T>
    using Vector2 = std::array<T, 2>;

    /// Rows on the coordinates of the point and of the nodes of the chain, in this
    /// order.
    struct Rows
    {
      /// Gap at the end of the step (m).
      Number new_gap{};
      /// D . change, which is new gap - old gap (m).
      Number gap_increment{};
      /// T . change: sliding distance of the point along the initial facet (m).
      Number slip{};
      /// D and T, 1.
      std::vector<Number> normal, tangential;
      /// The coverage at the end of the step, and its row C (1/m), which is empty without
      /// open ends.
      Number              new_coverage{1.};
      std::vector<Number> coverage;
    };

    /// Half widths of the rounded vertices between facets of the chain (m); null for sharp
    /// ones.
    using Roundings = std::vector<double>;

    /**
     * Positions at the beginning of a step and at its end: first that of the
     * point, then those of the nodes of the chain (m). References are stored.
     */
    FacetChain(const std::vector<Vector2<double>> &old_positions,
               const std::vector<Vector2<Number>> &new_positions,
               const Caution                       caution   = Caution::none,
               const Roundings                    *roundings = nullptr,
               const OpenEnds                     &open_ends = {})
      : old_x(old_positions)
      , new_x(new_positions)
      , caution(caution)
      , roundings(roundings)
      , open_ends(open_ends)
    {}

    /**
     * Rows for a point that faces the facet @p old_facet of the chain at the
     * beginning and @p new_facet at the end. @p rows keeps its memory.
     */
    void
    evaluate(const unsigned int old_facet,
             const unsigned int new_facet,
             Rows              &rows) const
    {
      rows.normal.assign(2 * new_x.size(), Number(0.));
      rows.tangential.assign(2 * new_x.size(), Number(0.));
      add_normal_row(old_facet, Number(1.), rows.normal);
      add_tangential_row(old_facet, rows.tangential);
      set_coverage(rows);
      if (roundings)
        {
          for (unsigned int facet = old_facet; facet + 3 < new_x.size();
               ++facet)
            add_rounded(facet, 1., rows.normal);
          for (unsigned int facet = old_facet; facet > 0; --facet)
            add_rounded(facet - 1, -1., rows.normal);
          rows.new_gap       = gap(new_x, new_facet, *roundings);
          rows.gap_increment = times_change(rows.normal);
          rows.slip          = times_change(rows.tangential);
          return;
        }
      const bool         forward = new_facet > old_facet;
      const unsigned int first   = forward ? old_facet : new_facet;
      const unsigned int last    = forward ? new_facet : old_facet;
      for (unsigned int facet = first; facet < last; ++facet)
        add_passing(facet, forward ? 1. : -1., rows.normal);

      rows.new_gap       = gap(new_x, new_facet);
      rows.gap_increment = times_change(rows.normal);
      rows.slip          = times_change(rows.tangential);
    }

    /// The distance from the line of @p facet (m).
    template <typename T>
    static T
    gap(const std::vector<Vector2<T>> &x, const unsigned int facet)
    {
      using std::sqrt;
      const auto e = edge(x, facet);
      return cross(e, minus(x[0], x[facet + 1])) / sqrt(dot(e, e));
    }

    /// The distance from the surface with rounded vertices, in front of which the point
    /// is at @p facet (m).
    template <typename T>
    static T
    gap(const std::vector<Vector2<T>> &x,
        const unsigned int             facet,
        const Roundings               &roundings)
    {
      T distance = gap(x, facet);
      if (facet + 3 < x.size())
        distance -= turn(x, facet) *
          past_rounded(past_vertex(x, facet), roundings[facet]);
      if (facet > 0)
        distance -= turn(x, facet - 1) *
          past_rounded(T(-past_vertex(x, facet - 1)), roundings[facet - 1]);
      return distance;
    }

    /// psi(t) with the half width @p w.
    template <typename T>
    static T
    past_rounded(const T &t, const double w)
    {
      return t * SmoothStep::value(T(t / w));
    }

    /// The coverage of the point.
    template <typename T>
    static T
    coverage(const std::vector<Vector2<T>> &x, const OpenEnds &open_ends)
    {
      using std::sqrt;
      T          result(1.);
      const auto add = [&](const unsigned int facet, const bool is_first) {
        const auto e      = edge(x, facet);
        const T    length = sqrt(dot(e, e));
        const T    along  = dot(e, minus(x[0], x[facet + 1])) / length;
        result *= covered(T(is_first ? T(-along) : T(along - length)),
                          open_ends.largest_overhang);
      };
      if (open_ends.first)
        add(0, true);
      if (open_ends.last)
        add(x.size() - 3, false);
      return result;
    }

    /// The coordinate (m) from the bisector between @p facet and the next one,
    /// negative on the side of @p facet.
    template <typename T>
    static T
    past_vertex(const std::vector<Vector2<T>> &x, const unsigned int facet)
    {
      using std::sqrt;
      const auto e1 = edge(x, facet), e2 = edge(x, facet + 1);
      const T    l1 = sqrt(dot(e1, e1)), l2 = sqrt(dot(e2, e2));
      const auto r = minus(x[0], x[facet + 2]);
      return (dot(e1, r) / l1 + dot(e2, r) / l2) /
        (1. + dot(e1, e2) / (l1 * l2));
    }

    /// The sine of the angle between @p facet and the next one: positive for a
    /// concave vertex.
    template <typename T>
    static T
    turn(const std::vector<Vector2<T>> &x, const unsigned int facet)
    {
      using std::sqrt;
      const auto e1 = edge(x, facet), e2 = edge(x, facet + 1);
      return cross(e1, e2) / sqrt(dot(e1, e1) * dot(e2, e2));
    }

    /// Whether the point is between the bisectors at both ends of @p facet.
    static bool
    is_between_bisectors(const std::vector<Vector2<double>> &x,
                         const unsigned int                  facet)
    {
      const unsigned int n_facets = x.size() - 2;
      return (facet + 1 == n_facets || past_vertex(x, facet) < 0.) &&
        (facet == 0 || past_vertex(x, facet - 1) >= 0.);
    }

    /// The facet that the point faces at positions @p x, found by walking over
    /// vertices from @p facet. A vertex is only passed by more than @p margin
    /// times the length of the facet before it: a point at a vertex would
    /// otherwise alternate between facets with round-off.
    static unsigned int
    facet_before(const std::vector<Vector2<double>> &x,
                 unsigned int                        facet,
                 const double                        margin = 0.)
    {
      const unsigned int n_facets = x.size() - 2, begin = facet;
      const auto         small = [&](const unsigned int f) {
        return margin == 0. ? 0.
                                    : margin * std::sqrt(dot(edge(x, f), edge(x, f)));
      };
      while (facet + 1 < n_facets && past_vertex(x, facet) >= small(facet))
        ++facet;
      if (facet == begin)
        while (facet > 0 && past_vertex(x, facet - 1) < -small(facet - 1))
          --facet;
      return facet;
    }

  private:
    template <typename T>
    static Vector2<T>
    minus(const Vector2<T> &a, const Vector2<T> &b)
    {
      return {{T(a[0] - b[0]), T(a[1] - b[1])}};
    }

    template <typename T>
    static T
    dot(const Vector2<T> &a, const Vector2<T> &b)
    {
      return a[0] * b[0] + a[1] * b[1];
    }

    template <typename T>
    static T
    cross(const Vector2<T> &a, const Vector2<T> &b)
    {
      return a[0] * b[1] - a[1] * b[0];
    }

    template <typename T>
    static Vector2<T>
    edge(const std::vector<Vector2<T>> &x, const unsigned int facet)
    {
      return minus(x[facet + 2], x[facet + 1]);
    }

    Vector2<Number>
    middle(const unsigned int i) const
    {
      return {{Number(.5 * (old_x[i][0] + new_x[i][0])),
               Number(.5 * (old_x[i][1] + new_x[i][1]))}};
    }

    /// Add @p factor * @p gradient to the entries of point @p i in @p row.
    static void
    add(const unsigned int     i,
        const Number          &factor,
        const Vector2<Number> &gradient,
        std::vector<Number>   &row)
    {
      row[2 * i] += factor * gradient[0];
      row[2 * i + 1] += factor * gradient[1];
    }

    Number
    times_change(const std::vector<Number> &row) const
    {
      Number sum(0.);
      for (unsigned int i = 0; i < new_x.size(); ++i)
        for (unsigned int c = 0; c < 2; ++c)
          sum += row[2 * i + c] * (new_x[i][c] - old_x[i][c]);
      return sum;
    }

    /// Add @p factor * grad (e . e) of the vector e from point @p i to point @p j.
    void
    add_square(const unsigned int   i,
               const unsigned int   j,
               const Number        &factor,
               std::vector<Number> &row) const
    {
      const Vector2<Number> e = minus(middle(j), middle(i));
      add(j, Number(2. * factor), e, row);
      add(i, Number(-2. * factor), e, row);
    }

    void
    add_normal_row(const unsigned int   facet,
                   const Number        &factor,
                   std::vector<Number> &row) const
    {
      using std::sqrt;
      const unsigned int a = facet + 1, b = facet + 2;
      const auto         old_e = edge(old_x, facet);
      const auto         new_e = edge(new_x, facet);
      const double       old_l = std::sqrt(dot(old_e, old_e));
      const Number       new_l = sqrt(dot(new_e, new_e));
      const Number       areas = cross(old_e, minus(old_x[0], old_x[a])) +
        cross(new_e, minus(new_x[0], new_x[a]));

      const Vector2<Number> e    = minus(middle(b), middle(a));
      const Vector2<Number> r    = minus(middle(0), middle(a));
      const Number          mean = .5 * factor * (1. / old_l + 1. / new_l);
      add(0, mean, {{Number(-e[1]), e[0]}}, row);
      add(a, mean, {{Number(e[1] - r[1]), Number(r[0] - e[0])}}, row);
      add(b, mean, {{r[1], Number(-r[0])}}, row);
      add_square(a,
                 b,
                 Number(-factor * areas /
                        (2. * old_l * new_l * (old_l + new_l))),
                 row);
    }

    void
    add_tangential_row(const unsigned int facet, std::vector<Number> &row) const
    {
      using std::sqrt;
      const unsigned int    a = facet + 1, b = facet + 2;
      const auto            old_e = edge(old_x, facet);
      const auto            new_e = edge(new_x, facet);
      const double          old_b = dot(old_e, old_e);
      const Number          new_b = dot(new_e, new_e);
      const Vector2<Number> e     = minus(middle(b), middle(a));
      const Vector2<Number> r     = minus(middle(0), middle(a));
      const Number          l     = sqrt(dot(e, e));

      const Number mean = .5 * l * (1. / old_b + 1. / new_b);
      add(0, mean, e, row);
      add(a, mean, {{Number(-e[0] - r[0]), Number(-e[1] - r[1])}}, row);
      add(b, mean, r, row);
      const Number products = dot(old_e, minus(old_x[0], old_x[a])) +
        dot(new_e, minus(new_x[0], new_x[a]));
      add_square(a, b, Number(-l * products / (2. * old_b * new_b)), row);
    }

    /// W at the overhang @p s.
    template <typename T>
    static T
    covered(const T &s, const double largest_overhang)
    {
      return SmoothStep::value(T(1. - 2. * s / largest_overhang));
    }

    /// The overhang of the point beyond the first or the last node, as a function of it and
    /// the nodes of the facet there.
    DiscreteScalar<Number, 6>
    overhang(const unsigned int facet, const bool is_first) const
    {
      using Scalar                         = DiscreteScalar<Number, 6>;
      const unsigned int          a        = facet + 1;
      const Vector2<Number>       e        = minus(middle(a + 1), middle(a));
      const std::array<double, 2> old_edge = edge(old_x, facet);
      const std::array<Number, 2> new_edge = edge(new_x, facet);
      const auto                  product_with_edge = [&](const unsigned int to,
                                         const unsigned int place) {
        const Vector2<Number> r = minus(middle(to), middle(a));
        Scalar                product;
        product.old_value = dot(old_edge, minus(old_x[to], old_x[a]));
        product.new_value = dot(new_edge, minus(new_x[to], new_x[a]));
        for (unsigned int c = 0; c < 2; ++c)
          {
            product.row[place + c] += e[c];
            product.row[4 + c] += r[c];
            product.row[2 + c] -= e[c] + r[c];
          }
        return product;
      };
      const Scalar length = sqrt(product_with_edge(a + 1, 4));
      const Scalar along  = product_with_edge(0, 0) / length;
      return is_first ? Scalar() - along : along - length;
    }

    void
    set_coverage(Rows &rows) const
    {
      rows.coverage.clear();
      rows.new_coverage = Number(1.);
      if (!open_ends.first && !open_ends.last)
        return;
      rows.coverage.resize(2 * new_x.size(), Number(0.));
      double     old_coverage = 1.;
      const auto multiply = [&](const unsigned int facet, const bool is_first) {
        const auto   s       = overhang(facet, is_first);
        const double per     = 2. / open_ends.largest_overhang;
        const double old_end = covered(s.old_value, open_ends.largest_overhang);
        const Number new_end = covered(s.new_value, open_ends.largest_overhang);
        const Number mean_end = .5 * (old_end + new_end),
                     of_s     = -.5 * per * (old_coverage + rows.new_coverage) *
          SmoothStep::quotient(1. - per * s.old_value,
                               Number(1. - per * s.new_value));
        for (Number &entry : rows.coverage)
          entry *= mean_end;
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int c = 0; c < 2; ++c)
            rows.coverage[2 * (i == 0 ? 0 : facet + i) + c] +=
              of_s * s.row[2 * i + c];
        old_coverage *= old_end;
        rows.new_coverage *= new_end;
      };
      if (open_ends.first)
        multiply(0, true);
      if (open_ends.last)
        multiply(new_x.size() - 3, false);
    }

    /// Add the terms of passing the vertex between @p facet and the next one,
    /// @p direction being 1 towards the next one and -1 from there.
    void
    add_passing(const unsigned int   facet,
                const double         direction,
                std::vector<Number> &row) const
    {
      const double old_t = past_vertex(old_x, facet);
      const Number new_t = past_vertex(new_x, facet);
      // The part of the displacement behind the vertex.
      Number part = new_t / (new_t - old_t);
      if constexpr (!std::is_same<Number, double>::value)
        {
          const bool is_convex = turn(old_x, facet) < 0.;
          if (is_convex && caution != Caution::none)
            part = Number(part.val());
          else if (!is_convex && caution == Caution::at_all_vertices)
            part = Number(part.val() +
                          (new_t - new_t.val()) / (new_t.val() - old_t));
        }
      add_normal_row(facet + 1, Number(direction * part), row);
      add_normal_row(facet, Number(-direction * part), row);
      add_turning_row(facet, Number(direction * old_t * part), row);
    }

    /// Add the terms of the rounded vertex between @p facet and the next one for a point
    /// in front of @p facet, @p direction being 1, or in front of the next one, -1.
    void
    add_rounded(const unsigned int   facet,
                const double         direction,
                std::vector<Number> &row) const
    {
      const double w     = (*roundings)[facet];
      const double old_t = direction * past_vertex(old_x, facet);
      const Number new_t = direction * past_vertex(new_x, facet);
      if (old_t <= -w && new_t <= -w)
        return;
      const double old_psi = past_rounded(old_t, w);
      const Number new_psi = past_rounded(new_t, w);
      Number       tau;
      if (old_t >= w && new_t >= w)
        tau = 1.;
      else if (std::abs(old_t) <= w && new_t >= -w && new_t <= w)
        {
          // The quotient of differences of t/2 + 3/4 t^2/w - t^4/(4 w^3).
          const double a = old_t / w;
          const Number b = new_t / w;
          tau            = .5 + .75 * (a + b) - .25 * (a + b) * (a * a + b * b);
        }
      else
        tau = (new_psi - old_psi) / (new_t - old_t);
      Number of_turn = .5 * (tau * (old_t + new_t) - (old_psi + new_psi));
      if constexpr (!std::is_same<Number, double>::value)
        if (caution != Caution::none)
          {
            tau     = Number(tau.val());
            of_turn = Number(of_turn.val());
          }
      const unsigned int near = direction > 0. ? facet : facet + 1,
                         far  = direction > 0. ? facet + 1 : facet;
      add_normal_row(far, tau, row);
      add_normal_row(near, Number(-tau), row);
      add_turning_row(facet, of_turn, row);
    }

    /// Add @p factor times the quotient of differences of e_1 x e_2, the sine of the
    /// angle between @p facet and the next one.
    void
    add_turning_row(const unsigned int   facet,
                    const Number        &factor,
                    std::vector<Number> &row) const
    {
      using std::sqrt;
      const unsigned int a = facet + 1, b = facet + 2, c = facet + 3;
      const auto   old_e1 = edge(old_x, facet), old_e2 = edge(old_x, facet + 1);
      const auto   new_e1 = edge(new_x, facet), new_e2 = edge(new_x, facet + 1);
      const double old_l1 = std::sqrt(dot(old_e1, old_e1));
      const double old_l2 = std::sqrt(dot(old_e2, old_e2));
      const Number new_l1 = sqrt(dot(new_e1, new_e1));
      const Number new_l2 = sqrt(dot(new_e2, new_e2));

      const Vector2<Number> e1 = minus(middle(b), middle(a));
      const Vector2<Number> e2 = minus(middle(c), middle(b));
      const Number          mean =
        .5 * factor * (1. / (old_l1 * old_l2) + 1. / (new_l1 * new_l2));
      add(a, mean, {{Number(-e2[1]), e2[0]}}, row);
      add(b, mean, {{Number(e1[1] + e2[1]), Number(-e1[0] - e2[0])}}, row);
      add(c, mean, {{Number(-e1[1]), e1[0]}}, row);

      const Number areas =
        .5 * factor * (cross(old_e1, old_e2) + cross(new_e1, new_e2));
      add_square(a,
                 b,
                 Number(-areas * .5 * (1. / old_l2 + 1. / new_l2) /
                        (old_l1 * new_l1 * (old_l1 + new_l1))),
                 row);
      add_square(b,
                 c,
                 Number(-areas * .5 * (1. / old_l1 + 1. / new_l1) /
                        (old_l2 * new_l2 * (old_l2 + new_l2))),
                 row);
    }

    const std::vector<Vector2<double>> &old_x;
    const std::vector<Vector2<Number>> &new_x;
    const Caution                       caution;
    const Roundings *const              roundings;
    const OpenEnds                      open_ends;
  };
} // namespace Ricochet

#endif
