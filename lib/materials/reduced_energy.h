// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_materials_reduced_energy_h
#define ricochet_materials_reduced_energy_h

#include <materials/hyperelastic_law.h>
#include <materials/plane_state.h>

#include <deal.II/base/symmetric_tensor.h>

#include <array>

namespace Ricochet
{
  /**
   * A hyperelastic law in @p dim dimensions, as a function of the right
   * Cauchy-Green tensor C (dim x dim), as Hyperelastic is for laws of any type.
   * Here the type of the law is known at compile time, so that all of it can be
   * one loop.
   *
   * In 2D the energy is a function of the trace and the determinant of the
   * in-plane part of C. C_33 is 1 in plane strain; in plane stress it minimises
   * W, so that the reduced energy is hyperelastic again: its first derivative
   * is that of W at fixed C_33, its second one is condensed.
   *
   * In all functions det C must be positive. Number is double, or Lanes for several
   * points at once.
   */
  template <int dim, typename Law>
  class ReducedEnergy
  {
  public:
    template <typename Number>
    using Symmetric2 = dealii::SymmetricTensor<2, dim, Number>;
    template <typename Number>
    using Symmetric4 = dealii::SymmetricTensor<4, dim, Number>;

    /// @param law is held by reference. @param plane_state not used in 3D.
    ReducedEnergy(const Law &law, const PlaneState plane_state)
      : law(law)
      , plane_state(plane_state)
    {}

    /// W (J/m^dim).
    template <typename Number>
    Number
    energy(const Symmetric2<Number> &c) const;

    /// W(@p old_c + @p difference) - W(@p old_c), free of cancellation.
    template <typename Number>
    Number
    energy_difference(const Symmetric2<Number> &old_c,
                      const Symmetric2<Number> &difference) const;

    /// dW/dC (Pa), half of the second Piola-Kirchhoff stress.
    template <typename Number>
    Symmetric2<Number>
    derivative(const Symmetric2<Number> &c) const;

    /// dW/dC and d2W/dC2 (Pa).
    template <typename Number>
    void
    derivatives(const Symmetric2<Number> &c,
                Symmetric2<Number>       &first,
                Symmetric4<Number>       &second) const;

    /// The trace of C in three dimensions and its derivative with respect to C,
    /// for Pioletti's viscosity.
    template <typename Number>
    Number
    trace(const Symmetric2<Number> &c, Symmetric2<Number> &derivative) const;

    /// C_33 in 2D.
    template <typename Number>
    Number
    c33(const Number &trace, const Number &determinant) const;

    /// trace (second in 3D), determinant of C.
    template <typename Number>
    static std::array<Number, dim>
    invariants_of(const Symmetric2<Number> &c);

    /// The invariants in three dimensions of a flat body.
    template <typename Number>
    static Invariants<Number>
    spatial(const Number &trace, const Number &determinant, const Number &c33)
    {
      return {trace + c33, determinant + trace * c33, determinant * c33};
    }

  private:
    /// The derivatives of the (reduced) energy with respect to its dim
    /// invariants, and of C_33.
    template <typename Number>
    struct Reduced
    {
      std::array<Number, dim>                  gradient{};
      std::array<std::array<Number, dim>, dim> hessian{};
      std::array<Number, dim>                  c33_gradient{};
    };

    template <typename Number>
    Reduced<Number>
    reduce(const std::array<Number, dim> &invariants,
           const bool                     with_hessian) const;

    /// The change of the invariants from @p c to @p c + @p difference, without
    /// cancellation.
    template <typename Number>
    static std::array<Number, dim>
    invariants_difference(const Symmetric2<Number> &c,
                          const Symmetric2<Number> &difference);

    /// dI/dC for each of the dim invariants.
    template <typename Number>
    static std::array<Symmetric2<Number>, dim>
    invariant_gradients(const Symmetric2<Number> &c);

    const Law       &law;
    const PlaneState plane_state;
  };



  template <int dim, typename Law>
  template <typename Number>
  std::array<Number, dim>
  ReducedEnergy<dim, Law>::invariants_of(const Symmetric2<Number> &c)
  {
    if constexpr (dim == 2)
      return {{dealii::trace(c), determinant(c)}};
    else
      return {{dealii::trace(c), second_invariant(c), determinant(c)}};
  }



  template <int dim, typename Law>
  template <typename Number>
  std::array<Number, dim>
  ReducedEnergy<dim, Law>::invariants_difference(
    const Symmetric2<Number> &c,
    const Symmetric2<Number> &difference)
  {
    const Symmetric2<Number> mean    = c + Number(.5) * difference;
    const Number             d_trace = dealii::trace(difference);
    const Number d_second = dealii::trace(mean) * d_trace - mean * difference;
    // In 2D the second invariant is the determinant.
    if constexpr (dim == 2)
      return {{d_trace, d_second}};
    else
      {
        using General       = dealii::Tensor<2, dim, Number>;
        const auto cofactor = [](const Symmetric2<Number> &a) {
          return symmetrize(General(a) * General(a)) - dealii::trace(a) * a +
            second_invariant(a) * dealii::unit_symmetric_tensor<dim, Number>();
        };
        return {{d_trace,
                 d_second,
                 cofactor(c) * difference + c * cofactor(difference) +
                   determinant(difference)}};
      }
  }



  template <int dim, typename Law>
  template <typename Number>
  std::array<dealii::SymmetricTensor<2, dim, Number>, dim>
  ReducedEnergy<dim, Law>::invariant_gradients(const Symmetric2<Number> &c)
  {
    using General       = dealii::Tensor<2, dim, Number>;
    const auto identity = dealii::unit_symmetric_tensor<dim, Number>();
    const Symmetric2<Number> second = dealii::trace(c) * identity - c;
    if constexpr (dim == 2)
      return {{identity, second}};
    else
      return {{identity,
               second,
               symmetrize(General(c) * General(c)) - dealii::trace(c) * c +
                 second_invariant(c) * identity}};
  }



  template <int dim, typename Law>
  template <typename Number>
  Number
  ReducedEnergy<dim, Law>::c33(const Number &trace,
                               const Number &determinant) const
  {
    return plane_state == PlaneState::plane_strain
      ? Number(1.)
      : law.plane_stress_c33(trace, determinant);
  }



  template <int dim, typename Law>
  template <typename Number>
  Number
  ReducedEnergy<dim, Law>::energy(const Symmetric2<Number> &c) const
  {
    const auto i = invariants_of(c);
    if constexpr (dim == 2)
      return law.energy(spatial(i[0], i[1], c33(i[0], i[1])));
    else
      return law.energy(Invariants<Number>{i[0], i[1], i[2]});
  }



  template <int dim, typename Law>
  template <typename Number>
  Number
  ReducedEnergy<dim, Law>::energy_difference(
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
        return law.energy_difference(
          spatial(i[0], i[1], s),
          Invariants<Number>{diff[0] + d_s,
                             diff[1] + diff[0] * s_1 + i[0] * d_s,
                             diff[1] * s_1 + i[1] * d_s});
      }
    else
      return law.energy_difference(Invariants<Number>{i[0], i[1], i[2]},
                                   Invariants<Number>{diff[0],
                                                      diff[1],
                                                      diff[2]});
  }



  template <int dim, typename Law>
  template <typename Number>
  typename ReducedEnergy<dim, Law>::template Reduced<Number>
  ReducedEnergy<dim, Law>::reduce(const std::array<Number, dim> &invariants,
                                  const bool with_hessian) const
  {
    Reduced<Number> reduced;
    if constexpr (dim == 3)
      {
        const Invariants<Number> i{invariants[0], invariants[1], invariants[2]};
        reduced.gradient = law.gradient(i);
        if (with_hessian)
          reduced.hessian = law.hessian(i);
      }
    else
      {
        // With trace t, determinant b and s = C_33:
        // I1 = t + s, I2 = b + t s, I3 = b s.
        const Number t = invariants[0], b = invariants[1];
        const Number s   = c33(t, b);
        const auto   i   = spatial(t, b, s);
        const auto   g   = law.gradient(i);
        reduced.gradient = {{g[0] + s * g[1], g[1] + s * g[2]}};
        if (!with_hessian)
          return reduced;

        // Directions d(I1, I2, I3) along t, b and s.
        const auto                  h = law.hessian(i);
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



  template <int dim, typename Law>
  template <typename Number>
  dealii::SymmetricTensor<2, dim, Number>
  ReducedEnergy<dim, Law>::derivative(const Symmetric2<Number> &c) const
  {
    const auto         reduced   = reduce<Number>(invariants_of(c), false);
    const auto         gradients = invariant_gradients(c);
    Symmetric2<Number> result;
    for (unsigned int k = 0; k < dim; ++k)
      result += reduced.gradient[k] * gradients[k];
    return result;
  }



  template <int dim, typename Law>
  template <typename Number>
  void
  ReducedEnergy<dim, Law>::derivatives(const Symmetric2<Number> &c,
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
    const auto identity = dealii::unit_symmetric_tensor<dim, Number>();
    second += reduced.gradient[1] *
      (outer_product(identity, identity) -
       dealii::identity_tensor<dim, Number>());
    // that of the determinant in 3D is linear: of C^2 - tr(C) C + I2 1.
    if constexpr (dim == 3)
      {
        Symmetric4<Number> curvature = outer_product(identity, gradients[1]) -
          outer_product(c, identity) -
          dealii::trace(c) * dealii::identity_tensor<dim, Number>();
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



  template <int dim, typename Law>
  template <typename Number>
  Number
  ReducedEnergy<dim, Law>::trace(const Symmetric2<Number> &c,
                                 Symmetric2<Number>       &derivative) const
  {
    derivative = dealii::unit_symmetric_tensor<dim, Number>();
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
} // namespace Ricochet

#endif
