// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef own_step_gent_h
#define own_step_gent_h

#include <materials/material_table.h>

#include <array>
#include <cmath>

/**
 * A user's material: the law of Gent for rubber whose chains can be stretched so far and no
 * farther (Rubber Chemistry and Technology 69, 1996, 59-61), slightly compressible, with the
 * deviation x = I1 I3^(-1/3) - 3, its limit m and J^2 = I3:
 *
 *     W = - mu m/2 ln(1 - x/m) + K/2 (J - 1)^2.
 *
 * The shear modulus at rest is mu, the bulk modulus K.
 */
struct Gent
{
  /// Pa; the limit is a number.
  double shear_modulus = 0., limit = 0., bulk_modulus = 0.;

  static constexpr const char *name = "Gent";

  static Ricochet::OwnParameters
  parameters()
  {
    using Ricochet::OwnParameter;
    return {OwnParameter("Gent shear modulus", 4e5)
              .means("Shear modulus at rest", "Pa", ". Used by Gent.")
              .at_least(1e-30)
              .belongs_to("the law Gent"),
            OwnParameter("Gent limit", 50.)
              .means("Deviation at which chains are straight",
                     "1",
                     ". Used by Gent.")
              .at_least(1e-3)
              .belongs_to("the law Gent"),
            OwnParameter("Bulk modulus", 1e6)
              .means("Bulk modulus", "Pa", ". Used by Gent.")
              .at_least(1e-30)
              .belongs_to("the law Gent")};
  }

  static Gent
  make(const Ricochet::ParameterValues &values)
  {
    return {values["Gent shear modulus"],
            values["Gent limit"],
            values["Bulk modulus"]};
  }

  template <typename Number>
  Number
  energy(const Ricochet::Invariants<Number> &i) const
  {
    using std::cbrt;
    using std::log;
    using std::sqrt;
    const Number x = i.first / cbrt(i.third) - 3., j = sqrt(i.third);
    return -.5 * shear_modulus * limit * log(Number(1. - x / limit)) +
      .5 * bulk_modulus * (j - 1.) * (j - 1.);
  }

  template <typename Number>
  std::array<Number, 3>
  gradient(const Ricochet::Invariants<Number> &i) const
  {
    using std::cbrt;
    using std::sqrt;
    const Number a = 1. / cbrt(i.third), x = i.first * a - 3.;
    const Number slope = .5 * shear_modulus / (1. - x / limit);
    return {{Number(slope * a),
             Number(0.),
             Number(-slope * i.first * a / (3. * i.third) +
                    .5 * bulk_modulus * (1. - 1. / sqrt(i.third)))}};
  }

  template <typename Number>
  std::array<std::array<Number, 3>, 3>
  hessian(const Ricochet::Invariants<Number> &i) const
  {
    using std::cbrt;
    using std::sqrt;
    const Number a = 1. / cbrt(i.third), x = i.first * a - 3.;
    const Number left      = 1. - x / limit;
    const Number slope     = .5 * shear_modulus / left;
    const Number curvature = slope / (limit * left);
    // Derivatives of x along I3, once and twice, and mixed.
    const Number x_3  = -i.first * a / (3. * i.third);
    const Number x_33 = -4. * x_3 / (3. * i.third);
    const Number x_13 = -a / (3. * i.third);

    std::array<std::array<Number, 3>, 3> result{};
    result[0][0] = curvature * a * a;
    result[0][2] = result[2][0] = curvature * a * x_3 + slope * x_13;
    result[2][2]                = curvature * x_3 * x_3 + slope * x_33 +
      .25 * bulk_modulus / (i.third * sqrt(i.third));
    return result;
  }
};

#endif
