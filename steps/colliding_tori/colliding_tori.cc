// SPDX-License-Identifier: LGPL-2.1-or-later

// # Colliding tori
//
// Two hollow tori of soft rubber are thrown at each other, off centre and tilted.
// Their tubes are pressed flat, until the walls meet inside; the tori turn, part,
// and go on spinning and swinging. They touch each other and themselves.
//
// ## The problem
//
// That of the program colliding_spheres, with one surface instead of two: all
// that bounds either torus, outside and inside, against itself,
//
// $$ \rho\, \ddot u - \mathrm{Div}\, \Pi(F) = 0, \qquad
//    g \ge 0, \quad p \ge 0, \quad p\, g = 0 \quad\text{or its like}, \qquad
//    |t| \le \mu p . $$
//
// No force comes from outside, and all six momenta are kept.
//
// ## A surface against itself
//
// Gap, pressure and directions of a point that faces a triangle are those
// between two bodies. New is the choice of the triangles that a point can face
// at all (`lib/contact/surfaces/own_facets.h`). The closest one is always its
// own. Left out are
//
// - those that it is connected with, and their neighbours;
// - those with the same orientation as its own surface;
// - those that are behind its own surface, where its wall is;
// - those that it is behind by more than half of the wall there. So no point
// faces the far side of its own wall, nor, when the tube is flat, triangles
// beyond the opposite wall.
//
// The remaining triangle that is touched is then the closest one. Folds that
// will close in the coming step are seen where the velocity leads.
//
// Every node is a slave, on both sides of a contact. In return none is left
// out, whichever wall meets which; between two bodies one surface would do.
//
// ## The scheme
//
// As there, Gonzalez' discrete gradient of the stored energy
// (`lib/materials/gonzalez.h`) and rows $D$ with $D \cdot \Delta x = \Delta g$:
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    = \sum_j w_j \big( p_j D_j + t_{1,j} T_{1,j} + t_{2,j} T_{2,j} \big),
//    \qquad \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} . $$
//
// By default contact is improved normal compliance. Its stored energy is
// returned, so that the sum of kinetic, elastic and contact energy is kept to
// the tolerance of Newton's method.
//
// ## Run it
//
//     colliding_tori parameter_files/colliding_tori/default.prm
//     colliding_tori --set "Contact/Self=false"
//     mpirun -n 2 colliding_tori --set "Contact/Friction coefficient=0.3"
//     colliding_tori --print-parameters

#include <base/exceptions.h>
#include <base/program.h>
#include <discretization/distributed_mesh.h>
#include <materials/material_parameters.h>
#include <output/mean_rotation.h>
#include <output/part_columns.h>
#include <problems/impact_loop.h>
#include <problems/part_meshes.h>
#include <problems/torus_mesh.h>

#include <deal.II/base/function.h>
#include <deal.II/physics/transformations.h>

#include <array>
#include <cstdio>

using namespace dealii;
using namespace Ricochet;

class CollidingTori
{
public:
  CollidingTori();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  /// Initial motion of each torus.
  struct Throw
  {
    std::string  name;
    Point<3>     centre;
    Tensor<1, 3> axis, velocity, spin;
  };

  HollowTorus
  torus(const unsigned int number) const;

  unsigned int
  nearest_torus(const Point<3> &x) const;

  /// Outsides and insides that may touch, and their names.
  std::map<types::boundary_id, std::string>
  surfaces() const;

  void
  make_whole_mesh(Triangulation<3> &mesh) const;

  /// The velocity of a torus that flies and spins, at the point x (m/s).
  Tensor<1, 3>
  initial_velocity(const Point<3> &x) const;

  /// Mass, momenta and energies of one torus.
  struct Flight
  {
    double       mass;
    Tensor<1, 3> velocity, own_angular_momentum;
  };

  Flight
  flight(const Impact<3>  &collision,
         const Momenta<3> &momenta,
         const State      &state) const;

  void
  report(Impact<3>            &collision,
         const PartColumns<3> &parts,
         const State          &end,
         const EnergyLedger   &ledger,
         RunFolder            &folder) const;

  ImpactParameters     impact;
  MaterialParameters   material;
  std::array<Throw, 2> throws;
  HollowTorus          shape;
  bool                 touch_themselves = true;
};



// ## Data
CollidingTori::CollidingTori()
{
  shape.tube_radius = .35;
  shape.wall        = .06;

  throws[0] = {"left",
               Point<3>(-1., -.35, 0.),
               Tensor<1, 3>({.3, 1., .3}),
               Tensor<1, 3>({6., 0., 0.}),
               Tensor<1, 3>()};
  throws[1] = {"right",
               Point<3>(1., .35, 0.),
               Tensor<1, 3>({1., .2, .3}),
               Tensor<1, 3>({-6., 0., 0.}),
               Tensor<1, 3>()};

  material.law                     = "neo-Hookean";
  material.plane_state             = "plane strain";
  material.density                 = 1000.;
  material.values["Young modulus"] = 3e5;
  material.values["Poisson ratio"] = .35;

  impact.time.final_time   = .3;
  impact.time.time_step    = 2e-3;
  impact.time.fields_every = 3;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment = "improved normal compliance";
  impact.contact.values["Compliance coefficient"] = 3e7;
  impact.contact.values["Compliance exponent"]    = 2.;
  impact.contact.values["Tangential compliance"]  = 1e5;
  impact.contact.values["Augmentation"]           = 3e5;
  impact.contact.values["Penalty epsilon0"]       = 1e-7;
}



void
CollidingTori::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  material.add_parameters(prm);
  prm.enter_subsection("Contact");
  prm.add_parameter(
    "Self",
    touch_themselves,
    "Self-contact of the tori: all of their surfaces, outside "
    "and inside, touch each other and themselves. Otherwise the nodes "
    "of the left one's outside touch that of the right one, and "
    "walls pass through each other inside.",
    Patterns::Bool());
  prm.leave_subsection();
  prm.enter_subsection("Tori");
  prm.add_parameter("Ring radius",
                    shape.ring_radius,
                    "From the centre of a torus to the middle of its tube (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Tube radius",
                    shape.tube_radius,
                    "Of the outside of the tube (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Wall",
                    shape.wall,
                    "Thickness of the wall of the tube (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Cells around the ring",
                    shape.n_around_ring,
                    "Number of hexahedra.",
                    Patterns::Integer(4));
  prm.add_parameter("Cells around the tube",
                    shape.n_around_tube,
                    "Number of hexahedra.",
                    Patterns::Integer(4));
  prm.add_parameter("Cells across the wall",
                    shape.n_across_wall,
                    "Number of hexahedra.",
                    Patterns::Integer(1));
  for (Throw &one : throws)
    {
      prm.add_parameter("Centre of the " + one.name + " torus",
                        one.centre,
                        "Where it is at the start (m).");
      prm.add_parameter("Axis of the " + one.name + " torus",
                        one.axis,
                        "The direction across its ring, of any length.");
      prm.add_parameter("Velocity of the " + one.name + " torus",
                        one.velocity,
                        "Of its centre at the start (m/s).");
      prm.add_parameter("Spin of the " + one.name + " torus",
                        one.spin,
                        "Its angular velocity at the start (rad/s).");
    }
  prm.leave_subsection();
}



void
CollidingTori::validate() const
{
  check_pair_combination(impact.contact,
                         scheme_traits(impact.scheme.name),
                         {touch_themselves, /* dim */ 3});
  material.validate(3, impact.scheme.name);
  impact.validate(material.is_linear(), material.velocity_force());
  if (material.is_linear())
    throw InputError(
      "Linear elastic bodies cannot turn, and tori that are thrown "
      "do: take another Material/Law.");
  impact.check_size(6. * shape.n_around_ring * shape.n_around_tube *
                      (shape.n_across_wall + 1.),
                    3);
  // The construction of a mesh checks its parameters.
  for (const unsigned int number : {0, 1})
    {
      Triangulation<3> mesh;
      make_hollow_torus(torus(number), mesh);
    }
}



std::vector<UnusedParameter>
CollidingTori::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  const auto                   own    = material.unused_parameters();
  unused.insert(unused.end(), own.begin(), own.end());
  return unused;
}



// ## Mesh
//
// Outsides have the boundary ids 0 and 2, insides 1 and 3.
HollowTorus
CollidingTori::torus(const unsigned int number) const
{
  HollowTorus one = shape;
  one.centre      = throws[number].centre;
  one.axis        = throws[number].axis;
  return one;
}



std::map<types::boundary_id, std::string>
CollidingTori::surfaces() const
{
  std::map<types::boundary_id, std::string> names;
  for (const unsigned int number : {0, 1})
    {
      names[2 * number + TorusBoundary::outside] =
        throws[number].name + "_outside";
      names[2 * number + TorusBoundary::inside] =
        throws[number].name + "_inside";
    }
  if (!touch_themselves)
    return {*names.begin()};
  return names;
}



void
CollidingTori::make_whole_mesh(Triangulation<3> &mesh) const
{
  Triangulation<3> tori[2];
  for (const unsigned int number : {0, 1})
    {
      make_hollow_torus(torus(number), tori[number]);
      for (const auto &cell : tori[number].active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(2 * number + face->boundary_id());
    }
  join_parts<3>({&tori[0], &tori[1]}, mesh);
}



// ## The run
//
// The torus to which a point belongs is not the one with the nearer centre when
// one ring reaches into the other, but the one with the nearer tube.
unsigned int
CollidingTori::nearest_torus(const Point<3> &x) const
{
  double distance[2];
  for (const unsigned int number : {0, 1})
    {
      const Tensor<1, 3> axis =
        throws[number].axis / throws[number].axis.norm();
      const Tensor<1, 3> way    = x - throws[number].centre;
      const double       height = way * axis;
      distance[number] =
        std::hypot(height, (way - height * axis).norm() - shape.ring_radius);
    }
  return distance[0] < distance[1] ? 0 : 1;
}



Tensor<1, 3>
CollidingTori::initial_velocity(const Point<3> &x) const
{
  const Throw &own = throws[nearest_torus(x)];
  return own.velocity + cross_product_3d(own.spin, x - own.centre);
}



void
CollidingTori::run(RunFolder &folder)
{
  const auto mesh =
    distribute_mesh<3>([&](Triangulation<3> &whole) { make_whole_mesh(whole); },
                       folder.communicator);

  const Material<3> rubber = material.make<3>();
  ImpactSetup<3>    setup{rubber};
  for (const Throw &one : throws)
    setup.parts.push_back({one.name, rubber, material.density});
  if (touch_themselves)
    {
      std::set<types::boundary_id> ids;
      for (const auto &[id, name] : surfaces())
        ids.insert(id);
      setup.pairs = {touching_itself(ids)};
    }
  else
    setup.pairs = {
      {"tori", {TorusBoundary::outside}, {2 + TorusBoundary::outside}}};
  Impact<3> collision(impact, *mesh, setup, folder.communicator);
  folder.log(
    std::to_string(mesh->n_global_active_cells()) + " cells, " +
    std::to_string(collision.body.owned_indices().size()) + " unknowns, " +
    material.law + ", " + impact.contact.treatment +
    ", mu = " + to_text(impact.contact.values["Friction coefficient"]));

  std::vector<std::function<double(const Point<3> &)>> velocity;
  for (unsigned int c = 0; c < 3; ++c)
    velocity.emplace_back(
      [this, c](const Point<3> &x) { return initial_velocity(x)[c]; });
  const State initial_state =
    collision.state_in_motion(FunctionFromFunctionObjects<3>(velocity));

  // Energy, work and momenta of each torus and of both, beside what every program
  // writes.
  ImpactLoop<3>        loop(impact.time,
                     collision,
                     {rubber, rubber},
                     surfaces(),
                     folder);
  const PartColumns<3> parts(collision.body,
                             collision.system,
                             /* small strains */ false,
                             {throws[0].name, throws[1].name});
  parts.add_to(loop);

  const State end = loop.run(initial_state);
  report(collision, parts, end, loop.energy_ledger(), folder);
}



// ## Results
//
// Parts of the energy of each torus: of the motion of its centre; of a rigid
// torus that turns with the same angular momentum $L$ about the centre,
// $\tfrac12 L \cdot I^{-1} L$; and the rest, which is in vibrations. The tensor
// of inertia $I$ is that of the undeformed torus, turned by the mean rotation.
CollidingTori::Flight
CollidingTori::flight(const Impact<3>  &collision,
                      const Momenta<3> &momenta,
                      const State      &state) const
{
  const auto along_x = collision.uniform(Tensor<1, 3>({1., 0., 0.})),
             along_y = collision.uniform(Tensor<1, 3>({0., 1., 0.}));
  Flight result;
  result.mass             = momenta.linear(along_x)[0];
  const Tensor<1, 3> p    = momenta.linear(state.velocity),
                     of_x = momenta.angular(state.solution, along_x),
                     of_y = momenta.angular(state.solution, along_y);
  result.velocity         = p / result.mass;
  const Tensor<1, 3> middle =
    Tensor<1, 3>({of_y[2], -of_x[2], of_x[1]}) / result.mass;
  result.own_angular_momentum =
    momenta.angular(state.solution, state.velocity) -
    cross_product_3d(middle, p);
  return result;
}



void
CollidingTori::report(Impact<3>            &collision,
                      const PartColumns<3> &parts,
                      const State          &end,
                      const EnergyLedger   &ledger,
                      RunFolder            &folder) const
{
  const auto print = [&](const std::string &name, const double value) {
    char line[80];
    std::snprintf(line, sizeof(line), "%-32s %16.8e", name.c_str(), value);
    folder.log(line);
  };
  const std::vector<double> &first  = ledger.rows().front();
  const std::vector<double> &last   = ledger.rows().back();
  const auto                 column = [&](const std::string &name) {
    return ledger.column_number(name);
  };

  // The tensors of inertia, column by column, from unit rotations about each axis.
  Tensor<2, 3> inertia[2];
  for (unsigned int k = 0; k < 3; ++k)
    {
      Tensor<1, 3> axis;
      axis[k] = 1.;
      std::vector<std::function<double(const Point<3> &)>> turning;
      for (unsigned int c = 0; c < 3; ++c)
        turning.emplace_back([this, axis, c](const Point<3> &x) {
          return cross_product_3d(axis,
                                  Tensor<1, 3>(
                                    x - throws[nearest_torus(x)].centre))[c];
        });
      const State unit =
        collision.state_in_motion(FunctionFromFunctionObjects<3>(turning));
      for (const unsigned int number : {0, 1})
        {
          const Tensor<1, 3> angular =
            flight(collision, parts.momenta(number), unit).own_angular_momentum;
          for (unsigned int i = 0; i < 3; ++i)
            inertia[number][i][k] = angular[i];
        }
    }

  double in_vibrations = last[column("energy")];
  for (const unsigned int number : {0, 1})
    {
      const std::string  name = "_" + throws[number].name;
      const Flight       own  = flight(collision, parts.momenta(number), end);
      const Tensor<1, 3> turn = MeanRotation<3>(collision.body,
                                                collision.consistent_mass,
                                                2,
                                                number,
                                                number + 1)
                                  .vector(end.solution);
      Tensor<2, 3> rotation = unit_symmetric_tensor<3>();
      if (turn.norm() > 0.)
        rotation = Physics::Transformations::Rotations::rotation_matrix_3d(
          Point<3>(turn / turn.norm()),
          turn.norm());
      const Tensor<1, 3> spin = rotation *
        (invert(inertia[number]) *
         (transpose(rotation) * own.own_angular_momentum));
      for (unsigned int c = 0; c < 3; ++c)
        print(std::string("velocity_") + "xyz"[c] + name, own.velocity[c]);
      for (unsigned int c = 0; c < 3; ++c)
        print(std::string("spin_") + "xyz"[c] + name, spin[c]);
      in_vibrations -= .5 * own.mass * own.velocity.norm_square() +
        .5 * (spin * own.own_angular_momentum);
    }
  print("energy_left_over", last[column("energy")] / first[column("energy")]);
  print("energy_in_vibrations", in_vibrations / first[column("energy")]);
  for (const std::string momentum : {"momentum_x",
                                     "momentum_y",
                                     "momentum_z",
                                     "angular_momentum_x",
                                     "angular_momentum_y",
                                     "angular_momentum_z"})
    print("drift_" + momentum,
          last[column(momentum)] - first[column(momentum)]);
  for (const auto &[id, name] : surfaces())
    for (const std::string quantity : {"contact_force_", "penetration_"})
      {
        double most = 0.;
        for (const auto &row : ledger.rows())
          most = std::max(most, row[column(quantity + name)]);
        print("largest_" + quantity + name, most);
      }
}



int
main(int argc, char **argv)
{
  return run_program<CollidingTori>(
    argc,
    argv,
    "colliding_tori",
    "Two hollow tori collide, with self-contact.");
}
