// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef own_step_yeoh_h
#define own_step_yeoh_h

#include <materials/material_table.h>

#include <array>
#include <cmath>

/**
 * A user's material: Yeoh's law for filled rubber (Rubber Chemistry and
 * Technology 66, 1993), slightly compressible, with the deviation x = I1
 * I3^(-1/3) - 3 and J^2 = I3:
 *
 *     W = c10 x + c20 x^2 + c30 x^3 + K/2 (J - 1)^2.
 *
 * The shear modulus at rest is 2 c10, the bulk modulus K.
 */
struct Yeoh
{
  /// Pa
  double c10 = 0., c20 = 0., c30 = 0., bulk_modulus = 0.;

  static constexpr const char *name = "Yeoh";

  static Ricochet::OwnParameters
  parameters()
  {
    using Ricochet::OwnParameter;
    return {OwnParameter("Yeoh c10", 2e5)
              .means("Factor of the deviation", "Pa", ". Used by Yeoh.")
              .at_least(1e-30)
              .belongs_to("the law Yeoh"),
            OwnParameter("Yeoh c20", -2e3)
              .means("Factor of its square", "Pa", ". Used by Yeoh.")
              .belongs_to("the law Yeoh"),
            OwnParameter("Yeoh c30", 1e3)
              .means("Factor of its cube", "Pa", ". Used by Yeoh.")
              .at_least(0.)
              .belongs_to("the law Yeoh"),
            OwnParameter("Bulk modulus", 1e6)
              .means("Bulk modulus", "Pa", ". Used by Yeoh.")
              .at_least(1e-30)
              .belongs_to("the law Yeoh")};
  }

  static Yeoh
  make(const Ricochet::ParameterValues &values)
  {
    return {values["Yeoh c10"],
            values["Yeoh c20"],
            values["Yeoh c30"],
            values["Bulk modulus"]};
  }

  template <typename Number>
  Number
  energy(const Ricochet::Invariants<Number> &i) const
  {
    using std::cbrt;
    using std::sqrt;
    const Number x = i.first / cbrt(i.third) - 3., j = sqrt(i.third);
    return x * (c10 + x * (c20 + x * c30)) +
      .5 * bulk_modulus * (j - 1.) * (j - 1.);
  }

  template <typename Number>
  std::array<Number, 3>
  gradient(const Ricochet::Invariants<Number> &i) const
  {
    using std::cbrt;
    using std::sqrt;
    const Number a = 1. / cbrt(i.third), x = i.first * a - 3.;
    const Number slope = c10 + x * (2. * c20 + x * 3. * c30);
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
    const Number slope     = c10 + x * (2. * c20 + x * 3. * c30);
    const Number curvature = 2. * c20 + 6. * x * c30;
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
