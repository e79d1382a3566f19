// SPDX-License-Identifier: LGPL-2.1-or-later

// # A user's own step
//
// The shortest program on Ricochet's library: a block falls on the ground,
//
//     rho u_tt - div P(F) = rho g,     gap >= 0, p >= 0, p gap' = 0     on its lower side,
//
// with persistent contact, which keeps the energy. Copy this folder, and change the mesh,
// the material, the obstacle. Run it as
//
//     own_step --output-dir output/own_step
//
// A user's contact law, friction law, material and time scheme are beside it,
// each in one file, and become choices of the parameter file in the first lines
// of main():
//
//     own_step --set "Contact/Treatment=exponential pressure" --set "Material/Law=Gent"

#include "backward_euler.h"
#include "exponential_pressure.h"
#include "gent.h"
#include "limited_friction.h"

#include <base/program.h>
#include <materials/material_parameters.h>
#include <problems/impact_loop.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/grid/grid_generator.h>

using namespace dealii;
using namespace Ricochet;

int
main(int argc, char **argv)
{
  // Before any parameter is declared: laws declare their own.
  register_contact_law<ExponentialPressure>();
  register_friction_law<LimitedFriction>();
  register_material<Gent>();
  register_time_scheme<BackwardEuler>();

  // Parameters of the file, with this program's defaults.
  ImpactParameters   impact;
  MaterialParameters material;
  double             height        = .1;
  impact.time.final_time           = .5;
  impact.time.time_step            = 5e-3;
  impact.scheme.name               = "midpoint";
  impact.contact.treatment         = "persistent contact";
  material.law                     = "neo-Hookean";
  material.plane_state             = "plane strain";
  material.density                 = 1000.;
  material.values["Young modulus"] = 1e6;
  material.values["Poisson ratio"] = .3;
  // Stiffnesses of contact that the user does not set are 0 here, and follow from the
  // material and the mesh below.
  impact.contact.leave_open();
  const auto add_parameters = [&](ParameterHandler &parameters) {
    impact.add_parameters(parameters);
    material.add_parameters(parameters);
    parameters.enter_subsection("Start");
    parameters.add_parameter("Height",
                             height,
                             "Height of the block above the ground (m).",
                             Patterns::Double(0.));
    parameters.leave_subsection();
  };

  // Checks before any time is spent.
  const auto validate = [&]() {
    material.validate(2, impact.scheme.name);
    // The diagonal of a cell of the mesh below.
    constexpr double cell_diameter = .177;
    impact.contact.set_missing(material.scales(cell_diameter, /* degree */ 1));
    impact.validate(material.is_linear(), material.velocity_force());
  };

  const auto run = [&](RunFolder &folder) {
    parallel::shared::Triangulation<2> mesh(folder.communicator);
    GridGenerator::subdivided_hyper_rectangle(mesh,
                                              {8, 4},
                                              Point<2>(0., height),
                                              Point<2>(1., height + .5),
                                              /* colorize */ true);
    for (const auto &cell : mesh.active_cell_iterators())
      cell->set_material_id(0);

    const Material<2> elastic = material.make<2>();
    ImpactSetup<2>    setup{elastic};
    setup.density   = material.density;
    setup.gravity   = Tensor<1, 2>({0., -9.81});
    setup.obstacles = foundation_below<2>(/* lower side */ 2);
    Impact<2> block(impact, mesh, setup, folder.communicator);

    ImpactLoop<2> loop(impact.time, block, {elastic}, {{2, "ground"}}, folder);
    loop.run(block.state_in_flight(Tensor<1, 2>()));
  };

  return run_program(argc,
                     argv,
                     {"own_step",
                      "A block falls on the ground.",
                      add_parameters,
                      validate,
                      run,
                      [&]() {
                        std::vector<UnusedParameter> unused =
                          impact.unused_parameters();
                        const auto own = material.unused_parameters();
                        unused.insert(unused.end(), own.begin(), own.end());
                        return unused;
                      }});
}
