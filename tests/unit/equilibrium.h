// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_equilibrium_h
#define ricochet_tests_unit_equilibrium_h

#include <problems/impact.h>

#include <utility>

/// Equilibrium of bulk and contact forces. @return displacement and contact
/// force.
template <int dim>
std::pair<Ricochet::Vector, Ricochet::Vector>
equilibrium(Ricochet::Impact<dim> &impact, const double end_time = 0.)
{
  const Ricochet::Vector zero = impact.body.make_vector();
  Ricochet::State        rest;
  rest.solution = rest.velocity = rest.acceleration = rest.contact_force =
    rest.mean_velocity = rest.scheme_force = zero;
  rest.contact_shares.assign(impact.contact->shares().size(), zero);
  Ricochet::Stage stage;
  stage.inertia_origin   = zero;
  stage.load             = zero;
  stage.time_step        = 1.;
  stage.end_time         = end_time;
  Ricochet::State result = rest;
  impact.system.solve_stage(stage, rest, result);
  return {result.solution, result.contact_force};
}

#endif
