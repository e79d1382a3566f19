// SPDX-License-Identifier: LGPL-2.1-or-later

// # A disk, step by step
//
// The program elastic_ball (paper A, section 6.1) with one material, one treatment of contact
// and one time scheme, all of them written out: a disk of linear elasticity
// flies at a rigid foundation, and a step can be read in one file. Mesh,
// material and energy table are the library's, the rest is deal.II. The program
// gives the numbers of elastic_ball to Newton's tolerance
// (`tests/integration/test_by_hand.py`). That one has all treatments, runs on
// several processors, and is faster, because it factors the matrix of the body
// once.
//
// ## The equations
//
// With the displacement $U$ and the velocity $V$ of the nodes, a step of the midpoint scheme from
// $(U_0, V_0)$ to $(U_1, V_1)$ is (A (3.2), (3.9))
//
// $$ \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2}, \qquad
//    M \frac{V_1 - V_0}{\Delta t} + K \frac{U_0 + U_1}{2} + F_c = 0, \qquad
//    F_c = - \sum_j w_j\, p_j N_j . $$
//
// The sum goes over the nodes of the circle: $w_j$ is the length of circle that belongs to the
// node, $N_j$ has the normal of the foundation in the rows of its displacement, and the pressure
// $p_j$ follows from its gap $g_j = x_{j,2} + u_{j,2}$ at both ends of the step. Improved normal
// compliance (A (3.10), (3.11), here with the exponent 2) takes the quotient of differences of
// the energy $\tfrac{c_\nu}{2} [\delta]_+^2$ of a spring, $\delta = -g$ being the penetration:
//
// $$ p = \frac{c_\nu}{2}\, \frac{[\delta_1]_+^2 - [\delta_0]_+^2}{\delta_1 - \delta_0} . $$
//
// Multiply the equation of motion by $U_1 - U_0$: the energy
// $E = \tfrac12 V \cdot M V + \tfrac12 U \cdot K U$ changes by $- F_c \cdot (U_1 - U_0)$ (A
// proposition 3.1), that is by minus the change of the springs' energy. So both together are
// constant, with any step.
//
// ## Run it
//
//     disk_step_by_step parameter_files/disk_step_by_step/default.prm
//     elastic_ball parameter_files/elastic_ball/impact_1ms.prm
//
// do the same. The disk has 15.7016 MJ, and `modified_energy`, with that of the springs, keeps
// them: the column `balance_residual` is 1e-12 at most.

#include <base/exceptions.h>
#include <base/program.h>
#include <materials/linear_elastic.h>
#include <output/energy_ledger.h>
#include <problems/round_meshes.h>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>
#include <deal.II/lac/sparse_direct.h>
#include <deal.II/lac/sparse_matrix.h>
#include <deal.II/lac/vector.h>

#include <limits>
#include <map>

using namespace dealii;
using namespace Ricochet;

struct DiskStepByStep
{
  // ## Parameters, with the names that they have in elastic_ball
  unsigned int n_nodes = 1580, n_boundary_nodes = 128;
  double       rho = 1000., E = 1e10, nu = .35; // kg/m^3, Pa
  double       initial_gap = .055;              // m
  Tensor<1, 2> initial_velocity{{0., -10.}};    // m/s
  double       c_nu       = 2.6e12;             // Pa/m
  double       final_time = .06, dt = 1e-3;     // s
  double       tolerance  = 1e-10;
  unsigned int max_solves = 30, log_every = 1;

  void
  add_parameters(ParameterHandler &prm)
  {
    const auto add = [&](std::string name, auto &x, auto text, auto pattern) {
      prm.enter_subsection(name.substr(0, name.find('/')));
      prm.add_parameter(name.substr(name.find('/') + 1), x, text, pattern);
      prm.leave_subsection();
    };
    using Number = Patterns::Double;
    const Number positive(1e-30), gap(0.), ratio(-.99, .499), part(1e-15, 1e-6);
    const Patterns::Integer vertices(8, 100000), solves(1, 1000), lines(0);
    const Patterns::List    vector(Number(), 2, 2);
    add("Mesh/Nodes", n_nodes, "All vertices.", vertices);
    add("Mesh/Boundary nodes", n_boundary_nodes, "On the circle.", vertices);
    add("Material/Density", rho, "Mass density (kg/m^3).", positive);
    add("Material/Young modulus", E, "Young's modulus (Pa).", positive);
    add("Material/Poisson ratio", nu, "Of plane stress.", ratio);
    add("Start/Initial gap", initial_gap, "Of the lowest point (m).", gap);
    add("Start/Initial velocity",
        initial_velocity,
        "Velocity of the whole disk (m/s).",
        vector);
    add("Contact/Compliance coefficient", c_nu, "c_nu (Pa/m).", positive);
    add("Time/Final time", final_time, "End of the run (s).", positive);
    add("Time/Time step", dt, "Length of a step (s).", positive);
    add("Newton/Tolerance", tolerance, "Residual over forces.", part);
    add("Newton/Maximum iterations",
        max_solves,
        "Linear solves before the run stops.",
        solves);
    add("Output/Log every",
        log_every,
        "Number of steps between lines of the log; 0 for none.",
        lines);
  }

  void
  validate() const
  {
    if (final_time > 1e8 * dt || dt > (1. + 1e-9) * final_time)
      throw InputError("The run must have between one and 1e8 time steps.");
    // The construction of the mesh checks its parameters.
    Triangulation<2> mesh;
    make_grid(mesh);
  }

  // ## Mesh
  //
  // The reference position is that at the start: the displacement begins with zero.
  void
  make_grid(Triangulation<2> &mesh) const
  {
    const double   radius = 10.; // m
    const Point<2> centre(0., radius + initial_gap);
    make_disk_of_triangles(centre, radius, n_boundary_nodes, n_nodes, mesh);
  }

  // ## Mass and stiffness
  //
  // $M$ and $K$ are $\int \rho\, \varphi_i \cdot \varphi_j$ and
  // $\int \sigma(\varphi_i) : \varepsilon(\varphi_j)$ with linear triangles, for which the rule is
  // exact. Plane stress is in the first Lamé parameter.
  using Field = dealii::Vector<double>;
  Triangulation<2>     mesh;
  const FESystem<2>    fe{FE_SimplexP<2>(1), 2};
  DoFHandler<2>        dof_handler{mesh};
  SparsityPattern      pattern;
  SparseMatrix<double> mass, stiffness, tangent;

  void
  assemble_body()
  {
    dof_handler.distribute_dofs(fe);
    DynamicSparsityPattern dsp(dof_handler.n_dofs());
    DoFTools::make_sparsity_pattern(dof_handler, dsp);
    pattern.copy_from(dsp);
    for (SparseMatrix<double> *matrix : {&mass, &stiffness, &tangent})
      matrix->reinit(pattern);

    const auto material =
      LinearElastic::from_young(E, nu).in_plane(PlaneState::plane_stress);
    const MappingFE<2>                   mapping{FE_SimplexP<2>(1)};
    const QGaussSimplex<2>               rule(2);
    FEValues<2>                          values(mapping,
                       fe,
                       rule,
                       update_values | update_gradients | update_JxW_values);
    const FEValuesExtractors::Vector     u(0);
    const unsigned int                   n = fe.n_dofs_per_cell();
    FullMatrix<double>                   cell_mass(n, n), cell_stiffness(n, n);
    std::vector<types::global_dof_index> indices(n);
    for (const auto &cell : dof_handler.active_cell_iterators())
      {
        values.reinit(cell);
        cell_mass = cell_stiffness = 0.;
        for (const unsigned int q : values.quadrature_point_indices())
          for (const unsigned int i : values.dof_indices())
            {
              const auto momentum = rho * values[u].value(i, q) * values.JxW(q);
              const auto stress =
                material.stress(values[u].symmetric_gradient(i, q)) *
                values.JxW(q);
              for (const unsigned int j : values.dof_indices())
                {
                  cell_mass(i, j) += momentum * values[u].value(j, q);
                  cell_stiffness(i, j) +=
                    stress * values[u].symmetric_gradient(j, q);
                }
            }
        cell->get_dof_indices(indices);
        mass.add(indices, cell_mass);
        stiffness.add(indices, cell_stiffness);
      }
  }

  // ## Contact
  //
  // The nodes of the circle by the index of their vertical displacement: each has half of the
  // length of either edge that it belongs to.
  struct Node
  {
    double height = 0., weight = 0.; // m
  };
  std::map<types::global_dof_index, Node> circle;

  void
  make_circle()
  {
    for (const auto &cell : dof_handler.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          for (const unsigned int v : face->vertex_indices())
            {
              Node &node = circle[face->vertex_dof_index(v, /* component */ 1)];
              node.height = face->vertex(v)[1];
              node.weight += .5 * face->measure();
            }
  }

  // The law: pressure (Pa) and its derivative with respect to $\delta_1$ (Pa/m). With
  // penetration at both ends of the step the quotient is the sum of both, and is not formed of
  // differences of numbers that may be equal.
  std::pair<double, double>
  pressure(const double old_delta, const double delta) const
  {
    const double old_part = std::max(old_delta, 0.), part = std::max(delta, 0.);
    if (old_part == 0. && part == 0.)
      return {0., 0.};
    if (old_part > 0. && part > 0.)
      return {.5 * c_nu * (old_part + part), .5 * c_nu};
    const double difference = delta - old_delta;
    const double quotient   = (part * part - old_part * old_part) / difference;
    return {.5 * c_nu * quotient,
            .5 * c_nu * (2. * part - quotient) / difference};
  }

  // Force and tangent of all nodes, and the sums for the table.
  Field  U_0, U, V, F_c; // m, m, m/s, N
  double spring_energy = 0., contact_force = 0., smallest_gap = 0.; // J, N, m

  void
  assemble_contact()
  {
    spring_energy = contact_force = 0.;
    smallest_gap                  = std::numeric_limits<double>::max();
    for (const auto &[dof, node] : circle)
      {
        const double old_gap       = node.height + U_0(dof),
                     gap           = node.height + U(dof);
        const auto [p, derivative] = pressure(-old_gap, -gap);
        F_c(dof)                   = -p * node.weight;
        tangent.add(dof, dof, derivative * node.weight);

        contact_force += p * node.weight;
        const double part = std::max(-gap, 0.);
        spring_energy += .5 * c_nu * part * part * node.weight;
        smallest_gap = std::min(smallest_gap, gap);
      }
  }

  // ## Newton's method
  //
  // The first equation of the scheme gives $V_1$ by $U_1$; the second one is then
  //
  // $$ \frac{2}{\Delta t^2} M (U_1 - U_0 - \Delta t\, V_0) + K \frac{U_0 + U_1}{2}
  //    + F_c(U_0, U_1) = 0 . $$
  //
  // The residual is measured by contact and by the inertia of the whole increment, which is not
  // zero in flight.
  unsigned int
  solve()
  {
    const double inertia = 2. / (dt * dt);
    Field        increment, mean, residual(U), force(U);
    for (unsigned int n_solves = 0; n_solves <= max_solves; ++n_solves)
      {
        tangent.copy_from(mass);
        tangent *= inertia;
        tangent.add(.5, stiffness);
        assemble_contact();

        increment = U;
        increment -= U_0;
        mass.vmult(force, increment);
        const double scale = inertia * force.l2_norm() + F_c.l2_norm();
        increment.add(-dt, V);
        mass.vmult(residual, increment);
        residual *= inertia;
        mean = U;
        mean.sadd(.5, .5, U_0);
        stiffness.vmult_add(residual, mean);
        residual += F_c;
        if (n_solves > 0 && residual.l2_norm() <= tolerance * scale)
          return n_solves;

        SparseDirectUMFPACK().solve(tangent, residual);
        U -= residual;
      }
    throw ComputationError("Newton's method has not converged in " +
                           std::to_string(max_solves) + " iterations.");
  }

  // ## One step
  //
  // The predictor is free flight; Newton's method corrects it; the velocity follows. The work
  // against contact is returned (J), for the balance.
  unsigned int n_iterations = 0;

  double
  advance()
  {
    U_0 = U;
    U.add(dt, V);
    n_iterations = solve();
    Field increment(U);
    increment -= U_0;
    V.sadd(-1., 2. / dt, increment);
    return F_c * increment;
  }

  // ## The run
  //
  // In each row of the table, which has the names of elastic_ball, the balance
  // $E_1 - E_0 + F_c \cdot (U_1 - U_0) = 0$ is checked: a wrong force, or an equation that was not
  // solved, violates it, and the program reports it and ends with code 4.
  void
  run(RunFolder &folder)
  {
    make_grid(mesh);
    assemble_body();
    make_circle();
    for (Field *field : {&U_0, &U, &V, &F_c})
      field->reinit(dof_handler.n_dofs());
    for (const unsigned int c : {0, 1})
      for (const auto i : DoFTools::extract_dofs(
             dof_handler,
             fe.component_mask(FEValuesExtractors::Scalar(c))))
        V(i) = initial_velocity[c];
    assemble_contact();
    folder.log(std::to_string(mesh.n_active_cells()) + " cells, " +
               std::to_string(U.size()) + " unknowns");

    double time, kinetic, elastic, modified, balance, iterations,
      contact_work = 0.;
    double energy = .5 * mass.matrix_norm_square(V), largest_energy = 0.;
    const std::vector<std::tuple<std::string, std::string, double *>> columns =
      {{"time", "s", &time},
       {"kinetic_energy", "J", &kinetic},
       {"elastic_energy", "J", &elastic},
       {"energy", "J", &energy},
       {"modified_energy", "J", &modified},
       {"contact_work", "J", &contact_work},
       {"balance_residual", "1", &balance},
       {"newton_iterations", "1", &iterations},
       {"smallest_gap_foundation", "m", &smallest_gap},
       {"contact_force_foundation", "N", &contact_force}};
    EnergyLedger ledger(folder);
    for (const auto &[name, unit, value] : columns)
      ledger.add_column(name, unit);
    folder.begin();
    ledger.start();
    for (unsigned int step = 0; step < final_time / dt + 1. - 1e-9; ++step)
      {
        const double work = step == 0 ? 0. : advance();
        time              = step * dt;
        kinetic           = .5 * mass.matrix_norm_square(V);
        elastic           = .5 * stiffness.matrix_norm_square(U);
        balance           = kinetic + elastic - energy + work;
        energy            = kinetic + elastic;
        modified          = energy + spring_energy;
        largest_energy    = std::max(largest_energy, modified);
        balance /= largest_energy > 0. ? largest_energy : 1.;
        contact_work += work;
        iterations = n_iterations;
        std::vector<double> row;
        for (const auto &column : columns)
          row.push_back(*std::get<2>(column));
        ledger.add_row(row);
        if (log_every > 0 && step % log_every == 0)
          folder.log("t = " + to_text(time) + " s: energy " + to_text(energy) +
                     " J, modified " + to_text(modified) +
                     " J, contact force " + to_text(contact_force) + " N, " +
                     std::to_string(n_iterations) + " iterations");
        if (!(std::abs(balance) <= 1e-9))
          folder.leave_open({"The energy balance does not close."});
      }
    ledger.write_hdf5();
  }
};

int
main(int argc, char **argv)
{
  return run_program<DiskStepByStep>(
    argc,
    argv,
    "disk_step_by_step",
    "The elastic ball (paper A, section 6.1) with a step written out in one file.");
}
