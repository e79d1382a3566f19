// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_static_equilibrium_h
#define ricochet_time_integration_static_equilibrium_h

#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /**
   * Static equilibrium at the end of each load step, F(u_new) = 0, where F is the internal
   * and contact force less the load; time is the parameter of the load. Friction and
   * viscosity act by the rate (u_new - u_old)/dt.
   *
   * Works are those of the trapezoidal rule, as in other schemes with forces of instants;
   * so the energy balance of a step has a remainder, which is in the column of the
   * numerical dissipation: for a nonlinear body the error of the rule along the path, and
   * half of what a load does that is not in equilibrium at the beginning, say one that is
   * applied at once.
   *
   * A body that no support holds, but perhaps contact, has a singular stiffness. Its
   * equilibrium is the limit of
   *
   *     c M (x_k - x_(k-1)) + F(x_k) = 0,
   *
   * in which c falls with the imbalance c M (x_k - x_(k-1)): pseudo-transient continuation
   * (Kelley and Keyes, SIAM Journal on Numerical Analysis 35, 1998). It is the last resort
   * of bodies that are held, too, where there is no equilibrium near the last one: an arch
   * snaps through, a node slips off an edge. The energy that a motion would
   * take away then is in the same column.
   */
  class StaticEquilibrium : public TimeScheme
  {
  public:
    static SchemeTraits
    traits()
    {
      SchemeTraits traits = SchemeTraits::at_instants_with_rates("static");
      traits.has_inertia  = false;
      return traits;
    }

    static std::string
    about()
    {
      return "equilibrium at the end of each load step";
    }

    static OwnParameters
    parameters()
    {
      return {};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &)
    {
      return std::make_unique<StaticEquilibrium>();
    }

    /// @throws NewtonFailure, and ComputationError where bodies that nothing holds find no
    /// rest.
    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

    /// @throws NewtonFailure where no equilibrium is found.
    StepReport
    step_of_last_resort(SemiDiscreteSystem &system,
                        const State        &old_state,
                        const double        time_step,
                        State              &new_state) override;

    bool
    has_last_resort() const override
    {
      return true;
    }

  private:
    /// @param is_last_resort by pseudo-transient continuation.
    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         const bool          is_last_resort,
         State              &new_state);

    /// Solve #stage by pseudo-transient continuation. @throws NewtonFailure, and
    /// ComputationError where bodies that nothing holds find no rest.
    SolverReport
    find_rest(SemiDiscreteSystem &system,
              const State        &old_state,
              State              &new_state);

    Stage stage;
    // Work space.
    Vector force, increment, old_reaction, new_reaction;
  };
} // namespace Ricochet

#endif
