// SPDX-License-Identifier: LGPL-2.1-or-later

// # 1D-SS: a bar between two obstacles
//
// A bar of unit length, unit modulus and unit density flies to and fro between
// two rigid obstacles, at 0 and at 1.5. It starts compressed to half its
// length, so that it stands against the right obstacle, and moves to the left:
//
//     u_tt - u_xx = 0                            for 0 < x < 1,
//     u(0, t) >= 0,    u_x(0, t) <= 0,  u(0, t) u_x(0, t) = 0,
//     u(1, t) <= 1/2,  u_x(1, t) <= 0,  (u(1, t) - 1/2) u_x(1, t) = 0,
//     u(x, 0) = 1 - x/2,  u_t(x, 0) = -1/2.
//
// This is the benchmark 1D-SS of paper C (Huang, Pignet, Drouet and Chouly,
// "HHT-alpha and TR-BDF2 schemes for dynamic contact problems", section 4.2).
// The exact solution has the period 6 and the energy 1/4. Each end goes through
// three states: off the obstacle, pressed against it (pressure 1), and touching
// it with no pressure at all. This last one, grazing contact, is where the
// contact operators have no derivative, and where a discrete solution is most
// easily thrown off.
//
// Run it as
//
//     bar_ss parameter_files/bar_ss/default.prm
//     bar_ss parameter_files/bar_ss/default.prm --set "Time/Mass=redistributed"
//     bar_ss --help
//
// No end is clamped: the program also shows that nothing in the library needs
// a body to be held.

#include <contact/obstacles/half_space.h>
#include <base/program.h>
#include <output/vtu_series.h>
#include <problems/bar.h>


using namespace dealii;
using namespace Ricochet;

class BarSS
{
public:
  void
  run(RunFolder &folder);

  // h = dt = 0.05, T = 12, gamma_0 = 1/epsilon_0 = 5, unless the parameter file
  // says otherwise.
  BarParameters parameters;
};



void
BarSS::run(RunFolder &folder)
{
  const ImpactParameters &impact = parameters.impact;

  parallel::shared::Triangulation<1> triangulation(folder.communicator);
  make_bar_grid(parameters.mesh_size, triangulation);

  // A bar of modulus lambda + 2 mu = 1, and two obstacles that fill x < 0 and x
  // > 3/2; the normal of each points to the bar.
  const LinearElastic material{/* lambda */ 0., /* mu */ .5};
  ImpactSetup<1>      setup{material};
  setup.density   = 1.;
  setup.degree    = parameters.degree;
  setup.obstacles = {
    {BarEnds::left, half_space_at_rest<1>(Point<1>(0.), Tensor<1, 1>({1.}))},
    {BarEnds::right,
     half_space_at_rest<1>(Point<1>(1.5), Tensor<1, 1>({-1.}))}};

  // Mesh and data make the equation of motion: mass, bulk, contact, scheme.
  Impact<1> bar(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " elements, " + std::to_string(bar.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", " +
             impact.scheme.name + ", " + impact.mass + " mass");

  // The initial displacement is linear, so that the interpolation is exact. The
  // initial acceleration follows from it; with Nitsche's method it is large at
  // the right end, where the bar is compressed and yet without pressure.
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

  // The time loop writes energies and contact for every benchmark. We add what
  // the figures of the paper plot: the motion of the two ends, and the error.
  TimeLoop loop(impact.time,
                folder,
                bar.system,
                *bar.scheme,
                {{BarEnds::left, "left"}, {BarEnds::right, "right"}});
  add_bar_end_columns(BarEnds::left, bar.body, exact, loop);
  add_bar_end_columns(BarEnds::right, bar.body, exact, loop);
  add_bar_error_column(bar.body, exact, loop);

  VtuSeries<1> fields(bar.body, material, *bar.contact, bar.obstacles, folder);
  loop.write_fields = [&](const State &state, const unsigned int step) {
    fields.write(state, step);
  };

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
  BarSS program;
  return run_program(
    argc,
    argv,
    {"bar_ss",
     "1D-SS: an elastic bar flies to and fro between two obstacles\n(paper C, "
     "section 4.2).",
     [&](ParameterHandler &prm) { program.parameters.add_parameters(prm); },
     [&]() { program.parameters.validate(); },
     [&](RunFolder &folder) { program.run(folder); },
     [&]() { return program.parameters.impact.unused_parameters(); }});
}
