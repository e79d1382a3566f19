// SPDX-License-Identifier: LGPL-2.1-or-later
#include <materials/hyperelastic.h>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::energy(const Symmetric2<Number> &c) const
  {
    return reduced().energy(c);
  }



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::energy_difference(
    const Symmetric2<Number> &old_c,
    const Symmetric2<Number> &difference) const
  {
    return reduced().energy_difference(old_c, difference);
  }



  template <int dim>
  template <typename Number>
  SymmetricTensor<2, dim, Number>
  Hyperelastic<dim>::derivative(const Symmetric2<Number> &c) const
  {
    return reduced().derivative(c);
  }



  template <int dim>
  template <typename Number>
  void
  Hyperelastic<dim>::derivatives(const Symmetric2<Number> &c,
                                 Symmetric2<Number>       &first,
                                 Symmetric4<Number>       &second) const
  {
    reduced().derivatives(c, first, second);
  }



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::trace(const Symmetric2<Number> &c,
                           Symmetric2<Number>       &derivative) const
  {
    return reduced().trace(c, derivative);
  }



  template <int dim>
  SymmetricTensor<2, dim>
  Hyperelastic<dim>::cauchy_stress(
    const Tensor<2, dim> &deformation_gradient) const
  {
    const Symmetric2<double> c =
      symmetrize(transpose(deformation_gradient) * deformation_gradient);
    // The volume ratio of a flat body includes its thickness.
    double volume_ratio = determinant(deformation_gradient);
    if constexpr (dim == 2)
      {
        const auto i = Reduced::invariants_of(c);
        volume_ratio *= std::sqrt(reduced().c33(i[0], i[1]));
      }
    return symmetrize(deformation_gradient *
                      Tensor<2, dim>(2. * derivative(c)) *
                      transpose(deformation_gradient)) /
      volume_ratio;
  }



  template <int dim>
  SymmetricTensor<2, 3>
  Hyperelastic<dim>::spatial_cauchy_stress(
    const Tensor<2, dim> &deformation_gradient) const
  {
    const Symmetric2<double> in_plane = cauchy_stress(deformation_gradient);
    SymmetricTensor<2, 3>    stress;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = i; j < dim; ++j)
        stress[i][j] = in_plane[i][j];
    if constexpr (dim == 2)
      {
        // 2 dW/dC_33 C_33/J, with the dependence of the invariants on C_33 from
        // spatial(). In plane stress that is zero.
        const auto plane = Reduced::invariants_of(
          symmetrize(transpose(deformation_gradient) * deformation_gradient));
        const double s = reduced().c33(plane[0], plane[1]);
        const auto   w = law->gradient(Reduced::spatial(plane[0], plane[1], s));
        stress[2][2]   = 2. * (w[0] + w[1] * plane[0] + w[2] * plane[1]) * s /
          std::sqrt(plane[1] * s);
      }
    return stress;
  }


  template class Hyperelastic<2>;
  template class Hyperelastic<3>;

#define INSTANTIATE(dim, Number)                                \
  template Number Hyperelastic<dim>::energy<Number>(            \
    const SymmetricTensor<2, dim, Number> &) const;             \
  template Number Hyperelastic<dim>::energy_difference<Number>( \
    const SymmetricTensor<2, dim, Number> &,                    \
    const SymmetricTensor<2, dim, Number> &) const;             \
  template SymmetricTensor<2, dim, Number>                      \
  Hyperelastic<dim>::derivative<Number>(                        \
    const SymmetricTensor<2, dim, Number> &) const;             \
  template void Hyperelastic<dim>::derivatives<Number>(         \
    const SymmetricTensor<2, dim, Number> &,                    \
    SymmetricTensor<2, dim, Number> &,                          \
    SymmetricTensor<4, dim, Number> &) const;                   \
  template Number Hyperelastic<dim>::trace<Number>(             \
    const SymmetricTensor<2, dim, Number> &,                    \
    SymmetricTensor<2, dim, Number> &) const;

  INSTANTIATE(2, double)
  INSTANTIATE(2, Lanes)
  INSTANTIATE(3, double)
  INSTANTIATE(3, Lanes)
#undef INSTANTIATE
} // namespace Ricochet
