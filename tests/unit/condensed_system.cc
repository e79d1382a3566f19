// SPDX-License-Identifier: LGPL-2.1-or-later

// What a linear body condensed to contact stands on: half solutions, dense systems
// of sets of places, and accelerations, each against the matrix itself.

#include "meshes.h"

#include <base/exceptions.h>
#include <base/ghosted_vector.h>
#include <discretization/linear_bulk.h>
#include <solvers/factorisation.h>
#include <solvers/functional_norm.h>
#include <solvers/known_product.h>
#include <solvers/low_rank_correction.h>
#include <solvers/mass_solver.h>
#include <solvers/positive_system.h>
#include <solvers/unsymmetric_system.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(condensed_system)

namespace
{
  const LinearElastic material{1.5, 1.};

  Body<3>
  cube_body(const CubeAbovePlane<3>                    &cube,
            const std::set<dealii::types::boundary_id> &clamped)
  {
    return {cube.triangulation,
            2,
            clamped,
            {1},
            MultiplierSpace::none,
            MPI_COMM_WORLD};
  }

  /// Each functional looks at a few neighbours, the functionals are far apart.
  Functionals
  some_functionals(const unsigned int n,
                   const unsigned int first,
                   const unsigned int n_unknowns)
  {
    Functionals functionals;
    for (unsigned int f = 0; f < n; ++f)
      {
        for (unsigned int k = 0; k < 4; ++k)
          functionals.add((first + 97 * f + 3 * k) % n_unknowns,
                          1. + .3 * f - .7 * k);
        functionals.end_functional();
      }
    return functionals;
  }

  /// Every fifth unknown couples no longer to the others, but with another sign to its
  /// like.
  void
  make_some_negative(Matrix &matrix)
  {
    for (auto entry = matrix.begin(); entry != matrix.end(); ++entry)
      {
        const bool row    = entry->row() % 5 == 0,
                   column = entry->column() % 5 == 0;
        if (row && column)
          entry->value() *= -1.;
        else if (row != column)
          entry->value() = 0.;
      }
  }

  Vector
  as_vector(const Functionals &functionals, const unsigned int f, Vector vector)
  {
    vector = 0.;
    for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
         ++k)
      vector(functionals.index[k]) += functionals.value[k];
    vector.compress(VectorOperation::add);
    return vector;
  }
} // namespace

// l . A^{-1} r is the product of the halves L^{-1} l and L^{-1} r; whole solutions
// are two halves; what is seen of one needs the first half alone, and forces on the
// functionals that are known need not go through the factor. The same where some unknowns
// have a negative matrix of their own, as multipliers of the augmented Lagrangian.
BOOST_DATA_TEST_CASE(halves_make_solutions,
                     boost::unit_test::data::make({false, true}),
                     has_negative)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3> cube(true, 5);
  const Body<3>           body = cube_body(cube, {});
  const LinearBulk<3>     bulk(body, material);
  Matrix                  matrix;
  matrix.reinit(body.sparsity_pattern());
  assemble_mass_matrix(body, 1.).add_to(20., matrix);
  bulk.add_tangent(1., body.make_vector(), matrix);
  if (has_negative)
    make_some_negative(matrix);
  const auto factorisation = make_cholesky_factorisation(false);
  BOOST_REQUIRE(factorisation->factorise(matrix, false));
  BOOST_REQUIRE(factorisation->has_halves());

  const Functionals left  = some_functionals(5, 11, matrix.m()),
                    right = some_functionals(7, 1204, matrix.m());
  const auto left_half    = factorisation->go_forwards(left),
             right_half   = factorisation->go_forwards(right);
  BOOST_CHECK_LT(left_half.values.size(), 5 * matrix.m());
  std::vector<double> products;
  factorisation->multiply(left_half, right_half, products);
  Vector solution = body.make_vector(), other(solution);
  for (unsigned int r = 0; r < right.size(); ++r)
    {
      const Vector right_hand_side = as_vector(right, r, solution);
      factorisation->solve(right_hand_side, solution);
      for (unsigned int l = 0; l < left.size(); ++l)
        BOOST_CHECK_SMALL(products[r * left.size() + l] -
                            as_vector(left, l, other) * solution,
                          1e-13 * solution.linfty_norm());

      std::vector<double> half;
      factorisation->go_forwards(right_hand_side, half);
      factorisation->go_backwards(half, other);
      other -= solution;
      BOOST_CHECK_SMALL(other.linfty_norm(), 1e-13 * solution.linfty_norm());

      std::vector<double> seen(left.size());
      factorisation->observe(left_half, half, seen.data());
      for (unsigned int l = 0; l < left.size(); ++l)
        BOOST_CHECK_SMALL(seen[l] - as_vector(left, l, other) * solution,
                          1e-13 * solution.linfty_norm());
      std::vector<double> coefficients(right.size());
      coefficients[r] = 1.;
      factorisation->subtract(right_half, coefficients.data(), half);
      for (const double value : half)
        BOOST_CHECK_SMALL(value, 1e-13 * solution.linfty_norm());
    }
}

namespace
{
  /// A symmetric, positive definite matrix with entries of the size of one.
  std::vector<std::vector<double>>
  positive_columns(const unsigned int n, const unsigned int seed)
  {
    std::mt19937                     generator(seed);
    std::uniform_real_distribution<> random(-1., 1.);
    std::vector<std::vector<double>> root(n, std::vector<double>(n)),
      columns(root);
    for (auto &column : root)
      for (double &entry : column)
        entry = random(generator);
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < n; ++j)
        for (unsigned int k = 0; k < n; ++k)
          columns[i][j] += root[i][k] * root[j][k];
    return columns;
  }
} // namespace

// The last columns of a factor are full, and end with a block of any width.
BOOST_AUTO_TEST_CASE(halves_of_full_matrices_make_solutions)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  for (unsigned int n = 40; n < 52; ++n)
    {
      const auto                     columns = positive_columns(n, n);
      dealii::DynamicSparsityPattern pattern(n, n);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          pattern.add(i, j);
      Matrix matrix;
      matrix.reinit(dealii::complete_index_set(n), pattern, MPI_COMM_WORLD);
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          matrix.set(i, j, columns[i][j] + (i == j ? 1. : 0.));
      matrix.compress(VectorOperation::insert);
      const auto factorisation = make_cholesky_factorisation(false);
      BOOST_REQUIRE(factorisation->factorise(matrix, false));
      BOOST_REQUIRE(factorisation->has_halves());
      Vector right_hand_side(dealii::complete_index_set(n), MPI_COMM_WORLD);
      randomise(right_hand_side, 1., 3);
      Vector              solution(right_hand_side), rest(right_hand_side);
      std::vector<double> half;
      factorisation->go_forwards(right_hand_side, half);
      factorisation->go_backwards(half, solution);
      matrix.vmult(rest, solution);
      rest -= right_hand_side;
      BOOST_CHECK_MESSAGE(rest.linfty_norm() < 1e-11,
                          n << " unknowns: " << rest.linfty_norm());
    }
}

// Sets near the one that was factored, with other places and another diagonal, and
// one that is far from it.
BOOST_AUTO_TEST_CASE(nearby_sets_are_solved)
{
  constexpr unsigned int           n = 80;
  std::mt19937                     generator(6);
  std::uniform_real_distribution<> random(-1., 1.);
  auto                             columns = positive_columns(n, 5);

  struct Set
  {
    unsigned int first, end, but;
    double       other_diagonal;
    bool         is_updated;
  };
  PositiveSystem system;
  for (const Set &set : {Set{10, 70, n, 1., false},
                         Set{10, 70, n, 1., false},
                         Set{12, 70, n, 1., true},
                         Set{10, 72, n, 1., true},
                         Set{11, 72, 40, 1., true},
                         Set{10, 70, n, 3., true},
                         Set{8, 70, 30, 3., true},
                         Set{10, 70, n, 1., false},
                         Set{20, 50, n, 1., false},
                         Set{20, 52, 20, 1., true}})
    {
      std::vector<unsigned int> places;
      std::vector<double>       diagonal;
      for (unsigned int place = set.first; place < set.end; ++place)
        if (place != set.but)
          {
            places.push_back(place);
            diagonal.push_back(place == 33 ? set.other_diagonal : 1.);
          }
      BOOST_REQUIRE(system.set(places, diagonal, columns, true));
      BOOST_CHECK_EQUAL(system.is_updated(), set.is_updated);
      dealii::Vector<double> right_hand_side(places.size());
      for (double &entry : right_hand_side)
        entry = random(generator);
      dealii::Vector<double> solution(right_hand_side);
      system.solve(solution);
      for (unsigned int i = 0; i < places.size(); ++i)
        {
          double sum = diagonal[i] * solution[i] - right_hand_side[i];
          for (unsigned int j = 0; j < places.size(); ++j)
            sum += columns[places[j]][places[i]] * solution[j];
          BOOST_CHECK_SMALL(sum, 1e-12);
        }
    }
  columns[30][30] = -100.;
  system.forget();
  BOOST_CHECK(!system.set({29, 30}, {1., 1.}, columns, false));
}

// Sets that begin as the one before them, of which the factorisation keeps blocks:
// with the digits of a system that knows of none, and after the matrix is another one.
BOOST_AUTO_TEST_CASE(kept_blocks_have_the_same_digits)
{
  constexpr unsigned int n = 250;
  struct Set
  {
    unsigned int end, but;
    double       diagonal_at_100;
  };
  PositiveSystem system;
  for (const unsigned int seed : {7, 8})
    {
      const auto columns = positive_columns(n, seed);
      system.forget();
      for (const Set &set : {Set{130, n, 1.},
                             Set{200, n, 1.},
                             Set{150, n, 1.},
                             Set{150, 140, 1.},
                             Set{150, 20, 1.},
                             Set{250, 20, 1.},
                             Set{250, 20, 2.},
                             Set{70, n, 1.}})
        {
          std::vector<unsigned int> places;
          std::vector<double>       diagonal;
          for (unsigned int place = 0; place < set.end; ++place)
            if (place != set.but)
              {
                places.push_back(place);
                diagonal.push_back(place == 100 ? set.diagonal_at_100 : 1.);
              }
          PositiveSystem fresh;
          BOOST_REQUIRE(system.set(places, diagonal, columns, false));
          BOOST_REQUIRE(fresh.set(places, diagonal, columns, false));
          dealii::Vector<double> solution(places.size());
          solution = 1.;
          dealii::Vector<double> other(solution);
          system.solve(solution);
          fresh.solve(other);
          for (unsigned int i = 0; i < places.size(); ++i)
            {
              BOOST_CHECK_EQUAL(solution[i], other[i]);
              double sum = diagonal[i] * solution[i] - 1.;
              for (unsigned int j = 0; j < places.size(); ++j)
                sum += columns[places[j]][places[i]] * solution[j];
              BOOST_CHECK_SMALL(sum, 1e-10);
            }
        }
    }
}

// Systems that are not symmetric, with rows that look at the same values in groups of
// three and alone, factored in single precision and in double precision: solutions solve
// as well. One that is nearly singular, two of its unknowns look nearly the same, is
// beyond single precision.
BOOST_DATA_TEST_CASE(unsymmetric_systems_are_solved,
                     boost::unit_test::data::make({false, true}) *
                       boost::unit_test::data::make({1., 1e-9}),
                     may_be_single,
                     difference)
{
  constexpr unsigned int           n = 300, n_places = 400;
  std::mt19937                     generator(3);
  std::uniform_real_distribution<> random(-1., 1.);
  auto                             columns = positive_columns(n_places, 5);
  std::vector<unsigned int>        places;
  std::vector<FunctionalRow>       on_places(n), on_values(n);
  for (unsigned int i = 0; i < n; ++i)
    {
      places.push_back(i + i / 4);
      if (i % 5 == 0)
        on_places[i] = {{places.back(), .5}, {399, 7.}};
      // The last one is not among them.
      const unsigned int first = i % 7 == 0 ? i : i - i % 3;
      for (unsigned int k = 0; k < 6; ++k)
        on_values[i].emplace_back(first + 11 * k, random(generator));
    }
  // Rows that are nearly the same but for what they add themselves.
  on_values[100] = on_values[101];
  on_places[101] = {{places[101], -1. + difference}, {places[100], 1.}};
  on_places[100].clear();
  const UnsymmetricSystem::Terms terms{places, on_places, on_values, columns};
  UnsymmetricSystem              system;
  system.factorise(terms, may_be_single);
  BOOST_CHECK_EQUAL(system.is_in_single_precision(), may_be_single);
  for (unsigned int repetition = 0; repetition < 2; ++repetition)
    {
      dealii::Vector<double> right_hand_side(n);
      for (double &entry : right_hand_side)
        entry = random(generator);
      dealii::Vector<double> solution(right_hand_side);
      system.solve(terms, solution);
      BOOST_CHECK_EQUAL(system.is_in_single_precision(),
                        may_be_single && difference == 1.);
      const double size = solution.linfty_norm();
      for (unsigned int i = 0; i < n; ++i)
        {
          double rest = solution[i] - right_hand_side[i];
          for (const auto &[place, value] : on_places[i])
            for (unsigned int j = 0; j < n; ++j)
              if (places[j] == place)
                rest += value * solution[j];
          for (const auto &[o, value] : on_values[i])
            for (unsigned int j = 0; j < n; ++j)
              rest += value * columns[places[j]][o] * solution[j];
          BOOST_CHECK_SMALL(rest, 1e-8 + 1e-11 * size);
        }
    }
}

// A change in more places than a block of the dense system has, before and after the
// matrix becomes another one: solutions solve, whatever was kept. Also where one to five
// rows look at the same observables and have different values, as the components of nodes
// that touch.
BOOST_DATA_TEST_CASE(a_new_matrix_has_its_own_corrections,
                     boost::unit_test::data::make({false, true}),
                     has_clusters)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3>   cube(true, 3);
  const Body<3>             body = cube_body(cube, {});
  const LinearBulk<3>       bulk(body, material);
  constexpr unsigned int    n = 90;
  Functionals               functionals;
  const std::vector<double> order(n, 0.);
  for (unsigned int f = 0; f < n; ++f)
    {
      functionals.add(10 * f, 1.);
      functionals.end_functional();
    }
  LowRankCorrection::Options options;
  options.is_symmetric = true;
  LowRankCorrection                   correction(body.owned_indices(),
                               MPI_COMM_WORLD,
                               {functionals, order, {}},
                               {},
                               options);
  std::vector<LowRankCorrection::Row> change(n);
  for (unsigned int f = 0; f < n; ++f)
    change[f] = {{correction.place(f), 3. + f}};
  unsigned int size = 1;
  for (unsigned int first = 0; has_clusters && first < n; first += size)
    {
      size = 1 + size % 5;
      for (unsigned int f = first; f < std::min(first + size, n); ++f)
        {
          change[f].clear();
          for (unsigned int other = first; other < std::min(first + 8, n);
               ++other)
            change[f].emplace_back(correction.place(other),
                                   (f == other ? 3. + f : 0.) +
                                     std::sin(5. * f + other));
        }
    }
  const auto factorisation = make_cholesky_factorisation(false);
  for (const double stiffness : {1., 5.})
    {
      Matrix matrix;
      matrix.reinit(body.sparsity_pattern());
      assemble_mass_matrix(body, 1.).add_to(20., matrix);
      bulk.add_tangent(stiffness, body.make_vector(), matrix);
      BOOST_REQUIRE(factorisation->factorise(matrix, false));
      correction.forget_columns();
      correction.set_change(change, *factorisation);
      Vector right_hand_side = body.make_vector(), solution(right_hand_side),
             rest(right_hand_side);
      randomise(right_hand_side, 1., 4);
      correction.solve(right_hand_side, solution, *factorisation);
      matrix.vmult(rest, solution);
      for (unsigned int f = 0; f < n; ++f)
        for (const auto &[place, value] : change[f])
          for (unsigned int other = 0; other < n; ++other)
            if (correction.place(other) == place)
              rest(10 * f) += value * solution(10 * other);
      rest -= right_hand_side;
      BOOST_CHECK_SMALL(rest.linfty_norm(), 1e-10);
    }
}

// Also of clamped bodies, on any number of ranks.
BOOST_AUTO_TEST_CASE(accelerations_have_their_forces)
{
  for (const bool is_clamped : {false, true})
    {
      const CubeAbovePlane<3> cube(true, 3);
      const Body<3>           body =
        cube_body(cube,
                  is_clamped ? std::set<dealii::types::boundary_id>{2}
                             : std::set<dealii::types::boundary_id>{});
      const BodyMatrix mass = assemble_mass_matrix(body, 1.7);
      const std::vector<MassSolver::Index> clamped(
        body.clamped_indices().begin(),
        body.clamped_indices().end());
      const MassSolver solver(mass, clamped);
      Vector force = body.make_vector(), acceleration(force), inertia(force);
      randomise(force, 1., 3);
      for (const auto i : clamped)
        force(i) = 0.;
      force.compress(VectorOperation::insert);
      solver.solve(force, acceleration);
      for (const auto i : clamped)
        BOOST_CHECK_EQUAL(acceleration(i), 0.);
      mass.vmult(inertia, acceleration);
      for (const auto i : clamped)
        inertia(i) = 0.;
      inertia.compress(VectorOperation::insert);
      inertia -= force;
      BOOST_CHECK_SMALL(inertia.linfty_norm(), 1e-14);
    }

  // Nothing to accelerate with.
  const CubeAbovePlane<3> cube(true, 1);
  const Body<3>           body  = cube_body(cube, {});
  const BodyMatrix        none  = assemble_mass_matrix(body, 0.);
  Vector                  force = body.make_vector(), acceleration(force);
  force                         = 1.;
  BOOST_CHECK_THROW(MassSolver(none, {}).solve(force, acceleration),
                    NewtonFailure);
}

BOOST_AUTO_TEST_CASE(rows_of_all_ranks_are_summed)
{
  // Each rank has a part of row 7, with a column that all share, and a row of its own.
  const unsigned int rank =
                       dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD),
                     n_ranks =
                       dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const auto sums =
    sum_of_all_ranks({{20 + rank, {{{{rank, 1.}}, {}, {{3, 4.}}}}},
                      {7, {{{{5, 1. + rank}, {9 + rank, 2.}}, {{1, .5}}, {}}}}},
                     MPI_COMM_WORLD);
  BOOST_REQUIRE_EQUAL(sums.size(), n_ranks + 1);
  BOOST_CHECK_EQUAL(sums[0].number, 7u);
  FunctionalRow row = {{5, n_ranks * (n_ranks + 1.) / 2.}};
  for (unsigned int r = 0; r < n_ranks; ++r)
    row.emplace_back(9 + r, 2.);
  BOOST_CHECK(sums[0].rows[0] == row);
  BOOST_CHECK(sums[0].rows[1] == FunctionalRow({{1, .5 * n_ranks}}));
  BOOST_CHECK(sums[0].rows[2].empty());
  for (unsigned int r = 0; r < n_ranks; ++r)
    {
      BOOST_CHECK_EQUAL(sums[r + 1].number, 20 + r);
      BOOST_CHECK(sums[r + 1].rows[0] == FunctionalRow({{r, 1.}}));
      BOOST_CHECK(sums[r + 1].rows[2] == FunctionalRow({{3, 4.}}));
    }
}

// The norm of a sum of functionals, some of which share unknowns, is that of the vector
// which is the sum. On several ranks each has functionals of its own unknowns; where one
// looks at those of another rank, norms are not known.
BOOST_AUTO_TEST_CASE(norms_of_sums_of_functionals)
{
  const CubeAbovePlane<3> cube(true, 3);
  const Body<3>           body  = cube_body(cube, {});
  const auto             &owned = body.owned_indices();
  const unsigned int      n     = 6;
  Functionals             functionals;
  std::vector<double>     coefficients;
  Vector                  sum = body.make_vector(), scaling(sum);
  for (unsigned int i = 0; i < scaling.locally_owned_size(); ++i)
    scaling.trilinos_vector()[0][i] = 1. + i % 7;
  for (unsigned int f = 0; f < n; ++f)
    {
      coefficients.push_back(f == 2 ? 0. : 1.5 - f);
      for (unsigned int k = 0; k < 4; ++k)
        {
          const auto index =
            owned.nth_index_in_set((3 * f + 5 * k) % owned.n_elements());
          functionals.add(index, 1. + f - .3 * k);
          sum(index) += coefficients[f] * (1. + f - .3 * k);
        }
      functionals.end_functional();
    }
  sum.compress(VectorOperation::add);
  FunctionalNorm norm(functionals, owned, body.communicator);
  BOOST_REQUIRE(norm.is_known());
  BOOST_CHECK_CLOSE(norm.of_sum(coefficients, nullptr), sum.l2_norm(), 1e-12);
  sum.scale(scaling);
  BOOST_CHECK_CLOSE(norm.of_sum(coefficients, &scaling), sum.l2_norm(), 1e-12);

  if (dealii::Utilities::MPI::n_mpi_processes(body.communicator) == 1)
    return;
  Functionals  elsewhere = functionals;
  const auto   all       = owned.size();
  unsigned int other     = 0;
  while (owned.is_element(other))
    ++other;
  BOOST_REQUIRE_LT(other, all);
  elsewhere.add(other, 1.);
  elsewhere.end_functional();
  BOOST_CHECK(!FunctionalNorm(elsewhere, owned, body.communicator).is_known());
}

// All values of this rank, in their order, or some of them and of other ranks'.
BOOST_AUTO_TEST_CASE(ghosted_values_are_those_of_the_vector)
{
  const CubeAbovePlane<3> cube(true, 3);
  const Body<3>           body   = cube_body(cube, {});
  Vector                  vector = body.make_vector();
  dealii::IndexSet        some(vector.size());
  for (dealii::types::global_dof_index i = 1; i < vector.size(); i += 3)
    some.add_index(i);
  for (const auto &indices : {body.owned_indices(), some})
    {
      GhostedVector ghosted(indices, body.communicator);
      for (const double factor : {1., -.5})
        {
          for (const auto i : body.owned_indices())
            vector(i) = factor * (1. + i);
          vector.compress(VectorOperation::insert);
          ghosted.import(vector);
          BOOST_TEST(ghosted.size() == indices.n_elements());
          for (const auto i : indices)
            BOOST_TEST(ghosted(i) == factor * (1. + i));
        }
    }
}

// A product is made again when the vector is another one, be it by its last digit.
BOOST_AUTO_TEST_CASE(products_are_those_of_the_vector)
{
  const CubeAbovePlane<3> cube(true, 3);
  const Body<3>           body = cube_body(cube, {});
  const BodyMatrix        mass = assemble_mass_matrix(body, 20.);
  const KnownProduct      momentum(mass);
  Vector                  velocity = body.make_vector(), product(velocity);
  for (unsigned int i = 0; i < velocity.locally_owned_size(); ++i)
    velocity.trilinos_vector()[0][i] = .01 * i - 1.;
  const auto check = [&]() {
    mass.vmult(product, velocity);
    product -= momentum.with(velocity);
    BOOST_CHECK_EQUAL(product.linfty_norm(), 0.);
  };
  check();
  check();
  const unsigned int last = velocity.locally_owned_size() - 1;
  velocity.trilinos_vector()[0][last] += 1e-3;
  check();
}

BOOST_AUTO_TEST_SUITE_END()
