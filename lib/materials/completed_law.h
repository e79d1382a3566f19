// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_completed_law_h
#define ricochet_materials_completed_law_h

#include <materials/hyperelastic_law.h>
#include <materials/linear_elastic.h>

#include <deal.II/base/template_constraints.h>

#include <Sacado_Fad_SFad.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace Ricochet
{
  /**
   * A hyperelastic law with all functions of HyperelasticLaw: the law's own
   * functions where it has them, and otherwise general ones that follow from
   * its energy, gradient and Hessian. A law of its own may write
   *
   *     energy_difference()   otherwise Gauss' rule along the segment between both states,
   *     plane_stress_c33()    otherwise Newton's method,
   *     third_derivatives()   otherwise automatic differentiation of the Hessian,
   *     at_small_strains()    otherwise gradient and Hessian at rest,
   *
   * where its own are faster.
   */
  template <typename Law>
  struct CompletedLaw : public Law
  {
    explicit CompletedLaw(const Law &law)
      : Law(law)
    {}

    /// See HyperelasticLaw::energy_difference().
    template <typename Number>
    Number
    energy_difference(const Invariants<Number> &i,
                      const Invariants<Number> &difference) const
    {
      if constexpr (has<energy_difference_of>)
        return Law::energy_difference(i, difference);
      else
        return integrated_difference(i, difference);
    }

    /// See HyperelasticLaw::plane_stress_c33().
    template <typename Number>
    Number
    plane_stress_c33(const Number &trace, const Number &determinant) const
    {
      if constexpr (has<plane_stress_of>)
        return Law::plane_stress_c33(trace, determinant);
      else
        return c33_by_newton(trace, determinant);
    }

    /// See HyperelasticLaw::third_derivatives().
    ThirdDerivatives
    third_derivatives(const Invariants<> &i) const
    {
      if constexpr (has<third_derivatives_of>)
        return Law::third_derivatives(i);
      else
        return differentiated_hessian(i);
    }

    /// See HyperelasticLaw::at_small_strains().
    LinearElastic
    at_small_strains() const
    {
      if constexpr (has<small_strains_of>)
        return Law::at_small_strains();
      else
        return linearised_at_rest();
    }

    // The general formulas, for laws that have their own, too: for tests.

    /**
     * The integral of the gradient along the straight segment between both sets of
     * invariants, by Gauss' rule with six points. No two numbers that are nearly the same
     * are subtracted, so that the error of a small difference is as small.
     *
     * The rule is exact to round-off while the invariants change by a few hundredths. For
     * larger changes its error shows: where it departs from the plain difference of energies
     * by more than the round-off of that, for which 32 units of the largest terms are
     * allowed, the plain difference is taken. So the work of Gonzalez' stress
     * is the change of the energy to round-off for steps of any size.
     */
    template <typename Number>
    Number
    integrated_difference(const Invariants<Number> &i,
                          const Invariants<Number> &difference) const
    {
      using std::abs;
      constexpr std::array<double, 3> distances = {
        {0.2386191860831969, 0.6612093864662645, 0.9324695142031521}};
      constexpr std::array<double, 3> weights = {
        {0.4679139345726910, 0.3607615730481386, 0.1713244923791704}};
      const auto at = [&](const double s) {
        return Invariants<Number>{i.first + s * difference.first,
                                  i.second + s * difference.second,
                                  i.third + s * difference.third};
      };
      Number integral(0.), size(0.);
      for (unsigned int q = 0; q < 3; ++q)
        for (const double side : {-1., 1.})
          {
            const auto   point = at(.5 * (1. + side * distances[q]));
            const auto   g     = this->gradient(point);
            const double half  = .5 * weights[q];
            integral += half *
              (g[0] * difference.first + g[1] * difference.second +
               g[2] * difference.third);
            size += half *
              (abs(Number(g[0] * point.first)) +
               abs(Number(g[1] * point.second)) +
               abs(Number(g[2] * point.third)));
          }
      const Number old_energy = this->template energy<Number>(i);
      const Number new_energy = this->template energy<Number>(at(1.));
      const Number plain      = new_energy - old_energy;
      const Number bound      = 32. * std::numeric_limits<double>::epsilon() *
        (size + abs(old_energy) + abs(new_energy));
      return where_less(bound, abs(Number(integral - plain)), plain, integral);
    }

    /**
     * The root of dW/dC_33 by Newton's method within a bracket, which is widened by factors
     * of two until it holds the root, and halved where Newton's method leaves it.
     */
    template <typename Number>
    Number
    c33_by_newton(const Number &trace, const Number &determinant) const
    {
      using std::abs;
      using std::min;
      const Number zero(0.), unbounded(std::numeric_limits<double>::max());
      Number       s     = min(Number(1.), Number(1. / determinant));
      Number       lower = zero, upper = unbounded;
      // Lanes that have converged keep their value.
      Number moves(1.);
      for (unsigned int k = 0; k < 200; ++k)
        {
          const Invariants<Number> i{trace + s,
                                     determinant + trace * s,
                                     determinant * s};
          const auto               g = this->gradient(i);
          const auto               h = this->hessian(i);
          const Number value         = g[0] + trace * g[1] + determinant * g[2];
          const Number slope         = h[0][0] +
            trace * (h[0][1] + h[1][0] + trace * h[1][1]) +
            determinant *
              (h[0][2] + h[2][0] + trace * (h[1][2] + h[2][1]) +
               determinant * h[2][2]);
          lower             = where_less(value, zero, s, lower);
          upper             = where_less(zero, value, s, upper);
          const Number step = -value / slope;
          // No end above: twice as large; none but zero below: half as large.
          const Number middle =
            where_less(upper,
                       unbounded,
                       where_less(zero, lower, .5 * lower + .5 * upper, .5 * s),
                       2. * s);
          const Number newton = s + step;
          const Number inside =
            where_less(lower,
                       newton,
                       where_less(newton, upper, newton, middle),
                       middle);
          // The next step would be the square of this one.
          const Number arrived =
            where_less(abs(step),
                       1e-9 * s,
                       where_less(zero, slope, Number(1.), zero),
                       zero);
          const Number next = where_less(zero, arrived, newton, inside);
          s += moves * (next - s);
          moves = where_less(zero, arrived, zero, moves);
          if (!is_less_somewhere(zero, moves))
            break;
        }
      return s;
    }

    /// By Sacado.
    ThirdDerivatives
    differentiated_hessian(const Invariants<> &i) const
    {
      using AD           = Sacado::Fad::SFad<double, 3>;
      const auto       h = this->hessian(Invariants<AD>{AD(3, 0, i.first),
                                                        AD(3, 1, i.second),
                                                        AD(3, 2, i.third)});
      ThirdDerivatives third{};
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          for (unsigned int m = 0; m < 3; ++m)
            third[k][l][m] = AD(h[k][l]).dx(m);
      return third;
    }

    /**
     * Lamé's parameters of the energy around C = I: a simple shear by a small k has
     * I1 - 3 = I2 - 3 = k^2 and mu k^2/2 stored, and a uniaxial strain with C_11 = 1 + e
     * changes the invariants by e (1, 2, 1), exactly, and stores (lambda + 2 mu) e^2/8.
     */
    LinearElastic
    linearised_at_rest() const
    {
      const Invariants<>          rest{3., 3., 1.};
      const auto                  g       = this->gradient(rest);
      const auto                  h       = this->hessian(rest);
      const std::array<double, 3> along   = {{1., 2., 1.}};
      const double                mu      = 2. * (g[0] + g[1]);
      double                      modulus = 0.;
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int l = 0; l < 3; ++l)
          modulus += 4. * h[k][l] * along[k] * along[l];
      return {modulus - 2. * mu, mu};
    }

  private:
    // Optional functions of the law.
    template <typename L>
    using energy_difference_of =
      decltype(std::declval<const L &>().energy_difference(
        std::declval<Invariants<>>(),
        std::declval<Invariants<>>()));
    template <typename L>
    using plane_stress_of =
      decltype(std::declval<const L &>().plane_stress_c33(1., 1.));
    template <typename L>
    using third_derivatives_of =
      decltype(std::declval<const L &>().third_derivatives(
        std::declval<Invariants<>>()));
    template <typename L>
    using small_strains_of =
      decltype(std::declval<const L &>().at_small_strains());

    template <template <typename...> class Operation>
    static constexpr bool has =
      dealii::internal::is_supported_operation<Operation, Law>;
  };
} // namespace Ricochet

#endif
