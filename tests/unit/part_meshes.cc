// SPDX-License-Identifier: LGPL-2.1-or-later

// Meshes of several parts: every number that can be computed by hand, no common
// vertices of parts even where they touch, and refused input.

#include <base/exceptions.h>
#include <problems/part_meshes.h>

#include <deal.II/distributed/shared_tria.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <set>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;
using dealii::Triangulation;
using dealii::numbers::PI;

BOOST_AUTO_TEST_SUITE(part_meshes)

namespace
{
  using Cell = Triangulation<2>::active_cell_iterator;

  /// Numbers of the vertices of a cell, counter-clockwise: deal.II counts those
  /// of a quadrilateral in a Z.
  std::vector<unsigned int>
  around(const Cell &cell)
  {
    if (cell->n_vertices() == 3)
      return {cell->vertex_index(0),
              cell->vertex_index(1),
              cell->vertex_index(2)};
    return {cell->vertex_index(0),
            cell->vertex_index(1),
            cell->vertex_index(3),
            cell->vertex_index(2)};
  }

  /// By hand, from the vertices, with its sign.
  double
  signed_area(const Triangulation<2>          &mesh,
              const std::vector<unsigned int> &vertices)
  {
    double area = 0.;
    for (unsigned int k = 0; k < vertices.size(); ++k)
      {
        const Point<2> &a = mesh.get_vertices()[vertices[k]];
        const Point<2> &b =
          mesh.get_vertices()[vertices[(k + 1) % vertices.size()]];
        area += .5 * (a[0] * b[1] - a[1] * b[0]);
      }
    return area;
  }

  struct Part
  {
    unsigned int           n_cells = 0;
    double                 area    = 0.;
    std::set<unsigned int> vertices;
  };

  /// Data of the cells of each material id; also a check that all are
  /// positively oriented.
  std::map<unsigned int, Part>
  parts_of(const Triangulation<2> &mesh)
  {
    std::map<unsigned int, Part> parts;
    for (const auto &cell : mesh.active_cell_iterators())
      {
        Part        &part     = parts[cell->material_id()];
        const auto   vertices = around(cell);
        const double area     = signed_area(mesh, vertices);
        BOOST_CHECK_GT(area, 0.);
        ++part.n_cells;
        part.area += area;
        part.vertices.insert(vertices.begin(), vertices.end());
      }
    return parts;
  }

  /// Parts 0 ... n-1, that have no vertex in common, and each vertex in one.
  void
  check_parts(const Triangulation<2>             &mesh,
              const std::map<unsigned int, Part> &parts,
              const unsigned int                  n)
  {
    BOOST_REQUIRE_EQUAL(parts.size(), n);
    BOOST_CHECK_EQUAL(parts.rbegin()->first, n - 1);
    std::set<unsigned int> all;
    std::size_t            sum = 0;
    for (const auto &entry : parts)
      {
        all.insert(entry.second.vertices.begin(), entry.second.vertices.end());
        sum += entry.second.vertices.size();
      }
    BOOST_CHECK_EQUAL(sum, all.size());
    BOOST_CHECK_EQUAL(sum, mesh.n_vertices());
  }

  /// By boundary id.
  std::map<unsigned int, double>
  boundary_lengths(const Triangulation<2> &mesh)
  {
    std::map<unsigned int, double> lengths;
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          lengths[face->boundary_id()] +=
            face->vertex(0).distance(face->vertex(1));
    return lengths;
  }

  /// In a mesh of triangles.
  bool
  has_edge(const Triangulation<2> &mesh,
           const unsigned int      a,
           const unsigned int      b)
  {
    for (const auto &cell : mesh.active_cell_iterators())
      {
        const auto                   vertices = around(cell);
        const std::set<unsigned int> set(vertices.begin(), vertices.end());
        if (set.count(a) && set.count(b))
          return true;
      }
    return false;
  }

  /// The first quadrilateral of a row of @p n_along nodes is cut from its lower
  /// left, the second, and the first of the second row, along the other
  /// diagonal. The first node of the part is @p begin.
  void
  check_diagonals(const Triangulation<2> &mesh,
                  const unsigned int      begin,
                  const unsigned int      n_along)
  {
    const auto node = [&](const unsigned int i, const unsigned int j) {
      return begin + j * n_along + i;
    };
    BOOST_CHECK(has_edge(mesh, node(0, 0), node(1, 1)));
    BOOST_CHECK(!has_edge(mesh, node(1, 0), node(0, 1)));
    BOOST_CHECK(has_edge(mesh, node(2, 0), node(1, 1)));
    BOOST_CHECK(!has_edge(mesh, node(1, 0), node(2, 1)));
    BOOST_CHECK(has_edge(mesh, node(1, 1), node(0, 2)));
    BOOST_CHECK(!has_edge(mesh, node(0, 1), node(1, 2)));
  }

  void
  check_position(const Triangulation<2> &mesh,
                 const unsigned int      vertex,
                 const Point<2>         &expected)
  {
    BOOST_CHECK_SMALL(mesh.get_vertices().at(vertex).distance(expected), 1e-13);
  }
} // namespace



BOOST_AUTO_TEST_CASE(ringed_disks_by_hand)
{
  for (const unsigned int n : {1, 2, 11})
    {
      // The second is turned, and they overlap: that is allowed in a mesh.
      const RingedDisk first{Point<2>(0., 3.), 2., n, 0.};
      const RingedDisk second{Point<2>(1., 0.), .5, n + 1, .3};
      Triangulation<2> mesh;
      make_ringed_disks({first, second}, mesh);
      const auto parts = parts_of(mesh);
      check_parts(mesh, parts, 2);
      const auto lengths = boundary_lengths(mesh);
      BOOST_CHECK_EQUAL(lengths.size(), 2u);

      unsigned int begin = 0;
      for (unsigned int p = 0; p < 2; ++p)
        {
          const RingedDisk  &disk = p == 0 ? first : second;
          const unsigned int m    = disk.n_rings;
          BOOST_CHECK_EQUAL(parts.at(p).vertices.size(), 1 + 3 * m * (m + 1));
          // Each ring adds 6 (2k - 1).
          BOOST_CHECK_EQUAL(parts.at(p).n_cells, 6 * m * m);
          BOOST_CHECK_CLOSE(parts.at(p).area,
                            3. * m * disk.radius * disk.radius *
                              std::sin(2. * PI / (6. * m)),
                            1e-10);
          BOOST_CHECK_CLOSE(lengths.at(p),
                            12. * m * disk.radius * std::sin(PI / (6. * m)),
                            1e-10);

          check_position(mesh, begin, disk.centre);
          for (unsigned int k = 1; k <= m; ++k)
            for (unsigned int j = 0; j < 6 * k; ++j)
              {
                const double angle = disk.angle + PI * j / (3. * k);
                check_position(mesh,
                               begin + 1 + 3 * k * (k - 1) + j,
                               disk.centre +
                                 disk.radius * k / m *
                                   Tensor<1, 2>(
                                     {std::cos(angle), std::sin(angle)}));
              }
          begin += 1 + 3 * m * (m + 1);
        }
    }
}

// The edges about some nodes of the third of three rings, as they are written
// in the definition: sector 1 begins at its node 3 and at node 2 of ring 2.
BOOST_AUTO_TEST_CASE(triangles_of_a_ringed_disk)
{
  Triangulation<2> mesh;
  make_ringed_disks({{Point<2>(), 1., 3, 0.}}, mesh);
  const auto node = [](const unsigned int ring, const unsigned int j) {
    return 1 + 3 * ring * (ring - 1) + j;
  };
  BOOST_CHECK(has_edge(mesh, node(3, 3), node(2, 2)));
  BOOST_CHECK(has_edge(mesh, node(3, 4), node(2, 2)));
  BOOST_CHECK(has_edge(mesh, node(3, 4), node(2, 3)));
  BOOST_CHECK(has_edge(mesh, node(3, 5), node(2, 3)));
  BOOST_CHECK(has_edge(mesh, node(3, 5), node(2, 4)));
  BOOST_CHECK(has_edge(mesh, node(3, 6), node(2, 4)));
  BOOST_CHECK(!has_edge(mesh, node(3, 3), node(2, 3)));
  BOOST_CHECK(!has_edge(mesh, node(3, 5), node(2, 2)));
  // Where the rings close.
  BOOST_CHECK(has_edge(mesh, node(3, 17), node(2, 0)));
  BOOST_CHECK(has_edge(mesh, node(3, 0), node(2, 0)));
  BOOST_CHECK(has_edge(mesh, node(3, 17), node(3, 0)));
  BOOST_CHECK(has_edge(mesh, node(1, 5), 0));
}

BOOST_AUTO_TEST_CASE(stent_and_artery_by_hand)
{
  using Geometry = StentArteryGeometry;
  Triangulation<2> mesh;
  make_stent_artery({}, mesh);
  const auto parts = parts_of(mesh);
  check_parts(mesh, parts, 2);
  BOOST_CHECK_EQUAL(mesh.n_vertices(), 1137u);
  BOOST_CHECK_EQUAL(parts.at(0).vertices.size(), 729u);
  BOOST_CHECK_EQUAL(parts.at(0).n_cells, 2u * 80u * 8u);
  BOOST_CHECK_EQUAL(parts.at(1).n_cells, 2u * 101u * 3u);
  BOOST_CHECK_CLOSE(parts.at(0).area, 20., 1e-10);
  // Whatever the wave, since the thickness is measured along y.
  BOOST_CHECK_CLOSE(parts.at(1).area, 12. * .2, 1e-10);

  const auto upper_side = [](const unsigned int i) {
    return Point<2>(4. + 12. * i / 101.,
                    -.05 - .15 * (1. + std::cos(10. * PI * i / 101.)));
  };
  double wave = 0.;
  for (unsigned int i = 0; i < 102; ++i)
    {
      check_position(mesh, 729 + 3 * 102 + i, upper_side(i));
      check_position(mesh, 729 + i, upper_side(i) - Tensor<1, 2>({0., .2}));
      if (i > 0)
        wave += upper_side(i - 1).distance(upper_side(i));
    }
  check_position(mesh, 0, Point<2>(0., 0.));
  check_position(mesh, 728, Point<2>(20., 1.));
  check_position(mesh, 2 * 81 + 3, Point<2>(.75, .25));
  check_position(mesh, 729, Point<2>(4., -.55));

  const auto lengths = boundary_lengths(mesh);
  BOOST_CHECK_EQUAL(lengths.size(), 6u);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::artery_inner_wall), 20., 1e-10);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::artery_outer_side), 20., 1e-10);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::artery_ends), 2., 1e-10);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::stent_upper_side), wave, 1e-10);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::stent_lower_side), wave, 1e-10);
  BOOST_CHECK_CLOSE(lengths.at(Geometry::stent_ends), .4, 1e-10);
  // Which of two sides of the same length is which.
  for (const auto &cell : mesh.active_cell_iterators())
    for (const auto &face : cell->face_iterators())
      if (face->at_boundary())
        {
          const unsigned int vertex = face->vertex_index(0);
          const double       y      = face->vertex(0)[1];
          if (face->boundary_id() == Geometry::artery_inner_wall)
            BOOST_CHECK_EQUAL(y, 0.);
          if (face->boundary_id() == Geometry::artery_outer_side)
            BOOST_CHECK_EQUAL(y, 1.);
          if (face->boundary_id() == Geometry::stent_lower_side)
            BOOST_CHECK(vertex >= 729 && vertex < 729 + 102);
          if (face->boundary_id() == Geometry::stent_upper_side)
            BOOST_CHECK(vertex >= 729 + 3 * 102);
        }

  check_diagonals(mesh, 0, 81);
  check_diagonals(mesh, 729, 102);
}

// Two pairs, one upon the other: a turn by a right angle changes places, and
// nothing else.
BOOST_AUTO_TEST_CASE(touching_rectangles_stay_apart)
{
  for (const CellShape shape :
       {CellShape::triangles, CellShape::quadrilaterals})
    for (const double angle : {0., .5 * PI})
      {
        Rectangle lower{Point<2>(1., 0.), Point<2>(4., 1.), {{3, 2}}};
        Rectangle upper{Point<2>(1., 1.), Point<2>(4., 3.), {{3, 2}}};
        lower.angle = upper.angle = angle;
        lower.shift = upper.shift = Tensor<1, 2>({10., -7.});
        Triangulation<2> mesh;
        make_rectangles({lower, upper}, shape, mesh);

        const auto parts = parts_of(mesh);
        check_parts(mesh, parts, 2);
        BOOST_CHECK_EQUAL(mesh.n_vertices(), 2u * 12u);
        // The upper side of one coincides with the lower of the other.
        for (unsigned int i = 0; i < 4; ++i)
          BOOST_CHECK_EQUAL(mesh.get_vertices()[8 + i].distance(
                              mesh.get_vertices()[12 + i]),
                            0.);
        for (unsigned int p = 0; p < 2; ++p)
          {
            BOOST_CHECK_EQUAL(parts.at(p).n_cells,
                              shape == CellShape::triangles ? 12u : 6u);
            BOOST_CHECK_CLOSE(parts.at(p).area, p == 0 ? 3. : 6., 1e-10);
          }

        const auto lengths = boundary_lengths(mesh);
        BOOST_CHECK_EQUAL(lengths.size(), 8u);
        for (unsigned int p = 0; p < 2; ++p)
          {
            BOOST_CHECK_CLOSE(lengths.at(rectangle_side(p, Rectangle::left)),
                              p + 1.,
                              1e-10);
            BOOST_CHECK_CLOSE(lengths.at(rectangle_side(p, Rectangle::right)),
                              p + 1.,
                              1e-10);
            BOOST_CHECK_CLOSE(lengths.at(rectangle_side(p, Rectangle::lower)),
                              3.,
                              1e-10);
            BOOST_CHECK_CLOSE(lengths.at(rectangle_side(p, Rectangle::upper)),
                              3.,
                              1e-10);
          }

        // First turned about the origin, then shifted.
        const Point<2> last =
          angle == 0. ? Point<2>(14., -4.) : Point<2>(10. - 3., 4. - 7.);
        check_position(mesh, 23, last);

        // Each id on the side of which it has the name.
        const std::map<unsigned int, Point<2>> middles = {
          {Rectangle::left, Point<2>(1., 2.)},
          {Rectangle::right, Point<2>(4., 2.)},
          {Rectangle::lower, Point<2>(2.5, 1.)},
          {Rectangle::upper, Point<2>(2.5, 3.)}};
        std::map<unsigned int, Point<2>> sums;
        for (const auto &cell : mesh.active_cell_iterators())
          if (cell->material_id() == 1)
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary())
                sums[face->boundary_id() - 4] +=
                  face->measure() * face->center();
        for (const auto &[side, middle] : middles)
          {
            const Point<2> turned =
              angle == 0. ? middle : Point<2>(-middle[1], middle[0]);
            const Point<2> mean =
              sums.at(side) / lengths.at(rectangle_side(1, side));
            BOOST_CHECK_SMALL(mean.distance(turned + lower.shift), 1e-13);
          }

        if (shape == CellShape::triangles)
          {
            check_diagonals(mesh, 0, 4);
            check_diagonals(mesh, 12, 4);
          }
      }
  BOOST_CHECK_EQUAL(rectangle_side(0, 0), 0u);
  BOOST_CHECK_EQUAL(rectangle_side(3, Rectangle::upper), 15u);
}

// On any number of ranks all know all ids.
BOOST_AUTO_TEST_CASE(shared_by_all_ranks)
{
  dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
  make_ringed_disks({{Point<2>(0., 1.), 1., 4, 0.},
                     {Point<2>(0., -1.), 1., 4, 0.}},
                    mesh);
  check_parts(mesh, parts_of(mesh), 2);
  const auto lengths = boundary_lengths(mesh);
  BOOST_CHECK_EQUAL(lengths.size(), 2u);
  for (const auto &entry : lengths)
    BOOST_CHECK_CLOSE(entry.second, 48. * std::sin(PI / 24.), 1e-10);
}

BOOST_AUTO_TEST_CASE(impossible_numbers_are_refused)
{
  const double     nan      = std::numeric_limits<double>::quiet_NaN();
  const double     infinity = std::numeric_limits<double>::infinity();
  Triangulation<2> mesh;

  const auto refuse_disk = [&](const RingedDisk &disk) {
    BOOST_CHECK_THROW(make_ringed_disks({RingedDisk(), disk}, mesh),
                      InputError);
  };
  BOOST_CHECK_THROW(make_ringed_disks({}, mesh), InputError);
  for (const double radius : {0., -1., nan, infinity})
    refuse_disk({Point<2>(), radius, 3, 0.});
  refuse_disk({Point<2>(), 1., 0, 0.});
  refuse_disk({Point<2>(), 1., 3, nan});
  refuse_disk({Point<2>(0., infinity), 1., 3, 0.});

  using Geometry = StentArteryGeometry;
  for (const auto length : {&Geometry::artery_length,
                            &Geometry::artery_thickness,
                            &Geometry::stent_length,
                            &Geometry::stent_thickness,
                            &Geometry::gap,
                            &Geometry::strut_height})
    for (const double value : {0., -.1, nan, infinity})
      {
        Geometry geometry;
        geometry.*length = value;
        BOOST_CHECK_THROW(make_stent_artery(geometry, mesh), InputError);
      }
  for (const auto n_nodes : {&Geometry::artery_nodes_along,
                             &Geometry::artery_nodes_across,
                             &Geometry::stent_nodes_along,
                             &Geometry::stent_nodes_across})
    for (const unsigned int value : {0, 1})
      {
        Geometry geometry;
        geometry.*n_nodes = value;
        BOOST_CHECK_THROW(make_stent_artery(geometry, mesh), InputError);
      }
  for (const double begin : {-.001, 8.001, nan})
    {
      Geometry geometry;
      geometry.stent_begin = begin;
      BOOST_CHECK_THROW(make_stent_artery(geometry, mesh), InputError);
    }
  Geometry no_struts;
  no_struts.n_struts = 0;
  BOOST_CHECK_THROW(make_stent_artery(no_struts, mesh), InputError);

  const Rectangle good{Point<2>(0., 0.), Point<2>(1., 1.)};
  const auto      refuse_rectangle = [&](const Rectangle &rectangle) {
    BOOST_CHECK_THROW(make_rectangles({good, rectangle},
                                      CellShape::triangles,
                                      mesh),
                      InputError);
  };
  BOOST_CHECK_THROW(make_rectangles({}, CellShape::triangles, mesh),
                    InputError);
  refuse_rectangle(Rectangle());
  refuse_rectangle({Point<2>(0., 0.), Point<2>(1., -1.)});
  refuse_rectangle({Point<2>(0., 0.), Point<2>(nan, 1.)});
  refuse_rectangle({Point<2>(0., 0.), Point<2>(1., 1.), {{0, 1}}});
  refuse_rectangle({Point<2>(0., 0.), Point<2>(1., 1.), {{1, 1}}, nan});
  refuse_rectangle({Point<2>(0., 0.),
                    Point<2>(1., 1.),
                    {{1, 1}},
                    0.,
                    Tensor<1, 2>({0., infinity})});
  BOOST_CHECK_THROW(rectangle_side(0, 4), InputError);

  // No mesh was made by the refused calls, and the ends may be flush, also up
  // to round-off in the sum of decimal fractions.
  BOOST_CHECK_EQUAL(mesh.n_vertices(), 0u);
  Geometry flush;
  flush.artery_length = .3;
  flush.stent_begin   = .1;
  flush.stent_length  = .2;
  BOOST_CHECK_NO_THROW(make_stent_artery(flush, mesh));
}

BOOST_AUTO_TEST_SUITE_END()
