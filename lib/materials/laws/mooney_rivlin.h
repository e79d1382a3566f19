// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_laws_mooney_rivlin_h
#define ricochet_materials_laws_mooney_rivlin_h

#include <materials/hyperelastic_law.h>

#include <cmath>

namespace Ricochet
{
  /**
   * The law of Mooney (1940) and Rivlin (1948) for rubber, slightly compressible (for
   * instance Holzapfel, "Nonlinear solid mechanics", 2000, (6.147)), with the isochoric
   * invariants x = I1 I3^(-1/3), y = I2 I3^(-2/3) and J^2 = I3:
   *
   *     W = c10 (x - 3) + c01 (y - 3) + K/2 (J - 1)^2.
   *
   * At rest the shear modulus is 2 (c10 + c01), the bulk modulus K.
   */
  struct MooneyRivlin
  {
    /// Pa
    double c10 = 0., c01 = 0., bulk_modulus = 0.;

    static constexpr const char *name = "Mooney-Rivlin";

    static OwnParameters
    parameters()
    {
      const std::string owner = "the law Mooney-Rivlin";
      return {OwnParameter("Mooney c10", 1.5e5)
                .means("Factor of the first isochoric invariant",
                       "Pa",
                       " in the law Mooney-Rivlin; c10 + c01 is half of the "
                       "shear modulus at rest.")
                .at_least(1e-30)
                .belongs_to(owner),
              OwnParameter("Mooney c01", 5e4)
                .means("Factor of the second isochoric invariant",
                       "Pa",
                       " in the law Mooney-Rivlin.")
                .at_least(0.)
                .belongs_to(owner),
              OwnParameter("Mooney bulk modulus", 4e6)
                .means("Bulk modulus K at rest",
                       "Pa",
                       " in the law Mooney-Rivlin.")
                .at_least(1e-30)
                .belongs_to(owner)};
    }

    static MooneyRivlin
    make(const ParameterValues &values)
    {
      return {values["Mooney c10"],
              values["Mooney c01"],
              values["Mooney bulk modulus"]};
    }

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      using std::cbrt;
      using std::sqrt;
      const Number a = 1. / cbrt(i.third), j = sqrt(i.third);
      return c10 * (i.first * a - 3.) + c01 * (i.second * a * a - 3.) +
        .5 * bulk_modulus * (j - 1.) * (j - 1.);
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      using std::cbrt;
      using std::sqrt;
      const Number a = 1. / cbrt(i.third);
      return {{Number(c10 * a),
               Number(c01 * a * a),
               Number(-(c10 * i.first + 2. * c01 * i.second * a) * a /
                        (3. * i.third) +
                      .5 * bulk_modulus * (1. - 1. / sqrt(i.third)))}};
    }

    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      using std::cbrt;
      using std::sqrt;
      const Number a = 1. / cbrt(i.third), per_third = 1. / (3. * i.third);
      std::array<std::array<Number, 3>, 3> result{};
      result[0][2] = result[2][0] = -c10 * a * per_third;
      result[1][2] = result[2][1] = -2. * c01 * a * a * per_third;
      result[2][2] = (4. * c10 * i.first + 10. * c01 * i.second * a) * a *
          per_third * per_third +
        .25 * bulk_modulus / (i.third * sqrt(i.third));
      return result;
    }
  };
} // namespace Ricochet

#endif
