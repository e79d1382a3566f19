// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef own_step_exponential_pressure_h
#define own_step_exponential_pressure_h

#include <contact/treatments/contact_law_table.h>

#include <cmath>

/**
 * A user's contact law: a pressure that grows exponentially with the
 * penetration,
 *
 *     p = p_0 (exp(penetration/d) - 1),     potential p_0 (d (exp(penetration/d) - 1)
 *                                                          - penetration),
 *
 * in the nodes of the surface, at the end of the step.
 */
struct ExponentialPressure
{
  /// Pa
  double p_0 = 1.;
  /// m
  double d = 1.;

  static constexpr const char *name = "exponential pressure";

  static Ricochet::OwnParameters
  parameters()
  {
    using namespace Ricochet;
    return {OwnParameter("Exponential pressure", 1e5)
              .means("Parameter p_0",
                     "Pa",
                     ": the pressure is p_0 (exp(penetration/d) - 1). Used by "
                     "exponential pressure.")
              .at_least(1e-30)
              .by_scale([](const Scales &scales, const ParameterValues &) {
                return .1 * scales.wave_modulus;
              })
              .belongs_to("exponential pressure"),
            OwnParameter("Exponential length", 1e-3)
              .means("Parameter d", "m", ". Used by exponential pressure.")
              .at_least(1e-30)
              .by_scale([](const Scales &scales, const ParameterValues &) {
                return .01 * scales.cell_diameter;
              })
              .belongs_to("exponential pressure")};
  }

  static ExponentialPressure
  make(const Ricochet::ParameterValues &values)
  {
    return {values["Exponential pressure"], values["Exponential length"]};
  }

  static Ricochet::EnergyPromise
  promise()
  {
    return {
      Ricochet::EnergyPromise::Kind::never_gains,
      "the force is the slope, at the end of the step, of a potential that is "
      "convex in the gap"};
  }

  static constexpr Ricochet::ContactLawTraits
  traits()
  {
    Ricochet::ContactLawTraits traits;
    traits.nodal            = true;
    traits.takes_friction   = true;
    traits.piecewise_linear = false;
    return traits;
  }

  template <typename Number>
  Ricochet::ContactPointForce<Number>
  force(const Ricochet::ContactPointState<Number> &state,
        const Ricochet::ContactPointState<double> & /*old_state*/,
        const double /*cell_diameter*/) const
  {
    using std::exp;
    if (!(state.gap < 0.))
      return {};
    return {Number(-p_0 * (exp(-state.gap / d) - 1.)), Number(0.), Number(0.)};
  }

  double
  potential(const Ricochet::ContactPointState<> &state,
            const double /*cell_diameter*/) const
  {
    return state.gap < 0. ? p_0 * (d * std::expm1(-state.gap / d) + state.gap)
                          : 0.;
  }
};

#endif
