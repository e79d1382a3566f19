// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_frozen_tangent_h
#define ricochet_time_integration_frozen_tangent_h

#include <base/types.h>

namespace Ricochet
{
  /**
   * The tangent of a nonlinear body that served in the last steps: where it was made, and
   * how well it served. The stage solver has one, and a checkpoint, so that a resumed run
   * makes the same tangent again.
   *
   * What a tangent costs and the iterations that it takes more, as it grows old, are
   * shared by the steps in which it serves: a new one is made when the next step's
   * iterations are expected to be above that mean.
   */
  struct FrozenTangent
  {
    /// What making and factoring a tangent takes, in iterations with it: 12 to 14,
    /// measured with rings of 2000 to 60 000 unknowns.
    static constexpr double cost = 12.;

    /// What has to be stored besides #solution.
    struct Record
    {
      /// End and length of the step for which it was made (s).
      double end_time = 0., time_step = 0.;
      /// In how many steps it has served; 0: there is none.
      unsigned int n_steps = 0;
      /// Iterations of the first and the last one of them, and what all but the
      /// first took more than that.
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

    /// A new one, for a step to @p end_time that begins with @p solution.
    void
    begin(const double  end_time,
          const double  time_step,
          const Vector &solution);

    /// It has served in a step with so many iterations.
    void
    count(const unsigned int n_iterations);

    /// Whether it is worth while to use it once more, for a step of this length.
    bool
    serves(const double time_step) const;

    /// Whether both are made for the same step from the same state.
    bool
    is_same(const FrozenTangent &other) const;

    /// Whether it has served.
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

    /// By copy_values().
    FrozenTangent &
    operator=(const FrozenTangent &other);

    Record record;
    /// System vector where it was made (m): the state at the begin of that step.
    Vector solution;
  };
} // namespace Ricochet

#endif
