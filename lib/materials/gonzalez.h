// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_gonzalez_h
#define ricochet_materials_gonzalez_h

#include <materials/lanes.h>
#include <materials/viscosity.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Ricochet
{
  /**
   * The second Piola-Kirchhoff stress of a step from C_old to C_new =
   * C_old + difference (Gonzalez; papers A (3.7), B (3.2)),
   *
   *     S = 2 [ W'(C_mean) + quotient difference ],
   *     quotient = (W(C_new) - W(C_old) - W'(C_mean) : difference)
   *                / (difference : difference),
   *
   * with C_mean = (C_old + C_new)/2, so that S : difference/2 is exactly the
   * difference of energies. The numerator is of third order in the difference
   * while its round-off is of first order: below the threshold the quotient
   * is dropped.
   *
   * Energy is what gives W and its derivatives: Hyperelastic, or ReducedEnergy of a law.
   */
  template <int dim>
  struct GonzalezStress
  {
    template <typename Number>
    using Symmetric2 = dealii::SymmetricTensor<2, dim, Number>;
    template <typename Number>
    using Symmetric4 = dealii::SymmetricTensor<4, dim, Number>;

    /// Frobenius norm of the difference of C below which the quotient is
    /// dropped. There it changes the stress by about 1e-14 of a modulus, and
    /// its derivative carries a round-off of 1e-9.
    static constexpr double threshold = 1e-7;

    /// S (Pa).
    template <typename Energy, typename Number>
    static Symmetric2<Number>
    stress(const Energy             &material,
           const Symmetric2<Number> &old_c,
           const Symmetric2<Number> &difference)
    {
      const Symmetric2<Number> derivative =
        material.template derivative<Number>(old_c + Number(.5) * difference);
      const Number quotient =
        energy_quotient(material, old_c, difference, derivative);
      return Number(2.) * (derivative + quotient * difference);
    }

    /// S (Pa) and its exact derivative with respect to C_new, which has no
    /// major symmetry.
    template <typename Energy, typename Number>
    static void
    stress_and_tangent(const Energy             &material,
                       const Symmetric2<Number> &old_c,
                       const Symmetric2<Number> &difference,
                       Symmetric2<Number>       &stress,
                       Symmetric4<Number>       &tangent)
    {
      Symmetric2<Number> derivative;
      Symmetric4<Number> second_derivative;
      material.template derivatives<Number>(old_c + Number(.5) * difference,
                                            derivative,
                                            second_derivative);
      stress  = Number(2.) * derivative;
      tangent = second_derivative;

      const Number square = difference * difference;
      if (!is_less_somewhere(Number(threshold * threshold), square))
        return;
      const Number quotient =
        energy_quotient(material, old_c, difference, derivative);
      const Number             inverse_square      = inverse(square);
      const Symmetric2<Number> quotient_derivative = inverse_square *
        (material.template derivative<Number>(old_c + difference) - derivative -
         Number(.5) * (second_derivative * difference) -
         Number(2.) * quotient * difference);
      stress += Number(2.) * quotient * difference;
      tangent += Number(2.) *
        (quotient * dealii::identity_tensor<dim, Number>() +
         outer_product(difference, quotient_derivative));
    }

  private:
    /// 1/@p square, or 0 where the quotient is dropped.
    template <typename Number>
    static Number
    inverse(const Number &square)
    {
      const Number smallest(threshold * threshold);
      return where_less(square,
                        smallest,
                        Number(0.),
                        1. / where_less(square, smallest, Number(1.), square));
    }

    template <typename Energy, typename Number>
    static Number
    energy_quotient(const Energy             &material,
                    const Symmetric2<Number> &old_c,
                    const Symmetric2<Number> &difference,
                    const Symmetric2<Number> &derivative)
    {
      const Number square = difference * difference;
      if (!is_less_somewhere(Number(threshold * threshold), square))
        return Number(0.);
      return (material.energy_difference(old_c, difference) -
              derivative * difference) *
        inverse(square);
    }
  };



  /// Derivatives of viscous_stress() with respect to @p change and @p c.
  template <int dim, typename Number>
  struct ViscousTangent
  {
    dealii::SymmetricTensor<4, dim, Number> with_change, with_c;
  };

  /**
   * The viscous second Piola-Kirchhoff stress (Pa) where C has the rate
   * @p change / @p time, and is @p c itself; S : change/2 is the energy that it
   * dissipates per volume in that time. In a step @p c is the mean.
   *
   * @param tangent set if given.
   */
  template <int dim, typename Energy, typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  viscous_stress(const Energy                                  &material,
                 const Viscosity                               &viscosity,
                 const dealii::SymmetricTensor<2, dim, Number> &c,
                 const dealii::SymmetricTensor<2, dim, Number> &change,
                 const double                                   time,
                 ViscousTangent<dim, Number> *tangent = nullptr)
  {
    const Number rate_factor(viscosity.eta / time);
    const auto   identity = dealii::identity_tensor<dim, Number>();
    if (viscosity.law == Viscosity::Law::curnier)
      {
        if (tangent)
          *tangent = {2. * rate_factor * identity, {}};
        return 2. * rate_factor * change;
      }

    dealii::SymmetricTensor<2, dim, Number> trace_derivative;
    const Number                            unclipped =
      material.template trace<Number>(c, trace_derivative) - 3.;
    const Number zero(0.), one(1.);
    const Number factor = where_less(zero, unclipped, unclipped, zero);
    const Number slope  = where_less(zero, unclipped, one, zero);
    if (tangent)
      *tangent = {rate_factor * factor * identity,
                  outer_product(change,
                                rate_factor * slope * trace_derivative)};
    return rate_factor * factor * change;
  }
} // namespace Ricochet

#endif
