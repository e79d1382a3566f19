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
   * The integration restarts in each step of the output, so that a resumed run
   * gives the same numbers. The work against contact is taken from the
   * potential of the law; the remaining error of the balance is that of the
   * integration.
   */
  class ARKode : public TimeScheme
  {
  public:
    ARKode(const double relative_tolerance, const double absolute_tolerance);

    static SchemeTraits
    traits()
    {
      return {"ARKODE",
              /* contact_over_step */ false,
              /* needs_potential */ true};
    }

    static std::string
    about()
    {
      return "adaptive Runge-Kutta of SUNDIALS, for treatments with a potential, "
             "as a check";
    }

    static OwnParameters
    parameters()
    {
      return {
        OwnParameter("ARKODE relative tolerance", 1e-8)
          .means("Relative error allowed per step. Used by ARKODE.", "", "")
          .at_least(1e-14)
          .at_most(1e-2)
          .belongs_to("the time scheme ARKODE"),
        OwnParameter("ARKODE absolute tolerance", 1e-10)
          .means(
            "Absolute error allowed per step, in m and m/s. Used by ARKODE.",
            "",
            "")
          .at_least(1e-16)
          .at_most(1.)
          .belongs_to("the time scheme ARKODE")};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &values)
    {
      return std::make_unique<ARKode>(values["ARKODE relative tolerance"],
                                      values["ARKODE absolute tolerance"]);
    }

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
