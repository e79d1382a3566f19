// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_backward_difference_h
#define ricochet_time_integration_backward_difference_h

#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /**
   * The backward difference formula of second order for steps of different lengths,
   *
   *     y_new = of_last y_last - of_before y_before + rate_step y'_new,
   *
   * with y for displacement and velocity (Hairer, Norsett and Wanner, "Solving ordinary
   * differential equations I", 1993, (III.5.5)).
   */
  struct BackwardDifference
  {
    double of_last = 0., of_before = 0.;
    /// s
    double rate_step = 0.;

    /// @param step length of the step (s). @param step_before that of the step before it.
    static BackwardDifference
    after(const double step_before, const double step)
    {
      const double ratio = step / step_before, all = 1. + 2. * ratio;
      return {(1. + ratio) * (1. + ratio) / all,
              ratio * ratio / all,
              (1. + ratio) / all * step};
    }
  };

  /// The stage of a scheme in which that formula holds, with its energy balance.
  class BackwardDifferenceStage
  {
  public:
    /**
     * Advance from the states "before" and @p last to @p new_state at @p end_time (s), and
     * add to @p report the balance between @p last and @p new_state.
     *
     * @param solution_before displacements (m). @param velocity_before (m/s).
     * @throws NewtonFailure
     */
    void
    solve(SemiDiscreteSystem       &system,
          const BackwardDifference &formula,
          const Vector             &solution_before,
          const Vector             &velocity_before,
          const State              &last,
          const double              end_time,
          State                    &new_state,
          StepReport               &report);

  private:
    Stage stage;
    // Work space.
    Vector last_force, new_force, work, increment, velocity_increment;
  };
} // namespace Ricochet

#endif
