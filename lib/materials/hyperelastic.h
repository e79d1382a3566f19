// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_hyperelastic_h
#define ricochet_materials_hyperelastic_h

#include <materials/hyperelastic_law.h>
#include <materials/plane_state.h>
#include <materials/reduced_energy.h>

#include <deal.II/base/symmetric_tensor.h>

#include <memory>

namespace Ricochet
{
  /**
   * A hyperelastic law of any kind in @p dim dimensions, as a function of the right
   * Cauchy-Green tensor C (dim x dim); see ReducedEnergy for plane strain and stress.
   *
   * In all functions det C must be positive.
   */
  template <int dim>
  class Hyperelastic
  {
  public:
    template <typename Number>
    using Symmetric2 = dealii::SymmetricTensor<2, dim, Number>;
    template <typename Number>
    using Symmetric4 = dealii::SymmetricTensor<4, dim, Number>;

    /// @param plane_state not used in 3D.
    Hyperelastic(std::shared_ptr<const HyperelasticLaw> law,
                 const PlaneState                       plane_state)
      : law(std::move(law))
      , plane_state(plane_state)
    {}

    // Number is double, or Lanes for several points at once.

    /// W (J/m^dim).
    template <typename Number>
    Number
    energy(const Symmetric2<Number> &right_cauchy_green) const;

    /// W(@p old_c + @p difference) - W(@p old_c), free of cancellation.
    template <typename Number>
    Number
    energy_difference(const Symmetric2<Number> &old_c,
                      const Symmetric2<Number> &difference) const;

    /// dW/dC (Pa), half of the second Piola-Kirchhoff stress.
    template <typename Number>
    Symmetric2<Number>
    derivative(const Symmetric2<Number> &right_cauchy_green) const;

    /// dW/dC and d2W/dC2 (Pa).
    template <typename Number>
    void
    derivatives(const Symmetric2<Number> &right_cauchy_green,
                Symmetric2<Number>       &first,
                Symmetric4<Number>       &second) const;

    /// The trace of C in three dimensions and its derivative with respect to C,
    /// for Pioletti's viscosity.
    template <typename Number>
    Number
    trace(const Symmetric2<Number> &right_cauchy_green,
          Symmetric2<Number>       &derivative) const;

    /// See GonzalezStress::stress().
    Symmetric2<Lanes>
    step_stress(const Symmetric2<Lanes> &old_c,
                const Symmetric2<Lanes> &difference) const
    {
      return law->step_stress(plane_state, old_c, difference);
    }

    /// Cauchy stress (Pa).
    Symmetric2<double>
    cauchy_stress(const dealii::Tensor<2, dim> &deformation_gradient) const;

    /// Cauchy stress (Pa) with the out-of-plane components in 2D; in 1D there
    /// are none.
    dealii::SymmetricTensor<2, 3>
    spatial_cauchy_stress(
      const dealii::Tensor<2, dim> &deformation_gradient) const;

  private:
    using Reduced = ReducedEnergy<dim, HyperelasticLaw>;

    Reduced
    reduced() const
    {
      return {*law, plane_state};
    }

    const std::shared_ptr<const HyperelasticLaw> law;
    const PlaneState                             plane_state;
  };
} // namespace Ricochet

#endif
