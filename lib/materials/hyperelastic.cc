// SPDX-License-Identifier: LGPL-2.1-or-later
#include <materials/hyperelastic.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The invariants of C in dim dimensions: trace, (second in 3D),
    /// determinant.
    template <int dim, typename Number>
    std::array<Number, dim>
    invariants_of(const SymmetricTensor<2, dim, Number> &c)
    {
      if constexpr (dim == 2)
        return {{dealii::trace(c), determinant(c)}};
      else
        return {{dealii::trace(c), second_invariant(c), determinant(c)}};
    }

    /// Their change from @p c to @p c + @p difference, without cancellation.
    template <int dim, typename Number>
    std::array<Number, dim>
    invariants_difference(const SymmetricTensor<2, dim, Number> &c,
                          const SymmetricTensor<2, dim, Number> &difference)
    {
      const SymmetricTensor<2, dim, Number> mean = c + Number(.5) * difference;
      const Number                          d_trace = dealii::trace(difference);
      const Number d_second = dealii::trace(mean) * d_trace - mean * difference;
      // In 2D the second invariant is the determinant.
      if constexpr (dim == 2)
        return {{d_trace, d_second}};
      else
        {
          using General       = Tensor<2, dim, Number>;
          const auto cofactor = [](const SymmetricTensor<2, dim, Number> &a) {
            return symmetrize(General(a) * General(a)) - dealii::trace(a) * a +
              second_invariant(a) * unit_symmetric_tensor<dim, Number>();
          };
          return {{d_trace,
                   d_second,
                   cofactor(c) * difference + c * cofactor(difference) +
                     determinant(difference)}};
        }
    }

    /// The invariants in three dimensions of a flat body.
    template <typename Number>
    Invariants<Number>
    spatial(const Number &trace, const Number &determinant, const Number &c33)
    {
      return {trace + c33, determinant + trace * c33, determinant * c33};
    }
  } // namespace



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::c33(const Number &trace, const Number &determinant) const
  {
    return plane_state == PlaneState::plane_strain
      ? Number(1.)
      : law->plane_stress_c33(trace, determinant);
  }



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::energy(const Symmetric2<Number> &c) const
  {
    const auto i = invariants_of(c);
    if constexpr (dim == 2)
      return law->energy(spatial(i[0], i[1], c33(i[0], i[1])));
    else
      return law->energy(Invariants<Number>{i[0], i[1], i[2]});
  }



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::energy_difference(
    const Symmetric2<Number> &old_c,
    const Symmetric2<Number> &difference) const
  {
    const auto i    = invariants_of(old_c);
    const auto diff = invariants_difference(old_c, difference);
    if constexpr (dim == 2)
      {
        // The energy is stationary in C_33 in plane stress, so that the
        // cancellation in the difference of C_33 does no harm.
        const Number s   = c33(i[0], i[1]);
        const Number s_1 = c33<Number>(i[0] + diff[0], i[1] + diff[1]);
        const Number d_s = s_1 - s;
        return law->energy_difference(
          spatial(i[0], i[1], s),
          Invariants<Number>{diff[0] + d_s,
                             diff[1] + diff[0] * s_1 + i[0] * d_s,
                             diff[1] * s_1 + i[1] * d_s});
      }
    else
      return law->energy_difference(Invariants<Number>{i[0], i[1], i[2]},
                                    Invariants<Number>{diff[0],
                                                       diff[1],
                                                       diff[2]});
  }



  template <int dim>
  template <typename Number>
  typename Hyperelastic<dim>::template Reduced<Number>
  Hyperelastic<dim>::reduce(const std::array<Number, dim> &invariants,
                            const bool                     with_hessian) const
  {
    Reduced<Number> reduced;
    if constexpr (dim == 3)
      {
        const Invariants<Number> i{invariants[0], invariants[1], invariants[2]};
        reduced.gradient = law->gradient(i);
        if (with_hessian)
          reduced.hessian = law->hessian(i);
      }
    else
      {
        // With trace t, determinant b and s = C_33:
        // I1 = t + s, I2 = b + t s, I3 = b s.
        const Number t = invariants[0], b = invariants[1];
        const Number s   = c33(t, b);
        const auto   i   = spatial(t, b, s);
        const auto   g   = law->gradient(i);
        reduced.gradient = {{g[0] + s * g[1], g[1] + s * g[2]}};
        if (!with_hessian)
          return reduced;

        // Directions d(I1, I2, I3) along t, b and s.
        const auto                  h = law->hessian(i);
        const Number                one(1.), zero(0.);
        const std::array<Number, 3> along_t = {{one, s, zero}},
                                    along_b = {{zero, one, s}},
                                    along_s = {{one, t, b}};
        const auto second = [&h](const std::array<Number, 3> &x,
                                 const std::array<Number, 3> &y) {
          Number sum(0.);
          for (unsigned int k = 0; k < 3; ++k)
            for (unsigned int l = 0; l < 3; ++l)
              sum += h[k][l] * x[k] * y[l];
          return sum;
        };
        reduced.hessian[0][0] = second(along_t, along_t);
        reduced.hessian[0][1] = reduced.hessian[1][0] =
          second(along_t, along_b);
        reduced.hessian[1][1] = second(along_b, along_b);
        if (plane_state == PlaneState::plane_stress)
          {
            const Number ts = second(along_t, along_s) + g[1];
            const Number bs = second(along_b, along_s) + g[2];
            const Number ss = second(along_s, along_s);
            reduced.hessian[0][0] -= ts * ts / ss;
            reduced.hessian[0][1] -= ts * bs / ss;
            reduced.hessian[1][0] -= ts * bs / ss;
            reduced.hessian[1][1] -= bs * bs / ss;
            reduced.c33_gradient = {{-ts / ss, -bs / ss}};
          }
      }
    return reduced;
  }



  namespace
  {
    /// dI/dC for each of the dim invariants.
    template <int dim, typename Number>
    std::array<SymmetricTensor<2, dim, Number>, dim>
    invariant_gradients(const SymmetricTensor<2, dim, Number> &c)
    {
      using General       = Tensor<2, dim, Number>;
      const auto identity = unit_symmetric_tensor<dim, Number>();
      const SymmetricTensor<2, dim, Number> second =
        dealii::trace(c) * identity - c;
      if constexpr (dim == 2)
        return {{identity, second}};
      else
        return {{identity,
                 second,
                 symmetrize(General(c) * General(c)) - dealii::trace(c) * c +
                   second_invariant(c) * identity}};
    }
  } // namespace



  template <int dim>
  template <typename Number>
  SymmetricTensor<2, dim, Number>
  Hyperelastic<dim>::derivative(const Symmetric2<Number> &c) const
  {
    const auto         reduced   = reduce<Number>(invariants_of(c), false);
    const auto         gradients = invariant_gradients(c);
    Symmetric2<Number> result;
    for (unsigned int k = 0; k < dim; ++k)
      result += reduced.gradient[k] * gradients[k];
    return result;
  }



  template <int dim>
  template <typename Number>
  void
  Hyperelastic<dim>::derivatives(const Symmetric2<Number> &c,
                                 Symmetric2<Number>       &first,
                                 Symmetric4<Number>       &second) const
  {
    const auto reduced   = reduce<Number>(invariants_of(c), true);
    const auto gradients = invariant_gradients(c);
    first                = Symmetric2<Number>();
    second               = Symmetric4<Number>();
    for (unsigned int k = 0; k < dim; ++k)
      {
        first += reduced.gradient[k] * gradients[k];
        for (unsigned int l = 0; l < dim; ++l)
          second +=
            reduced.hessian[k][l] * outer_product(gradients[k], gradients[l]);
      }
    // The second derivative of the second invariant (in 2D the determinant) is
    // constant,
    const auto identity = unit_symmetric_tensor<dim, Number>();
    second += reduced.gradient[1] *
      (outer_product(identity, identity) - identity_tensor<dim, Number>());
    // that of the determinant in 3D is linear: of C^2 - tr(C) C + I2 1.
    if constexpr (dim == 3)
      {
        Symmetric4<Number> curvature = outer_product(identity, gradients[1]) -
          outer_product(c, identity) -
          dealii::trace(c) * identity_tensor<dim, Number>();
        // d(C^2) = dC C + C dC, symmetrised in both pairs of indices.
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            for (unsigned int k = 0; k < dim; ++k)
              for (unsigned int l = k; l < dim; ++l)
                curvature[i][j][k][l] += (i == k ? .5 : 0.) * c[l][j] +
                  (i == l ? .5 : 0.) * c[k][j] + (j == k ? .5 : 0.) * c[l][i] +
                  (j == l ? .5 : 0.) * c[k][i];
        second += reduced.gradient[2] * curvature;
      }
  }



  template <int dim>
  template <typename Number>
  Number
  Hyperelastic<dim>::trace(const Symmetric2<Number> &c,
                           Symmetric2<Number>       &derivative) const
  {
    derivative = unit_symmetric_tensor<dim, Number>();
    if constexpr (dim == 2)
      {
        const auto i         = invariants_of(c);
        const auto reduced   = reduce<Number>(i, true);
        const auto gradients = invariant_gradients(c);
        for (unsigned int k = 0; k < dim; ++k)
          derivative += reduced.c33_gradient[k] * gradients[k];
        return i[0] + c33(i[0], i[1]);
      }
    else
      return dealii::trace(c);
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
        const auto i = invariants_of(c);
        volume_ratio *= std::sqrt(c33(i[0], i[1]));
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
        // 2 dW/dC_33 C_33/J, and spatial() says how the invariants depend on
        // C_33. In plane stress that is zero.
        const auto plane = invariants_of(
          symmetrize(transpose(deformation_gradient) * deformation_gradient));
        const double s = c33(plane[0], plane[1]);
        const auto   w = law->gradient(spatial(plane[0], plane[1], s));
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
