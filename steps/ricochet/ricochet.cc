// SPDX-License-Identifier: LGPL-2.1-or-later

// # Ricochet: bodies, obstacles and contacts of your own
//
// Your own bodies, obstacles and contacts, from a parameter file. The other
// programs are benchmarks, each of one situation; here the file says what there
// is:
//
//     set Program   = ricochet
//     set Dimension = 2
//
//     subsection Body ball
//       set Shape    = disk
//       set Radius   = 0.5
//       set Velocity = 1, -3
//     end
//     subsection Obstacle floor
//       set Shape  = half space
//       set Centre = 0, -0.6
//     end
//     subsection Contact ball on floor
//       set Surface = ball
//       set Against = floor
//     end
//
// There are as many bodies, obstacles, contacts, conditions at boundaries and
// probes as sections `Body NAME`, `Obstacle NAME`, `Contact NAME`,
// `Condition NAME` and `Probe NAME`. Sections `Phase NAME` have the changes for
// a part of the run, which goes on from where the one before it has ended: so
// something is pressed, settles, is released and hits.
//
// ## The problem
//
// All bodies together are, with the first Piola-Kirchhoff stress $\Pi$,
//
// $$ \rho\, \ddot u - \mathrm{Div}\, \Pi(u) = \rho\, b
//    \quad\text{in each body}, \qquad
//    u = u_D \;\text{ or }\; \Pi n = f \;\text{ where a condition says so}, $$
//
// and in each contact, with the gap $g$ (positive when separated), the pressure
// $p$ (positive in compression) and the friction traction $t$,
//
// $$ g \ge 0, \quad p \ge 0, \quad p\, g = 0 \;\text{ or its like}, \qquad
//    |t| \le \mu p \;\text{ against the slip}, $$
//
// with the treatment, the friction and the parameters of each contact.
// Parameters with a unit that are not given follow from moduli, densities and
// mesh sizes of the bodies that take part, so that a problem in millimetres and
// tonnes has the solution of the same one in metres and kilograms; the values
// are in log.txt and parameters.prm.
//
// ## Weak form
//
// For all $v$ that are zero where displacements are prescribed,
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int \Pi(u) : \nabla v \, dx
//    - \sum_c \int_{\Gamma_c} \big( p \delta g(v) + t \cdot \delta s(v) \big)
//    \, ds = \int \rho\, b \cdot v \, dx + \int_{\Gamma_N} f \cdot v \, ds . $$
//
// Here $\delta g(v)$ and $\delta s(v)$ are the changes of gap and slip along
// $v$. Against an obstacle $\delta g(v) = \nu \cdot v$ with its normal $\nu$
// (see the programs elastic_ball and obstacle_course); between bodies it has a
// part on each of them (colliding_disks).
//
// ## One step of this program
//
// With the midpoint scheme, which is the default,
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    - \sum_c \sum_j w_j \big( p_j D_j + T_j t_j \big) = L + R, \qquad
//    \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} , $$
//
// where each $D_j$ is a row whose product with the displacement of the step is
// the change of the gap, and the forces $R$ are the reactions of prescribed
// displacements. So the energy balance closes with any combination:
//
//     change of energy = work of loads and prescribed displacements
//                        - what contacts, friction and viscosity take
//
// Each term has a file: $F_{int}$ `lib/materials/gonzalez.h` and
// `lib/discretization/hyperelastic_bulk.cc`; $D_j$ `lib/contact/kinematics/`;
// $p_j$ `lib/contact/laws/` and `lib/contact/treatments/`; the sum over
// contacts `lib/contact/treatments/contact_sum.h`; the step
// `lib/time_integration/midpoint.cc`. The sections of the file are translated
// into these in `lib/scene/scene.h`.
//
// ## Run it
//
//     ricochet examples/belt_with_spring.prm
//     ricochet examples/belt_with_spring.prm --validate
//     ricochet --print-parameters
//
// The second describes the scene without a run; the third has all sections,
// with NAME for your own names.

#include <base/program.h>
#include <output/phase_ledger.h>
#include <problems/combinations.h>
#include <scene/scene.h>

#include <memory>

using namespace dealii;
using namespace Ricochet;

namespace
{
  /// A scene in the dimension that the file gives, known once it is read.
  template <int dim>
  Program
  program_of(const std::shared_ptr<Scene<dim>> &scene)
  {
    Program program;
    program.add_parameters = [scene](ParameterHandler &parameters) {
      scene->add_parameters(parameters);
    };
    program.validate    = [scene]() { scene->validate(); };
    program.run         = [scene](RunFolder &folder) { scene->run(folder); };
    program.take_meshes = [scene](const std::string &folder) {
      scene->kept_meshes = folder;
    };
    program.checksum_of_bodies = [scene]() {
      return scene->checksum_of_bodies();
    };
    program.unused_parameters = [scene]() {
      return scene->unused_parameters();
    };
    program.description_of_input = [scene](const std::string &folder) {
      return scene->description(folder);
    };
    return program;
  }
} // namespace



int
main(int argc, char **argv)
{
  // Functions called below once the dimension is known.
  Program scene;
  return run_program(
    argc,
    argv,
    {"ricochet",
     "Bodies, obstacles and contacts of your own, from a parameter file.",
     [&](ParameterHandler &parameters) { scene.add_parameters(parameters); },
     [&]() { scene.validate(); },
     [&](RunFolder &folder) { scene.run(folder); },
     [&]() { return scene.unused_parameters(); },
     [&](const ParameterText &text) {
       scene = dimension_of(text) == 2
         ? program_of(std::make_shared<Scene<2>>(text))
         : program_of(std::make_shared<Scene<3>>(text));
     },
     [&](const std::string &folder) {
       return scene.description_of_input(folder);
     },
     {{"--promises",
       "print what contact treatments promise of the energy",
       promises_as_table},
      {"--combinations",
       "print which choices go together, as CSV",
       combinations_as_csv}},
     join_phases,
     [&](const std::string &folder) { scene.take_meshes(folder); },
     [&]() { return scene.checksum_of_bodies(); }});
}
