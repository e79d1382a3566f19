// SPDX-License-Identifier: LGPL-2.1-or-later

// The exact solutions of the bars against the closed forms of the benchmarks,
// and against the wave equation and the conservation of energy.

#include <exact_solutions/bar_characteristics.h>

#include <deal.II/base/quadrature_lib.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(exact_solutions)

namespace
{
  BarCharacteristics
  bar_sd()
  {
    return {.5, -.5, 0., {false, .5}, {true, 0.}, 12.};
  }

  BarCharacteristics
  bar_ss()
  {
    return {1., -.5, -.5, {false, 1.}, {false, 0.}, 12.};
  }

  void
  check_energy(BarCharacteristics &exact, const double energy)
  {
    // The solution is piecewise linear with kinks at multiples of 1/20.
    const dealii::QIterated<1> quadrature(dealii::QGauss<1>(1), 20);
    for (unsigned int n = 0; n <= 240; ++n)
      {
        exact.set_time(n * .05);
        double sum = 0.;
        for (unsigned int q = 0; q < quadrature.size(); ++q)
          {
            const double strain = exact.gradient(quadrature.point(q))[0];
            const double speed  = exact.velocity(quadrature.point(q)[0]);
            sum +=
              .5 * (strain * strain + speed * speed) * quadrature.weight(q);
          }
        BOOST_CHECK_SMALL(sum - energy, 1e-13);
      }
  }

  /// value() must be consistent with gradient() and velocity().
  void
  check_derivatives(BarCharacteristics &exact)
  {
    const double eps = 1e-6;
    for (double t = .013; t < 11.9; t += .217)
      for (double x = .031; x < .97; x += .109)
        {
          // Kinks travel along the characteristics through integer times.
          const auto distance_to_integer = [](const double y) {
            return std::abs(y - std::round(y));
          };
          if (distance_to_integer(t - x) < 1e-3 ||
              distance_to_integer(t + x) < 1e-3)
            continue;
          const auto u = [&](const double x_, const double t_) {
            exact.set_time(t_);
            return exact.value(dealii::Point<1>(x_));
          };
          const double u_x = (u(x + eps, t) - u(x - eps, t)) / (2. * eps);
          const double u_t = (u(x, t + eps) - u(x, t - eps)) / (2. * eps);
          exact.set_time(t);
          BOOST_CHECK_SMALL(u_x - exact.gradient(dealii::Point<1>(x))[0], 1e-8);
          BOOST_CHECK_SMALL(u_t - exact.velocity(x), 1e-8);
        }
  }
} // namespace



BOOST_AUTO_TEST_CASE(sd_has_the_values_of_the_benchmark)
{
  auto exact = bar_sd();
  for (unsigned int period = 0; period < 4; ++period)
    for (double s = .025; s < 3.; s += .05)
      {
        exact.set_time(3. * period + s);
        const double u = s < 1. ? .5 - .5 * s : s < 2. ? 0. : .5 * (s - 2.);
        const double p = s > 1. && s < 2. ? .5 : 0.;
        BOOST_CHECK_SMALL(exact.value(dealii::Point<1>(0.)) - u, 1e-12);
        BOOST_CHECK_SMALL(exact.value(dealii::Point<1>(1.)), 1e-12);
        BOOST_CHECK_SMALL(exact.end_pressure(0) - p, 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(ss_has_the_values_of_the_benchmark)
{
  auto exact = bar_ss();
  for (unsigned int period = 0; period < 2; ++period)
    for (double s = .025; s < 6.; s += .05)
      {
        exact.set_time(6. * period + s);
        const double left  = s < 1. ? 1. - s
           : s < 4.                 ? 0.
           : s < 5.                 ? s - 4.
                                    : 1.;
        const double right = s < 1. ? .5
          : s < 2.                  ? .5 - (s - 1.)
          : s < 3.                  ? -.5
          : s < 4.                  ? s - 3. - .5
                                    : .5;
        BOOST_CHECK_SMALL(exact.value(dealii::Point<1>(0.)) - left, 1e-12);
        BOOST_CHECK_SMALL(exact.value(dealii::Point<1>(1.)) - right, 1e-12);
        BOOST_CHECK_SMALL(exact.end_pressure(0) - (s > 2. && s < 3. ? 1. : 0.),
                          1e-12);
        BOOST_CHECK_SMALL(exact.end_pressure(1) - (s > 5. ? 1. : 0.), 1e-12);
      }
}

BOOST_AUTO_TEST_CASE(energy_is_constant)
{
  auto sd = bar_sd();
  check_energy(sd, .125);
  auto ss = bar_ss();
  check_energy(ss, .25);
}

BOOST_AUTO_TEST_CASE(derivatives_are_consistent)
{
  auto sd = bar_sd();
  check_derivatives(sd);
  auto ss = bar_ss();
  check_derivatives(ss);
}

BOOST_AUTO_TEST_SUITE_END()
