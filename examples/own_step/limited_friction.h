// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef own_step_limited_friction_h
#define own_step_limited_friction_h

#include <contact/treatments/contact_law_table.h>

/**
 * A user's friction law: Coulomb's until the traction reaches the strength of
 * the surface in shear, which no pressure raises, as in metal forming.
 */
struct LimitedFriction
{
  /// mu
  double coefficient = 0.;
  /// Pa
  double strength = 1.;

  static constexpr const char *name = "limited by shear";

  static Ricochet::OwnParameters
  parameters()
  {
    using Ricochet::OwnParameter;
    return {OwnParameter("Limited coefficient", .3)
              .means("Coefficient of friction while pressures are small. Used "
                     "by limited by shear.",
                     "",
                     "")
              .at_least(0.)
              .belongs_to("the friction law limited by shear"),
            OwnParameter("Shear strength", 1e3)
              .means("Largest traction of friction",
                     "Pa",
                     ". Used by limited by shear.")
              .at_least(1e-30)
              .belongs_to("the friction law limited by shear")};
  }

  static LimitedFriction
  make(const Ricochet::ParameterValues &values)
  {
    return {values["Limited coefficient"], values["Shear strength"]};
  }

  template <typename Number>
  Number
  limit(const Number &pressure, const Number & /*slip_speed*/) const
  {
    return coefficient * pressure < strength ? Number(coefficient * pressure)
                                             : Number(strength);
  }
};

#endif
