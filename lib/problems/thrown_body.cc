// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/contact_sum.h>
#include <problems/impact_loop.h>
#include <problems/thrown_body.h>

#include <deal.II/base/function.h>

namespace Ricochet
{
  using namespace dealii;

  void
  ThrownBodyParameters::add_parameters(ParameterHandler &parameters)
  {
    impact.add_parameters(parameters);
    material.add_parameters(parameters);
    parameters.enter_subsection("Mesh");
    parameters.add_parameter("Cells",
                             cell_shape,
                             "Shape of the cells.",
                             Patterns::Selection("triangles|quadrilaterals"));
    parameters.add_parameter("Degree",
                             degree,
                             "Polynomial degree of the displacement.",
                             Patterns::Integer(1, 2));
    parameters.leave_subsection();

    parameters.enter_subsection("Start");
    parameters.add_parameter(
      "Initial gap",
      initial_gap,
      "Distance of the lowest point from the foundation at the start (m). Free "
      "flight is exact in every scheme; a small gap saves it. Where within a "
      "step the impact falls changes what happens at the impact.",
      Patterns::Double(0.));
    parameters.add_parameter("Initial velocity",
                             initial_velocity,
                             "Velocity of the whole body at the start (m/s).");
    parameters.leave_subsection();
  }



  void
  ThrownBodyParameters::validate() const
  {
    material.validate(2, impact.scheme.name);
    impact.validate(material.is_linear(), material.velocity_force());
  }



  std::vector<UnusedParameter>
  ThrownBodyParameters::unused_parameters() const
  {
    std::vector<UnusedParameter> unused = impact.unused_parameters();
    const auto                   own    = material.unused_parameters();
    unused.insert(unused.end(), own.begin(), own.end());
    return unused;
  }



  void
  add_momentum_columns(const Momenta<2> &momenta,
                       const Body<2>    &body,
                       TimeLoop         &loop)
  {
    Vector vertical;
    body.interpolate(Functions::ConstantFunction<2>(
                       std::vector<double>{0., 1.}),
                     vertical);
    const double total_mass = momenta.linear(vertical)[1];
    loop.rebounds.push_back({"foundation", {{"", total_mass}}});
    loop.add_column("momentum_x", "kg m/s", [&momenta](const State &state) {
      return momenta.linear(state.velocity)[0];
    });
    loop.add_column("momentum_y", "kg m/s", [&momenta](const State &state) {
      return momenta.linear(state.velocity)[1];
    });
    loop.add_column("angular_momentum",
                    "kg m^2/s",
                    [&momenta](const State &state) {
                      return momenta.angular(state.solution, state.velocity)[2];
                    });
    loop.add_column("centre_displacement_y",
                    "m",
                    [&momenta, total_mass](const State &state) {
                      return momenta.linear(state.solution)[1] / total_mass;
                    });
  }



  void
  throw_body(const ThrownBodyParameters                      &parameters,
             const Triangulation<2>                          &triangulation,
             const types::boundary_id                         outer_boundary,
             RunFolder                                       &folder,
             const std::map<types::boundary_id, std::string> &self_contact)
  {
    const ImpactParameters &impact = parameters.impact;

    // Mesh and data make the equation of motion: mass, bulk, contact, scheme.
    const Material<2> material = parameters.material.make<2>();
    ImpactSetup<2>    setup{material};
    setup.density   = parameters.material.density;
    setup.degree    = parameters.degree;
    setup.obstacles = foundation_below<2>(outer_boundary);
    std::map<types::boundary_id, std::string> contacts = {
      {outer_boundary, "foundation"}};
    if (!self_contact.empty())
      {
        std::set<types::boundary_id> ids;
        for (const auto &[id, name] : self_contact)
          {
            ids.insert(id);
            contacts[ContactSum::id_of(/* between surfaces */ 1, id)] = name;
          }
        setup.pairs.push_back(touching_itself(ids));
      }
    Impact<2> thrown(impact, triangulation, setup, folder.communicator);
    folder.log(std::to_string(triangulation.n_global_active_cells()) +
               " cells, " + std::to_string(thrown.body.owned_indices().size()) +
               " unknowns, " + parameters.material.law + ", " +
               impact.contact.treatment + ", " + impact.scheme.name + ", " +
               impact.mass + " mass");

    // The body flies, undeformed.
    const State initial_state =
      thrown.state_in_flight(parameters.initial_velocity);

    // The time loop writes energies and contact; momenta are added.
    ImpactLoop<2>    loop(impact.time, thrown, {material}, contacts, folder);
    const Momenta<2> momenta(thrown.body,
                             thrown.system.mass_matrix(),
                             /* small strains */ material.linear.has_value());
    add_momentum_columns(momenta, thrown.body, loop);

    loop.run(initial_state);
  }
} // namespace Ricochet
