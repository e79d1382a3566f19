// SPDX-License-Identifier: LGPL-2.1-or-later

// # 1D-SD: a bar between a wall and an obstacle
//
// A bar of unit length, unit modulus and unit density is held at its right
// end. It is stretched away from a rigid obstacle at its left end, let go, and
// hits the obstacle again and again:
//
//     u_tt - u_xx = 0                            for 0 < x < 1,
//     u(1, t) = 0,
//     u(0, t) >= 0,  u_x(0, t) <= 0,  u(0, t) u_x(0, t) = 0,
//     u(x, 0) = 1/2 - x/2,  u_t(x, 0) = 0.
//
// This is the benchmark 1D-SD of paper C (Huang, Pignet, Drouet and Chouly,
// "HHT-alpha and TR-BDF2 schemes for dynamic contact problems", section 4.1),
// which goes back to Dabaghi, Petrov, Pousin and Renard (2016). The exact
// solution has the period 3: the left end flies for one unit of time, stays in
// contact with the pressure 1/2 for one, and flies back for one. The energy is
// 1/8 at all times.
//
// Everything that matters can go wrong here: the velocity of the end jumps at
// the impact, and a discrete end has mass, so that the pressure oscillates and
// energy may appear or be lost. The program runs any contact treatment with any
// time scheme, with the consistent mass or with one that has no inertia on the
// contact boundary, and compares with the exact solution.
//
// Run it as
//
//     bar_sd parameter_files/bar_sd/default.prm
//     bar_sd parameter_files/bar_sd/default.prm --set "Time/Scheme=TR-BDF2"
//     bar_sd --help
//
// Nitsche's method with Crank-Nicolson (the defaults) has a mean displacement
// of the left end over the first contact (t = 1.00 ... 2.10) of 5.0e-4; the
// penalty method has -3.8e-3: it lets the bar penetrate.

#include <contact/obstacles/half_space.h>
#include <base/program.h>
#include <output/vtu_series.h>
#include <problems/bar.h>


using namespace dealii;
using namespace Ricochet;

class BarSD
{
public:
  void
  run(RunFolder &folder);

  // h = dt = 0.05, T = 12, gamma_0 = 1/epsilon_0 = 5, unless the parameter file
  // says otherwise.
  BarParameters parameters;
};



void
BarSD::run(RunFolder &folder)
{
  const ImpactParameters &impact = parameters.impact;

  parallel::shared::Triangulation<1> triangulation(folder.communicator);
  make_bar_grid(parameters.mesh_size, triangulation);

  // A bar of modulus lambda + 2 mu = 1, and an obstacle that fills x < 0. The
  // signed distance of a point to it is its coordinate, so that the gap of the
  // left end is its displacement.
  const LinearElastic material{/* lambda */ 0., /* mu */ .5};
  ImpactSetup<1>      setup{material};
  setup.density   = 1.;
  setup.degree    = parameters.degree;
  setup.clamped   = {BarEnds::right};
  setup.obstacles = {
    {BarEnds::left, half_space_at_rest<1>(Point<1>(0.), Tensor<1, 1>({1.}))}};

  // Mesh and data make the equation of motion: mass, bulk, contact, scheme.
  Impact<1> bar(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " elements, " + std::to_string(bar.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", " +
             impact.scheme.name + ", " + impact.mass + " mass");

  // The initial displacement is linear, so that the interpolation is exact. The
  // initial acceleration follows from it.
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

  // The time loop writes energies and contact for every benchmark. We add what
  // the figures of the paper plot: the motion of the left end, and the error.
  TimeLoop loop(impact.time,
                folder,
                bar.system,
                *bar.scheme,
                {{BarEnds::left, "left"}});
  add_bar_end_columns(BarEnds::left, bar.body, exact, loop);
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
  BarSD program;
  return run_program(
    argc,
    argv,
    {"bar_sd",
     "1D-SD: an elastic bar, held at its right end, hits an obstacle with its "
     "left end\n(paper C, section 4.1).",
     [&](ParameterHandler &prm) { program.parameters.add_parameters(prm); },
     [&]() { program.parameters.validate(); },
     [&](RunFolder &folder) { program.run(folder); },
     [&]() { return program.parameters.impact.unused_parameters(); }});
}
