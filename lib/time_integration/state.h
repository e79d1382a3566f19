// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_state_h
#define ricochet_time_integration_state_h

#include <base/types.h>

#include <vector>

namespace Ricochet
{
  /// All data that a time scheme needs to continue from an instant. All vectors
  /// are system vectors without ghost values; the entries of the multipliers in
  /// velocity, acceleration and forces are zero.
  struct State
  {
    /// s
    double time = 0.;
    /// Displacements (m) and multipliers (Pa).
    Vector solution;
    /// m/s
    Vector velocity;
    /// Acceleration at this instant; for the midpoint scheme the mean over the last
    /// step (m/s^2).
    Vector acceleration;
    /// Contact force at this instant (two-point treatments: over the last
    /// step), on the side of the internal forces (N).
    Vector contact_force;
    /// The part of contact_force that is friction, and the viscous force, on the side of
    /// the internal forces (N): for schemes with forces of instants. Of size 0 without.
    Vector friction_force, viscous_force;
    /// The parts of contact_force of several contacts (N), see
    /// ContactOperator::shares(); empty where there is only one.
    std::vector<Vector> contact_shares;
    /// Mean velocity over the last step, (u_new - u_old)/dt (m/s), which
    /// predictors of the gap need; kept by the midpoint scheme.
    Vector mean_velocity;
    /// The force -M a of the scheme's own equation of motion (N); used by the
    /// energy balance only.
    Vector scheme_force;
    /// The state a step before, displacements (m) and velocity (m/s), and the length of that
    /// step (s), 0 for none; kept by schemes of several steps.
    Vector solution_before, velocity_before;
    double step_before = 0.;

    State()              = default;
    State(const State &) = default;
    State(State &&)      = default;
    State &
    operator=(State &&) = default;

    /// Assignment by copy_values().
    State &
    operator=(const State &other);
  };
} // namespace Ricochet

#endif
