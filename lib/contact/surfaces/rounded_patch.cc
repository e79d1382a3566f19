// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/point_before_triangle.h>
#include <contact/surfaces/rounded_patch.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  namespace
  {
    using Triangle = PointBeforeTriangle<double>;
    using Edge     = RoundedPatch::Edge;
  } // namespace



  RoundedPatches::RoundedPatches(const ContactSurface<3> &surface)
    : surface(surface)
    , at_node(surface.nodes.size())
  {
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      for (const unsigned int node : surface.facets[f].nodes)
        at_node[node].push_back(f);
    for (const auto &facet : surface.facets)
      has_open_edge.push_back(
        std::any_of(facet.neighbours.begin(),
                    facet.neighbours.end(),
                    [](const auto &neighbour) { return !neighbour; }));
    // Beyond a node the lines of a triangle's edges at an angle of more than 30 degrees are
    // farther off than their roundings.
    for (const auto &facets : at_node)
      {
        double largest = 0.;
        for (const unsigned int f : facets)
          largest = std::max(largest, largest_width(f));
        radius_of_node.push_back(4. * largest);
      }
  }



  double
  RoundedPatches::largest_width(const unsigned int f) const
  {
    // Wide enough for the slope of a pressure between two triangles to be moderate against
    // the stiffness of a body, and narrow against the triangles.
    return .1 * std::sqrt(surface.facets[f].measure);
  }



  double
  RoundedPatches::width(const unsigned int f, const unsigned int other) const
  {
    return std::min(largest_width(f), largest_width(other));
  }



  unsigned int
  RoundedPatches::number_of_edge(const unsigned int f,
                                 const unsigned int neighbour) const
  {
    const auto &neighbours = surface.facets[f].neighbours;
    return std::find(neighbours.begin(), neighbours.end(), neighbour) -
      neighbours.begin();
  }



  std::array<RoundedPatches::Position, 4>
  RoundedPatches::corners(const unsigned int f, const Instant &instant) const
  {
    const auto &nodes = surface.facets[f].nodes;
    return {{instant.point,
             instant.nodes[nodes[0]],
             instant.nodes[nodes[1]],
             instant.nodes[nodes[2]]}};
  }



  RoundedPatches::Distances
  RoundedPatches::distances(const std::array<Position, 4> &x)
  {
    Distances result;
    result.from_edges = Triangle::distances_from_edges(x);
    result.from_plane = Triangle::gap(x);
    for (unsigned int v = 0; v < 3; ++v)
      {
        double square = -result.from_plane * result.from_plane;
        for (unsigned int c = 0; c < 3; ++c)
          square += (x[0][c] - x[1 + v][c]) * (x[0][c] - x[1 + v][c]);
        result.from_nodes[v] = std::sqrt(std::max(0., square));
      }
    return result;
  }



  void
  RoundedPatches::add(const unsigned int f,
                      const Instant     &begin,
                      const Instant     &end,
                      Candidates        &candidates) const
  {
    auto &facets = candidates.facets;
    if (std::find(facets.begin(), facets.end(), f) != facets.end())
      return;
    facets.push_back(f);
    candidates.distances.push_back(
      {{distances(corners(f, begin)), distances(corners(f, end))}});
  }



  double
  RoundedPatches::coordinate(const Candidates  &candidates,
                             const Edge        &edge,
                             const unsigned int k) const
  {
    const auto &all = candidates.distances;
    return edge.coordinate(
      all[edge.first][k].from_edges[edge.number_in_first],
      all[edge.second][k].from_edges[edge.number_in_second]);
  }



  bool
  RoundedPatches::collect(const unsigned int f,
                          const Instant     &begin,
                          const Instant     &end,
                          const NearAt       near_at,
                          const double       largest_overhang,
                          Candidates        &candidates) const
  {
    constexpr std::size_t most = 64;
    const unsigned int    last = near_at == NearAt::begin ? 0 : 1;
    candidates.facets.clear();
    candidates.distances.clear();
    add(f, begin, end, candidates);
    auto &facets = candidates.facets;
    for (unsigned int i = 0; i < facets.size(); ++i)
      {
        const unsigned int             own   = facets[i];
        const auto                    &facet = surface.facets[own];
        const std::array<Distances, 2> its{
          {candidates.distances[i][0], candidates.distances[i][last]}};
        // Beyond an open edge the lines of inner edges diverge, so that a point there may
        // have weights of several facets along the border.
        bool is_beyond = false;
        for (unsigned int e = 0; e < 3; ++e)
          is_beyond = is_beyond ||
            (!facet.neighbours[e] &&
             std::min(its[0].from_edges[e], its[1].from_edges[e]) < 0.);
        const double farther = is_beyond ? 2. * largest_overhang : 0.;
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int node = facet.nodes[v];
            const double       distance =
              std::min(its[0].from_nodes[v], its[1].from_nodes[v]);
            const bool is_near = distance < radius_of_node[node];
            if (is_near || distance < radius_of_node[node] + farther)
              for (const unsigned int other : at_node[node])
                if (is_near || has_open_edge[other])
                  add(other, begin, end, candidates);
          }
        // At an edge at which the surface turns by less than a right angle, a point is no
        // farther inside of the neighbour than its distance from the plane.
        const auto is_far_inside = [&](const unsigned int e) {
          return std::all_of(its.begin(), its.end(), [&](const auto &at) {
            return at.from_edges[e] >
              2. * largest_width(own) + std::abs(at.from_plane);
          });
        };
        for (unsigned int e = 0; e < 3; ++e)
          if (facet.neighbours[e] && !is_far_inside(e))
            {
              const unsigned int other = *facet.neighbours[e];
              const unsigned int n     = facets.size();
              add(other, begin, end, candidates);
              if (facets.size() == n)
                continue;
              const Edge edge{i, n, e, number_of_edge(other, own), 0.};
              if (std::max(coordinate(candidates, edge, 0),
                           coordinate(candidates, edge, last)) <=
                  -width(own, other))
                {
                  facets.pop_back();
                  candidates.distances.pop_back();
                }
            }
        if (facets.size() > most)
          return false;
      }
    return true;
  }



  void
  RoundedPatches::collect_edges(const Candidates  &candidates,
                                std::vector<Edge> &edges) const
  {
    edges.clear();
    const auto &facets = candidates.facets;
    for (unsigned int i = 0; i < facets.size(); ++i)
      for (unsigned int e = 0; e < 3; ++e)
        if (const auto other = surface.facets[facets[i]].neighbours[e])
          {
            const unsigned int j =
              std::find(facets.begin(), facets.end(), *other) - facets.begin();
            if (j < facets.size() && j > i)
              edges.push_back({i,
                               j,
                               e,
                               number_of_edge(*other, facets[i]),
                               width(facets[i], *other)});
          }
  }



  bool
  RoundedPatches::find(const unsigned int  f,
                       const Instant      &begin,
                       const Instant      &end,
                       const NearAt        near_at,
                       const double        largest_overhang,
                       RoundedPatch       &patch,
                       RoundedGap<double> &gap) const
  {
    static thread_local Candidates        candidates;
    static thread_local std::vector<Edge> edges;
    if (!collect(f, begin, end, near_at, largest_overhang, candidates))
      return false;
    collect_edges(candidates, edges);

    // Weights at both instants, and the edges where they change.
    const unsigned int n_candidates = candidates.facets.size();
    static thread_local std::vector<std::array<double, 2>> weights;
    static thread_local std::vector<bool>                  is_constant;
    weights.assign(n_candidates, {{1., 1.}});
    is_constant.clear();
    for (const Edge &edge : edges)
      {
        std::array<double, 2> beyond;
        for (unsigned int k = 0; k < 2; ++k)
          {
            beyond[k] =
              SmoothStep::value(coordinate(candidates, edge, k) / edge.width);
            weights[edge.first][k] *= 1. - beyond[k];
            weights[edge.second][k] *= beyond[k];
          }
        is_constant.push_back(beyond[0] == beyond[1] &&
                              (beyond[0] == 0. || beyond[0] == 1.));
      }

    // Facets without a weight at both instants are left out, except where an edge of another
    // one depends on them; so are edges that change nothing.
    const auto counts = [&](const unsigned int i) {
      return weights[i][0] > 0. || weights[i][1] > 0.;
    };
    constexpr unsigned int                        left_out = -1;
    static thread_local std::vector<unsigned int> number;
    number.assign(n_candidates, left_out);
    number[0] = 0;
    for (unsigned int i = 0; i < n_candidates; ++i)
      if (counts(i))
        number[i] = 0;
    for (unsigned int e = 0; e < edges.size(); ++e)
      if (!is_constant[e] &&
          (counts(edges[e].first) || counts(edges[e].second)))
        number[edges[e].first] = number[edges[e].second] = 0;
    patch.facets.clear();
    patch.counts.clear();
    gap.old_gaps.clear();
    gap.new_gaps.clear();
    for (unsigned int i = 0; i < n_candidates; ++i)
      if (number[i] != left_out)
        {
          number[i] = patch.facets.size();
          patch.facets.push_back(candidates.facets[i]);
          patch.counts.push_back(counts(i));
          gap.old_gaps.push_back(candidates.distances[i][0].from_plane);
          gap.new_gaps.push_back(candidates.distances[i][1].from_plane);
        }
    gap.counts = patch.counts;
    patch.open_edges.clear();
    gap.open_edges.clear();
    for (unsigned int i = 0; i < n_candidates; ++i)
      for (unsigned int e = 0; counts(i) && e < 3; ++e)
        {
          const auto &at = candidates.distances[i];
          if (surface.facets[candidates.facets[i]].neighbours[e] ||
              std::min(at[0].from_edges[e], at[1].from_edges[e]) >= 0.)
            continue;
          const RoundedPatch::OpenEdge edge{number[i],
                                            e,
                                            .5 * largest_overhang};
          patch.open_edges.push_back(edge);
          gap.open_edges.push_back({number[i],
                                    edge.half_overhang,
                                    edge.coordinate(at[0].from_edges[e]),
                                    edge.coordinate(at[1].from_edges[e])});
        }
    patch.edges.clear();
    gap.edges.clear();
    for (const Edge &edge : edges)
      if (number[edge.first] != left_out && number[edge.second] != left_out)
        {
          patch.edges.push_back(edge);
          patch.edges.back().first  = number[edge.first];
          patch.edges.back().second = number[edge.second];
          gap.edges.push_back({number[edge.first],
                               number[edge.second],
                               edge.width,
                               coordinate(candidates, edge, 0),
                               coordinate(candidates, edge, 1)});
        }
    if (patch.facets.size() + patch.edges.size() + patch.open_edges.size() >
        most_scalars)
      return false;

    patch.nodes.clear();
    patch.corners.clear();
    for (const unsigned int facet : patch.facets)
      {
        patch.corners.emplace_back();
        for (unsigned int v = 0; v < 3; ++v)
          {
            const unsigned int node = surface.facets[facet].nodes[v];
            const auto         known =
              std::find(patch.nodes.begin(), patch.nodes.end(), node);
            patch.corners.back()[v] = known - patch.nodes.begin();
            if (known == patch.nodes.end())
              patch.nodes.push_back(node);
          }
      }
    return true;
  }

} // namespace Ricochet
