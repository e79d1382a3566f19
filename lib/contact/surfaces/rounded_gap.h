// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_rounded_gap_h
#define ricochet_contact_surfaces_rounded_gap_h

#include <cmath>
#include <vector>

namespace Ricochet
{
  /**
   * The gap of a point to a surface of triangles with rounded edges: a differentiable
   * function of the positions alone, whatever triangle the point faces. Where points
   * pass from one triangle to another without it, the derivative of the gap jumps:
   * Newton's method has nothing to converge to where a step begins on an edge, as it does
   * for nodes that meet nodes or diagonals of quadrilaterals.
   *
   * The gap is the mean of the distances g_i from the planes of triangles,
   *
   *     g = sum u_i g_i / sum u_i,     u_i = product of sigma(-t/w) over the edges of i,
   *
   * where t is the coordinate of the point from the bisector of an edge (m), positive
   * beyond the edge as seen from triangle i, w the half width of the rounding, and
   * sigma rises from 0 at -1 to 1 at 1 with sigma(x) + sigma(-x) = 1. In front of a triangle
   * and away from its edges g is g_i.
   *
   * Over a step the change of g is a sum of changes of g_i and t, with factors from the rules
   * for products and quotients of DiscreteScalar: with rows whose products with
   * the change of the positions are those changes, the increment of g is exact, and if the
   * moments of their rows are zero, so is that of the row of g.
   *
   * @tparam Number type of the new values: double, or one for automatic
   * differentiation.
   */
  template <typename Number>
  class RoundedGap
  {
  public:
    /// An edge between two triangles of the patch.
    struct Edge
    {
      /// The triangles.
      unsigned int first = 0, second = 0;
      /// Half width of the rounding (m).
      double width = 0.;
      /// Coordinate from the bisector, positive on the side of the second triangle (m).
      double old_t = 0.;
      Number new_t{};
    };

    /// Whether a triangle takes part in the mean; others are there for their edges.
    std::vector<bool> counts;
    /// Distances from the planes of the triangles (m).
    std::vector<double> old_gaps;
    std::vector<Number> new_gaps;
    std::vector<Edge>   edges;

    /// The gap at both ends of the step (m).
    double old_gap = 0.;
    Number new_gap{};
    /// Factors of the changes of #new_gaps and of the coordinates of #edges.
    std::vector<Number> of_gaps, of_edges;

    /// Evaluate gap and factors. @return whether there is a gap: a point may be beyond an
    /// edge of each triangle of the patch.
    bool
    evaluate()
    {
      const unsigned int n = old_gaps.size();
      parts.resize(edges.size());
      for (unsigned int e = 0; e < edges.size(); ++e)
        set_part(edges[e], parts[e]);

      old_weight.assign(n, 1.);
      new_weight.assign(n, Number(1.));
      factors.clear();
      begin.assign(1, 0);
      double old_sum = 0., old_product = 0.;
      Number new_sum(0.), new_product(0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          if (counts[i])
            multiply(i);
          else
            old_weight[i] = 0., new_weight[i] = Number(0.);
          begin.push_back(factors.size());
          old_sum += old_weight[i];
          new_sum += new_weight[i];
          old_product += old_weight[i] * old_gaps[i];
          new_product += new_weight[i] * new_gaps[i];
        }
      constexpr double smallest = 1e-3;
      if (!(old_sum > smallest && new_sum > smallest))
        return false;
      old_gap = old_product / old_sum;
      new_gap = new_product / new_sum;

      // g is a quotient of sums of products u_i g_i.
      const Number per_sums    = 1. / (old_sum * new_sum);
      const Number of_products = .5 * (old_sum + new_sum) * per_sums;
      const Number of_sum      = .5 * (old_product + new_product) * per_sums;
      of_gaps.assign(n, Number(0.));
      of_edges.assign(edges.size(), Number(0.));
      for (unsigned int i = 0; i < n; ++i)
        {
          of_gaps[i] = of_products * .5 * (old_weight[i] + new_weight[i]);
          const Number of_weight =
            of_products * .5 * (old_gaps[i] + new_gaps[i]) - of_sum;
          for (unsigned int k = begin[i]; k < begin[i + 1]; ++k)
            of_edges[factors[k].edge] += of_weight * factors[k].factor;
        }
      for (unsigned int e = 0; e < edges.size(); ++e)
        of_edges[e] *= parts[e].quotient;
      return true;
    }

    /// sigma(x)
    template <typename T>
    static T
    rise(const T &x)
    {
      if (x <= -1.)
        return T(0.);
      if (x >= 1.)
        return T(1.);
      return T(.5 + x * (.75 - .25 * x * x));
    }

  private:
    /// sigma on the side of the second triangle of an edge.
    struct Part
    {
      double old_value = 0.;
      Number new_value{};
      /// The change of sigma over that of t (1/m).
      Number quotient{};
    };

    /// A weight changes by this factor times the change of the sigma of an edge.
    struct Factor
    {
      unsigned int edge;
      Number       factor;
    };

    static void
    set_part(const Edge &edge, Part &part)
    {
      const double old_x = edge.old_t / edge.width;
      const Number new_x = edge.new_t / edge.width;
      part.old_value     = rise(old_x);
      part.new_value     = rise(new_x);
      if ((old_x <= -1. && new_x <= -1.) || (old_x >= 1. && new_x >= 1.))
        part.quotient = Number(0.);
      else if (old_x >= -1. && old_x <= 1. && new_x >= -1. && new_x <= 1.)
        part.quotient =
          (.75 - .25 * (old_x * old_x + old_x * new_x + new_x * new_x)) /
          edge.width;
      else
        part.quotient =
          (part.new_value - part.old_value) / (edge.new_t - edge.old_t);
    }

    /// The weight of triangle @p i, and how it changes.
    void
    multiply(const unsigned int i)
    {
      const unsigned int first = factors.size();
      for (unsigned int e = 0; e < edges.size(); ++e)
        {
          if (edges[e].first != i && edges[e].second != i)
            continue;
          const bool   is_second = edges[e].second == i;
          const double old_value =
            is_second ? parts[e].old_value : 1. - parts[e].old_value;
          const Number new_value =
            is_second ? parts[e].new_value : Number(1. - parts[e].new_value);
          for (unsigned int k = first; k < factors.size(); ++k)
            factors[k].factor *= .5 * (old_value + new_value);
          const double sign = is_second ? 1. : -1.;
          factors.push_back(
            {e, Number(sign * .5 * (old_weight[i] + new_weight[i]))});
          old_weight[i] *= old_value;
          new_weight[i] *= new_value;
        }
    }

    // Work space.
    std::vector<Part>         parts;
    std::vector<double>       old_weight;
    std::vector<Number>       new_weight;
    std::vector<Factor>       factors;
    std::vector<unsigned int> begin;
  };
} // namespace Ricochet

#endif
