// SPDX-License-Identifier: LGPL-2.1-or-later

// # Ricochet
//
// Your own bodies, obstacles and contacts, from a parameter file. The other programs
// are benchmarks, each of one situation; here the file says what there is:
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
// There are as many bodies, obstacles, contacts, conditions at boundaries and probes
// as sections `Body NAME`, `Obstacle NAME`, `Contact NAME`, `Condition NAME` and `Probe
// NAME`. All bodies together are
//
//     rho u_tt - div P(F) = rho b                        in each body,
//     u = u_D or P N = t                                 where a condition says so,
//     gap >= 0, p >= 0, p gap = 0 or its like,
//     |friction| <= mu p                                 in each contact,
//
// with the treatment, the friction and the parameters of each contact. What has a unit
// and is not given follows from moduli, densities and mesh sizes of the bodies that take
// part, so that a problem in millimetres and tonnes has the solution of the same one in
// metres and kilograms; the values are in log.txt and parameters.prm.
//
// One step with the midpoint scheme, which is the default, is
//
//     M (v_1 - v_0)/dt + F_int(u_0, u_1) + sum over contacts F_c(u_0, u_1) = F_ext,
//
// where each F_c is pressure times a row whose product with the step is the change of the
// gap. So the ledger closes whatever is combined: change of energy = work of loads and
// prescribed displacements - what contacts, friction and viscosity take.
//
// Run it as
//
//     ricochet examples/belt_with_spring.prm
//     ricochet examples/belt_with_spring.prm --validate
//     ricochet --print-parameters
//
// The second tells what is there, without a run; the third has all sections, with NAME
// for the names of your own.

#include <base/program.h>
#include <scene/scene.h>

#include <memory>

using namespace dealii;
using namespace Ricochet;

namespace
{
  /// A scene in as many dimensions as the file says, which is known once it is read.
  template <int dim>
  Program
  program_of(const std::shared_ptr<Scene<dim>> &scene)
  {
    Program program;
    program.add_parameters = [scene](ParameterHandler &parameters) {
      scene->add_parameters(parameters);
    };
    program.validate = [scene]() { scene->validate(); };
    program.run      = [scene](RunFolder &folder) { scene->run(folder); };
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
  // What the functions below call, once the dimension is known.
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
     }});
}
