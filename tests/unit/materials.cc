// SPDX-License-Identifier: LGPL-2.1-or-later

// Hyperelastic laws in plane strain, plane stress and 3D: stress and tangent
// against automatic differentiation of the energy (Sacado, twice), frame
// indifference, the limit of small strains; Gonzalez' stress and its identity;
// viscosities and their dissipation.

#include "deformation_gradient.h"

#include <base/exceptions.h>
#include <materials/gonzalez.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/ciarlet_geymonat.h>
#include <materials/laws/mooney_rivlin.h>
#include <materials/laws/neo_hookean.h>
#include <materials/laws/saint_venant_kirchhoff.h>
#include <materials/laws/yeoh.h>
#include <materials/material_parameters.h>

#include <Sacado.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <random>

using namespace Ricochet;
using dealii::SymmetricTensor;
using dealii::Tensor;
using AD  = Sacado::Fad::DFad<double>;
using AD2 = Sacado::Fad::DFad<AD>;

BOOST_AUTO_TEST_SUITE(materials)

namespace
{
  const CiarletGeymonat      ciarlet_geymonat{.5, .005, .35};
  const SaintVenantKirchhoff saint_venant_kirchhoff{1.2, .8};
  const NeoHookean           neo_hookean{1.2, .8};
  const MooneyRivlin         mooney_rivlin{.3, .1, 1.7};
  const Yeoh                 yeoh{.4, -.02, .05, 1.7};

  template <int dim>
  SymmetricTensor<2, dim>
  cauchy_green(const Tensor<2, dim> &f)
  {
    return symmetrize(transpose(f) * f);
  }

  /// The pairs of indices of the independent components of C; in 2D also C_33.
  template <int dim>
  std::vector<std::array<unsigned int, 2>>
  components()
  {
    if constexpr (dim == 2)
      return {{{0, 0}}, {{1, 1}}, {{0, 1}}, {{2, 2}}};
    else
      return {{{0, 0}}, {{1, 1}}, {{2, 2}}, {{0, 1}}, {{0, 2}}, {{1, 2}}};
  }

  /// The energy as a function of the components of C in three dimensions,
  /// written out without any of the formulas of the library.
  template <typename Law, typename Number>
  Number
  energy_of_components(const Law &law, const Number c[3][3])
  {
    const Number i1 = c[0][0] + c[1][1] + c[2][2];
    const Number i2 = c[0][0] * c[1][1] + c[1][1] * c[2][2] +
      c[2][2] * c[0][0] - c[0][1] * c[0][1] - c[0][2] * c[0][2] -
      c[1][2] * c[1][2];
    const Number i3 = c[0][0] * (c[1][1] * c[2][2] - c[1][2] * c[1][2]) -
      c[0][1] * (c[0][1] * c[2][2] - c[1][2] * c[0][2]) +
      c[0][2] * (c[0][1] * c[1][2] - c[1][1] * c[0][2]);
    return law.template energy<Number>({i1, i2, i3});
  }

  template <int dim, typename Law>
  void
  compare_with_automatic_differentiation(const Law &law, const PlaneState state)
  {
    const Hyperelastic<dim> material(
      std::make_shared<HyperelasticLawImplementation<Law>>(law),
      state);
    const auto         indices = components<dim>();
    const unsigned int n       = indices.size();
    for (const double size : {0., 1e-4, .1, .3})
      for (unsigned int seed = 0; seed < 5; ++seed)
        {
          const auto f = deformation_gradient<dim>(size, seed);
          const auto c = cauchy_green(f);
          if (dealii::determinant(c) < .05)
            continue;

          // C_33 as computed by the program, to be stationary.
          const double c33 = dim == 3 || state == PlaneState::plane_strain
            ? 1.
            : CompletedLaw<Law>(law).plane_stress_c33(dealii::trace(c),
                                                      dealii::determinant(c));
          AD2          ad_c[3][3];
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              ad_c[i][j] = AD2(n, AD(n, 0.));
          for (unsigned int k = 0; k < n; ++k)
            {
              const auto [i, j]  = indices[k];
              const double value = static_cast<int>(i) < dim ? c[i][j] : c33;
              AD2          variable(n, k, AD(n, k, value));
              ad_c[i][j] = ad_c[j][i] = variable;
            }
          const AD2 energy = energy_of_components(law, ad_c);
          BOOST_CHECK_SMALL(energy.val().val() - material.energy(c), 1e-14);

          SymmetricTensor<2, dim> first;
          SymmetricTensor<4, dim> second;
          material.derivatives(c, first, second);
          BOOST_CHECK_SMALL((first - material.derivative(c)).norm(), 1e-15);

          const auto gradient = [&](const unsigned int k) {
            return energy.dx(k).val();
          };
          const auto hessian = [&](const unsigned int k, const unsigned int l) {
            return energy.dx(k).dx(l);
          };
          const bool condensed = dim == 2 && state == PlaneState::plane_stress;
          if (condensed)
            BOOST_CHECK_SMALL(gradient(3), 1e-13);
          const unsigned int n_plane = dim * (dim + 1) / 2;
          for (unsigned int k = 0; k < n_plane; ++k)
            {
              // An off-diagonal component stands in the energy twice.
              const auto [i, j]     = indices[k];
              const double k_factor = i == j ? 1. : 2.;
              BOOST_CHECK_SMALL(gradient(k) - k_factor * first[i][j], 1e-13);
              for (unsigned int l = 0; l < n_plane; ++l)
                {
                  const auto [p, q]     = indices[l];
                  const double l_factor = p == q ? 1. : 2.;
                  double       expected = hessian(k, l);
                  if (condensed)
                    expected -= hessian(k, 3) * hessian(l, 3) / hessian(3, 3);
                  BOOST_CHECK_SMALL(expected -
                                      k_factor * l_factor * second[i][j][p][q],
                                    1e-11 * (1. + std::abs(expected)));
                }
            }

          // dW/dF = 2 F dW/dC, and the Cauchy stress turns with the body.
          const auto     stress = material.cauchy_stress(f);
          Tensor<2, dim> rotation(dealii::unit_symmetric_tensor<dim>());
          rotation[0][0] = rotation[1][1] = std::cos(.7);
          rotation[0][1]                  = -std::sin(.7);
          rotation[1][0]                  = std::sin(.7);
          BOOST_CHECK_SMALL(material.energy(cauchy_green(rotation * f)) -
                              material.energy(c),
                            1e-14);
          BOOST_CHECK_SMALL(
            (Tensor<2, dim>(material.cauchy_stress(rotation * f)) -
             rotation * Tensor<2, dim>(stress) * transpose(rotation))
              .norm(),
            1e-13);
        }
  }

  /// The derivative of the stress at rest must be that of linear elasticity.
  template <int dim>
  void
  compare_with_linear_elasticity(
    const std::shared_ptr<const HyperelasticLaw> &law,
    const LinearElastic                          &linear,
    const PlaneState                              state)
  {
    const Hyperelastic<dim> material(law, state);
    const double            size     = 1e-7;
    Tensor<2, dim>          gradient = size *
      (deformation_gradient<dim>(1., 3) -
       Tensor<2, dim>(dealii::unit_symmetric_tensor<dim>()));
    const auto stress =
      material.cauchy_stress(dealii::unit_symmetric_tensor<dim>() + gradient);
    const auto expected = linear.in_plane(state).stress(symmetrize(gradient));
    BOOST_CHECK_SMALL((stress - expected).norm(), 1e-6 * expected.norm());
  }

  template <int dim>
  void
  check_gonzalez(const Hyperelastic<dim> &material)
  {
    using Stress         = GonzalezStress<dim>;
    const auto old_c     = cauchy_green(deformation_gradient<dim>(.2, 7));
    const auto direction = cauchy_green(deformation_gradient<dim>(.5, 8)) -
      dealii::unit_symmetric_tensor<dim>();
    for (const double size :
         {.5, 1e-2, 1e-4, 1e-5, 1e-6, 2e-7, 5e-8, 1e-9, 1e-12, 0.})
      {
        const SymmetricTensor<2, dim> difference = size * direction;
        SymmetricTensor<2, dim>       stress;
        SymmetricTensor<4, dim>       tangent;
        Stress::stress_and_tangent(material,
                                   old_c,
                                   difference,
                                   stress,
                                   tangent);
        BOOST_CHECK_SMALL(
          (stress - Stress::stress(material, old_c, difference)).norm(),
          1e-15);

        // The work of the step is the difference of energies: to a few units of
        // round-off of the stress, and, where the quotient is dropped, to the
        // third power of the difference.
        const double energy_difference =
          material.energy_difference(old_c, difference);
        const double norm = difference.norm();
        BOOST_CHECK_SMALL(
          .5 * (stress * difference) - energy_difference,
          1e-15 * norm + (norm < Stress::threshold ? norm * norm * norm : 0.));
        BOOST_CHECK_SMALL(energy_difference -
                            (material.energy(old_c + difference) -
                             material.energy(old_c)),
                          2e-15);

        // The tangent against a central difference; its round-off grows as the
        // difference of C falls.
        const double eps = 1e-5;
        for (unsigned int i = 0; i < dim; ++i)
          for (unsigned int j = i; j < dim; ++j)
            {
              SymmetricTensor<2, dim> unit;
              unit[i][j] = 1.;
              // Only where the branch does not change within the difference.
              if (norm < 1e2 * eps && norm > 0.)
                continue;
              const auto quotient =
                (Stress::stress(material, old_c, difference + eps * unit) -
                 Stress::stress(material, old_c, difference - eps * unit)) /
                (2. * eps);
              BOOST_CHECK_SMALL((quotient - tangent * unit).norm(), 1e-7);
            }
        // For small differences the tangent is that of the mean: continuous
        // across the threshold.
        if (norm < 1e-4)
          {
            SymmetricTensor<2, dim> derivative;
            SymmetricTensor<4, dim> second;
            material.derivatives(old_c + .5 * difference, derivative, second);
            BOOST_CHECK_SMALL((tangent - second).norm(), 1e-8 + 10. * norm);
          }
      }
  }

  template <int dim>
  void
  check_viscosity(const Hyperelastic<dim> &material)
  {
    const double time_step = .1;
    const auto   old_c     = cauchy_green(deformation_gradient<dim>(.2, 7));
    for (const auto law : {Viscosity::Law::curnier, Viscosity::Law::pioletti})
      for (const double scale : {.6, 1., 1.5})
        for (unsigned int seed = 0; seed < 4; ++seed)
          {
            const Viscosity               viscosity{law, 2.5};
            const SymmetricTensor<2, dim> c          = scale * old_c;
            const SymmetricTensor<2, dim> difference = .3 *
              (cauchy_green(deformation_gradient<dim>(.5, 20 + seed)) -
               dealii::unit_symmetric_tensor<dim>());
            ViscousTangent<dim, double> tangent;
            const auto                  stress = viscous_stress(material,
                                               viscosity,
                                               c,
                                               difference,
                                               time_step,
                                               &tangent);
            const double dissipation           = .5 * (stress * difference);
            BOOST_CHECK_GE(dissipation, 0.);
            if (law == Viscosity::Law::curnier)
              BOOST_CHECK_CLOSE(dissipation,
                                viscosity.eta / time_step *
                                  (difference * difference),
                                1e-10);
            const double eps = 1e-6;
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                {
                  SymmetricTensor<2, dim> unit;
                  unit[i][j]       = 1.;
                  const auto value = [&](const double of_c,
                                         const double of_change) {
                    const SymmetricTensor<2, dim> at = c + of_c * unit,
                                                  by = difference +
                      of_change * unit;
                    return viscous_stress(material,
                                          viscosity,
                                          at,
                                          by,
                                          time_step);
                  };
                  BOOST_CHECK_SMALL(((value(0., eps) - value(0., -eps)) /
                                       (2. * eps) -
                                     tangent.with_change * unit)
                                      .norm(),
                                    1e-5);
                  BOOST_CHECK_SMALL(((value(eps, 0.) - value(-eps, 0.)) /
                                       (2. * eps) -
                                     tangent.with_c * unit)
                                      .norm(),
                                    1e-5);
                }
          }
  }

  template <int dim>
  void
  check_several_points(const Hyperelastic<dim> &material)
  {
    for (const double change : {0., 1e-9, 1e-4, .05, .3})
      {
        dealii::SymmetricTensor<2, dim, Lanes>       old_c, difference;
        std::vector<dealii::SymmetricTensor<2, dim>> stress;
        for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
          {
            const auto f = deformation_gradient<dim>(.1, lane);
            const auto c = cauchy_green(f);
            const auto d =
              cauchy_green(f +
                           change * deformation_gradient<dim>(.5, 100 + lane)) -
              c;
            stress.push_back(GonzalezStress<dim>::stress(material, c, d));
            for (unsigned int i = 0; i < dim; ++i)
              for (unsigned int j = i; j < dim; ++j)
                {
                  old_c[i][j][lane]      = c[i][j];
                  difference[i][j][lane] = d[i][j];
                }
          }
        const auto all = material.step_stress(old_c, difference);
        for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
          for (unsigned int i = 0; i < dim; ++i)
            for (unsigned int j = i; j < dim; ++j)
              BOOST_CHECK_SMALL(all[i][j][lane] - stress[lane][i][j], 1e-11);
      }
  }

  /// Energy, gradient and Hessian of a law, and nothing else.
  template <typename Law>
  struct Bare
  {
    Law law;

    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      return law.template energy<Number>(i);
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      return law.gradient(i);
    }

    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      return law.hessian(i);
    }
  };

  template <typename Law>
  void
  compare_general_formulas(const Law &law, const ThirdDerivatives &third)
  {
    const CompletedLaw<Law> own(law);
    // The differences of invariants from tiny to as large as they are.
    for (unsigned int seed = 0; seed < 20; ++seed)
      for (const double size : {1e-13, 1e-9, 1e-5, 1e-2, .1, .5, 2., 10.})
        {
          const auto   c = cauchy_green(deformation_gradient<3>(.2, seed));
          std::mt19937 generator(100 + seed);
          std::uniform_real_distribution<double> number(-1., 1.);
          const Invariants<>                     i{dealii::first_invariant(c),
                               dealii::second_invariant(c),
                               dealii::third_invariant(c)};
          Invariants<> difference{size * number(generator),
                                  size * number(generator),
                                  size * number(generator)};
          if (i.third + difference.third < .05)
            difference.third = std::abs(difference.third);
          const double expected = own.energy_difference(i, difference);
          const double change   = std::max({std::abs(difference.first),
                                            std::abs(difference.second),
                                            std::abs(difference.third)});
          // Round-off of the difference where it is small, of the energies where not.
          BOOST_CHECK_SMALL(own.integrated_difference(i, difference) - expected,
                            size <= .01 ? 2e-15 * change
                                        : 4e-14 * (1. + std::abs(expected)));

          Invariants<Lanes> i_lanes{i.first, i.second, i.third};
          const Lanes       lanes =
            own.integrated_difference(i_lanes,
                                      Invariants<Lanes>{difference.first,
                                                        difference.second,
                                                        difference.third});
          for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
            BOOST_CHECK_SMALL(lanes[lane] - expected,
                              size <= .01 ? 2e-15 * change
                                          : 4e-14 * (1. + std::abs(expected)));
        }

    // Sheets, squeezed and stretched; each lane another one.
    for (const double size : {0., .1, .5, 3.})
      {
        Lanes traces, determinants;
        for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
          {
            auto f = deformation_gradient<2>(size, 11 * lane);
            if (dealii::determinant(f) < .2)
              f = dealii::unit_symmetric_tensor<2>() * (.5 + size);
            const auto c       = cauchy_green(f);
            traces[lane]       = dealii::trace(c);
            determinants[lane] = dealii::determinant(c);
          }
        const Lanes lanes = own.c33_by_newton(traces, determinants);
        for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
          {
            // Saint Venant and Kirchhoff's sheet of a large trace has no thickness.
            const double expected =
              own.plane_stress_c33(traces[lane], determinants[lane]);
            if (expected < 1e-3)
              continue;
            BOOST_CHECK_CLOSE(own.c33_by_newton(traces[lane],
                                                determinants[lane]),
                              expected,
                              1e-12);
            BOOST_CHECK_CLOSE(lanes[lane], expected, 1e-12);
          }
      }

    const auto found = own.differentiated_hessian({3.3, 3.2, .8});
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int l = 0; l < 3; ++l)
        for (unsigned int m = 0; m < 3; ++m)
          BOOST_CHECK_SMALL(found[k][l][m] - third[k][l][m], 1e-14);

    const LinearElastic small = own.at_small_strains();
    BOOST_CHECK_CLOSE(own.linearised_at_rest().lambda, small.lambda, 1e-12);
    BOOST_CHECK_CLOSE(own.linearised_at_rest().mu, small.mu, 1e-12);

    for (const auto state :
         {PlaneState::plane_strain, PlaneState::plane_stress})
      {
        const Hyperelastic<2> bare(
          std::make_shared<HyperelasticLawImplementation<Bare<Law>>>(
            Bare<Law>{law}),
          state);
        check_gonzalez(bare);
        check_several_points(bare);
      }
    const Hyperelastic<3> bare(
      std::make_shared<HyperelasticLawImplementation<Bare<Law>>>(
        Bare<Law>{law}),
      PlaneState::plane_strain);
    check_gonzalez(bare);
    check_several_points(bare);
  }

  template <typename Function>
  void
  for_all_materials(const Function &function)
  {
    for (const auto state :
         {PlaneState::plane_strain, PlaneState::plane_stress})
      {
        function(Hyperelastic<2>(
          std::make_shared<HyperelasticLawImplementation<CiarletGeymonat>>(
            ciarlet_geymonat),
          state));
        function(Hyperelastic<2>(
          std::make_shared<HyperelasticLawImplementation<SaintVenantKirchhoff>>(
            saint_venant_kirchhoff),
          state));
        function(Hyperelastic<2>(
          std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
            neo_hookean),
          state));
        function(Hyperelastic<2>(
          std::make_shared<HyperelasticLawImplementation<MooneyRivlin>>(
            mooney_rivlin),
          state));
        function(Hyperelastic<2>(
          std::make_shared<HyperelasticLawImplementation<Yeoh>>(yeoh),
          state));
      }
    function(Hyperelastic<3>(
      std::make_shared<HyperelasticLawImplementation<CiarletGeymonat>>(
        ciarlet_geymonat),
      PlaneState::plane_strain));
    function(Hyperelastic<3>(
      std::make_shared<HyperelasticLawImplementation<SaintVenantKirchhoff>>(
        saint_venant_kirchhoff),
      PlaneState::plane_strain));
    function(Hyperelastic<3>(
      std::make_shared<HyperelasticLawImplementation<NeoHookean>>(neo_hookean),
      PlaneState::plane_strain));
    function(Hyperelastic<3>(
      std::make_shared<HyperelasticLawImplementation<MooneyRivlin>>(
        mooney_rivlin),
      PlaneState::plane_strain));
    function(Hyperelastic<3>(
      std::make_shared<HyperelasticLawImplementation<Yeoh>>(yeoh),
      PlaneState::plane_strain));
  }
} // namespace



BOOST_AUTO_TEST_CASE(derivatives_are_derivatives)
{
  for (const auto state : {PlaneState::plane_strain, PlaneState::plane_stress})
    {
      compare_with_automatic_differentiation<2>(ciarlet_geymonat, state);
      compare_with_automatic_differentiation<2>(saint_venant_kirchhoff, state);
      compare_with_automatic_differentiation<2>(neo_hookean, state);
      compare_with_automatic_differentiation<2>(mooney_rivlin, state);
      compare_with_automatic_differentiation<2>(yeoh, state);
    }
  const PlaneState none = PlaneState::plane_strain;
  compare_with_automatic_differentiation<3>(ciarlet_geymonat, none);
  compare_with_automatic_differentiation<3>(saint_venant_kirchhoff, none);
  compare_with_automatic_differentiation<3>(neo_hookean, none);
  compare_with_automatic_differentiation<3>(mooney_rivlin, none);
  compare_with_automatic_differentiation<3>(yeoh, none);
}

// The closed form of plane stress against its definition for a large stretch
// (methods.md writes it for C_33).
BOOST_AUTO_TEST_CASE(plane_stress_of_ciarlet_geymonat)
{
  const double trace = 3.1, det = 1.7;
  const double c33 = ciarlet_geymonat.plane_stress_c33(trace, det);
  BOOST_CHECK_CLOSE(c33,
                    (.5 + 2. * .005 + .35) / (.5 + .005 * trace + .35 * det),
                    1e-12);
  BOOST_CHECK_CLOSE(ciarlet_geymonat.plane_stress_c33(2., 1.), 1., 1e-12);
}

BOOST_AUTO_TEST_CASE(small_strains_are_linear)
{
  const auto svk =
    std::make_shared<HyperelasticLawImplementation<SaintVenantKirchhoff>>(
      saint_venant_kirchhoff);
  const auto nh =
    std::make_shared<HyperelasticLawImplementation<NeoHookean>>(neo_hookean);
  const auto cg =
    std::make_shared<HyperelasticLawImplementation<CiarletGeymonat>>(
      ciarlet_geymonat);
  const auto mr = std::make_shared<HyperelasticLawImplementation<MooneyRivlin>>(
    mooney_rivlin);
  const auto ye = std::make_shared<HyperelasticLawImplementation<Yeoh>>(yeoh);
  const LinearElastic lame{1.2, .8};
  const LinearElastic mr_lame{1.7 - 2. / 3. * .8, .8};
  const LinearElastic cg_lame{4. * (.005 + .35), 2. * (.5 + .005)};
  for (const auto state : {PlaneState::plane_strain, PlaneState::plane_stress})
    {
      compare_with_linear_elasticity<2>(svk, lame, state);
      compare_with_linear_elasticity<2>(nh, lame, state);
      compare_with_linear_elasticity<2>(cg, cg_lame, state);
      compare_with_linear_elasticity<2>(mr, mr_lame, state);
      compare_with_linear_elasticity<2>(ye, mr_lame, state);
    }
  compare_with_linear_elasticity<3>(svk, lame, PlaneState::plane_strain);
  compare_with_linear_elasticity<3>(nh, lame, PlaneState::plane_strain);
  compare_with_linear_elasticity<3>(cg, cg_lame, PlaneState::plane_strain);
  compare_with_linear_elasticity<3>(mr, mr_lame, PlaneState::plane_strain);
  compare_with_linear_elasticity<3>(ye, mr_lame, PlaneState::plane_strain);
}

// Simple shear by gamma, by hand: the shear stress is 2 (c10 + c01) gamma with Mooney's law,
// however large it is, and 2 gamma (c10 + 2 c20 gamma^2 + 3 c30 gamma^4) with Yeoh's.
BOOST_AUTO_TEST_CASE(simple_shear)
{
  const auto shear_stress = [](const auto &law, const double gamma) {
    const Hyperelastic<3> material(
      std::make_shared<
        HyperelasticLawImplementation<std::decay_t<decltype(law)>>>(law),
      PlaneState::plane_strain);
    Tensor<2, 3> f(dealii::unit_symmetric_tensor<3>());
    f[0][1]           = gamma;
    const auto stress = f *
      Tensor<2, 3>(2. *
                   material.derivative(
                     SymmetricTensor<2, 3>(symmetrize(transpose(f) * f)))) *
      transpose(f);
    return stress[0][1];
  };
  for (const double gamma : {.1, 1., 3.})
    {
      const double square = gamma * gamma;
      BOOST_CHECK_CLOSE(shear_stress(mooney_rivlin, gamma),
                        2. * (.3 + .1) * gamma,
                        1e-10);
      BOOST_CHECK_CLOSE(shear_stress(yeoh, gamma),
                        2. * gamma *
                          (.4 - 2. * .02 * square + 3. * .05 * square * square),
                        1e-10);
    }
}

BOOST_AUTO_TEST_CASE(gonzalez_stress_keeps_the_energy)
{
  for_all_materials([](const auto &material) { check_gonzalez(material); });
}

BOOST_AUTO_TEST_CASE(several_points_at_once_are_as_one)
{
  // The function that steps take their stress from, against the same formula for one
  // point.
  for_all_materials(
    [](const auto &material) { check_several_points(material); });

  // Its logarithm, to round-off of the result, where it is a series and where not.
  for (double x = 1e-16; x < 10.; x *= 1.3)
    for (const double sign : {1., -1.})
      if (sign * x > -.999)
        {
          const double exact = std::log1p(sign * x);
          const double error = log_of_one_plus(Lanes(sign * x))[0] / exact - 1.;
          BOOST_CHECK_SMALL(error, 8e-16);
        }
}

BOOST_AUTO_TEST_CASE(functions_of_several_points)
{
  const auto check =
    [](const auto &lanes_of, const auto &exact, const double from) {
      Lanes x;
      for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
        x[lane] = from + .7 * lane;
      const Lanes y = lanes_of(x);
      for (unsigned int lane = 0; lane < Lanes::size(); ++lane)
        BOOST_CHECK_LE(std::abs(y[lane] - exact(x[lane])),
                       4e-16 * std::abs(exact(x[lane])));
    };
  for (const double from : {1e-12, .3, 2., 40.})
    {
      check([](const Lanes &x) { return sqrt(x); },
            [](const double x) { return std::sqrt(x); },
            from);
      check([](const Lanes &x) { return cbrt(x); },
            [](const double x) { return std::cbrt(x); },
            from);
      check([](const Lanes &x) { return log(x); },
            [](const double x) { return std::log(x); },
            from);
      check([](const Lanes &x) { return pow(x, -1. / 3.); },
            [](const double x) { return std::pow(x, -1. / 3.); },
            from);
      for (const double sign : {1., -1.})
        {
          check([](const Lanes &x) { return exp(x); },
                [](const double x) { return std::exp(x); },
                sign * from);
          check([](const Lanes &x) { return expm1(x); },
                [](const double x) { return std::expm1(x); },
                sign * from);
        }
    }
}

// The general formulas for functions that a law does not write itself, against
// the laws' own.
BOOST_AUTO_TEST_CASE(what_a_law_leaves_out)
{
  ThirdDerivatives third{};
  compare_general_formulas(saint_venant_kirchhoff, third);
  const double i3 = .8, cube = i3 * i3 * i3;
  third[2][2][2] = -2. * (.5 + 2. * .005 + .35) / cube;
  compare_general_formulas(ciarlet_geymonat, third);
  // h = (mu/2 + lambda/4 (1 - ln I3)) / I3^2
  third[2][2][2] = (-1.2 / 4. - .8 - 1.2 / 2. * (1. - std::log(i3))) / cube;
  compare_general_formulas(neo_hookean, third);
}

BOOST_AUTO_TEST_CASE(viscosity_dissipates)
{
  for_all_materials([](const auto &material) { check_viscosity(material); });
}

// In compression tr C - 3 is negative; Pioletti's dissipation is clipped.
BOOST_AUTO_TEST_CASE(pioletti_is_clipped)
{
  const Hyperelastic<3> material(
    std::make_shared<HyperelasticLawImplementation<NeoHookean>>(neo_hookean),
    PlaneState::plane_strain);
  const auto identity = dealii::unit_symmetric_tensor<3>();
  const auto stress   = viscous_stress<3>(material,
                                        {Viscosity::Law::pioletti, 1.},
                                        .5 * identity,
                                        .1 * identity,
                                        1.);
  BOOST_CHECK_EQUAL(stress.norm(), 0.);
}

BOOST_AUTO_TEST_CASE(parameters_without_meaning_are_refused)
{
  MaterialParameters parameters;
  BOOST_CHECK_THROW(parameters.validate(3, "midpoint"), InputError);
  parameters.plane_state = "plane strain";
  BOOST_CHECK_NO_THROW(parameters.validate(3, "midpoint"));
  parameters.viscosity = "Curnier";
  BOOST_CHECK_THROW(parameters.validate(2, "midpoint"), InputError);
  parameters.law = "neo-Hookean";
  BOOST_CHECK_NO_THROW(parameters.validate(2, "midpoint"));
  BOOST_CHECK_THROW(parameters.validate(2, "ARKODE"), InputError);
}

BOOST_AUTO_TEST_SUITE_END()
