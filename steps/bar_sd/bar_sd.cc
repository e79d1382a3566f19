// SPDX-License-Identifier: LGPL-2.1-or-later

// # 1D-SD: a bar between a wall and an obstacle
//
// An elastic bar is held at its right end. Its left end is pushed away from a
// rigid obstacle, so that the bar is compressed to half its length, and let go:
// it hits the obstacle again and again. This is the benchmark 1D-SD of paper C
// (Huang, Pignet, Drouet and Chouly, "HHT-alpha and TR-BDF2 schemes for dynamic
// contact problems", section 4.1), which goes back to Dabaghi, Petrov, Pousin
// and Renard (2016). It is the place to begin: one space dimension, one point
// that can touch, an exact solution, and yet everything that makes dynamic
// contact difficult.
//
// ## The problem
//
// The bar has unit length, unit modulus and unit density, so that waves travel
// with speed one. Its displacement $u(x, t)$ obeys (C (34))
//
// $$ \ddot u - u_{xx} = 0 \quad (0 < x < 1), \qquad u(1, t) = 0, $$
//
// $$ u(x, 0) = \tfrac12 - \tfrac{x}{2}, \qquad \dot u(x, 0) = 0 . $$
//
// The obstacle fills the points left of zero. The **gap** $g$ is the distance
// of the left end from it, positive when they are apart; here it is the
// displacement, $g = u(0, t)$. The **contact pressure** $p$ is the force by
// which the obstacle pushes the end away, positive in compression; here
// $p = -u_x(0, t)$. Both obey *Signorini's condition* (A (2.1), C (1)(v)):
//
// $$ g \ge 0, \qquad p \ge 0, \qquad p\, g = 0 . $$
//
// The end does not enter the obstacle, the obstacle does not pull, and it
// pushes only where it is touched. The first two are inequalities and the third
// one is not linear: that is all that contact adds to linear elasticity, and it
// is enough.
//
// ## What happens
//
// The left end is free at first, so that a wave of unloading runs from it to the
// right. Behind the wave the bar has no strain and moves to the left with the
// velocity $-1/2$. At $t = 1$ the wave is at the wall and the end at the
// obstacle. The obstacle stops the left end, the wall the right one, and a wave
// starts from each, behind which the bar is at rest and compressed. Until that
// of the wall arrives at the left end, at $t = 2$, there is contact with the
// pressure $1/2$. Then the end flies off with $+1/2$, and at $t = 3$ everything
// is as it was (figure C-5 shows the bar at several times). This repeats for
// ever, with the energy
//
// $$ E = \tfrac12 \int_0^1 \dot u^2 \, dx + \tfrac12 \int_0^1 u_x^2 \, dx
//      = \tfrac18 . $$
//
// The velocity of the end jumps from $-1/2$ to $0$ at the impact. In the exact
// solution this costs nothing, because a point has no mass. The end node of a
// mesh has some, and something has to happen to its kinetic energy: the
// pressure oscillates, and energy may be lost or, worse, made.
//
// ## Weak form
//
// Multiply by a test function $v$ with $v(1) = 0$ and integrate by parts. What
// remains at the left end is the pressure times $v(0)$, which is how much the
// gap changes along $v$:
//
// $$ \int_0^1 \ddot u \, v \, dx + \int_0^1 u_x v_x \, dx - p \, v(0) = 0 . $$
//
// Finite elements turn this into (C (22))
//
// $$ M \ddot U + K U + F_c(U) = 0, $$
//
// with the mass matrix $M$, the stiffness matrix $K$ and the contact force
// $F_c$, whose main part is $-p$ in the row of the left end. How $p$ follows
// from $U$ is the **contact treatment**; how time is divided into steps is the
// **time scheme**. The program combines most treatments with most schemes, and
// refuses the rest with a message.
//
// ## Nitsche's method, the default treatment
//
// Signorini's condition is the same as one equation: for any $\gamma > 0$
//
// $$ p = [\, p - \gamma g \,]_+, \qquad [x]_+ = \max(x, 0). $$
//
// (If $p > 0$ it says $g = 0$, and if $p = 0$ it says $g \ge 0$.) The bar has a
// pressure of its own, that of the stress in its end element, $p(u) = -u_x(0)$.
// Nitsche's method puts it in place of $p$ on the right, with
// $\gamma = \gamma_0/h$, and takes the result $[q]_+$, $q = p(u) - \gamma g$,
// for the force: $F_c(u)\,[v] = -[q]_+\, v(0)$. That is its variant
// $\theta = 0$. To have a force that comes from a potential, a term is added
// with the pressure $p(v) = -v_x(0)$ of the test function (C (6) to (9), in our
// signs):
//
// $$ F_c(u)\,[v] = -[q]_+\, v(0)
//    + \frac{\theta}{\gamma}\, \big( [q]_+ - p(u) \big)\, p(v) . $$
//
// For the exact solution $[q]_+ = p$ and the new term is zero: it makes no
// error (the method is *consistent*), and no unknown is needed for the force.
// $\theta = 1$ is the symmetric variant, which is the derivative of a
// potential: so there is a **modified energy** (C (13)),
//
// $$ E_N = E + \frac{1}{2\gamma} \big( [q]_+^2 - p(u)^2 \big), $$
//
// which is what a perfect time scheme would keep. It is in
// `lib/contact/laws/nitsche.h`, line by line. The bar needs $\gamma_0 > 1$, its
// modulus; below that the modified energy can be negative, and the program
// refuses to start.
//
// The **penalty** method (C (14) to (17), `lib/contact/laws/penalty.h`) takes a
// spring instead, $p = [-g]_+ / \epsilon$ with $\epsilon = \epsilon_0 h$. It is
// simpler, but there is no pressure without penetration. Its modified energy is
// that of bar and spring, $E + [-g]_+^2 / (2 \epsilon)$.
//
// ## A mass matrix without mass at the end
//
// The mass matrix of finite elements, $\int \rho N_i N_j$ ("consistent"), gives
// the end node a mass, which an obstacle has to stop at once. With
// `Time/Mass = redistributed` the node has none: the mass goes to the others,
// so that total mass, centre and moment of inertia are unchanged (C 2.4).
// A node without mass is in equilibrium at any time, and nothing in it can
// oscillate.
//
// ## One step of this program
//
// With the Crank-Nicolson scheme, C (24) with $\alpha = 0$, a step of length
// $\Delta t$ from the old state $(U_0, V_0, A_0)$ to the new one is
//
// $$ U_1 = U_0 + \Delta t\, V_0 + \tfrac14 \Delta t^2 (A_0 + A_1), \qquad
//    V_1 = V_0 + \tfrac12 \Delta t\, (A_0 + A_1), $$
//
// $$ M A_1 + K U_1 + F_c(U_1) = 0 . $$
//
// The first line gives $A_1$ by $U_1$; put into the second it is one nonlinear
// system for $U_1$,
//
// $$ \frac{4}{\Delta t^2} M (U_1 - \hat U) + K U_1 + F_c(U_1) = 0, \qquad
//    \hat U = U_0 + \Delta t\, V_0 + \tfrac14 \Delta t^2 A_0, $$
//
// which is piecewise linear: there is one matrix with contact and one without.
// Newton's method tries one, looks at the sign of $q$, and is done after one or
// two solutions. In the library: the scheme is `lib/time_integration/generalised_alpha.cc`,
// the system SemiDiscreteSystem::solve_stage, the iteration
// `lib/solvers/newton.cc`.
//
// While contact lasts, or while there is none, $F_c$ is linear and
// Crank-Nicolson keeps $E_N$ exactly. Only a step in which contact begins or
// ends changes it. With a force $\gamma [x]_+$ ($x = q/\gamma$; for the penalty
// method $x = -g$ and $1/\epsilon$ in place of $\gamma$) the trapezoidal
// rule then counts a work that is not the change of the potential: where contact
// begins, $\tfrac12 (0 + \gamma x_1)(x_1 - x_0)$ is
// $\tfrac12 \gamma x_1^2 - \tfrac12 \gamma x_0 x_1$. So
//
// $$ \Delta E_N = \tfrac{\gamma}{2}\, x_0 x_1 \;\text{ where contact begins},
//    \quad
//    \Delta E_N = -\tfrac{\gamma}{2}\, x_0 x_1 \;\text{ where it ends}. $$
//
// $x_0$ and $x_1$ have different signs: beginning loses and ending gains. You
// can see it in the lowest panel of figure C-6 (on the left), whose steps are at
// the eight times at which contact changes.
//
// Other schemes: HHT takes part of the forces at the old instead of the new end
// of the step (by a weight $\alpha$); TR-BDF2 makes a trapezoidal step over the
// first 59 % and a backward one over the rest. Both damp vibrations that are
// faster than the step resolves, and so the energy falls in nearly every step, not only
// where contact changes. What they take is the energy of these vibrations:
// Crank-Nicolson keeps it, but in the wrong place. At $t = 12$, where the exact
// bar is at rest, it has 0.012 J of kinetic energy, TR-BDF2 0.0001 J; so the bar
// of TR-BDF2 flies higher, with less energy.
//
// ## Run it
//
// From the top folder of the source:
//
//     build/release/bar_sd parameter_files/bar_sd/default.prm --output-dir output/first
//     build/release/bar_sd parameter_files/bar_sd/default.prm --set "Time/Scheme=TR-BDF2" --output-dir output/second
//     build/release/bar_sd --help
//     python/bin/ricochet-plot output/first output/second -o output/plots
//
// A run takes about a second, and has a folder of its own (without
// `--output-dir` the second one would replace the first). In it is
// `energy.csv`, one row for each step. The file has $h = \Delta t = 0.05$, 240
// steps, $\gamma_0 = 5$, $\theta = 1$ and the consistent mass; `--set` changes
// one parameter. The last line draws both runs into the same axes: energies,
// contact force, gap. (With Nitsche's method there is contact where $q > 0$;
// the gap may swing by some millimetres around zero meanwhile.)
//
// Nitsche's method with Crank-Nicolson (the defaults) has a mean displacement of the left end over
// $t$ = 1.00 ... 2.10 of 5.0e-4 m, the penalty method of -3.8e-3 m, as C 4.1.1 prints without these
// times. They were found by trying: over 1 ... 2, the exact contact, it is -1.2e-4 and -4.57e-3 m.

#include <contact/obstacles/half_space.h>
#include <base/program.h>
#include <problems/bar.h>
#include <problems/impact_loop.h>


using namespace dealii;
using namespace Ricochet;

// The parameters are $h = \Delta t = 0.05$, $T = 12$, $\gamma_0 = 1/\epsilon_0 = 5$, unless
// the parameter file says otherwise.
class BarSD : public BarParameters
{
public:
  void
  run(RunFolder &folder);
};



// ## The run
void
BarSD::run(RunFolder &folder)
{
  parallel::shared::Triangulation<1> triangulation(folder.communicator);
  make_bar_grid(mesh_size, triangulation);

  // ### Data
  //
  // The bar is a body of linear elasticity with strains in one direction,
  // $\sigma = (\lambda + 2\mu)\, u_x$: the modulus is one. The obstacle fills
  // $x < 0$; its gap function is the signed distance of a point, here its
  // coordinate, so that the gap of the left end is its displacement.
  const LinearElastic material{/* lambda */ 0., /* mu */ .5};
  ImpactSetup<1>      setup{material};
  setup.density   = 1.;
  setup.degree    = degree;
  setup.clamped   = {BarEnds::right};
  setup.obstacles = {
    {BarEnds::left, half_space_at_rest<1>(Point<1>(0.), Tensor<1, 1>({1.}))}};

  // ### The equation of motion
  //
  // Mesh and data make $M \ddot U + K U + F_c(U) = 0$: the mass $M$, the
  // stiffness $K$ (`lib/discretization/linear_bulk.cc`), the contact force
  // $F_c$ (`lib/contact/treatments/pointwise_contact.cc`, which asks the law
  // that the parameter file names), and the scheme; with
  // `Time/Mass = redistributed` an $M$ without mass at the end
  // (`lib/time_integration/mass_redistribution.h`).
  Impact<1> bar(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " elements, " + std::to_string(bar.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", " +
             impact.scheme.name + ", " + impact.mass + " mass");

  // ### The start
  //
  // The exact solution: $\dot u + u_x$ is constant along lines $x + t$ = const.
  // and $\dot u - u_x$ along $x - t$ = const., and what happens at an end turns
  // one into the other (`lib/exact_solutions/bar_characteristics.h`).
  //
  // The initial displacement is linear, so that the interpolation is exact. The
  // initial acceleration follows from it, $A_0 = -M^{-1}(K U_0 + F_c(U_0))$ (C,
  // section 4).
  BarCharacteristics exact(/* u(0, 0) */ .5,
                           /* strain */ -.5,
                           /* velocity */ 0.,
                           /* left end */ {/* held */ false, /* gap */ .5},
                           /* right end */ {/* held */ true, /* gap */ 0.},
                           impact.time.final_time + impact.time.time_step);
  Ricochet::Vector   displacement, velocity;
  bar.body.interpolate(exact, displacement);
  bar.body.interpolate(Functions::ZeroFunction<1>(), velocity);
  const State initial_state =
    bar.system.initial_state(displacement, velocity, /* time */ 0.);

  // ### Time
  //
  // The time loop takes step after step. Each one is "one step of this program"
  // above, unless Newton's method fails and the step is halved, and is entered
  // into the energy table, energy.csv: kinetic and elastic energy, $E_N$, the
  // work of contact, the dissipation of the scheme, gap and pressure. In each
  // row
  //
  //     E_new - E_old = external work - work against contact
  //                     - numerical dissipation
  //
  // must hold to round-off; the residual is the column `balance_residual`.
  // The numerical dissipation comes from a formula of its own, that of the
  // scheme (in HHT::step), not from this difference: so the residual would
  // reveal a wrong tangent or a wrong force.
  //
  // We add what the figures of the paper plot: the motion of the left end, and
  // the error.
  ImpactLoop<1> loop(impact.time,
                     bar,
                     {material},
                     {{BarEnds::left, "left"}},
                     folder);
  add_bar_end_columns(BarEnds::left, bar.body, exact, loop);
  add_bar_error_column(bar.body, exact, loop);

  loop.run(initial_state);

  // The error of figure C-10.
  char line[100];
  std::snprintf(line,
                sizeof(line),
                "L2(0,T;H1) error: %.10e, factorisations: %u",
                bar_error_norm(impact.time.time_step, loop),
                bar.system.n_factorisations());
  folder.log(line);
}



int
main(int argc, char **argv)
{
  return run_program<BarSD>(
    argc,
    argv,
    "bar_sd",
    "1D-SD: an elastic bar, held at its right end, hits an obstacle with its "
    "left end\n(paper C, section 4.1).");
}
