// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_deformation_gradient_h
#define ricochet_tests_unit_deformation_gradient_h

#include <deal.II/base/symmetric_tensor.h>

#include <random>

namespace Ricochet
{
  /// A deformation gradient with a positive determinant, @p size away from the
  /// identity.
  template <int dim>
  dealii::Tensor<2, dim>
  deformation_gradient(const double size, const unsigned int seed)
  {
    std::mt19937                           generator(seed);
    std::uniform_real_distribution<double> number(-1., 1.);
    dealii::Tensor<2, dim> f(dealii::unit_symmetric_tensor<dim>());
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
        f[i][j] += size * number(generator);
    return f;
  }
} // namespace Ricochet

#endif
