// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_gonzalez_h
#define ricochet_materials_gonzalez_h

#include <materials/hyperelastic.h>
#include <materials/viscosity.h>

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
   */
  template <int dim>
  struct GonzalezStress
  {
    using Symmetric2 = dealii::SymmetricTensor<2, dim>;
    using Symmetric4 = dealii::SymmetricTensor<4, dim>;

    /// Frobenius norm of the difference of C below which the quotient is
    /// dropped. There it changes the stress by about 1e-14 of a modulus, and
    /// its derivative carries a round-off of 1e-9.
    static constexpr double threshold = 1e-7;

    /// S (Pa).
    static Symmetric2
    stress(const Hyperelastic<dim> &material,
           const Symmetric2        &old_c,
           const Symmetric2        &difference)
    {
      const Symmetric2 derivative =
        material.derivative(old_c + .5 * difference);
      const double square = difference * difference;
      if (square < threshold * threshold)
        return 2. * derivative;
      const double quotient = (material.energy_difference(old_c, difference) -
                               derivative * difference) /
        square;
      return 2. * (derivative + quotient * difference);
    }

    /// S (Pa) and its exact derivative with respect to C_new, which has no
    /// major symmetry.
    static void
    stress_and_tangent(const Hyperelastic<dim> &material,
                       const Symmetric2        &old_c,
                       const Symmetric2        &difference,
                       Symmetric2              &stress,
                       Symmetric4              &tangent)
    {
      Symmetric2 derivative;
      Symmetric4 second_derivative;
      material.derivatives(old_c + .5 * difference,
                           derivative,
                           second_derivative);
      stress  = 2. * derivative;
      tangent = second_derivative;

      const double square = difference * difference;
      if (square < threshold * threshold)
        return;
      const double quotient = (material.energy_difference(old_c, difference) -
                               derivative * difference) /
        square;
      const Symmetric2 quotient_derivative =
        (material.derivative(old_c + difference) - derivative -
         .5 * (second_derivative * difference) - 2. * quotient * difference) /
        square;
      stress += 2. * quotient * difference;
      tangent += 2. *
        (quotient * dealii::identity_tensor<dim>() +
         outer_product(difference, quotient_derivative));
    }
  };



  /**
   * The viscous second Piola-Kirchhoff stress of a step (Pa), at the rate
   * difference/time_step; S : difference/2 is the energy that it dissipates per
   * volume. If @p tangent is given, its derivative with respect to C_new is
   * added to it.
   */
  template <int dim>
  dealii::SymmetricTensor<2, dim>
  viscous_stress(const Hyperelastic<dim>               &material,
                 const Viscosity                       &viscosity,
                 const dealii::SymmetricTensor<2, dim> &old_c,
                 const dealii::SymmetricTensor<2, dim> &difference,
                 const double                           time_step,
                 dealii::SymmetricTensor<4, dim>       *tangent = nullptr)
  {
    const double rate_factor = viscosity.eta / time_step;
    if (viscosity.law == Viscosity::Law::curnier)
      {
        if (tangent)
          *tangent += 2. * rate_factor * dealii::identity_tensor<dim>();
        return 2. * rate_factor * difference;
      }

    dealii::SymmetricTensor<2, dim> trace_derivative;
    const double                    factor =
      material.trace(old_c + .5 * difference, trace_derivative) - 3.;
    if (factor <= 0.)
      return {};
    if (tangent)
      *tangent += rate_factor *
        (factor * dealii::identity_tensor<dim>() +
         outer_product(difference, .5 * trace_derivative));
    return rate_factor * factor * difference;
  }
} // namespace Ricochet

#endif
