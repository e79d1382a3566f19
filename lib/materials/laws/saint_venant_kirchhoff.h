// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_laws_saint_venant_kirchhoff_h
#define ricochet_materials_laws_saint_venant_kirchhoff_h

#include <materials/hyperelastic_law.h>

namespace Ricochet
{
  /**
   * Saint Venant and Kirchhoff's law, linear between Green-Lagrange strain
   * E = (C - I)/2 and second Piola-Kirchhoff stress:
   *
   *     W = lambda/2 tr(E)^2 + mu tr(E^2).
   *
   * For large rotations and small strains; it softens under compression, and an
   * element can be pressed flat with finite energy.
   */
  struct SaintVenantKirchhoff
  {
    /// Pa
    double lambda = 0.;
    /// Pa
    double mu = 0.;

    static constexpr const char *name = "Saint Venant-Kirchhoff";

    static OwnParameters
    parameters()
    {
      return LinearElastic::parameters();
    }

    static SaintVenantKirchhoff
    make(const ParameterValues &values)
    {
      const LinearElastic lame = LinearElastic::make(values);
      return {lame.lambda, lame.mu};
    }

    LinearElastic
    at_small_strains() const
    {
      return {lambda, mu};
    }

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      return Number(lambda / 8. * (i.first - 3.) * (i.first - 3.) +
                    mu / 4. *
                      (i.first * i.first - 2. * i.second - 2. * i.first + 3.));
    }

    template <typename Number>
    Number
    energy_difference(const Invariants<Number> &i,
                      const Invariants<Number> &diff) const
    {
      return diff.first *
        (lambda / 8. * (2. * (i.first - 3.) + diff.first) +
         mu / 4. * (2. * (i.first - 1.) + diff.first)) -
        mu / 2. * diff.second;
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      return {{lambda / 4. * (i.first - 3.) + mu / 2. * (i.first - 1.),
               Number(-mu / 2.),
               Number(0.)}};
    }

    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &) const
    {
      std::array<std::array<Number, 3>, 3> result{};
      result[0][0] = Number(lambda / 4. + mu / 2.);
      return result;
    }

    template <typename Number>
    Number
    plane_stress_c33(const Number &trace, const Number & /*determinant*/) const
    {
      return 1. - lambda / (lambda + 2. * mu) * (trace - 2.);
    }
  };
} // namespace Ricochet

#endif
