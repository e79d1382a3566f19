// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/contact_sum.h>
#include <discretization/curved_geometry.h>
#include <discretization/distributed_mesh.h>
#include <output/obstacle_work.h>
#include <output/part_columns.h>
#include <problems/impact_loop.h>
#include <problems/part_meshes.h>
#include <scene/scene.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

// Set-up of the run from a scene.
namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A name as written in the ledger.
    std::string
    column_name(std::string name)
    {
      std::replace(name.begin(), name.end(), ' ', '_');
      return name;
    }
  } // namespace



  template <int dim>
  ImpactSetup<dim>
  Scene<dim>::make_setup() const
  {
    ImpactSetup<dim> setup{parts.front().material.template make<dim>()};
    setup.degree           = degree;
    setup.starts_displaced = !start_from.empty();
    setup.gravity          = gravity;
    for (const PartOfScene &own : parts)
      {
        const BodySection<dim> &body = bodies[own.body];
        Part<dim>               part{own.name,
                       own.material.template make<dim>(),
                       own.material.density,
                       body.velocity,
                       body.spin,
                       centres[own.body]};
        if (!body.acceleration.empty())
          part.acceleration =
            parse_vector_field<dim>(body.acceleration,
                                    body.name_of("Acceleration"));
        setup.parts.push_back(part);
      }
    for (const ContactSection &contact : contacts)
      {
        const Touching     touching = find_touching(contact);
        const std::string &name     = contact.section.name;
        if (touching.obstacles.empty())
          {
            std::set<types::boundary_id> slave;
            for (const auto &surface : touching.slave)
              slave.insert(surface.ids.begin(), surface.ids.end());
            setup.contacts.push_back(
              {name,
               contact.parameters,
               {},
               {{name,
                 slave,
                 touching.is_self ? slave : touching.master,
                 touching.is_self}}});
            setup.contacts.back().pairs.front().interference =
              contact.make_interference();
          }
        // Contacts with rigid obstacles, one for each body and obstacle: a body
        // has its own stress, and a boundary may touch several.
        for (const unsigned int i : touching.obstacles)
          for (const auto &surface : touching.slave)
            {
              Contact own{name, contact.parameters};
              own.part = *parts_at(surface).begin();
              const auto obstacle =
                obstacles[i].second.make(impact.time.final_time);
              for (const auto id : surface.ids)
                own.obstacles[id] = obstacle;
              setup.contacts.push_back(own);
            }
      }
    for (const ConditionSection<dim> &condition : conditions)
      condition.add_to(surfaces, first_part, setup);
    return setup;
  }



  template <int dim>
  void
  Scene<dim>::join(Triangulation<dim> &whole) const
  {
    std::vector<const Triangulation<dim> *> all;
    for (const auto &mesh : meshes)
      all.push_back(&mesh->cells);
    join_parts(all, whole, /* keep material ids */ true);
  }



  template <int dim>
  CellNodes<dim>
  Scene<dim>::nodes_of_cells() const
  {
    CellNodes<dim> nodes;
    for (const auto &mesh : meshes)
      nodes.insert(nodes.end(), mesh->nodes.begin(), mesh->nodes.end());
    return nodes;
  }



  namespace
  {
    /// The parts of the body that have these parts of the boundary. Collective.
    template <int dim>
    std::set<unsigned int>
    parts_behind(const Body<dim> &body, const std::set<types::boundary_id> &ids)
    {
      std::vector<unsigned int> mine;
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
              mine.push_back(cell->material_id());
      std::set<unsigned int> parts;
      for (const auto &list :
           Utilities::MPI::all_gather(body.communicator, mine))
        parts.insert(list.begin(), list.end());
      return parts;
    }

    /// The unknowns on which the force of a contact on its first surface acts, in
    /// direction @p c: all of the bodies that have it, as Nitsche's method acts on all
    /// nodes of the cells behind a surface; only those of the surface where the second
    /// one is on the same body.
    template <int dim>
    IndexSet
    first_side(const Impact<dim>                  &assembly,
               const Contact                      &contact,
               const std::set<types::boundary_id> &ids,
               const unsigned int                  c)
    {
      const Body<dim>             &body = assembly.body;
      IndexSet                     unknowns(body.owned_indices().size());
      std::set<types::boundary_id> others;
      for (const ContactPair &pair : contact.pairs)
        others.insert(pair.master.begin(), pair.master.end());
      const std::set<unsigned int> parts       = parts_behind(body, ids),
                                   other_parts = parts_behind(body, others);
      const bool is_apart =
        std::none_of(parts.begin(), parts.end(), [&](const unsigned int part) {
          return other_parts.count(part) > 0;
        });
      if (!is_apart)
        {
          for (const auto id : ids)
            unknowns.add_indices(body.boundary_displacements(id, c) &
                                 body.owned_indices());
          return unknowns;
        }
      Tensor<1, dim> direction;
      direction[c]      = 1.;
      const Vector unit = assembly.uniform(direction);
      const auto   part_of =
        body.parts_of_unknowns(std::max<std::size_t>(1, assembly.parts.size()));
      unsigned int k = 0;
      for (const auto i : body.owned_indices())
        {
          if (k < part_of.size() && parts.count(part_of[k]) > 0 &&
              unit(i) != 0.)
            unknowns.add_index(i);
          ++k;
        }
      return unknowns;
    }

    /// The columns resultant_x_CONTACT, ...: the force on the first surface of each contact,
    /// pressure and friction together (N); of a surface with itself there is none. And the columns
    /// impulse_x_CONTACT, ...: its integral since the start (N s). @p assembly must outlive
    /// @p loop.
    template <int dim>
    void
    add_resultants(TimeLoop &loop, const Impact<dim> &assembly)
    {
      // For each name, the numbers of contacts and the nodes of their first
      // surfaces.
      struct Resultant
      {
        std::string                                    name;
        std::vector<std::pair<unsigned int, IndexSet>> forces;
      };
      for (unsigned int c = 0; c < dim; ++c)
        {
          std::vector<Resultant> resultants;
          for (unsigned int k = 0; k < assembly.contacts.size(); ++k)
            {
              const Contact               &contact = assembly.contacts[k];
              std::set<types::boundary_id> ids;
              for (const auto &obstacle : contact.obstacles)
                ids.insert(obstacle.first);
              for (const ContactPair &pair : contact.pairs)
                if (!pair.is_self)
                  ids.insert(pair.slave.begin(), pair.slave.end());
              if (ids.empty())
                continue;
              const IndexSet    nodes = first_side(assembly, contact, ids, c);
              const std::string name  = column_name(contact.name);
              if (resultants.empty() || resultants.back().name != name)
                resultants.push_back({name, {}});
              resultants.back().forces.emplace_back(k, nodes);
            }
          for (const Resultant &resultant : resultants)
            {
              const auto force_at = [forces       = resultant.forces,
                                     communicator = assembly.body.communicator](
                                      const State &state) {
                double sum = 0.;
                for (const auto &[k, nodes] : forces)
                  {
                    // The state has the force that the body exerts.
                    const Vector &force = state.contact_shares.empty()
                      ? state.contact_force
                      : state.contact_shares[k];
                    for (const auto i : nodes)
                      sum -= force(i);
                  }
                return Utilities::MPI::sum(sum, communicator);
              };
              const std::string name =
                std::string(1, "xyz"[c]) + "_" + resultant.name;
              loop.add_column("resultant_" + name, "N", force_at);
              loop.add_sum("impulse_" + name,
                           "N s",
                           [force_at,
                            is_of_step =
                              assembly.scheme->contact_force_is_of_step()](
                             const State &begin,
                             const State &end) {
                             const double force = is_of_step
                               ? force_at(end)
                               : .5 * (force_at(begin) + force_at(end));
                             return force * (end.time - begin.time);
                           });
            }
        }
    }



    /// Contacts between two bodies, or of one with an obstacle at rest, have a restitution.
    template <int dim>
    void
    add_rebounds(TimeLoop                        &loop,
                 const Impact<dim>               &assembly,
                 const PartColumns<dim>          &columns,
                 const std::vector<std::string>  &body_names,
                 const std::vector<unsigned int> &first_part)
    {
      for (const Contact &contact : assembly.contacts)
        {
          std::set<types::boundary_id> ids;
          bool                         is_at_rest = true;
          for (const auto &[id, obstacle] : contact.obstacles)
            {
              ids.insert(id);
              is_at_rest = is_at_rest && obstacle->motion().is_at_rest();
            }
          for (const ContactPair &pair : contact.pairs)
            {
              ids.insert(pair.slave.begin(), pair.slave.end());
              ids.insert(pair.master.begin(), pair.master.end());
            }
          // The bodies of these parts.
          std::set<unsigned int> numbers;
          for (const unsigned int part : parts_behind(assembly.body, ids))
            numbers.insert(
              first_part.empty()
                ? part
                : std::upper_bound(first_part.begin(), first_part.end(), part) -
                  first_part.begin() - 1);
          if (!is_at_rest ||
              numbers.size() != (contact.is_between_bodies() ? 2 : 1))
            continue;
          RunSummary::Rebound rebound{column_name(contact.name), {}};
          for (const unsigned int b : numbers)
            rebound.bodies.push_back(
              body_names.size() == 1
                ? RunSummary::Rebound::Body{"",
                                            columns.momenta().mass_of_body()}
                : RunSummary::Rebound::Body{"_" + body_names[b],
                                            columns.momenta(b).mass_of_body()});
          loop.rebounds.push_back(rebound);
        }
    }
  } // namespace



  // ### The run
  template <int dim>
  void
  Scene<dim>::run(RunFolder &folder)
  {
    for (const std::string &line : notes())
      folder.log(line);

    // Computed values replace the zeros in parameters.prm.
    for (const ContactSection &contact : contacts)
      {
        handler->enter_subsection(contact.section.full_name());
        for (const auto &[name, value] : contact.parameters.used_values())
          {
            char text[40];
            std::snprintf(text, sizeof(text), "%.17g", value);
            handler->set(name, std::string(text));
            folder.log(contact.name_of(name) + " = " + to_text(value));
          }
        handler->leave_subsection();
      }
    std::ostringstream all_parameters;
    handler->print_parameters(all_parameters, ParameterHandler::Text);
    folder.all_parameters = all_parameters.str();

    const auto cells =
      distribute_mesh<dim>([&](Triangulation<dim> &whole) { join(whole); },
                           folder.communicator);
    ImpactSetup<dim> setup = make_setup();
    const auto       nodes = nodes_of_cells();
    if (!nodes.empty())
      setup.geometry = make_curved_geometry(nodes, *cells, folder.communicator);
    Impact<dim> assembly(impact, *cells, setup, folder.communicator);
    folder.log(std::to_string(cells->n_global_active_cells()) + " cells, " +
               std::to_string(assembly.body.owned_indices().size()) +
               " unknowns, " + std::to_string(bodies.size()) +
               (bodies.size() == 1 ? " body, " : " bodies, ") +
               std::to_string(contacts.size()) +
               (contacts.size() == 1 ? " contact, " : " contacts, ") +
               impact.scheme.name);
    for (const std::string &line : notes_on_fits(assembly.contacts))
      folder.log(line);

    State initial_state;
    if (start_from.empty())
      initial_state = assembly.state_of_parts();
    else
      {
        const auto motion =
          CheckpointMotion::read(start_from,
                                 assembly.body.make_vector(),
                                 CheckpointMesh(assembly.system.unknowns,
                                                folder.communicator));
        initial_state = assembly.state_from(motion);
        folder.log("starts from " + start_from +
                   " at its t = " + Units(units_text).text(motion.time, "s"));
      }

    // Boundaries of one contact have common columns.
    std::map<types::boundary_id, std::string> names;
    std::vector<Obstacles>                    obstacles_of_contacts;
    for (unsigned int k = 0; k < assembly.contacts.size(); ++k)
      {
        const Contact &contact = assembly.contacts[k];
        const auto     add     = [&](const types::boundary_id id) {
          names[assembly.contacts.size() == 1 ? id : ContactSum::id_of(k, id)] =
            column_name(contact.name);
        };
        for (const auto &obstacle : contact.obstacles)
          add(obstacle.first);
        for (const ContactPair &pair : contact.pairs)
          for (const auto id : pair.slave)
            add(id);
        obstacles_of_contacts.push_back(contact.obstacles);
      }
    std::vector<Material<dim>> all_materials;
    for (const Part<dim> &part : assembly.parts)
      all_materials.push_back(part.material);
    ImpactLoop<dim>          loop(impact.time,
                         assembly,
                         all_materials,
                         names,
                         folder,
                         Units(units_text));
    std::vector<std::string> body_names;
    for (const BodySection<dim> &body : bodies)
      body_names.push_back(body.section.column_name());
    const PartColumns<dim> columns(assembly.body,
                                   assembly.system,
                                   /* small strains */
                                   are_linear(all_materials),
                                   body_names,
                                   first_part);
    columns.add_to(loop);
    add_resultants(loop, assembly);
    add_rebounds(loop, assembly, columns, body_names, first_part);
    for (const ProbeSection<dim> &probe : probes)
      probe.add_to(loop, assembly, surfaces, first_part);
    const ObstacleWork<dim> obstacle_work(assembly.body, obstacles_of_contacts);
    loop.obstacle_work = obstacle_work;

    for (const Part<dim> &part : assembly.parts)
      loop.part_names.push_back(part.name);
    for (const BodySection<dim> &body : bodies)
      body.keep_mesh(folder);
    loop.run(initial_state);
    folder.log("pictures: ricochet-plot " + folder.file("") +
               (impact.time.wants_fields() ? " --fields" : ""));
  }


  template ImpactSetup<2>
  Scene<2>::make_setup() const;
  template ImpactSetup<3>
  Scene<3>::make_setup() const;
  template void
  Scene<2>::join(Triangulation<2> &) const;
  template void
  Scene<3>::join(Triangulation<3> &) const;
  template CellNodes<2>
  Scene<2>::nodes_of_cells() const;
  template CellNodes<3>
  Scene<3>::nodes_of_cells() const;
  template void
  Scene<2>::run(RunFolder &);
  template void
  Scene<3>::run(RunFolder &);
} // namespace Ricochet
