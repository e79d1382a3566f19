// SPDX-License-Identifier: LGPL-2.1-or-later
#include <time_integration/tr_bdf2.h>

#include <cmath>

namespace Ricochet
{
  TRBDF2::TRBDF2(const double gamma)
    : gamma(gamma)
    , a_middle(1. / (gamma * (2. - gamma)))
    , a_old((1. - gamma) * (1. - gamma) / (gamma * (2. - gamma)))
    , a_rate((1. - gamma) / (2. - gamma))
    , trapezoidal_rule(0.)
  {
    // At gamma = 2 - sqrt(2) both stages have the same matrix, except for
    // round-off.
    if (std::abs(a_rate - .5 * gamma) < 1e-14)
      a_rate = .5 * gamma;
  }



  StepReport
  TRBDF2::step(SemiDiscreteSystem &system,
               const State        &old_state,
               const double        time_step,
               State              &new_state)
  {
    const double dt = time_step;

    StepReport report =
      trapezoidal_rule.step(system, old_state, gamma * dt, middle);
    // The product in the order in which the trapezoidal rule multiplies, so that equal means
    // equal to the last digit.
    stage.solve(system,
                {a_middle, a_old, a_rate * dt},
                old_state.solution,
                old_state.velocity,
                middle,
                old_state.time + dt,
                new_state,
                report);
    system.reconstruct_massless(old_state, dt, new_state);
    return report;
  }
} // namespace Ricochet
