// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <time_integration/bdf2.h>

namespace Ricochet
{
  StepReport
  BDF2::step(SemiDiscreteSystem &system,
             const State        &old_state,
             const double        time_step,
             State              &new_state)
  {
    StepReport report;
    if (old_state.step_before > 0.)
      {
        stage.solve(system,
                    BackwardDifference::after(old_state.step_before, time_step),
                    old_state.solution_before,
                    old_state.velocity_before,
                    old_state,
                    old_state.time + time_step,
                    new_state,
                    report);
        system.reconstruct_massless(old_state, time_step, new_state);
      }
    else
      report = first_step.step(system, old_state, time_step, new_state);
    copy_values(old_state.solution, new_state.solution_before);
    copy_values(old_state.velocity, new_state.velocity_before);
    new_state.step_before = time_step;
    return report;
  }
} // namespace Ricochet
