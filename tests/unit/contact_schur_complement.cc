// SPDX-License-Identifier: LGPL-2.1-or-later

// The basis of condensed stages: triangular solves of a Cholesky factorisation, whole and
// in part, and the contact Schur complement, each against the matrix itself; norms of
// sums of rows, and accelerations.

#include "condensed_solution.h"
#include "meshes.h"

#include <base/exceptions.h>
#include <base/ghosted_vector.h>
#include <base/vector_operations.h>
#include <discretization/linear_bulk.h>
#include <solvers/contact_schur_complement.h>
#include <solvers/mass_solver.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <boost/test/data/test_case.hpp>
#include <boost/test/unit_test.hpp>

#include <numeric>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(contact_schur_complement)

namespace
{
  const LinearElastic material{1.5, 1.};

  Body<3>
  cube_body(const CubeAbovePlane<3>                    &cube,
            const std::set<dealii::types::boundary_id> &clamped,
            const MPI_Comm                              communicator)
  {
    return {cube.triangulation,
            2,
            clamped,
            {1},
            MultiplierSpace::none,
            communicator};
  }

  /// Each row has a few neighbouring unknowns, the rows are far apart.
  Functionals
  some_rows(const unsigned int n,
            const unsigned int first,
            const unsigned int n_unknowns)
  {
    Functionals rows;
    for (unsigned int f = 0; f < n; ++f)
      {
        for (unsigned int k = 0; k < 4; ++k)
          rows.add((first + 97 * f + 3 * k) % n_unknowns, 1. + .3 * f - .7 * k);
        rows.end_functional();
      }
    return rows;
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

  double
  product(const Functionals         &rows,
          const unsigned int         f,
          const std::vector<double> &solution)
  {
    double sum = 0.;
    for (std::size_t k = rows.begin[f]; k < rows.begin[f + 1]; ++k)
      sum += rows.value[k] * solution[rows.index[k]];
    return sum;
  }

  /// matrix^{-1} @p right_hand_side by the factors, which is checked.
  std::vector<double>
  checked_solution(const Matrix                                &matrix,
                   const TriangularSolves                      &factor,
                   const dealii::TrilinosWrappers::MPI::Vector &right_hand_side,
                   const double                                 tolerance)
  {
    std::vector<double> forward, solution(matrix.m());
    factor.forward(local_values(right_hand_side), forward);
    factor.backward(forward, solution.data());
    Ricochet::Vector as_vector(right_hand_side), rest(right_hand_side);
    std::copy(solution.begin(), solution.end(), as_vector.begin());
    matrix.vmult(rest, as_vector);
    rest -= right_hand_side;
    BOOST_CHECK_LT(rest.linfty_norm(),
                   tolerance * right_hand_side.linfty_norm());
    return solution;
  }
} // namespace

// l . A^{-1} r is the product of the forward solves of l and r; a region of the
// unknowns is solved for by a part of the factors; and sums of rows whose forward solves
// are known are added. The same where some unknowns have a negative matrix of their own,
// as multipliers of the augmented Lagrangian, and in single precision.
BOOST_DATA_TEST_CASE(triangular_solves,
                     boost::unit_test::data::make({false, true}) *
                       boost::unit_test::data::make({false, true}),
                     has_negative,
                     is_single)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3> cube(true, 5);
  const Body<3>           body = cube_body(cube, {}, MPI_COMM_WORLD);
  const LinearBulk<3>     bulk(body, material);
  Matrix                  matrix;
  matrix.reinit(body.sparsity_pattern());
  assemble_mass_matrix(body, 1.).add_to(20., matrix);
  bulk.add_tangent(1., body.make_vector(), matrix);
  if (has_negative)
    make_some_negative(matrix);
  SparseCholesky cholesky(is_single ? SparseCholesky::Kind::frozen_tangent
                                    : SparseCholesky::Kind::exact);
  BOOST_REQUIRE(cholesky.factorise(matrix));
  const TriangularSolves &factor    = cholesky.factor();
  const double            tolerance = is_single ? 1e-5 : 1e-12;

  constexpr unsigned int n_left = 5, n_right = 16;
  const Functionals      left = some_rows(n_left, 11, matrix.m()),
                    right     = some_rows(n_right, 1204, matrix.m());
  const auto numbers          = [](const unsigned int n) {
    std::vector<unsigned int> all(n);
    std::iota(all.begin(), all.end(), 0U);
    return all;
  };
  const auto left_forward          = factor.forward(left, numbers(n_left)),
             right_forward         = factor.forward(right, numbers(n_right));
  constexpr unsigned int n_columns = TriangularSolves::n_columns;
  BOOST_CHECK_LT(left_forward.values.size(), n_columns * matrix.m());
  std::vector<double> products;
  factor.multiply(left_forward, right_forward, products);
  for (unsigned int r = 0; r < n_right; ++r)
    {
      Vector right_hand_side = body.make_vector();
      for (std::size_t k = right.begin[r]; k < right.begin[r + 1]; ++k)
        right_hand_side(right.index[k]) += right.value[k];
      right_hand_side.compress(VectorOperation::add);
      const auto solution =
        checked_solution(matrix, factor, right_hand_side, tolerance);
      const double size = 1e-3 * right_hand_side.linfty_norm();
      for (unsigned int l = 0; l < n_left; ++l)
        BOOST_CHECK_SMALL(products[l * n_columns + r] -
                            product(left, l, solution),
                          (is_single ? 1e-4 : 1e-10) * size);

      // In a region.
      std::vector<double> forward, part;
      factor.forward(local_values(right_hand_side), forward);
      const std::vector<TriangularSolves::Index> unknowns(left.index.begin(),
                                                          left.index.end());
      factor.backward(forward, factor.region_of(unknowns), part);
      for (const auto unknown : unknowns)
        BOOST_CHECK_SMALL(part[factor.place_of(unknown)] - solution[unknown],
                          (is_single ? 1e-4 : 1e-10) * size);

      // Nothing is left when the row is taken off again.
      std::vector<double> coefficients(n_columns);
      coefficients[r] = -1.;
      factor.add(right_forward, coefficients.data(), forward);
      for (const double value : forward)
        BOOST_CHECK_SMALL(value, 1e-12 * right_hand_side.linfty_norm());
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
BOOST_AUTO_TEST_CASE(full_matrices)
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
      SparseCholesky cholesky(SparseCholesky::Kind::exact);
      BOOST_REQUIRE(cholesky.factorise(matrix));
      Vector right_hand_side(dealii::complete_index_set(n), MPI_COMM_WORLD);
      randomise(right_hand_side, 1., 3);
      checked_solution(matrix, cholesky.factor(), right_hand_side, 1e-11);
    }
}

// One that is not symmetric is refused, unless its symmetric part will do; one that is
// indefinite is not.
BOOST_AUTO_TEST_CASE(other_matrices)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3> cube(true, 2);
  const Body<3>           body = cube_body(cube, {}, MPI_COMM_WORLD);
  Matrix                  matrix;
  matrix.reinit(body.sparsity_pattern());
  assemble_mass_matrix(body, 1.).add_to(20., matrix);
  const auto factorise = [&](const SparseCholesky::Kind kind) {
    return SparseCholesky(kind).factorise(matrix);
  };
  BOOST_CHECK(factorise(SparseCholesky::Kind::exact));
  auto entry = matrix.begin();
  while (entry->row() == entry->column() || entry->value() == 0.)
    ++entry;
  const double value = entry->value();
  entry->value()     = .9 * value;
  BOOST_CHECK(!factorise(SparseCholesky::Kind::exact));
  BOOST_CHECK(factorise(SparseCholesky::Kind::frozen_tangent));
  entry->value() = value;
  matrix.set(entry->row(), entry->row(), -1.);
  matrix.compress(VectorOperation::insert);
  SparseCholesky cholesky(SparseCholesky::Kind::exact);
  BOOST_REQUIRE(cholesky.factorise(matrix));
  Vector right_hand_side = body.make_vector();
  randomise(right_hand_side, 1., 3);
  checked_solution(matrix, cholesky.factor(), right_hand_side, 1e-10);
}

// Solutions with a change along the rows, by coefficients alone, before and after the
// body becomes another one, and with more rows than a group has. Also where one to five
// rows look at the same others and have different values, as the components of nodes that
// touch, and where rows of the body are taken out.
BOOST_DATA_TEST_CASE(contact_is_solved_for_alone,
                     boost::unit_test::data::make({false, true}) *
                       boost::unit_test::data::make({false, true}),
                     has_clusters,
                     eliminates_rows)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3>       cube(true, 3);
  const Body<3>                 body = cube_body(cube, {}, MPI_COMM_WORLD);
  const LinearBulk<3>           bulk(body, material);
  constexpr unsigned int        n = 90;
  ContactStructure::ActsThrough contact;
  for (unsigned int f = 0; f < n; ++f)
    {
      contact.functionals.add(10 * f, 1.);
      contact.functionals.end_functional();
      contact.order.push_back((7 * f) % 11);
    }
  std::vector<FunctionalRow> change(n), excess_change(n);
  for (unsigned int f = 0; f < n; ++f)
    {
      change[f] = {{f, 3. + f}};
      if (eliminates_rows && f % 3 == 0)
        excess_change[f] = {{f, -.6}};
    }
  unsigned int size = 1;
  for (unsigned int first = 0; has_clusters && first < n; first += size)
    {
      size = 1 + size % 5;
      for (unsigned int f = first; f < std::min(first + size, n); ++f)
        {
          change[f].clear();
          for (unsigned int other = first; other < std::min(first + 8, n);
               ++other)
            change[f].emplace_back(other,
                                   (f == other ? 3. + f : 0.) +
                                     std::sin(5. * f + other));
        }
    }
  // Some open ones.
  for (const unsigned int f : {4, 5, 50})
    {
      change[f].clear();
      excess_change[f].clear();
    }
  TangentSolver::Costs   spent;
  ContactSchurComplement complement(contact,
                                    SparseCholesky::Kind::exact,
                                    spent);
  for (const double stiffness : {1., 5.})
    {
      Tangent tangent;
      tangent.assemble_body = [&](Matrix &matrix) {
        matrix.reinit(body.sparsity_pattern());
        assemble_mass_matrix(body, 1.).add_to(20., matrix);
        bulk.add_tangent(stiffness, body.make_vector(), matrix);
      };
      tangent.add_open_contact = [](Matrix &) {};
      complement.factorise(tangent);
      Vector right_hand_side = body.make_vector(), solution(right_hand_side),
             rest(right_hand_side);
      randomise(right_hand_side, 1., 4);

      solve_condensed(complement,
                      change,
                      excess_change,
                      right_hand_side,
                      solution);

      Matrix body_matrix;
      tangent.assemble_body(body_matrix);
      body_matrix.vmult(rest, solution);
      const Vector of_body(rest);
      for (unsigned int f = 0; f < n; ++f)
        {
          double sum = 0.;
          for (const auto &[g, value] : change[f])
            sum += value * solution(10 * g);
          for (const auto &[g, value] : excess_change[f])
            sum += value * of_body(10 * g);
          rest(10 * f) += sum;
        }
      rest -= right_hand_side;
      BOOST_CHECK_SMALL(rest.linfty_norm(), 1e-10);
    }
  // A row that is taken out, and nothing in its place.
  change.assign(n, {});
  excess_change.assign(n, {});
  excess_change[8] = {{8, -1.}};
  BOOST_CHECK_THROW(complement.set_contact(change, excess_change),
                    NewtonFailure);
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
                             : std::set<dealii::types::boundary_id>{},
                  MPI_COMM_WORLD);
      const BodyMatrix       mass = assemble_mass_matrix(body, 1.7);
      const dealii::IndexSet constrained =
        constrained_indices(body.constraints(), body.owned_indices());
      const std::vector<MassSolver::Index> clamped(constrained.begin(),
                                                   constrained.end());
      const MassSolver                     solver(mass, clamped);
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
  const Body<3>           body  = cube_body(cube, {}, MPI_COMM_WORLD);
  const BodyMatrix        none  = assemble_mass_matrix(body, 0.);
  Vector                  force = body.make_vector(), acceleration(force);
  force                         = 1.;
  BOOST_CHECK_THROW(MassSolver(none, {}).solve(force, acceleration),
                    NewtonFailure);
}

// The norm of a sum of rows, some of which have common unknowns, is that of the
// summed vector.
BOOST_AUTO_TEST_CASE(norms_of_sums_of_rows)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const CubeAbovePlane<3>       cube(true, 3);
  const Body<3>                 body  = cube_body(cube, {}, MPI_COMM_WORLD);
  const auto                   &owned = body.owned_indices();
  const unsigned int            n     = 6;
  ContactStructure::ActsThrough contact;
  std::vector<double>           coefficients;
  Vector                        sum = body.make_vector(), scaling(sum);
  for (unsigned int i = 0; i < scaling.locally_owned_size(); ++i)
    local_values(scaling)[i] = 1. + i % 7;
  for (unsigned int f = 0; f < n; ++f)
    {
      coefficients.push_back(f == 2 ? 0. : 1.5 - f);
      contact.order.push_back(0.);
      for (unsigned int k = 0; k < 4; ++k)
        contact.functionals.add((3 * f + 5 * k) % owned.n_elements(),
                                1. + f - .3 * k);
      contact.functionals.end_functional();
    }
  TangentSolver::Costs   spent;
  ContactSchurComplement complement(contact,
                                    SparseCholesky::Kind::exact,
                                    spent);
  complement.add_rows(coefficients, sum);
  BOOST_CHECK_CLOSE(complement.norm_of_rows(coefficients, nullptr),
                    sum.l2_norm(),
                    1e-12);
  sum.scale(scaling);
  BOOST_CHECK_CLOSE(complement.norm_of_rows(coefficients, &scaling),
                    sum.l2_norm(),
                    1e-12);
}

// All values of this rank, in their order, or some of them and of other ranks'.
BOOST_AUTO_TEST_CASE(ghosted_values_are_those_of_the_vector)
{
  const CubeAbovePlane<3> cube(true, 3);
  const Body<3>           body   = cube_body(cube, {}, MPI_COMM_WORLD);
  Vector                  vector = body.make_vector();
  dealii::IndexSet        some(vector.size());
  for (dealii::types::global_dof_index i = 1; i < vector.size(); i += 3)
    some.add_index(i);
  for (const auto &indices : {body.owned_indices(), some})
    {
      GhostedVector ghosted(indices);
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

BOOST_AUTO_TEST_SUITE_END()
