// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/expressions.h>
#include <base/files.h>
#include <base/units.h>
#include <base/unknown_name.h>
#include <problems/clearance.h>
#include <problems/impact.h>
#include <scene/scene.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>


namespace Ricochet
{
  using namespace dealii;

  unsigned int
  dimension_of(const ParameterText &text)
  {
    const ParameterText::Assignment *found = text.find("Dimension");
    // Without any section there is nothing to compute, but parameters can be printed.
    if (!found && text.sections.empty())
      return 2;
    if (!found)
      throw InputError(
        "The parameter file has to say 'set Dimension = 2' or 'set "
        "Dimension = 3'.");
    if (found->value != "2" && found->value != "3")
      throw InputError(found->where + ": Dimension is 2 or 3, not '" +
                       found->value.substr(0, 100) + "'.");
    return found->value == "2" ? 2 : 3;
  }



  template <int dim>
  Scene<dim>::Scene(const ParameterText &text)
  {
    impact.time.final_time   = 1.;
    impact.time.time_step    = 1e-2;
    impact.time.fields_every = 5;
    impact.scheme.name       = "midpoint";

    // Phases have been taken apart by run_program().
    std::vector<NamedSection> sections = find_named_sections(
      text,
      {"Body", "Material", "Obstacle", "Contact", "Condition", "Probe"},
      {"Time", "Output", "Newton", "Linear solver", "Limits", "Mesh", "Start"});
    // To print parameters, one of each kind.
    if (text.sections.empty())
      for (const std::string kind :
           {"Body", "Material", "Obstacle", "Contact", "Condition", "Probe"})
        sections.push_back({kind, "NAME", "no file"});
    for (const NamedSection &section : sections)
      if (section.kind == "Body")
        bodies.emplace_back(section);
      else if (section.kind == "Material")
        {
          materials.emplace_back(section, default_material());
          materials.back().second.section = section.full_name();
        }
      else if (section.kind == "Obstacle")
        {
          obstacles.emplace_back(section, ObstacleParameters<dim>());
          obstacles.back().second.section = section.full_name();
        }
      else if (section.kind == "Contact")
        contacts.emplace_back(section);
      else if (section.kind == "Condition")
        conditions.emplace_back(section);
      else
        probes.emplace_back(section);
    for (const auto &obstacle : obstacles)
      for (const BodySection<dim> &body : bodies)
        if (obstacle.first.name == body.section.name &&
            body.section.name != "NAME")
          throw InputError(obstacle.first.where + ": a body is called '" +
                           body.section.name +
                           "', too; contacts could not tell them apart.");
  }



  template <int dim>
  void
  Scene<dim>::add_parameters(ParameterHandler &parameters)
  {
    handler = &parameters;
    parameters.declare_entry("Dimension",
                             std::to_string(dim),
                             Patterns::Selection("2|3"),
                             "Number of space dimensions: 2 or 3.");
    parameters.add_parameter(
      "Units",
      units_text,
      "Units of length, mass and time of all numbers in this file. Any three will "
      "do, since nothing is converted; the energy table is headed by them. "
      "What is said of units here and in messages means the ones of the SI, and "
      "stands for yours.",
      Patterns::Anything());
    impact.add_parameters_without_contact(parameters);

    parameters.enter_subsection("Mesh");
    parameters.add_parameter(
      "Degree",
      degree,
      "Polynomial degree of the displacement, of all bodies; 2 not with mortar and cut "
      "faces.",
      Patterns::Integer(1, 2));
    parameters.leave_subsection();
    parameters.enter_subsection("Start");
    parameters.add_parameter("Gravity",
                             gravity,
                             "Acceleration of gravity (m/s^2).");
    parameters.add_parameter(
      "From",
      start_from,
      "Output folder of another run of the same bodies, at whose last checkpoint this one "
      "starts: with its displacements and velocities, to which those of the bodies are "
      "added. Time begins at 0. What is fixed stays where it is there. Empty: "
      "without displacement.",
      Patterns::Anything());
    parameters.add_parameter(
      "Advance",
      advance,
      "How long the bodies have flown already, each with its velocity alone (s): "
      "shifts where within a step an impact falls.");
    parameters.leave_subsection();
    parameters.enter_subsection("Limits");
    parameters.add_parameter(
      "Meshing time",
      meshing_time,
      "How long Gmsh, or a generator of deal.II, may make the "
      "mesh of a body (s); 0 for any time.",
      Patterns::Integer(0, 1000000));
    parameters.leave_subsection();

    for (auto &body : bodies)
      body.add_parameters(parameters);
    for (auto &material : materials)
      material.second.add_parameters(parameters);
    for (auto &obstacle : obstacles)
      obstacle.second.add_parameters(parameters);
    for (auto &contact : contacts)
      contact.add_parameters(parameters);
    for (auto &condition : conditions)
      condition.add_parameters(parameters);
    for (auto &probe : probes)
      probe.add_parameters(parameters);
  }



  template <int dim>
  std::vector<UnusedParameter>
  Scene<dim>::unused_parameters() const
  {
    std::vector<UnusedParameter> unused = impact.scheme.unused_parameters();
    const auto add = [&](const std::vector<UnusedParameter> &more) {
      unused.insert(unused.end(), more.begin(), more.end());
    };
    for (const auto &body : bodies)
      add(body.unused_parameters());
    for (const auto &material : materials)
      add(material.second.unused_parameters());
    for (const auto &obstacle : obstacles)
      add(obstacle.second.unused_parameters());
    for (const auto &contact : contacts)
      add(contact.parameters.unused_parameters());
    for (const auto &condition : conditions)
      add(condition.unused_parameters());
    return unused;
  }



  // ### The sections together
  template <int dim>
  void
  Scene<dim>::check(const ContactSection &contact,
                    const Touching       &touching,
                    const bool            redistributed_mass) const
  {
    bool          is_linear      = true;
    VelocityForce velocity_force = VelocityForce::none;
    for (const PartOfScene &part : parts)
      {
        is_linear = is_linear && part.material.is_linear();
        velocity_force =
          std::max(velocity_force, part.material.velocity_force());
      }
    const SchemeTraits scheme = scheme_traits(impact.scheme.name);
    if (const auto interference = contact.make_interference())
      {
        const auto refuse = [](const std::string &why) {
          throw InputError("Interference " + why);
        };
        if (!touching.obstacles.empty() || touching.is_self)
          refuse("works between bodies only; an obstacle can be made larger.");
        if (contact.parameters.coupling != "points")
          refuse("needs Coupling = points.");
        const auto names = names_in(contact.interference);
        const bool is_constant =
          std::find(names.begin(), names.end(), "t") == names.end();
        if (scheme.has_inertia && !is_constant)
          refuse(
            "that depends on t needs Time/Scheme = static: in motion its work is not "
            "known.");
        if (scheme.has_inertia && start_from.empty() && interference(0.) != 0.)
          refuse(
            "of " + to_text(interference(0.)) +
            " at the start would be a penetration; let a static phase raise it from 0.");
      }
    check_combination(contact.parameters,
                      scheme,
                      redistributed_mass,
                      is_linear,
                      velocity_force,
                      degree);
    for (const unsigned int k : touching.obstacles)
      check_motions(scheme,
                    {{0, obstacles[k].second.make(impact.time.final_time)}});
    if (touching.obstacles.empty())
      check_pair_combination(
        contact.parameters,
        scheme,
        {touching.is_self, dim, degree, is_linear, redistributed_mass});
  }



  template <int dim>
  void
  Scene<dim>::validate()
  {
    if (bodies.empty() || bodies.front().section.where == "no file")
      throw InputError(
        "There is no body: the parameter file needs a section "
        "'subsection Body NAME'.");
    Units{units_text};
    impact.time.validate();
    for (const BodySection<dim> &body : bodies)
      if (!body.acceleration.empty())
        parse_vector_field<dim>(body.acceleration,
                                body.name_of("Acceleration"));
    for (const BodySection<dim> &body : bodies)
      if (!scheme_traits(impact.scheme.name).has_inertia &&
          (body.velocity.norm() > 0. || body.spin.norm() > 0.))
        throw InputError(
          body.section.where + ": the body '" + body.section.name +
          "' has a velocity at the start, which has no meaning with the "
          "time scheme " +
          impact.scheme.name + ", in which nothing has inertia.");
    make_meshes();
    for (const PartOfScene &part : parts)
      part.material.validate(dim, impact.scheme.name);

    find_missing_values();
    for (const ContactSection &contact : contacts)
      {
        const Touching touching = find_touching(contact);
        try
          {
            check(contact, touching, impact.redistributed_mass());
          }
        catch (const InputError &error)
          {
            // Number of the named one.
            throw InputError(contact.section.where + ", " +
                               contact.section.full_name() + ": " +
                               error.what(),
                             error.details);
          }
        if (!touching.obstacles.empty() && uses_stress(contact.parameters))
          for (const auto &surface : touching.slave)
            if (parts_at(surface).size() > 1)
              throw InputError(contact.section.where + ": the treatment '" +
                               contact.parameters.treatment +
                               "' takes the stress at the surface, which must "
                               "be of one material.");
      }
    ImpactSetup<dim> setup{parts.front().material.template make<dim>()};
    for (const ConditionSection<dim> &condition : conditions)
      condition.add_to(surfaces, first_part, setup);
    for (const ProbeSection<dim> &probe : probes)
      probe.find_body(surfaces);
  }



  template <int dim>
  std::uint32_t
  Scene<dim>::checksum_of_bodies() const
  {
    std::uint32_t result = 0;
    for (const auto &mesh : meshes)
      for (const auto &cell : mesh->cells.active_cell_iterators())
        {
          std::ostringstream bytes;
          const auto         put = [&](const auto &value) {
            bytes.write(reinterpret_cast<const char *>(&value), sizeof(value));
          };
          put(cell->material_id());
          for (const unsigned int v : cell->vertex_indices())
            for (unsigned int c = 0; c < dim; ++c)
              put(cell->vertex(v)[c]);
          for (const auto &face : cell->face_iterators())
            put(face->boundary_id());
          result = checksum(bytes.str(), result);
        }
    return result;
  }



  template <int dim>
  void
  Scene<dim>::make_meshes()
  {
    meshes.clear();
    parts.clear();
    first_part = {0};
    centres.clear();
    surfaces          = SurfaceNames();
    double n_unknowns = 0.;
    bool   is_simplex = false, is_curved = false;
    for (unsigned int b = 0; b < bodies.size(); ++b)
      {
        meshes.push_back(std::make_unique<BodyMesh<dim>>());
        BodyMesh<dim> &mesh = *meshes.back();
        // A mesh that is much too large is refused here, before it is made.
        impact.check_size(dim * bodies[b].vertices_at_least(), dim);
        bodies[b].meshing_time = meshing_time;
        bodies[b].make_mesh(mesh, advance, kept_meshes);
        const bool simplex = mesh.cells.all_reference_cells_are_simplex();
        if (b > 0 && simplex != is_simplex)
          {
            const auto kind = [](const bool of_simplices) {
              return std::string(
                of_simplices ? (dim == 2 ? "triangles" : "tetrahedra")
                             : (dim == 2 ? "quadrilaterals" : "hexahedra"));
            };
            throw InputError(
              "The body '" + bodies[0].section.name + "' is of " +
              kind(is_simplex) + ", the body '" + bodies[b].section.name +
              "' of " + kind(simplex) +
              "; all need the same. Of shapes, Cells chooses; of files, cells are "
              "what they are: 'Recombine Surface {...};' in a .geo makes "
              "quadrilaterals.");
          }
        is_simplex        = simplex;
        const bool curved = !mesh.nodes.empty();
        if (b > 0 && curved != is_curved)
          throw InputError("The bodies '" + bodies[0].section.name + "' and '" +
                           bodies[b].section.name +
                           "' have elements of different order; all need the "
                           "same.");
        is_curved = curved;
        if (is_curved && degree == 1)
          throw InputError("The body '" + bodies[b].section.name +
                           "' has curved cells, which take Mesh/Degree = 2.");
        n_unknowns += dim * static_cast<double>(mesh.cells.n_used_vertices()) *
          (degree == 1 ? 1. : std::pow(2., dim));

        // Numbers of the boundaries are those of the scene from here on.
        std::set<types::boundary_id> own_ids;
        for (const auto &boundary : mesh.boundaries)
          own_ids.insert(boundary.first);
        const auto id = surfaces.add_body(bodies[b].section.name,
                                          own_ids,
                                          mesh.boundary_names);
        for (const auto &cell : mesh.cells.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              face->set_boundary_id(id.at(face->boundary_id()));
        decltype(mesh.boundaries) boundaries;
        for (const auto &[own, boundary] : mesh.boundaries)
          boundaries[id.at(own)] = boundary;
        mesh.boundaries = boundaries;
        make_parts(b);
      }
    impact.check_size(n_unknowns, dim);
  }



  template <int dim>
  const MaterialParameters &
  Scene<dim>::find_material(const std::string &name,
                            const std::string &where) const
  {
    std::vector<std::string> names;
    for (const auto &material : materials)
      {
        if (material.first.name == name)
          return material.second;
        names.push_back(material.first.name);
      }
    throw unknown_name(where + ": there is no section 'Material " +
                         name.substr(0, 100) + "'",
                       name,
                       names);
  }



  template <int dim>
  void
  Scene<dim>::make_parts(const unsigned int b)
  {
    const BodySection<dim> &body  = bodies[b];
    const BodyMesh<dim>    &mesh  = *meshes[b];
    const auto              named = body.named_materials(mesh);
    const auto              material_of =
      [&](const std::string &name) -> const MaterialParameters & {
      if (!name.empty())
        return find_material(name, body.name_of("Materials"));
      return body.material_name.empty()
        ? body.material
        : find_material(body.material_name, body.name_of("Material"));
    };
    // Cells of the body's own material come first, then the others by their names.
    std::map<std::string, double> measures;
    double                        mass = 0.;
    Tensor<1, dim>                moment;
    for (const auto &[id, share] : mesh.shares)
      {
        const auto        own  = named.find(id);
        const std::string name = own == named.end() ? "" : own->second;
        measures[name] += share.measure;
        const double density = material_of(name).density;
        mass += density * share.measure;
        moment += density * share.moment;
      }
    centres.emplace_back(moment / mass);
    std::map<std::string, unsigned int> part;
    for (const auto &[name, measure] : measures)
      {
        part[name] = parts.size();
        parts.push_back(
          {body.section.column_name() + (name.empty() ? "" : "_" + name),
           b,
           material_of(name),
           measure});
        std::replace(parts.back().name.begin(),
                     parts.back().name.end(),
                     ' ',
                     '_');
      }
    first_part.push_back(parts.size());
    for (const auto &cell : mesh.cells.active_cell_iterators())
      {
        const auto own = named.find(cell->material_id());
        cell->set_material_id(part.at(own == named.end() ? "" : own->second));
      }
  }



  template <int dim>
  std::set<unsigned int>
  Scene<dim>::parts_at(const SurfaceNames::Surface &surface) const
  {
    std::set<unsigned int> list;
    for (const auto &cell : meshes[surface.body]->cells.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary() && surface.ids.count(face->boundary_id()) > 0)
          list.insert(cell->material_id());
    return list;
  }



  template <int dim>
  typename Scene<dim>::Touching
  Scene<dim>::find_touching(const ContactSection &contact) const
  {
    Touching touching;
    touching.slave = surfaces.find(contact.surface, contact.name_of("Surface"));
    if (Utilities::trim(contact.against) == "itself")
      {
        touching.is_self = true;
        return touching;
      }
    std::vector<std::string> names    = surfaces.body_names();
    unsigned int             n_bodies = 0;
    const auto items = Utilities::split_string_list(contact.against, ';');
    for (const std::string &item : items)
      {
        const std::string name =
          Utilities::trim(item.substr(0, item.find(':')));
        bool known = surfaces.find_body(name) < surfaces.n_bodies();
        n_bodies += known;
        for (unsigned int i = 0; i < obstacles.size(); ++i)
          if (obstacles[i].first.name == item)
            {
              if (std::count(touching.obstacles.begin(),
                             touching.obstacles.end(),
                             i) > 0)
                throw InputError(contact.name_of("Against") +
                                 " names the obstacle '" + item + "' twice.");
              touching.obstacles.push_back(i);
              known = true;
            }
        if (!known)
          {
            for (const auto &obstacle : obstacles)
              names.push_back(obstacle.first.name);
            throw unknown_name(contact.name_of("Against") +
                                 ": there is neither a body nor an obstacle '" +
                                 name.substr(0, 100) + "'",
                               name,
                               names);
          }
      }
    if (items.empty())
      throw InputError(contact.section.where + ": " +
                       contact.name_of("Against") +
                       " has to say what the surface may touch: obstacles, "
                       "bodies, or 'itself'.");
    if (n_bodies > 0 && !touching.obstacles.empty())
      throw InputError(contact.name_of("Against") +
                       " names bodies and obstacles; make a contact for each.");
    if (n_bodies > 0)
      for (const auto &surface :
           surfaces.find(contact.against, contact.name_of("Against")))
        {
          touching.master.insert(surface.ids.begin(), surface.ids.end());
          for (const auto &slave : touching.slave)
            for (const auto id : slave.ids)
              if (surface.ids.count(id) > 0)
                throw InputError(
                  contact.section.where +
                  ": the contact is between a surface and the same surface; "
                  "for that say 'itself'.");
        }
    return touching;
  }



  namespace
  {
    /// Sums over the faces of a surface.
    struct CellSizes
    {
      double       diameters = 0.;
      double       depths    = 0.; // see Scales
      unsigned int n         = 0;
    };

    /// Add those of the faces of @p mesh with @p ids.
    template <int dim>
    void
    add_sizes(const Triangulation<dim>           &mesh,
              const std::set<types::boundary_id> &ids,
              CellSizes                          &sizes)
    {
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && ids.count(face->boundary_id()) > 0)
            {
              // Simplices narrow from the face on.
              const double depth = cell->measure() / face->measure() *
                (cell->reference_cell().is_simplex() ? dim : 1);
              sizes.diameters += cell->diameter();
              sizes.depths +=
                std::min(cell->diameter(),
                         2. * std::sqrt(static_cast<double>(dim)) * depth);
              ++sizes.n;
            }
    }
  } // namespace



  template <int dim>
  void
  Scene<dim>::find_missing_values()
  {
    for (ContactSection &contact : contacts)
      {
        // The softest of the bodies that take part.
        const Touching         touching = find_touching(contact);
        std::set<unsigned int> partners;
        const auto             add_partners = [&](const auto &surface) {
          const auto own = parts_at(surface);
          partners.insert(own.begin(), own.end());
        };
        CellSizes sizes;
        for (const auto &surface : touching.slave)
          {
            add_partners(surface);
            add_sizes(meshes[surface.body]->cells, surface.ids, sizes);
          }
        const double diameter = sizes.diameters / sizes.n;
        const double depth    = sizes.depths / sizes.n;
        if (touching.obstacles.empty() && !touching.is_self)
          for (const auto &surface :
               surfaces.find(contact.against, contact.name_of("Against")))
            add_partners(surface);
        // Without a finite modulus no default by scale is finite.
        constexpr double largest = std::numeric_limits<double>::max();
        Scales           scales{largest, largest, 0., diameter, depth, degree};
        for (const unsigned int p : partners)
          {
            const Scales own =
              parts[p].material.scales(diameter, degree, depth);
            if (own.young_modulus < scales.young_modulus)
              scales = own;
          }
        contact.parameters.set_missing(scales);
        for (const auto &[name, value] : contact.parameters.used_values())
          if (!std::isfinite(value))
            throw InputError(contact.name_of(name) +
                             " cannot be found from moduli, density and mesh "
                             "size of the bodies, which are too large or too "
                             "small; it would be " +
                             to_text(value) + ".");
      }
  }



  template class Scene<2>;
  template class Scene<3>;
} // namespace Ricochet
