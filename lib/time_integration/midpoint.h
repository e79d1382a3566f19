// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_midpoint_h
#define ricochet_time_integration_midpoint_h

#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /**
   * The midpoint scheme (papers A (3.2), B (3.1), C (38)),
   *
   *     M (v_new - v_old)/dt + f(u_old, u_new) = (L_old + L_new)/2,
   *     (u_new - u_old)/dt = (v_old + v_new)/2,
   *
   * where the bulk force is the discrete derivative of the stored energy
   * (Gonzalez' stress for hyperelastic bodies) plus the viscous force. Two-point
   * treatments depend on both ends of the step: improved normal compliance and
   * Hauret-Le Tallec are discrete derivatives, persistent contact is a condition
   * on the change of the gap, and with Nitsche-hybrid this is the hybrid scheme
   * of paper C. All other treatments are enforced at the end of the step, where
   * Signorini, penalty and standard compliance only dissipate.
   */
  class Midpoint : public TimeScheme
  {
  public:
    static SchemeTraits
    traits()
    {
      return {"midpoint", /* contact_over_step */ true};
    }

    static std::string
    about()
    {
      return "A (3.2), B (3.1); with the Nitsche-hybrid treatment this is the "
             "hybrid scheme, C (38)";
    }

    static OwnParameters
    parameters()
    {
      return {};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &)
    {
      return std::make_unique<Midpoint>();
    }

    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

    bool
    contact_force_is_of_step() const override
    {
      return true;
    }

  private:
    Stage  stage;
    Vector work;
  };
} // namespace Ricochet

#endif
