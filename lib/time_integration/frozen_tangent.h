// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_frozen_tangent_h
#define ricochet_time_integration_frozen_tangent_h

#include <base/types.h>

namespace Ricochet
{
  /**
   * The frozen tangent of a nonlinear body, used in the last steps: the state for which
   * it was assembled, and the iterations with it. The stage solver keeps it, and so
   * does a checkpoint, so that a resumed run assembles the same tangent.
   *
   * Its cost and the additional iterations as it ages are averaged over the steps in
   * which it is used: a new one is assembled when the iterations of the next step
   * are expected to be above that mean.
   */
  struct FrozenTangent
  {
    /// Cost of assembling and factoring a tangent, in iterations with it: 12 to
    /// 14, measured with rings of 2000 to 60 000 unknowns.
    static constexpr double cost = 12.;

    /// Data to be stored besides #solution.
    struct Record
    {
      /// End and length of the step for which it was made (s).
      double end_time = 0., time_step = 0.;
      /// Number of steps in which it was used; 0: there is none.
      unsigned int n_steps = 0;
      /// Iterations of the first and the last one of them, and the sum of the
      /// additional iterations of all but the first.
      unsigned int first_iterations = 0, last_iterations = 0,
                   more_iterations = 0;

      template <typename Archive>
      void
      serialize(Archive &archive, const unsigned int /*version*/)
      {
        archive &end_time &time_step &n_steps &first_iterations &last_iterations
          &more_iterations;
      }
    };

    /// Set a new one, for a step to @p end_time that begins with @p solution.
    void
    begin(const double  end_time,
          const double  time_step,
          const Vector &solution);

    /// Count a step in which it was used, with its number of iterations.
    void
    count(const unsigned int n_iterations);

    /// Whether it is worth while to use it once more, for a step of this length.
    bool
    serves(const double time_step) const;

    /// Whether both are for the same step from the same state.
    bool
    is_same(const FrozenTangent &other) const;

    /// Whether it was used.
    bool
    exists() const
    {
      return record.n_steps > 0;
    }

    void
    forget()
    {
      record = {};
    }

    FrozenTangent()                      = default;
    FrozenTangent(const FrozenTangent &) = default;
    FrozenTangent(FrozenTangent &&)      = default;
    FrozenTangent &
    operator=(FrozenTangent &&) = default;

    /// Assignment by copy_values().
    FrozenTangent &
    operator=(const FrozenTangent &other);

    Record record;
    /// System vector of its state (m): that at the beginning of its step.
    Vector solution;
  };
} // namespace Ricochet

#endif
