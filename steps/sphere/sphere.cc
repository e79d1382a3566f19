// SPDX-License-Identifier: LGPL-2.1-or-later

// # The sphere
//
// An elastic ball of diameter 40 falls from a height of 2 on a rigid foundation,
// the half space below x_3 = 0:
//
//     rho u_tt - div sigma(u) = rho g             in the ball,
//     gap >= 0, p >= 0, p gap = 0                 on the lower half, with
//     gap = x_3 + u_3, p the contact pressure,
//     u = 0, u_t = 0                              at t = 0,
//
// with linear elasticity and g = (0, 0, -0.1). All numbers are without unit, as in
// paper C, section 4.3, of which this is the benchmark in three dimensions.
//
// The soft sphere (lambda = mu = 20) is squashed to some two thirds of its height
// and takes twenty units of time for its first bounce. The hard one (lambda = mu =
// 30000, hard.prm) touches a spot of a few elements for one unit of time.
//
// Gravity makes a load, and what a scheme should keep is the energy (modified by
// Nitsche's terms) less the work of the load: the columns `modified_energy` and
// `external_work` of energy.csv.
//
// The body is linear, so that the matrix of its equation of motion is the same in
// all steps: it is factored once, and contact is a correction of low rank (see
// lib/solvers/low_rank_correction.h). Large bodies, and those on several ranks, are
// solved by multigrid; the end of the log says which.
//
// Run it as
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
#include <output/vtu_series.h>
#include <problems/ball_mesh.h>
#include <problems/impact.h>

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
  /// Where the middle of the ball is at the start (m).
  Point<3>
  centre() const
  {
    return Point<3>(0., 0., radius + initial_gap);
  }

  /// Where it will touch the foundation.
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



// ### Data
//
// The soft sphere with Nitsche's method and Crank-Nicolson.
Sphere::Sphere()
  : gravity({0., 0., -.1})
{
  impact.time.final_time       = 60.;
  impact.time.time_step        = .25;
  impact.time.fields_every     = 4;
  impact.scheme.name           = "Crank-Nicolson";
  impact.contact.treatment     = "Nitsche";
  impact.contact.nitsche_theta = 1.;
  // 100 mu, as the paper has it; the penalty parameter is its inverse.
  impact.contact.nitsche_gamma_0        = 2000.;
  impact.contact.augmentation           = 2000.;
  impact.contact.penalty_epsilon_0      = 5e-4;
  impact.contact.compliance_coefficient = 2000.;
  impact.contact.tangential_compliance  = 2000.;
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
    "In a file the order of the elements tells.");
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
  // Reading the mesh is the check of its file. A mesh that is to be made has some
  // 3.6 unknowns in each cube of the mesh size with degree 1 and 27 with degree 2.
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



// ### Mesh
//
// Each rank keeps its part of the mesh only. A file, or tetrahedra by Gmsh, are
// taken as a whole by the first rank, cut and handed out; hexahedra are refined
// where they are.
//
// A ball with straight edges lacks what is between its faces and the sphere: with
// h = 4 its volume is 1.4 % too small, and it touches the foundation with a vertex or
// a flat facet, which the hard sphere feels. Curved cells have a node on each edge
// besides, on the sphere where the edge is on the surface: the geometry is then as
// good as displacements of degree 2 are.
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



// ### The run
void
Sphere::run(RunFolder &folder)
{
  const Mesh mesh = make_mesh(folder.communicator);

  // Mesh and data make the equation of motion: mass, bulk, contact, scheme.
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

  // It starts undeformed.
  const State initial_state = sphere.state_in_flight(initial_velocity);

  // The time loop writes energies and contact; the lowest point shows how the
  // sphere vibrates.
  TimeLoop           loop(impact.time,
                folder,
                sphere.system,
                *sphere.scheme,
                {{BallBoundary::lower_half, "foundation"}});
  const NodeProbe<3> lowest(sphere.body, Point<3>(0., 0., initial_gap));
  loop.add_column("lowest_displacement", "m", [&](const State &state) {
    return lowest.value(state.solution, 2);
  });
  loop.add_column("lowest_velocity", "m/s", [&](const State &state) {
    return lowest.value(state.velocity, 2);
  });

  VtuSeries<3> fields(sphere.body,
                      material,
                      *sphere.contact,
                      sphere.obstacles,
                      folder);
  loop.write_fields = [&](const State &state, const unsigned int step) {
    fields.write(state, step);
  };

  loop.run(initial_state);
}



int
main(int argc, char **argv)
{
  Sphere program;
  return run_program(argc,
                     argv,
                     {"sphere",
                      "An elastic sphere falls on a rigid foundation (paper C, "
                      "section 4.3).",
                      [&](ParameterHandler &prm) {
                        program.add_parameters(prm);
                      },
                      [&]() { program.validate(); },
                      [&](RunFolder &folder) { program.run(folder); },
                      [&]() { return program.unused_parameters(); }});
}
