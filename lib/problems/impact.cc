// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/obstacles/half_space.h>
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <contact/treatments/contact_sum.h>
#include <contact/treatments/pair_contact.h>
#include <discretization/boundary_load.h>
#include <discretization/bulk_of_parts.h>
#include <discretization/bulk_sum.h>
#include <discretization/linear_bulk.h>
#include <problems/clearance.h>
#include <problems/impact.h>
#include <problems/unheld_bodies.h>
#include <time_integration/mass_redistribution.h>

#include <deal.II/base/function.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>

#include <algorithm>
#include <limits>


namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    using BoundaryIds = std::set<types::boundary_id>;

    /// All contacts of a set-up: those with the treatment of the @p parameters, and
    /// those with their own.
    template <int dim>
    std::vector<Contact>
    contacts_of(const ContactParameters &parameters,
                const ImpactSetup<dim>  &setup)
    {
      std::vector<Contact> contacts;
      if (!setup.obstacles.empty())
        contacts.push_back({"", parameters, setup.obstacles});
      if (!setup.pairs.empty())
        contacts.push_back({"", parameters, {}, setup.pairs});
      contacts.insert(contacts.end(),
                      setup.contacts.begin(),
                      setup.contacts.end());
      return contacts;
    }

    /// The boundaries on which a contact is formulated.
    BoundaryIds
    contact_ids(const Contact &contact)
    {
      BoundaryIds ids;
      for (const auto &obstacle : contact.obstacles)
        ids.insert(obstacle.first);
      for (const ContactPair &pair : contact.pairs)
        ids.insert(pair.slave.begin(), pair.slave.end());
      return ids;
    }

    BoundaryIds
    contact_ids(const std::vector<Contact> &contacts)
    {
      BoundaryIds all;
      for (const Contact &contact : contacts)
        {
          const BoundaryIds ids = contact_ids(contact);
          all.insert(ids.begin(), ids.end());
        }
      return all;
    }

    MultiplierSpace
    multipliers_of(const Contact &contact)
    {
      return contact.is_between_bodies()
        ? pair_multiplier_space(contact.parameters)
        : multiplier_space(contact.parameters);
    }

    /// The space of the multipliers of all contacts, with displacements of @p degree.
    MultiplierSpace
    multipliers_of(const std::vector<Contact> &contacts,
                   const unsigned int          degree)
    {
      MultiplierSpace all = MultiplierSpace::none;
      for (const Contact &contact : contacts)
        all = std::max(all, multipliers_of(contact));
      if (all == MultiplierSpace::nodal_vector ||
          (all == MultiplierSpace::nodal && degree > 1))
        for (const Contact &contact : contacts)
          if (!contact.is_between_bodies() &&
              multipliers_of(contact) != MultiplierSpace::none)
            throw InputError(
              "The treatment '" + contact.parameters.treatment +
              "' of the contact '" + contact.name +
              "' brings multipliers for a rigid obstacle, which cannot be "
              "combined with those of another contact between bodies. Choose an "
              "active set, penalty or normal compliance for it.");
      return all;
    }

    /// The contacts of a set-up with the sets of their multipliers, see Body: the first one
    /// for obstacles, and for contacts between bodies the first one that no other contact
    /// has on the same nodes.
    template <int dim>
    std::vector<Contact>
    contacts_with_sets(const ContactParameters  &parameters,
                       const ImpactSetup<dim>   &setup,
                       const Triangulation<dim> &triangulation,
                       const MPI_Comm            communicator)
    {
      std::vector<Contact> contacts = contacts_of(parameters, setup);
      std::vector<std::set<unsigned int>> vertices;
      for (const Contact &contact : contacts)
        {
          const BoundaryIds       ids = contact_ids(contact);
          std::set<unsigned int> &own = vertices.emplace_back();
          for (const auto &cell : triangulation.active_cell_iterators())
            if (!cell->is_artificial())
              for (const auto &face : cell->face_iterators())
                if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
                  for (const unsigned int v : face->vertex_indices())
                    own.insert(face->vertex_index(v));
        }
      const auto share_nodes = [&](const unsigned int i, const unsigned int j) {
        const bool some = std::any_of(vertices[i].begin(),
                                      vertices[i].end(),
                                      [&](const unsigned int v) {
                                        return vertices[j].count(v) > 0;
                                      });
        return Utilities::MPI::max(some ? 1 : 0, communicator) == 1;
      };
      for (unsigned int j = 0; j < contacts.size(); ++j)
        {
          if (!contacts[j].is_between_bodies() ||
              multipliers_of(contacts[j]) == MultiplierSpace::none)
            continue;
          std::set<unsigned int> taken;
          for (unsigned int i = 0; i < contacts.size(); ++i)
            if ((i < j || !contacts[i].is_between_bodies()) &&
                multipliers_of(contacts[i]) != MultiplierSpace::none &&
                share_nodes(i, j))
              taken.insert(contacts[i].multiplier_set());
          unsigned int set = 0;
          while (taken.count(set) > 0)
            ++set;
          for (ContactPair &pair : contacts[j].pairs)
            pair.multiplier_set = set;
        }
      return contacts;
    }

    /// Set the overlaps of curved surfaces that fit into each other in the @p contacts; none
    /// where bodies overlap by more.
    /// @return what is wrong with other overlaps, see find_overlaps().
    template <int dim>
    std::string
    set_overlaps(const Body<dim> &body, std::vector<Contact> &contacts)
    {
      std::string problem;
      for (Contact &contact : contacts)
        {
          const std::string own =
            find_overlaps(body,
                          contact.pairs,
                          contact.parameters.coupling == "points");
          if (!own.empty())
            for (ContactPair &pair : contact.pairs)
              pair.overlap = 0.;
          if (problem.empty())
            problem = own;
        }
      return problem;
    }

    /// The boundary ids of each set.
    std::vector<BoundaryIds>
    multiplier_sets(const std::vector<Contact> &contacts)
    {
      std::vector<BoundaryIds> sets;
      for (const Contact &contact : contacts)
        if (multipliers_of(contact) != MultiplierSpace::none)
          {
            const unsigned int set = contact.multiplier_set();
            sets.resize(std::max<std::size_t>(sets.size(), set + 1));
            const BoundaryIds ids = contact_ids(contact);
            sets[set].insert(ids.begin(), ids.end());
          }
      return sets;
    }

    std::vector<std::string>
    names_of(const std::vector<Contact> &contacts)
    {
      std::vector<std::string> names;
      for (const Contact &contact : contacts)
        names.push_back(contact.name);
      return names;
    }

    /// The obstacles of all contacts, for output.
    Obstacles
    obstacles_of(const std::vector<Contact> &contacts)
    {
      Obstacles all;
      for (unsigned int k = 0; k < contacts.size(); ++k)
        for (const auto &[id, obstacle] : contacts[k].obstacles)
          all[ContactSum::id_of(k, id)] = obstacle;
      return all;
    }

    /// All boundaries with an obstacle, a contact or a condition.
    template <int dim>
    typename Body<dim>::BoundaryIds
    named_ids(const ImpactSetup<dim> &setup)
    {
      const std::vector<Contact>      contacts = contacts_of({}, setup);
      typename Body<dim>::BoundaryIds ids      = contact_ids(contacts);
      ids.insert(setup.clamped.begin(), setup.clamped.end());
      for (const Contact &contact : contacts)
        for (const ContactPair &pair : contact.pairs)
          ids.insert(pair.master.begin(), pair.master.end());
      for (const auto &entry : setup.imposed)
        ids.insert(entry.first);
      for (const auto &entry : setup.tractions)
        ids.insert(entry.first);
      for (const BoundarySprings<dim> &spring : setup.springs)
        ids.insert(spring.boundary_id);
      for (const BoundaryPressure<dim> &pressure : setup.pressures)
        ids.insert(pressure.boundary_id);
      for (const ResultantLoad<dim> &load : setup.resultants)
        ids.insert(load.ids.begin(), load.ids.end());
      for (const auto &vertex : setup.vertices)
        ids.erase(vertex.first);
      return ids;
    }

    template <int dim>
    typename Body<dim>::HeldComponents
    held_components(const ImpactSetup<dim> &setup)
    {
      typename Body<dim>::HeldComponents held;
      for (const auto &[id, imposed] : setup.imposed)
        held[id] = imposed.components;
      return held;
    }

    template <int dim>
    bool
    is_moved(const ImpactSetup<dim> &setup)
    {
      for (const auto &entry : setup.imposed)
        if (entry.second.value)
          return true;
      return false;
    }

    /// Where conditions meet, zero displacements take precedence, then the
    /// smaller boundary id.
    template <int dim>
    std::vector<typename Impact<dim>::Prescription>
    make_prescriptions(const Body<dim> &body, const ImpactSetup<dim> &setup)
    {
      std::map<types::global_dof_index, Point<dim>> places;
      if (is_moved(setup))
        {
          std::map<types::global_dof_index, Point<dim>> points;
          DoFTools::map_dofs_to_support_points(body.mapping(),
                                               body.dof_handler(),
                                               points);
          for (const auto &[dof, place] : points)
            places[body.system_index(dof)] = place;
        }
      std::map<types::global_dof_index, typename Impact<dim>::Prescription> all;
      for (const auto &[id, imposed] : setup.imposed)
        for (unsigned int c = 0; c < dim; ++c)
          if (imposed.components[c])
            for (const auto unknown : body.boundary_displacements(id, c))
              all.insert(
                {unknown, {unknown, c, places[unknown], imposed.value}});
      for (const auto id : setup.clamped)
        for (unsigned int c = 0; c < dim; ++c)
          for (const auto unknown : body.boundary_displacements(id, c))
            all.erase(unknown);
      std::vector<typename Impact<dim>::Prescription> list;
      for (const auto &entry : all)
        list.push_back(entry.second);
      return list;
    }

    template <int dim>
    std::vector<Material<dim>>
    materials_of(const ImpactSetup<dim> &setup)
    {
      std::vector<Material<dim>> materials;
      for (const Part<dim> &part : setup.parts)
        materials.push_back(part.material);
      if (materials.empty())
        materials.push_back(setup.material);
      return materials;
    }

    template <int dim>
    std::vector<double>
    densities_of(const ImpactSetup<dim> &setup)
    {
      std::vector<double> densities;
      for (const Part<dim> &part : setup.parts)
        densities.push_back(part.density);
      if (densities.empty())
        densities.push_back(setup.density);
      return densities;
    }

    /// The mesh has each of the @p boundaries. @return the mesh.
    template <int dim>
    const Triangulation<dim> &
    with_boundaries(const Triangulation<dim>              &triangulation,
                    const typename Body<dim>::BoundaryIds &boundaries,
                    const MPI_Comm                         communicator)
    {
      for (const auto id : boundaries)
        {
          bool found = false;
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const auto &face : cell->face_iterators())
                found =
                  found || (face->at_boundary() && face->boundary_id() == id);
          if (Utilities::MPI::max(found ? 1 : 0, communicator) == 0)
            throw InputError("The mesh has no boundary with the id " +
                             std::to_string(id) +
                             ", which should touch an obstacle or be held.");
        }
      return triangulation;
    }

    /// A field that is @p value everywhere, zero in multipliers.
    template <int dim>
    Vector
    uniform_field(const Body<dim> &body, const Tensor<1, dim> &value)
    {
      Vector vector;
      body.interpolate(Functions::ConstantFunction<dim>(
                         std::vector<double>(value.begin_raw(),
                                             value.end_raw())),
                       vector);
      return vector;
    }

    template <int dim>
    Vector
    weight_of(const Body<dim>      &body,
              const BodyMatrix     &mass,
              const Tensor<1, dim> &gravity)
    {
      Vector weight = body.make_vector();
      if (gravity != Tensor<1, dim>())
        mass.vmult(weight, uniform_field(body, gravity));
      return weight;
    }

    /// Set the entries of @p result that belong to part @p p to those of @p field.
    void
    copy_part(const unsigned int               p,
              const std::vector<unsigned int> &part_of_unknown,
              const Vector                    &field,
              Vector                          &result)
    {
      // Nodes of parts that touch coincide and move differently.
      for (unsigned int i = 0; i < part_of_unknown.size(); ++i)
        if (part_of_unknown[i] == p)
          local_values(result)[i] = local_values(field)[i];
    }

    template <int dim>
    Vector
    interpolated(
      const Body<dim>                                              &body,
      const std::function<Tensor<1, dim>(const Point<dim> &place)> &function)
    {
      std::vector<std::function<double(const Point<dim> &)>> components;
      for (unsigned int c = 0; c < dim; ++c)
        components.emplace_back([&function, c](const Point<dim> &place) {
          return function(place)[c];
        });
      Vector result;
      body.interpolate(FunctionFromFunctionObjects<dim>(components), result);
      return result;
    }

    /// Blocks are stored where matrix-vector products dominate; the multigrid
    /// of elements of degree one, and that of bodies against bodies, need
    /// entries.
    template <int dim>
    MatrixStorage
    storage_of(const ImpactParameters &parameters,
               const Body<dim>        &body,
               const ImpactSetup<dim> &setup)
    {
      const std::vector<Material<dim>> materials = materials_of(setup);
      const std::vector<Contact>       contacts =
        contacts_of(parameters.contact, setup);
      const bool is_linear = are_linear(materials);
      const bool between_bodies =
        std::any_of(contacts.begin(), contacts.end(), [](const auto &contact) {
          return contact.is_between_bodies();
        });
      const bool multigrid =
        LinearSolver::chooses_multigrid(parameters.linear_solver,
                                        dim,
                                        body.owned_indices().size(),
                                        Utilities::MPI::n_mpi_processes(
                                          body.communicator));
      // Ghosts stand where multipliers would, multigrid's smoothers need entries, and
      // against each other bodies that are not linear are factored for each iteration.
      const bool is_plain = !between_bodies && !body.has_multipliers();
      const bool has_room = !body.has_multipliers() ||
        Utilities::MPI::n_mpi_processes(body.communicator) == 1;
      const bool has_blocks = is_plain ? !multigrid || setup.degree > 1
                                       : !multigrid && is_linear && has_room;
      return has_blocks ? MatrixStorage::blocks : MatrixStorage::entries;
    }

    template <int dim>
    std::unique_ptr<BulkOperator>
    make_bulk(const Body<dim>        &body,
              const ImpactSetup<dim> &setup,
              const std::string      &scheme,
              const MatrixStorage     storage)
    {
      const std::vector<Material<dim>> materials = materials_of(setup);
      // Each cell has a material.
      body.parts_of_unknowns(materials.size());
      auto terms = bulk_of_parts(body, materials, storage);
      // Damping in proportion to the mass.
      std::vector<double> damping = densities_of(setup);
      for (unsigned int p = 0; p < materials.size(); ++p)
        damping[p] *= materials[p].viscosity.mass_damping;
      for (const BoundarySprings<dim> &spring : setup.springs)
        if (spring.damping > 0. && !scheme_traits(scheme).has_rates())
          throw InputError(
            "Dashpots cannot be combined with the time scheme '" + scheme +
            "', whose forces are functions of the displacement.");
      if (!setup.springs.empty() ||
          *std::max_element(damping.begin(), damping.end()) > 0.)
        terms.push_back(std::make_unique<SpringsAndDashpots<dim>>(body,
                                                                  setup.springs,
                                                                  damping));
      if (terms.size() == 1)
        return std::move(terms[0]);
      return std::make_unique<BulkSum>(std::move(terms), body.make_vector());
    }

    template <int dim>
    void
    check_pair(const ImpactParameters &parameters,
               const ImpactSetup<dim> &setup,
               const Contact          &contact)
    {
      const auto materials = materials_of(setup);
      check_pair_combination(contact.parameters,
                             scheme_traits(parameters.scheme.name),
                             {contact.pairs.front().is_self,
                              dim,
                              setup.degree,
                              are_linear(materials),
                              parameters.redistributed_mass()});
    }

    template <int dim>
    std::unique_ptr<ContactOperator>
    make_contact_on_cut_faces(const ImpactParameters     &parameters,
                              const Body<dim>            &body,
                              const ImpactSetup<dim>     &setup,
                              const std::vector<Contact> &contacts)
    {
      const Contact &contact = contacts.back();
      check_pair(parameters, setup, contact);
      std::vector<LinearElastic> materials;
      for (const Material<dim> &material : materials_of(setup))
        {
          AssertThrow(material.linear, ExcInternalError());
          materials.push_back(*material.linear);
        }
      if (contacts.size() > 1)
        throw InputError(
          "Contact/Coupling = cut faces cannot be combined with "
          "rigid obstacles or other contacts.");
      if constexpr (dim == 2)
        return make_cut_face_contact(contact.parameters,
                                     scheme_traits(parameters.scheme.name),
                                     body,
                                     materials,
                                     contact.pairs);
      else
        throw InputError(
          "Contact/Coupling = cut faces is available in 2D only.");
    }

    template <int dim>
    std::unique_ptr<ContactOperator>
    make_one_contact(const ImpactParameters &parameters,
                     const Body<dim>        &body,
                     const ImpactSetup<dim> &setup,
                     const Contact          &contact)
    {
      const SchemeTraits &scheme = scheme_traits(parameters.scheme.name);
      if (contact.is_between_bodies())
        {
          check_pair(parameters, setup, contact);
          return make_pair_contact(contact.parameters,
                                   scheme,
                                   body,
                                   contact.pairs);
        }
      const Material<dim> material = materials_of(setup)[contact.part];
      return make_contact(contact.parameters,
                          scheme,
                          body,
                          material.linear ? LinearStress<dim>(*material.linear)
                                          : LinearStress<dim>(),
                          contact.obstacles);
    }

    /// A node can be held by one constraint of mortar, and by one with multipliers against
    /// obstacles, or with friction in 3D. @throws InputError
    template <int dim>
    void
    check_shared_nodes(const Body<dim>            &body,
                       const std::vector<Contact> &contacts)
    {
      const auto nodes_of = [&](const Contact &contact) {
        IndexSet nodes(body.owned_indices().size());
        for (const auto id : contact_ids(contact))
          nodes.add_indices(body.boundary_displacements(id, 0));
        return nodes;
      };
      for (unsigned int j = 0; j < contacts.size(); ++j)
        for (unsigned int i = 0; i < j; ++i)
          {
            const Contact &a = contacts[i], &b = contacts[j];
            const bool     are_points = a.parameters.coupling == "points" &&
              b.parameters.coupling == "points";
            if (a.is_between_bodies() != b.is_between_bodies() ||
                (a.is_between_bodies() && are_points) ||
                !is_constraint(a.parameters) || !is_constraint(b.parameters))
              continue;
            const bool shared = (nodes_of(a) & nodes_of(b)).n_elements() > 0;
            if (Utilities::MPI::max(shared ? 1 : 0, body.communicator) == 0)
              continue;
            const auto is_simple = [](const Contact &contact) {
              return multipliers_of(contact) == MultiplierSpace::none &&
                (dim < 3 || !has_friction(contact.parameters));
            };
            if (a.is_between_bodies() || !is_simple(a) || !is_simple(b))
              throw InputError(
                "The contacts '" + a.name + "' and '" + b.name +
                "' are constraints on the same nodes. " +
                (a.is_between_bodies()
                   ? "Take Contact/Coupling = points, name all surfaces in one "
                     "contact, make another surface the first one of it, or take "
                     "a law for one of them: "
                   : "Several obstacles can hold a node by active sets, in 3D "
                     "without friction. Make one of them a held body, or take a "
                     "law for one of them: ") +
                names_of_laws() + ".");
          }
    }

    template <int dim>
    std::unique_ptr<ContactOperator>
    make_any_contact(const ImpactParameters     &parameters,
                     const Body<dim>            &body,
                     const ImpactSetup<dim>     &setup,
                     const std::vector<Contact> &contacts)
    {
      if (contacts.empty())
        return make_one_contact(parameters,
                                body,
                                setup,
                                {"", parameters.contact});
      if (contacts.back().is_between_bodies() &&
          contacts.back().parameters.coupling == "cut faces")
        return make_contact_on_cut_faces(parameters, body, setup, contacts);
      check_shared_nodes(body, contacts);
      std::vector<std::unique_ptr<ContactOperator>> operators;
      for (const Contact &contact : contacts)
        try
          {
            operators.push_back(
              make_one_contact(parameters, body, setup, contact));
          }
        catch (const InputError &error)
          {
            // Number of the named one.
            if (contact.name.empty())
              throw;
            throw InputError("Contact " + contact.name + ": " + error.what());
          }
      if (operators.size() == 1)
        return std::move(operators.front());
      return std::make_unique<ContactSum>(std::move(operators));
    }

    /// The pressures of @p setup that follow the surface; null without.
    template <int dim>
    std::unique_ptr<FollowerLoad>
    make_follower(const Body<dim>        &body,
                  const BulkOperator     &bulk,
                  const ImpactSetup<dim> &setup,
                  const std::string      &scheme)
    {
      if (setup.pressures.empty())
        return nullptr;
      if (scheme_traits(scheme).needs_potential)
        throw InputError(
          "A pressure that follows the surface cannot be combined with the time "
          "scheme '" +
          scheme +
          "', which takes forces from a potential.\nAllowed with it: " +
          names_of_schemes(
            [](const SchemeTraits &s) { return !s.needs_potential; }) +
          ".");
      if (bulk.is_linear())
        throw InputError(
          "A pressure that follows the surface is for large strains; a linear "
          "elastic body does not know where its surface is. Take a traction, or "
          "Saint Venant-Kirchhoff instead of linear elastic.");
      if constexpr (dim > 1)
        return std::make_unique<FollowerPressure<dim>>(body, setup.pressures);
      else
        throw InputError("In 1D pressures are loads.");
    }

    /// All external loads of @p setup (N).
    template <int dim>
    SemiDiscreteSystem::Load
    make_load(const Body<dim>        &body,
              const BodyMatrix       &mass,
              const Vector           &weight,
              const ImpactSetup<dim> &setup)
    {
      std::vector<SemiDiscreteSystem::Load> terms;
      if (setup.load)
        terms.push_back(setup.load);
      for (const auto &[id, traction] : setup.tractions)
        terms.push_back(boundary_load(body, id, traction));
      for (const ResultantLoad<dim> &load : setup.resultants)
        terms.push_back(resultant_load(body, load));
      const bool any = std::any_of(setup.parts.begin(),
                                   setup.parts.end(),
                                   [](const Part<dim> &part) {
                                     return bool(part.acceleration);
                                   });
      if (any)
        terms.push_back([&body,
                         &mass,
                         parts   = setup.parts,
                         part_of = body.parts_of_unknowns(setup.parts.size()),
                         time_known = std::numeric_limits<double>::quiet_NaN(),
                         known      = body.make_vector()](const double time,
                                                     Vector &result) mutable {
          if (time != time_known)
            {
              Vector field = body.make_vector();
              for (unsigned int p = 0; p < parts.size(); ++p)
                if (parts[p].acceleration)
                  copy_part(p,
                            part_of,
                            interpolated<dim>(
                              body,
                              [&](const Point<dim> &place) {
                                return parts[p].acceleration(time, place);
                              }),
                            field);
              mass.vmult(known, field);
              time_known = time;
            }
          result += known;
        });
      if (setup.gravity != Tensor<1, dim>())
        terms.push_back(
          [&weight](const double, Vector &result) { result += weight; });
      if (terms.empty())
        return {};
      return [terms](const double time, Vector &result) {
        for (const SemiDiscreteSystem::Load &term : terms)
          term(time, result);
      };
    }
  } // namespace



  template <int dim>
  Impact<dim>::Impact(const ImpactParameters   &parameters,
                      const Triangulation<dim> &triangulation,
                      const ImpactSetup<dim>   &setup,
                      const MPI_Comm            communicator)
    : contacts(contacts_with_sets(parameters.contact,
                                  setup,
                                  triangulation,
                                  communicator))
    , body(with_boundaries(triangulation, named_ids(setup), communicator),
           setup.degree,
           setup.clamped,
           contact_ids(contacts),
           multipliers_of(contacts, setup.degree),
           communicator,
           held_components(setup),
           setup.geometry.get(),
           multiplier_sets(contacts),
           setup.vertices)
    , bulk(make_bulk(body,
                     setup,
                     parameters.scheme.name,
                     storage_of(parameters, body, setup)))
    , consistent_mass(
        assemble_mass_matrix(body,
                             densities_of(setup),
                             parameters.redistributed_mass()
                               ? MatrixStorage::entries
                               : storage_of(parameters, body, setup)))
    , redistributed_mass(
        parameters.redistributed_mass()
          ? std::make_unique<BodyMatrix>(
              redistribute_mass(body, *consistent_mass.entries()))
          : nullptr)
    , overlap_problem(set_overlaps(body, contacts))
    , obstacles(obstacles_of(contacts))
    , parts(setup.parts)
    , contact(make_any_contact(parameters, body, setup, contacts))
    , weight(weight_of(body, consistent_mass, setup.gravity))
    , prescriptions(make_prescriptions(body, setup))
    , follower(make_follower(body, *bulk, setup, parameters.scheme.name))
    , system(redistributed_mass ? *redistributed_mass : consistent_mass,
             consistent_mass,
             *bulk,
             *contact,
             {parameters.redistributed_mass()
                ? body.contact_indices()
                : IndexSet(body.contact_indices().size()),
              &body.constraints(),
              body.multiplier_indices(),
              dim,
              [this]() -> const TrilinosWrappers::SparsityPattern & {
                return body.sparsity_pattern();
              },
              [this]() { return body.canonical_positions(); },
              [this]() { return body.mesh_checksum(); },
              [this]() {
                // Where contact couples other unknowns in each step.
                return body.coarse_space(contact->couplings() != nullptr);
              },
              is_moved(setup) || setup.starts_displaced
                ? [this](const double time,
                         Vector      &vector) { impose(time, vector); }
                : std::function<void(const double, Vector &)>(),
              [this, step = 1e-3 * parameters.time.time_step](const double time,
                                                              Vector &vector) {
                impose_rate(time, step, vector);
              },
              scheme_traits(parameters.scheme.name).has_inertia
                ? SemiDiscreteSystem::Unknowns::Unheld()
                : find_unheld_bodies(body, setup),
              names_of(contacts)},
             make_load(body, consistent_mass, weight, setup),
             parameters.newton,
             parameters.linear_solver,
             follower.get())
    , scheme(make_time_scheme(parameters.scheme))
    , has_inertia(scheme_traits(parameters.scheme.name).has_inertia)
  {
    const SchemeTraits traits = scheme_traits(parameters.scheme.name);
    for (const Contact &one : contacts)
      check_motions(traits, one.obstacles);
    // With inertia of nodes that follow a motion, the work of a reaction at instants is
    // not known.
    const auto knows_imposed_work = [](const SchemeTraits &one) {
      return one.contact_over_step || !one.has_inertia;
    };
    if (is_moved(setup) && !knows_imposed_work(traits))
      throw InputError(
        "An imposed displacement cannot be combined with the time "
        "scheme '" +
        parameters.scheme.name +
        "', which does not know the work of its reaction.\nAllowed with it: " +
        names_of_schemes(knows_imposed_work) + ".");
  }



  template <int dim>
  void
  Impact<dim>::impose(const double time, Vector &vector) const
  {
    for (const Prescription &prescription : prescriptions)
      vector(prescription.unknown) = prescription.value
        ? prescription.value(time, prescription.place)[prescription.component]
        : start_displacement.size() > 0
        ? start_displacement(prescription.unknown)
        : 0.;
    vector.compress(VectorOperation::insert);
  }



  template <int dim>
  void
  Impact<dim>::impose_rate(const double time,
                           const double step,
                           Vector      &vector) const
  {
    // A motion need not be known before it begins.
    for (const Prescription &prescription : prescriptions)
      {
        const auto value = [&](const double t) {
          return prescription.value(t,
                                    prescription.place)[prescription.component];
        };
        vector(prescription.unknown) = prescription.value
          ? (-1.5 * value(time) + 2. * value(time + step) -
             .5 * value(time + 2. * step)) /
            step
          : 0.;
      }
    vector.compress(VectorOperation::insert);
  }


  template <int dim>
  Vector
  Impact<dim>::uniform(const Tensor<1, dim> &value) const
  {
    return uniform_field(body, value);
  }



  template <int dim>
  State
  Impact<dim>::state_in_flight(const Tensor<1, dim> &velocity)
  {
    return state_in_motion(Functions::ConstantFunction<dim>(
      std::vector<double>(velocity.begin_raw(), velocity.end_raw())));
  }



  template <int dim>
  State
  Impact<dim>::state_in_motion(const Function<dim> &velocity)
  {
    Vector start;
    body.interpolate(velocity, start);
    return state_with(uniform(Tensor<1, dim>()), start);
  }



  template <int dim>
  State
  Impact<dim>::state_of_parts()
  {
    return state_with(uniform(Tensor<1, dim>()), velocities_of_parts());
  }



  template <int dim>
  State
  Impact<dim>::state_from(const CheckpointMotion &motion)
  {
    start_displacement = motion.solution;
    for (const Prescription &one : prescriptions)
      if (one.value)
        {
          const double there = start_displacement(one.unknown),
                       here  = one.value(0., one.place)[one.component];
          if (std::abs(there - here) >
              1e-6 * std::max(std::abs(there), std::abs(here)))
            throw InputError(
              "A displacement that a condition imposes is " + to_text(here) +
              " at t = 0, and " + to_text(there) +
              " in the state from which this run starts, in the direction " +
              std::string(1, "xyz"[one.component]) +
              ". Begin its Value with the latter.");
        }
    Vector velocity = velocities_of_parts();
    velocity += motion.velocity;
    // The force of a law follows from the displacement; that of a condition is the one of
    // the contact with its name, of the same boundary where it has several.
    std::vector<Vector>   forces(contacts.size());
    std::set<std::size_t> taken;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      if (is_constraint(contacts[k].parameters))
        for (std::size_t there = 0; there < motion.contact_forces.size();
             ++there)
          if (motion.contact_names.at(there) == contacts[k].name &&
              taken.insert(there).second)
            {
              forces[k] = motion.contact_forces[there];
              break;
            }
    const State state = state_with(motion.solution, velocity, forces);
    check_new_contacts(state, motion.contact_names);
    return state;
  }



  template <int dim>
  void
  Impact<dim>::check_new_contacts(
    const State                    &state,
    const std::vector<std::string> &contacts_before) const
  {
    const auto summaries = system.contact.summary(
      {state.solution, state.contact_force, state.time, &state.contact_shares});
    const double cell_size =
      Utilities::MPI::min(GridTools::minimal_cell_diameter(
                            body.dof_handler().get_triangulation()),
                          body.communicator);
    for (unsigned int k = 0; k < contacts.size(); ++k)
      if (std::find(contacts_before.begin(),
                    contacts_before.end(),
                    contacts[k].name) == contacts_before.end())
        for (const auto id : contact_ids(contacts[k]))
          if (const auto found = summaries.find(
                contacts.size() == 1 ? id : ContactSum::id_of(k, id));
              found != summaries.end() &&
              found->second.max_penetration > 1e-6 * cell_size)
            throw InputError(
              "The contact '" + contacts[k].name +
              "' begins here, and its surfaces overlap by " +
              to_text(found->second.max_penetration) +
              " in the state from which this run starts. Move them "
              "apart before.");
  }



  template <int dim>
  Vector
  Impact<dim>::velocities_of_parts() const
  {
    const std::vector<unsigned int> part_of =
      body.parts_of_unknowns(parts.size());
    Vector start = body.make_vector();
    // Velocities without spin in one go, however many parts there are.
    for (unsigned int c = 0; c < dim; ++c)
      {
        Tensor<1, dim> direction;
        direction[c]      = 1.;
        const Vector unit = uniform(direction);
        for (unsigned int k = 0; k < part_of.size(); ++k)
          if (part_of[k] < parts.size())
            local_values(start)[k] +=
              parts[part_of[k]].velocity[c] * local_values(unit)[k];
      }
    for (unsigned int p = 0; p < parts.size(); ++p)
      {
        const Part<dim> &part = parts[p];
        if (part.spin == Tensor<1, 3>())
          continue;
        copy_part(p,
                  part_of,
                  interpolated<dim>(body,
                                    [&](const Point<dim> &place) {
                                      Tensor<1, dim>     result = part.velocity;
                                      const Tensor<1, 3> turning =
                                        cross_product_3d(part.spin,
                                                         in_space<dim>(place) -
                                                           in_space<dim>(
                                                             part.centre));
                                      for (unsigned int c = 0; c < dim; ++c)
                                        result[c] += turning[c];
                                      return result;
                                    }),
                  start);
      }
    return start;
  }



  template <int dim>
  State
  Impact<dim>::state_with(const Vector              &displacement,
                          const Vector              &velocity,
                          const std::vector<Vector> &contact_forces)
  {
    // With displacements the contacts themselves know, see check_new_contacts().
    if (start_displacement.size() == 0)
      {
        if (!overlap_problem.empty())
          throw InputError(overlap_problem);
        for (const Contact &own : contacts)
          check_clearance(body,
                          own.obstacles,
                          own.name,
                          /* only what may touch */ !own.name.empty());
      }
    if (has_inertia)
      return system.initial_state(displacement,
                                  velocity,
                                  /* time */ 0.,
                                  contact_forces);
    if (velocity.linfty_norm() > 0.)
      throw InputError(
        "A body with a velocity at the start cannot be combined with a "
        "static analysis, in which nothing has inertia.");
    State state         = system.initial_state(displacement,
                                       velocity,
                                       /* time */ 0.,
                                       contact_forces);
    state.velocity      = 0.;
    state.acceleration  = 0.;
    state.mean_velocity = 0.;
    return state;
  }



  template <int dim>
  Obstacles
  foundation_below(const types::boundary_id boundary_id)
  {
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    return {{boundary_id, half_space_at_rest<dim>(Point<dim>(), up)}};
  }


  template struct Impact<1>;
  template struct Impact<2>;
  template struct Impact<3>;
  template Obstacles
  foundation_below<2>(const types::boundary_id);
  template Obstacles
  foundation_below<3>(const types::boundary_id);
} // namespace Ricochet
