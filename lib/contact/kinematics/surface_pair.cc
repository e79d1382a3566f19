// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/facet_search.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
          if (!node.mean_of.empty())
            break;
          indices.add_indices(node.unknowns.begin(), node.unknowns.end());
          for (const auto index : node.multipliers)
            if (index != numbers::invalid_dof_index)
              indices.add_index(index);
        }
    }

    template <int dim>
    std::vector<std::array<int, dim>>
    local_indices(const ContactSurface<dim> &surface,
                  const GhostedVector       &ghosted)
    {
      std::vector<std::array<int, dim>> local(surface.nodes.size());
      for (unsigned int n = 0;
           n < local.size() && surface.nodes[n].mean_of.empty();
           ++n)
        for (unsigned int c = 0; c < dim; ++c)
          local[n][c] = ghosted.local_index(surface.nodes[n].unknowns[c]);
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
    ghosted =
      GhostedVector(Vector(body.owned_indices(), relevant, body.communicator));
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
  std::vector<std::pair<typename SurfacePair<dim>::Index, double>>
  SurfacePair<dim>::unknowns() const
  {
    std::map<Index, double> distances;
    const auto              add = [&](const ContactSurface<dim> &surface,
                         const ContactSurface<dim> &other) {
      const auto is_own = [](const auto &node) { return node.mean_of.empty(); };
      dealii::Point<dim> middle;
      unsigned int       n_nodes = 0;
      for (const auto &node : other.nodes)
        if (is_own(node))
          {
            ++n_nodes;
            middle += node.reference_position;
          }
      middle /= n_nodes;
      const auto distance = [&](const auto &node) {
        return node.reference_position.distance(middle);
      };
      double smallest = std::numeric_limits<double>::max();
      for (const auto &node : surface.nodes)
        if (is_own(node))
          smallest = std::min(smallest, distance(node));
      for (const auto &node : surface.nodes)
        if (is_own(node))
          {
            const double farther = distance(node) - smallest;
            for (const Index index : node.unknowns)
              distances.emplace(index, farther);
            for (const Index index : node.multipliers)
              if (index != numbers::invalid_dof_index)
                distances.emplace(index, farther);
          }
    };
    add(slave, master);
    add(master, slave);
    return {distances.begin(), distances.end()};
  }



  template <int dim>
  void
  SurfacePair<dim>::make_nodal_points(const Body<dim> &body)
  {
    std::vector<Point> all(slave.nodes.size());
    const auto         add =
      [&](const unsigned int n, const unsigned int f, double share) {
        all[n].facets.push_back(f);
        all[n].weight += share * slave.facets[f].measure / dim;
        all[n].cell_diameter =
          std::max(all[n].cell_diameter, slave.facets[f].cell_diameter);
        all[n].boundary_id = slave.facets[f].boundary_id;
      };
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      for (const unsigned int n : slave.facets[f].nodes)
        {
          slave.for_each_node_of(n,
                                 [&](const unsigned int of,
                                     const double       share) {
                                   add(of, f, share);
                                 });
        }
    for (unsigned int n = 0; n < all.size(); ++n)
      if (slave.nodes[n].mean_of.empty() && is_mine(body, n))
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
    ghosted.import(solution);
    const double *value = ghosted.values();
    const auto    get   = [&](const ContactSurface<dim>               &surface,
                         const std::vector<std::array<int, dim>> &index,
                         const std::vector<Position>             *start_x,
                         std::vector<Position>                   &x) {
      x.resize(index.size());
      for (unsigned int n = 0; n < x.size(); ++n)
        if (const auto &mean_of = surface.nodes[n].mean_of; !mean_of.empty())
          {
            x[n] = {};
            for (const unsigned int of : mean_of)
              for (unsigned int c = 0; c < dim; ++c)
                x[n][c] += x[of][c] / mean_of.size();
          }
        else
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
  double
  SurfacePair<dim>::longest_way(const Positions &from, const Positions &to)
  {
    const auto of_surface = [](const std::vector<Position> &a,
                               const std::vector<Position> &b) {
      double longest = 0.;
      for (unsigned int n = 0; n < b.size(); ++n)
        {
          Tensor<1, dim> way;
          for (unsigned int c = 0; c < dim; ++c)
            way[c] = b[n][c] - a[n][c];
          longest = std::max(longest, way.norm());
        }
      return longest;
    };
    return of_surface(from.slave, to.slave) +
      of_surface(from.master, to.master);
  }



  template <int dim>
  void
  SurfacePair<dim>::get_multipliers()
  {
    for (unsigned int p = 0; p < own_points.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        if (own_points[p].multipliers[c] != numbers::invalid_dof_index)
          gaps[p].multipliers[c] =
            ghosted.vector()(own_points[p].multipliers[c]);
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


  template class SurfacePair<1>;
  template class SurfacePair<2>;
  template class SurfacePair<3>;
} // namespace Ricochet
