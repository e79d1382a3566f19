// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_laws_ciarlet_geymonat_h
#define ricochet_materials_laws_ciarlet_geymonat_h

#include <materials/hyperelastic_law.h>

#include <cmath>

namespace Ricochet
{
  /**
   * The law of Ciarlet and Geymonat, which papers A (6.2) and B (6.2) call
   * Ogden's:
   *
   *     W = c1 (I1 - 3) + c2 (I2 - 3) + d (I3 - 1) - (c1 + 2 c2 + d) ln I3.
   *
   * For small strains its shear modulus is 2 (c1 + c2) and its first Lamé
   * parameter 4 (c2 + d).
   */
  struct CiarletGeymonat
  {
    /// Pa
    double c1 = 0.;
    /// Pa
    double c2 = 0.;
    /// Pa
    double d = 0.;

    static constexpr const char *name   = "Ciarlet-Geymonat";
    static constexpr const char *remark = "papers A and B call it Ogden's";

    static OwnParameters
    parameters()
    {
      return {OwnParameter("c1", .5e6)
                .means("Factor of I1 - 3", "Pa", ". Used by Ciarlet-Geymonat.")
                .at_least(1e-30)
                .belongs_to("the law Ciarlet-Geymonat"),
              OwnParameter("c2", 5e3)
                .means("Factor of I2 - 3", "Pa", ". Used by Ciarlet-Geymonat.")
                .at_least(0.)
                .belongs_to("the law Ciarlet-Geymonat"),
              OwnParameter("d", .35e6)
                .means("Factor of I3 - 1", "Pa", ". Used by Ciarlet-Geymonat.")
                .at_least(1e-30)
                .belongs_to("the law Ciarlet-Geymonat")};
    }

    static CiarletGeymonat
    make(const ParameterValues &values)
    {
      return {values["c1"], values["c2"], values["d"]};
    }

    LinearElastic
    at_small_strains() const
    {
      return {4. * (c2 + d), 2. * (c1 + c2)};
    }

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      using std::log;
      return c1 * (i.first - 3.) + c2 * (i.second - 3.) + d * (i.third - 1.) -
        (c1 + 2. * c2 + d) * log(i.third);
    }

    template <typename Number>
    Number
    energy_difference(const Invariants<Number> &i,
                      const Invariants<Number> &diff) const
    {
      return c1 * diff.first + c2 * diff.second + d * diff.third -
        (c1 + 2. * c2 + d) * log_of_one_plus(diff.third / i.third);
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      return {{Number(c1), Number(c2), d - (c1 + 2. * c2 + d) / i.third}};
    }

    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      std::array<std::array<Number, 3>, 3> result{};
      result[2][2] = (c1 + 2. * c2 + d) / (i.third * i.third);
      return result;
    }

    template <typename Number>
    Number
    plane_stress_c33(const Number &trace, const Number &determinant) const
    {
      return (c1 + 2. * c2 + d) / (c1 + c2 * trace + d * determinant);
    }
  };
} // namespace Ricochet

#endif
