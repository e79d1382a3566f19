// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_arkode_h
#define ricochet_time_integration_arkode_h

#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /**
   * SUNDIALS' ARKODE: an explicit Runge-Kutta method with its own, error
   * controlled steps, for the semi-discrete Nitsche and penalty systems. They
   * are Lipschitz differential equations (paper C, (11), and so (15)), so that an
   * independent code can check the hand-written schemes.
   *
   * It starts afresh in each step of the output, so that a run that is resumed
   * gives the same numbers. Its work against contact is taken from the
   * potential of the law; what is then left of the balance is the integration
   * error.
   */
  class ARKode : public TimeScheme
  {
  public:
    ARKode(const double relative_tolerance, const double absolute_tolerance);

    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

    bool
    integrates_by_itself() const override
    {
      return true;
    }

  private:
    const double relative_tolerance, absolute_tolerance;
  };
} // namespace Ricochet

#endif
