// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_impact_parameters_h
#define ricochet_problems_impact_parameters_h

#include <contact/contact_treatment.h>
#include <solvers/linear_solver.h>
#include <solvers/newton.h>
#include <problems/time_loop.h>
#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /// The parameters that all benchmarks share.
  struct ImpactParameters
  {
    ContactParameters        contact;
    TimeScheme::Parameters   scheme;
    TimeLoop::Parameters     time;
    NewtonSolver::Parameters newton;
    LinearSolver::Parameters linear_solver;
    /// "consistent" or "redistributed".
    std::string mass = "consistent";

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// Refuse combinations without meaning. @param linear_material the body is
    /// linear elastic. @param viscous it is viscous. @throws InputError
    void
    validate(const bool linear_material = true,
             const bool viscous         = false) const;

    bool
    redistributed_mass() const
    {
      return mass == "redistributed";
    }
  };
} // namespace Ricochet

#endif
