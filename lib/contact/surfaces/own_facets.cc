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
  } // namespace



  OwnFacets::OwnFacets(const ContactSurface<3> &surface)
    : surface(surface)
    , facets_at_node(surface.nodes.size())
  {
    for (const auto &node : surface.nodes)
      reference_positions.push_back({{node.reference_position[0],
                                      node.reference_position[1],
                                      node.reference_position[2]}});
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      for (const unsigned int n : nodes_of(f))
        facets_at_node[n].push_back(f);
    const FacetSearch<3> search(surface, reference_positions);
    for (unsigned int f = 0; f < surface.facets.size(); ++f)
      {
        const auto         &own  = surface.facets[f];
        const double        size = std::sqrt(own.measure);
        const Tensor<1, 3> &n    = own.normal;
        Tensor<1, 3>        middle;
        for (const unsigned int node : own.nodes)
          middle += to_tensor(reference_positions[node]) / 3.;
        // The closest facet behind it that faces the other way ends the wall.
        const Position y   = {{middle[0], middle[1], middle[2]}};
        const auto     end = search.closest_facing(
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
      }
  }



  std::vector<unsigned int>
  OwnFacets::nodes_of(const unsigned int f) const
  {
    std::vector<unsigned int> nodes;
    for (const unsigned int n : surface.facets[f].nodes)
      {
        const auto &mean_of = surface.nodes[n].mean_of;
        if (mean_of.empty())
          nodes.push_back(n);
        nodes.insert(nodes.end(), mean_of.begin(), mean_of.end());
      }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }



  std::vector<unsigned int>
  OwnFacets::beside(const std::vector<unsigned int> &facets) const
  {
    std::vector<unsigned int> result;
    for (const unsigned int f : facets)
      for (const unsigned int n : nodes_of(f))
        result.insert(result.end(),
                      facets_at_node[n].begin(),
                      facets_at_node[n].end());
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
  }



  bool
  OwnFacets::can_touch(const Observer              &point,
                       const unsigned int           f,
                       const std::vector<Position> &positions) const
  {
    if (std::binary_search(point.beside.begin(), point.beside.end(), f))
      return false;
    const auto        &facet = surface.facets[f];
    const Tensor<1, 3> n   = to_tensor(facet_normal<3>(surface, positions, f)),
                       own = to_tensor(point.normal);
    const double lengths = n.norm() * own.norm(), product = n * own;
    // Where a surface is about to be folded it does not face itself yet; but what is
    // behind such a facet is only round a corner.
    if (product > std::sqrt(.5) * lengths)
      return false;
    const Tensor<1, 3> y     = to_tensor(point.y),
                       there = closest_point(surface, f, positions, y) - y;
    const double gap =
      n * (y - to_tensor(positions[facet.nodes[0]])) / n.norm();
    if (gap > 0.)
      return there * own >= -.1 * there.norm() * own.norm();
    // What is pressed in is before the facet, or not far beside it in a valley.
    if (product >= 0. ||
        there.norm() > 1.5 * -gap + 1e-6 * std::sqrt(facet.measure))
      return false;
    double depth = largest_depth[f];
    // What was there before any displacement has hardly come nearer by more than half.
    if (facet.part == surface.facets[point.facet].part)
      depth = std::min(
        depth,
        .5 *
          (closest_point(surface, f, reference_positions, point.reference) -
           point.reference)
            .norm());
    return gap > -depth;
  }
} // namespace Ricochet
