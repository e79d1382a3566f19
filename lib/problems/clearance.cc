// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/surfaces/closest_point.h>
#include <contact/surfaces/contact_surface.h>
#include <problems/clearance.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The same on all ranks: the first text that is not empty.
    std::string
    first_text(const std::string &text, const MPI_Comm communicator)
    {
      for (const std::string &one :
           Utilities::MPI::all_gather(communicator, text))
        if (!one.empty())
          return one;
      return "";
    }

    template <int dim>
    bool
    is_inside(const Body<dim>                                      &body,
              const typename DoFHandler<dim>::active_cell_iterator &cell,
              const Tensor<1, 3>                                   &x)
    {
      Point<dim> point;
      for (unsigned int c = 0; c < dim; ++c)
        point[c] = x[c];
      if (!cell->bounding_box().point_inside(point))
        return false;
      try
        {
          return cell->reference_cell().contains_point(
            body.mapping().transform_real_to_unit_cell(cell, point));
        }
      catch (const typename Mapping<dim>::ExcTransformationFailed &)
        {
          return false;
        }
    }
  } // namespace



  void
  check_motions(const SchemeTraits &scheme, const Obstacles &obstacles)
  {
    if (std::all_of(obstacles.begin(), obstacles.end(), [](const auto &entry) {
          return entry.second->motion().is_at_rest();
        }))
      return;
    if (scheme.needs_potential)
      throw InputError("The time scheme " + scheme.name +
                       " cannot be combined with an obstacle that moves: it "
                       "reads the work of contact off a potential.\nAllowed: " +
                       names_of_schemes([](const SchemeTraits &s) {
                         return !s.needs_potential;
                       }) +
                       ".");
  }



  namespace
  {
    /// Material ids of the cells at the boundary @p id. Collective.
    template <int dim>
    std::set<types::material_id>
    materials_at(const Body<dim> &body, const types::boundary_id id)
    {
      std::set<types::material_id> own;
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() == id)
              own.insert(cell->material_id());
      std::set<types::material_id> all;
      for (const auto &list : Utilities::MPI::all_gather(
             body.communicator,
             std::vector<types::material_id>(own.begin(), own.end())))
        all.insert(list.begin(), list.end());
      return all;
    }
  } // namespace



  template <int dim>
  void
  check_clearance(const Body<dim>   &body,
                  const Obstacles   &obstacles,
                  const std::string &contact,
                  const bool         only_what_may_touch)
  {
    for (const auto &entry : obstacles)
      {
        std::set<types::material_id> parts;
        if (only_what_may_touch)
          parts = materials_at(body, entry.first);
        const RigidObstacle &obstacle  = *entry.second;
        const Placement      placement = obstacle.motion().placement(0.);
        double               overlap   = 0.;
        std::string          problem;
        const Tensor<1, 3>   centre =
          placement.push_forward(obstacle.shape().centre());
        const bool has_inside = obstacle.gap(centre, 0.) < 0.;
        for (const auto &cell : body.dof_handler().active_cell_iterators())
          {
            if (!cell->is_locally_owned() ||
                (only_what_may_touch && parts.count(cell->material_id()) == 0))
              continue;
            for (const unsigned int v : cell->vertex_indices())
              {
                const Tensor<1, 3> x   = in_space<dim>(cell->vertex(v));
                const double       gap = obstacle.gap(x, 0.);
                if (problem.empty())
                  problem = obstacle.shape().problem_at(placement.pull_back(x));
                // The tolerance is that of a mesh, whose vertices are off the
                // surface by round-off.
                if (-gap > 1e-3 * cell->diameter())
                  overlap = std::max(overlap, -gap);
              }
            if (has_inside && overlap == 0. && is_inside(body, cell, centre))
              overlap = -obstacle.gap(centre, 0.);
          }
        problem = first_text(problem, body.communicator);
        if (!problem.empty())
          throw InputError(problem);
        overlap = Utilities::MPI::max(overlap, body.communicator);
        if (overlap > 0.)
          throw InputError(
            "At the start the body overlaps with the obstacle of " +
            (contact.empty() ? "boundary " + std::to_string(entry.first)
                             : "the contact '" + contact + "'") +
            " by " + to_text(overlap) +
            " (unit of length). Move one of them away.");
      }
  }


  namespace
  {
    /// How far @p x is inside of the part whose boundary is @p facets (m): negative
    /// outside.
    double
    depth_inside(const Point<1>                                      &x,
                 const ContactSurface<1>                             &surface,
                 const std::vector<const ContactSurface<1>::Facet *> &facets)
    {
      double depth = std::numeric_limits<double>::max();
      for (const auto *facet : facets)
        depth =
          std::min(depth,
                   facet->normal *
                     (surface.nodes[facet->nodes[0]].reference_position - x));
      return depth;
    }

    double
    depth_inside(const Point<2>                                      &x,
                 const ContactSurface<2>                             &surface,
                 const std::vector<const ContactSurface<2>::Facet *> &facets)
    {
      // From inside, the boundary is seen under a full angle.
      double angle = 0., distance = std::numeric_limits<double>::max();
      for (const auto *facet : facets)
        {
          const Tensor<1, 2> a =
            surface.nodes[facet->nodes[0]].reference_position - x;
          const Tensor<1, 2> b =
            surface.nodes[facet->nodes[1]].reference_position - x;
          angle += std::atan2(a[0] * b[1] - a[1] * b[0], a * b);
          const Tensor<1, 2> e = b - a;
          const double along   = std::clamp(-(a * e) / e.norm_square(), 0., 1.);
          distance             = std::min(distance, (a + along * e).norm());
        }
      return std::abs(angle) > numbers::PI ? distance : -distance;
    }

    double
    depth_inside(const Point<3>                                      &x,
                 const ContactSurface<3>                             &surface,
                 const std::vector<const ContactSurface<3>::Facet *> &facets)
    {
      // The solid angle of the whole boundary is 4 pi inside; that of a triangle by
      // A. van Oosterom and J. Strackee, IEEE Trans. Biomed. Eng. 30 (1983) 125-126.
      double angle = 0., distance = std::numeric_limits<double>::max();
      for (const auto *facet : facets)
        {
          std::array<Tensor<1, 3>, 3> r;
          for (unsigned int v = 0; v < 3; ++v)
            r[v] = surface.nodes[facet->nodes[v]].reference_position - x;
          const std::array<double, 3> l = {
            {r[0].norm(), r[1].norm(), r[2].norm()}};
          angle += 2. *
            std::atan2(cross_product_3d(r[0], r[1]) * r[2],
                       l[0] * l[1] * l[2] + (r[0] * r[1]) * l[2] +
                         (r[1] * r[2]) * l[0] + (r[2] * r[0]) * l[1]);
          const auto shares =
            closest_in_triangle(Tensor<1, 3>(), r[0], r[1], r[2]);
          distance = std::min(
            distance,
            (shares[0] * r[0] + shares[1] * r[1] + shares[2] * r[2]).norm());
        }
      return std::abs(angle) > 2. * numbers::PI ? distance : -distance;
    }



    /// Points in which a body with this @p facet is tested against others: its
    /// nodes; its middle, as edges may cross with all nodes outside; and a
    /// point a little behind that, as the whole boundary of coincident bodies
    /// is common.
    template <int dim>
    std::array<Point<dim>, dim + 2>
    places_of(const ContactSurface<dim>                 &surface,
              const typename ContactSurface<dim>::Facet &facet)
    {
      // A tenth of its height is inside even of a skewed cell.
      constexpr double                depth = .1;
      std::array<Point<dim>, dim + 2> places;
      Point<dim>                      middle;
      for (unsigned int v = 0; v < dim; ++v)
        {
          places[v] = surface.nodes[facet.nodes[v]].reference_position;
          middle += places[v] / static_cast<double>(dim);
        }
      places[dim]     = middle;
      places[dim + 1] = middle - depth * facet.cell_height * facet.normal;
      return places;
    }



    /// How far a facet of the surface may be off the arc whose chord it is: its length
    /// times an eighth of the angle to its neighbours, where it is not a sharp edge (m).
    template <int dim>
    double
    rise_of_arc(const ContactSurface<dim>                 &surface,
                const typename ContactSurface<dim>::Facet &facet)
    {
      constexpr double sharp = 40. * numbers::PI / 180.;
      double           angle = 0., length = 0.;
      const auto       turn_to = [&](const std::optional<unsigned int> &other) {
        if (!other)
          return;
        const double cosine = facet.normal * surface.facets[*other].normal;
        const double turn   = std::acos(std::clamp(cosine, -1., 1.));
        if (turn < sharp)
          angle = std::max(angle, turn);
      };
      turn_to(facet.previous);
      turn_to(facet.next);
      for (const auto &neighbour : facet.neighbours)
        turn_to(neighbour);
      for (const unsigned int a : facet.nodes)
        for (const unsigned int b : facet.nodes)
          length = std::max(length,
                            surface.nodes[a].reference_position.distance(
                              surface.nodes[b].reference_position));
      return length * angle / 8.;
    }
  } // namespace



  template <int dim>
  std::string
  find_overlaps(const Body<dim>          &body,
                std::vector<ContactPair> &pairs,
                const bool                takes_overlaps)
  {
    if (pairs.empty())
      return "";
    std::set<types::boundary_id> all_boundaries;
    for (const auto &list : Utilities::MPI::all_gather(
           body.communicator,
           body.dof_handler().get_triangulation().get_boundary_ids()))
      all_boundaries.insert(list.begin(), list.end());
    const ContactSurface<dim> surface(body, all_boundaries);
    using Facet = typename ContactSurface<dim>::Facet;
    std::map<types::material_id, std::vector<const Facet *>> boundary_of_part;
    std::map<types::material_id, std::vector<Point<dim>>>    nodes_of_part;
    for (const Facet &facet : surface.facets)
      {
        boundary_of_part[facet.part].push_back(&facet);
        for (const unsigned int node : facet.nodes)
          nodes_of_part[facet.part].push_back(
            surface.nodes[node].reference_position);
      }
    std::map<types::material_id, BoundingBox<dim>> box_of_part;
    for (const auto &[part, nodes] : nodes_of_part)
      box_of_part.emplace(part, BoundingBox<dim>(nodes));

    for (ContactPair &pair : pairs)
      {
        const auto takes_part = [&](const Facet &facet) {
          return pair.slave.count(facet.boundary_id) > 0 ||
            pair.master.count(facet.boundary_id) > 0;
        };
        double largest_rise = 0.;
        for (const Facet &facet : surface.facets)
          if (takes_part(facet))
            largest_rise = std::max(largest_rise, rise_of_arc(surface, facet));
        for (const Facet &facet : surface.facets)
          if (takes_part(facet))
            for (const Point<dim> &x : places_of(surface, facet))
              for (const auto &[part, boundary] : boundary_of_part)
                {
                  if (part == facet.part ||
                      !box_of_part.at(part).point_inside(x))
                    continue;
                  // Surfaces may touch; a little is round-off.
                  const double depth = depth_inside(x, surface, boundary);
                  if (!(depth > 1e-6 * facet.cell_diameter))
                    continue;
                  // A margin for arcs whose facets differ in length.
                  const bool is_fit =
                    !pair.is_self && depth < 1.5 * largest_rise;
                  if (is_fit && takes_overlaps)
                    {
                      pair.overlap = std::max(pair.overlap, depth);
                      continue;
                    }
                  std::string text;
                  for (unsigned int c = 0; c < dim; ++c)
                    text += (c == 0 ? "" : ", ") + to_text(x[c]);
                  return "At the start bodies overlap: the point (" + text +
                    ") of the contact '" + pair.name +
                    "' is inside another one, " + to_text(depth) +
                    " behind its surface. Move one of them away" +
                    (is_fit ? ", or take Contact/Coupling = points, where gaps "
                              "are counted from what chords of an arc overlap."
                            : ".");
                }
      }
    return "";
  }


  template std::string
  find_overlaps(const Body<1> &, std::vector<ContactPair> &, const bool);
  template std::string
  find_overlaps(const Body<2> &, std::vector<ContactPair> &, const bool);
  template std::string
  find_overlaps(const Body<3> &, std::vector<ContactPair> &, const bool);
  template void
  check_clearance(const Body<1> &,
                  const Obstacles &,
                  const std::string &,
                  const bool);
  template void
  check_clearance(const Body<2> &,
                  const Obstacles &,
                  const std::string &,
                  const bool);
  template void
  check_clearance(const Body<3> &,
                  const Obstacles &,
                  const std::string &,
                  const bool);
} // namespace Ricochet
