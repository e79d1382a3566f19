// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/facet_chain.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Unknowns of @p surface, to be added to @p indices.
    template <int dim>
    void
    add_unknowns(const ContactSurface<dim> &surface, IndexSet &indices)
    {
      for (const auto &node : surface.nodes)
        {
          indices.add_indices(node.unknowns.begin(), node.unknowns.end());
          for (const auto index : node.multipliers)
            if (index != numbers::invalid_dof_index)
              indices.add_index(index);
        }
    }

    template <int dim>
    std::vector<std::array<int, dim>>
    local_indices(const ContactSurface<dim> &surface, const Vector &ghosted)
    {
      std::vector<std::array<int, dim>> local(surface.nodes.size());
      for (unsigned int n = 0; n < local.size(); ++n)
        for (unsigned int c = 0; c < dim; ++c)
          local[n][c] = ghosted.trilinos_vector().Map().LID(
            static_cast<TrilinosWrappers::types::int_type>(
              surface.nodes[n].unknowns[c]));
      return local;
    }
  } // namespace



  template <int dim>
  SurfacePair<dim>::SurfacePair(const Body<dim> &body, const ContactPair &pair)
    : is_self(pair.is_self)
    , slave(body, pair.slave)
    , master(body, pair.master)
  {
    IndexSet relevant = body.owned_indices();
    add_unknowns(slave, relevant);
    add_unknowns(master, relevant);
    ghosted.reinit(body.owned_indices(), relevant, body.communicator);
    slave_index  = local_indices(slave, ghosted);
    master_index = local_indices(master, ghosted);

    bool is_same = false;
    for (const auto id : pair.slave)
      is_same = is_same || pair.master.count(id) > 0;
    if (is_same && (!is_self || pair.slave != pair.master))
      throw InputError(
        "The contact '" + pair.name +
        "' has a boundary that is slave and master. A surface that "
        "may touch itself has to be said to do so.");
    if (is_self)
      return;
    bool some_face = false;
    for (const auto &facet : slave.facets)
      for (const auto &other : master.facets)
        some_face = some_face || facet.normal * other.normal < 0.;
    if (!some_face)
      throw InputError(
        "The surfaces of the contact '" + pair.name +
        "' face each other the wrong way: nowhere is the outside "
        "of one before that of the other. Is a boundary id that "
        "of the far side of a body?");
  }



  template <int dim>
  void
  SurfacePair<dim>::make_nodal_points(const Body<dim> &body)
  {
    std::vector<Point> all(slave.nodes.size());
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      for (const unsigned int n : slave.facets[f].nodes)
        {
          all[n].facets.push_back(f);
          all[n].weight += slave.facets[f].measure / dim;
          all[n].cell_diameter =
            std::max(all[n].cell_diameter, slave.facets[f].cell_diameter);
          all[n].boundary_id = slave.facets[f].boundary_id;
        }
    for (unsigned int n = 0; n < all.size(); ++n)
      if (is_mine(body, n))
        {
          all[n].nodes       = {{n, 1.}};
          all[n].multipliers = slave.nodes[n].multipliers;
          all[n].can_touch   = !slave.nodes[n].is_held;
          own_points.push_back(all[n]);
        }
  }



  template <int dim>
  void
  SurfacePair<dim>::get_positions(const Vector    &solution,
                                  Positions       &positions,
                                  const Positions *start,
                                  const double     time) const
  {
    ghosted             = solution;
    const double *value = ghosted.trilinos_vector()[0];
    const auto    get   = [&](const ContactSurface<dim>               &surface,
                         const std::vector<std::array<int, dim>> &index,
                         const std::vector<Position>             *start_x,
                         std::vector<Position>                   &x) {
      x.resize(index.size());
      for (unsigned int n = 0; n < x.size(); ++n)
        for (unsigned int c = 0; c < dim; ++c)
          x[n][c] = (start_x ? (*start_x)[n][c]
                                  : surface.nodes[n].reference_position[c]) +
            time * value[index[n][c]];
    };
    get(slave, slave_index, start ? &start->slave : nullptr, positions.slave);
    get(master,
        master_index,
        start ? &start->master : nullptr,
        positions.master);
  }



  template <int dim>
  void
  SurfacePair<dim>::get_multipliers()
  {
    for (unsigned int p = 0; p < own_points.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        if (own_points[p].multipliers[c] != numbers::invalid_dof_index)
          gaps[p].multipliers[c] = ghosted(own_points[p].multipliers[c]);
  }



  template <int dim>
  typename SurfacePair<dim>::Position
  SurfacePair<dim>::normal_of(const Point                 &point,
                              const std::vector<Position> &slave_x) const
  {
    Position sum{};
    for (const unsigned int f : point.facets)
      {
        const Position normal = facet_normal<dim>(slave, slave_x, f);
        for (unsigned int c = 0; c < dim; ++c)
          sum[c] += normal[c];
      }
    return sum;
  }



  template <int dim>
  typename SurfacePair<dim>::Position
  SurfacePair<dim>::position_of(const Point                 &point,
                                const std::vector<Position> &slave_x) const
  {
    Position y{};
    for (const auto &[node, weight] : point.nodes)
      for (unsigned int c = 0; c < dim; ++c)
        y[c] += weight * slave_x[node][c];
    return y;
  }



  template <int dim>
  typename SurfacePair<dim>::Chain
  SurfacePair<dim>::chain_around(const unsigned int f,
                                 unsigned int      &place) const
  {
    unsigned int first = f;
    for (unsigned int k = 0; k < 2; ++k)
      if (const auto previous = master.facets[first].previous)
        first = *previous;
    // A closed surface of few facets is gone round more than once.
    Chain chain;
    chain.nodes.push_back(master.facets[first].nodes[0]);
    std::optional<unsigned int> facet         = first;
    unsigned int                n_behind_last = 0;
    bool                        passed        = false;
    while (facet && n_behind_last < 3)
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
  const std::vector<typename SurfacePair<dim>::Position> &
  SurfacePair<dim>::gather(const Position              &y,
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
  SurfacePair<dim>::gap_before(const std::vector<Position> &x,
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
  SurfacePair<dim>::facet_before(const std::vector<Position> &x,
                                 const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return facet;
    else
      return FacetChain<double>::facet_before(x, facet);
  }



  template <int dim>
  bool
  SurfacePair<dim>::is_off(const std::vector<Position> &x,
                           const Chain                 &chain,
                           const unsigned int           facet) const
  {
    if constexpr (dim == 1)
      return false;
    else
      {
        const auto     &own = master.facets[chain.facets[facet]];
        const Position &a = x[facet + 1], &b = x[facet + 2];
        const double    length = std::hypot(b[0] - a[0], b[1] - a[1]);
        const double    along  = ((b[0] - a[0]) * (x[0][0] - a[0]) +
                              (b[1] - a[1]) * (x[0][1] - a[1])) /
          length;
        // Edges of bodies of the same size may meet, and what is pressed into a facet
        // that turns is not off its end for that.
        const double gap       = gap_before(x, chain, facet);
        const double tolerance = 1e-6 * length + std::max(0., -gap);
        if ((!own.previous && along < -tolerance) ||
            (!own.next && along > length + tolerance))
          return true;
        // Past a vertex points may be as far as its bisector leads; what is farther
        // off the ends of the facet than before it is beside it.
        const double beside = std::max(-along, along - length);
        return beside > 1.5 * std::abs(gap) + .5 * length;
      }
  }



  template <int dim>
  bool
  SurfacePair<dim>::shares_node(const Point &point, const unsigned int f) const
  {
    for (const unsigned int of_point : point.facets)
      for (const unsigned int a : slave.facets[of_point].nodes)
        for (const unsigned int b : master.facets[f].nodes)
          if (a == b)
            return true;
    return false;
  }



  template <int dim>
  bool
  SurfacePair<dim>::can_touch_itself(
    const Point                 &point,
    const unsigned int           f,
    const Position              &y,
    const Position              &normal_of_point,
    const std::vector<Position> &master_x) const
  {
    const auto &own = master.facets[f];
    if (shares_node(point, f))
      return false;
    // Between the far sides of a wall is its material, which becomes thinner by less
    // than half; what is pressed into a facet is nearer to it than that.
    dealii::Point<dim> reference;
    for (const auto &[node, weight] : point.nodes)
      reference += weight * slave.nodes[node].reference_position;
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
    // Where the surface is about to be folded it does not face itself yet; but what is
    // behind such a facet is only round a corner.
    const double cosine  = product / std::sqrt(square * square_of_point);
    const bool   is_wall = slave.facets[point.facets[0]].part == own.part;
    const double depth   = is_wall ? .5 * distance : own.measure;
    return gap > (cosine < 0. ? -depth * std::sqrt(square) : 0.) &&
      cosine < std::sqrt(.5);
  }



  template <int dim>
  std::optional<typename SurfacePair<dim>::Facing>
  SurfacePair<dim>::find_facet(const Position              &y,
                               const Position              &normal,
                               const FacetSearch<dim>      &search,
                               const std::vector<Position> &master_x,
                               const Point                 *self,
                               const double largest_distance) const
  {
    const auto can_touch = [&](const unsigned int f) {
      return !self || can_touch_itself(*self, f, y, normal, master_x);
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
    if (is_off(work, facing.chain, facing.facet) ||
        !can_touch(facing.chain.facets[facing.facet]))
      return {};
    return facing;
  }


  template class SurfacePair<1>;
  template class SurfacePair<2>;
} // namespace Ricochet
