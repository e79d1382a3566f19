// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/pair_before_chains.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  template <int dim>
  typename PairBeforeChains<dim>::Chain
  PairBeforeChains<dim>::chain_around(const unsigned int f,
                                      unsigned int      &place) const
  {
    unsigned int first = f;
    for (unsigned int k = 0; k < Chain::n_beside; ++k)
      if (const auto previous = master.facets[first].previous)
        first = *previous;
    // Chains go round a closed surface of few facets more than once.
    Chain chain;
    chain.nodes.push_back(master.facets[first].nodes[0]);
    std::optional<unsigned int> facet         = first;
    unsigned int                n_behind_last = 0;
    bool                        passed        = false;
    while (facet && n_behind_last <= Chain::n_beside)
      {
        if (!passed && *facet == f)
          place = chain.facets.size();
        chain.facets.push_back(*facet);
        if constexpr (dim == 2)
          chain.nodes.push_back(master.facets[*facet].nodes[1]);
        passed = passed || *facet == f;
        n_behind_last += passed ? 1 : 0;
        facet = master.facets[*facet].next;
      }
    return chain;
  }



  template <int dim>
  const std::vector<typename PairBeforeChains<dim>::Position> &
  PairBeforeChains<dim>::gather(const Position              &y,
                                const Chain                 &chain,
                                const std::vector<Position> &master_x) const
  {
    work.assign(1, y);
    for (const unsigned int node : chain.nodes)
      work.push_back(master_x[node]);
    return work;
  }



  template <int dim>
  double
  PairBeforeChains<dim>::gap_before(const std::vector<Position> &x,
                                    const Chain                 &chain,
                                    const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return master.facets[chain.facets[facet]].normal[0] * (x[0][0] - x[1][0]);
    else
      return FacetChain<double>::gap(x, facet);
  }



  template <int dim>
  unsigned int
  PairBeforeChains<dim>::facet_before(const std::vector<Position> &x,
                                      const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return facet;
    else
      return FacetChain<double>::facet_before(x, facet);
  }



  template <int dim>
  std::pair<double, double>
  PairBeforeChains<dim>::place_along(const std::vector<Position> &x,
                                     const unsigned int           facet)
  {
    if constexpr (dim == 1)
      return {0., 0.};
    else
      {
        const Position &a = x[facet + 1], &b = x[facet + 2];
        const double    length = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double    along  = ((b[0] - a[0]) * (x[0][0] - a[0]) +
                              (b[1] - a[1]) * (x[0][1] - a[1])) /
          length;
        return {along, length};
      }
  }



  template <int dim>
  bool
  PairBeforeChains<dim>::is_off(const std::vector<Position> &x,
                                const Chain                 &chain,
                                const unsigned int           facet,
                                const double largest_overhang) const
  {
    if constexpr (dim == 1)
      return false;
    else
      {
        const auto &own            = master.facets[chain.facets[facet]];
        const auto [along, length] = place_along(x, facet);
        if ((!own.previous && along < 0.) || (!own.next && along > length))
          return std::max(-along, along - length) > largest_overhang;
        const double gap = gap_before(x, chain, facet);
        // A point past a vertex may be as far away as its bisector allows; a point
        // farther off the ends of the facet than in front of it is beside it.
        const double beside = std::max(-along, along - length);
        return beside > 1.5 * std::abs(gap) + .5 * length;
      }
  }



  template <int dim>
  bool
  PairBeforeChains<dim>::shares_node(const Point       &point,
                                     const unsigned int f) const
  {
    for (const unsigned int of_point : point.facets)
      for (const unsigned int a : this->slave.facets[of_point].nodes)
        for (const unsigned int b : master.facets[f].nodes)
          if (a == b)
            return true;
    return false;
  }



  template <int dim>
  bool
  PairBeforeChains<dim>::can_touch_itself(
    const Point                 &point,
    const unsigned int           f,
    const Position              &y,
    const Position              &normal_of_point,
    const std::vector<Position> &master_x) const
  {
    const auto &own = master.facets[f];
    if (shares_node(point, f))
      return false;
    // The material between the far sides of a wall becomes thinner by less than
    // half; a point that is pressed into a facet is nearer to it than that.
    dealii::Point<dim> reference;
    for (const auto &[node, weight] : point.nodes)
      reference += weight * this->slave.nodes[node].reference_position;
    const auto &a = master.nodes[own.nodes[0]].reference_position;
    double      distance, gap = 0.;
    if constexpr (dim == 2)
      {
        const auto   e = master.nodes[own.nodes[1]].reference_position - a;
        const double along =
          std::clamp(((reference - a) * e) / e.norm_square(), 0., 1.);
        distance = (reference - (a + along * e)).norm();
      }
    else
      distance = (reference - a).norm();
    const Position normal = facet_normal<dim>(master, master_x, f);
    double         square = 0., square_of_point = 0., product = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      {
        gap += normal[c] * (y[c] - master_x[own.nodes[0]][c]);
        square += normal[c] * normal[c];
        square_of_point += normal_of_point[c] * normal_of_point[c];
        product += normal[c] * normal_of_point[c];
      }
    // A surface that is about to be folded does not face itself yet; but a point
    // behind such a facet is only round a corner.
    const double cosine  = product / std::sqrt(square * square_of_point);
    const bool   is_wall = this->slave.facets[point.facets[0]].part == own.part;
    const double depth   = is_wall ? .5 * distance : own.measure;
    return gap > (cosine < 0. ? -depth * std::sqrt(square) : 0.) &&
      cosine < std::sqrt(.5);
  }



  template <int dim>
  std::optional<typename PairBeforeChains<dim>::Facing>
  PairBeforeChains<dim>::find_facet(const Position              &y,
                                    const Position              &normal,
                                    const FacetSearch<dim>      &search,
                                    const std::vector<Position> &master_x,
                                    const double largest_overhang,
                                    const Point *self,
                                    const double largest_distance) const
  {
    const auto can_touch = [&](const unsigned int f) {
      return !self || this->can_touch_itself(*self, f, y, normal, master_x);
    };
    const auto found = self
      ? search.closest_facing(y, normal, can_touch, largest_distance)
      : search.closest_facing(y, normal);
    if (!found)
      return {};
    Facing       facing;
    unsigned int place = 0;
    facing.chain       = chain_around(*found, place);
    gather(y, facing.chain, master_x);
    facing.facet = facet_before(work, place);
    if (is_off(work, facing.chain, facing.facet, largest_overhang) ||
        !can_touch(facing.chain.facets[facing.facet]))
      return {};
    return facing;
  }


  template class PairBeforeChains<1>;
  template class PairBeforeChains<2>;
} // namespace Ricochet
