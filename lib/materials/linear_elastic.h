// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_linear_elastic_h
#define ricochet_materials_linear_elastic_h

#include <deal.II/base/symmetric_tensor.h>

namespace Ricochet
{
  /**
   * Isotropic linear elasticity, a pure function of the strain (paper C, (1)):
   * stress = lambda tr(strain) I + 2 mu strain.
   *
   * In 1D the modulus of a bar is lambda + 2 mu; for a bar of modulus E take
   * lambda = 0 and mu = E/2.
   */
  struct LinearElastic
  {
    /// First Lamé parameter (Pa).
    double lambda = 0.;
    /// Shear modulus (Pa).
    double mu = 0.;

    /// Cauchy stress (Pa) for the small @p strain.
    template <int dim, typename Number>
    dealii::SymmetricTensor<2, dim, Number>
    stress(const dealii::SymmetricTensor<2, dim, Number> &strain) const
    {
      return lambda * trace(strain) *
        dealii::unit_symmetric_tensor<dim, Number>() +
        2. * mu * strain;
    }
  };
} // namespace Ricochet

#endif
