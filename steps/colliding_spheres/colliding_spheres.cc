// SPDX-License-Identifier: LGPL-2.1-or-later

// # Colliding spheres
//
// Two elastic balls fly at each other in 3D, and may spin. This is the program
// colliding_disks with one dimension more: a point faces a triangle and not a
// line, there are two directions along a surface, and six momenta to be kept.
//
// ## The problem
//
// $$ \rho\, \ddot u - \mathrm{Div}\, \Pi(F) = 0 \quad\text{in both balls}, $$
//
// with the first Piola-Kirchhoff stress $\Pi = F S$, and between their surfaces
// $g \ge 0$, $p \ge 0$, $p\, g = 0$ or its like, and Coulomb's friction
// $|t| \le \mu p$, against the slip. No force comes from outside: linear and
// angular momentum of both together, all six numbers, are kept whatever the
// method, and energy by the methods that are made for it.
//
// ## The gap
//
// Contact is formulated in the nodes $y$ of one surface, the slave. Each of
// them faces a triangle $(a, b, c)$ of the other one, and its gap is the
// distance from the triangle's plane,
//
// $$ g = \frac{V}{\sqrt B}, \qquad V = \det(b - a,\, c - a,\, y - a), \qquad
//    \sqrt B = |(b - a) \times (c - a)| . $$
//
// Its projection on the plane, $a + \xi_1 (b - a) + \xi_2 (c - a)$, follows
// from products of the three differences $w_i$ alone. With `Contact/Coupling =
// mortar` they are replaced by the mean of such gaps around the node, over the
// pieces that triangles of both surfaces cut out of each other
// (`lib/contact/kinematics/mortar_triangles.h`).
//
// ## Weak form
//
// As between disks: for all $v$
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int \Pi : \nabla v \, dx
//    \\ - \sum_j w_j \big( p_j\, \delta g_j(v) + t_{1,j}\, \delta s_{1,j}(v)
//    + t_{2,j}\, \delta s_{2,j}(v) \big) = 0 . $$
//
// ## The scheme
//
// Over a step from $x_0$ to $x_1$, the coordinates of all four points, the
// pressure acts along a row $D$ with
//
// $$ D \cdot (x_1 - x_0) = g_1 - g_0 , $$
//
// so that its work on both bodies is $p\, (g_1 - g_0)$ to the last digit. The
// products $q_{ij} = w_i \cdot w_j$ are quadratic, and their gradients in the
// middle of the step are their quotients of differences. $V$ is cubic, and the
// gradient in the middle lacks $\tfrac14 \det(\Delta w)$ of its change. This
// term is added along a direction that neither pushes nor turns the four points
// as a whole:
//
// $$ D_V = \nabla V_m + \tfrac14 \det(\Delta w) \,
//    \frac{\sum \Delta q_{ij} \nabla q_{ij} + v \nabla V_m / \ell^2}
//         {\sum (\Delta q_{ij})^2 + v^2 / \ell^2} ,
//    \\ v = \nabla V_m \cdot \Delta x, \quad
//    \ell^2 = \tfrac12 \big( \sqrt{B_0} + \sqrt{B_1} \big) . $$
//
// The rules for products, quotients and roots give $D$, and likewise $T_1$ and
// $T_2$ for the slip (`lib/contact/surfaces/point_before_triangle.h`). All of
// these functions are invariant under a rigid motion of all four points, whence
// the sum of the forces and of their moments is zero.
//
// ## One step of this program
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    = \sum_j w_j \big( p_j D_j + t_{1,j} T_{1,j} + t_{2,j} T_{2,j} \big),
//    \qquad \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} , $$
//
// where $F_{int}$ is the discrete gradient of the stored energy
// (`lib/materials/gonzalez.h`), and $p$ and $t$ follow from gap, increment and
// slip by the treatment that the parameter file asks for.
//
// With persistent contact energy is kept to round-off; but a node that has
// penetrated by $d$ in the step in which it touches stays there. The loss in
// the motion of the centres is the energy of vibrations: for elastic spheres it
// is small when the contact lasts much longer than waves need to cross them
// (Hertz).
//
// ## Run it
//
//     colliding_spheres parameter_files/colliding_spheres/default.prm
//     colliding_spheres parameter_files/colliding_spheres/oblique_spin.prm
//     mpirun -n 2 colliding_spheres --set "Spheres/Offset=0.5"
//     colliding_spheres --print-parameters

#include <base/exceptions.h>
#include <base/program.h>
#include <discretization/curved_geometry.h>
#include <discretization/distributed_mesh.h>
#include <materials/material_parameters.h>
#include <output/part_columns.h>
#include <problems/ball_mesh.h>
#include <problems/impact_loop.h>
#include <problems/part_meshes.h>

#include <deal.II/base/function.h>
#include <deal.II/grid/grid_generator.h>

#include <cmath>
#include <cstdio>

using namespace dealii;
using namespace Ricochet;

class CollidingSpheres
{
public:
  CollidingSpheres();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  /// Initial positions of the centres of the spheres (m).
  Point<3>
  centre(const unsigned int sphere) const;

  /// The point that will touch the other one.
  std::optional<FinePlace>
  fine_place(const unsigned int sphere) const;

  unsigned int
  nearest_sphere(const Point<3> &x) const
  {
    return x.distance(centre(0)) < x.distance(centre(1)) ? 0 : 1;
  }

  /// @return the nodes of curved cells, nothing for straight ones.
  CellNodes<3>
  make_whole_mesh(Triangulation<3> &mesh) const;

  /// The velocity of a ball that flies and spins, at the point x (m/s).
  Tensor<1, 3>
  initial_velocity(const Point<3> &x) const;

  /// Angular momentum of one sphere about its own middle (kg m^2/s).
  Tensor<1, 3>
  own_angular_momentum(const unsigned int    sphere,
                       const Impact<3>      &collision,
                       const PartColumns<3> &parts,
                       const State          &state) const;

  void
  report(Impact<3>            &collision,
         const PartColumns<3> &parts,
         const State          &begin,
         const State          &end,
         const EnergyLedger   &ledger,
         RunFolder            &folder) const;

  ImpactParameters   impact;
  MaterialParameters material;
  double             radius = 1., distance = 2.02, offset = 0., speed = 1.;
  Tensor<1, 3>       spin[2];
  double             mesh_size[2]   = {.35, .4};
  double             fine_mesh_size = 0.;
  unsigned int       degree         = 1;
  bool               is_curved      = false;
  std::string        cell_shape     = "tetrahedra";
  std::string        slave          = "left";
};



// ## Data
CollidingSpheres::CollidingSpheres()
{
  material.law                     = "neo-Hookean";
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
CollidingSpheres::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  impact.contact.add_pair_parameters(prm);
  material.add_parameters(prm);
  prm.enter_subsection("Spheres");
  prm.add_parameter("Radius",
                    radius,
                    "Radius of both spheres (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Distance",
                    distance,
                    "Distance of their middles at the start (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter(
    "Offset",
    offset,
    "Distance of the parallels to x on which they fly (m), the right "
    "one towards y: 0 for head-on.",
    Patterns::Double(0.));
  prm.add_parameter("Speed", speed, "Speed of each, towards the other (m/s).");
  prm.add_parameter("Spin of the left sphere",
                    spin[0],
                    "Its angular velocity at the start (rad/s).");
  prm.add_parameter("Spin of the right sphere",
                    spin[1],
                    "The same for the other sphere.");
  prm.add_parameter("Cells",
                    cell_shape,
                    "Shape of the cells.",
                    Patterns::Selection("tetrahedra|hexahedra"));
  prm.add_parameter(
    "Mesh size of the left sphere",
    mesh_size[0],
    "Length of an element (m); of hexahedra the longest edge at the "
    "surface is no longer.",
    Patterns::Double(1e-30));
  prm.add_parameter("Mesh size of the right sphere",
                    mesh_size[1],
                    "The same for the other sphere.",
                    Patterns::Double(1e-30));
  prm.add_parameter(
    "Mesh size where they touch",
    fine_mesh_size,
    "Length of elements around the place where the spheres first touch, over a "
    "dozen of them; from there on they grow. Only for tetrahedra. "
    "0: as everywhere (m).",
    Patterns::Double(0.));
  prm.add_parameter("Degree",
                    degree,
                    "Polynomial degree of the displacement.",
                    Patterns::Integer(1, 2));
  prm.add_parameter(
    "Curved cells",
    is_curved,
    "Whether the edges of cells are curved, with the nodes of the "
    "surface on the sphere. Takes degree 2 and tetrahedra.");
  prm.add_parameter("Slave",
                    slave,
                    "The sphere in whose nodes contact is formulated.",
                    Patterns::Selection("left|right"));
  prm.leave_subsection();
}



void
CollidingSpheres::validate() const
{
  check_pair_combination(impact.contact,
                         scheme_traits(impact.scheme.name),
                         {/* is_self */ false, /* dim */ 3});
  material.validate(3, impact.scheme.name);
  impact.validate(material.is_linear(), material.velocity_force());
  if (!(offset < distance))
    throw InputError("Spheres/Offset = " + to_text(offset) +
                     " m must be smaller than Spheres/Distance = " +
                     to_text(distance) + " m.");
  if (!(distance >= 2. * radius))
    throw InputError("Spheres/Distance = " + to_text(distance) +
                     " m must be two radii at least: the spheres overlap.");
  if (material.is_linear() && (spin[0].norm() > 0. || spin[1].norm() > 0.))
    throw InputError(
      "Linear elastic bodies cannot turn: a sphere that spins "
      "takes another Material/Law.");
  if (fine_mesh_size > 0. && cell_shape != "tetrahedra")
    throw InputError(
      "Spheres/Mesh size where they touch is for Spheres/Cells = "
      "tetrahedra.");
  if (fine_mesh_size > std::min(mesh_size[0], mesh_size[1]))
    throw InputError(
      "Spheres/Mesh size where they touch = " + to_text(fine_mesh_size) +
      " m is larger than that of a whole sphere.");
  if (is_curved && (degree == 1 || cell_shape != "tetrahedra"))
    throw InputError(
      "Spheres/Curved cells = true takes Spheres/Degree = 2 and "
      "Spheres/Cells = tetrahedra.");
  if (degree > 1 && impact.contact.coupling != "points")
    throw InputError("Contact/Coupling = " + impact.contact.coupling +
                     " takes Spheres/Degree = 1; with 2 it can be points.");
  double n_unknowns = 0.;
  for (const unsigned int sphere : {0, 1})
    {
      double volume = std::pow(radius / mesh_size[sphere], 3);
      // Half a ball of fine elements around it, and as many beyond.
      if (const auto fine = fine_place(sphere))
        volume += std::pow(fine->n_elements(), 3);
      n_unknowns += 4. / 3. * numbers::PI * volume * (degree == 1 ? 3.6 : 27.);
    }
  impact.check_size(n_unknowns, 3);
}



std::vector<UnusedParameter>
CollidingSpheres::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  const auto                   own    = material.unused_parameters();
  unused.insert(unused.end(), own.begin(), own.end());
  return unused;
}



// ## Mesh
//
// The first rank makes both balls, puts them side by side into one mesh, in
// which the material id distinguishes them, and distributes the parts. No two
// bodies have a common node, so that the mesh is one in name only.
Point<3>
CollidingSpheres::centre(const unsigned int sphere) const
{
  const double side = sphere == 0 ? -.5 : .5;
  return Point<3>(side * std::sqrt(distance * distance - offset * offset),
                  side * offset,
                  0.);
}



std::optional<FinePlace>
CollidingSpheres::fine_place(const unsigned int sphere) const
{
  if (fine_mesh_size == 0.)
    return {};
  // Each flies along x until they are two radii apart.
  const double       along = std::sqrt(4. * radius * radius - offset * offset);
  const Tensor<1, 3> to_the_right({along, offset, 0.});
  const Tensor<1, 3> half = (sphere == 0 ? .5 : -.5) * to_the_right;
  return FinePlace{centre(sphere) + half, fine_mesh_size, degree};
}



CellNodes<3>
CollidingSpheres::make_whole_mesh(Triangulation<3> &mesh) const
{
  CellNodes<3>     nodes;
  Triangulation<3> balls[2];
  for (unsigned int sphere = 0; sphere < 2; ++sphere)
    {
      Triangulation<3> ball;
      if (cell_shape == "tetrahedra")
        {
          CellNodes<3> own;
          make_ball_of_tetrahedra(centre(sphere),
                                  radius,
                                  mesh_size[sphere],
                                  balls[sphere],
                                  is_curved ? &own : nullptr,
                                  fine_place(sphere));
          nodes.insert(nodes.end(), own.begin(), own.end());
        }
      else
        {
          make_ball_of_hexahedra(centre(sphere),
                                 radius,
                                 mesh_size[sphere],
                                 ball);
          GridGenerator::flatten_triangulation(ball, balls[sphere]);
        }
      // All of its surface can touch the other.
      for (const auto &cell : balls[sphere].active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(sphere + 1);
    }
  join_parts<3>({&balls[0], &balls[1]}, mesh);
  return nodes;
}



// ## The run
//
// A ball that flies with $v_c$ and spins with $\omega$ about its middle $c$ has
// the velocity $v_c + \omega \times (x - c)$.
Tensor<1, 3>
CollidingSpheres::initial_velocity(const Point<3> &x) const
{
  const unsigned int sphere = nearest_sphere(x);
  return Tensor<1, 3>({sphere == 0 ? speed : -speed, 0., 0.}) +
    cross_product_3d(spin[sphere], x - centre(sphere));
}



void
CollidingSpheres::run(RunFolder &folder)
{
  CellNodes<3> nodes;
  const auto   mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) { nodes = make_whole_mesh(whole); },
    folder.communicator);

  // Two parts in one mesh, and the surfaces that may touch: slave first, whose
  // nodes are the points $y$, then the master, whose faces are the triangles.
  const Material<3> elastic = material.make<3>();
  ImpactSetup<3>    setup{elastic};
  setup.degree = degree;
  if (is_curved)
    setup.geometry = make_curved_geometry(nodes, *mesh, folder.communicator);
  setup.parts.push_back({"left", elastic, material.density});
  setup.parts.push_back({"right", elastic, material.density});
  const types::boundary_id slave_id = slave == "left" ? 1 : 2;
  setup.pairs = {{"spheres", {slave_id}, {3U - slave_id}}};
  Impact<3> collision(impact, *mesh, setup, folder.communicator);
  folder.log(
    std::to_string(mesh->n_global_active_cells()) +
    (is_curved ? " curved cells, " : " cells, ") +
    std::to_string(collision.body.owned_indices().size()) + " unknowns, " +
    material.law + ", " + impact.contact.treatment +
    ", mu = " + to_text(impact.contact.values["Friction coefficient"]));

  std::vector<std::function<double(const Point<3> &)>> velocity;
  for (unsigned int c = 0; c < 3; ++c)
    velocity.emplace_back(
      [this, c](const Point<3> &x) { return initial_velocity(x)[c]; });
  const State initial_state =
    collision.state_in_motion(FunctionFromFunctionObjects<3>(velocity));

  // Energy, work and momenta of each sphere and of both, beside what every program
  // writes.
  ImpactLoop<3>        loop(impact.time,
                     collision,
                     {elastic, elastic},
                     {{slave_id, "spheres"}},
                     folder);
  const PartColumns<3> parts(collision.body,
                             collision.system,
                             elastic.linear.has_value(),
                             {"left", "right"});
  parts.add_to(loop);

  const State end = loop.run(initial_state);
  report(collision, parts, initial_state, end, loop.energy_ledger(), folder);
}



// ## Results
//
// The angular momentum of a sphere about its own centre is that about the
// origin less that of the centre. The position of the centre follows from
// products with translations: $m\, c \times e$ for each direction $e$.
Tensor<1, 3>
CollidingSpheres::own_angular_momentum(const unsigned int    sphere,
                                       const Impact<3>      &collision,
                                       const PartColumns<3> &parts,
                                       const State          &state) const
{
  const Momenta<3> &momenta = parts.momenta(sphere);
  const auto        along_x = collision.uniform(Tensor<1, 3>({1., 0., 0.})),
             along_y        = collision.uniform(Tensor<1, 3>({0., 1., 0.}));
  const double       mass   = momenta.linear(along_x)[0];
  const Tensor<1, 3> of_x   = momenta.angular(state.solution, along_x),
                     of_y   = momenta.angular(state.solution, along_y);
  const Tensor<1, 3> middle = Tensor<1, 3>({of_y[2], -of_x[2], of_x[1]}) / mass;
  return momenta.angular(state.solution, state.velocity) -
    cross_product_3d(middle, momenta.linear(state.velocity));
}



void
CollidingSpheres::report(Impact<3>            &collision,
                         const PartColumns<3> &parts,
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
  const auto translation = collision.uniform(Tensor<1, 3>({1., 0., 0.}));
  const auto velocity    = [&](const unsigned int sphere, const State &state) {
    const Momenta<3> &momenta = parts.momenta(sphere);
    return momenta.linear(state.velocity) / momenta.linear(translation)[0];
  };
  const std::string names[2] = {"left", "right"};
  for (unsigned int sphere = 0; sphere < 2; ++sphere)
    for (unsigned int c = 0; c < 3; ++c)
      print(std::string("velocity_") + "xyz"[c] + "_" + names[sphere],
            velocity(sphere, end)[c]);

  // The spin of a rigid sphere with the same angular momentum; linear bodies do not
  // turn.
  if (!material.is_linear())
    {
      std::vector<std::function<double(const Point<3> &)>> turning;
      for (unsigned int c = 0; c < 3; ++c)
        turning.emplace_back([this, c](const Point<3> &x) {
          const unsigned int sphere = nearest_sphere(x);
          return cross_product_3d(Tensor<1, 3>({0., 0., 1.}),
                                  Tensor<1, 3>(x - centre(sphere)))[c];
        });
      const State unit =
        collision.state_in_motion(FunctionFromFunctionObjects<3>(turning));
      for (unsigned int sphere = 0; sphere < 2; ++sphere)
        {
          const double inertia =
            own_angular_momentum(sphere, collision, parts, unit)[2];
          const Tensor<1, 3> angular =
            own_angular_momentum(sphere, collision, parts, end);
          for (unsigned int c = 0; c < 3; ++c)
            print(std::string("spin_") + "xyz"[c] + "_" + names[sphere],
                  angular[c] / inertia);
        }
    }

  // Along the line of the centres when the spheres first touch.
  const double       along = std::sqrt(4. * radius * radius - offset * offset);
  const Tensor<1, 3> line  = Tensor<1, 3>({along, offset, 0.}) / (2. * radius);
  print("restitution",
        -((velocity(1, end) - velocity(0, end)) * line) /
          ((velocity(1, begin) - velocity(0, begin)) * line));
  const std::vector<double> &first  = ledger.rows().front();
  const std::vector<double> &last   = ledger.rows().back();
  const auto                 column = [&](const std::string &name) {
    return ledger.column_number(name);
  };
  print("energy_left_over", last[column("energy")] / first[column("energy")]);
  for (const std::string name : {"momentum_x",
                                 "momentum_y",
                                 "momentum_z",
                                 "angular_momentum_x",
                                 "angular_momentum_y",
                                 "angular_momentum_z"})
    print("drift_" + name, last[column(name)] - first[column(name)]);
  double penetration = 0., force = 0.;
  for (const auto &row : ledger.rows())
    {
      penetration = std::max(penetration, row[column("penetration_spheres")]);
      force       = std::max(force, row[column("contact_force_spheres")]);
    }
  print("penetration", penetration);
  print("largest_force", force);
}



int
main(int argc, char **argv)
{
  return run_program<CollidingSpheres>(argc,
                                       argv,
                                       "colliding_spheres",
                                       "Two elastic spheres collide in 3D.");
}
