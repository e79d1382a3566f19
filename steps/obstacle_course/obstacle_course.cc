// SPDX-License-Identifier: LGPL-2.1-or-later

// # Obstacle course
//
// A disk or a block falls, slides or rolls, under its weight, on a rigid
// obstacle that may be curved and may move. In the benchmarks of papers A to C a
// rigid obstacle is a plane, and the gap is an affine function of the
// displacement. Here it is not, and the direction of the contact force turns
// while the body moves along the surface. The introduction of the program
// elastic_ball comes first, that of hyperelastic_ring has friction.
//
// ## The problem
//
// In the body
//
// $$ \rho\, \ddot u - \mathrm{Div}\, \Pi(u) = \rho\, b , $$
//
// with the first Piola-Kirchhoff stress $\Pi = F S$ (or $\sigma$, if the body
// is linear), and on its boundary
//
// $$ g = \phi(x + u, t), \qquad g \ge 0, \quad p \ge 0, \quad p\, g = 0, \qquad
//    |t| \le \mu p \;\text{ against the slip} . $$
//
// $\phi$ is the distance to the surface of the obstacle, positive outside.
//
// ## Weak form
//
// The force on a point acts along the gradient of $\phi$ where the point is,
// since that is how the gap changes with the displacement:
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int \Pi(u) : \nabla v \, dx
//    - \int_\Gamma p\; \nabla \phi(x + u, t) \cdot v \, ds
//    - \int_\Gamma t \cdot v_\tau \, ds = \int \rho\, b \cdot v \, dx . $$
//
// ## The scheme: a discrete gradient
//
// The midpoint scheme keeps energy because the work of the pressure over a step
// is pressure times the change of the gap. On a plane this holds automatically.
// On a curved surface the normal at the beginning of the step, at its end or in
// the middle gives a work with a small error in each step. So the force acts
// along a **discrete gradient** $D$ of the distance: a direction that depends
// on both positions $x_0$ and $x_1$ of the point, with
//
// $$ D \cdot (x_1 - x_0) = \phi(x_1) - \phi(x_0) $$
//
// exactly. For a circle around $c$, with $r = x - c$, it is
//
// $$ D = \frac{r_0 + r_1}{|r_0| + |r_1|} , $$
//
// since $|r_1|^2 - |r_0|^2 = (r_0 + r_1) \cdot (r_1 - r_0)$. It has no moment
// about $c$ either: a disk in a bowl keeps its energy and, without gravity, its
// angular momentum about the middle of the bowl
// (`lib/contact/obstacles/radial_distance.h`; the other shapes are beside it).
//
// A **moving obstacle** has a position and a rotation that are functions of
// time. The point is described in the frame of the obstacle, where the gap is
// again $\phi$ of one position: $D$ is computed there and rotated back. Of the
// work $p\, D \cdot$ (displacement increment) on the body a part is the change
// of the gap, and the rest is the work of the motion of the obstacle
// (`lib/contact/obstacles/rigid_obstacle.h`).
//
// ## One step of this program
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    - \sum_j w_j\, \big( p_j D_j(U_0, U_1) + t_j \big) = L, \qquad
//    \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} , $$
//
// where $p_j$ follows from the gaps $g_0$ and $g_1$ of the node by any
// treatment of elastic_ball, $t_j$ from the slip along the surface relative to
// the obstacle, as in hyperelastic_ring, and $L$ is the weight. During Newton's
// method $D$ turns with the end of the step, and so its matrix has the
// derivative $p\, \partial D / \partial x_1$ beside the stiffness of the law.
// Multiplied by $U_1 - U_0$:
//
//     E_new - E_old = work of gravity - work against contact and friction
//
// ## Examples
//
// Examples in `parameter_files/obstacle_course/` have solutions by hand:
//
//     block_slides, block_sticks   on an incline of tan(beta) = 1/2, with mu = 0.49
//                                  and 0.51: a = g (sin beta - mu cos beta), or 0
//     disk_slips, disk_rolls       there with mu = 0.15 and 0.18: a disk rolls with
//                                  a = 2/3 g sin(beta) where mu > tan(beta)/3, and
//                                  slips with the block's a otherwise
//     bowl                         a disk runs to and fro and keeps its energy
//     rising_plate                 a ball on a plate that is lifted
//     drum                         a body in a drum that turns and drags it along
//     folding_strip                a strip that falls on its end buckles, and touches
//                                  itself where it folds
//
// ## Run it
//
//     obstacle_course parameter_files/obstacle_course/default.prm
//     obstacle_course --print-parameters

#include <base/program.h>
#include <contact/obstacles/obstacle_parameters.h>
#include <contact/treatments/contact_sum.h>
#include <materials/material_parameters.h>
#include <output/obstacle_work.h>
#include <problems/clearance.h>
#include <problems/impact_loop.h>
#include <problems/thrown_body.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

using namespace dealii;
using namespace Ricochet;

class ObstacleCourse
{
public:
  ObstacleCourse();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  void
  make_grid(Triangulation<2> &triangulation) const;

  static constexpr types::boundary_id surface = 0;

  ImpactParameters      impact;
  MaterialParameters    material;
  ObstacleParameters<2> obstacle;

  std::string  body_shape = "disk";
  Point<2>     centre;
  double       radius = .5, width = 1., height = .5;
  double       angle            = 0.;
  unsigned int n_boundary_nodes = 64;
  Tensor<1, 2> initial_velocity;
  double       initial_spin = 0.;
  Tensor<1, 2> gravity;
  bool         touches_itself = false;
};



// ## Data
//
// By default, a soft disk that falls onto another one, which is rigid.
ObstacleCourse::ObstacleCourse()
  : centre(.1, 1.02)
  , gravity({0., -9.81})
{
  material.law                     = "neo-Hookean";
  material.plane_state             = "plane strain";
  material.density                 = 1000.;
  material.values["Young modulus"] = 1e6;
  material.values["Poisson ratio"] = .3;

  obstacle.shape  = "circle";
  obstacle.radius = .5;

  impact.time.final_time   = .5;
  impact.time.time_step    = 2e-3;
  impact.time.fields_every = 5;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment                        = "persistent contact";
  impact.contact.values["Compliance coefficient"] = 1e8;
  impact.contact.values["Tangential compliance"]  = 1e5;
  impact.contact.values["Augmentation"]           = 1e6;
  impact.contact.values["Nitsche gamma0"]         = 2e7;
  impact.contact.values["Penalty epsilon0"]       = 1e-7;
}



void
ObstacleCourse::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  material.add_parameters(prm);
  obstacle.add_parameters(prm);

  prm.enter_subsection("Body");
  prm.add_parameter("Shape",
                    body_shape,
                    "Shape of the body.",
                    Patterns::Selection("disk|block"));
  prm.add_parameter("Centre", centre, "Where its middle is at the start (m).");
  prm.add_parameter("Radius",
                    radius,
                    "Radius of the disk (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Width",
                    width,
                    "Width of the block (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Height",
                    height,
                    "Height of the block (m).",
                    Patterns::Double(1e-30));
  prm.add_parameter("Angle",
                    angle,
                    "Angle (rad) by which the body is turned at the start, "
                    "against the clock.");
  prm.add_parameter("Boundary nodes",
                    n_boundary_nodes,
                    "Number of nodes on the boundary: for a disk 8, 16, 32, "
                    "...; for a block the cells become squares as far as "
                    "possible.",
                    Patterns::Integer(8, 100000));
  prm.leave_subsection();

  prm.enter_subsection("Contact");
  prm.add_parameter(
    "Self",
    touches_itself,
    "Whether the boundary of the body also touches itself, by the "
    "same treatment as the obstacle.",
    Patterns::Bool());
  prm.leave_subsection();

  prm.enter_subsection("Start");
  prm.add_parameter("Initial velocity",
                    initial_velocity,
                    "Velocity of the middle at the start (m/s).");
  prm.add_parameter("Initial spin",
                    initial_spin,
                    "Angular velocity about the middle at the start (rad/s), "
                    "against the clock.");
  prm.add_parameter("Gravity", gravity, "Acceleration of gravity (m/s^2).");
  prm.leave_subsection();
}



void
ObstacleCourse::validate() const
{
  if (touches_itself)
    check_pair_combination(impact.contact,
                           scheme_traits(impact.scheme.name),
                           {/* is_self */ true});
  material.validate(2, impact.scheme.name);
  impact.validate(material.is_linear(), material.velocity_force());
  check_motions(scheme_traits(impact.scheme.name),
                {{surface, obstacle.make(impact.time.final_time)}});
  impact.check_size(2. * n_boundary_nodes * n_boundary_nodes / 8., 2);
  Triangulation<2> triangulation;
  make_grid(triangulation);
}



std::vector<UnusedParameter>
ObstacleCourse::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  for (const auto &own :
       {material.unused_parameters(), obstacle.unused_parameters()})
    unused.insert(unused.end(), own.begin(), own.end());
  const auto need = [&](const std::string &shape, const std::string &name) {
    if (body_shape != shape)
      unused.push_back(
        {"Body/" + name, shape + "; Body/Shape is " + body_shape});
  };
  need("disk", "Radius");
  need("block", "Width");
  need("block", "Height");
  return unused;
}



// ## Mesh
void
ObstacleCourse::make_grid(Triangulation<2> &triangulation) const
{
  if (body_shape == "disk")
    make_disk_of_quadrilaterals(Point<2>(),
                                radius,
                                n_boundary_nodes,
                                triangulation);
  else
    {
      // Squares, or nearly so, and the number of nodes on the boundary.
      const double       size    = 2. * (width + height) / n_boundary_nodes;
      const unsigned int n_up    = std::max(1., std::round(height / size));
      const unsigned int n_along = std::max(1., n_boundary_nodes / 2. - n_up);
      GridGenerator::subdivided_hyper_rectangle(
        triangulation,
        {n_along, n_up},
        Point<2>(-.5 * width, -.5 * height),
        Point<2>(.5 * width, .5 * height));
    }
  GridTools::rotate(angle, triangulation);
  GridTools::shift(centre, triangulation);
}



// ## The run
void
ObstacleCourse::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_grid(triangulation);

  // Mesh and data make the equation of motion: mass, bulk, contact, scheme.
  // An obstacle consists of its shape, which gives $\phi$ and $D$, and its
  // motion. The kinematics of a plane at rest, whose $D$ is constant, and of
  // any other obstacle are two classes behind one interface
  // (`lib/contact/kinematics/contact_kinematics.h`), and treatments do not
  // distinguish them.
  const Material<2> elastic = material.make<2>();
  ImpactSetup<2>    setup{elastic};
  setup.density   = material.density;
  setup.obstacles = {{surface, obstacle.make(impact.time.final_time)}};
  setup.gravity   = gravity;
  std::map<types::boundary_id, std::string> contacts = {{surface, "obstacle"}};
  if (touches_itself)
    {
      setup.pairs = {touching_itself({surface})};
      contacts[ContactSum::id_of(/* between surfaces */ 1, surface)] = "itself";
    }
  Impact<2> course(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " cells, " + std::to_string(course.body.owned_indices().size()) +
             " unknowns, " + material.law + ", " + impact.contact.treatment +
             ", " + impact.scheme.name + ", obstacle: " + obstacle.shape);

  // The body moves as a rigid one: velocity of the centre, and spin about it,
  // $v = v_c + \omega\, e_3 \times (x - c)$.
  const State initial_state =
    course.state_in_motion(FunctionFromFunctionObjects<2>(
      {[&](const Point<2> &x) {
         return initial_velocity[0] - initial_spin * (x[1] - centre[1]);
       },
       [&](const Point<2> &x) {
         return initial_velocity[1] + initial_spin * (x[0] - centre[0]);
       }}));

  // The time loop writes energies and contact; momenta give the motion of the
  // centre, and the spin. The work of a moving obstacle is computed a second
  // time, from force, moment and motion: an independent value of that in the
  // balance.
  ImpactLoop<2>    loop(impact.time, course, {elastic}, contacts, folder);
  const Momenta<2> momenta(course.body,
                           course.system.mass_matrix(),
                           /* small strains */ elastic.linear.has_value());
  add_momentum_columns(momenta, course.body, loop);
  const double mass = momenta.linear(course.uniform(Tensor<1, 2>({1., 0.})))[0];
  loop.add_column("centre_displacement_x", "m", [&](const State &state) {
    return momenta.linear(state.solution)[0] / mass;
  });

  const ObstacleWork<2> obstacle_work(course.body, {course.obstacles});
  loop.obstacle_work = obstacle_work;

  loop.run(initial_state);
}



int
main(int argc, char **argv)
{
  return run_program<ObstacleCourse>(
    argc,
    argv,
    "obstacle_course",
    "A disk or a block on a rigid obstacle that may be curved "
    "and may move.");
}
