// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_laws_yeoh_h
#define ricochet_materials_laws_yeoh_h

#include <materials/hyperelastic_law.h>

#include <array>
#include <cmath>

namespace Ricochet
{
  /**
   * The law of Yeoh for filled rubber (Rubber Chemistry and Technology 66, 1993, 754-771),
   * slightly compressible, with the deviation x = I1 I3^(-1/3) - 3 and J^2 = I3:
   *
   *     W = c10 x + c20 x^2 + c30 x^3 + K/2 (J - 1)^2.
   *
   * At rest the shear modulus is 2 c10, the bulk modulus K.
   */
  struct Yeoh
  {
    /// Pa
    double c10 = 0., c20 = 0., c30 = 0., bulk_modulus = 0.;

    static constexpr const char *name = "Yeoh";

    static OwnParameters
    parameters()
    {
      const std::string owner = "the law Yeoh";
      return {
        OwnParameter("Yeoh c10", 2e5)
          .means("Factor of the deviation",
                 "Pa",
                 " of the first isochoric invariant in the law Yeoh; half of "
                 "the shear modulus at rest.")
          .at_least(1e-30)
          .belongs_to(owner),
        OwnParameter("Yeoh c20", -2e3)
          .means("Factor of the square of the deviation",
                 "Pa",
                 " in the law Yeoh.")
          .belongs_to(owner),
        OwnParameter("Yeoh c30", 1e3)
          .means("Factor of the cube of the deviation",
                 "Pa",
                 " in the law Yeoh.")
          .at_least(0.)
          .belongs_to(owner),
        OwnParameter("Yeoh bulk modulus", 4e6)
          .means("Bulk modulus K at rest", "Pa", " in the law Yeoh.")
          .at_least(1e-30)
          .belongs_to(owner)};
    }

    static Yeoh
    make(const ParameterValues &values)
    {
      return {values["Yeoh c10"],
              values["Yeoh c20"],
              values["Yeoh c30"],
              values["Yeoh bulk modulus"]};
    }

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      using std::cbrt;
      using std::sqrt;
      const Number x = i.first / cbrt(i.third) - 3., j = sqrt(i.third);
      return x * (c10 + x * (c20 + x * c30)) +
        .5 * bulk_modulus * (j - 1.) * (j - 1.);
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
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
    hessian(const Invariants<Number> &i) const
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

} // namespace Ricochet

#endif
