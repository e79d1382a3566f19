// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>
#include <contact/surfaces/own_facets.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The point of facet @p f that is closest to @p y.
    Tensor<1, 3>
    closest_point(const ContactSurface<3>                  &surface,
                  const unsigned int                        f,
                  const std::vector<std::array<double, 3>> &positions,
                  const Tensor<1, 3>                       &y)
    {
      std::array<Tensor<1, 3>, 3> x;
      for (unsigned int v = 0; v < 3; ++v)
        x[v] = to_tensor(positions[surface.facets[f].nodes[v]]);
      const auto shares = closest_in_triangle(y, x[0], x[1], x[2]);
      return shares[0] * x[0] + shares[1] * x[1] + shares[2] * x[2];
    }
    std::vector<std::array<double, 3>>
    positions_before(const ContactSurface<3> &surface)
    {
      std::vector<std::array<double, 3>> positions;
      for (const auto &node : surface.nodes)
        positions.push_back({{node.reference_position[0],
                              node.reference_position[1],
                              node.reference_position[2]}});
      return positions;
    }
  } // namespace



  OwnFacets::OwnFacets(const ContactSurface<3> &surface)
    : surface(surface)
    , facets_at_node(surface.nodes.size())
    , reference_positions(positions_before(surface))
    , reference_search(surface, reference_positions)
  {
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      for (const unsigned int n : nodes_of(f))
        facets_at_node[n].push_back(f);
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      {
        const auto         &own  = surface.facets[f];
        const double        size = std::sqrt(own.measure);
        const Tensor<1, 3> &n    = own.normal;
        Tensor<1, 3>        middle;
        for (const unsigned int node : own.nodes)
          middle += to_tensor(reference_positions[node]) / 3.;
        // The closest facet behind it with opposite orientation ends the wall.
        const Position y   = {{middle[0], middle[1], middle[2]}};
        const auto     end = reference_search.closest_facing(
          y,
          y,
          [&](const unsigned int other) {
            const auto &facet = surface.facets[other];
            return facet.part == own.part && facet.normal * n < 0. &&
              (closest_point(surface, other, reference_positions, middle) -
               middle) *
                n <
              -1e-6 * size;
          },
          2. * size);
        largest_depth.push_back(
          end ? std::min(
                  size,
                  .5 *
                    (closest_point(surface, *end, reference_positions, middle) -
                     middle)
                      .norm())
              : size);
        double longest = 0.;
        for (unsigned int v = 0; v < 3; ++v)
          longest =
            std::max(longest,
                     (to_tensor(reference_positions[own.nodes[(v + 1) % 3]]) -
                      to_tensor(reference_positions[own.nodes[v]]))
                       .norm());
        longest_edge.push_back(longest);
      }
  }



  std::vector<unsigned int>
  OwnFacets::nodes_of(const unsigned int f) const
  {
    std::vector<unsigned int> nodes;
    for (const unsigned int n : surface.facets[f].nodes)
      surface.for_each_node_of(n, [&](const unsigned int of, const double) {
        nodes.push_back(of);
      });
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }



  std::vector<unsigned int>
  OwnFacets::around(const Point<3>                  &reference,
                    const std::vector<unsigned int> &own) const
  {
    std::vector<unsigned int> result;
    for (const unsigned int f : own)
      for (const unsigned int n : nodes_of(f))
        result.insert(result.end(),
                      facets_at_node[n].begin(),
                      facets_at_node[n].end());
    // Factor on the size of the next elements beyond which facets behind are
    // left out.
    constexpr double n_edges = 3.;
    const double     reach =
      n_edges * *std::max_element(longest_edge.begin(), longest_edge.end());
    Position lower, upper;
    for (unsigned int c = 0; c < 3; ++c)
      {
        lower[c] = reference[c] - reach;
        upper[c] = reference[c] + reach;
      }
    for (const unsigned int f : reference_search.near(lower, upper))
      {
        const auto        &facet = surface.facets[f];
        const Tensor<1, 3> a = to_tensor(reference_positions[facet.nodes[0]]);
        if (facet.part == surface.facets[own[0]].part &&
            facet.normal * (reference - a) < 1e-6 * longest_edge[f] &&
            (closest_point(surface, f, reference_positions, reference) -
             reference)
                .norm() < n_edges * longest_edge[f])
          result.push_back(f);
      }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }



  bool
  OwnFacets::can_touch(const Position              &y,
                       const Position              &normal,
                       const unsigned int           f,
                       const std::vector<Position> &positions) const
  {
    const Tensor<1, 3> n   = to_tensor(facet_normal<3>(surface, positions, f)),
                       own = to_tensor(normal);
    const double product   = n * own;
    // A surface about to be folded does not face itself yet; a facet behind
    // such a one is only round a corner.
    if (product > std::sqrt(.5) * n.norm() * own.norm())
      return false;
    const Tensor<1, 3> point = to_tensor(y);
    const double       gap =
      n * (point - to_tensor(positions[surface.facets[f].nodes[0]])) / n.norm();
    if (gap > 0.)
      return (closest_point(surface, f, positions, point) - point) * own >= 0.;
    return product < 0. && gap > -largest_depth[f];
  }
} // namespace Ricochet
