// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_slip_rate_friction_h
#define ricochet_contact_laws_slip_rate_friction_h

#include <base/own_parameter.h>

#include <cmath>
#include <string>

namespace Ricochet
{
  /**
   * Coulomb's friction with a coefficient that depends on the slip rate (paper A, 2.3),
   *
   *     mu(v) = (a - b) exp(-alpha |v|) + b,
   *
   * from a at rest to b for fast slip: with a large alpha the static and the dynamic
   * coefficient of the textbooks.
   */
  struct SlipRateFriction
  {
    /// a and b (1), alpha (s/m).
    double at_rest = 0., at_fast_slip = 0., decay = 0.;

    static constexpr const char *name = "slip-rate dependent";

    static OwnParameters
    parameters()
    {
      const std::string owner = "slip-rate dependent friction";
      return {
        OwnParameter("Static coefficient", 1.5)
          .means("Coefficient of friction at rest (paper A, 2.3: a). Used by "
                 "slip-rate dependent friction.",
                 "",
                 "")
          .at_least(0.)
          .belongs_to(owner),
        OwnParameter("Dynamic coefficient", .5)
          .means("Coefficient of friction for fast slip (paper A, 2.3: b). "
                 "Used by slip-rate dependent friction.",
                 "",
                 "")
          .at_least(0.)
          .belongs_to(owner),
        OwnParameter("Slip-rate decay", 100.)
          .means(
            "Parameter alpha by which the coefficient goes from one to the "
            "other with the slip rate",
            "s/m",
            " (paper A, 2.3). Used by slip-rate dependent friction.")
          .at_least(0.)
          .belongs_to(owner)};
    }

    static SlipRateFriction
    make(const ParameterValues &values)
    {
      return {values["Static coefficient"],
              values["Dynamic coefficient"],
              values["Slip-rate decay"]};
    }

    static std::string
    absent(const ParameterValues &values)
    {
      const SlipRateFriction law = make(values);
      return law.at_rest > 0. || law.at_fast_slip > 0.
        ? ""
        : "both coefficients are 0";
    }

    template <typename Number>
    Number
    limit(const Number &pressure, const Number &slip_speed) const
    {
      using std::exp;
      return ((at_rest - at_fast_slip) * exp(Number(-decay * slip_speed)) +
              at_fast_slip) *
        pressure;
    }
  };
} // namespace Ricochet

#endif
