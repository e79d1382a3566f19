// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_generalised_alpha_h
#define ricochet_time_integration_generalised_alpha_h

#include <time_integration/time_scheme.h>

namespace Ricochet
{
  /**
   * Newmark's formulas,
   *
   *     u_new = u_old + dt v_old + dt^2 ((1/2 - beta) a_old + beta a_new),
   *     v_new = v_old + dt ((1 - gamma) a_old + gamma a_new),
   *
   * with weighted means of both ends in the equation of motion,
   *
   *     M ((1 - alpha_m) a_new + alpha_m a_old) + (1 - alpha_f) F(u_new)
   *     + alpha_f F(u_old) = 0,
   *
   * where F is the internal and contact force less the load: the generalised-alpha
   * method (Chung and Hulbert, Journal of Applied Mechanics 60, 1993). With the spectral
   * radius rho of infinitely fast oscillations it is of second order, damps slow ones the
   * least, and has
   *
   *     alpha_m = (2 rho - 1)/(rho + 1),     alpha_f = rho/(rho + 1),
   *     beta = (1 - alpha_m + alpha_f)^2/4,  gamma = 1/2 - alpha_m + alpha_f.
   *
   * HHT and Newmark's method are the same with other coefficients.
   */
  class GeneralisedAlpha : public TimeScheme
  {
  public:
    struct Coefficients
    {
      double alpha_m = 0., alpha_f = 0., beta = .25, gamma = .5;
    };

    explicit GeneralisedAlpha(const Coefficients &coefficients)
      : coefficients(coefficients)
    {}

    /// @param radius spectral radius of infinitely fast oscillations.
    explicit GeneralisedAlpha(const double radius)
      : GeneralisedAlpha(of_radius(radius))
    {}

    static SchemeTraits
    traits()
    {
      return SchemeTraits::at_instants_with_rates("generalised-alpha");
    }

    static std::string
    about()
    {
      return "Chung and Hulbert 1993";
    }

    static OwnParameters
    parameters()
    {
      return {
        OwnParameter("Spectral radius", .8)
          .means("Spectral radius of infinitely fast oscillations, from 1 "
                 "(not damped) to 0 (gone after a step). Used by "
                 "generalised-alpha.",
                 "",
                 "")
          .at_least(0.)
          .at_most(1.)
          .belongs_to("the time scheme generalised-alpha")};
    }

    static std::unique_ptr<TimeScheme>
    make(const ParameterValues &values)
    {
      return std::make_unique<GeneralisedAlpha>(values["Spectral radius"]);
    }

    StepReport
    step(SemiDiscreteSystem &system,
         const State        &old_state,
         const double        time_step,
         State              &new_state) override;

  private:
    static Coefficients
    of_radius(const double radius)
    {
      const double alpha_m = (2. * radius - 1.) / (radius + 1.),
                   alpha_f = radius / (radius + 1.),
                   sum     = 1. - alpha_m + alpha_f;
      return {alpha_m, alpha_f, .25 * sum * sum, sum - .5};
    }

    const Coefficients coefficients;
    Stage              stage;
    // Work space.
    Vector predicted, old_force, new_force, load, mass_times_jump, work;
  };



  /// The common terms of the energy balance of schemes whose forces are those of
  /// instants: external work, work against contact and friction, and viscous dissipation
  /// by the trapezoidal rule, i.e. the mean of both forces times the increment of
  /// displacement. Terms of contact, friction and viscosity may have either sign.
  void
  add_trapezoidal_works(const SemiDiscreteSystem &system,
                        const State              &old_state,
                        const State              &new_state,
                        StepReport               &report);
} // namespace Ricochet

#endif
