// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_stage_h
#define ricochet_time_integration_stage_h

#include <base/types.h>

namespace Ricochet
{
  /**
   * One nonlinear system, as every time scheme poses it: find x such that
   *
   *     inertia M (x - inertia_origin) + bulk force + contact force = load,
   *
   * where the forces are either weighted sums of their values at the old and
   * the new point, or those of a whole step between both.
   */
  struct Stage
  {
    /// 1/s^2
    double inertia = 0.;
    /// m
    Vector inertia_origin;

    /// Length of the step (s); needed by step forces and predictors of the gap, so by
    /// the midpoint scheme only.
    double time_step = 0.;
    /// Time of the new point (s), which determines the positions of obstacles.
    double end_time = 0.;

    /// The bulk force is that of a step; its weights are not used.
    bool   bulk_step_force = false;
    double bulk_weight_new = 1.;
    double bulk_weight_old = 0.;

    /// With a two-point contact law, contact_weight_new is 1.
    double contact_weight_new = 1.;
    double contact_weight_old = 0.;

    /// The velocity at the new point is (x - rate_origin) / rate_time (m; s): for
    /// friction and viscosity of schemes whose forces are those of instants, see
    /// SemiDiscreteSystem::needs_rates().
    Vector rate_origin;
    double rate_time = 0.;

    /// The solution is so near to the last state that a nonlinear body may be solved with
    /// the tangent there; not so in a load step.
    bool is_near_last_state = true;

    /// External load (N), already weighted.
    Vector load;
  };
} // namespace Ricochet

#endif
