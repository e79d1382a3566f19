// SPDX-License-Identifier: LGPL-2.1-or-later

// Cells of second order: balls against the volume, area and normals of the sphere, on
// any number of ranks; exactness of displacements of degree 2 in them.

#include <base/exceptions.h>
#include <discretization/body.h>
#include <discretization/curved_geometry.h>
#include <discretization/distributed_mesh.h>
#include <discretization/linear_bulk.h>
#include <problems/ball_mesh.h>
#include <problems/gmsh_mesh.h>

#include <deal.II/base/function_lib.h>
#include <deal.II/distributed/tria.h>
#include <deal.II/fe/fe_values.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

using namespace Ricochet;
using dealii::FEFaceValues;
using dealii::FEValues;
using dealii::Mapping;
using dealii::Point;
using dealii::SymmetricTensor;
using dealii::Tensor;
using dealii::Triangulation;

BOOST_AUTO_TEST_SUITE(curved_geometry)

namespace
{
  /// Deviations of a ball from a ball.
  struct Ball
  {
    /// Relative errors of volume and area.
    double volume = 0., area = 0.;
    /// The volume itself (m^3).
    double size = 0.;
    /// Largest distance of a face's quadrature point from the sphere, over the radius,
    /// and of a normal from the sphere's.
    double distance = 0., normal = 0.;
  };



  Ball
  measure(const Body<3> &body, const Point<3> &center, const double radius)
  {
    FEValues<3>     values(body.mapping(),
                       body.dof_handler().get_fe(),
                       body.cell_quadrature(),
                       dealii::update_JxW_values);
    FEFaceValues<3> face_values(body.mapping(),
                                body.dof_handler().get_fe(),
                                body.face_quadrature(),
                                dealii::update_JxW_values |
                                  dealii::update_normal_vectors |
                                  dealii::update_quadrature_points);
    Ball            ball;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          values.reinit(cell);
          for (const double weight : values.get_JxW_values())
            ball.volume += weight;
          for (const unsigned int f : cell->face_indices())
            if (cell->face(f)->at_boundary())
              {
                face_values.reinit(cell, f);
                for (const unsigned int q :
                     face_values.quadrature_point_indices())
                  {
                    const Tensor<1, 3> x =
                      face_values.quadrature_point(q) - center;
                    ball.area += face_values.JxW(q);
                    ball.distance =
                      std::max(ball.distance, std::abs(x.norm() / radius - 1.));
                    ball.normal = std::max(
                      ball.normal,
                      (x / x.norm() - face_values.normal_vector(q)).norm());
                  }
              }
        }
    const double exact_area = 4. * dealii::numbers::PI * radius * radius;
    const auto   error      = [&](const double value, const double exact) {
      return std::abs(
        dealii::Utilities::MPI::sum(value, body.communicator) / exact - 1.);
    };
    ball.size   = dealii::Utilities::MPI::sum(ball.volume, body.communicator);
    ball.volume = error(ball.volume, exact_area * radius / 3.);
    ball.area   = error(ball.area, exact_area);
    ball.distance =
      dealii::Utilities::MPI::max(ball.distance, body.communicator);
    ball.normal = dealii::Utilities::MPI::max(ball.normal, body.communicator);
    return ball;
  }



  /// x -> gradient . x
  class Linear : public dealii::Function<3>
  {
  public:
    Linear(const Tensor<2, 3> &gradient)
      : dealii::Function<3>(3)
      , gradient(gradient)
    {}

    double
    value(const Point<3> &x, const unsigned int component) const override
    {
      return (gradient * x)[component];
    }

  private:
    const Tensor<2, 3> gradient;
  };



  const Point<3>   center(.5, -1., 2.);
  constexpr double radius = 2.;



  /// A ball with edges of length @p h, on parts of a mesh on all ranks.
  Ball
  measure_ball(const bool tetrahedra, const bool curved, const double h)
  {
    std::unique_ptr<Triangulation<3>> mesh;
    std::unique_ptr<Mapping<3>>       geometry;
    if (tetrahedra)
      {
        CellNodes<3> nodes;
        mesh = distribute_mesh<3>(
          [&](Triangulation<3> &whole) {
            make_ball_of_tetrahedra(center,
                                    radius,
                                    h,
                                    whole,
                                    curved ? &nodes : nullptr);
          },
          MPI_COMM_WORLD);
        if (curved)
          geometry = make_curved_geometry(nodes, *mesh, MPI_COMM_WORLD);
      }
    else
      {
        mesh =
          std::make_unique<dealii::parallel::distributed::Triangulation<3>>(
            MPI_COMM_WORLD);
        make_ball_of_hexahedra(center, radius, h, *mesh);
        if (curved)
          geometry = make_curved_geometry(*mesh);
      }
    const Body<3> body(*mesh,
                       2,
                       {},
                       {1},
                       MultiplierSpace::none,
                       MPI_COMM_WORLD,
                       {},
                       geometry.get());
    BOOST_TEST(body.is_curved() == curved);
    return measure(body, center, radius);
  }
} // namespace



BOOST_AUTO_TEST_CASE(balls_against_the_sphere)
{
  for (const bool tetrahedra : {true, false})
    {
      const Ball straight = measure_ball(tetrahedra, false, 1.),
                 coarse   = measure_ball(tetrahedra, true, 1.),
                 fine     = measure_ball(tetrahedra, true, .5);
      for (const Ball &ball : {straight, coarse, fine})
        BOOST_TEST_MESSAGE((tetrahedra ? "tetrahedra: " : "hexahedra: ")
                           << "volume " << ball.volume << ", area " << ball.area
                           << ", distance " << ball.distance << ", normal "
                           << ball.normal);
      // Straight edges are off by h^2/(8 radius^2), and their normals by h/radius.
      BOOST_TEST(straight.volume > 2e-2);
      BOOST_TEST(coarse.volume < straight.volume / 20.);
      BOOST_TEST(coarse.normal < straight.normal / 4.);
      // Quadratic ones fall at least as h^3, their normals as h^2.
      BOOST_TEST(fine.volume < coarse.volume / 6.);
      BOOST_TEST(fine.area < coarse.area / 6.);
      BOOST_TEST(fine.distance < coarse.distance / 5.);
      BOOST_TEST(fine.normal < coarse.normal / 3.);
    }
}



// A uniform strain is a displacement of degree 2 also in curved cells, since it is a
// linear function of the positions, which are of degree 2: its energy is the density
// times the volume that the cells have.
BOOST_AUTO_TEST_CASE(uniform_strain_is_reproduced)
{
  CellNodes<3> nodes;
  const auto   mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) {
      make_ball_of_tetrahedra(center, radius, 1., whole, &nodes);
    },
    MPI_COMM_WORLD);
  const auto    geometry = make_curved_geometry(nodes, *mesh, MPI_COMM_WORLD);
  const Body<3> body(*mesh,
                     2,
                     {},
                     {1},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD,
                     {},
                     geometry.get());
  const double  volume = measure(body, center, radius).size;

  Tensor<2, 3> gradient;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      gradient[i][j] = .01 * (1. + i - 2. * j + i * j);
  const LinearElastic material{3., 2.};
  const LinearBulk<3> bulk(body, material);
  const Linear        linear(gradient);
  Vector              displacement;
  body.interpolate(linear, displacement);
  const SymmetricTensor<2, 3> strain = symmetrize(gradient);
  const double                density =
    .5 * (3. * trace(strain) * trace(strain) + 2. * 2. * (strain * strain));
  BOOST_CHECK_CLOSE(bulk.energy(displacement), density * volume, 1e-9);
}



// The file comes from elsewhere (the ball of paper C, h = 4, from Gmsh), with the
// nodes of its surface on the sphere to seven digits.
BOOST_AUTO_TEST_CASE(file_of_second_order)
{
  CellNodes<3> nodes;
  const auto   mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) {
      nodes = read_ball(RICOCHET_MESHES "/sphere_h4_curved.msh", whole);
    },
    MPI_COMM_WORLD);
  const Body<3> straight(*mesh,
                         2,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
  const auto    geometry = make_curved_geometry(nodes, *mesh, MPI_COMM_WORLD);
  const Body<3> curved(*mesh,
                       2,
                       {},
                       {1},
                       MultiplierSpace::none,
                       MPI_COMM_WORLD,
                       {},
                       geometry.get());
  BOOST_TEST(curved.owned_indices().size() == 14112U);
  const Ball ball   = measure(curved, Point<3>(0., 0., 22.), 20.),
             coarse = measure(straight, Point<3>(0., 0., 22.), 20.);
  BOOST_TEST_MESSAGE("volume " << ball.volume << ", normal " << ball.normal
                               << "; straight: " << coarse.volume << ", "
                               << coarse.normal);
  BOOST_TEST(coarse.volume > 1e-2);
  BOOST_TEST(ball.volume < 2e-4);
  BOOST_TEST(ball.distance < 1e-3);
  BOOST_TEST(ball.normal < 2e-2);
}



BOOST_AUTO_TEST_CASE(folded_cells_are_refused)
{
  CellNodes<3> nodes;
  const auto   mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) {
      make_ball_of_tetrahedra(center, radius, 1., whole, &nodes);
    },
    MPI_COMM_WORLD);
  // The node between the first two vertices goes far beyond the other two.
  if (!nodes.empty())
    nodes[3][4] +=
      2. * ((nodes[3][2] - nodes[3][0]) + (nodes[3][3] - nodes[3][1]));
  const auto geometry = make_curved_geometry(nodes, *mesh, MPI_COMM_WORLD);
  BOOST_CHECK_EXCEPTION(
    Body<3>(*mesh,
            2,
            {},
            {1},
            MultiplierSpace::none,
            MPI_COMM_WORLD,
            {},
            geometry.get()),
    InputError,
    [](const InputError &error) {
      return std::string(error.what()).find("turned inside out") !=
        std::string::npos;
    });
}

BOOST_AUTO_TEST_SUITE_END()
