// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_hyperelastic_law_h
#define ricochet_materials_hyperelastic_law_h

#include <materials/lanes.h>
#include <materials/linear_elastic.h>
#include <materials/plane_state.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace Ricochet
{
  /// Principal invariants of the right Cauchy-Green tensor C in three
  /// dimensions: tr C, (tr(C)^2 - tr(C^2))/2, det C.
  template <typename Number = double>
  struct Invariants
  {
    Number first{};
    Number second{};
    Number third{};
  };

  /// Third derivatives of an energy with respect to the three invariants.
  using ThirdDerivatives = std::array<std::array<std::array<double, 3>, 3>, 3>;

  /**
   * An isotropic hyperelastic law: the energy density W as a function of the
   * three invariants of C, with its derivatives. Plane strain and plane stress
   * are left to Hyperelastic.
   *
   * A concrete law is a struct with energy, gradient and Hessian, from which
   * HyperelasticLawImplementation makes one of this class; the table is in
   * material_table.cc.
   */
  class HyperelasticLaw
  {
  public:
    virtual ~HyperelasticLaw() = default;

    /// W (J/m^3); zero for C = I.
    virtual double
    energy(const Invariants<> &invariants) const = 0;

    /**
     * W(@p invariants + @p difference) - W(@p invariants) (J/m^3), without the
     * cancellation of a plain difference: Gonzalez' stress divides it by the
     * square of the difference.
     */
    virtual double
    energy_difference(const Invariants<> &invariants,
                      const Invariants<> &difference) const = 0;

    /// The three first derivatives of W (Pa).
    virtual std::array<double, 3>
    gradient(const Invariants<> &invariants) const = 0;

    /// The second derivatives of W (Pa).
    virtual std::array<std::array<double, 3>, 3>
    hessian(const Invariants<> &invariants) const = 0;

    /**
     * The C_33 for which a sheet has no stress across it, dW/dC_33 = 0.
     *
     * @param trace, determinant of the in-plane part of C; the determinant
     * is positive.
     */
    virtual double
    plane_stress_c33(const double &trace, const double &determinant) const = 0;

    /// The third derivatives of W (Pa).
    virtual ThirdDerivatives
    third_derivatives(const Invariants<> &invariants) const = 0;

    /// Lamé's parameters at small strains, in 3D (Pa).
    virtual LinearElastic
    at_small_strains() const = 0;

    // The same in several points.
    virtual Lanes
    energy(const Invariants<Lanes> &invariants) const = 0;

    virtual Lanes
    energy_difference(const Invariants<Lanes> &invariants,
                      const Invariants<Lanes> &difference) const = 0;

    virtual std::array<Lanes, 3>
    gradient(const Invariants<Lanes> &invariants) const = 0;

    virtual std::array<std::array<Lanes, 3>, 3>
    hessian(const Invariants<Lanes> &invariants) const = 0;

    virtual Lanes
    plane_stress_c33(const Lanes &trace, const Lanes &determinant) const = 0;

    /// GonzalezStress::stress() in several points (Pa): most of the time of a
    /// time step is spent here, so that it is one function for each law.
    virtual dealii::SymmetricTensor<2, 2, Lanes>
    step_stress(
      const PlaneState                            plane_state,
      const dealii::SymmetricTensor<2, 2, Lanes> &old_c,
      const dealii::SymmetricTensor<2, 2, Lanes> &difference) const = 0;

    virtual dealii::SymmetricTensor<2, 3, Lanes>
    step_stress(
      const PlaneState                            plane_state,
      const dealii::SymmetricTensor<2, 3, Lanes> &old_c,
      const dealii::SymmetricTensor<2, 3, Lanes> &difference) const = 0;
  };
} // namespace Ricochet

#endif
