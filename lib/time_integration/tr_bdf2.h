// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_tr_bdf2_h
#define ricochet_time_integration_tr_bdf2_h

#include <time_integration/backward_difference.h>
#include <time_integration/hht.h>

namespace Ricochet
{
  /**
   * TR-BDF2 (paper C, (33)): the trapezoidal rule over gamma dt, then the
   * second-order backward difference formula over the whole step. L-stable.
   */
  class TRBDF2 : public TimeScheme
  {
  public:
    explicit TRBDF2(const double gamma);

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("TR-BDF2");
    }

    static std::string
    about()
    {
      return "C, (33)";
    }

    static OwnParameters
    parameters()
    {
      // Default exact to round-off: both stages share a matrix only if gamma is
      // 2 - sqrt(2).
      return {OwnParameter("TR-BDF2 gamma", 0.5857864376269049)
                .means("Fraction of the step that the trapezoidal rule takes "
                       "(paper C: gamma tilde); at 2 - sqrt(2) both stages "
                       "have the same matrix. Used by TR-BDF2.",
                       "",
                       "")
                .at_least(.01)
                .at_most(.99)
                .belongs_to("the time scheme TR-BDF2")};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &values)
    {
      return std::make_unique<TRBDF2>(values["TR-BDF2 gamma"]);
    }

    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

  private:
    const double gamma;
    // y_new = a_middle y_middle - a_old y_old + a_rate dt y'_new
    const double            a_middle, a_old;
    double                  a_rate;
    HHT                     trapezoidal_rule;
    State                   middle;
    BackwardDifferenceStage stage;
  };
} // namespace Ricochet

#endif
