// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_bdf2_h
#define ricochet_time_integration_bdf2_h

#include <time_integration/backward_difference.h>
#include <time_integration/tr_bdf2.h>

#include <cmath>

namespace Ricochet
{
  /**
   * The backward difference formula of second order over two steps, whose lengths may
   * differ: L-stable, with one stage in a step. The first step, which has none before it, is
   * that of TR-BDF2. The last two states are part of the State.
   */
  class BDF2 : public TimeScheme
  {
  public:
    BDF2()
      : first_step(2. - std::sqrt(2.))
    {}

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("BDF2");
    }

    static std::string
    about()
    {
      return "backward differences over two steps";
    }

    static OwnParameters
    parameters()
    {
      return {};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &)
    {
      return std::make_unique<BDF2>();
    }

    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

  private:
    TRBDF2                  first_step;
    BackwardDifferenceStage stage;
  };
} // namespace Ricochet

#endif
