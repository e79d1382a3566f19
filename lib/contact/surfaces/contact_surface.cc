// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/surfaces/contact_surface.h>

#include <deal.II/fe/fe_values.h>

#include <boost/serialization/array.hpp>
#include <boost/serialization/vector.hpp>

#include <algorithm>
#include <map>
#include <tuple>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A facet as sent from rank to rank.
    template <int dim>
    struct Message
    {
      struct End
      {
        std::array<double, dim>                  position;
        std::array<types::global_dof_index, dim> unknowns, multipliers;
        bool                                     has_several_sets = false;

        template <class Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          // clang-format off
          archive & position & unknowns & multipliers & has_several_sets;
          // clang-format on
        }
      };

      std::array<double, dim> middle, normal;
      std::vector<End>        ends;
      double       measure = 0., cell_diameter = 0., cell_height = 0.;
      unsigned int boundary_id = 0, part = 0;
      /// The rank that it comes from.
      unsigned int owner = 0;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        // clang-format off
        archive & middle & normal & ends & measure & cell_diameter
                & cell_height & boundary_id & part;
        // clang-format on
      }

      /// Where parts touch, two facets may coincide.
      bool
      operator<(const Message &other) const
      {
        return std::tie(middle, normal) < std::tie(other.middle, other.normal);
      }
    };

    template <int dim>
    std::array<double, dim>
    to_array(const Tensor<1, dim> &x)
    {
      std::array<double, dim> array;
      for (unsigned int c = 0; c < dim; ++c)
        array[c] = x[c];
      return array;
    }

    /// The corners of a face in an order that is anticlockwise from outside, in
    /// 2D with the outside on the left. Those of a quadrilateral come in two
    /// rows.
    template <int dim>
    void
    turn_around(std::vector<unsigned int>     &corners,
                const std::vector<Point<dim>> &positions,
                const Tensor<1, dim>          &normal)
    {
      if (corners.size() == 4)
        std::swap(corners[2], corners[3]);
      if constexpr (dim > 1)
        {
          const auto along = [&](const unsigned int corner) {
            return positions[corner] - positions[corners[0]];
          };
          double outside;
          if constexpr (dim == 2)
            outside = cross_product_2d(along(corners[1])) * normal;
          else
            outside =
              cross_product_3d(along(corners[1]), along(corners.back())) *
              normal;
          if ((dim == 2 ? -outside : outside) < 0.)
            std::reverse(corners.begin(), corners.end());
        }
    }

    /// The nodes of a cell: vertices, and, with degree 2, those between them.
    template <int dim>
    struct NodesOfCell
    {
      NodesOfCell(const Body<dim> &body, const unsigned int multiplier_set)
        : body(body)
        , multiplier_set(multiplier_set)
        , element(body.dof_handler().get_fe())
        , points(element.base_element(0).get_unit_support_points())
        , dofs(element.n_dofs_per_cell())
      {}

      void
      reinit(const typename DoFHandler<dim>::active_cell_iterator &cell)
      {
        cell->get_dof_indices(dofs);
        positions.clear();
        for (const Point<dim> &point : points)
          positions.push_back(
            body.mapping().transform_unit_to_real_cell(cell, point));
        // Vertices are equal to the last digit.
        for (const unsigned int v : cell->vertex_indices())
          positions[v] = cell->vertex(v);
        if (body.has_multipliers())
          {
            const auto  multiplier_cell = body.multiplier_cell(cell);
            const auto &multipliers = body.multiplier_dof_handler().get_fe();
            multiplier_dofs.resize(multipliers.n_dofs_per_cell());
            multiplier_cell->get_dof_indices(multiplier_dofs);
          }
      }

      /// The node in the middle of these vertices.
      unsigned int
      between(const std::vector<unsigned int> &vertices) const
      {
        Point<dim> middle;
        for (const unsigned int v : vertices)
          middle += points[v] / static_cast<double>(vertices.size());
        unsigned int closest = 0;
        for (unsigned int n = 0; n < points.size(); ++n)
          if (points[n].distance(middle) < points[closest].distance(middle))
            closest = n;
        AssertThrow(points[closest].distance(middle) < 1e-9,
                    ExcInternalError());
        return closest;
      }

      typename Message<dim>::End
      end(const unsigned int node) const
      {
        typename Message<dim>::End result;
        result.position = to_array<dim>(positions[node]);
        result.multipliers.fill(numbers::invalid_dof_index);
        for (unsigned int c = 0; c < dim; ++c)
          result.unknowns[c] =
            body.system_index(dofs[element.component_to_system_index(c, node)]);
        if (body.has_multipliers())
          {
            const auto &multipliers = body.multiplier_dof_handler().get_fe();
            const auto  multiplier  = [&](const unsigned int set,
                                        const unsigned int c) {
              return body.multiplier_system_index(
                multiplier_dofs[multipliers.component_to_system_index(
                  body.multiplier_component(set, c),
                  node)]);
            };
            if (node < multipliers.base_element(0).n_dofs_per_cell())
              {
                unsigned int n_sets = 0;
                for (unsigned int set = 0; set < body.n_multiplier_sets();
                     ++set)
                  n_sets += multiplier(set, 0) != numbers::invalid_dof_index;
                result.has_several_sets = n_sets > 1;
                for (unsigned int c = 0; c < body.n_multipliers_per_node(); ++c)
                  result.multipliers[c] = multiplier(multiplier_set, c);
              }
          }
        return result;
      }

      const Body<dim>                     &body;
      const unsigned int                   multiplier_set;
      const FiniteElement<dim>            &element;
      const std::vector<Point<dim>>       &points;
      std::vector<types::global_dof_index> dofs, multiplier_dofs;
      /// m
      std::vector<Point<dim>> positions;
    };

    /// The facets of a face with @p corners: itself, or, with degree 2, the
    /// parts into which the nodes between them divide it.
    template <int dim>
    std::vector<std::vector<unsigned int>>
    parts_of_face(const std::vector<unsigned int> &corners,
                  const NodesOfCell<dim>          &nodes)
    {
      if (dim == 1 || nodes.element.degree == 1)
        return {corners};
      std::vector<unsigned int> middles;
      for (unsigned int v = 0; v < corners.size(); ++v)
        middles.push_back(
          nodes.between({corners[v], corners[(v + 1) % corners.size()]}));
      if (dim == 2)
        return {{corners[0], middles[0]}, {middles[0], corners[1]}};
      std::vector<std::vector<unsigned int>> parts;
      const unsigned int                     n = corners.size();
      if (n == 3)
        {
          for (unsigned int v = 0; v < n; ++v)
            parts.push_back({corners[v], middles[v], middles[(v + n - 1) % n]});
          parts.push_back(middles);
          return parts;
        }
      const unsigned int centre = nodes.between(corners);
      for (unsigned int v = 0; v < n; ++v)
        {
          parts.push_back({corners[v], middles[v], centre});
          parts.push_back({middles[v], corners[(v + 1) % n], centre});
        }
      return parts;
    }

    /// Length or area, and direction, of a part of a face with a node between others.
    template <int dim>
    Tensor<1, dim>
    measure_of(const std::vector<unsigned int> &part,
               const std::vector<Point<dim>>   &positions)
    {
      Tensor<1, dim> result;
      if constexpr (dim == 2)
        result = cross_product_2d(positions[part[0]] - positions[part[1]]);
      if constexpr (dim == 3)
        result = .5 *
          cross_product_3d(positions[part[1]] - positions[part[0]],
                           positions[part[2]] - positions[part[0]]);
      return result;
    }

    /// The facets of owned cells.
    template <int dim>
    std::vector<Message<dim>>
    own_facets(const Body<dim>                    &body,
               const std::set<types::boundary_id> &boundaries,
               const unsigned int                  multiplier_set)
    {
      const FiniteElement<dim> &element = body.dof_handler().get_fe();
      FEFaceValues<dim>         face_values(body.mapping(),
                                    element,
                                    body.face_quadrature(),
                                    update_normal_vectors | update_JxW_values);
      NodesOfCell<dim>          nodes(body, multiplier_set);
      std::vector<Message<dim>> messages;
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary() &&
                boundaries.count(cell->face(f)->boundary_id()) > 0)
              {
                const auto face = cell->face(f);
                face_values.reinit(cell, f);
                nodes.reinit(cell);
                std::vector<unsigned int> corners;
                for (const unsigned int v : cell->vertex_indices())
                  for (unsigned int w = 0; w < face->n_vertices(); ++w)
                    if (face->vertex_index(w) == cell->vertex_index(v))
                      corners.push_back(v);
                turn_around<dim>(corners,
                                 nodes.positions,
                                 face_values.normal_vector(0));
                const auto parts        = parts_of_face<dim>(corners, nodes);
                double     face_measure = 0.;
                for (const unsigned int q :
                     face_values.quadrature_point_indices())
                  face_measure += face_values.JxW(q);
                for (const std::vector<unsigned int> &part : parts)
                  {
                    Message<dim> message;
                    message.cell_diameter = cell->diameter();
                    message.cell_height   = cell->measure() / face_measure;
                    message.boundary_id   = face->boundary_id();
                    message.part          = cell->material_id();
                    if (parts.size() == 1)
                      {
                        message.measure = face_measure;
                        message.middle  = to_array<dim>(face->center());
                        message.normal = to_array(face_values.normal_vector(0));
                      }
                    else
                      {
                        const Tensor<1, dim> measure =
                          measure_of<dim>(part, nodes.positions);
                        message.measure = measure.norm();
                        message.normal =
                          to_array<dim>(measure / measure.norm());
                        Tensor<1, dim> middle;
                        for (const unsigned int n : part)
                          middle += nodes.positions[n] /
                            static_cast<double>(part.size());
                        message.middle = to_array<dim>(middle);
                      }
                    for (const unsigned int n : part)
                      message.ends.push_back(nodes.end(n));
                    messages.push_back(message);
                  }
              }
      return messages;
    }
  } // namespace



  template <int dim>
  ContactSurface<dim>::ContactSurface(
    const Body<dim>                    &body,
    const std::set<types::boundary_id> &boundaries,
    const unsigned int                  multiplier_set)
  {
    if (body.dof_handler().get_fe().degree > 2)
      throw InputError(
        "Contact between bodies takes displacements of degree 1 and 2; "
        "the degree is " +
        std::to_string(body.dof_handler().get_fe().degree) + ".");
    std::vector<Message<dim>> messages;
    const auto                messages_of_rank =
      Utilities::MPI::all_gather(body.communicator,
                                 own_facets(body, boundaries, multiplier_set));
    for (unsigned int rank = 0; rank < messages_of_rank.size(); ++rank)
      for (Message<dim> message : messages_of_rank[rank])
        {
          message.owner = rank;
          messages.push_back(std::move(message));
        }
    std::sort(messages.begin(), messages.end());
    if (messages.empty())
      throw InputError(
        "A contact has no surface: the mesh has no boundary "
        "with one of its ids.");

    std::map<types::global_dof_index, unsigned int> number_of_node;
    std::vector<std::vector<unsigned int>>          nodes_of_messages;
    for (const Message<dim> &message : messages)
      {
        nodes_of_messages.emplace_back();
        for (const auto &end : message.ends)
          {
            const auto [known, is_new] =
              number_of_node.emplace(end.unknowns[0], nodes.size());
            nodes_of_messages.back().push_back(known->second);
            if (!is_new)
              continue;
            Node node;
            for (unsigned int c = 0; c < dim; ++c)
              node.reference_position[c] = end.position[c];
            node.unknowns         = end.unknowns;
            node.multipliers      = end.multipliers;
            node.has_several_sets = end.has_several_sets;
            node.is_held =
              std::all_of(end.unknowns.begin(),
                          end.unknowns.end(),
                          [&](const auto index) {
                            return body.constraints().is_constrained(index);
                          });
            nodes.push_back(node);
          }
      }
    for (unsigned int m = 0; m < messages.size(); ++m)
      {
        const Message<dim>              &message = messages[m];
        const std::vector<unsigned int> &own     = nodes_of_messages[m];
        Facet                            facet;
        for (unsigned int c = 0; c < dim; ++c)
          facet.normal[c] = message.normal[c];
        facet.boundary_id   = message.boundary_id;
        facet.part          = message.part;
        facet.owner         = message.owner;
        facet.measure       = message.measure;
        facet.cell_diameter = message.cell_diameter;
        facet.cell_height   = message.cell_height;
        if (own.size() == dim)
          {
            std::copy(own.begin(), own.end(), facet.nodes.begin());
            facets.push_back(facet);
          }
        else if constexpr (dim == 3)
          {
            Node mean;
            mean.unknowns.fill(numbers::invalid_dof_index);
            mean.multipliers.fill(numbers::invalid_dof_index);
            mean.mean_of = own;
            mean.is_held = true;
            for (const unsigned int n : own)
              {
                mean.reference_position +=
                  nodes[n].reference_position / static_cast<double>(own.size());
                mean.is_held = mean.is_held && nodes[n].is_held;
              }
            nodes.push_back(mean);
            for (unsigned int v = 0; v < own.size(); ++v)
              {
                facet.nodes          = {{own[v],
                                         own[(v + 1) % own.size()],
                                         static_cast<unsigned int>(nodes.size() - 1)}};
                const Point<dim>  &a = nodes[facet.nodes[0]].reference_position;
                const Tensor<1, 3> area = .5 *
                  cross_product_3d(Tensor<1, 3>(
                                     nodes[facet.nodes[1]].reference_position -
                                     a),
                                   Tensor<1, 3>(mean.reference_position - a));
                facet.measure = area.norm();
                facet.normal  = area / area.norm();
                facets.push_back(facet);
              }
          }
      }
    connect_facets();
  }



  template <int dim>
  void
  ContactSurface<dim>::connect_facets()
  {
    const char *const branches =
      "A surface of contact branches: more than two of its facets meet ";
    if constexpr (dim == 2)
      {
        std::vector<std::optional<unsigned int>> begins(nodes.size());
        for (unsigned int f = 0; f < facets.size(); ++f)
          {
            std::optional<unsigned int> &begin = begins[facets[f].nodes[0]];
            if (begin)
              throw InputError(std::string(branches) + "at a node.");
            begin = f;
          }
        for (unsigned int f = 0; f < facets.size(); ++f)
          if (const auto next = begins[facets[f].nodes[1]])
            {
              facets[f].next         = next;
              facets[*next].previous = f;
            }
      }
    if constexpr (dim == 3)
      {
        // An edge is seen from both sides in opposite directions.
        std::map<std::pair<unsigned int, unsigned int>, unsigned int> edges;
        for (unsigned int f = 0; f < facets.size(); ++f)
          for (unsigned int e = 0; e < 3; ++e)
            if (!edges
                   .emplace(std::pair(facets[f].nodes[e],
                                      facets[f].nodes[(e + 1) % 3]),
                            f)
                   .second)
              throw InputError(std::string(branches) + "at an edge.");
        for (Facet &facet : facets)
          for (unsigned int e = 0; e < 3; ++e)
            if (const auto other = edges.find(
                  std::pair(facet.nodes[(e + 1) % 3], facet.nodes[e]));
                other != edges.end())
              facet.neighbours[e] = other->second;
      }
  }


  template <int dim>
  std::vector<std::set<types::boundary_id>>
  ContactSurface<dim>::connected_boundaries() const
  {
    std::vector<std::set<types::boundary_id>> groups;
    const auto                                group_of = [&](const auto id) {
      return std::find_if(groups.begin(), groups.end(), [&](const auto &group) {
        return group.count(id) > 0;
      });
    };
    for (const Facet &facet : facets)
      if (group_of(facet.boundary_id) == groups.end())
        groups.push_back({facet.boundary_id});
    const auto join = [&](const Facet                       &facet,
                          const std::optional<unsigned int> &neighbour) {
      if (!neighbour)
        return;
      const auto own   = group_of(facet.boundary_id);
      const auto other = group_of(facets[*neighbour].boundary_id);
      if (own == other)
        return;
      own->insert(other->begin(), other->end());
      groups.erase(other);
    };
    for (const Facet &facet : facets)
      {
        join(facet, facet.previous);
        join(facet, facet.next);
        for (const auto &neighbour : facet.neighbours)
          join(facet, neighbour);
      }
    return groups;
  }


  template class ContactSurface<1>;
  template class ContactSurface<2>;
  template class ContactSurface<3>;
} // namespace Ricochet
