// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/points_before_triangles.h>
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/quadrature_lib.h>

#include <Sacado_Fad_SLFad.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>

namespace Ricochet
{
  using namespace dealii;

  using NearAt = RoundedPatches::NearAt;

  namespace
  {
    /// Distance of the first of @p x from the triangle between the others.
    double
    distance(const std::array<std::array<double, 3>, 4> &x)
    {
      const Tensor<1, 3> y = to_tensor(x[0]), a = to_tensor(x[1]),
                         b = to_tensor(x[2]), c = to_tensor(x[3]);
      const auto shares = closest_in_triangle(y, a, b, c);
      return (y - shares[0] * a - shares[1] * b - shares[2] * c).norm();
    }

    /// How far a point is beside a triangle, along its plane, from the square of its
    /// distance and its gap.
    double
    beside(const double distance_square, const double gap)
    {
      return std::sqrt(std::max(0., distance_square - gap * gap));
    }
  } // namespace



  PointsBeforeTriangles::PointsBeforeTriangles(const Body<3>     &body,
                                               const ContactPair &pair,
                                               const PointsIn     points_in,
                                               const bool         has_coverage)
    : SurfacePair<3>(body, pair)
    , has_coverage(has_coverage && !is_self)
    , rounded_patches(master)
  {
    if (points_in == PointsIn::quadrature_points)
      make_quadrature_points(body);
    else if (points_in == PointsIn::corners)
      make_corner_points(body);
    else
      make_nodal_points(body, has_coverage);
    gaps.resize(own_points.size());
    steps.resize(own_points.size());

    std::vector<dealii::Point<3>> places;
    for (const auto &node : master.nodes)
      places.push_back(node.reference_position);
    const auto ends = BoundingBox<3>(places).get_boundary_points();
    smallest_reach  = is_self ? 0. : .1 * ends.first.distance(ends.second);
    for (const auto &facet : master.facets)
      smallest_reach =
        std::max(smallest_reach, 2. * std::sqrt(2. * facet.measure));

    std::vector<std::vector<unsigned int>> at_node(master.nodes.size());
    for (unsigned int f = 0; f < master.facets.size(); ++f)
      for (const unsigned int node : master.facets[f].nodes)
        at_node[node].push_back(f);
    around.resize(master.facets.size());
    for (unsigned int f = 0; f < master.facets.size(); ++f)
      {
        for (const unsigned int node : master.facets[f].nodes)
          around[f].insert(around[f].end(),
                           at_node[node].begin(),
                           at_node[node].end());
        std::sort(around[f].begin(), around[f].end());
        around[f].erase(std::unique(around[f].begin(), around[f].end()),
                        around[f].end());
      }
    if (is_self)
      {
        own_facets = std::make_unique<OwnFacets>(master);
        for (const Point &point : own_points)
          {
            dealii::Point<3> reference;
            for (const auto &[node, weight] : point.nodes)
              reference += weight * slave.nodes[node].reference_position;
            own_around.push_back(own_facets->around(reference, point.facets));
          }
      }
  }



  void
  PointsBeforeTriangles::make_quadrature_points(const Body<3> &body)
  {
    // As many points as elsewhere on a triangle of degree 1.
    const QGaussSimplex<2> rule(2);
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      {
        const auto &facet = slave.facets[f];
        if (!is_mine(body, facet.nodes[0]))
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point point;
            point.facets           = {f};
            point.weight           = 2. * rule.weight(q) * facet.measure;
            point.cell_diameter    = facet.cell_diameter;
            point.boundary_id      = facet.boundary_id;
            point.largest_overhang = half_length(f);
            point.multipliers.fill(numbers::invalid_dof_index);
            const auto  &xi           = rule.point(q);
            const double at_corner[3] = {1. - xi[0] - xi[1], xi[0], xi[1]};
            std::map<unsigned int, double> weight;
            for (unsigned int v = 0; v < 3; ++v)
              {
                slave.for_each_node_of(facet.nodes[v],
                                       [&](const unsigned int n,
                                           const double       share) {
                                         weight[n] += share * at_corner[v];
                                       });
              }
            point.nodes.assign(weight.begin(), weight.end());
            own_points.push_back(point);
          }
      }
  }



  PointsBeforeTriangles::Corners<double>
  PointsBeforeTriangles::corners(const unsigned int p,
                                 const unsigned int f,
                                 const Positions   &positions) const
  {
    const auto &nodes = master.facets[f].nodes;
    return {{position_of(own_points[p], positions.slave),
             positions.master[nodes[0]],
             positions.master[nodes[1]],
             positions.master[nodes[2]]}};
  }



  PointsBeforeTriangles::Passing::Points<double>
  PointsBeforeTriangles::corners(const unsigned int p,
                                 const unsigned int old_facet,
                                 const unsigned int new_facet,
                                 const Positions   &positions) const
  {
    Passing::Points<double> x;
    x[0] = position_of(own_points[p], positions.slave);
    for (unsigned int v = 0; v < 3; ++v)
      {
        x[1 + v] = positions.master[master.facets[old_facet].nodes[v]];
        x[4 + v] = positions.master[master.facets[new_facet].nodes[v]];
      }
    return x;
  }



  std::optional<SharedEdge>
  PointsBeforeTriangles::shared_edge(const unsigned int old_facet,
                                     const unsigned int new_facet) const
  {
    const auto &a = master.facets[old_facet];
    const auto &b = master.facets[new_facet];
    for (unsigned int e = 0; e < 3; ++e)
      if (a.neighbours[e] == new_facet)
        for (unsigned int v = 0; v < 3; ++v)
          if (b.nodes[v] != a.nodes[e] && b.nodes[v] != a.nodes[(e + 1) % 3])
            return SharedEdge{e, v};
    return {};
  }



  double
  PointsBeforeTriangles::overhang(const unsigned int p) const
  {
    const Corners<double> x    = corners(p, steps[p].old_facet, old_positions);
    const double          away = distance(x);
    return beside(away * away, PointBeforeTriangle<double>::gap(x));
  }



  bool
  PointsBeforeTriangles::is_off(const unsigned int     p,
                                const Corners<double> &x,
                                const unsigned int     f,
                                const double           tolerance) const
  {
    const Tensor<1, 3> y = to_tensor(x[0]), a = to_tensor(x[1]),
                       b = to_tensor(x[2]), c = to_tensor(x[3]);
    const auto         shares = closest_in_triangle(y, a, b, c);
    const Tensor<1, 3> away = y - shares[0] * a - shares[1] * b - shares[2] * c;
    const double       gap  = PointBeforeTriangle<double>::gap(x);
    const double       off  = beside(away.norm_square(), gap);
    const double       size =
      std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    for (unsigned int e = 0; e < 3; ++e)
      if (!master.facets[f].neighbours[e] && shares[(e + 2) % 3] == 0. &&
          off > 0.)
        return off > found_overhang(own_points[p], has_coverage);
    // A point past a convex edge may be as far away as the neighbour is in front of
    // it; a point farther off the facet than in front of it is beside it.
    return off > 1.5 * std::abs(gap) + tolerance * size;
  }



  std::optional<unsigned int>
  PointsBeforeTriangles::find_facet(
    const unsigned int                p,
    const FacetSearch<3>             &search,
    const Positions                  &positions,
    const double                      largest_distance,
    const std::optional<unsigned int> likely) const
  {
    if (is_self)
      return find_own_facet(p, search, positions, largest_distance, likely);
    const Point &point = own_points[p];
    const auto   f = search.closest_facing(position_of(point, positions.slave),
                                         normal_of(point, positions.slave),
                                         {},
                                         largest_distance,
                                         likely);
    if (!f)
      return {};
    const Corners<double> x   = corners(p, *f, positions);
    const double          gap = PointBeforeTriangle<double>::gap(x);
    // Contact does not reach through a body.
    if (is_off(p, x, *f) || !(gap > -std::sqrt(master.facets[*f].measure)))
      return {};
    // A point behind the plane of a facet, but nearer to another one that it does not
    // face, is at the far side of the body, or beside it; except if it has only just
    // entered, at an edge.
    if (gap < 0.)
      {
        // Facets as far as the facet itself, except for round-off.
        const auto nearest = search.closest_facing(
          x[0],
          x[0],
          [](const unsigned int) { return true; },
          (1. + 1e-6) * distance(x) +
            1e-6 * std::sqrt(master.facets[*f].measure),
          f);
        const Corners<double> other = corners(p, *nearest, positions);
        const double          size = std::sqrt(master.facets[*nearest].measure);
        if (*nearest != *f && distance(other) < .999 * distance(x) &&
            (gap < -.2 * size ||
             PointBeforeTriangle<double>::gap(other) > 1e-6 * size))
          return {};
      }
    return f;
  }



  std::optional<unsigned int>
  PointsBeforeTriangles::find_own_facet(
    const unsigned int                p,
    const FacetSearch<3>             &search,
    const Positions                  &positions,
    const double                      largest_distance,
    const std::optional<unsigned int> likely) const
  {
    const Point   &point  = own_points[p];
    const Position y      = position_of(point, positions.slave),
                   normal = normal_of(point, positions.slave);
    const auto &around_it = own_around[p];
    const auto  is_around = [&](const unsigned int f) {
      return std::binary_search(around_it.begin(), around_it.end(), f);
    };
    const auto f = search.closest_facing(
      y,
      normal,
      [&](const unsigned int other) {
        return !is_around(other) &&
          own_facets->can_touch(y, normal, other, positions.master);
      },
      largest_distance,
      likely);
    if (!f)
      return {};
    const Corners<double> x   = corners(p, *f, positions);
    const double          gap = PointBeforeTriangle<double>::gap(x);
    // Closer facets may be excluded: then the point is beside this one.
    if (is_off(p, x, *f, .1))
      return {};
    // A point behind the plane of a facet, but nearer to another one and in front of
    // that, is beside the body.
    if (gap < 0.)
      {
        const auto nearest = search.closest_facing(
          y,
          normal,
          [&](const unsigned int other) { return !is_around(other); },
          std::numeric_limits<double>::infinity(),
          f);
        const Corners<double> other     = corners(p, *nearest, positions);
        const bool            is_nearer = distance(other) < .999 * distance(x);
        if (*nearest != *f && is_nearer &&
            PointBeforeTriangle<double>::gap(other) >
              1e-6 * std::sqrt(master.facets[*nearest].measure))
          return {};
      }
    return f;
  }



  bool
  PointsBeforeTriangles::meets_node(const unsigned int p) const
  {
    const Point &point = own_points[p];
    if (point.multipliers[0] == numbers::invalid_dof_index)
      return false;
    const auto           &facet = master.facets[steps[p].old_facet];
    const Corners<double> x     = corners(p, steps[p].old_facet, old_positions);
    const auto            shares = closest_in_triangle(to_tensor(x[0]),
                                            to_tensor(x[1]),
                                            to_tensor(x[2]),
                                            to_tensor(x[3]));
    for (unsigned int v = 0; v < 3; ++v)
      if (shares[v] > 1. - 1e-8)
        {
          const auto &corner = master.nodes[facet.nodes[v]];
          return corner.mean_of.empty() && !corner.is_held &&
            facet.nodes[v] < point.nodes[0].first;
        }
    return false;
  }



  const std::vector<unsigned int> &
  PointsBeforeTriangles::allowed_around(const unsigned int p,
                                        const unsigned int f) const
  {
    if (!is_self)
      return around[f];
    static thread_local std::vector<unsigned int> allowed;
    allowed.clear();
    std::set_difference(around[f].begin(),
                        around[f].end(),
                        own_around[p].begin(),
                        own_around[p].end(),
                        std::back_inserter(allowed));
    return allowed;
  }



  unsigned int
  PointsBeforeTriangles::walk(const unsigned int p,
                              const unsigned int f,
                              const Position    &normal,
                              const Position    &y,
                              FacetsAround<3>   &facets) const
  {
    unsigned int closest = f;
    // A fast point may pass several facets, but not the whole surface.
    for (unsigned int n = 0; n < farthest_walk; ++n)
      {
        const auto next =
          facets.closest_facing(allowed_around(p, closest), y, normal, closest);
        if (!next || *next == closest)
          break;
        closest = *next;
      }
    return closest;
  }



  unsigned int
  PointsBeforeTriangles::last_facet(const unsigned int p,
                                    const Positions   &now,
                                    FacetsAround<3>   &facets) const
  {
    const Step        &step = steps[p];
    const unsigned int old  = step.old_facet;
    const double       size = std::sqrt(master.facets[old].measure);
    // A point that is far off needs no search.
    if (!step.may_pass)
      return old;
    const Corners<double> x = corners(p, old, now);
    if (PointBeforeTriangle<double>::gap(x) > 2. * size)
      return old;
    const unsigned int closest = walk(p, old, step.normal, x[0], facets);
    if (closest == old)
      return old;
    // Gaps that are equal except for round-off would make the choice arbitrary. The
    // search at the beginning of the next step has no such margin: the difference of
    // both gaps is an error of the energy.
    const auto   old_x  = corners(p, old, closest, old_positions);
    const auto   new_x  = corners(p, old, closest, now);
    const double change = Passing::difference(new_x);
    if (std::abs(change) < 1e-13 * size)
      return old;
    const auto edge   = shared_edge(old, closest);
    const bool passes = edge
      ? Passing::past_edge(old_x, *edge) <= 1e-9 * size &&
        Passing::past_edge(new_x, *edge) > 1e-11 * size
      : Passing::difference(old_x) * change <= 0.;
    return passes ? closest : old;
  }



  bool
  PointsBeforeTriangles::find_rounded_gap(const unsigned int           p,
                                          const unsigned int           f,
                                          const Positions             &end,
                                          const RoundedPatches::NearAt near_at)
  {
    Step &step = steps[p];
    return rounded_patches.find(f,
                                instant(p, old_positions),
                                instant(p, end),
                                near_at,
                                own_points[p].largest_overhang,
                                step.patch,
                                step.rounded_gap) &&
      step.rounded_gap.evaluate();
  }



  bool
  PointsBeforeTriangles::evaluate_rounded(const unsigned int p)
  {
    Step &step     = steps[p];
    step.new_facet = step.old_facet;
    // A point that is far off has no force, whatever its gap is.
    const double plain_gap = PointBeforeTriangle<double>::gap(
      corners(p, step.old_facet, new_positions));
    if (std::min(plain_gap, gaps[p].old_gap) >
        std::sqrt(master.facets[step.old_facet].measure))
      {
        gaps[p].new_gap = plain_gap;
        step.patch.facets.assign(1, step.old_facet);
        step.patch.open_edges.clear();
        return true;
      }
    // Values at the beginning are known from there, except for a point that was then beyond
    // an open edge by more than its largest overhang. Deep behind a sharp fold there is no
    // nearest facet, and a facet that the point only comes near later would have a weight at
    // the beginning, too. Energy would be made by that, and Newton's method has no limit:
    // the facets of the beginning stay.
    const double length = std::sqrt(master.facets[step.old_facet].measure);
    const auto   begins_as_is = [&]() {
      const auto &rounded = step.rounded_gap;
      return std::abs(rounded.old_coverage - gaps[p].old_coverage) < 1e-9 &&
        (rounded.old_coverage == 0. ||
         std::abs(rounded.old_gap - gaps[p].old_gap) < 1e-9 * length);
    };
    const auto find = [&](const NearAt near_at) {
      return find_rounded_gap(p, step.old_facet, new_positions, near_at);
    };
    if (!(find(NearAt::begin_or_end) && begins_as_is()) && !find(NearAt::begin))
      return false;
    gaps[p].old_gap      = step.rounded_gap.old_gap;
    gaps[p].new_gap      = step.rounded_gap.new_gap;
    gaps[p].old_coverage = step.rounded_gap.old_coverage;
    gaps[p].new_coverage = step.rounded_gap.new_coverage;
    return true;
  }



  void
  PointsBeforeTriangles::begin_before(const unsigned int p,
                                      const unsigned int f,
                                      const double       gap,
                                      const bool         may_pass)
  {
    gaps[p].is_before_facet = true;
    gaps[p].old_gap         = gap;
    steps[p].old_facet      = f;
    steps[p].may_pass       = may_pass;
    gaps[p].old_coverage = gaps[p].new_coverage = 1.;
    steps[p].may_be_rounded = steps[p].is_rounded = false;
  }



  void
  PointsBeforeTriangles::begin_rounded(const unsigned int p)
  {
    steps[p].may_be_rounded = steps[p].is_rounded = true;
    gaps[p].old_gap      = steps[p].rounded_gap.old_gap;
    gaps[p].old_coverage = gaps[p].new_coverage =
      steps[p].rounded_gap.old_coverage;
  }



  std::optional<unsigned int>
  PointsBeforeTriangles::likely_facet(const unsigned int p) const
  {
    if (gaps[p].is_before_facet)
      return steps[p].new_facet;
    return facets_now[p];
  }



  void
  PointsBeforeTriangles::find_facets_now()
  {
    if (keeps_facets || found_at.is_same(old_positions))
      return;
    const FacetSearch<3> search(master, old_positions.master, near_facets);
    facets_now.resize(own_points.size());
    for_each_range([&](const unsigned int begin, const unsigned int end) {
      for (unsigned int p = begin; p < end; ++p)
        if (this->may_touch(own_points[p]))
          facets_now[p] = find_facet(p,
                                     search,
                                     old_positions,
                                     smallest_reach,
                                     likely_facet(p));
    });
    found_at = old_positions;
  }



  void
  PointsBeforeTriangles::find_facet_later(const unsigned int    p,
                                          const FacetSearch<3> &search,
                                          const Positions      &later,
                                          FacetsAround<3>      &facets)
  {
    // The gap with rounded edges does not depend on the facet from which it is found.
    if (gaps[p].is_before_facet && steps[p].is_rounded)
      return;
    const auto f = find_facet(p, search, later, reach, facets_now[p]);
    if (!f)
      return;
    // A point that is behind the surface can only come to face it from the side.
    if (!is_self && find_rounded_gap(p, *f, old_positions, NearAt::begin))
      {
        const auto &rounded = steps[p].rounded_gap;
        if (rounded.old_gap > 0. || rounded.old_coverage == 0.)
          {
            begin_before(p, *f, rounded.old_gap, true);
            begin_rounded(p);
          }
        return;
      }
    // The path to this facet, from where the point is now; if the point does not face
    // this part of the surface yet, along this facet.
    const Position     y     = position_of(own_points[p], old_positions.slave);
    const unsigned int first = walk(p, *f, steps[p].normal, y, facets);
    for (const unsigned int old_facet : {first, *f})
      {
        const double gap = PointBeforeTriangle<double>::gap(
          corners(p, old_facet, old_positions));
        if (gap > 0.)
          {
            begin_before(p, old_facet, gap, old_facet == first);
            if (!is_self && old_facet == first &&
                find_rounded_gap(p, first, old_positions, NearAt::begin))
              begin_rounded(p);
            return;
          }
      }
  }



  double
  PointsBeforeTriangles::reach_of_step(const Course &course) const
  {
    return smallest_reach + longest_way(course.begin, course.end);
  }



  void
  PointsBeforeTriangles::begin_step(const ContactStart &start)
  {
    Course course;
    begin_course(start, course);
    reach                 = course.reach;
    const double way      = reach - smallest_reach;
    old_positions         = std::move(course.begin);
    new_positions         = old_positions;
    const bool has_length = start.time_step > 0.;
    find_facets_now();
    const auto later = has_length
      ? std::make_unique<FacetSearch<3>>(master, course.end.master, near_facets)
      : nullptr;
    for_each_range([&](const unsigned int begin, const unsigned int end) {
      FacetsAround<3> facets(master, old_positions.master),
        facets_between(master, course.middle.master);
      for (unsigned int p = begin; p < end; ++p)
        {
          Step &step          = steps[p];
          Gaps &gap           = gaps[p];
          gap.is_before_facet = false;
          step.up_to_date     = false;
          if (!this->may_touch(own_points[p]))
            continue;
          step.normal = normal_of(own_points[p], old_positions.slave);
          if (const auto f = facets_now[p])
            {
              begin_before(p,
                           *f,
                           PointBeforeTriangle<double>::gap(
                             corners(p, *f, old_positions)),
                           true);
              if (!is_self &&
                  find_rounded_gap(p, *f, old_positions, NearAt::begin))
                begin_rounded(p);
            }
          if (has_length &&
              (!gap.is_before_facet || may_change_facet(gap.old_gap, way)))
            find_facet_later(p, *later, course.end, facets);
          step.is_double = gap.is_before_facet && is_self && meets_node(p);
          if (step.is_double)
            gap.is_before_facet = false;
          if (!gap.is_before_facet)
            continue;
          step.new_facet    = step.old_facet;
          gap.new_gap       = gap.old_gap;
          gap.predicted_gap = gap.old_gap;
          if (has_length)
            gap.predicted_gap = PointBeforeTriangle<double>::gap(
              corners(p,
                      last_facet(p, course.middle, facets_between),
                      course.middle));
        }
    });
  }



  void
  PointsBeforeTriangles::evaluate(const Vector &solution)
  {
    read(solution, new_positions);
    for_each_range([&](const unsigned int begin, const unsigned int end) {
      FacetsAround<3> facets(master, new_positions.master);
      for (unsigned int p = begin; p < end; ++p)
        if (gaps[p].is_before_facet)
          {
            Step &step      = steps[p];
            step.up_to_date = false;
            step.is_rounded = step.may_be_rounded && evaluate_rounded(p);
            if (step.is_rounded)
              continue;
            gaps[p].new_coverage = gaps[p].old_coverage;
            step.new_facet       = last_facet(p, new_positions, facets);
            gaps[p].new_gap      = PointBeforeTriangle<double>::gap(
              corners(p, step.new_facet, new_positions));
          }
    });
  }



  void
  PointsBeforeTriangles::stay_at_vertex(const unsigned int p,
                                        const double       tolerance)
  {
    Step &step = steps[p];
    if (step.is_rounded)
      return;
    const auto  &old = master.facets[step.old_facet];
    const double gap = PointBeforeTriangle<double>::gap(
      corners(p, step.old_facet, new_positions));
    for (const unsigned int f : allowed_around(p, step.old_facet))
      if (f != step.old_facet &&
          std::abs(
            PointBeforeTriangle<double>::gap(corners(p, f, new_positions)) -
            gap) < tolerance * std::sqrt(old.measure))
        step.may_pass = false;
  }



  int
  PointsBeforeTriangles::passage(const unsigned int p) const
  {
    const Step &step = steps[p];
    if (step.is_rounded)
      return 1 + step.old_facet;
    return step.new_facet == step.old_facet ? 0 : 1 + step.new_facet;
  }



  void
  PointsBeforeTriangles::rounded_rows(const unsigned int   p,
                                      std::vector<double> &normal,
                                      std::vector<double> &coverage) const
  {
    using Triangle = PointBeforeTriangle<double>;
    static thread_local std::vector<std::array<Triangle::Row, 3>> rows;
    const RoundedPatch       &patch   = steps[p].patch;
    const RoundedGap<double> &gap     = steps[p].rounded_gap;
    const bool                is_open = !patch.open_edges.empty();
    normal.assign(3 * (1 + patch.nodes.size()), 0.);
    coverage.assign(is_open ? normal.size() : 0, 0.);
    const auto add = [&](const unsigned int   facet,
                         const double         factor,
                         const Triangle::Row &row,
                         std::vector<double> &sum) {
      for (unsigned int v = 0; v < 4; ++v)
        {
          const unsigned int to =
            v == 0 ? 0 : 3 * (1 + patch.corners[facet][v - 1]);
          for (unsigned int c = 0; c < 3; ++c)
            sum[to + c] += factor * row[3 * v + c];
        }
    };
    rows.resize(patch.facets.size());
    for (unsigned int i = 0; i < patch.facets.size(); ++i)
      {
        Triangle::Scalar                of_plane;
        std::array<Triangle::Scalar, 3> from_edges;
        Triangle::distances(corners(p, patch.facets[i], old_positions),
                            corners(p, patch.facets[i], new_positions),
                            of_plane,
                            from_edges);
        add(i, gap.of_gaps[i], of_plane.row, normal);
        for (unsigned int e = 0; e < 3; ++e)
          rows[i][e] = from_edges[e].row;
      }
    for (unsigned int e = 0; e < patch.edges.size(); ++e)
      {
        const RoundedPatch::Edge &edge     = patch.edges[e];
        const auto                add_edge = [&](const double         factor,
                                  std::vector<double> &sum) {
          add(edge.second,
              .5 * factor,
              rows[edge.second][edge.number_in_second],
              sum);
          add(edge.first,
              -.5 * factor,
              rows[edge.first][edge.number_in_first],
              sum);
        };
        add_edge(gap.of_edges[e], normal);
        if (is_open)
          add_edge(gap.coverage_of_edges[e], coverage);
      }
    for (unsigned int e = 0; e < patch.open_edges.size(); ++e)
      {
        const RoundedPatch::OpenEdge &edge = patch.open_edges[e];
        add(edge.facet,
            -gap.coverage_of_open[e],
            rows[edge.facet][edge.number],
            coverage);
      }
  }



  void
  PointsBeforeTriangles::update(const unsigned int p) const
  {
    Step &step = steps[p];
    if (step.up_to_date)
      return;
    step.up_to_date = true;

    // Rows on the coordinates of the point and of these nodes, and the increments.
    static thread_local std::vector<unsigned int> nodes;
    static thread_local std::vector<double>       normal, coverage;
    static thread_local std::array<std::vector<double>, n_tangents> tangential;
    Rows &rows = step.rows;
    nodes.clear();
    coverage.clear();
    const auto copy = [&](const auto &from) {
      normal.assign(from.normal.begin(), from.normal.end());
      for (unsigned int d = 0; d < n_tangents; ++d)
        {
          tangential[d].assign(from.tangential[d].begin(),
                               from.tangential[d].end());
          rows.slip[d] = from.slip[d];
        }
      rows.gap_increment = from.gap_increment;
    };
    const auto add_corners = [&](const unsigned int facet) {
      const auto &its_nodes = master.facets[facet].nodes;
      nodes.insert(nodes.end(), its_nodes.begin(), its_nodes.end());
    };
    add_corners(step.old_facet);
    if (step.new_facet == step.old_facet)
      {
        // Slip is along the facet where the step began.
        PointBeforeTriangle<double>::Rows one;
        PointBeforeTriangle<double>::evaluate(
          corners(p, step.old_facet, old_positions),
          corners(p, step.old_facet, new_positions),
          one,
          needs_slip);
        copy(one);
        if (is_at_edge(step))
          {
            // The first nodes of a patch are those of that facet.
            nodes = step.patch.nodes;
            rounded_rows(p, normal, coverage);
            for (unsigned int d = 0; d < n_tangents; ++d)
              tangential[d].resize(normal.size(), 0.);
            rows.gap_increment = gaps[p].new_gap - gaps[p].old_gap;
          }
      }
    else
      {
        Passing::Rows both;
        Passing::evaluate(
          corners(p, step.old_facet, step.new_facet, old_positions),
          corners(p, step.old_facet, step.new_facet, new_positions),
          shared_edge(step.old_facet, step.new_facet),
          Caution::none,
          both);
        copy(both);
        add_corners(step.new_facet);
      }

    // The unknowns that the point and the nodes move with.
    rows.unknowns.clear();
    step.shares.clear();
    const auto add = [&](const auto        &node,
                         const unsigned int corner,
                         const double       factor) {
      const auto known =
        std::find(rows.unknowns.begin(), rows.unknowns.end(), node.unknowns[0]);
      const unsigned int place = known - rows.unknowns.begin();
      if (known == rows.unknowns.end())
        rows.unknowns.insert(known, node.unknowns.begin(), node.unknowns.end());
      for (unsigned int c = 0; c < 3; ++c)
        step.shares.push_back({place + c, 3 * corner + c, factor});
    };
    for (const auto &[node, weight] : own_points[p].nodes)
      add(slave.nodes[node], 0, weight);
    for (unsigned int k = 0; k < nodes.size(); ++k)
      master.for_each_node_of(nodes[k],
                              [&](const unsigned int n, const double share) {
                                add(master.nodes[n], 1 + k, share);
                              });

    rows.normal.assign(rows.unknowns.size(), 0.);
    rows.coverage.assign(coverage.empty() ? 0 : rows.unknowns.size(), 0.);
    for (auto &row : rows.tangential)
      row.assign(rows.unknowns.size(), 0.);
    for (const Share &share : step.shares)
      {
        rows.normal[share.place] += share.factor * normal[share.coordinate];
        if (!coverage.empty())
          rows.coverage[share.place] +=
            share.factor * coverage[share.coordinate];
        for (unsigned int d = 0; d < n_tangents; ++d)
          rows.tangential[d][share.place] +=
            share.factor * tangential[d][share.coordinate];
      }
    double square = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      square += normal[c] * normal[c];
    for (unsigned int c = 0; c < 3; ++c)
      rows.direction[c] = normal[c] / std::sqrt(square);
  }



  const SurfacePair<3>::Rows &
  PointsBeforeTriangles::rows(const unsigned int p) const
  {
    update(p);
    return steps[p].rows;
  }



  template <unsigned int n_points, typename Evaluate>
  void
  PointsBeforeTriangles::differentiate(const unsigned int  p,
                                       const Coefficients &coefficients,
                                       const Evaluate     &evaluate,
                                       Derivatives        &result) const
  {
    constexpr unsigned int n = 3 * n_points;
    using Differentiable     = Sacado::Fad::SLFad<double, n>;
    const Step &step         = steps[p];
    const auto  now = corners(p, step.old_facet, step.new_facet, new_positions);
    std::array<std::array<Differentiable, 3>, n_points> x;
    for (unsigned int v = 0; v < n_points; ++v)
      for (unsigned int c = 0; c < 3; ++c)
        x[v][c] = Differentiable(n, 3 * v + c, now[v][c]);
    RowsOfPoint<Differentiable, n> all;
    evaluate(x, all);

    const unsigned int m = step.rows.unknowns.size();
    result.coverage.clear();
    result.gap.assign(m, 0.);
    for (auto &row : result.slip)
      row.assign(m, 0.);
    result.forces.assign(m * m, 0.);
    for (const Share &share : step.shares)
      {
        result.gap[share.place] +=
          share.factor * all.new_gap.dx(share.coordinate);
        for (unsigned int d = 0; needs_slip && d < n_tangents; ++d)
          result.slip[d][share.place] +=
            share.factor * all.slip[d].dx(share.coordinate);
      }
    // The force along the rows, with its derivatives.
    for (const Share &a : step.shares)
      {
        Differentiable entry =
          -coefficients.pressure * all.normal[a.coordinate];
        for (unsigned int d = 0; needs_slip && d < n_tangents; ++d)
          entry += coefficients.traction[d] * all.tangential[d][a.coordinate];
        for (const Share &b : step.shares)
          result.forces[a.place * m + b.place] +=
            a.factor * b.factor * entry.dx(b.coordinate);
      }
  }



  void
  PointsBeforeTriangles::differentiate_rounded(const unsigned int  p,
                                               const Coefficients &coefficients,
                                               const Caution       caution,
                                               Derivatives        &result) const
  {
    // The rows of gap and coverage are sums of rows of the scalars s (distances from planes,
    // coordinates of edges) with factors P(s). Both are differentiated by themselves.
    using OfTriangle = Sacado::Fad::SLFad<double, 12>;
    using OfScalars  = Sacado::Fad::SLFad<double, RoundedPatches::most_scalars>;
    using Triangle   = PointBeforeTriangle<OfTriangle>;
    const Step         &step     = steps[p];
    const RoundedPatch &patch    = step.patch;
    const unsigned int  n_facets = patch.facets.size(),
                       n_edges   = patch.edges.size(),
                       n_open    = patch.open_edges.size(),
                       n_scalars = n_facets + n_edges + n_open,
                       n         = 3 * (1 + patch.nodes.size());
    struct OfFacet
    {
      Triangle::Scalar                gap;
      std::array<Triangle::Scalar, 3> from_edges;
      Triangle::Rows                  slip;
    };
    static thread_local std::vector<OfFacet> facets;
    facets.resize(n_facets);
    for (unsigned int i = 0; i < n_facets; ++i)
      {
        const auto now = corners(p, patch.facets[i], new_positions);
        std::array<std::array<OfTriangle, 3>, 4> x;
        for (unsigned int v = 0; v < 4; ++v)
          for (unsigned int c = 0; c < 3; ++c)
            x[v][c] = OfTriangle(12, 3 * v + c, now[v][c]);
        const auto old_x = corners(p, patch.facets[i], old_positions);
        Triangle::distances(old_x, x, facets[i].gap, facets[i].from_edges);
        if (i == 0 && needs_slip)
          Triangle::evaluate(old_x, x, facets[i].slip);
      }

    static thread_local RoundedGap<OfScalars> rounded;
    const auto variable = [&](const unsigned int k, const OfTriangle &value) {
      return OfScalars(static_cast<int>(n_scalars),
                       static_cast<int>(k),
                       value.val());
    };
    rounded.counts = patch.counts;
    rounded.old_gaps.clear();
    rounded.new_gaps.clear();
    rounded.edges.clear();
    rounded.open_edges.clear();
    for (unsigned int i = 0; i < n_facets; ++i)
      {
        rounded.old_gaps.push_back(facets[i].gap.old_value);
        rounded.new_gaps.push_back(variable(i, facets[i].gap.new_value));
      }
    for (unsigned int e = 0; e < patch.edges.size(); ++e)
      {
        const RoundedPatch::Edge &edge = patch.edges[e];
        const auto &a = facets[edge.first].from_edges[edge.number_in_first];
        const auto &b = facets[edge.second].from_edges[edge.number_in_second];
        rounded.edges.push_back(
          {edge.first,
           edge.second,
           edge.width,
           edge.coordinate(a.old_value, b.old_value),
           variable(n_facets + e, edge.coordinate(a.new_value, b.new_value))});
      }
    for (unsigned int e = 0; e < n_open; ++e)
      {
        const RoundedPatch::OpenEdge &edge = patch.open_edges[e];
        const auto &s = facets[edge.facet].from_edges[edge.number];
        rounded.open_edges.push_back(
          {edge.facet,
           edge.half_overhang,
           edge.coordinate(s.old_value),
           variable(n_facets + n_edges + e, edge.coordinate(s.new_value))});
      }
    rounded.evaluate();

    // The factors of the rows of the scalars in the force, with their derivatives.
    static thread_local std::vector<OfScalars> factors;
    factors.assign(n_scalars, OfScalars(0.));
    for (unsigned int k = 0; k < n_facets + n_edges; ++k)
      factors[k] = -coefficients.pressure *
        (k < n_facets ? rounded.of_gaps[k] : rounded.of_edges[k - n_facets]);
    if (n_open > 0)
      {
        for (unsigned int e = 0; e < n_edges; ++e)
          factors[n_facets + e] +=
            coefficients.energy * rounded.coverage_of_edges[e];
        for (unsigned int e = 0; e < n_open; ++e)
          factors[n_facets + n_edges + e] =
            coefficients.energy * rounded.coverage_of_open[e];
      }

    // The rows of the scalars and their gradients, and the derivatives of rows.
    static thread_local std::vector<double> row, gradient, of_rows;
    row.assign(n_scalars * n, 0.);
    gradient.assign(n_scalars * n, 0.);
    of_rows.assign(n * n, 0.);
    const auto place = [&](const unsigned int facet, const unsigned int i) {
      return i < 3 ? i : 3 * (1 + patch.corners[facet][i / 3 - 1]) + i % 3;
    };
    const auto add_rows = [&](const unsigned int                facet,
                              const std::array<OfTriangle, 12> &its_row,
                              const double                      factor) {
      for (unsigned int i = 0; i < 12; ++i)
        for (unsigned int j = 0; j < 12; ++j)
          of_rows[place(facet, i) * n + place(facet, j)] +=
            factor * its_row[i].dx(j);
    };
    const auto add = [&](const unsigned int      facet,
                         const unsigned int      scalar,
                         const Triangle::Scalar &value,
                         const double            factor) {
      for (unsigned int i = 0; i < 12; ++i)
        {
          const unsigned int to = scalar * n + place(facet, i);
          row[to] += factor * value.row[i].val();
          gradient[to] += factor * value.new_value.dx(i);
        }
      add_rows(facet, value.row, factor * factors[scalar].val());
    };
    for (unsigned int i = 0; i < n_facets; ++i)
      add(i, i, facets[i].gap, 1.);
    for (unsigned int e = 0; e < n_edges; ++e)
      {
        const RoundedPatch::Edge &edge = patch.edges[e];
        add(edge.second,
            n_facets + e,
            facets[edge.second].from_edges[edge.number_in_second],
            .5);
        add(edge.first,
            n_facets + e,
            facets[edge.first].from_edges[edge.number_in_first],
            -.5);
      }
    for (unsigned int e = 0; e < n_open; ++e)
      {
        const RoundedPatch::OpenEdge &edge = patch.open_edges[e];
        add(edge.facet,
            n_facets + n_edges + e,
            facets[edge.facet].from_edges[edge.number],
            -1.);
      }
    static thread_local std::vector<double> of_gap, of_coverage, of_factor;
    // The slope of the weights may let Newton's method oscillate, see Caution.
    const bool has_slopes = caution == Caution::none;
    of_gap.assign(n, 0.);
    of_coverage.assign(n, 0.);
    const auto is_weight = [&](const unsigned int l) {
      return l >= n_facets && l < n_facets + n_edges;
    };
    for (unsigned int k = 0; k < n_scalars; ++k)
      {
        for (unsigned int i = 0; i < n; ++i)
          of_gap[i] += rounded.new_gap.dx(k) * gradient[k * n + i];
        for (unsigned int i = 0; n_open > 0 && i < n; ++i)
          of_coverage[i] += rounded.new_coverage.dx(k) * gradient[k * n + i];
        of_factor.assign(n, 0.);
        for (unsigned int l = 0; l < n_scalars; ++l)
          if (const double derivative = factors[k].dx(l);
              derivative != 0. && (has_slopes || !is_weight(l)))
            for (unsigned int i = 0; i < n; ++i)
              of_factor[i] += derivative * gradient[l * n + i];
        for (unsigned int i = 0; i < n; ++i)
          if (const double entry = row[k * n + i]; entry != 0.)
            for (unsigned int j = 0; j < n; ++j)
              of_rows[i * n + j] += entry * of_factor[j];
      }

    const unsigned int m = step.rows.unknowns.size();
    result.coverage.assign(n_open > 0 ? m : 0, 0.);
    result.gap.assign(m, 0.);
    for (auto &one : result.slip)
      one.assign(m, 0.);
    result.forces.assign(m * m, 0.);
    if (needs_slip)
      for (unsigned int d = 0; d < n_tangents; ++d)
        {
          add_rows(0, facets[0].slip.tangential[d], coefficients.traction[d]);
          for (const Share &share : step.shares)
            for (unsigned int i = 0; i < 12; ++i)
              if (place(0, i) == share.coordinate)
                result.slip[d][share.place] +=
                  share.factor * facets[0].slip.slip[d].dx(i);
        }
    for (const Share &a : step.shares)
      {
        result.gap[a.place] += a.factor * of_gap[a.coordinate];
        if (n_open > 0)
          result.coverage[a.place] += a.factor * of_coverage[a.coordinate];
        for (const Share &b : step.shares)
          result.forces[a.place * m + b.place] +=
            a.factor * b.factor * of_rows[a.coordinate * n + b.coordinate];
      }
  }



  const SurfacePair<3>::Derivatives &
  PointsBeforeTriangles::derivatives(const unsigned int  p,
                                     const Coefficients &coefficients,
                                     const Caution       caution) const
  {
    update(p);
    static thread_local Derivatives result;
    const Step                     &step = steps[p];
    const unsigned int              old = step.old_facet, now = step.new_facet;
    if (is_at_edge(step))
      differentiate_rounded(p, coefficients, caution, result);
    else if (now == old)
      differentiate<4>(
        p,
        coefficients,
        [&](const auto &x, auto &rows) {
          using Number = std::decay_t<decltype(x[0][0])>;
          PointBeforeTriangle<Number>::evaluate(corners(p, old, old_positions),
                                                x,
                                                rows,
                                                needs_slip);
        },
        result);
    else
      differentiate<7>(
        p,
        coefficients,
        [&](const auto &x, auto &rows) {
          using Number = std::decay_t<decltype(x[0][0])>;
          PointPassingTriangles<Number>::evaluate(
            corners(p, old, now, old_positions),
            x,
            shared_edge(old, now),
            caution,
            rows);
        },
        result);
    return result;
  }



  std::vector<SurfacePair<3>::Index>
  PointsBeforeTriangles::unknowns_nearby(const unsigned int p) const
  {
    std::vector<Index> unknowns = rows(p).unknowns;
    const auto         add      = [&](const auto &node) {
      unknowns.insert(unknowns.end(),
                      node.unknowns.begin(),
                      node.unknowns.end());
    };
    // The neighbours to which the point may pass.
    for (const auto &neighbour : master.facets[steps[p].old_facet].neighbours)
      if (neighbour)
        for (const unsigned int n : master.facets[*neighbour].nodes)
          {
            master.for_each_node_of(n,
                                    [&](const unsigned int of,
                                        const double /*share*/) {
                                      add(master.nodes[of]);
                                    });
          }
    for (const Index multiplier : own_points[p].multipliers)
      if (multiplier != numbers::invalid_dof_index)
        unknowns.push_back(multiplier);
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                   unknowns.end());
    return unknowns;
  }



  double
  PointsBeforeTriangles::round_off(const unsigned int p) const
  {
    // Round-off of differences of positions, each of which is a reference position
    // plus a displacement.
    double             size   = 0.;
    const Position     y      = position_of(own_points[p], new_positions.slave);
    const auto        &own    = slave.nodes[own_points[p].nodes[0].first];
    const unsigned int corner = master.facets[steps[p].new_facet].nodes[0];
    for (unsigned int c = 0; c < 3; ++c)
      size += std::abs(y[c]) + std::abs(own.reference_position[c]) +
        std::abs(new_positions.master[corner][c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }
} // namespace Ricochet
