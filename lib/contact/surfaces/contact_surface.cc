// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/surfaces/contact_surface.h>

#include <deal.II/fe/fe_values.h>

#include <boost/serialization/array.hpp>

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
      std::array<End, dim>    ends;
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
        unsigned int n_ends   = 0;
        for (const unsigned int v : cell->vertex_indices())
          {
            bool on_face = false;
            for (unsigned int w = 0; w < face->n_vertices(); ++w)
              on_face =
                on_face || face->vertex_index(w) == cell->vertex_index(v);
            if (!on_face)
              continue;
            typename Message<dim>::End &end = message.ends[n_ends++];
            end.position                    = to_array<dim>(cell->vertex(v));
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
          }
        // Outside on the left.
        if constexpr (dim == 2)
          if ((message.ends[1].position[0] - message.ends[0].position[0]) *
                  message.normal[1] -
                (message.ends[1].position[1] - message.ends[0].position[1]) *
                  message.normal[0] <
              0.)
            std::swap(message.ends[0], message.ends[1]);
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
    for (const Message<dim> &message : messages)
      {
        Facet facet;
        for (unsigned int v = 0; v < dim; ++v)
          {
            const auto &end = message.ends[v];
            const auto [known, is_new] =
              number_of_node.emplace(end.unknowns[0], nodes.size());
            facet.nodes[v] = known->second;
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
        for (unsigned int c = 0; c < dim; ++c)
          facet.normal[c] = message.normal[c];
        facet.boundary_id   = message.boundary_id;
        facet.part          = message.part;
        facet.measure       = message.measure;
        facet.cell_diameter = message.cell_diameter;
        facets.push_back(facet);
      }

    if constexpr (dim == 2)
      {
        std::vector<std::optional<unsigned int>> begins(nodes.size());
        for (unsigned int f = 0; f < facets.size(); ++f)
          {
            std::optional<unsigned int> &begin = begins[facets[f].nodes[0]];
            if (begin)
              throw InputError(
                "A surface of contact branches: at a node more "
                "than two of its facets meet.");
            begin = f;
          }
        for (unsigned int f = 0; f < facets.size(); ++f)
          if (const auto next = begins[facets[f].nodes[1]])
            {
              facets[f].next         = next;
              facets[*next].previous = f;
            }
      }
  }


  template class ContactSurface<1>;
  template class ContactSurface<2>;
} // namespace Ricochet
