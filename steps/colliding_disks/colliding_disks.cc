// SPDX-License-Identifier: LGPL-2.1-or-later

// # Colliding disks
//
// Two elastic disks fly at each other and part again, head-on or with an offset
// $b$ of their paths: contact of two deformable bodies without any rigid one.
// Pressures, friction and the midpoint scheme are those of the programs
// elastic_ball and hyperelastic_ring. New is the gap: both sides of it move.
//
// ## The problem
//
// In both disks, of a Saint Venant-Kirchhoff material in plane strain (linear
// between $C - I$ and the stress $S$, for large rotations),
//
// $$ \rho\, \ddot u - \mathrm{Div} (F S) = 0 , $$
//
// and between their circles $g \ge 0$, $p \ge 0$, $p\, g = 0$ or its like, and
// Coulomb's friction, $|t| \le \mu p$ and against the slip. No force comes from
// outside. Linear and angular momentum of both together are kept, whatever the
// method; energy by the methods that are made for it. With an offset the
// circles roll and slide on each other, so that nodes of one pass the vertices
// of the other.
//
// ## The gap between two bodies
//
// Contact is formulated in the nodes $y$ of one surface, the **slave**. Each
// faces a facet from $a$ to $b$ of the other one, the **master**, whose outside
// is on its left. All three move. With $e = b - a$ and $r = y - a$, the gap is
// the distance from the line of the facet, and $\xi$ is the coordinate of the
// point along it (B (2.5)):
//
// $$ g = \frac{A}{\sqrt B}, \qquad \xi = \frac{P}{B}, \qquad
//    A = e \times r, \quad B = e \cdot e, \quad P = e \cdot r . $$
//
// ## Weak form
//
// A pressure pushes both bodies. It is multiplied by how much the gap changes
// along $v$, and since the gap depends on the displacements of the point and of
// both ends of the facet, so does this (B (2.29) to (2.31), with our signs):
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int F S : \nabla v \, dx
//    - \sum_j w_j \big( p_j \delta g_j(v) + t_j \delta s_j(v) \big) = 0 , $$
//
// where $s$ is the slip along the facet. Action and reaction are balanced: a
// rigid motion of all three points changes neither gap nor slip, so that the
// sum of their forces and of the moments is zero.
//
// ## The scheme
//
// Over a step of the midpoint scheme the changes $\delta g$ and $\delta s$ are
// rows $D$ and $T$ on the coordinates $x = (y, a, b)$ of the three points, such
// that
//
// $$ D \cdot (x_1 - x_0) = g_1 - g_0, \qquad
//    T \cdot (x_1 - x_0) = L_m (\xi_1 - \xi_0) . $$
//
// The gradient of $g$ anywhere in the step is not enough, because $g$ is not
// linear. But $A$, $B$ and $P$ are quadratic, and the gradient of a quadratic
// function in the middle of a step is exactly its quotient of differences. The
// rules for products and quotients do the rest: with $L = \sqrt B$ and $m$ for
// the middle,
//
// $$ D = \tfrac12 \Big( \frac{1}{L_0} + \frac{1}{L_1} \Big) \nabla A_m
//    - \frac{A_0 + A_1}{2 L_0 L_1 (L_0 + L_1)} \nabla B_m , $$
//
// $$ T = L_m \Big[
//    \tfrac12 \Big( \frac{1}{B_0} + \frac{1}{B_1} \Big) \nabla P_m
//    - \frac{P_0 + P_1}{2 B_0 B_1} \nabla B_m \Big] . $$
//
// A point that passes a vertex during the step gets the mean of the rows of
// both facets, weighted by the part of its displacement on each, and a small
// couple for the change of the angle between them, so that the first equation
// stays exact (`lib/contact/surfaces/facet_chain.h`). B (3.6) has the same
// change of the gap, but the force of B (3.4) is along the normal in the middle
// of the step, and its work is not the same once the normal turns.
//
// ## One step of this program
//
//     predict  where all points will be in the middle of the step
//     choose the facet that each node of the slave faces, and keep it
//     solve    M (V_1 - V_0)/dt + F_int(U_0, U_1) = sum of w (p D + t T)
//              U_1 - U_0 = dt (V_0 + V_1)/2
//              for U_1, and for p and t where they are constraints:
//              persistent contact: p >= 0, D . dx >= 0, p D . dx = 0
//
// The work of contact is then $p\,(g_1 - g_0)$ for each point, as against a
// plane, and the properties of the treatments in elastic_ball hold. The file is
// `lib/contact/treatments/pair_contact.h`.
//
// ## Which is the slave?
//
// The meshes are rings of triangles of different numbers; the finer one is the
// slave, unless the parameter file says otherwise: the choice must not matter
// by more than the error of the discretisation.
//
// At the end the program prints the velocities of the centres of mass, the
// restitution along the line of the centres at the first touch, the remaining
// energy and the largest penetration, with eight digits.
//
// ## Run it
//
//     colliding_disks parameter_files/colliding_disks/default.prm
//     colliding_disks --set "Disks/Offset=1" --set "Contact/Friction coefficient=0.2"
//     colliding_disks --print-parameters

#include <base/exceptions.h>
#include <base/program.h>
#include <materials/material_parameters.h>
#include <output/part_columns.h>
#include <problems/impact_loop.h>
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
  /// Initial positions of the centres of the disks (m).
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



// ## Data
CollidingDisks::CollidingDisks()
{
  material.law                     = "Saint Venant-Kirchhoff";
  material.plane_state             = "plane strain";
  material.density                 = 1000.;
  material.values["Young modulus"] = 1e6;
  material.values["Poisson ratio"] = .3;

  impact.time.final_time   = .26;
  impact.time.time_step    = 4e-3;
  impact.time.fields_every = 5;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment                        = "persistent contact";
  impact.contact.values["Compliance coefficient"] = 1e8;
  impact.contact.values["Tangential compliance"]  = 1e5;
  impact.contact.values["Augmentation"]           = 1e6;
  impact.contact.values["Penalty epsilon0"]       = 1e-7;
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
  impact.validate(material.is_linear(), material.velocity_force());
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



// ## Mesh
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



// ## The run
void
CollidingDisks::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_grid(triangulation);

  // Two parts in one mesh, and the surfaces that may touch. One mesh means one
  // vector of unknowns, one $M$ and one $F_{int}$; the disks have no common
  // node, so that only $D$ and $T$ couple them. These couplings change during
  // the run.
  const Material<2> elastic = material.make<2>();
  ImpactSetup<2>    setup{elastic};
  setup.parts.push_back(
    {"left", elastic, material.density, Tensor<1, 2>({speed, 0.})});
  setup.parts.push_back(
    {"right", elastic, material.density, Tensor<1, 2>({-speed, 0.})});
  const types::boundary_id slave_id = slave == "left" ? 0 : 1;
  setup.pairs                       = {{"disks", {slave_id}, {1U - slave_id}}};
  Impact<2> collision(impact, triangulation, setup, folder.communicator);
  folder.log(
    std::to_string(triangulation.n_global_active_cells()) + " cells, " +
    std::to_string(collision.body.owned_indices().size()) + " unknowns, " +
    material.law + ", " + impact.contact.treatment +
    ", mu = " + to_text(impact.contact.values["Friction coefficient"]));

  const State initial_state = collision.state_of_parts();

  // Energy, momenta and work of each disk and of both, beside what every
  // program writes.
  ImpactLoop<2>        loop(impact.time,
                     collision,
                     {elastic, elastic},
                     {{slave_id, "disks"}},
                     folder);
  const PartColumns<2> parts(collision.body,
                             collision.system,
                             elastic.linear.has_value(),
                             {"left", "right"});
  parts.add_to(loop);

  const State end = loop.run(initial_state);
  report(collision, parts, initial_state, end, loop.energy_ledger(), folder);
}



// ## Results
//
// Numbers that other programs can be compared with. The restitution is the
// velocity with which the centres part along their line, over that with which
// they came.
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
  return run_program<CollidingDisks>(argc,
                                     argv,
                                     "colliding_disks",
                                     "Two elastic disks collide.");
}
