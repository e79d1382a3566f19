// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_hyperelastic_law_implementation_h
#define ricochet_materials_hyperelastic_law_implementation_h

#include <materials/completed_law.h>
#include <materials/gonzalez.h>
#include <materials/hyperelastic_law.h>
#include <materials/reduced_energy.h>

namespace Ricochet
{
  /**
   * Turns a struct with templated functions into a HyperelasticLaw; CompletedLaw has
   * those that the struct does not write. The templates serve one point and several at
   * once, and let the tests differentiate the same energy that the programs
   * use.
   */
  template <typename Law>
  class HyperelasticLawImplementation : public HyperelasticLaw
  {
  public:
    explicit HyperelasticLawImplementation(const Law &law)
      : law(law)
    {}

    double
    energy(const Invariants<> &invariants) const override
    {
      return law.template energy<double>(invariants);
    }

    double
    energy_difference(const Invariants<> &invariants,
                      const Invariants<> &difference) const override
    {
      return law.energy_difference(invariants, difference);
    }

    std::array<double, 3>
    gradient(const Invariants<> &invariants) const override
    {
      return law.gradient(invariants);
    }

    std::array<std::array<double, 3>, 3>
    hessian(const Invariants<> &invariants) const override
    {
      return law.hessian(invariants);
    }

    double
    plane_stress_c33(const double &trace,
                     const double &determinant) const override
    {
      return law.plane_stress_c33(trace, determinant);
    }

    ThirdDerivatives
    third_derivatives(const Invariants<> &invariants) const override
    {
      return law.third_derivatives(invariants);
    }

    LinearElastic
    at_small_strains() const override
    {
      return law.at_small_strains();
    }

    Lanes
    energy(const Invariants<Lanes> &invariants) const override
    {
      return law.template energy<Lanes>(invariants);
    }

    Lanes
    energy_difference(const Invariants<Lanes> &invariants,
                      const Invariants<Lanes> &difference) const override
    {
      return law.energy_difference(invariants, difference);
    }

    std::array<Lanes, 3>
    gradient(const Invariants<Lanes> &invariants) const override
    {
      return law.gradient(invariants);
    }

    std::array<std::array<Lanes, 3>, 3>
    hessian(const Invariants<Lanes> &invariants) const override
    {
      return law.hessian(invariants);
    }

    Lanes
    plane_stress_c33(const Lanes &trace,
                     const Lanes &determinant) const override
    {
      return law.plane_stress_c33(trace, determinant);
    }

    dealii::SymmetricTensor<2, 2, Lanes>
    step_stress(
      const PlaneState                            plane_state,
      const dealii::SymmetricTensor<2, 2, Lanes> &old_c,
      const dealii::SymmetricTensor<2, 2, Lanes> &difference) const override
    {
      return stress_in<2>(plane_state, old_c, difference);
    }

    dealii::SymmetricTensor<2, 3, Lanes>
    step_stress(
      const PlaneState                            plane_state,
      const dealii::SymmetricTensor<2, 3, Lanes> &old_c,
      const dealii::SymmetricTensor<2, 3, Lanes> &difference) const override
    {
      return stress_in<3>(plane_state, old_c, difference);
    }

  private:
    /// Inlined completely, without function calls.
    template <int dim>
    [[gnu::flatten]] dealii::SymmetricTensor<2, dim, Lanes>
    stress_in(const PlaneState                              plane_state,
              const dealii::SymmetricTensor<2, dim, Lanes> &old_c,
              const dealii::SymmetricTensor<2, dim, Lanes> &difference) const
    {
      return GonzalezStress<dim>::stress(
        ReducedEnergy<dim, CompletedLaw<Law>>(law, plane_state),
        old_c,
        difference);
    }

    const CompletedLaw<Law> law;
  };
} // namespace Ricochet

#endif
