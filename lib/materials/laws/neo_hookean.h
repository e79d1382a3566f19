// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_laws_neo_hookean_h
#define ricochet_materials_laws_neo_hookean_h

#include <materials/hyperelastic_law.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  /**
   * The compressible neo-Hookean law (for instance Bonet and Wood, "Nonlinear
   * continuum mechanics for finite element analysis", 1997), with
   * J^2 = det C = I3:
   *
   *     W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2.
   */
  struct NeoHookean
  {
    /// Pa
    double lambda = 0.;
    /// Pa
    double mu = 0.;

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      using std::log;
      const Number log_i3 = log(i.third);
      return Number(mu / 2. * (i.first - 3.) - mu / 2. * log_i3 +
                    lambda / 8. * log_i3 * log_i3);
    }

    double
    energy_difference(const Invariants<> &i, const Invariants<> &diff) const
    {
      const double log_difference = std::log1p(diff.third / i.third);
      return mu / 2. * diff.first +
        log_difference *
        (-mu / 2. + lambda / 8. * (2. * std::log(i.third) + log_difference));
    }

    std::array<double, 3>
    gradient(const Invariants<> &i) const
    {
      return {
        {mu / 2., 0., (-mu / 2. + lambda / 4. * std::log(i.third)) / i.third}};
    }

    std::array<std::array<double, 3>, 3>
    hessian(const Invariants<> &i) const
    {
      std::array<std::array<double, 3>, 3> result{};
      result[2][2] = (mu / 2. + lambda / 4. * (1. - std::log(i.third))) /
        (i.third * i.third);
      return result;
    }

    /// Solves mu (s - 1) + lambda/2 ln(s det) = 0 for s = C_33. With lambda >=
    /// 0 the function rises and is concave, so that Newton's method from a point where it is
    /// negative climbs to the root.
    double
    plane_stress_c33(const double /*trace*/, const double determinant) const
    {
      double s = std::min(1., 1. / determinant);
      for (unsigned int k = 0; k < 100; ++k)
        {
          const double value =
            mu * (s - 1.) + lambda / 2. * std::log(s * determinant);
          const double step = value / (mu + lambda / (2. * s));
          s -= step;
          if (!(std::abs(step) > 1e-15 * s))
            break;
        }
      return s;
    }
  };
} // namespace Ricochet

#endif
