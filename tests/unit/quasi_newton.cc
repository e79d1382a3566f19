// SPDX-License-Identifier: LGPL-2.1-or-later

// Nonlinear bodies with a frozen tangent: steps of the force that are mixed, and tangents that serve several steps.

#include <base/vector_operations.h>
#include <solvers/force_mixing.h>
#include <solvers/contact_schur_complement.h>
#include <time_integration/frozen_tangent.h>

#include <boost/test/unit_test.hpp>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <cmath>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(quasi_newton)

namespace
{
  constexpr unsigned int n_side = 14, n = n_side * n_side;

  dealii::IndexSet
  all_unknowns()
  {
    return dealii::complete_index_set(n);
  }

  /// A grid whose unknowns couple to their neighbours', on one rank; with
  /// @p skew, not quite symmetric.
  Matrix
  grid_matrix(const double skew)
  {
    dealii::DynamicSparsityPattern pattern(n, n);
    const auto                     for_each = [&](const auto &action) {
      for (unsigned int i = 0; i < n; ++i)
        {
          action(i, i, 4.3 + .1 * (i % 3));
          if (i % n_side != 0)
            {
              action(i, i - 1, -1. - skew);
              action(i - 1, i, -1. + skew);
            }
          if (i >= n_side)
            {
              action(i, i - n_side, -1.1 + skew * (i % 5));
              action(i - n_side, i, -1.1 - skew * (i % 5));
            }
        }
    };
    for_each([&](const unsigned int i, const unsigned int j, const double) {
      pattern.add(i, j);
    });
    Matrix matrix;
    matrix.reinit(all_unknowns(), pattern, MPI_COMM_SELF);
    for_each([&](const unsigned int i,
                 const unsigned int j,
                 const double       value) { matrix.set(i, j, value); });
    matrix.compress(VectorOperation::insert);
    return matrix;
  }

  Vector
  some_vector(const unsigned int seed)
  {
    Vector vector(all_unknowns(), MPI_COMM_SELF);
    for (unsigned int i = 0; i < n; ++i)
      vector(i) = std::sin(1. + seed + 2.7 * i);
    vector.compress(VectorOperation::insert);
    return vector;
  }
} // namespace



namespace
{
  /// Solutions with the symmetric part of a matrix.
  class Symmetric
  {
  public:
    explicit Symmetric(const Matrix &matrix)
    {
      BOOST_REQUIRE(cholesky.factorise(matrix));
    }

    void
    solve(const Vector &right_hand_side, Vector &solution)
    {
      cholesky.factor().forward(local_values(right_hand_side), forward);
      cholesky.factor().backward(forward, local_values(solution));
    }

  private:
    SparseCholesky      cholesky{SparseCholesky::Kind::frozen_tangent};
    std::vector<double> forward;
  };
} // namespace



BOOST_AUTO_TEST_CASE(tangents_serve_while_they_pay)
{
  // With k iterations more in each further step, the mean of the costs over n steps,
  // cost/n + k (n - 1)/2, is least at n = sqrt(2 cost/k).
  const Vector state = some_vector(4);
  for (const unsigned int more : {1, 3, 6})
    {
      FrozenTangent tangent;
      BOOST_CHECK(!tangent.serves(.1));
      tangent.begin(.1, .1, state);
      BOOST_CHECK(!tangent.exists());
      unsigned int n_steps = 0;
      do
        tangent.count(20 + more * n_steps++);
      while (tangent.serves(.1) && n_steps < 100);
      const auto mean_cost = [&](const unsigned int n) {
        return FrozenTangent::cost / n + .5 * more * (n - 1.);
      };
      BOOST_TEST_CONTEXT(more << " more in each step, " << n_steps << " steps")
      {
        BOOST_CHECK_LE(mean_cost(n_steps), mean_cost(n_steps + 1) + 1e-12);
        BOOST_CHECK_LE(mean_cost(n_steps), mean_cost(n_steps - 1) + 1e-12);
      }
    }

  // While it needs no more it serves, but in no step of another length; and it is
  // known by the step and the state for which it was made.
  FrozenTangent tangent, other;
  tangent.begin(.1, .1, state);
  for (unsigned int n = 0; n < 50; ++n)
    tangent.count(7);
  BOOST_CHECK(tangent.serves(.1));
  BOOST_CHECK(!tangent.serves(.05));
  other = tangent;
  BOOST_CHECK(other.is_same(tangent));
  other.begin(.1, .1, some_vector(5));
  BOOST_CHECK(!other.is_same(tangent));
  tangent.forget();
  BOOST_CHECK(!tangent.exists());
}



BOOST_AUTO_TEST_CASE(mixing_solves_what_plain_steps_do_not)
{
  // x = T^{-1} f for the symmetric part T of a matrix; plain steps f - r need three
  // times as many.
  const Matrix matrix = grid_matrix(.15);
  Symmetric    symmetric(matrix);
  const Vector right_hand_side = some_vector(2);
  const auto   iterations      = [&](const unsigned int n_kept) {
    ForceMixing  mixing(n_kept);
    Vector       x(right_hand_side), residual(x), step(x), update(x);
    unsigned int k = 0;
    x              = 0.;
    for (; k < 200; ++k)
      {
        matrix.vmult(residual, x);
        residual -= right_hand_side;
        if (residual.l2_norm() < 1e-11 * right_hand_side.l2_norm())
          break;
        if (n_kept == 0)
          {
            step = residual;
            step *= -1.;
          }
        else
          mixing.next(residual, step);
        symmetric.solve(step, update);
        x += update;
      }
    return k;
  };
  const unsigned int plain = iterations(0), mixed = iterations(40),
                     with_few = iterations(3);
  BOOST_TEST_MESSAGE(plain << " plain, " << with_few << " with three, " << mixed
                           << " mixed");
  BOOST_CHECK_LT(mixed, 25);
  BOOST_CHECK_LT(mixed, .6 * plain);
  BOOST_CHECK_LE(mixed, with_few);
}



BOOST_AUTO_TEST_SUITE_END()
