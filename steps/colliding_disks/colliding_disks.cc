// SPDX-License-Identifier: LGPL-2.1-or-later

// # Colliding disks
//
// Two elastic disks fly at each other and part again: contact of two deformable
// bodies without any rigid one,
//
//     rho u_tt - div (F S) = 0                  in both disks,
//     gap >= 0, p >= 0, p gap = 0 or its like   between their circles,
//     |t| <= mu p, t along the slip             (Coulomb),
//
// of a Saint Venant-Kirchhoff material in plane strain, head-on or with an offset b
// of their paths. No force comes from outside: linear and angular momentum of both
// together are kept, whatever the method, and energy by the methods that are made for
// it. With an offset the circles roll and slide on each other, so that nodes of one
// pass the vertices of the other.
//
// The meshes are rings of triangles of different numbers; the finer one is the slave,
// unless it is told otherwise: which one it is must not matter by more than the error
// of the discretisation.
//
// At the end the program prints the velocities of the centres of mass, the
// restitution along the line of the centres at the first touch, the energy that is
// left and the largest penetration, with eight digits.
//
// Run it as
//
//     colliding_disks parameter_files/colliding_disks/default.prm
//     colliding_disks --set "Disks/Offset=1" --set "Contact/Friction coefficient=0.2"
//     colliding_disks --print-parameters

#include <base/exceptions.h>
#include <base/program.h>
#include <materials/material_parameters.h>
#include <output/part_columns.h>
#include <output/vtu_series.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <deal.II/distributed/shared_tria.h>

#include <cmath>
#include <cstdio>

using namespace dealii;
using namespace Ricochet;

class CollidingDisks
{
public:
  CollidingDisks();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  /// Where the middles of the disks are at the start (m).
  Point<2>
  centre(const unsigned int disk) const;

  void
  make_grid(Triangulation<2> &triangulation) const;

  void
  report(const Impact<2>      &collision,
         const PartColumns<2> &parts,
         const State          &begin,
         const State          &end,
         const EnergyLedger   &ledger,
         RunFolder            &folder) const;

  ImpactParameters   impact;
  MaterialParameters material;
  double             radius = 1., distance = 2.02, offset = 0., speed = 1.;
  unsigned int       n_rings[2] = {11, 9};
  double             angle[2]   = {0., numbers::PI + .02};
  std::string        slave      = "left";
};



// ### Data
CollidingDisks::CollidingDisks()
{
  material.law           = "Saint Venant-Kirchhoff";
  material.plane_state   = "plane strain";
  material.density       = 1000.;
  material.young_modulus = 1e6;
  material.poisson_ratio = .3;

  impact.time.final_time   = .26;
  impact.time.time_step    = 4e-3;
  impact.time.fields_every = 5;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment              = "persistent contact";
  impact.contact.compliance_coefficient = 1e8;
  impact.contact.tangential_compliance  = 1e5;
  impact.contact.augmentation           = 1e6;
  impact.contact.penalty_epsilon_0      = 1e-7;
}



void
CollidingDisks::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  impact.contact.add_pair_parameters(prm);
  material.add_parameters(prm);
  prm.enter_subsection("Disks");
  prm.add_parameter("Radius",
                    radius,
                    "Radius of both disks (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Distance",
                    distance,
                    "Distance of their middles at the start (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Offset",
                    offset,
                    "Distance of the parallels on which they fly (m): 0 for "
                    "head-on.",
                    Patterns::Double(0.));
  prm.add_parameter("Speed", speed, "Speed of each, towards the other (m/s).");
  prm.add_parameter(
    "Rings of the left disk",
    n_rings[0],
    "The mesh has that many rings, the outer one with six times "
    "as many nodes.",
    Patterns::Integer(2, 1000));
  prm.add_parameter("Rings of the right disk",
                    n_rings[1],
                    "The same for the other disk.",
                    Patterns::Integer(2, 1000));
  prm.add_parameter("Angle of the left disk",
                    angle[0],
                    "By how much its mesh is turned, against the clock (rad).");
  prm.add_parameter("Angle of the right disk",
                    angle[1],
                    "The same for the other disk.");
  prm.add_parameter("Slave",
                    slave,
                    "The disk in whose nodes contact is formulated.",
                    Patterns::Selection("left|right"));
  prm.leave_subsection();
}



void
CollidingDisks::validate() const
{
  check_pair_combination(impact.contact, scheme_traits(impact.scheme.name));
  material.validate(2, impact.scheme.name);
  impact.validate(material.law == "linear elastic",
                  material.viscosity != "none" && material.viscosity_eta > 0.);
  if (!(offset < distance))
    throw InputError(
      "Disks/Offset = " + to_text(offset) +
      " m must be smaller than Disks/Distance = " + to_text(distance) + " m.");
  impact.check_size(6. * n_rings[0] * n_rings[0] + 6. * n_rings[1] * n_rings[1],
                    2);
  Triangulation<2> triangulation;
  make_grid(triangulation);
}



std::vector<UnusedParameter>
CollidingDisks::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  const auto                   own    = material.unused_parameters();
  unused.insert(unused.end(), own.begin(), own.end());
  return unused;
}



// ### Mesh
Point<2>
CollidingDisks::centre(const unsigned int disk) const
{
  const double side = disk == 0 ? -.5 : .5;
  return Point<2>(side * std::sqrt(distance * distance - offset * offset),
                  side * offset);
}



void
CollidingDisks::make_grid(Triangulation<2> &triangulation) const
{
  make_ringed_disks({{centre(0), radius, n_rings[0], angle[0]},
                     {centre(1), radius, n_rings[1], angle[1]}},
                    triangulation);
}



// ### The run
void
CollidingDisks::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_grid(triangulation);

  // Two parts in one mesh, and the surfaces that may touch.
  const Material<2> elastic = material.make<2>();
  ImpactSetup<2>    setup{elastic};
  setup.parts.push_back(
    {"left", elastic, material.density, Tensor<1, 2>({speed, 0.})});
  setup.parts.push_back(
    {"right", elastic, material.density, Tensor<1, 2>({-speed, 0.})});
  const types::boundary_id slave_id = slave == "left" ? 0 : 1;
  setup.pairs                       = {{"disks", {slave_id}, {1U - slave_id}}};
  Impact<2> collision(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " cells, " +
             std::to_string(collision.body.owned_indices().size()) +
             " unknowns, " + material.law + ", " + impact.contact.treatment +
             ", mu = " + to_text(impact.contact.friction_coefficient));

  const State initial_state = collision.state_of_parts();

  TimeLoop             loop(impact.time,
                folder,
                collision.system,
                *collision.scheme,
                {{slave_id, "disks"}});
  const PartColumns<2> parts(collision.body,
                             *collision.bulk,
                             collision.system.mass_matrix(),
                             elastic.linear.has_value(),
                             {"left", "right"});
  parts.add_to(loop);

  VtuSeries<2> fields(collision.body,
                      {elastic, elastic},
                      *collision.contact,
                      collision.obstacles,
                      folder);
  loop.write_fields = [&](const State &state, const unsigned int step) {
    fields.write(state, step);
  };

  const State end = loop.run(initial_state);
  report(collision, parts, initial_state, end, loop.energy_ledger(), folder);
}



// ### What came out
//
// Numbers that other programs can be compared with.
void
CollidingDisks::report(const Impact<2>      &collision,
                       const PartColumns<2> &parts,
                       const State          &begin,
                       const State          &end,
                       const EnergyLedger   &ledger,
                       RunFolder            &folder) const
{
  const auto print = [&](const std::string &name, const double value) {
    char line[80];
    std::snprintf(line, sizeof(line), "%-32s %16.8e", name.c_str(), value);
    folder.log(line);
  };
  const auto translation = collision.uniform(Tensor<1, 2>({1., 0.}));
  const auto velocity    = [&](const unsigned int disk, const State &state) {
    const Momenta<2> &momenta = parts.momenta(disk);
    return momenta.linear(state.velocity) / momenta.linear(translation)[0];
  };
  const std::string names[2] = {"left", "right"};
  for (unsigned int disk = 0; disk < 2; ++disk)
    for (unsigned int c = 0; c < 2; ++c)
      print("velocity_" + std::string(1, "xy"[c]) + "_" + names[disk],
            velocity(disk, end)[c]);

  // Along the line of the centres when the circles first touch.
  const double       along = std::sqrt(4. * radius * radius - offset * offset);
  const Tensor<1, 2> line  = Tensor<1, 2>({along, offset}) / (2. * radius);
  print("restitution",
        -((velocity(1, end) - velocity(0, end)) * line) /
          ((velocity(1, begin) - velocity(0, begin)) * line));
  const std::vector<double> &first  = ledger.rows().front();
  const std::vector<double> &last   = ledger.rows().back();
  const auto                 column = [&](const std::string &name) {
    return ledger.column_number(name);
  };
  print("energy_left_over", last[column("energy")] / first[column("energy")]);
  for (const std::string name :
       {"momentum_x", "momentum_y", "angular_momentum"})
    print("drift_" + name, last[column(name)] - first[column(name)]);
  double penetration = 0.;
  for (const auto &row : ledger.rows())
    penetration = std::max(penetration, row[column("penetration_disks")]);
  print("penetration", penetration);
}



int
main(int argc, char **argv)
{
  CollidingDisks program;
  return run_program(argc,
                     argv,
                     {"colliding_disks",
                      "Two elastic disks collide.",
                      [&](ParameterHandler &prm) {
                        program.add_parameters(prm);
                      },
                      [&]() { program.validate(); },
                      [&](RunFolder &folder) { program.run(folder); },
                      [&]() { return program.unused_parameters(); }});
}
