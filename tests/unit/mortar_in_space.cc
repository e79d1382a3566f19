// SPDX-License-Identifier: LGPL-2.1-or-later

// Mortar contact of surfaces in 3D: triangles that clip each other and the rule
// on the pieces; rows between two blocks with bumpy faces over random steps,
// whose product with the change of the positions is the change of the mean gaps
// and the slip, with sums and moments of zero and derivatives that are
// quotients of differences; and a uniform pressure between blocks whose meshes
// do not match (patch test).

#include "equilibrium.h"
#include "meshes.h"

#include <contact/kinematics/mortar_triangles.h>
#include <contact/kinematics/points_before_triangles.h>
#include <contact/surfaces/clipped_triangle.h>
#include <discretization/distributed_mesh.h>
#include <problems/part_meshes.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;
using dealii::Triangulation;

BOOST_AUTO_TEST_SUITE(mortar_in_space)

namespace
{
  /// int x^i y^j over the triangle between @p a, @p b and @p c, for i + j <= 2, by the
  /// middles of its edges.
  double
  moment(const ClippedTriangle::Point &a,
         const ClippedTriangle::Point &b,
         const ClippedTriangle::Point &c,
         const unsigned int            i,
         const unsigned int            j)
  {
    const double area = .5 *
      std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
    double     sum = 0.;
    const auto add = [&](const auto &p, const auto &q) {
      sum += std::pow(.5 * (p[0] + q[0]), i) * std::pow(.5 * (p[1] + q[1]), j);
    };
    add(a, b);
    add(b, c);
    add(c, a);
    return sum * area / 3.;
  }

  double
  moment(const ClippedTriangle &polygon,
         const unsigned int     i,
         const unsigned int     j)
  {
    double sum = 0.;
    if (polygon.area() > 0.)
      for (const auto &x : polygon.quadrature_points())
        sum += polygon.area() / 3. * std::pow(x[0], i) * std::pow(x[1], j);
    return sum;
  }
} // namespace



// Triangles with random corners that tile a square around the reference
// triangle: the clipped parts have moments up to the second that add up to its
// own.
BOOST_AUTO_TEST_CASE(clipped_triangles_tile)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> noise(-.04, .04);
  constexpr unsigned int                 n_cells = 9;
  for (const bool turned_around : {false, true})
    for (const double jitter : {0., 1.})
      {
        std::array<std::array<ClippedTriangle::Point, n_cells + 1>, n_cells + 1>
          x;
        for (unsigned int i = 0; i <= n_cells; ++i)
          for (unsigned int j = 0; j <= n_cells; ++j)
            x[i][j] = {{-.2 + 1.4 * i / n_cells + jitter * noise(random),
                        -.2 + 1.4 * j / n_cells + jitter * noise(random)}};
        double       sum[3][3] = {};
        unsigned int n_pieces  = 0;
        for (unsigned int i = 0; i < n_cells; ++i)
          for (unsigned int j = 0; j < n_cells; ++j)
            for (const bool upper : {false, true})
              {
                std::array<ClippedTriangle::Point, 3> corners = {
                  {x[i][j],
                   upper ? x[i + 1][j + 1] : x[i + 1][j],
                   upper ? x[i][j + 1] : x[i + 1][j + 1]}};
                if (turned_around)
                  std::swap(corners[1], corners[2]);
                const ClippedTriangle polygon(corners);
                n_pieces += polygon.area() > 0.;
                for (unsigned int a = 0; a < 3; ++a)
                  for (unsigned int b = 0; a + b < 3; ++b)
                    sum[a][b] += moment(polygon, a, b);
                if (polygon.area() > 1e-12)
                  {
                    BOOST_CHECK(polygon.contains(polygon.middle()));
                    BOOST_CHECK(!polygon.contains({{1.1, 1.1}}));
                  }
              }
        BOOST_CHECK_GT(n_pieces, 40);
        for (unsigned int a = 0; a < 3; ++a)
          for (unsigned int b = 0; a + b < 3; ++b)
            BOOST_CHECK_SMALL(
              sum[a][b] - moment({{0., 0.}}, {{1., 0.}}, {{0., 1.}}, a, b),
              1e-15);
      }

  // All of it, and nothing.
  using Corners                   = std::array<ClippedTriangle::Point, 3>;
  const Corners         around    = {{{{-1., -1.}}, {{4., -1.}}, {{-1., 4.}}}};
  const Corners         beside    = {{{{.6, .6}}, {{1., .6}}, {{.6, 1.}}}};
  const Corners         in_middle = {{{{.1, .1}}, {{.3, .2}}, {{.2, .5}}}};
  const ClippedTriangle all(around), none(beside), inside(in_middle);
  BOOST_CHECK_CLOSE(all.area(), .5, 1e-12);
  BOOST_CHECK_EQUAL(none.area(), 0.);
  for (unsigned int a = 0; a < 3; ++a)
    for (unsigned int b = 0; a + b < 3; ++b)
      BOOST_CHECK_SMALL(
        moment(inside, a, b) -
          moment(in_middle[0], in_middle[1], in_middle[2], a, b),
        1e-16);
}



namespace
{
  constexpr dealii::types::boundary_id upper_of_lower = 15, lower_of_upper = 24;

  /// Part 0 from z = -1 to 0, part 1 on top of it from @p gap to 1, both with the side
  /// @p width_of_lower and 1. Boundary ids are 10 (part + 1) + the number of the face of
  /// a deal.II cell.
  ///
  /// @param skew how far nodes are moved along the faces, as a part of 1: faces with four
  /// corners are no parallelograms then.
  void
  make_blocks(const bool         tetrahedra,
              const unsigned int n_lower,
              const unsigned int n_upper,
              const double       width_of_lower,
              const double       gap,
              const double       skew,
              Triangulation<3>  &whole)
  {
    Triangulation<3> parts[2];
    for (unsigned int p = 0; p < 2; ++p)
      {
        const unsigned int n     = p == 0 ? n_lower : n_upper;
        const double       width = p == 0 ? width_of_lower : 1.;
        const Point<3>     lower(-.5 * width, -.5 * width, p == 0 ? -1. : gap),
          upper(.5 * width, .5 * width, p == 0 ? 0. : 1.);
        Triangulation<3> bricks;
        dealii::GridGenerator::subdivided_hyper_rectangle(bricks,
                                                          {n, n, 2},
                                                          lower,
                                                          upper);
        if (tetrahedra)
          dealii::GridGenerator::convert_hypercube_to_simplex_mesh(bricks,
                                                                   parts[p]);
        else
          parts[p].copy_triangulation(bricks);
        for (const auto &cell : parts[p].active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              for (unsigned int c = 0; c < 3; ++c)
                {
                  if (std::abs(face->center()[c] - lower[c]) < 1e-9)
                    face->set_boundary_id(10 * (p + 1) + 2 * c);
                  if (std::abs(face->center()[c] - upper[c]) < 1e-9)
                    face->set_boundary_id(10 * (p + 1) + 2 * c + 1);
                }
        dealii::GridTools::transform(
          [&](const Point<3> &x) {
            Point<3>     y  = x;
            const double pi = dealii::numbers::PI;
            const double bump =
              std::cos(pi * x[0] / width) * std::cos(pi * x[1] / width) * skew;
            y[0] += bump * std::sin(2. * pi * x[1] / width);
            y[1] += bump;
            return y;
          },
          parts[p]);
      }
    join_parts<3>({&parts[0], &parts[1]}, whole);
  }

  /// Two blocks of which the upper one is the slave.
  struct Blocks
  {
    Blocks(const bool tetrahedra, const unsigned int seed)
      : random(seed)
    {
      mesh = distribute_mesh<3>(
        [&](Triangulation<3> &whole) {
          make_blocks(tetrahedra, 4, 3, 1.6, .02, .05, whole);
        },
        MPI_COMM_WORLD);
      body = std::make_unique<Body<3>>(*mesh,
                                       1,
                                       Body<3>::BoundaryIds{},
                                       Body<3>::BoundaryIds{},
                                       MultiplierSpace::none,
                                       MPI_COMM_WORLD);
      std::map<dealii::types::global_dof_index, Point<3>> positions;
      dealii::DoFTools::map_dofs_to_support_points(body->mapping(),
                                                   body->dof_handler(),
                                                   positions);
      for (const auto &[i, x] : positions)
        reference[body->system_index(i)] = x;
      for (unsigned int c = 0; c < 3; ++c)
        {
          dealii::ComponentMask mask(3, false);
          mask.set(c, true);
          for (const auto i :
               dealii::DoFTools::extract_dofs(body->dof_handler(), mask))
            component[body->system_index(i)] = c;
        }
    }

    std::unique_ptr<SurfacePair<3>>
    pair(const MortarShape shape) const
    {
      return std::make_unique<MortarTriangles>(*body,
                                               ContactPair{"blocks",
                                                           {lower_of_upper},
                                                           {upper_of_lower}},
                                               shape);
    }

    /// Noise of @p amplitude; the upper block slides by @p slide, and down by @p press,
    /// and turns about x by @p angle.
    Vector
    displacements(const double amplitude,
                  const double slide,
                  const double press,
                  const double angle)
    {
      std::uniform_real_distribution<double> noise(-amplitude, amplitude);
      Vector                                 vector = body->make_vector();
      for (dealii::types::global_dof_index i = 0; i < vector.size(); ++i)
        {
          double value = noise(random);
          if (!vector.in_local_range(i))
            continue;
          const Point<3>    &x = reference.at(i);
          const unsigned int c = component.at(i);
          if (x[2] > .01)
            value += c == 0 ? slide
              : c == 1
              ? (std::cos(angle) - 1.) * x[1] - std::sin(angle) * x[2]
              : (std::cos(angle) - 1.) * x[2] + std::sin(angle) * x[1] - press;
          vector(i) = value;
        }
      vector.compress(dealii::VectorOperation::insert);
      return vector;
    }

    std::mt19937                                            random;
    std::unique_ptr<Triangulation<3>>                       mesh;
    std::unique_ptr<Body<3>>                                body;
    std::map<dealii::types::global_dof_index, Point<3>>     reference;
    std::map<dealii::types::global_dof_index, unsigned int> component;
  };
} // namespace



BOOST_AUTO_TEST_CASE(rows_of_means_are_exact)
{
  for (const MortarShape shape : {MortarShape::standard, MortarShape::dual})
    for (const bool tetrahedra : {true, false})
      {
        double       increment = 0., slip = 0., sums = 0., moments = 0.;
        unsigned int n_before = 0, n_points = 0;
        for (unsigned int seed = 1; seed <= 4; ++seed)
          {
            Blocks       blocks(tetrahedra, seed);
            const auto   pair   = blocks.pair(shape);
            const Vector before = blocks.displacements(.01, 0., .01, 0.);
            const Vector after =
              blocks.displacements(.02, .05 * seed, .03, .03 * seed);
            Vector change(after), velocity(after);
            change -= before;
            velocity = change;
            velocity *= 1. / .1;
            const Vector zero = blocks.body->make_vector();
            pair->begin_step({before, zero, velocity, .1, .1});
            pair->evaluate(after);
            for (unsigned int p = 0; p < pair->points().size(); ++p)
              {
                ++n_points;
                if (!pair->is_before_facet(p))
                  continue;
                ++n_before;
                const auto &rows       = pair->rows(p);
                double      along      = 0.;
                double      sliding[2] = {};
                // Sums and moments of the rows D, T_1 and T_2.
                Tensor<1, 3> sum[3], moment[3];
                for (unsigned int k = 0; k < rows.unknowns.size(); ++k)
                  {
                    const auto         i = rows.unknowns[k];
                    const unsigned int c = blocks.component.at(i);
                    along += rows.normal[k] * change(i);
                    for (unsigned int d = 0; d < 2; ++d)
                      sliding[d] += rows.tangential[d][k] * change(i);
                    const double entries[3] = {rows.normal[k],
                                               rows.tangential[0][k],
                                               rows.tangential[1][k]};
                    // Unknowns of a node follow each other.
                    Point<3> middle = blocks.reference.at(i);
                    for (unsigned int d = 0; d < 3; ++d)
                      middle[d] += .5 * (before(i - c + d) + after(i - c + d));
                    for (unsigned int r = 0; r < 3; ++r)
                      {
                        Tensor<1, 3> force;
                        force[c] = entries[r];
                        sum[r] += force;
                        moment[r] +=
                          cross_product_3d(static_cast<const Tensor<1, 3> &>(
                                             middle),
                                           force);
                      }
                  }
                increment = std::max(
                  {increment,
                   std::abs(along - pair->new_gap(p) + pair->old_gap(p)),
                   std::abs(along - rows.gap_increment)});
                for (unsigned int d = 0; d < 2; ++d)
                  slip = std::max(slip, std::abs(sliding[d] - rows.slip[d]));
                for (unsigned int r = 0; r < 3; ++r)
                  {
                    sums    = std::max(sums, sum[r].norm());
                    moments = std::max(moments, moment[r].norm());
                  }
              }
          }
        BOOST_TEST_MESSAGE("increment " << increment << ", slip " << slip
                                        << ", sums " << sums << ", moments "
                                        << moments << ", of " << n_points
                                        << " points " << n_before);
        BOOST_CHECK_GT(n_before, n_points / 2);
        BOOST_CHECK_LT(increment, 1e-14);
        BOOST_CHECK_LT(slip, 1e-14);
        BOOST_CHECK_LT(sums, 2e-14);
        BOOST_CHECK_LT(moments, 2e-14);
      }
}



BOOST_AUTO_TEST_CASE(derivatives_of_means)
{
  const double       h = 1e-6, pressure = 2.;
  const Tensor<1, 2> traction({.7, -.4});
  for (const MortarShape shape : {MortarShape::standard, MortarShape::dual})
    for (const bool tetrahedra : {true, false})
      {
        Blocks       blocks(tetrahedra, 5);
        const auto   pair      = blocks.pair(shape);
        const Vector zero      = blocks.body->make_vector();
        const Vector before    = blocks.displacements(.01, 0., .01, 0.);
        const Vector after     = blocks.displacements(.01, .05, .03, .05);
        const Vector direction = blocks.displacements(1., 0., 0., 0.);
        pair->begin_step({before, zero, zero, .1, .1});
        double worst = 0.;
        for (unsigned int p = 0; p < pair->points().size(); p += 3)
          {
            if (!pair->is_before_facet(p))
              continue;
            // Force, gap and slips.
            const auto at = [&](const double length) {
              Vector point(after);
              point.add(length, direction);
              pair->evaluate(point);
              const auto         &rows = pair->rows(p);
              std::vector<double> values;
              for (unsigned int k = 0; k < rows.unknowns.size(); ++k)
                values.push_back(traction[0] * rows.tangential[0][k] +
                                 traction[1] * rows.tangential[1][k] -
                                 pressure * rows.normal[k]);
              values.push_back(pair->new_gap(p));
              values.push_back(rows.slip[0]);
              values.push_back(rows.slip[1]);
              return values;
            };
            const auto up = at(h), down = at(-h);
            pair->evaluate(after);
            const auto &rows = pair->rows(p);
            const auto &derivatives =
              pair->derivatives(p, {pressure, traction, 0.}, Caution::none);
            const unsigned int  m = rows.unknowns.size();
            std::vector<double> along(m + 3, 0.);
            for (unsigned int b = 0; b < m; ++b)
              {
                const double step = direction(rows.unknowns[b]);
                for (unsigned int a = 0; a < m; ++a)
                  along[a] += derivatives.forces[a * m + b] * step;
                along[m] += derivatives.gap[b] * step;
                for (unsigned int d = 0; d < 2; ++d)
                  along[m + 1 + d] += derivatives.slip[d][b] * step;
              }
            double size = 0.;
            for (const double value : along)
              size = std::max(size, std::abs(value));
            for (unsigned int k = 0; k < along.size(); ++k)
              worst = std::max(worst,
                               std::abs(along[k] - .5 * (up[k] - down[k]) / h) /
                                 size);
          }
        BOOST_TEST_MESSAGE("derivatives " << worst);
        BOOST_CHECK_LT(worst, 1e-7);
      }
}



namespace
{
  /// Two blocks without lateral contraction, pressed against each other. @return the
  /// largest relative error of the contact pressure.
  double
  worst_error_between_blocks(const std::string &treatment,
                             const std::string &coupling,
                             const unsigned int n_lower,
                             const unsigned int n_upper,
                             const bool         lower_is_slave,
                             const bool         tetrahedra,
                             const double       skew)
  {
    constexpr double    press = .01, stiffness_of_contact = 1e3;
    const LinearElastic soft{1., 1.}, stiff{10., 10.};
    const auto          mesh = distribute_mesh<3>(
      [&](Triangulation<3> &whole) {
        make_blocks(tetrahedra, n_lower, n_upper, 1., 0., skew, whole);
      },
      MPI_COMM_WORLD);
    ImpactParameters parameters;
    parameters.contact.treatment                        = treatment;
    parameters.contact.coupling                         = coupling;
    parameters.contact.values["Augmentation"]           = 10.;
    parameters.contact.values["Compliance coefficient"] = stiffness_of_contact;
    parameters.newton.tolerance                         = 1e-12;
    parameters.scheme.name                              = "midpoint";
    ImpactSetup<3> setup{Material<3>(soft)};
    setup.parts.push_back({"lower", Material<3>(soft), 1.});
    setup.parts.push_back({"upper", Material<3>(stiff), 1.});
    setup.pairs = {{"blocks",
                    {lower_is_slave ? upper_of_lower : lower_of_upper},
                    {lower_is_slave ? lower_of_upper : upper_of_lower}}};
    const VectorField<3> at_rest;
    for (const unsigned int part : {1U, 2U})
      for (unsigned int side = 0; side < 4; ++side)
        setup.imposed[10 * part + side] = {{{side < 2, side >= 2, false}},
                                           at_rest};
    setup.imposed[14]       = {{{false, false, true}}, at_rest};
    setup.imposed[25]       = {{{false, false, true}}, at_rest};
    setup.imposed[25].value = [](const double time, const Point<3> &) {
      return Tensor<1, 3>({0., 0., -press * time});
    };
    Impact<3> impact(parameters, *mesh, setup, MPI_COMM_WORLD);
    const auto [solution, force] = equilibrium(impact, /* end time */ 1.);

    // One after the other: the blocks, and the spring of normal compliance.
    const double compliance = treatment == "standard normal compliance"
      ? 1. / stiffness_of_contact
      : 0.;
    const double pressure   = press /
      (1. / (soft.lambda + 2. * soft.mu) + 1. / (stiff.lambda + 2. * stiff.mu) +
       compliance);
    const Vector field = impact.contact->pressure_field({solution, force, 1.});
    double       worst = 0.;
    unsigned int n     = 0;
    for (const auto i : field.locally_owned_elements())
      if (const double value = field(i); value != 0.)
        {
          worst = std::max(worst, std::abs(value / pressure - 1.));
          ++n;
        }
    const unsigned int n_slave = lower_is_slave ? n_lower : n_upper;
    // Five tetrahedra in a brick and four triangles in a quadrilateral have nodes of
    // their own only in the first case.
    n = dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD);
    BOOST_CHECK_GE(n, (n_slave + 1) * (n_slave + 1));
    return dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
  }
} // namespace



// Mortar passes a uniform pressure whatever the meshes are. That includes flat faces with
// four corners of any shape: the four triangles around their mean have the same
// nodal forces of a uniform pressure as the cell's bilinear functions.
BOOST_AUTO_TEST_CASE(blocks_that_do_not_match)
{
  for (const std::string treatment :
       {"Signorini active set", "standard normal compliance"})
    for (const auto &[n_lower, n_upper] : fewer_in_debug(
           std::vector<std::pair<unsigned int, unsigned int>>{{3, 4},
                                                              {5, 2},
                                                              {1, 4}}))
      for (const bool lower_is_slave : {true, false})
        for (const bool tetrahedra : {true, false})
          for (const double skew : {0., .05})
            {
              const auto error = [&](const std::string &coupling) {
                return worst_error_between_blocks(treatment,
                                                  coupling,
                                                  n_lower,
                                                  n_upper,
                                                  lower_is_slave,
                                                  tetrahedra,
                                                  skew);
              };
              const double of_mortar = error("mortar"),
                           of_dual   = error("dual mortar");
              BOOST_TEST_MESSAGE(
                treatment << ", " << n_lower << " / " << n_upper << " cells, "
                          << (lower_is_slave ? "lower" : "upper")
                          << " is slave, "
                          << (tetrahedra ? "tetrahedra" : "hexahedra")
                          << ", skew " << skew << ": mortar " << of_mortar
                          << ", dual " << of_dual);
              BOOST_CHECK_LT(of_mortar, 1e-10);
              BOOST_CHECK_LT(of_dual, 1e-10);
            }
}

BOOST_AUTO_TEST_SUITE_END()
