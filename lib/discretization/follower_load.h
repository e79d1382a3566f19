// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_follower_load_h
#define ricochet_discretization_follower_load_h

#include <base/types.h>

namespace Ricochet
{
  /// A load from outside that depends on where the body is, over a step or at an instant.
  /// All vectors are system vectors without ghost values; all functions are collective.
  class FollowerLoad
  {
  public:
    virtual ~FollowerLoad() = default;

    /// The force (N) on the body over the step from @p begin to @p end (s);
    /// with equal ends, the force at that instant.
    virtual void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  begin,
               const double  end,
               Vector       &force) const = 0;

    /// @p tangent -= @p weight times the derivative of step_force() with respect to the
    /// new solution. The force is symmetric in both ends.
    virtual void
    subtract_step_tangent(const double  weight,
                          const Vector &old_solution,
                          const Vector &new_solution,
                          const double  begin,
                          const double  end,
                          Matrix       &tangent) const = 0;

    /// The force (N) at an instant, @p time (s).
    void
    force_at(const Vector &solution, const double time, Vector &force) const
    {
      step_force(solution, solution, time, time, force);
    }

    /// @p tangent -= @p weight times the derivative of force_at(): both ends of the step
    /// change alike.
    void
    subtract_tangent_at(const double  weight,
                        const Vector &solution,
                        const double  time,
                        Matrix       &tangent) const
    {
      subtract_step_tangent(2. * weight,
                            solution,
                            solution,
                            time,
                            time,
                            tangent);
    }
  };
} // namespace Ricochet

#endif
