// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/facet_search.h>
#include <contact/surfaces/surface_features.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <iterator>
#include <map>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  SurfacePair<dim>::SurfacePair(const Body<dim> &body, const ContactPair &pair)
    : is_self(pair.is_self)
    , overlap(pair.overlap)
    , interference(pair.interference)
    , gap_offset(pair.overlap)
    , slave(body, pair.slave, pair.multiplier_set)
    , master(body, pair.master, pair.multiplier_set)
    , communicator(body.communicator)
    , owned(body.owned_indices())
    , patches(master, body.communicator)
  {
    const unsigned int this_rank =
      Utilities::MPI::this_mpi_process(communicator);
    std::vector<unsigned int> own_facets;
    for (unsigned int f = 0; f < slave.facets.size(); ++f)
      {
        bool is_own = slave.facets[f].owner == this_rank;
        for (const unsigned int n : slave.facets[f].nodes)
          slave.for_each_node_of(n,
                                 [&](const unsigned int of,
                                     const double /*share*/) {
                                   is_own = is_own || is_mine(body, of);
                                 });
        if (is_own)
          own_facets.push_back(f);
      }
    own_groups         = groups_of_neighbours(slave, own_facets);
    smallest_thickness = std::numeric_limits<double>::infinity();
    for (const auto &facet : master.facets)
      smallest_thickness =
        std::min({smallest_thickness,
                  facet.cell_height,
                  std::pow(facet.measure, 1. / std::max(1, dim - 1))});
    for (unsigned int patch = 0; patch < patches.size(); ++patch)
      {
        known.push_back(patches.is_own(patch));
        patches_around.push_back(patches.around(patch, farthest_walk));
      }
    make_exchange();

    bool is_same = false;
    for (const auto id : pair.slave)
      is_same = is_same || pair.master.count(id) > 0;
    if (is_same && (!is_self || pair.slave != pair.master))
      throw InputError(
        "The contact '" + pair.name +
        "' has a boundary that is slave and master. A surface that "
        "may touch itself has to be said to do so.");
    const auto moves = [](const auto &node) { return !node.is_held; };
    master_moves = std::any_of(master.nodes.begin(), master.nodes.end(), moves);
    if (!master_moves &&
        std::none_of(slave.nodes.begin(), slave.nodes.end(), moves))
      throw InputError("The contact '" + pair.name +
                       "' can do nothing: all nodes of its surfaces are held.");
    if (is_self || pair.is_part)
      return;
    bool some_face = false;
    for (unsigned int f = 0; f < slave.facets.size() && !some_face; ++f)
      for (const auto &other : master.facets)
        some_face = some_face || slave.facets[f].normal * other.normal < 0.;
    if (!some_face)
      throw InputError("The surfaces of the contact '" + pair.name +
                       "' face each other the wrong way: no outward normal of "
                       "one points against one of the other. Is a boundary "
                       "id that of the far side of a body?");
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
  double
  SurfacePair<dim>::half_length(const unsigned int f) const
  {
    const auto &corners = slave.facets[f].nodes;
    double      longest = 0.;
    for (const unsigned int a : corners)
      for (const unsigned int b : corners)
        longest = std::max(longest,
                           slave.nodes[a].reference_position.distance(
                             slave.nodes[b].reference_position));
    return .5 * longest;
  }



  template <int dim>
  std::vector<typename SurfacePair<dim>::Point>
  SurfacePair<dim>::points_of_nodes() const
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
      if (slave.nodes[n].mean_of.empty())
        {
          for (const unsigned int f : all[n].facets)
            all[n].largest_overhang += half_length(f) / all[n].facets.size();
          all[n].nodes       = {{n, 1.}};
          all[n].multipliers = slave.nodes[n].multipliers;
          all[n].is_shared   = slave.nodes[n].has_several_sets;
        }
    return all;
  }



  template <int dim>
  void
  SurfacePair<dim>::make_nodal_points(const Body<dim> &body,
                                      const bool       has_coverage)
  {
    for (const Point &point : points_of_nodes())
      if (!point.nodes.empty() && is_mine(body, point.nodes.front().first))
        {
          own_points.push_back(point);
          // At an instant nothing else decides which contact has a node at a seam.
          if (has_coverage && point.is_shared)
            own_points.back().largest_overhang *= 1e-6;
        }
  }



  template <int dim>
  void
  SurfacePair<dim>::make_corner_points(const Body<dim> &body)
  {
    const std::vector<Point> all            = points_of_nodes();
    const SurfaceFeatures    features       = features_of(slave);
    const auto               is_on_symmetry = [&](const unsigned int node) {
      unsigned int n_prescribed = 0;
      for (const Index index : slave.nodes[node].unknowns)
        n_prescribed += body.constraints().is_constrained(index);
      return n_prescribed > 0 && n_prescribed < dim;
    };
    // The points of an edge share what its nodes stand for.
    constexpr unsigned int parts = dim == 3 ? 4 : 1;
    for (unsigned int n = 0; n < all.size(); ++n)
      if (features.is_on[n] && is_mine(body, n) && !is_on_symmetry(n))
        {
          own_points.push_back(all[n]);
          own_points.back().weight /= parts;
        }
    for (const auto &edge : features.edges)
      if (is_mine(body, edge[0]) &&
          !(is_on_symmetry(edge[0]) && is_on_symmetry(edge[1])))
        for (unsigned int k = 1; k < parts; ++k)
          {
            const double second = 1. * k / parts;
            const Point &a = all[edge[0]], &b = all[edge[1]];
            Point        point = a;
            point.nodes        = {{edge[0], 1. - second}, {edge[1], second}};
            point.weight       = .5 * (a.weight + b.weight) / parts;
            point.largest_overhang =
              .5 * (a.largest_overhang + b.largest_overhang);
            point.facets.clear();
            std::set_intersection(a.facets.begin(),
                                  a.facets.end(),
                                  b.facets.begin(),
                                  b.facets.end(),
                                  std::back_inserter(point.facets));
            own_points.push_back(point);
          }
    for (Point &point : own_points)
      point.multipliers.fill(numbers::invalid_dof_index);
  }



  template <int dim>
  bool
  SurfacePair<dim>::may_touch(const Point &point) const
  {
    return master_moves ||
      std::any_of(point.nodes.begin(),
                  point.nodes.end(),
                  [&](const auto &node) {
                    return !slave.nodes[node.first].is_held;
                  });
  }



  template <int dim>
  void
  SurfacePair<dim>::make_exchange()
  {
    std::vector<Index> indices;
    const auto         add = [&](const ContactSurface<dim> &surface,
                         const unsigned int         facet) {
      for (const unsigned int n : surface.facets[facet].nodes)
        surface.for_each_node_of(
          n,
          [&](const unsigned int of, const double /*share*/) {
            const auto &unknowns = surface.nodes[of].unknowns;
            indices.insert(indices.end(), unknowns.begin(), unknowns.end());
          });
    };
    for (const auto &group : own_groups)
      for (const unsigned int f : group)
        add(slave, f);
    for (unsigned int patch = 0; patch < patches.size(); ++patch)
      if (known[patch])
        for (const unsigned int f : patches.facets_of(patch))
          add(master, f);
    for (const auto &node : slave.nodes)
      if (node.mean_of.empty() && owned.is_element(node.unknowns[0]))
        for (const Index index : node.multipliers)
          if (index != numbers::invalid_dof_index)
            indices.push_back(index);
    std::sort(indices.begin(), indices.end());
    indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
    IndexSet to_know(owned.size());
    to_know.add_indices(indices.begin(), indices.end());
    ghosted = GhostedVector(to_know);
    multiplier_index.clear();

    const auto find = [&](const ContactSurface<dim>         &surface,
                          std::vector<std::array<int, dim>> &local) {
      local.resize(surface.nodes.size());
      for (unsigned int n = 0; n < local.size(); ++n)
        for (unsigned int c = 0; c < dim; ++c)
          local[n][c] = surface.nodes[n].mean_of.empty()
            ? ghosted.local_index(surface.nodes[n].unknowns[c])
            : -1;
    };
    find(slave, slave_index);
    find(master, master_index);
  }



  template <int dim>
  bool
  SurfacePair<dim>::find_near(Course &course)
  {
    course.reach = reach_of_step(course);
    std::vector<unsigned int> near(patches.size());
    std::iota(near.begin(), near.end(), 0);
    std::vector<BoundingBox<dim>> places;
    if (std::isfinite(course.reach))
      {
        for (const auto &group : own_groups)
          places.push_back(box_of_facets<dim>(slave,
                                              group,
                                              course.begin.slave,
                                              course.end.slave));
        near = patches.near(places,
                            course.reach,
                            course.begin.master,
                            course.end.master);
      }
    near_facets.clear();
    for (const unsigned int patch : near)
      near_facets.insert(near_facets.end(),
                         patches.facets_of(patch).begin(),
                         patches.facets_of(patch).end());
    std::sort(near_facets.begin(), near_facets.end());
    if (Utilities::MPI::n_mpi_processes(communicator) == 1)
      return false;

    bool knows_all = true;
    for (const unsigned int patch : near)
      for (const unsigned int other : patches_around[patch])
        knows_all = knows_all && known[other];
    if (Utilities::MPI::min(knows_all ? 1 : 0, communicator) == 1)
      return false;
    // Patches a little farther off may be near in one of the next steps.
    if (std::isfinite(course.reach))
      near = patches.near(places,
                          1.5 * course.reach,
                          course.begin.master,
                          course.end.master);
    for (unsigned int patch = 0; patch < patches.size(); ++patch)
      known[patch] = patches.is_own(patch);
    for (const unsigned int patch : near)
      for (const unsigned int other : patches_around[patch])
        known[other] = true;
    return true;
  }



  template <int dim>
  void
  SurfacePair<dim>::get_positions(Positions       &positions,
                                  const Positions *start,
                                  const double     time) const
  {
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
        else if (index[n][0] < 0)
          x[n].fill(std::numeric_limits<double>::quiet_NaN());
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
  void
  SurfacePair<dim>::read(const Vector &solution, Positions &positions)
  {
    ghosted.import(solution);
    get_positions(positions);
    if (multiplier_index.size() != own_points.size())
      for (const Point &point : own_points)
        {
          multiplier_index.emplace_back();
          for (unsigned int c = 0; c < dim; ++c)
            multiplier_index.back()[c] =
              point.multipliers[c] != numbers::invalid_dof_index
              ? ghosted.local_index(point.multipliers[c])
              : -1;
        }
    const double *value = ghosted.values();
    for (unsigned int p = 0; p < own_points.size(); ++p)
      for (unsigned int c = 0; c < dim; ++c)
        if (multiplier_index[p][c] >= 0)
          gaps[p].multipliers[c] = value[multiplier_index[p][c]];
  }



  template <int dim>
  void
  SurfacePair<dim>::begin_course(const ContactStart &start, Course &course)
  {
    const auto read_all = [&]() {
      read(start.solution, course.begin);
      if (start.time_step > 0.)
        {
          ghosted.import(start.mean_velocity);
          get_positions(course.middle, &course.begin, .5 * start.time_step);
          get_positions(course.end, &course.begin, start.time_step);
        }
      else
        course.middle = course.end = course.begin;
    };
    read_all();
    if (find_near(course))
      {
        make_exchange();
        read_all();
      }
    if (start.time_step == 0.)
      for (unsigned int p = 0; p < own_points.size(); ++p)
        gaps[p].position = position_of(own_points[p], course.begin.slave);
  }



  template <int dim>
  double
  SurfacePair<dim>::longest_way(const Positions &from,
                                const Positions &to) const
  {
    // Each node is known on some rank; the comparison skips the NaN of unknown
    // ones.
    std::vector<double> longest(2, 0.);
    const auto          find = [](const std::vector<Position> &a,
                         const std::vector<Position> &b,
                         double                      &longest_of_surface) {
      for (unsigned int n = 0; n < b.size(); ++n)
        {
          Tensor<1, dim> way;
          for (unsigned int c = 0; c < dim; ++c)
            way[c] = b[n][c] - a[n][c];
          longest_of_surface = std::max(longest_of_surface, way.norm());
        }
    };
    find(from.slave, to.slave, longest[0]);
    find(from.master, to.master, longest[1]);
    Utilities::MPI::max(longest, communicator, longest);
    return longest[0] + longest[1];
  }



  template <int dim>
  dealii::Point<3>
  SurfacePair<dim>::reference_place(const unsigned int p) const
  {
    dealii::Point<3> place;
    for (const auto &[node, weight] : own_points[p].nodes)
      for (unsigned int c = 0; c < dim; ++c)
        place[c] += weight * slave.nodes[node].reference_position[c];
    return place;
  }



  template <int dim>
  bool
  SurfacePair<dim>::crosses(const unsigned int p,
                            const unsigned int f,
                            const Positions   &begin,
                            const Positions   &end) const
  {
    const Point &point = own_points[p];
    const auto  &nodes = master.facets[f].nodes;
    if (is_self)
      for (const unsigned int of_point : point.facets)
        for (const unsigned int a : slave.facets[of_point].nodes)
          for (const unsigned int b : nodes)
            if (a == b)
              return false;
    const auto gap_at = [&](const Positions &x, const Position &y) {
      const Position normal = facet_normal<dim>(master, x.master, f);
      double         gap = 0., square = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        {
          gap += normal[c] * (y[c] - x.master[nodes[0]][c]);
          square += normal[c] * normal[c];
        }
      return gap / std::sqrt(square);
    };
    const Position y0 = position_of(point, begin.slave),
                   y1 = position_of(point, end.slave);
    const double gap0 = gap_at(begin, y0), gap1 = gap_at(end, y1);
    if (!(gap0 > 0. && gap1 < 0.))
      return false;
    const Position own = normal_of(point, end.slave),
                   its = facet_normal<dim>(master, end.master, f);
    double product     = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      product += own[c] * its[c];
    if (product >= 0.)
      return false;
    // Positions of both at that time, on straight paths.
    const double when = gap0 / (gap0 - gap1);
    const auto   at   = [&](const Position &a, const Position &b) {
      Tensor<1, 3> x;
      for (unsigned int c = 0; c < dim; ++c)
        x[c] = a[c] + when * (b[c] - a[c]);
      return x;
    };
    const Tensor<1, 3>        y = at(y0, y1);
    std::vector<Tensor<1, 3>> corners;
    for (const unsigned int node : nodes)
      corners.push_back(at(begin.master[node], end.master[node]));
    // In 2D and 1D a triangle without area.
    const auto         shares = closest_in_triangle(y,
                                            corners.front(),
                                            corners[dim > 1 ? 1 : 0],
                                            corners.back());
    const Tensor<1, 3> away   = y - shares[0] * corners.front() -
      shares[1] * corners[dim > 1 ? 1 : 0] - shares[2] * corners.back();
    return away.norm() < 1e-3 * smallest_thickness;
  }



  template <int dim>
  std::vector<unsigned int>
  SurfacePair<dim>::crossing_points(const Vector &begin, const Vector &end)
  {
    const std::vector<Gaps> gaps_of_step = gaps;
    Positions               x0, x1;
    read(begin, x0);
    read(end, x1);
    gaps = gaps_of_step;
    // The search at the end of the step detects motions below a quarter of the
    // smallest facet and the thinnest cell.
    if (longest_way(x0, x1) < .25 * smallest_thickness)
      return {};
    // Largest distance of a facet from its position at the end.
    double farthest = 0.;
    for (unsigned int n = 0; n < x0.master.size(); ++n)
      for (unsigned int c = 0; c < dim; ++c)
        if (const double change = std::abs(x1.master[n][c] - x0.master[n][c]);
            change > farthest)
          farthest = change;
    const FacetSearch<dim>    search(master, x1.master, near_facets);
    std::vector<unsigned int> list;
    for (unsigned int p = 0; p < own_points.size(); ++p)
      {
        if (!may_touch(own_points[p]))
          continue;
        const Position y0 = position_of(own_points[p], x0.slave),
                       y1 = position_of(own_points[p], x1.slave);
        Position lower = y0, upper = y0;
        for (unsigned int c = 0; c < dim; ++c)
          {
            lower[c] = std::min(y0[c], y1[c]) - farthest;
            upper[c] = std::max(y0[c], y1[c]) + farthest;
          }
        for (const unsigned int f : search.near(lower, upper))
          if (crosses(p, f, x0, x1))
            {
              list.push_back(p);
              break;
            }
      }
    return list;
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
