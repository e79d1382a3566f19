// SPDX-License-Identifier: LGPL-2.1-or-later

// # The sphere
//
// An elastic ball of diameter 40 falls from a height of 2 on a rigid foundation, the half space
// below $x_3 = 0$, and bounces: the benchmark of paper C, section 4.3, without units as there. (The
// height is our reading of its centre at (0, 0, 2), which would be 18 deep in the foundation.)
// It has the contact treatments and the time schemes of the
// bars (begin with the program bar_sd) on a body with some ten thousand
// unknowns, where the cost of a step begins to matter.
//
// ## The problem
//
// In the ball
//
// $$ \rho\, \ddot u - \mathrm{div}\, \sigma(u) = \rho\, b , \qquad
//    \sigma = \lambda \,\mathrm{tr}(\varepsilon)\, I + 2 \mu\, \varepsilon , $$
//
// with the acceleration of gravity $b = (0, 0, -0.1)$, from rest (C (1)). On
// the lower half of its surface (the paper: "the lower part"), with the gap
// $g = x_3 + u_3$ and the contact pressure $p = -\sigma_n$,
//
// $$ g \ge 0, \qquad p \ge 0, \qquad p\, g = 0 . $$
//
// The soft sphere ($\lambda = \mu = 20$) is squashed to some two thirds of its
// height and takes twenty units of time for its first bounce. The hard one
// ($\lambda = \mu = 30000$, hard.prm) touches a spot of a few elements for one
// unit of time.
//
// ## Weak form
//
// Nitsche's method for the whole surface (C (8), (9); in our signs, with
// $p(v) = -\sigma_n(v)$, the normal $\nu$ of the foundation,
// $\gamma = \gamma_0 / h_T$ and $q = p(u) - \gamma g$): for all $v$
//
// $$ \int_\Omega \rho\, \ddot u \cdot v \, dx
//    + \int_\Omega \sigma(u) : \varepsilon(v) \, dx
//    - \int_\Gamma \frac{\theta}{\gamma}\, p(u)\, p(v) \, ds
//    + \int_\Gamma \frac{1}{\gamma}\, [q]_+
//      \big( \theta\, p(v) - \gamma\, \nu \cdot v \big) \, ds
//    = \int_\Omega \rho\, b \cdot v \, dx . $$
//
// The integrals over $\Gamma$ are sums over quadrature points, in each of which
// `lib/contact/laws/nitsche.h` is evaluated once. The **proximal augmented
// Lagrangian** (C (18) to (20), `lib/contact/laws/augmented_lagrangian.h`) is
// the same with a multiplier $\lambda_h$ in place of $p(u)$, which has the
// equation
//
// $$ \int_\Gamma \frac{1}{\gamma}
//    \big( [\lambda_h - \gamma g]_+ - \lambda_h \big) \, \mu_h \, ds = 0
//    \quad\text{for all } \mu_h . $$
//
// Gravity makes a load, and what a scheme should keep is the modified energy
// less the work of the load: the columns `modified_energy` and `external_work`
// of energy.csv.
//
// ## One step of this program
//
// As in bar_sd: with Crank-Nicolson and HHT (C (24)) one nonlinear system
//
// $$ \frac{1}{\beta \Delta t^2} M (U_1 - \hat U)
//    + (1 - \alpha) \big( K U_1 + F_c(U_1) - L \big)
//    + \alpha \big( K U_0 + F_c(U_0) - L \big) = 0, $$
//
// $$ \hat U = U_0 + \Delta t\, V_0 + \Delta t^2 (\tfrac12 - \beta) A_0, \qquad
//    A_1 = \frac{U_1 - \hat U}{\beta \Delta t^2}, \qquad
//    V_1 = V_0 + \Delta t \big( (1 - \gamma) A_0 + \gamma A_1 \big) $$
//
// ($\gamma$ of the scheme here), with TR-BDF2 (C (33)) two. Algorithm 1 of the
// paper prints a factor $1/(2 \beta \Delta t^2)$, which should be
// $1/(\beta \Delta t^2)$.
//
// The **Nitsche-hybrid** scheme (C (38), (39)) is the midpoint rule with a rule
// of its own for the positive part: the mean of the states where the step
// begins in contact, the mean of the positive parts where it does not,
//
// $$ H(q_0) \, \Big[ \frac{q_0 + q_1}{2} \Big]_+
//    + H(-q_0) \, \frac{[q_0]_+ + [q_1]_+}{2}, \qquad H(0) = \tfrac12 , $$
//
// and with it $E_N$ never grows. (As printed, (39) has the two weights
// exchanged and $w$ for $P_N(w)$, and $E_N$ does grow:
// `lib/contact/laws/nitsche_two_point.h`.)
//
// ## Cost of a step
//
// The matrix $\frac{1}{\beta \Delta t^2} M + (1 - \alpha) K$ is the same in all
// steps: it is factored once. Contact adds to it in the quadrature points where
// $q > 0$, so that the matrix of an iteration is the factored one and a
// correction of low rank $U C V^T$, with one column for each such point, and
// the formula of Sherman, Morrison and Woodbury solves with it at the price of
// a small dense system (`lib/solvers/contact_schur_complement.h`). Large bodies
// are solved by multigrid, on several ranks sooner than on one; the end of the
// log names the solver.
//
// ## Run it
//
//     sphere parameter_files/sphere/default.prm
//     sphere parameter_files/sphere/hard.prm --set "Time/Scheme=TR-BDF2"
//     mpirun -n 2 sphere parameter_files/sphere/default.prm
//     sphere --help

#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/program.h>
#include <discretization/distributed_mesh.h>
#include <output/node_probe.h>
#include <problems/ball_mesh.h>
#include <problems/impact_loop.h>

#include <deal.II/distributed/tria.h>

using namespace dealii;
using namespace Ricochet;

namespace
{
  constexpr double radius = 20.;
} // namespace



class Sphere
{
public:
  Sphere();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  /// Initial position of the centre of the ball (m).
  Point<3>
  centre() const
  {
    return Point<3>(0., 0., radius + initial_gap);
  }

  /// The point that will touch the foundation.
  std::optional<FinePlace>
  fine_place() const
  {
    if (fine_mesh_size == 0.)
      return {};
    return FinePlace{centre() - Tensor<1, 3>({0., 0., radius}),
                     fine_mesh_size,
                     degree};
  }

  /// @return the nodes of curved cells, nothing for straight ones.
  CellNodes<3>
  make_whole_mesh(Triangulation<3> &mesh) const;

  /// A mesh and the geometry of its cells, null if they are straight.
  struct Mesh
  {
    std::unique_ptr<Triangulation<3>> cells;
    std::shared_ptr<const Mapping<3>> geometry;
  };

  Mesh
  make_mesh(const MPI_Comm communicator) const;

  ImpactParameters impact;
  std::string      mesh_file;
  std::string      cell_shape     = "tetrahedra";
  double           mesh_size      = 4.;
  double           fine_mesh_size = 0.;
  unsigned int     degree         = 2;
  bool             is_curved      = false;
  double           lambda = 20., mu = 20., density = 1.;
  double           initial_gap = 2.;
  Tensor<1, 3>     gravity, initial_velocity;
};



// ## Data
//
// The soft sphere with Nitsche's method and Crank-Nicolson.
Sphere::Sphere()
  : gravity({0., 0., -.1})
{
  impact.time.final_time                 = 60.;
  impact.time.time_step                  = .25;
  impact.time.fields_every               = 4;
  impact.scheme.name                     = "Crank-Nicolson";
  impact.contact.treatment               = "Nitsche";
  impact.contact.values["Nitsche theta"] = 1.;
  // $\gamma_0 = 100\, \mu$, as the paper has it; the penalty parameter
  // $\epsilon_0$ is its inverse.
  impact.contact.values["Nitsche gamma0"]         = 2000.;
  impact.contact.values["Augmentation"]           = 2000.;
  impact.contact.values["Penalty epsilon0"]       = 5e-4;
  impact.contact.values["Compliance coefficient"] = 2000.;
  impact.contact.values["Tangential compliance"]  = 2000.;
}



void
Sphere::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  prm.enter_subsection("Mesh");
  prm.add_parameter(
    "File",
    mesh_file,
    "Mesh file of Gmsh (format 2.2 or 4.1, ASCII) whose physical "
    "surface 1 is what can touch the foundation; empty to make a "
    "mesh. In a parameter file the path counts from the folder of that file.",
    Patterns::FileName());
  prm.add_parameter("Cells",
                    cell_shape,
                    "Shape of the cells, when no file is given.",
                    Patterns::Selection("tetrahedra|hexahedra"));
  prm.add_parameter("Mesh size",
                    mesh_size,
                    "Length of an element, when no file is given.",
                    Patterns::Double(.1, 20.));
  prm.add_parameter(
    "Mesh size where it touches",
    fine_mesh_size,
    "Length of elements around the place where the ball first touches the "
    "foundation, over a dozen of them (six with degree 2); from there on they grow. Only for tetrahedra, "
    "when no file is given. 0: as everywhere (m).",
    Patterns::Double(0.));
  prm.add_parameter("Degree",
                    degree,
                    "Polynomial degree of the displacement.",
                    Patterns::Integer(1, 2));
  prm.add_parameter(
    "Curved cells",
    is_curved,
    "Whether the edges of cells are curved, with the nodes of the "
    "surface on the sphere, when no file is given. Takes degree 2. "
    "In a file the order of the elements is used.");
  prm.leave_subsection();
  prm.enter_subsection("Material");
  prm.add_parameter("Lame lambda",
                    lambda,
                    "First Lamé parameter (Pa).",
                    Patterns::Double(0.));
  prm.add_parameter("Lame mu",
                    mu,
                    "Shear modulus (Pa).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Density",
                    density,
                    "Mass density (kg/m^3).",
                    Patterns::Double(1e-30));
  prm.leave_subsection();
  prm.enter_subsection("Start");
  prm.add_parameter("Initial gap",
                    initial_gap,
                    "Distance from the foundation, when no file is given (m).",
                    Patterns::Double(0.));
  prm.add_parameter("Gravity", gravity, "Acceleration of gravity (m/s^2).");
  prm.add_parameter("Initial velocity",
                    initial_velocity,
                    "Velocity of the whole body at the start (m/s).");
  prm.leave_subsection();
}



void
Sphere::validate() const
{
  impact.validate();
  if (is_curved && degree == 1)
    throw InputError("Mesh/Curved cells = true takes Mesh/Degree = 2.");
  // The check of the file is part of reading the mesh. A mesh that is to be
  // made has some 3.6 unknowns in each cube of the mesh size with degree 1 and
  // 27 with degree 2.
  if (!mesh_file.empty())
    on_first_rank(MPI_COMM_WORLD, [&]() {
      Triangulation<3> mesh;
      if (!make_whole_mesh(mesh).empty() && degree == 1)
        throw InputError("The mesh '" + mesh_file +
                         "' has elements of second " +
                         "order, which take Mesh/Degree = 2.");
      double lowest = 0.;
      for (const auto &cell : mesh.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->boundary_id() == BallBoundary::lower_half)
            for (const unsigned int v : face->vertex_indices())
              lowest = std::min(lowest, face->vertex(v)[2]);
      if (lowest < -1e-3 * radius)
        throw InputError("The mesh '" + mesh_file + "' starts inside the " +
                         "obstacle: it reaches " + to_text(-lowest) +
                         " m below the foundation at x_3 = 0. Move it up.");
    });
  else
    {
      if (fine_mesh_size > 0. && cell_shape != "tetrahedra")
        throw InputError(
          "Mesh/Mesh size where it touches is for Mesh/Cells = "
          "tetrahedra.");
      if (fine_mesh_size > mesh_size)
        throw InputError(
          "Mesh/Mesh size where it touches = " + to_text(fine_mesh_size) +
          " m is larger than Mesh/Mesh "
          "size = " +
          to_text(mesh_size) + " m.");
      double volume = std::pow(radius / mesh_size, 3);
      if (const auto fine = fine_place())
        volume += std::pow(fine->n_elements(), 3);
      impact.check_size(4. / 3. * numbers::PI * volume *
                          (degree == 1 ? 3.6 : 27.),
                        3);
    }
}



std::vector<UnusedParameter>
Sphere::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  if (!mesh_file.empty())
    for (const std::string name : {"Mesh/Cells",
                                   "Mesh/Mesh size",
                                   "Mesh/Mesh size where it touches",
                                   "Mesh/Curved cells",
                                   "Start/Initial gap"})
      unused.push_back(
        {name, "meshes that are made; Mesh/File is " + mesh_file});
  return unused;
}



// ## Mesh
//
// Each rank keeps its part of the mesh only. A file, or tetrahedra by Gmsh, are
// read or made as a whole by the first rank, partitioned and distributed;
// hexahedra are refined in parallel.
//
// A ball with straight edges lacks what is between its faces and the sphere:
// with $h = 4$ its volume is 1.4 % too small, and it touches the foundation
// with a vertex or a flat facet, which the hard sphere feels. Curved cells have
// a node on each edge besides, on the sphere where the edge is on the surface:
// the geometry is then as good as displacements of degree 2 are.
CellNodes<3>
Sphere::make_whole_mesh(Triangulation<3> &mesh) const
{
  if (!mesh_file.empty())
    return read_ball(mesh_file, mesh);
  CellNodes<3> nodes;
  make_ball_of_tetrahedra(centre(),
                          radius,
                          mesh_size,
                          mesh,
                          is_curved ? &nodes : nullptr,
                          fine_place());
  return nodes;
}



Sphere::Mesh
Sphere::make_mesh(const MPI_Comm communicator) const
{
  Mesh mesh;
  if (!mesh_file.empty() || cell_shape == "tetrahedra")
    {
      CellNodes<3> nodes;
      mesh.cells = distribute_mesh<3>(
        [&](Triangulation<3> &whole) { nodes = make_whole_mesh(whole); },
        communicator);
      if (Utilities::MPI::broadcast(communicator, !nodes.empty()))
        mesh.geometry = make_curved_geometry(nodes, *mesh.cells, communicator);
      return mesh;
    }
  auto cells =
    std::make_unique<parallel::distributed::Triangulation<3>>(communicator);
  make_ball_of_hexahedra(centre(), radius, mesh_size, *cells);
  if (is_curved)
    mesh.geometry = make_curved_geometry(*cells);
  mesh.cells = std::move(cells);
  return mesh;
}



// ## The run
void
Sphere::run(RunFolder &folder)
{
  const Mesh mesh = make_mesh(folder.communicator);

  // Mesh and data make the equation of motion: $M$, $K$, $F_c$ and $L$ of "one
  // step of this program", and the scheme. `foundation_below` is the half space
  // $x_3 < 0$: its distance function makes $g$, its normal the direction of the
  // force.
  const Material<3> material(LinearElastic{lambda, mu});
  ImpactSetup<3>    setup{material};
  setup.density   = density;
  setup.degree    = degree;
  setup.geometry  = mesh.geometry;
  setup.obstacles = foundation_below<3>(BallBoundary::lower_half);
  setup.gravity   = gravity;
  Impact<3> sphere(impact, *mesh.cells, setup, folder.communicator);

  folder.log(std::to_string(mesh.cells->n_global_active_cells()) +
             (mesh.geometry ? " curved cells, " : " cells, ") +
             std::to_string(sphere.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", " +
             impact.scheme.name + ", " + impact.mass + " mass");

  // The undeformed ball at rest.
  const State initial_state = sphere.state_in_flight(initial_velocity);

  // The time loop writes energies and contact: the force
  // $\int_\Gamma [q]_+ \, ds$, the gap, both pressures. The lowest point shows
  // how the sphere vibrates.
  ImpactLoop<3>      loop(impact.time,
                     sphere,
                     {material},
                     {{BallBoundary::lower_half, "foundation"}},
                     folder);
  const NodeProbe<3> lowest(sphere.body, Point<3>(0., 0., initial_gap));
  loop.add_column("lowest_displacement", "m", [&](const State &state) {
    return lowest.value(state.solution, 2);
  });
  loop.add_column("lowest_velocity", "m/s", [&](const State &state) {
    return lowest.value(state.velocity, 2);
  });

  loop.run(initial_state);
}



int
main(int argc, char **argv)
{
  return run_program<Sphere>(
    argc,
    argv,
    "sphere",
    "An elastic sphere falls on a rigid foundation (paper C, "
    "section 4.3).");
}
