// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/points_before_triangles.h>
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Of the first of @p x from the triangle between the others.
    double
    distance(const std::array<std::array<double, 3>, 4> &x)
    {
      const Tensor<1, 3> y = to_tensor(x[0]), a = to_tensor(x[1]),
                         b = to_tensor(x[2]), c = to_tensor(x[3]);
      const auto shares = closest_in_triangle(y, a, b, c);
      return (y - shares[0] * a - shares[1] * b - shares[2] * c).norm();
    }
  } // namespace



  PointsBeforeTriangles::PointsBeforeTriangles(const Body<3>     &body,
                                               const ContactPair &pair,
                                               const PointsIn     points_in)
    : SurfacePair<3>(body, pair)
  {
    if (is_self)
      throw InputError(
        "Contact of a surface with itself is there in the plane only.");
    if (points_in == PointsIn::quadrature_points)
      make_quadrature_points(body);
    else
      make_nodal_points(body);
    gaps.resize(own_points.size());
    steps.resize(own_points.size());
  }



  void
  PointsBeforeTriangles::make_quadrature_points(const Body<3> &body)
  {
    // As many as a triangle of degree 1 has elsewhere.
    const QGaussSimplex<2> rule(2);
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      {
        const auto &facet = slave.facets[f];
        if (!is_mine(body, facet.nodes[0]))
          continue;
        for (unsigned int q = 0; q < rule.size(); ++q)
          {
            Point point;
            point.facets        = {f};
            point.weight        = 2. * rule.weight(q) * facet.measure;
            point.cell_diameter = facet.cell_diameter;
            point.boundary_id   = facet.boundary_id;
            point.multipliers.fill(numbers::invalid_dof_index);
            point.can_touch           = false;
            const auto  &xi           = rule.point(q);
            const double at_corner[3] = {1. - xi[0] - xi[1], xi[0], xi[1]};
            std::map<unsigned int, double> weight;
            for (unsigned int v = 0; v < 3; ++v)
              {
                const auto &mean_of = slave.nodes[facet.nodes[v]].mean_of;
                if (mean_of.empty())
                  weight[facet.nodes[v]] += at_corner[v];
                for (const unsigned int of : mean_of)
                  weight[of] += at_corner[v] / mean_of.size();
              }
            point.nodes.assign(weight.begin(), weight.end());
            for (const auto &node : point.nodes)
              point.can_touch =
                point.can_touch || !slave.nodes[node.first].is_held;
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



  bool
  PointsBeforeTriangles::is_off(const Corners<double> &x,
                                const unsigned int     f) const
  {
    const Tensor<1, 3> y = to_tensor(x[0]), a = to_tensor(x[1]),
                       b = to_tensor(x[2]), c = to_tensor(x[3]);
    const auto         shares = closest_in_triangle(y, a, b, c);
    const Tensor<1, 3> away = y - shares[0] * a - shares[1] * b - shares[2] * c;
    const double       gap  = PointBeforeTriangle<double>::gap(x);
    const double       beside =
      std::sqrt(std::max(0., away.norm_square() - gap * gap));
    const double size =
      std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    // Edges of bodies of the same size may meet, and what is pressed into a facet that
    // turns is not off its end for that.
    if (beside > 1e-6 * size + std::max(0., -gap))
      for (unsigned int e = 0; e < 3; ++e)
        if (!master.facets[f].neighbours[e] && shares[(e + 2) % 3] == 0.)
          return true;
    // Past a convex edge points may be as far as the neighbour is before them; what is
    // farther off the facet than before it is beside it.
    return beside > 1.5 * std::abs(gap) + .5 * size;
  }



  std::optional<unsigned int>
  PointsBeforeTriangles::find_facet(const unsigned int    p,
                                    const FacetSearch<3> &search,
                                    const Positions      &positions) const
  {
    const Point &point = own_points[p];
    const auto   f = search.closest_facing(position_of(point, positions.slave),
                                         normal_of(point, positions.slave));
    if (!f)
      return {};
    const Corners<double> x   = corners(p, *f, positions);
    const double          gap = PointBeforeTriangle<double>::gap(x);
    // Contact does not reach through a body.
    if (is_off(x, *f) || !(gap > -std::sqrt(master.facets[*f].measure)))
      return {};
    // What is behind the plane of a facet, but nearer to another one that it does not
    // face, is outside of the body, or at its far side.
    if (gap < 0.)
      {
        const auto nearest =
          search.closest_facing(x[0], x[0], [](const unsigned int) {
            return true;
          });
        if (*nearest != *f &&
            distance(corners(p, *nearest, positions)) < .999 * distance(x))
          return {};
      }
    return f;
  }



  void
  PointsBeforeTriangles::set_facet(const unsigned int p, const unsigned int f)
  {
    Gaps &gap           = gaps[p];
    gap.is_before_facet = true;
    gap.old_gap =
      PointBeforeTriangle<double>::gap(corners(p, f, old_positions));
    gap.new_gap    = gap.old_gap;
    steps[p].facet = f;
  }



  void
  PointsBeforeTriangles::begin_step(const ContactStart &start)
  {
    get_positions(start.solution, old_positions);
    get_multipliers();
    new_positions         = old_positions;
    const bool has_length = start.time_step > 0.;
    Positions  middle     = old_positions, end;
    if (has_length)
      {
        get_positions(start.mean_velocity,
                      middle,
                      &old_positions,
                      .5 * start.time_step);
        get_positions(start.mean_velocity,
                      end,
                      &old_positions,
                      start.time_step);
      }
    const FacetSearch<3> search(master, middle.master);
    const auto           later = has_length
                ? std::make_unique<FacetSearch<3>>(master, end.master)
                : nullptr;
    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        gaps[p].is_before_facet = false;
        steps[p].up_to_date     = false;
        if (!own_points[p].can_touch)
          continue;
        if (const auto f = find_facet(p, search, middle))
          set_facet(p, *f);
        // What is fast may pass a whole triangle in a step.
        else if (has_length)
          if (const auto at_end = find_facet(p, *later, end))
            set_facet(p, *at_end);
        if (gaps[p].is_before_facet)
          gaps[p].predicted_gap = PointBeforeTriangle<double>::gap(
            corners(p, steps[p].facet, middle));
      }
  }



  void
  PointsBeforeTriangles::evaluate(const Vector &solution)
  {
    get_positions(solution, new_positions);
    get_multipliers();
    for (unsigned int p = 0; p < own_points.size(); ++p)
      if (gaps[p].is_before_facet)
        {
          gaps[p].new_gap = PointBeforeTriangle<double>::gap(
            corners(p, steps[p].facet, new_positions));
          steps[p].up_to_date = false;
        }
  }



  void
  PointsBeforeTriangles::update(const unsigned int p) const
  {
    Step &step = steps[p];
    if (step.up_to_date)
      return;
    step.up_to_date = true;
    PointBeforeTriangle<double>::evaluate(corners(p, step.facet, old_positions),
                                          corners(p, step.facet, new_positions),
                                          triangle_rows);
    Rows &rows         = step.rows;
    rows.gap_increment = triangle_rows.gap_increment;
    for (unsigned int d = 0; d < n_tangents; ++d)
      rows.slip[d] = triangle_rows.slip[d];

    // The nodes that the point and the corners move with.
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
    for (unsigned int v = 0; v < 3; ++v)
      {
        const auto &node = master.nodes[master.facets[step.facet].nodes[v]];
        if (node.mean_of.empty())
          add(node, v + 1, 1.);
        for (const unsigned int of : node.mean_of)
          add(master.nodes[of], v + 1, 1. / node.mean_of.size());
      }

    rows.normal.assign(rows.unknowns.size(), 0.);
    for (auto &row : rows.tangential)
      row.assign(rows.unknowns.size(), 0.);
    for (const Share &share : step.shares)
      {
        rows.normal[share.place] +=
          share.factor * triangle_rows.normal[share.coordinate];
        for (unsigned int d = 0; d < n_tangents; ++d)
          rows.tangential[d][share.place] +=
            share.factor * triangle_rows.tangential[d][share.coordinate];
      }
    double square = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      square += triangle_rows.normal[c] * triangle_rows.normal[c];
    for (unsigned int c = 0; c < 3; ++c)
      rows.direction[c] = triangle_rows.normal[c] / std::sqrt(square);
  }



  const SurfacePair<3>::Rows &
  PointsBeforeTriangles::rows(const unsigned int p) const
  {
    update(p);
    return steps[p].rows;
  }



  const SurfacePair<3>::Derivatives &
  PointsBeforeTriangles::derivatives(const unsigned int p,
                                     const double       pressure,
                                     const Tangential  &traction,
                                     const Caution /*caution*/) const
  {
    update(p);
    const Step             &step = steps[p];
    const Corners<double>   now  = corners(p, step.facet, new_positions);
    Corners<Differentiable> x;
    for (unsigned int v = 0; v < 4; ++v)
      for (unsigned int c = 0; c < 3; ++c)
        x[v][c] = Differentiable(12, 3 * v + c, now[v][c]);
    auto &all = differentiable_rows;
    PointBeforeTriangle<Differentiable>::evaluate(corners(p,
                                                          step.facet,
                                                          old_positions),
                                                  x,
                                                  all);

    const unsigned int m = step.rows.unknowns.size();
    result.gap.assign(m, 0.);
    for (auto &row : result.slip)
      row.assign(m, 0.);
    result.forces.assign(m * m, 0.);
    for (const Share &share : step.shares)
      {
        result.gap[share.place] +=
          share.factor * all.new_gap.dx(share.coordinate);
        for (unsigned int d = 0; d < n_tangents; ++d)
          result.slip[d][share.place] +=
            share.factor * all.slip[d].dx(share.coordinate);
      }
    // The force along the rows, with its derivatives.
    for (const Share &a : step.shares)
      {
        Differentiable entry = -pressure * all.normal[a.coordinate];
        for (unsigned int d = 0; d < n_tangents; ++d)
          entry += traction[d] * all.tangential[d][a.coordinate];
        for (const Share &b : step.shares)
          result.forces[a.place * m + b.place] +=
            a.factor * b.factor * entry.dx(b.coordinate);
      }
    return result;
  }



  std::vector<SurfacePair<3>::Index>
  PointsBeforeTriangles::unknowns_nearby(const unsigned int p) const
  {
    // The facet stays the same during a step.
    std::vector<Index> unknowns = rows(p).unknowns;
    for (const Index multiplier : own_points[p].multipliers)
      if (multiplier != numbers::invalid_dof_index)
        unknowns.push_back(multiplier);
    std::sort(unknowns.begin(), unknowns.end());
    return unknowns;
  }



  double
  PointsBeforeTriangles::round_off(const unsigned int p) const
  {
    // That of differences of positions, each of which is that of the reference and a
    // displacement.
    double             size   = 0.;
    const Position     y      = position_of(own_points[p], new_positions.slave);
    const auto        &own    = slave.nodes[own_points[p].nodes[0].first];
    const unsigned int corner = master.facets[steps[p].facet].nodes[0];
    for (unsigned int c = 0; c < 3; ++c)
      size += std::abs(y[c]) + std::abs(own.reference_position[c]) +
        std::abs(new_positions.master[corner][c]);
    return 2. * std::numeric_limits<double>::epsilon() * size;
  }
} // namespace Ricochet
