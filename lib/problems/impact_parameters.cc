// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <problems/impact_parameters.h>

namespace Ricochet
{
  using namespace dealii;

  void
  ImpactParameters::add_parameters(ParameterHandler &parameters)
  {
    contact.add_parameters(parameters);
    scheme.add_parameters(parameters);
    time.add_parameters(parameters);
    newton.add_parameters(parameters);
    linear_solver.add_parameters(parameters);
    parameters.enter_subsection("Time");
    parameters.add_parameter(
      "Mass",
      mass,
      "Mass matrix: consistent, or redistributed so that the nodes of the "
      "contact boundary have no inertia (paper C, section 2.4; EMM of paper "
      "A).",
      Patterns::Selection("consistent|redistributed"));
    parameters.leave_subsection();
  }



  void
  ImpactParameters::validate(const bool linear_material,
                             const bool viscous) const
  {
    check_combination(contact,
                      scheme.name,
                      redistributed_mass(),
                      linear_material,
                      viscous);
    if (time.final_time > 1e8 * time.time_step)
      throw InputError("The final time " + to_text(time.final_time) +
                       " s is more than 1e8 time steps of " +
                       to_text(time.time_step) + " s away.");
  }
} // namespace Ricochet
