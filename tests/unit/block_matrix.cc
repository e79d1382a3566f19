// SPDX-License-Identifier: LGPL-2.1-or-later

// Matrices of bodies by blocks between nodes do what the same matrices by entries do, in
// double precision to round-off and in single precision to its own.

#include "meshes.h"

#include <base/vector_operations.h>
#include <discretization/linear_bulk.h>
#include <solvers/single_finest_level.h>
#include <solvers/single_tangent.h>

#include <ml_MultiLevelPreconditioner.h>

#include <boost/test/unit_test.hpp>


using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(block_matrix)

namespace
{
  const LinearElastic material{1.5, 1.};

  /// The l2 norm of the difference, relative to that of @p exact.
  double
  difference(const Vector &found, const Vector &exact)
  {
    Vector error(found);
    error -= exact;
    return error.l2_norm() / exact.l2_norm();
  }

  /// A body with stiffness and mass in both storage formats.
  template <int dim>
  struct StoredTwice
  {
    StoredTwice(const bool            simplices,
                const unsigned int    degree,
                const MultiplierSpace multipliers = MultiplierSpace::none)
      : cube(simplices, 3)
      , body(cube.triangulation, degree, {2}, {1}, multipliers, MPI_COMM_WORLD)
      , entries(body, {material})
      , blocks(body, {material}, MatrixStorage::blocks)
      , mass_by_entries(assemble_mass_matrix(body, {2.}))
      , mass_by_blocks(assemble_mass_matrix(body, {2.}, MatrixStorage::blocks))
    {}

    /// 3 K + 5 M, in either storage format.
    MatrixSum
    terms(const MatrixStorage storage) const
    {
      const bool by_blocks = storage == MatrixStorage::blocks;
      MatrixSum  sum       = (by_blocks ? blocks : entries).tangent_terms(3.);
      sum.push_back({5., by_blocks ? &mass_by_blocks : &mass_by_entries});
      return sum;
    }

    TangentOperator
    tangent() const
    {
      return {body.owned_indices(),
              constrained_indices(body.constraints(), body.owned_indices()),
              Functionals(),
              MPI_COMM_WORLD};
    }

    const CubeAbovePlane<dim> cube;
    const Body<dim>           body;
    const LinearBulk<dim>     entries, blocks;
    const BodyMatrix          mass_by_entries, mass_by_blocks;
  };

  template <int dim>
  void
  check_products(const StoredTwice<dim> &twice)
  {
    Vector vector = twice.body.make_vector(), exact(vector), found(vector);
    randomise(vector, 1., 1);

    const MatrixSum by_entries = twice.terms(MatrixStorage::entries),
                    by_blocks  = twice.terms(MatrixStorage::blocks);
    for (unsigned int k = 0; k < by_entries.size(); ++k)
      {
        const BodyMatrix &entries = *by_entries[k].matrix,
                         &blocks  = *by_blocks[k].matrix;
        BOOST_REQUIRE(entries.entries() && blocks.blocks());
        entries.vmult(exact, vector);
        blocks.vmult(found, vector);
        BOOST_CHECK_SMALL(difference(found, exact), 1e-14);
        BOOST_CHECK_CLOSE_FRACTION(blocks.linfty_norm(),
                                   entries.linfty_norm(),
                                   1e-13);
        BOOST_CHECK_EQUAL(blocks.m(), entries.m());

        // As a matrix with entries.
        Matrix copy;
        blocks.copy_to(copy);
        copy.vmult(found, vector);
        BOOST_CHECK_SMALL(difference(found, exact), 1e-14);
        blocks.add_to(-1., copy);
        BOOST_CHECK_SMALL(copy.linfty_norm(), 1e-13);

        exact = 1.;
        found = 1.;
        entries.add_diagonal(2., exact);
        blocks.add_diagonal(2., found);
        BOOST_CHECK_SMALL(difference(found, exact), 1e-14);
      }
    twice.entries.force(vector, exact);
    twice.blocks.force(vector, found);
    BOOST_CHECK_SMALL(difference(found, exact), 1e-13);
  }



  template <int dim>
  void
  check_storage(const bool simplices, const unsigned int degree)
  {
    const StoredTwice<dim> twice(simplices, degree);
    check_products(twice);
    Vector vector = twice.body.make_vector(), exact(vector), found(vector);
    randomise(vector, 1., 1);
    const MatrixSum by_entries = twice.terms(MatrixStorage::entries),
                    by_blocks  = twice.terms(MatrixStorage::blocks);

    // The sum, in one sweep, with clamped unknowns; and in single precision, from
    // either.
    TangentOperator exact_tangent = twice.tangent(), tangent = twice.tangent();
    exact_tangent.set_terms(by_entries);
    tangent.set_terms(by_blocks);
    for (TangentOperator *one : {&exact_tangent, &tangent})
      one->set_change({});
    exact_tangent.vmult(exact, vector);
    tangent.vmult(found, vector);
    BOOST_CHECK_SMALL(difference(found, exact), 1e-14);
    for (const TangentOperator *one : {&exact_tangent, &tangent})
      {
        SingleTangent single;
        single.set_body(*one, dim);
        single.set_contact(*one);
        SingleTangent::VectorType argument, result;
        single.initialize_dof_vector(argument);
        single.initialize_dof_vector(result);
        for (const auto i : twice.body.owned_indices())
          argument(i) = static_cast<float>(vector(i));
        single.vmult(result, argument);
        for (const auto i : twice.body.owned_indices())
          found(i) = result(i) / single.factor();
        found.compress(VectorOperation::insert);
        BOOST_CHECK_SMALL(difference(found, exact), 1e-6);
        // Not by chance: single it is.
        BOOST_CHECK_GT(difference(found, exact), 1e-10);
      }
  }
} // namespace



BOOST_AUTO_TEST_CASE(blocks_do_what_entries_do)
{
  for (const bool simplices : {false, true})
    for (const unsigned int degree : {1, 2})
      {
        check_storage<2>(simplices, degree);
        check_storage<3>(simplices, degree);
      }
}

// On one rank multipliers may stand behind the nodes, with rows and columns of zeros.
BOOST_AUTO_TEST_CASE(multipliers_are_behind_blocks)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const StoredTwice<2> plane(true, 2, MultiplierSpace::nodal);
  check_products(plane);
  const StoredTwice<3> space(false, 1, MultiplierSpace::nodal_vector);
  BOOST_REQUIRE_GT(space.body.multiplier_indices().n_elements(), 0);
  check_products(space);
}

BOOST_AUTO_TEST_CASE(blocks_take_less_memory)
{
  // Couplings between ranks are stored on both.
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  const StoredTwice<3> twice(true, 2);
  const auto bytes = [&](const MatrixStorage storage, const unsigned int term) {
    return static_cast<double>(
      twice.terms(storage)[term].matrix->memory_consumption());
  };
  BOOST_CHECK_LT(bytes(MatrixStorage::blocks, 0),
                 .4 * bytes(MatrixStorage::entries, 0));
}

// The finest level of ML: the symmetric part, with entries that are on one side of the
// diagonal only, in single precision, for vectors of any size; and then as it was.
BOOST_AUTO_TEST_CASE(finest_level_in_single_precision)
{
  const auto [n_ranks, rank] =
    std::make_pair(dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD),
                   dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD));
  // Two nodes on each rank.
  const unsigned int first = 6 * rank;
  dealii::IndexSet   owned(6 * n_ranks);
  owned.add_range(first, first + 6);
  dealii::TrilinosWrappers::SparsityPattern pattern(owned, MPI_COMM_WORLD, 6);
  const std::vector<std::tuple<unsigned int, unsigned int, double>> others =
    {{0, 4, 1e7}, {5, 1, -2e7}, {0, 1, 3e7}, {4, 5, 4e7}};
  for (unsigned int i = 0; i < 6; ++i)
    pattern.add(first + i, first + i);
  for (const auto &[i, j, value] : others)
    pattern.add(first + i, first + j);
  // Nodes of the ranks before and after, too.
  std::vector<unsigned int> beyond;
  if (rank > 0)
    beyond.push_back(first - 6);
  if (rank + 1 < n_ranks)
    beyond.push_back(first + 6);
  for (const unsigned int j : beyond)
    pattern.add(first, j);
  pattern.compress();
  Matrix matrix;
  matrix.reinit(pattern);
  for (unsigned int i = 0; i < 6; ++i)
    matrix.set(first + i, first + i, 1e8 + i);
  for (const auto &[i, j, value] : others)
    matrix.set(first + i, first + j, value);
  for (const unsigned int j : beyond)
    matrix.set(first, j, 5e7);
  matrix.compress(VectorOperation::insert);

  Teuchos::ParameterList list;
  ML_Epetra::SetDefaults("SA", list);
  list.set("ML output", 0);
  list.set("PDE equations", 3);
  dealii::TrilinosWrappers::PreconditionAMG aggregation;
  aggregation.initialize(matrix.trilinos_matrix(), list);
  const ML *hierarchy =
    dynamic_cast<const ML_Epetra::MultiLevelPreconditioner &>(
      aggregation.trilinos_operator())
      .GetML();
  ML_Operator *level = &hierarchy->Amat[hierarchy->ML_finest_level];

  Vector vector(owned, MPI_COMM_WORLD), product(vector), transposed(vector),
    found(vector);
  const auto multiply = [&]() {
    level->matvec->func_ptr(level,
                            6,
                            local_values(vector),
                            6,
                            local_values(found));
  };
  for (const double size : {1., 1e-60, 1e60})
    {
      // Not of one size on all ranks.
      randomise(vector, size * std::pow(1e-3, rank), 3);
      matrix.vmult(product, vector);
      matrix.Tvmult(transposed, vector);
      product.sadd(.5, .5, transposed);
      SingleFinestLevel single(aggregation,
                               MatrixEntries(matrix),
                               3,
                               MPI_COMM_WORLD);
      multiply();
      BOOST_CHECK_SMALL(difference(found, product), 1e-6);
      BOOST_CHECK_GT(difference(found, product), 1e-12);
    }
  matrix.vmult(product, vector);
  multiply();
  BOOST_CHECK_SMALL(difference(found, product), 1e-15);
}

BOOST_AUTO_TEST_SUITE_END()
