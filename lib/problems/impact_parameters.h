// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_impact_parameters_h
#define ricochet_problems_impact_parameters_h

#include <contact/treatments/contact_treatment.h>
#include <solvers/linear_solver.h>
#include <solvers/newton.h>
#include <problems/size_limit.h>
#include <problems/time_loop.h>
#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /// The parameters of all benchmarks.
  struct ImpactParameters
  {
    ContactParameters        contact;
    TimeScheme::Parameters   scheme;
    TimeLoop::Parameters     time;
    NewtonSolver::Parameters newton;
    LinearSolver::Parameters linear_solver;
    SizeLimit                limit;
    /// "consistent" or "redistributed".
    std::string mass = "consistent";

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// All but those of contact.
    void
    add_parameters_without_contact(dealii::ParameterHandler &parameters);

    /// Refuse combinations without meaning. @param linear_material the body is
    /// linear elastic. @param velocity_force in the body. @throws InputError
    void
    validate(const bool          linear_material = true,
             const VelocityForce velocity_force  = VelocityForce::none) const;

    /// The parameters that have no effect with the others as they are.
    std::vector<UnusedParameter>
    unused_parameters() const;

    /// Refuse runs that do not fit into memory: SizeLimit::check() for the
    /// number of steps of the run.
    void
    check_size(const double       n_unknowns,
               const unsigned int dim,
               const double       more = 0.) const
    {
      limit.check(n_unknowns, dim, time.final_time / time.time_step, more);
    }

    bool
    redistributed_mass() const
    {
      return mass == "redistributed";
    }
  };
} // namespace Ricochet

#endif
