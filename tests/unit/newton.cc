// SPDX-License-Identifier: LGPL-2.1-or-later

// The Newton iteration on scalar equations with known behaviour, one copy per
// unknown: quadratic convergence, finite termination, line search, and failure.

#include <base/exceptions.h>
#include <solvers/newton.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(newton)

namespace
{
  Vector
  four_times(const double value)
  {
    Vector x(dealii::complete_index_set(4), MPI_COMM_SELF);
    x = value;
    return x;
  }

  /// f(x) = 0 in each entry of a vector. @param point becomes that of the last residual.
  NewtonSolver::Problem
  equations(const std::function<double(double)> &f,
            const std::function<double(double)> &derivative,
            Vector                              &point,
            const double                         scale = 1.)
  {
    NewtonSolver::Problem problem;
    problem.residual = [=, &point](const Vector &y, Vector &residual) {
      point = y;
      for (const auto i : y.locally_owned_elements())
        residual(i) = f(y(i));
      residual.compress(dealii::VectorOperation::insert);
    };
    problem.solve =
      [=, &point](const Vector &residual, Vector &update, bool, double) {
        for (const auto i : residual.locally_owned_elements())
          update(i) = residual(i) / derivative(point(i));
        update.compress(dealii::VectorOperation::insert);
      };
    problem.norm        = [](const Vector &v) { return v.linfty_norm(); };
    problem.active_set  = []() { return std::string("none"); };
    problem.accept      = []() {};
    problem.force_scale = [=]() { return scale; };
    problem.round_off   = []() { return 0.; };
    return problem;
  }

  std::vector<NewtonSolver::Iteration>
  solve(const std::function<double(double)> &f,
        const std::function<double(double)> &derivative,
        const double                         start,
        const NewtonSolver::Parameters      &parameters,
        double                              *root  = nullptr,
        const double                         scale = 1.)
  {
    Vector                      x = four_times(start), point(x);
    const NewtonSolver::Problem problem =
      equations(f, derivative, point, scale);
    NewtonSolver newton(parameters);
    const auto   history = newton.solve(problem, x);
    if (root != nullptr)
      *root = x(2);
    return history;
  }
} // namespace



BOOST_AUTO_TEST_CASE(converges_quadratically)
{
  double     root;
  const auto history = solve([](double x) { return x * x - 2.; },
                             [](double x) { return 2. * x; },
                             2.,
                             {1e-14, 30, 10},
                             &root);
  BOOST_CHECK_SMALL(root - std::sqrt(2.), 1e-14);
  // For x^2 - a, the residual is squared over 4 a, to leading order.
  for (unsigned int k = 1; k + 1 < history.size(); ++k)
    if (history[k + 1].relative_residual > 1e-14)
      BOOST_CHECK_LT(history[k + 1].relative_residual,
                     .2 * std::pow(history[k].relative_residual, 2));
  BOOST_CHECK_LE(history.size(), 7u);
}

BOOST_AUTO_TEST_CASE(piecewise_linear_equations_end_exactly)
{
  double     root;
  const auto history =
    solve([](double x) { return x + 3. * std::max(x, 0.) - 2.; },
          [](double x) { return x > 0. ? 4. : 1.; },
          -5.,
          {1e-14, 30, 10},
          &root);
  BOOST_CHECK_EQUAL(root, .5);
  BOOST_CHECK_LE(history.size(), 4u);
}

// Full steps for atan(x) diverge from x = 2; shortened ones converge.
BOOST_AUTO_TEST_CASE(line_search_saves_what_full_steps_lose)
{
  const auto f          = [](double x) { return std::atan(x); };
  const auto derivative = [](double x) { return 1. / (1. + x * x); };
  BOOST_CHECK_THROW(solve(f, derivative, 2., {1e-12, 20, 1000}), NewtonFailure);
  double     root;
  const auto history = solve(f, derivative, 2., {1e-12, 20, 0}, &root);
  BOOST_CHECK_SMALL(root, 1e-11);
  BOOST_CHECK_LT(history[1].step_length, 1.);
}

// Full steps for the cubic root of x go from x to -2 x, half of them to -x/2.
BOOST_AUTO_TEST_CASE(another_attempt_can_begin_where_one_failed)
{
  Vector     point = four_times(0.);
  const auto root =
    equations([](double x) { return std::cbrt(x); },
              [](double x) { return std::pow(std::cbrt(x), -2) / 3.; },
              point);
  // As long as the residual is less than twice that of the guess, the last iterate is
  // as good; later it is the guess.
  for (const auto &[n_iterations, end, expected] :
       {std::tuple(2u, 2u, 4.), std::tuple(4u, 0u, 1.)})
    {
      Vector       x = four_times(1.);
      NewtonSolver newton({1e-12, n_iterations, 1000});
      BOOST_CHECK_THROW(newton.solve(root, x), NewtonFailure);
      BOOST_CHECK_EQUAL(newton.end_iteration(), end);
      BOOST_CHECK_CLOSE(double(x(2)), expected, 1e-10);
      BOOST_CHECK(!newton.was_on_its_way());
    }
  Vector       x = four_times(1.);
  NewtonSolver newton({1e-8, 100, 1000});
  const bool   line_search_at_once = true;
  const auto  &history             = newton.solve(root, x, line_search_at_once);
  BOOST_CHECK_SMALL(double(x(2)), 1e-20);
  BOOST_CHECK_EQUAL(history[1].step_length, .5);
  BOOST_CHECK_EQUAL(newton.end_iteration() + 1, history.size());

  // Newton's method halves x where x^2 = 0, and needs but time.
  NewtonSolver patient({1e-12, 3, 1000});
  BOOST_CHECK_THROW(patient.solve(equations([](double x) { return x * x; },
                                            [](double x) { return 2. * x; },
                                            point),
                                  x = four_times(1.)),
                    NewtonFailure);
  BOOST_CHECK_CLOSE(double(x(2)), 1. / 8., 1e-10);
  BOOST_CHECK_EQUAL(patient.end_iteration(), 3u);
  BOOST_CHECK(patient.was_on_its_way());
}

BOOST_AUTO_TEST_CASE(never_returns_what_is_not_converged)
{
  const auto derivative = [](double) { return 1.; };
  // No root; a residual that is not a number; an iteration too few.
  BOOST_CHECK_THROW(solve([](double) { return 1.; }, derivative, 0., {}),
                    NewtonFailure);
  BOOST_CHECK_THROW(solve(
                      [](double x) {
                        return x == 0.
                          ? 1.
                          : std::numeric_limits<double>::quiet_NaN();
                      },
                      derivative,
                      0.,
                      {}),
                    NewtonFailure);
  BOOST_CHECK_THROW(solve([](double x) { return x * x - 2.; },
                          [](double x) { return 2. * x; },
                          2.,
                          {1e-14, 2, 10}),
                    NewtonFailure);
}

// Forces that are not a number are no forces of size zero: with the scale 1
// instead any residual below the tolerance would pass.
BOOST_AUTO_TEST_CASE(a_force_scale_that_is_not_a_number_never_converges)
{
  BOOST_CHECK_THROW(solve([](double) { return 1e-20; },
                          [](double) { return 1.; },
                          0.,
                          {1e-12, 5, 10},
                          nullptr,
                          std::numeric_limits<double>::quiet_NaN()),
                    NewtonFailure);
}

// The message holds the table of iterations.
BOOST_AUTO_TEST_CASE(failure_shows_its_history)
{
  try
    {
      solve([](double) { return 1.; },
            [](double) { return 1.; },
            0.,
            {1e-12, 30, 1000});
      BOOST_FAIL("no exception");
    }
  catch (const NewtonFailure &failure)
    {
      const std::string text = failure.what();
      BOOST_CHECK(text.find("not converged in 30 iterations") !=
                  std::string::npos);
      BOOST_CHECK(text.find("relative residual") != std::string::npos);
    }
}

BOOST_AUTO_TEST_SUITE_END()
