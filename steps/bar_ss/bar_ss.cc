// SPDX-License-Identifier: LGPL-2.1-or-later

// # 1D-SS: a bar between two obstacles
//
// A bar flies to and fro between two rigid obstacles, at $0$ and at $3/2$. It
// starts compressed to half its length, so that it stands against the right
// obstacle, and moves to the left. This is the benchmark 1D-SS of paper C
// (Huang, Pignet, Drouet and Chouly, "HHT-alpha and TR-BDF2 schemes for dynamic
// contact problems", section 4.2). It is 1D-SD (the program bar_sd, whose
// introduction explains gap, pressure, weak form and Nitsche's method) with two
// things more: nothing holds the bar, and an end can touch without pressing.
//
// ## The problem
//
// With unit length, modulus and density (C (35)):
//
// $$ \ddot u - u_{xx} = 0 \quad (0 < x < 1), \qquad
//    u(x, 0) = 1 - \tfrac{x}{2}, \quad \dot u(x, 0) = -\tfrac12 . $$
//
// Each end has a gap and a pressure. The normal of each obstacle points to the
// bar, to the right at the left end and to the left at the right end, so that
//
// $$ g_l = u(0, t), \qquad g_r = \tfrac12 - u(1, t), \qquad
//    p_l = -u_x(0, t), \qquad p_r = -u_x(1, t), $$
//
// and at both of them $g \ge 0$, $p \ge 0$, $p\, g = 0$. The energy is $1/4$.
//
// ## What happens
//
// The exact solution has the period 6. Each end goes through three states: off
// the obstacle, pressed against it with $p = 1$, and touching it with no
// pressure at all. The left end, for instance, arrives at $t = 1$ and rests
// there until $t = 2$ without being pressed. This is **grazing contact**,
// $g = 0$ and $p = 0$ together. Nitsche's force is $[q]_+$ with
// $q = p - \gamma g$: just there $q = 0$, the positive part has a kink, and the
// smallest error decides whether an end counts as touching or not. A discrete
// solution is most easily thrown off in these intervals.
//
// ## Weak form
//
// For all $v$, with no condition at either end,
//
// $$ \int_0^1 \ddot u \, v \, dx + \int_0^1 u_x v_x \, dx
//    - p_l \, v(0) + p_r \, v(1) = 0 . $$
//
// Each $p$ comes with the change of its gap along $v$, which is $v(0)$ at the
// left and $-v(1)$ at the right. In general it is
// $-\int p \, \delta g(v) \, ds$ over all of the contact boundary with
// $\delta g(v) = \nu \cdot v$, where $\nu$ is the normal of the obstacle
// towards the body: this one expression is what every program of this library
// adds to the equations of elasticity.
//
// ## One step of this program
//
// As in bar_sd, with any scheme. With TR-BDF2 (C (33),
// `lib/time_integration/tr_bdf2.cc`) a step has two stages. The trapezoidal
// rule goes over the part $\gamma_t = 2 - \sqrt 2$ of the step to a state in
// the middle, $(U_m, V_m, A_m)$, which is a step of Crank-Nicolson of the
// length $\gamma_t \Delta t$. Then the backward difference formula goes over
// the whole,
//
// $$ V_1 = a_m V_m - a_0 V_0 + b\, \Delta t\, A_1, \qquad
//    U_1 = a_m U_m - a_0 U_0 + b\, \Delta t\, V_1, \qquad
//    M A_1 + K U_1 + F_c(U_1) = 0, $$
//
// $$ a_m = \frac{1}{\gamma_t (2 - \gamma_t)}, \qquad
//    a_0 = \frac{(1 - \gamma_t)^2}{\gamma_t (2 - \gamma_t)}, \qquad
//    b = \frac{1 - \gamma_t}{2 - \gamma_t} . $$
//
// With $\gamma_t = 2 - \sqrt 2$ is $b = \gamma_t / 2$, so that both stages have
// the same matrix $M / (b\, \Delta t)^2 + K$, and one factorisation serves for
// both. Vibrations that the step cannot resolve are damped away (see the
// program spectral_radius): of the end that has begun to oscillate at an impact
// little is left after a few steps.
//
// ## Run it
//
//     bar_ss parameter_files/bar_ss/default.prm
//     bar_ss parameter_files/bar_ss/default.prm --set "Time/Mass=redistributed"
//     bar_ss --help
//
// ## A body that nothing holds
//
// No end is clamped: the program also shows that nothing in the library needs a
// body to be held. The matrix $K$ alone could not be factored, since a
// translation costs no energy; with the mass beside it each stage can.

#include <contact/obstacles/half_space.h>
#include <base/program.h>
#include <problems/bar.h>
#include <problems/impact_loop.h>


using namespace dealii;
using namespace Ricochet;

// The parameters are $h = \Delta t = 0.05$, $T = 12$, $\gamma_0 = 1/\epsilon_0 = 5$, unless
// the parameter file says otherwise.
class BarSS : public BarParameters
{
public:
  void
  run(RunFolder &folder);
};



// ## The run
void
BarSS::run(RunFolder &folder)
{
  parallel::shared::Triangulation<1> triangulation(folder.communicator);
  make_bar_grid(mesh_size, triangulation);

  // ### Data
  //
  // A bar of modulus $\lambda + 2 \mu = 1$, and two obstacles that fill $x < 0$
  // and $x > 3/2$; the normal of each points to the bar. The initial gap of an
  // end is its distance at zero displacement, $0$ at the left and $1/2$ at the
  // right, and the gap is that plus normal times displacement.
  const LinearElastic material{/* lambda */ 0., /* mu */ .5};
  ImpactSetup<1>      setup{material};
  setup.density   = 1.;
  setup.degree    = degree;
  setup.obstacles = {
    {BarEnds::left, half_space_at_rest<1>(Point<1>(0.), Tensor<1, 1>({1.}))},
    {BarEnds::right,
     half_space_at_rest<1>(Point<1>(1.5), Tensor<1, 1>({-1.}))}};

  // ### The equation of motion
  //
  // Mesh and data make $M \ddot U + K U + F_c(U) = 0$ (C (22)): mass, bulk,
  // contact, scheme. With the redistributed mass both end nodes have none.
  Impact<1> bar(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " elements, " + std::to_string(bar.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", " +
             impact.scheme.name + ", " + impact.mass + " mass");

  // ### The start
  //
  // The initial displacement is linear, so that the interpolation is exact. The
  // initial acceleration follows from it, $A_0 = -M^{-1} (K U_0 + F_c(U_0))$.
  // It is large at the left end, which is compressed and free. The right end is
  // compressed too, but its gap is closed: Nitsche's method takes
  // $q = p(u_h) = 1/2$ for a contact pressure at first, while the exact
  // solution has none there.
  BarCharacteristics exact(/* u(0, 0) */ 1.,
                           /* strain */ -.5,
                           /* velocity */ -.5,
                           /* left end */ {/* held */ false, /* gap */ 1.},
                           /* right end */ {/* held */ false, /* gap */ 0.},
                           impact.time.final_time + impact.time.time_step);
  Ricochet::Vector   displacement, velocity;
  bar.body.interpolate(exact, displacement);
  bar.body.interpolate(Functions::ConstantFunction<1>(-.5), velocity);
  const State initial_state =
    bar.system.initial_state(displacement, velocity, /* time */ 0.);

  // ### Time
  //
  // The time loop writes energies and contact for every benchmark, with
  // separate columns for each end. We add what the figures of the paper plot:
  // the motion of the two ends, and the error.
  ImpactLoop<1> loop(impact.time,
                     bar,
                     {material},
                     {{BarEnds::left, "left"}, {BarEnds::right, "right"}},
                     folder);
  add_bar_end_columns(BarEnds::left, bar.body, exact, loop);
  add_bar_end_columns(BarEnds::right, bar.body, exact, loop);
  add_bar_error_column(bar.body, exact, loop);

  loop.run(initial_state);

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
  return run_program<BarSS>(
    argc,
    argv,
    "bar_ss",
    "1D-SS: an elastic bar flies to and fro between two obstacles\n(paper C, "
    "section 4.2).");
}
