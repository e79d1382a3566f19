// SPDX-License-Identifier: LGPL-2.1-or-later

// The redistributed mass keeps mass, centre of mass and moments of inertia, has
// no inertia on the contact boundary, and is positive definite off it.

#include "meshes.h"

#include <base/exceptions.h>
#include <discretization/linear_bulk.h>
#include <time_integration/mass_redistribution.h>

#include <Eigen/Eigenvalues>
#include <boost/test/unit_test.hpp>

#include <map>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(mass_redistribution)

namespace
{
  template <int dim>
  void
  check(const bool simplices, const unsigned int degree, const unsigned int n)
  {
    const CubeAbovePlane<dim> cube(simplices, n);
    const Body<dim>           body(cube.triangulation,
                         degree,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
    const double              density = 3.;
    const BodyMatrix          mass    = assemble_mass_matrix(body, density);
    const Matrix redistributed = redistribute_mass(body, *mass.entries());

    const auto before = mass_moments(body, *mass.entries()).at(0);
    const auto after  = mass_moments(body, redistributed).at(0);
    BOOST_CHECK_SMALL(before[0] - density, 1e-12);
    BOOST_CHECK_SMALL(before[1] - density / 2., 1e-12);
    BOOST_CHECK_SMALL(before[1 + dim] - density / 3., 1e-12);
    for (unsigned int k = 0; k < before.size(); ++k)
      BOOST_CHECK_SMALL(before[k] - after[k], 1e-11);

    for (const auto i : body.contact_indices())
      for (auto entry = redistributed.begin(i); entry != redistributed.end(i);
           ++entry)
        BOOST_CHECK_EQUAL(entry->value(), 0.);

    // Eigenvalues need the whole matrix on one rank.
    if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
      return;
    // The components do not couple and are alike: the first one is enough.
    const unsigned int                   n_nodes = redistributed.m() / dim;
    std::map<unsigned int, unsigned int> node;
    std::vector<dealii::types::global_dof_index> dofs(
      body.dof_handler().get_fe().n_dofs_per_cell());
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        cell->get_dof_indices(dofs);
        for (unsigned int i = 0; i < dofs.size(); ++i)
          if (body.dof_handler().get_fe().system_to_component_index(i).first ==
              0)
            node.emplace(dofs[i], node.size());
      }
    BOOST_REQUIRE_EQUAL(node.size(), n_nodes);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n_nodes, n_nodes);
    for (const auto &[dof, i] : node)
      for (auto entry = redistributed.begin(dof);
           entry != redistributed.end(dof);
           ++entry)
        if (node.count(entry->column()) != 0)
          dense(i, node[entry->column()]) = entry->value();
    BOOST_CHECK_SMALL((dense - dense.transpose()).norm(), 1e-12);
    // On the contact boundary, ones in place of the zeros.
    for (const auto i : body.contact_indices())
      if (node.count(i) != 0)
        dense(node[i], node[i]) = 1.;
    BOOST_CHECK_GT(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense,
                                                     Eigen::EigenvaluesOnly)
        .eigenvalues()[0],
      0.);
  }

  /// The boundary id 1 for the end of a bar that lies at x = 0.
  void
  touch_at_the_origin(dealii::Triangulation<1> &mesh)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->center()[0] < 1e-9 ? 1 : 0);
  }
} // namespace



BOOST_AUTO_TEST_CASE(moments_in_1d)
{
  // deal.II has boundary ids of points; the mesh is the bar of the benchmarks.
  check<1>(false, 1, 20);
  check<1>(false, 2, 10);
}

BOOST_AUTO_TEST_CASE(moments_in_2d)
{
  check<2>(false, 1, 6);
  check<2>(true, 1, 6);
  check<2>(false, 2, 4);
}

BOOST_AUTO_TEST_CASE(moments_in_3d)
{
  check<3>(false, 1, 6);
  check<3>(true, 1, 8);
}

BOOST_AUTO_TEST_CASE(where_the_nearest_matrix_is_indefinite)
{
  // Its smallest eigenvalue is negative on these meshes; that of the one which
  // is nearest relative to the entries is not.
  check<3>(true, 1, 4);
  check<3>(true, 2, 3);
}

// Each body keeps its own moments, even when the other one has no contact
// boundary: two bars of 1 kg/m, of which only the first touches.
BOOST_AUTO_TEST_CASE(moments_are_those_of_each_body)
{
  dealii::Triangulation<1> first, second, both;
  dealii::GridGenerator::subdivided_hyper_cube(first, 8, 0., 1.);
  dealii::GridGenerator::subdivided_hyper_cube(second, 16, 5., 7.);
  dealii::GridGenerator::merge_triangulations(first, second, both, 1e-6);
  dealii::parallel::shared::Triangulation<1> mesh(MPI_COMM_WORLD);
  mesh.copy_triangulation(both);
  touch_at_the_origin(mesh);
  const Body<1> body(mesh, 1, {}, {1}, MultiplierSpace::none, MPI_COMM_WORLD);
  const BodyMatrix mass = assemble_mass_matrix(body, 1.);
  const auto       redistributed =
    mass_moments(body, redistribute_mass(body, *mass.entries()));
  BOOST_REQUIRE_EQUAL(redistributed.size(), 2);
  // Mass, integral of x and of x^2.
  const bool   first_is_short = redistributed[0][0] < 1.5;
  const auto  &of_first       = redistributed[first_is_short ? 0 : 1];
  const auto  &of_second      = redistributed[first_is_short ? 1 : 0];
  const double exact[2][3]    = {{1., .5, 1. / 3.}, {2., 12., 218. / 3.}};
  for (unsigned int k = 0; k < 3; ++k)
    {
      BOOST_CHECK_CLOSE(of_first[k], exact[0][k], 1e-9);
      BOOST_CHECK_CLOSE(of_second[k], exact[1][k], 1e-9);
    }
}

// A graded bar, cells from 1 to 1/1000 of the largest: without a preconditioner the
// test of definiteness took 574 iterations and gave up at 200.
BOOST_AUTO_TEST_CASE(graded_meshes_are_taken)
{
  std::vector<std::vector<double>> steps(1);
  const unsigned int               n = 60;
  for (unsigned int i = 0; i < n; ++i)
    steps[0].push_back(std::pow(1000., i / (n - 1.)));
  double length = 0.;
  for (const double step : steps[0])
    length += step;
  dealii::parallel::shared::Triangulation<1> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::subdivided_hyper_rectangle(mesh,
                                                    steps,
                                                    dealii::Point<1>(0.),
                                                    dealii::Point<1>(length));
  touch_at_the_origin(mesh);
  const Body<1> body(mesh, 1, {}, {1}, MultiplierSpace::none, MPI_COMM_WORLD);
  const BodyMatrix mass = assemble_mass_matrix(body, 1.);
  BOOST_CHECK_NO_THROW(redistribute_mass(body, *mass.entries()));
}

BOOST_AUTO_TEST_CASE(too_coarse_meshes_are_refused)
{
  const auto check_refused = [](auto cube, const unsigned int degree) {
    constexpr int    dim = decltype(cube.triangulation)::dimension;
    const Body<dim>  body(cube.triangulation,
                         degree,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
    const BodyMatrix mass = assemble_mass_matrix(body, 1.);
    BOOST_CHECK_THROW(redistribute_mass(body, *mass.entries()), InputError);
  };
  // One element: a single node is left, which cannot keep three moments. (One
  // element cannot be divided between two ranks.)
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == 1)
    check_refused(CubeAbovePlane<1>(false, 1), 1);
  // Enough nodes for the moments, but both matrices are indefinite.
  check_refused(CubeAbovePlane<2>(false, 3), 1);
}

BOOST_AUTO_TEST_SUITE_END()
