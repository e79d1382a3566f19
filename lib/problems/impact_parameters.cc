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
    add_parameters_without_contact(parameters);
  }



  void
  ImpactParameters::add_parameters_without_contact(ParameterHandler &parameters)
  {
    scheme.add_parameters(parameters);
    time.add_parameters(parameters);
    newton.add_parameters(parameters);
    linear_solver.add_parameters(parameters);
    limit.add_parameters(parameters);
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
  ImpactParameters::validate(const bool          linear_material,
                             const VelocityForce velocity_force) const
  {
    check_combination(contact,
                      scheme_traits(scheme.name),
                      redistributed_mass(),
                      linear_material,
                      velocity_force);
    time.validate();
  }



  std::vector<UnusedParameter>
  ImpactParameters::unused_parameters() const
  {
    std::vector<UnusedParameter> unused = contact.unused_parameters();
    const auto                   more   = scheme.unused_parameters();
    unused.insert(unused.end(), more.begin(), more.end());
    return unused;
  }
} // namespace Ricochet
