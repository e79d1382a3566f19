// SPDX-License-Identifier: LGPL-2.1-or-later

// Values that are independent of the code: hand calculations for one
// element, one oscillator, a rectangle in rigid motion. Other suites compare
// parts of the code with each other (stress with energy, tangent with force), and
// a factor that is wrong in all of them alike passes; here it does not.

#include <contact/obstacles/half_space.h>
#include <contact/treatments/contact_treatment.h>
#include <contact/laws/coulomb_friction.h>
#include <contact/laws/regularised_friction.h>
#include <contact/laws/augmented_lagrangian.h>
#include <contact/laws/nitsche.h>
#include <contact/laws/nitsche_two_point.h>
#include <contact/laws/normal_compliance.h>
#include <contact/laws/penalty.h>
#include <contact/laws/signorini_multiplier.h>
#include <contact/treatments/nitsche_bound.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/gonzalez.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/ciarlet_geymonat.h>
#include <materials/laws/neo_hookean.h>
#include <materials/laws/saint_venant_kirchhoff.h>
#include <materials/material_parameters.h>
#include <output/mean_rotation.h>
#include <output/momenta.h>
#include <problems/impact.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/physics/transformations.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Ricochet;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(independent_values)

namespace
{
  // Per cent, as BOOST_CHECK_CLOSE counts: a relative 1e-11.
  constexpr double round_off = 1e-9;

  /// A box of nx x ny (x nz) cells. Boundary ids: 0 and 1 are the ends in x, 2
  /// and 3 those in y, 4 and 5 those in z.
  template <int dim>
  struct Block
  {
    Block(const Point<dim>                &low,
          const Point<dim>                &high,
          const std::vector<unsigned int> &n_cells)
      : mesh(MPI_COMM_WORLD)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(mesh,
                                                        n_cells,
                                                        low,
                                                        high,
                                                        /* colorize */ true);
    }

    Body<dim>
    body(const std::set<dealii::types::boundary_id> &contact) const
    {
      return Body<dim>(mesh,
                       1,
                       {},
                       contact,
                       MultiplierSpace::none,
                       MPI_COMM_WORLD);
    }

    dealii::parallel::shared::Triangulation<dim> mesh;
  };

  template <int dim>
  using Field = std::vector<std::function<double(const Point<dim> &)>>;

  template <int dim>
  Vector
  interpolated(const Body<dim> &body, const Field<dim> &components)
  {
    Vector vector;
    body.interpolate(dealii::FunctionFromFunctionObjects<dim>(components),
                     vector);
    return vector;
  }

  /// A plane through @p point, with the outward normal @p normal.
  template <int dim>
  Obstacles
  plane(const dealii::types::boundary_id id,
        const Point<dim>                &point,
        const Tensor<1, dim>            &normal)
  {
    return {{id, half_space_at_rest<dim>(point, normal)}};
  }

  /// The sum of a component of @p force over the nodes of a boundary.
  template <int dim>
  double
  boundary_sum(const Body<dim>                 &body,
               const Vector                    &force,
               const unsigned int               component,
               const dealii::types::boundary_id id)
  {
    dealii::ComponentMask mask(dim, false);
    mask.set(component, true);
    double sum = 0.;
    for (const auto i :
         dealii::DoFTools::extract_boundary_dofs(body.dof_handler(),
                                                 mask,
                                                 {id}))
      sum += force(i);
    return sum;
  }

  template <int dim, typename Law>
  std::shared_ptr<const Hyperelastic<dim>>
  hyperelastic(const Law       &law,
               const PlaneState state = PlaneState::plane_strain)
  {
    return std::make_shared<const Hyperelastic<dim>>(
      std::make_shared<HyperelasticLawImplementation<Law>>(law),
      state);
  }

  template <int dim>
  Tensor<2, dim>
  diagonal(const std::array<double, dim> &values)
  {
    Tensor<2, dim> result;
    for (unsigned int i = 0; i < dim; ++i)
      result[i][i] = values[i];
    return result;
  }

  template <int dim>
  double
  energy(const Hyperelastic<dim> &material, const Tensor<2, dim> &f)
  {
    return material.energy(symmetrize(transpose(f) * f));
  }

  // Numbers without a factor of two between them.
  const double lambda = 1.7, mu = .6;
  const double c1 = .5, c2 = .11, d = .35, c_log = c1 + 2. * c2 + d;
  const SaintVenantKirchhoff saint_venant_kirchhoff{lambda, mu};
  const NeoHookean           neo_hookean{lambda, mu};
  const CiarletGeymonat      ciarlet_geymonat{c1, c2, d};

  /// Principal Cauchy stresses for the stretches l of the axes, J = l1 l2 l3:
  /// sigma_i = l_i/J dW/dl_i.
  using Principal = std::function<Tensor<1, 3>(const Tensor<1, 3> &)>;

  /// With W = lambda/2 tr(E)^2 + mu tr(E^2), E_i = (l_i^2 - 1)/2.
  Tensor<1, 3>
  stress_of_saint_venant_kirchhoff(const Tensor<1, 3> &l)
  {
    Tensor<1, 3> stress;
    const double trace = .5 * (l * l - 3.);
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = l[i] * l[i] * (lambda * trace + mu * (l[i] * l[i] - 1.)) /
        (l[0] * l[1] * l[2]);
    return stress;
  }

  /// With W = mu/2 (I1 - 3) - mu ln J + lambda/2 (ln J)^2.
  Tensor<1, 3>
  stress_of_neo_hookean(const Tensor<1, 3> &l)
  {
    Tensor<1, 3> stress;
    const double j = l[0] * l[1] * l[2];
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = (mu * (l[i] * l[i] - 1.) + lambda * std::log(j)) / j;
    return stress;
  }

  /// With W = c1 (I1 - 3) + c2 (I2 - 3) + d (J^2 - 1) - 2 (c1 + 2 c2 + d) ln J.
  Tensor<1, 3>
  stress_of_ciarlet_geymonat(const Tensor<1, 3> &l)
  {
    Tensor<1, 3> stress;
    const double j = l[0] * l[1] * l[2];
    for (unsigned int i = 0; i < 3; ++i)
      stress[i] = 2. *
        (c1 * l[i] * l[i] + c2 * l[i] * l[i] * (l * l - l[i] * l[i]) +
         d * j * j - c_log) /
        j;
    return stress;
  }

  double
  von_mises(const Tensor<1, 3> &s)
  {
    return std::sqrt(.5 *
                     ((s[0] - s[1]) * (s[0] - s[1]) +
                      (s[1] - s[2]) * (s[1] - s[2]) +
                      (s[2] - s[0]) * (s[2] - s[0])));
  }

  /// Stretches of the axes, in 3D and in plane strain.
  template <typename Law>
  void
  check_stretches(const Law &law, const Principal &stress)
  {
    for (const Tensor<1, 3> &l : {Tensor<1, 3>({1.4, 1., 1.}),    // one axis
                                  Tensor<1, 3>({1.25, 1.25, 1.}), // two
                                  Tensor<1, 3>({.7, 1.2, 1.}),
                                  Tensor<1, 3>({1.3, .8, 1.15})})
      {
        const Tensor<1, 3> expected = stress(l);
        const auto         f        = diagonal<3>({{l[0], l[1], l[2]}});
        const auto         material = hyperelastic<3>(law);
        const auto         cauchy   = material->cauchy_stress(f);
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            BOOST_CHECK_SMALL(cauchy[i][j] - (i == j ? expected[i] : 0.),
                              1e-13);
        const auto gradient = f - diagonal<3>({{1., 1., 1.}});
        BOOST_CHECK_CLOSE(Material<3>(material).von_mises(gradient),
                          von_mises(expected),
                          round_off);
        if (l[2] != 1.)
          continue;
        const auto flat_f    = diagonal<2>({{l[0], l[1]}});
        const auto flat      = hyperelastic<2>(law);
        const auto in_plane  = flat->cauchy_stress(flat_f);
        const auto flat_grad = flat_f - diagonal<2>({{1., 1.}});
        for (unsigned int i = 0; i < 2; ++i)
          BOOST_CHECK_SMALL(in_plane[i][i] - expected[i], 1e-13);
        BOOST_CHECK_SMALL(in_plane[0][1], 1e-14);
        BOOST_CHECK_CLOSE(Material<2>(flat).von_mises(flat_grad),
                          von_mises(expected),
                          round_off);
      }
  }

  /// A sheet with the stretches l1 and l2, whose thickness becomes l3.
  template <typename Law>
  void
  check_sheet(const Law       &law,
              const Principal &stress,
              const double     l1,
              const double     l2,
              const double     l3)
  {
    BOOST_CHECK_CLOSE(law.plane_stress_c33(l1 * l1 + l2 * l2,
                                           l1 * l1 * l2 * l2),
                      l3 * l3,
                      round_off);
    const Tensor<1, 3> expected = stress(Tensor<1, 3>({l1, l2, l3}));
    BOOST_CHECK_SMALL(expected[2], 1e-13);
    const auto material = hyperelastic<2>(law, PlaneState::plane_stress);
    const auto f        = diagonal<2>({{l1, l2}});
    const auto cauchy   = material->cauchy_stress(f);
    BOOST_CHECK_CLOSE(cauchy[0][0], expected[0], round_off);
    BOOST_CHECK_CLOSE(cauchy[1][1], expected[1], round_off);
    BOOST_CHECK_CLOSE(Material<2>(material).von_mises(f -
                                                      diagonal<2>({{1., 1.}})),
                      von_mises(expected),
                      round_off);
  }
} // namespace


// ### Materials

// E = mu (3 lambda + 2 mu)/(lambda + mu), nu = lambda/(2 (lambda + mu)); with
// lambda = 3/2 and mu = 1: E = 13/5, nu = 3/10.
BOOST_AUTO_TEST_CASE(young_modulus_and_lame)
{
  const LinearElastic lame = LinearElastic::from_young(2.6, .3);
  BOOST_CHECK_CLOSE(lame.lambda, 1.5, round_off);
  BOOST_CHECK_CLOSE(lame.mu, 1., round_off);
  // In plane stress 2 lambda mu/(lambda + 2 mu) = 3/3.5.
  BOOST_CHECK_CLOSE(lame.in_plane(PlaneState::plane_stress).lambda,
                    6. / 7.,
                    round_off);
}

// Von Mises' stress is |s| for one principal stress s, sqrt(3) tau for pure
// shear, 0 for a pressure.
BOOST_AUTO_TEST_CASE(von_mises_of_linear_bodies)
{
  const double        young = 2.6, nu = .3, shear = 1.;
  const LinearElastic lame = LinearElastic::from_young(young, nu);
  for (const double e : {1e-3, -2e-3})
    {
      const double      size = std::abs(e);
      const Material<3> solid(lame);
      BOOST_CHECK_CLOSE(solid.von_mises(diagonal<3>({{-nu * e, e, -nu * e}})),
                        young * size,
                        round_off);
      Tensor<2, 3> slide;
      slide[0][2] = e;
      BOOST_CHECK_CLOSE(solid.von_mises(slide),
                        std::sqrt(3.) * shear * size,
                        round_off);
      BOOST_CHECK_SMALL(solid.von_mises(diagonal<3>({{e, e, e}})), 1e-17);
      // One strain e: stresses (lambda + 2 mu) e, lambda e, lambda e.
      BOOST_CHECK_CLOSE(solid.von_mises(diagonal<3>({{e, 0., 0.}})),
                        2. * shear * size,
                        round_off);

      const Material<2> sheet(lame.in_plane(PlaneState::plane_stress),
                              {},
                              PlaneState::plane_stress);
      const Material<2> section(lame, {}, PlaneState::plane_strain);
      Tensor<2, 2>      flat_slide;
      flat_slide[0][1] = e;
      for (const Material<2> &material : {sheet, section})
        BOOST_CHECK_CLOSE(material.von_mises(flat_slide),
                          std::sqrt(3.) * shear * size,
                          round_off);
      BOOST_CHECK_CLOSE(sheet.von_mises(diagonal<2>({{e, -nu * e}})),
                        young * size,
                        round_off);
      // Two equal stresses E/(1 - nu) e and none across the sheet.
      BOOST_CHECK_CLOSE(sheet.von_mises(diagonal<2>({{e, e}})),
                        young / (1. - nu) * size,
                        round_off);
      // The section of a long body pulled in x, free in y: e_y = -nu/(1 - nu) e,
      // s = E/(1 - nu^2) e, and nu s across the section, which gives s sqrt(1 -
      // nu + nu^2).
      BOOST_CHECK_CLOSE(
        section.von_mises(diagonal<2>({{e, -nu / (1. - nu) * e}})),
        young / (1. - nu * nu) * size * std::sqrt(1. - nu + nu * nu),
        round_off);
      // A bar.
      BOOST_CHECK_CLOSE(Material<1>(LinearElastic{0., .5 * young})
                          .von_mises(diagonal<1>({{e}})),
                        young * size,
                        round_off);
    }
}

BOOST_AUTO_TEST_CASE(stretched_hyperelastic_bodies)
{
  check_stretches(saint_venant_kirchhoff, stress_of_saint_venant_kirchhoff);
  check_stretches(neo_hookean, stress_of_neo_hookean);
  check_stretches(ciarlet_geymonat, stress_of_ciarlet_geymonat);
}

// One axis stretched by l: E_1 = (l^2 - 1)/2, J = l, I1 = l^2 + 2, I2 = 2 l^2 +
// 1, I3 = l^2.
BOOST_AUTO_TEST_CASE(energy_of_a_stretch)
{
  for (const double l : {1.4, .75})
    {
      const double e = .5 * (l * l - 1.), log = std::log(l);
      const double of_saint_venant_kirchhoff = (.5 * lambda + mu) * e * e;
      const double of_neo_hookean = mu * e - mu * log + .5 * lambda * log * log;
      const double of_ciarlet_geymonat =
        2. * e * (c1 + 2. * c2 + d) - 2. * c_log * log;
      const auto f    = diagonal<3>({{l, 1., 1.}});
      const auto flat = diagonal<2>({{l, 1.}});
      BOOST_CHECK_CLOSE(energy(*hyperelastic<3>(saint_venant_kirchhoff), f),
                        of_saint_venant_kirchhoff,
                        round_off);
      BOOST_CHECK_CLOSE(energy(*hyperelastic<2>(saint_venant_kirchhoff), flat),
                        of_saint_venant_kirchhoff,
                        round_off);
      BOOST_CHECK_CLOSE(energy(*hyperelastic<3>(neo_hookean), f),
                        of_neo_hookean,
                        round_off);
      BOOST_CHECK_CLOSE(energy(*hyperelastic<2>(neo_hookean), flat),
                        of_neo_hookean,
                        round_off);
      BOOST_CHECK_CLOSE(energy(*hyperelastic<3>(ciarlet_geymonat), f),
                        of_ciarlet_geymonat,
                        round_off);
      BOOST_CHECK_CLOSE(energy(*hyperelastic<2>(ciarlet_geymonat), flat),
                        of_ciarlet_geymonat,
                        round_off);
    }
}

// x = X + k Y, J = 1. With b = F F^T = (1 + k^2, k; k, 1), neo-Hookean bodies
// have mu (b - 1); those of Ciarlet and Geymonat 2 ((c1 + c2 I1) b - c2 b^2 - c1
// - 2 c2), where I1 = 3 + k^2. Saint Venant-Kirchhoff: E = (0, k/2; k/2, k^2/2),
// S = lambda k^2/2 + 2 mu E, pushed forward by hand.
BOOST_AUTO_TEST_CASE(simple_shear)
{
  for (const double k : {.3, -.8})
    {
      const double                k2 = k * k;
      const std::array<double, 3> neo{{mu * k2, 0., mu * k}};
      const double                c = 2. * (c1 + c2);
      const std::array<double, 3> ciarlet{{c * k2, 0., c * k}};
      const double s11 = .5 * lambda * k2, s12 = mu * k, s22 = s11 + mu * k2;
      const std::array<double, 3> saint_venant{
        {s11 + 2. * k * s12 + k2 * s22, s22, s12 + k * s22}};

      Tensor<2, 3> f    = diagonal<3>({{1., 1., 1.}});
      Tensor<2, 2> flat = diagonal<2>({{1., 1.}});
      f[0][1] = flat[0][1] = k;
      const auto check     = [&](const auto                  &law,
                             const std::array<double, 3> &expected,
                             const double                 out_of_plane,
                             const double                 expected_energy) {
        const auto stress      = hyperelastic<3>(law)->cauchy_stress(f);
        const auto flat_stress = hyperelastic<2>(law)->cauchy_stress(flat);
        BOOST_CHECK_SMALL(stress[0][0] - expected[0], 1e-13);
        BOOST_CHECK_SMALL(stress[1][1] - expected[1], 1e-13);
        BOOST_CHECK_SMALL(stress[0][1] - expected[2], 1e-13);
        BOOST_CHECK_SMALL(stress[2][2] - out_of_plane, 1e-13);
        BOOST_CHECK_SMALL(flat_stress[0][0] - expected[0], 1e-13);
        BOOST_CHECK_SMALL(flat_stress[1][1] - expected[1], 1e-13);
        BOOST_CHECK_SMALL(flat_stress[0][1] - expected[2], 1e-13);
        BOOST_CHECK_CLOSE(energy(*hyperelastic<3>(law), f),
                          expected_energy,
                          round_off);
        BOOST_CHECK_CLOSE(energy(*hyperelastic<2>(law), flat),
                          expected_energy,
                          round_off);
      };
      check(neo_hookean, neo, 0., .5 * mu * k2);
      check(ciarlet_geymonat, ciarlet, 2. * c2 * k2, (c1 + c2) * k2);
      check(saint_venant_kirchhoff,
            saint_venant,
            s11,
            lambda / 8. * k2 * k2 + mu * (.5 * k2 + .25 * k2 * k2));
    }
}

// The thickness, from dW/dC33 = 0:
//   Saint Venant-Kirchhoff: E3 = -lambda/(lambda + 2 mu) (E1 + E2);
//   neo-Hookean: mu (l3^2 - 1) + lambda ln J = 0, solved for l2;
//   Ciarlet-Geymonat: l3^2 (c1 + c2 (l1^2 + l2^2) + d l1^2 l2^2) = c1 + 2 c2 + d.
BOOST_AUTO_TEST_CASE(thickness_of_sheets)
{
  const double l1 = 1.2, l2 = .95;
  const double e3 =
    -lambda / (lambda + 2. * mu) * .5 * (l1 * l1 + l2 * l2 - 2.);
  check_sheet(saint_venant_kirchhoff,
              stress_of_saint_venant_kirchhoff,
              l1,
              l2,
              std::sqrt(1. + 2. * e3));
  const double l3 = .9;
  check_sheet(neo_hookean,
              stress_of_neo_hookean,
              l1,
              std::exp(mu / lambda * (1. - l3 * l3)) / (l1 * l3),
              l3);
  check_sheet(ciarlet_geymonat,
              stress_of_ciarlet_geymonat,
              1.3,
              1.1,
              // 1.07/(.5 + .11 * 2.9 + .35 * 2.0449)
              std::sqrt(1.07 / 1.534715));
}

// The material has the values of its parameters: uniaxial stretches of each
// law, and the viscosities by their stresses. E = 2.6 and nu = 0.3 are lambda =
// 3/2 and mu = 1.
BOOST_AUTO_TEST_CASE(materials_by_their_parameters)
{
  MaterialParameters parameters;
  parameters.plane_state             = "plane strain";
  parameters.values["Young modulus"] = 2.6;
  parameters.values["Poisson ratio"] = .3;
  parameters.values["c1"]            = c1;
  parameters.values["c2"]            = c2;
  parameters.values["d"]             = d;
  const double l                     = 1.4;
  const auto   gradient              = diagonal<3>({{l - 1., 0., 0.}});
  const auto   stress                = [&](const std::string &law) {
    parameters.law = law;
    return parameters.make<3>().cauchy_stress(gradient)[0][0];
  };
  BOOST_CHECK_CLOSE(stress("linear elastic"), 3.5 * (l - 1.), round_off);
  BOOST_CHECK_CLOSE(stress("Saint Venant-Kirchhoff"),
                    l * 3.5 * .5 * (l * l - 1.),
                    round_off);
  BOOST_CHECK_CLOSE(stress("neo-Hookean"),
                    (l * l - 1. + 1.5 * std::log(l)) / l,
                    round_off);
  BOOST_CHECK_CLOSE(stress("Ciarlet-Geymonat"),
                    stress_of_ciarlet_geymonat(Tensor<1, 3>({l, 1., 1.}))[0],
                    round_off);
  parameters.viscosity     = "Pioletti";
  parameters.viscosity_eta = 5.;
  BOOST_CHECK(parameters.make<3>().viscosity.law == Viscosity::Law::pioletti);
  BOOST_CHECK_EQUAL(parameters.make<3>().viscosity.eta, 5.);
  parameters.viscosity = "Curnier";
  BOOST_CHECK(parameters.make<3>().viscosity.law == Viscosity::Law::curnier);
  parameters.law       = "linear elastic";
  parameters.viscosity = "linear";
  BOOST_CHECK(parameters.make<2>().viscosity.law == Viscosity::Law::linear);

  // A strip between walls: E/(1 - nu^2) as a sheet, lambda + 2 mu as a section,
  // and in it lambda across the plane, which is 2 mu e for von Mises.
  const auto flat = diagonal<2>({{.01, 0.}});
  BOOST_CHECK_CLOSE(parameters.make<2>().cauchy_stress(flat)[0][0],
                    3.5 * .01,
                    round_off);
  BOOST_CHECK_CLOSE(parameters.make<2>().von_mises(flat), 2. * .01, round_off);
  parameters.plane_state = "plane stress";
  const double s         = 2.6 / .91 * .01;
  BOOST_CHECK_CLOSE(parameters.make<2>().cauchy_stress(flat)[0][0],
                    s,
                    round_off);
  BOOST_CHECK_CLOSE(parameters.make<2>().von_mises(flat),
                    s * std::sqrt(1. - .3 + .09),
                    round_off);
}

// Curnier: W_v = eta/2 tr(Cdot^2), so S = 2 dW_v/dCdot = 2 eta Cdot. Pioletti:
// W_v = eta/4 tr(Cdot^2) (tr C - 3), so S = eta (tr C - 3) Cdot. Here eta = 5 Pa
// s, Cdot = difference/0.5 s, and in the middle of the step C = (1.3, .05; .05,
// 1.1).
BOOST_AUTO_TEST_CASE(viscous_stress_at_a_known_rate)
{
  SymmetricTensor<2, 2> c, difference;
  c[0][0]            = 1.3;
  c[0][1]            = .05;
  c[1][1]            = 1.1;
  difference[0][0]   = .2;
  difference[0][1]   = .1;
  const auto section = hyperelastic<2>(neo_hookean);
  // C33 = 1 - lambda/(lambda + 2 mu) (tr C - 2), with a factor of 1/2 here.
  const auto sheet =
    hyperelastic<2>(SaintVenantKirchhoff{2., 1.}, PlaneState::plane_stress);
  const Viscosity curnier{Viscosity::Law::curnier, 5.},
    pioletti{Viscosity::Law::pioletti, 5.};

  // A step, with C in its middle.
  SymmetricTensor<4, 2>     tangent;
  ViscousTangent<2, double> parts;
  const auto                stress_in = [&](const Hyperelastic<2> &body,
                             const Viscosity       &viscosity) {
    const auto result =
      viscous_stress<2>(body, viscosity, c, difference, .5, &parts);
    tangent = parts.with_change + .5 * parts.with_c;
    return result;
  };
  auto stress = stress_in(*section, curnier);
  BOOST_CHECK_CLOSE(stress[0][0], 4., round_off);
  BOOST_CHECK_CLOSE(stress[0][1], 2., round_off);
  BOOST_CHECK_SMALL(stress[1][1], 1e-14);
  BOOST_CHECK_CLOSE(tangent[0][0][0][0], 20., round_off);
  BOOST_CHECK_CLOSE(tangent[0][1][0][1], 10., round_off);
  BOOST_CHECK_SMALL(tangent[0][0][1][1], 1e-14);

  // Plane strain: tr C = 1.3 + 1.1 + 1, the factor is 0.4 and S = 4 difference.
  stress = stress_in(*section, pioletti);
  BOOST_CHECK_CLOSE(stress[0][0], .8, round_off);
  BOOST_CHECK_CLOSE(stress[0][1], .4, round_off);
  BOOST_CHECK_SMALL(stress[1][1], 1e-14);
  // dS = eta/dt ((tr C - 3) dC + difference tr(dC)/2)
  BOOST_CHECK_CLOSE(tangent[0][0][0][0], 10. * (.4 + .2 / 2.), round_off);
  BOOST_CHECK_CLOSE(tangent[0][0][1][1], 10. * .2 / 2., round_off);
  BOOST_CHECK_CLOSE(tangent[0][1][0][0], 10. * .1 / 2., round_off);
  BOOST_CHECK_CLOSE(tangent[0][1][0][1], 10. * .4 / 2., round_off);
  BOOST_CHECK_CLOSE(tangent[1][1][1][1], 10. * .4, round_off);

  // Plane stress: C33 = 0.8, the factor is 0.2 and S = 2 difference; tr C grows
  // by half of the in-plane trace.
  stress = stress_in(*sheet, pioletti);
  BOOST_CHECK_CLOSE(stress[0][0], .4, round_off);
  BOOST_CHECK_CLOSE(stress[0][1], .2, round_off);
  BOOST_CHECK_CLOSE(tangent[0][0][0][0], 10. * (.2 + .2 / 4.), round_off);
  BOOST_CHECK_CLOSE(tangent[0][0][1][1], 10. * .2 / 4., round_off);

  // In 3D, C = 1.2 in the middle on all axes: the factor is 0.6.
  const auto identity = dealii::unit_symmetric_tensor<3>();
  const auto solid    = viscous_stress<3>(*hyperelastic<3>(neo_hookean),
                                       pioletti,
                                       1.2 * identity,
                                       .1 * identity,
                                       .5);
  BOOST_CHECK_CLOSE(solid[2][2], 10. * .6 * .1, round_off);
}


// ### Bodies of one element, or in uniform strain

// A rectangle 2 m x 0.5 m is stretched from 1.2 to 1.4 times its length in 0.25 s
// with eta = 3 Pa s. P11 = F11 S11 with F11 = 1.3 in the middle, C11 grows by
// 1.96 - 1.44 = 0.52, and tr C = 1.7 + 1 + 1. The elastic part does the work of
// the energies: P11 = (W(1.4) - W(1.2))/0.2.
BOOST_AUTO_TEST_CASE(one_element_at_a_known_rate)
{
  const double   height = .5, volume = 1., time_step = .25, eta = 3.;
  const Block<2> block({1., 2.}, {3., 2.5}, {1, 1});
  const auto     body      = block.body({2});
  const auto     stretched = [&](const double factor) {
    return interpolated<2>(body,
                           {[factor](const Point<2> &x) {
                              return (factor - 1.) * x[0] + 7.;
                            },
                            [](const Point<2> &) { return -3.; }});
  };
  const Vector old_solution = stretched(1.2), solution = stretched(1.4);
  Vector       force = body.make_vector();
  const auto   w     = [](const double l) {
    return mu * (.5 * (l * l - 1.) - std::log(l)) +
      .5 * lambda * std::log(l) * std::log(l);
  };
  const auto material = hyperelastic<2>(neo_hookean);

  const double elastic = height * (w(1.4) - w(1.2)) / .2;
  for (const auto &[law, viscous, dissipation] :
       {std::tuple<Viscosity::Law, double, double>(Viscosity::Law::none,
                                                   0.,
                                                   0.),
        {Viscosity::Law::curnier,
         height * 1.3 * 2. * eta * .52 / time_step,
         volume * eta * .52 * .52 / time_step},
        {Viscosity::Law::pioletti,
         height * 1.3 * eta * .7 * .52 / time_step,
         volume * .5 * eta * .7 * .52 * .52 / time_step}})
    {
      const HyperelasticBulk<2> bulk(body,
                                     Material<2>(material,
                                                 Viscosity{law, eta}));
      bulk.step_force(old_solution, solution, time_step, force);
      BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 1),
                        elastic + viscous,
                        round_off);
      BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 0),
                        -elastic - viscous,
                        round_off);
      BOOST_CHECK_SMALL(bulk.viscous_dissipation(old_solution,
                                                 solution,
                                                 time_step) -
                          dissipation,
                        1e-13);
      // At an instant: P11 = dW/dl.
      bulk.force(solution, force);
      BOOST_CHECK_CLOSE(
        boundary_sum(body, force, 0, 1),
        height * (mu * (1.4 - 1. / 1.4) + lambda * std::log(1.4) / 1.4),
        round_off);
      BOOST_CHECK_CLOSE(bulk.energy(solution), volume * w(1.4), round_off);
    }
}

// Small strains: stress (lambda + 2 mu) e and eta edot, at the mean of strains 1
// and 3 per cent; the energy of the second one, and the viscous dissipation.
BOOST_AUTO_TEST_CASE(linear_body_at_a_known_rate)
{
  const double   height = .5, volume = 1., time_step = .25, eta = 3.;
  const Block<2> block({1., 2.}, {3., 2.5}, {3, 2});
  const auto     body     = block.body({2});
  const auto     strained = [&](const double strain, const double lateral) {
    return interpolated<2>(body,
                           {[=](const Point<2> &x) {
                              return strain * x[0] + 7.;
                            },
                            [=](const Point<2> &x) { return lateral * x[1]; }});
  };
  const Vector old_solution = strained(.01, 0.), solution = strained(.03, 0.);
  Vector       force   = body.make_vector();
  const double modulus = lambda + 2. * mu;

  const LinearBulk<2> bulk(body,
                           LinearElastic{lambda, mu},
                           {Viscosity::Law::linear, eta});
  bulk.step_force(old_solution, solution, time_step, force);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 1),
                    height * (modulus * .02 + eta * .02 / time_step),
                    round_off);
  // Across the strain there is lambda e, and no viscous stress; 2 m are long.
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 1, 3),
                    2. * lambda * .02,
                    round_off);
  BOOST_CHECK_CLOSE(bulk.viscous_dissipation(old_solution, solution, time_step),
                    volume * eta * .02 * .02 / time_step,
                    round_off);
  BOOST_CHECK_CLOSE(bulk.energy(solution),
                    .5 * volume * modulus * .03 * .03,
                    round_off);
  bulk.force(solution, force);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 1),
                    height * modulus * .03,
                    round_off);

  // Shear by 4 per cent: eta tr(edot^2) with edot_12 = .02/dt in both places.
  const Vector zero = body.make_vector();
  const Vector slide =
    interpolated<2>(body,
                    {[](const Point<2> &x) { return .04 * x[1]; },
                     [](const Point<2> &) { return 0.; }});
  BOOST_CHECK_CLOSE(bulk.energy(slide),
                    .5 * volume * mu * .04 * .04,
                    round_off);
  BOOST_CHECK_CLOSE(bulk.viscous_dissipation(zero, slide, time_step),
                    volume * eta * 2. * .02 * .02 / time_step,
                    round_off);

  // A sheet pulled in one direction stores E/2 e^2.
  const double        young = 2.6, nu = .3;
  const LinearBulk<2> sheet(body,
                            LinearElastic::from_young(young, nu).in_plane(
                              PlaneState::plane_stress));
  const Vector        pulled = strained(.03, -nu * .03);
  BOOST_CHECK_CLOSE(sheet.energy(pulled),
                    .5 * volume * young * .03 * .03,
                    round_off);
  sheet.force(pulled, force);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 1),
                    height * young * .03,
                    round_off);
  BOOST_CHECK_SMALL(boundary_sum(body, force, 1, 3), 1e-14);
}

// The matrices of one linear element of length 2 m: modulus/length (1, -1; -1, 1)
// and density length/6 (2, 1; 1, 2).
BOOST_AUTO_TEST_CASE(matrices_of_one_element)
{
  const Block<1>      block(Point<1>(1.), Point<1>(3.), {1});
  const auto          body = block.body({1});
  const BodyMatrix    mass = assemble_mass_matrix(body, 9.);
  const LinearBulk<1> bulk(body, LinearElastic{1., 2.});
  const Vector        unit =
    interpolated<1>(body, {[](const Point<1> &x) { return .5 * (x[0] - 1.); }});
  Vector product = body.make_vector();
  mass.vmult(product, unit);
  BOOST_CHECK_CLOSE(boundary_sum(body, product, 0, 1), 6., round_off);
  BOOST_CHECK_CLOSE(boundary_sum(body, product, 0, 0), 3., round_off);
  bulk.force(unit, product);
  BOOST_CHECK_CLOSE(boundary_sum(body, product, 0, 1), 2.5, round_off);
  BOOST_CHECK_CLOSE(boundary_sum(body, product, 0, 0), -2.5, round_off);
  BOOST_CHECK_CLOSE(bulk.energy(unit), 1.25, round_off);
}


// ### Mass and momenta

// The rectangle 1 < x < 4, 2 < y < 4 of density 3: mass 18, centre (2.5, 3),
// moment of inertia about the origin 18 (2.5^2 + 3^2) + 18/12 (3^2 + 2^2) = 294.
// It moves with (0.7, -0.3) and turns about the origin with omega = 2:
//   p = 18 (0.7 - 2 3, -0.3 + 2 2.5),
//   L = 18 (2.5 (-0.3) - 3 0.7) + 2 294,
//   T = (18 (0.7^2 + 0.3^2) + 2 2 18 (-0.3 2.5 - 0.7 3) + 2^2 294)/2.
BOOST_AUTO_TEST_CASE(momenta_of_a_rectangle)
{
  const Block<2>   block({1., 2.}, {4., 4.}, {3, 2});
  ImpactParameters parameters;
  parameters.contact.treatment = "penalty";
  Impact<2> impact(
    parameters,
    block.mesh,
    ImpactSetup<2>{Material<2>(LinearElastic{1., 1.}),
                   3.,
                   1,
                   {},
                   plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.}))},
    MPI_COMM_WORLD);
  const Vector velocity =
    interpolated<2>(impact.body,
                    {[](const Point<2> &x) { return .7 - 2. * x[1]; },
                     [](const Point<2> &x) { return -.3 + 2. * x[0]; }});
  BOOST_CHECK_CLOSE(impact.system.kinetic_energy(velocity), 490.62, round_off);
  const Vector moved = impact.uniform(Tensor<1, 2>({.5, -1.}));
  for (const bool small_strains : {true, false})
    {
      const Momenta<2> momenta(impact.body,
                               impact.system.mass_matrix(),
                               small_strains);
      BOOST_CHECK_CLOSE(momenta.linear(velocity)[0], -95.4, round_off);
      BOOST_CHECK_CLOSE(momenta.linear(velocity)[1], 84.6, round_off);
      const Vector zero = impact.body.make_vector();
      BOOST_CHECK_CLOSE(momenta.angular(zero, velocity)[2], 536.7, round_off);
      // Moved by u, the body has u x p more, which small strains do not see.
      BOOST_CHECK_CLOSE(momenta.angular(moved, velocity)[2],
                        small_strains ? 536.7 : 536.7 + .5 * 84.6 - 95.4,
                        round_off);
    }
}

// The box 1 x 2 x 1 m at z > 1 of density 2 turns about the x axis with omega =
// 1.5: v = omega (0, -z, y). Means: x 1/2, y 1, z 3/2, y^2 4/3, z^2 7/3, and the
// mass is 4.
BOOST_AUTO_TEST_CASE(momenta_of_a_box)
{
  const Block<3>   block({0., 0., 1.}, {1., 2., 2.}, {1, 2, 1});
  const auto       body = block.body({4});
  const BodyMatrix mass = assemble_mass_matrix(body, 2.);
  const Vector     velocity =
    interpolated<3>(body,
                    {[](const Point<3> &) { return 0.; },
                     [](const Point<3> &x) { return -1.5 * x[2]; },
                     [](const Point<3> &x) { return 1.5 * x[1]; }});
  const Momenta<3>   momenta(body, mass, true);
  const Tensor<1, 3> p = momenta.linear(velocity),
                     l = momenta.angular(body.make_vector(), velocity);
  BOOST_CHECK_SMALL((p - Tensor<1, 3>({0., -9., 6.})).norm(), 1e-12);
  BOOST_CHECK_SMALL((l - Tensor<1, 3>({22., -3., -4.5})).norm(), 1e-12);
}


BOOST_AUTO_TEST_CASE(rotation_of_a_box)
{
  // A box that is stretched along its own axes and then turned, and moved: exactly the
  // rotation that was given, however large.
  const Block<3>        block({0., 0., 1.}, {1., 2., 2.}, {1, 2, 1});
  const auto            body = block.body({4});
  const BodyMatrix      mass = assemble_mass_matrix(body, 2.);
  const MeanRotation<3> rotation(body, mass, 1, 0, 1);
  Tensor<1, 3>          axis({2., -1., 2.});
  axis /= axis.norm();
  for (const double angle : {0., 1e-9, .3, 2., 3.1415926, dealii::numbers::PI})
    {
      const Tensor<2, 3> turn =
        dealii::Physics::Transformations::Rotations::rotation_matrix_3d(
          Point<3>(axis),
          angle);
      std::vector<std::function<double(const Point<3> &)>> displacement;
      for (unsigned int c = 0; c < 3; ++c)
        displacement.emplace_back([=](const Point<3> &x) {
          const Tensor<1, 3> stretched({1.3 * x[0], .8 * x[1], x[2]});
          return (turn * stretched)[c] - x[c] + 5.;
        });
      const Tensor<1, 3> found =
        rotation.vector(interpolated<3>(body, displacement));
      // At half a turn both directions of the axis are right.
      const double sign = found * axis < 0. ? -1. : 1.;
      BOOST_CHECK_SMALL((sign * found - angle * axis).norm(), 1e-7);
      if (angle < 3.)
        BOOST_CHECK_SMALL((found - angle * axis).norm(), 1e-12);
    }
  // An inverted body has none.
  BOOST_CHECK_EQUAL(
    rotation
      .vector(interpolated<3>(body,
                              {[](const Point<3> &x) { return -2. * x[0]; },
                               [](const Point<3> &) { return 0.; },
                               [](const Point<3> &) { return 0.; }}))
      .norm(),
    0.);

  const Block<2>        plate({0., 0.}, {2., 1.}, {2, 1});
  const auto            flat      = plate.body({3});
  const BodyMatrix      flat_mass = assemble_mass_matrix(flat, 3.);
  const MeanRotation<2> flat_rotation(flat, flat_mass, 1, 0, 1);
  for (const double angle : {-3., -.5, 0., 1.})
    BOOST_CHECK_SMALL(flat_rotation.vector(
                        interpolated<2>(flat,
                                        {[=](const Point<2> &x) {
                                           return std::cos(angle) * x[0] -
                                             std::sin(angle) * x[1] - x[0];
                                         },
                                         [=](const Point<2> &x) {
                                           return std::sin(angle) * x[0] +
                                             std::cos(angle) * x[1] - x[1];
                                         }}))[2] -
                        angle,
                      1e-13);
}


// ### Contact in a point

BOOST_AUTO_TEST_CASE(normal_compliance_at_a_penetration)
{
  // c/2 d^alpha with c = 6, alpha = 3: 3 d^3, 9 d^2, 18 d.
  const CompliancePotential compliance{6., 3.};
  BOOST_CHECK_CLOSE(compliance.value(.5), .375, round_off);
  BOOST_CHECK_CLOSE(compliance.derivative(.5), 2.25, round_off);
  BOOST_CHECK_CLOSE(compliance.second_derivative(.5), 9., round_off);
  BOOST_CHECK_EQUAL(compliance.value(-.5), 0.);
  BOOST_CHECK_EQUAL(compliance.derivative(-.5), 0.);
  // (3 - 0.375)/0.5, and from outside (3 - 0)/1.5.
  BOOST_CHECK_CLOSE(compliance.discrete_derivative(.5, 1.), 5.25, round_off);
  BOOST_CHECK_CLOSE(compliance.discrete_derivative(-.5, 1.), 2., round_off);
  BOOST_CHECK_CLOSE(compliance.discrete_derivative(1., -.5), 2., round_off);

  const ContactPointState<>      closed{-.5, 0., 0.}, open{.1, 0., 0.};
  const StandardNormalCompliance standard{compliance};
  BOOST_CHECK_CLOSE(standard.force<double>(closed, open, 1.).gap,
                    -2.25,
                    round_off);
  BOOST_CHECK_CLOSE(standard.pressure(closed, 1.), 2.25, round_off);
  BOOST_CHECK_CLOSE(standard.potential(closed, 1.), .375, round_off);
  // At the mean penetration 0.2, and over the step: 0.375/0.6.
  BOOST_CHECK_CLOSE(
    MidpointNormalCompliance{{compliance}}.force<double>(closed, open, 1.).gap,
    -.36,
    round_off);
  BOOST_CHECK_CLOSE(
    ImprovedNormalCompliance{{compliance}}.force<double>(closed, open, 1.).gap,
    -.625,
    round_off);
}

BOOST_AUTO_TEST_CASE(laws_of_paper_c_in_a_point)
{
  const double h = .5;
  // epsilon = 0.1 h: a penetration of 0.02 m makes 0.4 Pa and 0.004 J/m^2.
  const Penalty             penalty{.1};
  const ContactPointState<> pressed{-.02, 0., 0.};
  BOOST_CHECK_CLOSE(penalty.force<double>(pressed, pressed, h).gap,
                    -.4,
                    round_off);
  BOOST_CHECK_CLOSE(penalty.pressure(pressed, h), .4, round_off);
  BOOST_CHECK_CLOSE(penalty.potential(pressed, h), .004, round_off);

  // gamma = 2/h = 4. Closed: p = 1 and g = -1/2, q = 3. Open: g = 1/2, q = -1.
  const ContactPointState<> closed{-.5, 1., 1.}, open{.5, 1., 1.};
  for (const double theta : {1., 0., -1.})
    {
      const Nitsche law{2., theta};
      auto          force = law.force<double>(closed, closed, h);
      BOOST_CHECK_CLOSE(force.gap, -3., round_off);
      BOOST_CHECK_SMALL(force.stress_pressure - theta * .5, 1e-14);
      BOOST_CHECK_CLOSE(law.pressure(closed, h), 3., round_off);
      force = law.force<double>(open, open, h);
      BOOST_CHECK_EQUAL(force.gap, 0.);
      BOOST_CHECK_SMALL(force.stress_pressure + theta * .25, 1e-14);
      // (q^2 - p^2)/(2 gamma)
      BOOST_CHECK_SMALL(law.potential(closed, h) - (theta == 1. ? 1. : 0.),
                        1e-14);
      BOOST_CHECK_SMALL(law.potential(open, h) + (theta == 1. ? .125 : 0.),
                        1e-14);
    }
  const ProximalAugmentedLagrangian lagrangian{2.};
  BOOST_CHECK_CLOSE(lagrangian.force<double>(closed, closed, h).gap,
                    -3.,
                    round_off);
  BOOST_CHECK_CLOSE(lagrangian.force<double>(closed, closed, h).multiplier,
                    .5,
                    round_off);
  BOOST_CHECK_CLOSE(lagrangian.potential(closed, h), 1., round_off);

  // From open to closed the hybrid takes the mean of 0 and 3, back q_mid = 1;
  // the end takes 3 and 0.
  const NitscheTwoPoint hybrid{2., 1., NitscheTwoPoint::Evaluation::hybrid},
    end{2., 1., NitscheTwoPoint::Evaluation::end_of_step};
  BOOST_CHECK_CLOSE(hybrid.force<double>(closed, open, h).gap, -1.5, round_off);
  BOOST_CHECK_CLOSE(hybrid.force<double>(open, closed, h).gap, -1., round_off);
  BOOST_CHECK_CLOSE(end.force<double>(closed, open, h).gap, -3., round_off);
  BOOST_CHECK_EQUAL(end.force<double>(open, closed, h).gap, 0.);

  // r = 4: a multiplier of 2 Pa presses at the gap 0.1, [2 - 0.4]_+ - 2 = -0.4;
  // one of 0.2 Pa does not, and shall vanish.
  const SignoriniMultiplier signorini{2.};
  BOOST_CHECK_CLOSE(signorini.force<double>({.1, 0., 2.}, {}, h).multiplier,
                    -.1,
                    round_off);
  BOOST_CHECK_CLOSE(signorini.force<double>({.1, 0., .2}, {}, h).multiplier,
                    -.05,
                    round_off);
  BOOST_CHECK_CLOSE(signorini.force<double>({.1, 0., 2.}, {}, h).gap,
                    -2.,
                    round_off);
}

// mu = 0.3 under 4 Pa carries 1.2 Pa; c_tau = 2 Pa s/m sticks up to 0.6 m/s.
BOOST_AUTO_TEST_CASE(coulomb_friction_at_a_slip_rate)
{
  const RegularisedFriction friction(
    std::make_shared<FrictionLawImplementation<CoulombFriction>>(
      CoulombFriction{.3}),
    2.);
  for (const double speed : {.5, 1.})
    {
      const Tensor<1, 3> rate({.6 * speed, 0., -.8 * speed});
      const Tensor<1, 3> expected =
        (speed < .6 ? 1. : 1.2) * Tensor<1, 3>({.6, 0., -.8});
      BOOST_CHECK_SMALL(
        (friction.traction(friction.creep(), 4., rate) - expected).norm(),
        1e-14);
      const auto branch =
        friction.choose_branch(friction.creep(), 4., rate, 2. * rate);
      BOOST_CHECK_EQUAL(branch.sticks, speed < .6);
      BOOST_CHECK_SMALL(
        (friction.traction_on(branch, 4., rate) - expected).norm(),
        1e-14);
    }
}


// ### Contact of a body

// A block on 0 < x < 2, its lower side at y = 1/4, above y = 0, lowered and
// tilted: the gap is -0.1 + 0.16 x. Its five nodes there have the lumped lengths
// 1/4, 1/2, 1/2, 1/2, 1/4, and those at x = 0 and 1/2 penetrate by 0.1 and 0.02.
BOOST_AUTO_TEST_CASE(summary_of_a_tilted_block_in_nodes)
{
  const Block<2> block({0., .25}, {2., 1.25}, {4, 2});
  const auto     body       = block.body({2});
  const auto     foundation = plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.}));
  ContactParameters parameters;
  parameters.treatment                        = "standard normal compliance";
  parameters.values["Compliance coefficient"] = 80.;
  const auto   contact                        = make_contact(parameters,
                                    scheme_traits("midpoint"),
                                    body,
                                    LinearElastic{1., 1.},
                                    foundation);
  const Vector solution =
    interpolated<2>(body,
                    {[](const Point<2> &) { return 0.; },
                     [](const Point<2> &x) { return -.35 + .16 * x[0]; }});
  Vector force = body.make_vector();
  contact->force_at(solution, 0., force);
  // Pressures 8 and 1.6 Pa: 8/4 + 1.6/2 N, against the displacement of the
  // body.
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 1, 2), -2.8, round_off);
  BOOST_CHECK_SMALL(boundary_sum(body, force, 0, 2), 1e-14);
  auto summary = contact->summary({solution, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.area, 2., round_off);
  BOOST_CHECK_CLOSE(summary.mean_gap, .06, round_off);
  BOOST_CHECK_CLOSE(summary.smallest_gap, -.1, round_off);
  BOOST_CHECK_CLOSE(summary.max_penetration, .1, round_off);
  BOOST_CHECK_CLOSE(summary.force, 2.8, round_off);
  BOOST_CHECK_CLOSE(summary.contact_pressure, 1.4, round_off);
  BOOST_CHECK_EQUAL(summary.active_points, 2u);
  // c/2 d^2: 0.4/4 + 0.016/2 J.
  BOOST_CHECK_CLOSE(contact->potential(solution, 0.), .108, round_off);

  // An active set reads the same force off the vector.
  parameters.treatment  = "Signorini active set";
  const auto active_set = make_contact(parameters,
                                       scheme_traits("midpoint"),
                                       body,
                                       LinearElastic{1., 1.},
                                       foundation);
  summary               = active_set->summary({solution, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.mean_gap, .06, round_off);
  BOOST_CHECK_CLOSE(summary.smallest_gap, -.1, round_off);
  BOOST_CHECK_CLOSE(summary.max_penetration, .1, round_off);
  BOOST_CHECK_CLOSE(summary.force, 2.8, round_off);
  BOOST_CHECK_CLOSE(summary.contact_pressure, 1.4, round_off);
  BOOST_CHECK_EQUAL(summary.active_points, 2u);

  // With alpha = 3: pressures 120 d^2, energies 40 d^3.
  parameters.treatment                     = "standard normal compliance";
  parameters.values["Compliance exponent"] = 3.;
  const auto cubic                         = make_contact(parameters,
                                  scheme_traits("midpoint"),
                                  body,
                                  LinearElastic{1., 1.},
                                  foundation);
  cubic->force_at(solution, 0., force);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 1, 2),
                    -1.2 / 4. - .048 / 2.,
                    round_off);
  BOOST_CHECK_CLOSE(cubic->potential(solution, 0.),
                    .04 / 4. + .00032 / 2.,
                    round_off);

  // Raised by 1 m nothing touches.
  const Vector raised = interpolated<2>(body,
                                        {[](const Point<2> &) { return 0.; },
                                         [](const Point<2> &) { return 1.; }});
  contact->force_at(raised, 0., force);
  summary = contact->summary({raised, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.mean_gap, 1.25, round_off);
  BOOST_CHECK_CLOSE(summary.smallest_gap, 1.25, round_off);
  BOOST_CHECK_EQUAL(summary.max_penetration, 0.);
  BOOST_CHECK_EQUAL(summary.force, 0.);
  BOOST_CHECK_EQUAL(summary.active_points, 0u);
}

// The same block, wholly in the obstacle: penetration 0.3 - 0.1 x, integrated by
// two Gauss points on each of four faces, with cells of diameter sqrt(1/2).
BOOST_AUTO_TEST_CASE(summary_of_a_tilted_block_by_integration)
{
  const Block<2>    block({0., .25}, {2., 1.25}, {4, 2});
  const auto        body = block.body({2});
  ContactParameters parameters;
  parameters.treatment                  = "penalty";
  parameters.values["Penalty epsilon0"] = .1;
  const auto contact =
    make_contact(parameters,
                 scheme_traits("midpoint"),
                 body,
                 LinearElastic{1., 1.},
                 plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.})));
  const Vector solution =
    interpolated<2>(body,
                    {[](const Point<2> &) { return 0.; },
                     [](const Point<2> &x) { return -.55 + .1 * x[0]; }});
  Vector force = body.make_vector();
  contact->force_at(solution, 0., force);
  const double epsilon = .1 * std::sqrt(.5);
  const auto   summary = contact->summary({solution, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.mean_gap, -.2, round_off);
  // The first Gauss point lies at x = (1 - 1/sqrt(3))/4.
  const double deepest = .3 - .025 * (1. - 1. / std::sqrt(3.));
  BOOST_CHECK_CLOSE(summary.max_penetration, deepest, round_off);
  BOOST_CHECK_CLOSE(summary.smallest_gap, -deepest, round_off);
  BOOST_CHECK_CLOSE(summary.force, .4 / epsilon, round_off);
  BOOST_CHECK_CLOSE(summary.contact_pressure, .2 / epsilon, round_off);
  BOOST_CHECK_EQUAL(summary.active_points, 8u);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 1, 2), -.4 / epsilon, round_off);
  // The integral of penetration^2 is 2 (0.2^2 + 0.1^2 2^2/12).
  BOOST_CHECK_CLOSE(contact->potential(solution, 0.),
                    2. * (.04 + .04 / 12.) / (2. * epsilon),
                    round_off);
}

// Nitsche's method on a block in uniform strain -2 % that is 0.05 m in the
// obstacle: p = (lambda + 2 mu) 0.02 of its own, q = p + gamma 0.05.
BOOST_AUTO_TEST_CASE(nitsche_pressure_of_a_pressed_block)
{
  const Block<2>    block({0., .25}, {2., 1.25}, {4, 2});
  const auto        body = block.body({2});
  ContactParameters parameters;
  parameters.treatment                = "Nitsche";
  parameters.values["Nitsche gamma0"] = 100.;
  const auto contact =
    make_contact(parameters,
                 scheme_traits("Crank-Nicolson"),
                 body,
                 LinearElastic{lambda, mu},
                 plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.})));
  const Vector solution = interpolated<2>(body,
                                          {[](const Point<2> &) { return 0.; },
                                           [](const Point<2> &x) {
                                             return -.3 - .02 * (x[1] - .25);
                                           }});
  Vector       force    = body.make_vector();
  contact->force_at(solution, 0., force);
  const double gamma = 100. / std::sqrt(.5), p = (lambda + 2. * mu) * .02,
               q     = p + gamma * .05;
  const auto summary = contact->summary({solution, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.stress_pressure, p, round_off);
  BOOST_CHECK_CLOSE(summary.contact_pressure, q, round_off);
  BOOST_CHECK_CLOSE(summary.force, 2. * q, round_off);
  BOOST_CHECK_CLOSE(contact->potential(solution, 0.),
                    2. * (q * q - p * p) / (2. * gamma),
                    round_off);
}

// An oblique plane with the normal (0.6, 0.8) through the origin, under the side
// y = 1 of 1 < x < 3, which has moved by (-1, -1.5): the mean gap is 0.6 2 + 0.8 -
// 0.6 - 1.2, the smallest 0.6 less.
BOOST_AUTO_TEST_CASE(gap_to_an_oblique_plane)
{
  const Block<2>    block({1., 1.}, {3., 2.}, {2, 1});
  const auto        body = block.body({2});
  ContactParameters parameters;
  parameters.treatment                        = "improved normal compliance";
  parameters.values["Compliance coefficient"] = 10.;
  const auto contact =
    make_contact(parameters,
                 scheme_traits("midpoint"),
                 body,
                 {},
                 plane<2>(2, Point<2>(), Tensor<1, 2>({.6, .8})));
  const Vector solution =
    interpolated<2>(body,
                    {[](const Point<2> &) { return -1.; },
                     [](const Point<2> &) { return -1.5; }});
  Vector force = body.make_vector();
  contact->force_at(solution, 0., force);
  const auto summary = contact->summary({solution, force, 0.}).at(2);
  BOOST_CHECK_CLOSE(summary.mean_gap, .2, round_off);
  BOOST_CHECK_CLOSE(summary.smallest_gap, -.4, round_off);
  // One corner of length 1/2 under 10 0.4 Pa, pushed along the normal.
  BOOST_CHECK_CLOSE(summary.force, 2., round_off);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 0, 2), -1.2, round_off);
  BOOST_CHECK_CLOSE(boundary_sum(body, force, 1, 2), -1.6, round_off);
}

// Regularised friction under so high a pressure that all sticks: c_tau times the
// slip rate, (1.2 - 1.15) m in 0.1 s, on a length of 2 m. Where it slips, mu times
// the pressure 10 Pa.
BOOST_AUTO_TEST_CASE(traction_of_a_sticking_block)
{
  const Block<2>    block({0., .25}, {2., 1.25}, {4, 2});
  const auto        body = block.body({2});
  ContactParameters parameters;
  parameters.treatment                        = "standard normal compliance";
  parameters.values["Compliance coefficient"] = 100.;
  parameters.values["Friction coefficient"]   = .3;
  for (const double c_tau : {3., 100.})
    {
      parameters.values["Tangential compliance"] = c_tau;
      const auto contact =
        make_contact(parameters,
                     scheme_traits("midpoint"),
                     body,
                     LinearElastic{1., 1.},
                     plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.})));
      const auto at = [&](const double x) {
        return interpolated<2>(body,
                               {[x](const Point<2> &) { return x; },
                                [](const Point<2> &) { return -.35; }});
      };
      const Vector old_solution = at(1.15), solution = at(1.2),
                   zero = body.make_vector();
      Vector residual(zero);
      contact->begin_stage({old_solution, zero, zero, .1}, 1.);
      contact->add_residual(solution, residual);
      BOOST_CHECK_CLOSE(boundary_sum(body, contact->contact_force(), 0, 2),
                        c_tau == 3. ? 2. * 3. * .5 : 2. * .3 * 10.,
                        1e-8);
      BOOST_CHECK_CLOSE(boundary_sum(body, contact->contact_force(), 1, 2),
                        -20.,
                        round_off);
    }
}

// The predictor of the mean gap is 0.06 m + (0.01 s)/2 v: at -11 m/s it stays open
// and nothing may press, at -13 m/s all five nodes are closed.
BOOST_AUTO_TEST_CASE(persistent_contact_looks_half_a_step_ahead)
{
  const Block<2>    block({0., .06}, {2., 1.06}, {4, 2});
  const auto        body = block.body({2});
  ContactParameters parameters;
  parameters.treatment = "persistent contact";
  const auto contact =
    make_contact(parameters,
                 scheme_traits("midpoint"),
                 body,
                 LinearElastic{1., 1.},
                 plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.})));
  const Vector zero    = body.make_vector();
  const auto   falling = [&](const double speed) {
    return interpolated<2>(body,
                           {[](const Point<2> &) { return 0.; },
                            [speed](const Point<2> &) { return -speed; }});
  };
  for (const double speed : {11., 13.})
    {
      Vector       residual(zero);
      const Vector mean_velocity = falling(speed);
      contact->begin_stage({zero, zero, mean_velocity, .01}, 1.);
      contact->add_residual(falling(.2), residual);
      BOOST_CHECK_EQUAL(contact->active_set_description(),
                        speed < 12. ? "0 of 5" : "5 of 5");
    }
}

// On a bar the constant of the trace inequality is degree^2 times the modulus:
// a polynomial of degree p - 1 is at an end at most p^2 times its mean square.
BOOST_AUTO_TEST_CASE(trace_constant_of_bars)
{
  const Block<1> block(Point<1>(0.), Point<1>(1.), {4});
  for (const unsigned int degree : {1u, 2u, 3u})
    {
      const Body<1> body(block.mesh,
                         degree,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
      BOOST_CHECK_CLOSE(
        nitsche_trace_constant(body,
                               LinearElastic{3., 2.},
                               plane<1>(1, Point<1>(2.), Tensor<1, 1>({-1.}))),
        7. * degree * degree,
        round_off);
    }
}


// ### Time schemes

namespace
{
  /// A bar of one element, held on the left, so that its right end is an
  /// oscillator of mass density/3 = 1 kg and stiffness 4 N/m. It starts from u =
  /// 1 m at rest: energy 2 J, acceleration -4 m/s^2.
  struct Oscillator
  {
    explicit Oscillator(const TimeScheme::Parameters &scheme,
                        const Viscosity              &viscosity = {},
                        const double                  gap       = 100.)
      : block(Point<1>(0.), Point<1>(1.), {1})
    {
      ImpactParameters parameters;
      parameters.scheme                             = scheme;
      parameters.contact.treatment                  = "penalty";
      parameters.contact.values["Penalty epsilon0"] = .25;
      impact = std::make_unique<Impact<1>>(
        parameters,
        block.mesh,
        ImpactSetup<1>{Material<1>(LinearElastic{0., 2.}, viscosity),
                       3.,
                       1,
                       std::set<dealii::types::boundary_id>{0},
                       plane<1>(1, Point<1>(1. + gap), Tensor<1, 1>({-1.}))},
        MPI_COMM_WORLD);
      start = impact->system.initial_state(
        interpolated<1>(impact->body, {[](const Point<1> &x) { return x[0]; }}),
        impact->body.make_vector(),
        0.);
    }

    void
    step(const double time_step)
    {
      report = impact->scheme->step(impact->system, start, time_step, end);
    }

    double
    right_end(const Vector &vector) const
    {
      return boundary_sum(impact->body, vector, 0, 1);
    }

    Block<1>                   block;
    std::unique_ptr<Impact<1>> impact;
    State                      start, end;
    StepReport                 report;
  };

  TimeScheme::Parameters
  scheme_named(const std::string &name)
  {
    TimeScheme::Parameters parameters;
    parameters.name = name;
    return parameters;
  }
} // namespace

// (v1 - 0)/dt = -4 (1 + u1)/2 and u1 = 1 + dt v1/2 with dt = 1/2: u1 = 3/5, v1 =
// -8/5.
BOOST_AUTO_TEST_CASE(oscillator_by_the_trapezoidal_and_the_midpoint_rule)
{
  for (const std::string name : {"Crank-Nicolson", "midpoint"})
    {
      Oscillator oscillator(scheme_named(name));
      BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.start.acceleration),
                        -4.,
                        round_off);
      BOOST_CHECK_CLOSE(oscillator.impact->bulk->energy(
                          oscillator.start.solution),
                        2.,
                        round_off);
      oscillator.step(.5);
      BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.solution),
                        .6,
                        round_off);
      BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.velocity),
                        -1.6,
                        round_off);
      BOOST_CHECK_CLOSE(oscillator.impact->system.kinetic_energy(
                          oscillator.end.velocity),
                        1.28,
                        round_off);
      BOOST_CHECK_EQUAL(oscillator.end.time, .5);
    }
}

namespace
{
  /// One step of @p time_step leads to the displacement @p u, the velocity @p v and the
  /// acceleration @p a, and what it loses of the 2 J is the scheme's dissipation.
  void
  check_oscillator(const TimeScheme::Parameters &scheme,
                   const double                  time_step,
                   const double                  u,
                   const double                  v,
                   const double                  a)
  {
    Oscillator oscillator(scheme);
    oscillator.step(time_step);
    const auto is = [&](const Vector &vector, const double expected) {
      BOOST_CHECK_CLOSE(oscillator.right_end(vector), expected, round_off);
    };
    is(oscillator.end.solution, u);
    is(oscillator.end.velocity, v);
    is(oscillator.end.acceleration, a);
    BOOST_CHECK_CLOSE(oscillator.report.numerical_dissipation,
                      2. - .5 * v * v - 2. * u * u,
                      1e-8);
  }
} // namespace

// alpha = +-0.1: beta = 0.3025, gamma = 0.6. With dt = 1/2, u1 = 0.8025 +
// 0.075625 a1, v1 = -0.8 + 0.3 a1 and a1 = -4 ((1 - alpha) u1 + alpha).
BOOST_AUTO_TEST_CASE(oscillator_by_hht)
{
  for (const double alpha : {.1, -.1})
    {
      auto parameters                = scheme_named("HHT");
      parameters.values["HHT alpha"] = alpha;
      const double u = alpha > 0. ? .77225 / 1.27225 : .83275 / 1.33275;
      const double a = alpha > 0. ? -3.6 * u - .4 : -4.4 * u + .4;
      check_oscillator(parameters, .5, u, -.8 + .3 * a, a);
    }
}

// The spectral radius 0: alpha_m = -1, alpha_f = 0, beta = 1, gamma = 3/2. With dt = 1/2,
// u1 = 3/2 + a1/4, v1 = 1 + 3/4 a1 and 2 a1 + 4 = -4 u1: u1 = 2/3, a1 = -10/3, v1 = -3/2.
// The radius 1/2: 0, 1/3, 4/9, 5/6; u1 = 17/18 + a1/9, v1 = -1/3 + 5/12 a1 and a1 = -8/3 u1 -
// 4/3: u1 = 43/70, a1 = -104/35, v1 = -11/7. And Newmark's method with 3/10 and 3/5: u1 =
// 4/5 + 3/40 a1, v1 = -4/5 + 3/10 a1 and a1 = -4 u1.
BOOST_AUTO_TEST_CASE(oscillator_by_generalised_alpha_and_newmark)
{
  auto parameters                      = scheme_named("generalised-alpha");
  parameters.values["Spectral radius"] = 0.;
  check_oscillator(parameters, .5, 2. / 3., -1.5, -10. / 3.);
  parameters.values["Spectral radius"] = .5;
  check_oscillator(parameters, .5, 43. / 70., -11. / 7., -104. / 35.);
  parameters                         = scheme_named("Newmark");
  parameters.values["Newmark beta"]  = .3;
  parameters.values["Newmark gamma"] = .6;
  check_oscillator(parameters, .5, 8. / 13., -20. / 13., -32. / 13.);
}

// gamma = 1/2 and dt = 1: the first half is the trapezoidal rule above. Then v2 =
// 4/3 (-8/5) - 4/3 u2 and u2 = 4/3 3/5 - 1/3 + v2/3, so u2 = -11/65, v2 =
// -124/65, and 8/65 J are lost.
BOOST_AUTO_TEST_CASE(oscillator_by_tr_bdf2)
{
  auto parameters                    = scheme_named("TR-BDF2");
  parameters.values["TR-BDF2 gamma"] = .5;
  check_oscillator(parameters, 1., -11. / 65., -124. / 65., 44. / 65.);
}

// BDF2 after a step of 1/2 from u = 1/4 and v = 1 takes one of 1: with 9/5, 4/5 and 3/5 v1 = -4/5 + 3
// a1/5, u1 = 9/5 - 1/5 + 3 v1/5 and a1 = -4 u1, so u1 = 28/61 and v1 = -116/61; the first
// step of a run is that of TR-BDF2. Its dissipation closes the balance.
BOOST_AUTO_TEST_CASE(oscillator_by_bdf2_with_unequal_steps)
{
  Oscillator oscillator(scheme_named("BDF2"));
  State     &start      = oscillator.start;
  start.solution_before = start.velocity_before = start.solution;
  start.solution_before *= .25;
  start.step_before = .5;
  oscillator.step(1.);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.solution),
                    28. / 61.,
                    round_off);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.velocity),
                    -116. / 61.,
                    round_off);
  BOOST_CHECK_EQUAL(oscillator.end.step_before, 1.);
  // (v1^2 + 4 u1^2)/2 is that much less than 2, for the mass 1.
  BOOST_CHECK_CLOSE(oscillator.report.numerical_dissipation,
                    2. - .5 * (116. * 116. + 4. * 28. * 28.) / (61. * 61.),
                    1e-9);

  Oscillator first(scheme_named("BDF2")), other(scheme_named("TR-BDF2"));
  first.step(1.);
  other.step(1.);
  BOOST_CHECK_EQUAL(first.right_end(first.end.solution),
                    other.right_end(other.end.solution));
}

// With eta = 1 Pa s beside the spring, dt = 1/2: v1 = -(1 + u1) - (u1 - 1) = -2
// u1 and u1 = 1 + v1/4, so u1 = 2/3, and (1/3)^2/dt is dissipated. The trapezoidal rule is
// the same: its mean viscous force is v1/2 = -2/3 N.
BOOST_AUTO_TEST_CASE(damped_oscillator)
{
  for (const std::string name : {"midpoint", "Crank-Nicolson"})
    {
      Oscillator oscillator(scheme_named(name), {Viscosity::Law::linear, 1.});
      oscillator.step(.5);
      BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.solution),
                        2. / 3.,
                        round_off);
      BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.velocity),
                        -4. / 3.,
                        round_off);
      BOOST_CHECK_CLOSE(oscillator.report.viscous_dissipation,
                        2. / 9.,
                        round_off);
    }
}

// TR-BDF2 with gamma = 1/2 and dt = 1 begins with the step above. Then v2 = 4/3 (-4/3) - (4 u2 +
// v2)/3 and u2 = 4/3 2/3 - 1/3 + v2/3, so u2 = 1/12, v2 = -17/12, and the means of the
// viscous forces 0, -4/3 and -17/12 N take 2/9 and 231/288 J. Newmark's method with 3/10 and 3/5,
// as above with a1 = -4 u1 - v1: u1 = 11/16, v1 = -5/4.
BOOST_AUTO_TEST_CASE(damped_oscillator_by_other_schemes)
{
  auto parameters                    = scheme_named("TR-BDF2");
  parameters.values["TR-BDF2 gamma"] = .5;
  Oscillator two_stages(parameters, {Viscosity::Law::linear, 1.});
  two_stages.step(1.);
  BOOST_CHECK_CLOSE(two_stages.right_end(two_stages.end.solution),
                    1. / 12.,
                    1e-9);
  BOOST_CHECK_CLOSE(two_stages.right_end(two_stages.end.velocity),
                    -17. / 12.,
                    round_off);
  BOOST_CHECK_CLOSE(two_stages.report.viscous_dissipation,
                    295. / 288.,
                    round_off);

  parameters                         = scheme_named("Newmark");
  parameters.values["Newmark beta"]  = .3;
  parameters.values["Newmark gamma"] = .6;
  Oscillator newmark(parameters, {Viscosity::Law::linear, 1.});
  newmark.step(.5);
  BOOST_CHECK_CLOSE(newmark.right_end(newmark.end.solution),
                    11. / 16.,
                    round_off);
  BOOST_CHECK_CLOSE(newmark.right_end(newmark.end.velocity), -1.25, round_off);
}

// An obstacle at the gap 1/4 - u presses with 4 N/m (epsilon = 1/4, h_T = 1): a =
// -8 u + 1. With dt = 1/2, u1 = 1 + (-7 + 1 - 8 u1)/16 = 5/12 and v1 = -7/3, still
// in contact; the work against contact is 2 (1/6)^2 - 2 (3/4)^2.
BOOST_AUTO_TEST_CASE(oscillator_in_contact)
{
  Oscillator oscillator(scheme_named("Crank-Nicolson"), {}, .25);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.start.acceleration),
                    -7.,
                    round_off);
  BOOST_CHECK_CLOSE(
    oscillator.impact->contact->potential(oscillator.start.solution, 0.),
    1.125,
    round_off);
  oscillator.step(.5);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.solution),
                    5. / 12.,
                    round_off);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.velocity),
                    -7. / 3.,
                    round_off);
  BOOST_CHECK_CLOSE(oscillator.right_end(oscillator.end.contact_force),
                    4. / 6.,
                    round_off);
  BOOST_CHECK_CLOSE(oscillator.report.contact_work, -77. / 72., round_off);
}

// A node without inertia has the velocity and the acceleration of its own
// displacements: (u1 - u0)/dt and (v1 - v0)/dt. And nothing but its own stress acts
// on it: with the midpoint scheme, the mean strain of its element is zero.
BOOST_AUTO_TEST_CASE(velocity_without_inertia)
{
  const Block<1>   block(Point<1>(0.), Point<1>(1.), {10});
  ImpactParameters parameters;
  parameters.contact.treatment = "penalty";
  parameters.scheme.name       = "midpoint";
  parameters.mass              = "redistributed";
  Impact<1> impact(
    parameters,
    block.mesh,
    ImpactSetup<1>{Material<1>(LinearElastic{0., .5}),
                   1.,
                   1,
                   {0},
                   plane<1>(1, Point<1>(100.), Tensor<1, 1>({-1.}))},
    MPI_COMM_WORLD);
  const State start = impact.system.initial_state(
    interpolated<1>(impact.body, {[](const Point<1> &x) { return x[0]; }}),
    interpolated<1>(impact.body, {[](const Point<1> &x) { return 3. * x[0]; }}),
    0.);
  State end;
  impact.scheme->step(impact.system, start, .1, end);
  const auto last = [&](const Vector &vector) {
    return boundary_sum(impact.body, vector, 0, 1);
  };
  const double velocity = (last(end.solution) - 1.) / .1;
  BOOST_CHECK_CLOSE(last(end.velocity), velocity, 1e-8);
  BOOST_CHECK_CLOSE(last(end.acceleration), (velocity - 3.) / .1, 1e-8);
  Vector force = impact.body.make_vector(), mean(start.solution);
  mean.sadd(.5, .5, end.solution);
  impact.bulk->force(mean, force);
  BOOST_CHECK_SMALL(last(force), 1e-11);
}

// A block of 4 kg slides over a plane at 5 m/s under its weight, with mu = 0.3:
// over each step its momentum grows by (-mu N, N - weight) dt, and friction
// dissipates about mu N 5 m/s dt. It is stiff, but not rigid, so that N comes
// and goes.
BOOST_AUTO_TEST_CASE(block_that_slides_down_its_speed)
{
  for (const std::string treatment : {"Signorini active set",
                                      "persistent contact",
                                      "standard normal compliance",
                                      "improved normal compliance"})
    {
      const double     friction = .3, gravity = 10., time_step = .01;
      const Block<2>   block({0., 0.}, {2., 1.}, {4, 2});
      ImpactParameters parameters;
      parameters.contact.treatment                        = treatment;
      parameters.contact.values["Friction coefficient"]   = friction;
      parameters.contact.values["Compliance coefficient"] = 1e4;
      // Slip at 5 m/s is far beyond sticking.
      parameters.contact.values["Tangential compliance"] = 1e4;
      parameters.contact.values["Augmentation"]          = 1e4;
      parameters.scheme.name                             = "midpoint";
      const auto weight = std::make_shared<Vector>();
      Impact<2>  impact(
        parameters,
        block.mesh,
        ImpactSetup<2>{Material<2>(LinearElastic::from_young(1e4, .3)),
                        2.,
                        1,
                        {},
                        plane<2>(2, Point<2>(), Tensor<1, 2>({0., 1.})),
                        {},
                        [weight](const double, Vector &load) {
                         load = *weight;
                       }},
        MPI_COMM_WORLD);
      *weight = impact.body.make_vector();
      impact.consistent_mass.vmult(*weight,
                                   impact.uniform(
                                     Tensor<1, 2>({0., -gravity})));
      const Momenta<2> momenta(impact.body,
                               impact.system.mass_matrix(),
                               /* small strains */ true);

      State state = impact.state_in_flight(Tensor<1, 2>({5., 0.})), next;
      BOOST_CHECK_CLOSE(momenta.linear(state.velocity)[0], 20., round_off);
      BOOST_CHECK_CLOSE(momenta.linear(state.acceleration)[1],
                        -4. * gravity,
                        1e-8);
      double impulse = 0., friction_work = 0.;
      for (unsigned int n = 0; n < 20; ++n)
        {
          const StepReport report =
            impact.scheme->step(impact.system, state, time_step, next);
          const double pressed =
            impact.contact->summary({next.solution, next.contact_force, 0.})
              .at(2)
              .force;
          const Tensor<1, 2> gained =
            momenta.linear(next.velocity) - momenta.linear(state.velocity);
          BOOST_CHECK_SMALL(gained[0] + friction * pressed * time_step, 1e-8);
          BOOST_CHECK_SMALL(gained[1] - (pressed - 4. * gravity) * time_step,
                            1e-8);
          impulse += pressed * time_step;
          friction_work += report.friction_work;
          std::swap(state, next);
        }
      BOOST_CHECK_GT(impulse, 1.);
      BOOST_CHECK_CLOSE(friction_work, friction * impulse * 5., 10.);
    }
}

BOOST_AUTO_TEST_SUITE_END()
