// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_rounded_gap_h
#define ricochet_contact_surfaces_rounded_gap_h

#include <contact/surfaces/smooth_step.h>

#include <vector>

namespace Ricochet
{
  /**
   * The gap of a point to a surface of triangles with rounded edges, and the coverage at
   * open ones: differentiable functions of the positions alone, whatever triangle the point
   * faces. Where points pass from one triangle to another without it, the derivative of the
   * gap jumps: Newton's method has nothing to converge to where a step begins on an edge, as
   * it does for nodes that meet nodes or diagonals of quadrilaterals.
   *
   * The gap is the mean of the distances g_i from the planes of triangles,
   *
   *     g = sum u_i g_i / sum u_i,     u_i = product of sigma(-t/w) over the edges of i,
   *
   * where t is the coordinate of the point from the bisector of an edge (m), positive
   * beyond the edge as seen from triangle i, w the half width of the rounding, and
   * sigma is SmoothStep. In front of a triangle and away from its edges g is g_i.
   *
   * The coverage W is the part of what a point stands for that has the surface in front of
   * it, see SurfacePair: the mean, with the same weights, of products of sigma(-t/w) over the
   * open edges of the triangles, where t is the coordinate from the middle of the range in
   * which the coverage falls from 1 to 0.
   *
   * Over a step the changes of g and W are sums of changes of g_i and t, with factors from
   * the rules for products and quotients of DiscreteScalar: with rows whose products with
   * the change of the positions are those changes, the increments are exact, and if the
   * moments of their rows are zero, so are those of the rows of g and W.
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

    /// An open edge.
    struct OpenEdge
    {
      unsigned int triangle = 0;
      /// Half width of the range in which the coverage falls (m).
      double width = 0.;
      /// Coordinate from the middle of this range, positive outwards (m).
      double old_t = 0.;
      Number new_t{};
    };

    /// Whether a triangle takes part in the mean; others are there for their edges.
    std::vector<bool> counts;
    /// Distances from the planes of the triangles (m).
    std::vector<double>   old_gaps;
    std::vector<Number>   new_gaps;
    std::vector<Edge>     edges;
    std::vector<OpenEdge> open_edges;

    /// The gap at both ends of the step (m).
    double old_gap = 0.;
    Number new_gap{};
    /// Factors of the changes of #new_gaps and of the coordinates of #edges in that of
    /// the gap.
    std::vector<Number> of_gaps, of_edges;

    /// The coverage at both ends of the step.
    double old_coverage = 1.;
    Number new_coverage{1.};
    /// Factors of the changes of the coordinates of #edges and #open_edges in that of the
    /// coverage (1/m).
    std::vector<Number> coverage_of_edges, coverage_of_open;

    /// Evaluate gap, coverage and factors. @return whether there is a gap: a point may be
    /// beyond an edge of each triangle of the patch.
    bool
    evaluate()
    {
      const unsigned int n = old_gaps.size();
      old_weight.assign(n, 1.);
      new_weight.assign(n, Number(1.));
      of_weights.clear();
      parts.resize(edges.size());
      for (unsigned int e = 0; e < edges.size(); ++e)
        {
          set_part(edges[e], parts[e]);
          multiply(edges[e].second, e, true);
          multiply(edges[e].first, e, false);
        }
      double old_sum = 0.;
      Number new_sum(0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          if (!counts[i])
            old_weight[i] = 0., new_weight[i] = Number(0.);
          old_sum += old_weight[i];
          new_sum += new_weight[i];
        }
      constexpr double smallest = 1e-3;
      if (!(old_sum > smallest && new_sum > smallest))
        return false;
      set_mean(old_gaps,
               new_gaps,
               old_sum,
               new_sum,
               old_gap,
               new_gap,
               of_gaps,
               of_edges);
      set_coverage(old_sum, new_sum);
      return true;
    }

  private:
    /// sigma on the side of the second triangle of an edge, or outwards of an open one.
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
      unsigned int triangle, edge;
      Number       factor;
    };

    template <typename AnyEdge>
    static void
    set_part(const AnyEdge &edge, Part &part)
    {
      const double old_x = edge.old_t / edge.width;
      const Number new_x = edge.new_t / edge.width;
      part.old_value     = SmoothStep::value(old_x);
      part.new_value     = SmoothStep::value(new_x);
      part.quotient      = SmoothStep::quotient(old_x, new_x) / edge.width;
    }

    /// Multiply the weight of triangle @p i by the sigma of edge @p e, or by 1 - sigma.
    void
    multiply(const unsigned int i, const unsigned int e, const bool is_second)
    {
      if (!counts[i])
        return;
      const Part  &part      = parts[e];
      const double old_value = is_second ? part.old_value : 1. - part.old_value;
      const Number new_value =
        is_second ? part.new_value : Number(1. - part.new_value);
      for (Factor &former : of_weights)
        if (former.triangle == i)
          former.factor *= .5 * (old_value + new_value);
      of_weights.push_back(
        {i,
         e,
         Number((is_second ? .5 : -.5) * (old_weight[i] + new_weight[i]))});
      old_weight[i] *= old_value;
      new_weight[i] *= new_value;
    }

    /// The mean of values of the triangles, a quotient of sums of products, and the factors
    /// of the changes of the values and of the coordinates of edges in its change.
    void
    set_mean(const std::vector<double> &old_values,
             const std::vector<Number> &new_values,
             const double               old_sum,
             const Number              &new_sum,
             double                    &old_mean,
             Number                    &new_mean,
             std::vector<Number>       &of_values,
             std::vector<Number>       &with_edges) const
    {
      const unsigned int n           = old_values.size();
      double             old_product = 0.;
      Number             new_product(0.);
      for (unsigned int i = 0; i < n; ++i)
        {
          old_product += old_weight[i] * old_values[i];
          new_product += new_weight[i] * new_values[i];
        }
      old_mean                 = old_product / old_sum;
      new_mean                 = new_product / new_sum;
      const Number per_sums    = 1. / (old_sum * new_sum);
      const Number of_products = .5 * (old_sum + new_sum) * per_sums;
      const Number of_sum      = .5 * (old_product + new_product) * per_sums;
      of_values.resize(n);
      with_edges.assign(edges.size(), Number(0.));
      for (unsigned int i = 0; i < n; ++i)
        of_values[i] = of_products * .5 * (old_weight[i] + new_weight[i]);
      for (const Factor &one : of_weights)
        with_edges[one.edge] += one.factor *
          (of_products * .5 *
             (old_values[one.triangle] + new_values[one.triangle]) -
           of_sum);
      for (unsigned int e = 0; e < edges.size(); ++e)
        with_edges[e] *= parts[e].quotient;
    }

    void
    set_coverage(const double old_sum, const Number &new_sum)
    {
      old_coverage = 1.;
      new_coverage = Number(1.);
      coverage_of_edges.clear();
      coverage_of_open.clear();
      if (open_edges.empty())
        return;
      const unsigned int n = old_gaps.size();
      old_covered.assign(n, 1.);
      new_covered.assign(n, Number(1.));
      coverage_of_open.resize(open_edges.size());
      for (unsigned int e = 0; e < open_edges.size(); ++e)
        {
          const unsigned int i = open_edges[e].triangle;
          Part               part;
          set_part(open_edges[e], part);
          const double old_value = 1. - part.old_value;
          const Number new_value = 1. - part.new_value;
          for (unsigned int former = 0; former < e; ++former)
            if (open_edges[former].triangle == i)
              coverage_of_open[former] *= .5 * (old_value + new_value);
          coverage_of_open[e] =
            -.5 * (old_covered[i] + new_covered[i]) * part.quotient;
          old_covered[i] *= old_value;
          new_covered[i] *= new_value;
        }
      set_mean(old_covered,
               new_covered,
               old_sum,
               new_sum,
               old_coverage,
               new_coverage,
               of_covered,
               coverage_of_edges);
      for (unsigned int e = 0; e < open_edges.size(); ++e)
        coverage_of_open[e] *= of_covered[open_edges[e].triangle];
    }

    // Work space.
    std::vector<Part>   parts;
    std::vector<double> old_weight, old_covered;
    std::vector<Number> new_weight, new_covered, of_covered;
    std::vector<Factor> of_weights;
  };
} // namespace Ricochet

#endif
