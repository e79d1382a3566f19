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
    /// A facet as it goes from rank to rank.
    template <int dim>
    struct Message
    {
      struct End
      {
        std::array<double, dim>                  position;
        std::array<types::global_dof_index, dim> unknowns, multipliers;

        template <class Archive>
        void
        serialize(Archive &archive, const unsigned int /*version*/)
        {
          // clang-format off
          archive & position & unknowns & multipliers;
          // clang-format on
        }
      };

      std::array<double, dim> middle, normal;
      std::vector<End>        ends;
      double                  measure = 0., cell_diameter = 0.;
      unsigned int            boundary_id = 0, part = 0;

      template <class Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        // clang-format off
        archive & middle & normal & ends & measure & cell_diameter
                & boundary_id & part;
        // clang-format on
      }

      /// Where parts touch, two facets may be in one place.
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

    /// In an order that is anticlockwise from outside. Those of a quadrilateral come in
    /// two rows.
    void
    turn_around(Message<3> &message)
    {
      auto &ends = message.ends;
      if (ends.size() == 4)
        std::swap(ends[2], ends[3]);
      Tensor<1, 3> edge[2], normal;
      for (unsigned int c = 0; c < 3; ++c)
        {
          edge[0][c] = ends[1].position[c] - ends[0].position[c];
          edge[1][c] = ends.back().position[c] - ends[0].position[c];
          normal[c]  = message.normal[c];
        }
      if (cross_product_3d(edge[0], edge[1]) * normal < 0.)
        std::reverse(ends.begin(), ends.end());
    }

    /// The facets of owned cells.
    template <int dim>
    std::vector<Message<dim>>
    own_facets(const Body<dim>                    &body,
               const std::set<types::boundary_id> &boundaries)
    {
      const FiniteElement<dim> &element = body.dof_handler().get_fe();
      FEFaceValues<dim>         face_values(body.mapping(),
                                    element,
                                    body.face_quadrature(),
                                    update_normal_vectors | update_JxW_values);
      std::vector<Message<dim>> messages;
      const auto                for_each_facet = [&](const auto &action) {
        for (const auto &cell : body.dof_handler().active_cell_iterators())
          if (cell->is_locally_owned())
            for (const unsigned int f : cell->face_indices())
              if (cell->face(f)->at_boundary() &&
                  boundaries.count(cell->face(f)->boundary_id()) > 0)
                action(cell, f);
      };
      for_each_facet([&](const auto &cell, const unsigned int f) {
        const auto face = cell->face(f);
        face_values.reinit(cell, f);
        Message<dim> message;
        for (const unsigned int q : face_values.quadrature_point_indices())
          message.measure += face_values.JxW(q);
        message.middle        = to_array<dim>(face->center());
        message.normal        = to_array(face_values.normal_vector(0));
        message.cell_diameter = cell->diameter();
        message.boundary_id   = face->boundary_id();
        message.part          = cell->material_id();
        for (const unsigned int v : cell->vertex_indices())
          {
            bool on_face = false;
            for (unsigned int w = 0; w < face->n_vertices(); ++w)
              on_face =
                on_face || face->vertex_index(w) == cell->vertex_index(v);
            if (!on_face)
              continue;
            typename Message<dim>::End end;
            end.position = to_array<dim>(cell->vertex(v));
            end.multipliers.fill(numbers::invalid_dof_index);
            for (unsigned int c = 0; c < dim; ++c)
              end.unknowns[c] = body.system_index(cell->vertex_dof_index(v, c));
            if (body.has_multipliers())
              {
                const auto multiplier_cell = body.multiplier_cell(cell);
                for (unsigned int c = 0;
                     c < body.multiplier_dof_handler().get_fe().n_components();
                     ++c)
                  end.multipliers[c] = body.multiplier_system_index(
                    multiplier_cell->vertex_dof_index(v, c));
              }
            message.ends.push_back(end);
          }
        // Outside on the left.
        if constexpr (dim == 2)
          if ((message.ends[1].position[0] - message.ends[0].position[0]) *
                  message.normal[1] -
                (message.ends[1].position[1] - message.ends[0].position[1]) *
                  message.normal[0] <
              0.)
            std::swap(message.ends[0], message.ends[1]);
        if constexpr (dim == 3)
          turn_around(message);
        messages.push_back(message);
      });
      return messages;
    }
  } // namespace



  template <int dim>
  ContactSurface<dim>::ContactSurface(
    const Body<dim>                    &body,
    const std::set<types::boundary_id> &boundaries)
  {
    if (body.dof_handler().get_fe().degree != 1)
      throw InputError(
        "Contact between bodies needs displacements of degree 1; "
        "the degree is " +
        std::to_string(body.dof_handler().get_fe().degree) + ".");
    std::vector<Message<dim>> messages;
    for (const auto &list :
         Utilities::MPI::all_gather(body.communicator,
                                    own_facets(body, boundaries)))
      messages.insert(messages.end(), list.begin(), list.end());
    std::sort(messages.begin(), messages.end());
    if (messages.empty())
      throw InputError(
        "A contact has no surface: the mesh has no boundary "
        "with one of its ids.");

    std::set<types::global_dof_index> held;
    for (const auto &list : Utilities::MPI::all_gather(
           body.communicator,
           std::vector<types::global_dof_index>(body.clamped_indices().begin(),
                                                body.clamped_indices().end())))
      held.insert(list.begin(), list.end());

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
            node.unknowns    = end.unknowns;
            node.multipliers = end.multipliers;
            node.is_held     = std::all_of(end.unknowns.begin(),
                                       end.unknowns.end(),
                                       [&](const auto index) {
                                         return held.count(index) > 0;
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
        facet.measure       = message.measure;
        facet.cell_diameter = message.cell_diameter;
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


  template class ContactSurface<1>;
  template class ContactSurface<2>;
  template class ContactSurface<3>;
} // namespace Ricochet
