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

    static constexpr const char *name = "neo-Hookean";

    static OwnParameters
    parameters()
    {
      return LinearElastic::parameters();
    }

    static NeoHookean
    make(const ParameterValues &values)
    {
      const LinearElastic lame = LinearElastic::make(values);
      return {lame.lambda, lame.mu};
    }

    /// See plane_stress_c33().
    static void
    check(const ParameterValues &values, const PlaneState plane_state)
    {
      const double poisson_ratio = values["Poisson ratio"];
      if (plane_state == PlaneState::plane_stress && poisson_ratio < 0.)
        throw InputError(
          "A neo-Hookean body in plane stress needs a Poisson ratio "
          "that is not negative; it is " +
          to_text(poisson_ratio) + ".");
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
      using std::log;
      const Number log_i3 = log(i.third);
      return Number(mu / 2. * (i.first - 3.) - mu / 2. * log_i3 +
                    lambda / 8. * log_i3 * log_i3);
    }

    template <typename Number>
    Number
    energy_difference(const Invariants<Number> &i,
                      const Invariants<Number> &diff) const
    {
      using std::log;
      const Number log_difference = log_of_one_plus(diff.third / i.third);
      return mu / 2. * diff.first +
        log_difference *
        (-mu / 2. + lambda / 8. * (2. * log(i.third) + log_difference));
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      using std::log;
      return {{Number(mu / 2.),
               Number(0.),
               (-mu / 2. + lambda / 4. * log(i.third)) / i.third}};
    }

    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      std::array<std::array<Number, 3>, 3> result{};
      using std::log;
      result[2][2] =
        (mu / 2. + lambda / 4. * (1. - log(i.third))) / (i.third * i.third);
      return result;
    }

    /// Solves mu (s - 1) + lambda/2 ln(s det) = 0 for s = C_33. With lambda >=
    /// 0 the function rises and is concave, so that Newton's method from a point where it is
    /// negative climbs to the root.
    template <typename Number>
    Number
    plane_stress_c33(const Number & /*trace*/, const Number &determinant) const
    {
      using std::abs;
      using std::log;
      using std::min;
      Number s = min(Number(1.), 1. / determinant);
      // Lanes that have converged keep their value.
      Number moves(1.);
      for (unsigned int k = 0; k < 100; ++k)
        {
          const Number value =
            mu * (s - 1.) + lambda / 2. * log(s * determinant);
          const Number step = moves * value / (mu + lambda / (2. * s));
          s -= step;
          moves = where_less(1e-15 * s, abs(step), moves, Number(0.));
          if (!is_less_somewhere(Number(0.), moves))
            break;
        }
      return s;
    }
  };
} // namespace Ricochet

#endif
