// SPDX-License-Identifier: LGPL-2.1-or-later

// Set-up and run of an impact: refused input, and files saved after an
// unforeseen failure.

#include "meshes.h"

#include <base/exceptions.h>
#include <output/node_probe.h>
#include <problems/ball_mesh.h>
#include <problems/gmsh_mesh.h>
#include <problems/impact.h>
#include <problems/round_meshes.h>

#include <deal.II/distributed/tria.h>

#include <boost/test/unit_test.hpp>

#include <unistd.h>

#include <filesystem>

using namespace Ricochet;

namespace
{
  Impact<1>
  make_bar(const CubeAbovePlane<1>         &bar,
           const dealii::types::boundary_id clamped)
  {
    ImpactParameters parameters;
    parameters.contact.treatment = "penalty";
    return Impact<1>(
      parameters,
      bar.triangulation,
      ImpactSetup<1>{LinearElastic{0., .5}, 1., 1, {clamped}, bar.plane(.1)},
      MPI_COMM_WORLD);
  }
} // namespace


BOOST_AUTO_TEST_SUITE(impact)

// Boundary 1 faces the plane, 2 is the other end.
BOOST_AUTO_TEST_CASE(boundaries_that_the_mesh_has_not_are_refused)
{
  const CubeAbovePlane<1> bar(false, 8);
  BOOST_CHECK_NO_THROW(make_bar(bar, 2));
  BOOST_CHECK_THROW(make_bar(bar, 7), InputError);
  ImpactParameters parameters;
  BOOST_CHECK_THROW(Impact<1>(parameters,
                              bar.triangulation,
                              ImpactSetup<1>{LinearElastic{0., .5},
                                             1.,
                                             1,
                                             {},
                                             {{5, bar.plane(.1).at(1)}}},
                              MPI_COMM_WORLD),
                    InputError);
}

// An error of a library in the middle of a run is not one of ours; the
// checkpoint and the energy table are saved all the same.
BOOST_AUTO_TEST_CASE(errors_that_nobody_foresaw_leave_a_checkpoint)
{
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("ricochet-impact-" + std::to_string(::getpid())))
                             .string();
  {
    const CubeAbovePlane<1> bar(false, 8);
    Impact<1>               impact = make_bar(bar, 2);
    RunFolder               folder({path, "unit_tests", "", false, false, true},
                     MPI_COMM_WORLD);
    TimeLoop::Parameters    parameters;
    parameters.time_step    = .1;
    parameters.final_time   = 1.;
    parameters.fields_every = 3;
    TimeLoop loop(parameters,
                  folder,
                  impact.system,
                  *impact.scheme,
                  {{1, "plane"}});
    loop.write_fields = [](const State &, const unsigned int step) {
      if (step == 6)
        throw std::logic_error("an error of a library");
    };
    BOOST_CHECK_THROW(loop.run(
                        impact.state_in_flight(dealii::Tensor<1, 1>({-.5}))),
                      std::logic_error);
    BOOST_CHECK_EQUAL(loop.energy_ledger().rows().size(), 7);
    for (const std::string name : {"checkpoint.bin", "energy.h5", "energy.csv"})
      BOOST_CHECK(std::filesystem::exists(folder.file(name)));
  }
  std::filesystem::remove_all(path);
}

BOOST_AUTO_TEST_SUITE_END()


namespace
{
  double
  area_of(const dealii::Triangulation<2> &mesh)
  {
    double area = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      area += cell->measure();
    return area;
  }
} // namespace


BOOST_AUTO_TEST_SUITE(round_meshes)

// The area of a polygon of n edges with the radius r is n/2 r^2 sin(2 pi/n).
BOOST_AUTO_TEST_CASE(areas_by_hand)
{
  const unsigned int n      = 24;
  const double       factor = .5 * n * std::sin(2. * dealii::numbers::PI / n);
  for (const CellShape shape :
       {CellShape::triangles, CellShape::quadrilaterals})
    {
      dealii::Triangulation<2> ring;
      make_ring(dealii::Point<2>(3., 1.), .8, 1., n, 4, shape, ring);
      BOOST_CHECK_EQUAL(ring.n_vertices(), 4 * n);
      BOOST_CHECK_CLOSE(area_of(ring), factor * (1. - .64), 1e-10);
    }
  dealii::Triangulation<2> disk;
  make_disk_of_triangles(dealii::Point<2>(3., 1.), 2., n, 61, disk);
  BOOST_CHECK_EQUAL(disk.n_vertices(), 61u);
  BOOST_CHECK_CLOSE(area_of(disk), factor * 4., 1e-10);
}

// Cells of meshes from Gmsh have numbers near those of their neighbours: on the mean over
// all pairs they are 0.03 of the number of cells apart, in Gmsh's own order 0.2.
BOOST_AUTO_TEST_CASE(neighbours_have_near_numbers)
{
  const auto distance = [](const dealii::Triangulation<3> &mesh) {
    double sum = 0., n_pairs = 0.;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto f : cell->face_indices())
        if (!cell->at_boundary(f))
          {
            sum += std::abs(1. * cell->active_cell_index() -
                            cell->neighbor(f)->active_cell_index());
            ++n_pairs;
          }
    return sum / n_pairs / mesh.n_active_cells();
  };
  dealii::Triangulation<3> made, read;
  make_ball_of_tetrahedra(dealii::Point<3>(), 1., .15, made);
  BOOST_CHECK_LT(distance(made), .1);
  read_gmsh_mesh(RICOCHET_MESHES "/sphere_h4.msh", read);
  BOOST_CHECK_LT(distance(read), .1);
  BOOST_TEST_MESSAGE("neighbours: " << distance(made) << ", "
                                    << distance(read));
}

BOOST_AUTO_TEST_SUITE_END()


BOOST_AUTO_TEST_SUITE(node_probe)

// On any number of ranks the node is the nearest of all, and not of one rank's
// part: values that are the coordinates identify it.
BOOST_AUTO_TEST_CASE(the_nearest_node_of_all)
{
  // A mesh of which each rank has its part and a ghost layer only.
  dealii::parallel::distributed::Triangulation<2> mesh(MPI_COMM_WORLD);
  dealii::GridGenerator::hyper_cube(mesh);
  mesh.refine_global(3);
  const Body<2> body(mesh, 1, {}, {0}, MultiplierSpace::none, MPI_COMM_WORLD);
  Vector        positions;
  body.interpolate(dealii::FunctionFromFunctionObjects<2>(
                     {[](const dealii::Point<2> &x) { return x[0]; },
                      [](const dealii::Point<2> &x) { return x[1]; }}),
                   positions);
  for (const dealii::Point<2> &corner : {dealii::Point<2>(0., 0.),
                                         dealii::Point<2>(1., 0.),
                                         dealii::Point<2>(0., 1.),
                                         dealii::Point<2>(1., 1.)})
    {
      const NodeProbe<2> probe(body, corner);
      for (unsigned int c = 0; c < 2; ++c)
        BOOST_CHECK_SMALL(probe.value(positions, c) - corner[c], 1e-14);
    }
  // In the middle of cells of 1/8, where ranks meet and elsewhere, all corners are as near.
  for (const double x : {.4375, .0625, .9375})
    for (const double y : {.4375, .5625})
      {
        const NodeProbe<2> probe(body, dealii::Point<2>(x, y));
        BOOST_CHECK_SMALL(probe.value(positions, 0) - (x - .0625), 1e-14);
        BOOST_CHECK_SMALL(probe.value(positions, 1) - (y - .0625), 1e-14);
      }
}

BOOST_AUTO_TEST_SUITE_END()
