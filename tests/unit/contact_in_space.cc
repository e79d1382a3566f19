// SPDX-License-Identifier: LGPL-2.1-or-later

// Contact between bodies in 3D. The rows of a point against a triangle, at
// random states: their product with the change of the positions is the change
// of the gap and the slip, their sums and moments are zero, their derivatives
// are quotients of differences. Then two balls that meet off their centres:
// balances, momenta, friction, tangents, ranks.

#include "on_all_ranks.h"
#include "contact_tangent.h"
#include "meshes.h"

#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <contact/kinematics/points_before_triangles.h>
#include <contact/surfaces/contact_surface.h>
#include <contact/surfaces/facet_search.h>
#include <contact/surfaces/point_passing_triangles.h>
#include <contact/surfaces/surface_features.h>
#include <discretization/curved_geometry.h>
#include <discretization/distributed_mesh.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/neo_hookean.h>
#include <output/momenta.h>
#include <problems/ball_mesh.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>

#include <Sacado_Fad_SLFad.hpp>

#include <numeric>
#include <random>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;
using dealii::Triangulation;

BOOST_AUTO_TEST_SUITE(contact_in_space)

namespace
{
  using AD       = Sacado::Fad::SLFad<double, 12>;
  using Rows     = PointBeforeTriangle<double>::Rows;
  using Position = std::array<std::array<double, 3>, 4>;

  std::mt19937 generator(42);

  double
  random_number(const double size)
  {
    return std::uniform_real_distribution<double>(-size, size)(generator);
  }

  Position
  random_triangle()
  {
    Position x{};
    x[2][0] = x[3][1] = 1.;
    x[0]              = {{.3, .3, random_number(.2)}};
    for (auto &point : x)
      for (double &c : point)
        c += random_number(.1);
    return x;
  }

  Position
  moved(const Position &x, const double size)
  {
    Position y = x;
    for (auto &point : y)
      for (double &c : point)
        c += random_number(size);
    return y;
  }

  /// Turned about an axis by any angle.
  Position
  turned(const Position &x)
  {
    Tensor<1, 3> axis;
    for (unsigned int c = 0; c < 3; ++c)
      axis[c] = random_number(1.);
    axis /= axis.norm();
    const double angle = random_number(3.), s = std::sin(angle),
                 c1 = std::cos(angle);
    Position y      = x;
    for (auto &point : y)
      {
        const Tensor<1, 3> p({point[0], point[1], point[2]});
        const Tensor<1, 3> q = c1 * p + s * cross_product_3d(axis, p) +
          (1. - c1) * (axis * p) * axis;
        for (unsigned int c = 0; c < 3; ++c)
          point[c] = q[c];
      }
    return y;
  }

  double
  times_change(const PointBeforeTriangle<double>::Row &row,
               const Position                         &a,
               const Position                         &b)
  {
    double sum = 0.;
    for (unsigned int p = 0; p < 4; ++p)
      for (unsigned int c = 0; c < 3; ++c)
        sum += row[3 * p + c] * (b[p][c] - a[p][c]);
    return sum;
  }

  /// The coordinates of the point in the triangle's plane, by deal.II's vectors.
  std::array<double, 2>
  coordinates(const Position &x)
  {
    std::array<Tensor<1, 3>, 4> p;
    for (unsigned int i = 0; i < 4; ++i)
      p[i] = Tensor<1, 3>({x[i][0], x[i][1], x[i][2]});
    const Tensor<1, 3> e1 = p[2] - p[1], e2 = p[3] - p[1], r = p[0] - p[1];
    const Tensor<1, 3> n = cross_product_3d(e1, e2);
    return {{(cross_product_3d(r, e2) * n) / n.norm_square(),
             (cross_product_3d(e1, r) * n) / n.norm_square()}};
  }

  double
  gap(const Position &x)
  {
    std::array<Tensor<1, 3>, 4> p;
    for (unsigned int i = 0; i < 4; ++i)
      p[i] = Tensor<1, 3>({x[i][0], x[i][1], x[i][2]});
    const Tensor<1, 3> n = cross_product_3d(p[2] - p[1], p[3] - p[1]);
    return (n / n.norm()) * (p[0] - p[1]);
  }

  /// Sum and moment about the middle of the step.
  double
  sum_and_moment(const PointBeforeTriangle<double>::Row &row,
                 const Position                         &a,
                 const Position                         &b)
  {
    Tensor<1, 3> sum, moment;
    for (unsigned int p = 0; p < 4; ++p)
      {
        Tensor<1, 3> force, x;
        for (unsigned int c = 0; c < 3; ++c)
          {
            force[c] = row[3 * p + c];
            x[c]     = .5 * (a[p][c] + b[p][c]);
          }
        sum += force;
        moment += cross_product_3d(x, force);
      }
    return sum.norm() + moment.norm();
  }

  void
  check_rows(const Position &a, const Position &b)
  {
    Rows rows;
    PointBeforeTriangle<double>::evaluate(a, b, rows);
    BOOST_CHECK_SMALL(times_change(rows.normal, a, b) - (gap(b) - gap(a)),
                      4e-14);
    BOOST_CHECK_SMALL(rows.gap_increment - (gap(b) - gap(a)), 4e-14);
    BOOST_CHECK_SMALL(rows.new_gap - gap(b), 4e-14);
    BOOST_CHECK_SMALL(sum_and_moment(rows.normal, a, b), 4e-14);
    // The slip is that of the coordinates, measured in the middle of the step.
    const auto   from = coordinates(a), to = coordinates(b);
    Tensor<1, 3> along;
    for (unsigned int c = 0; c < 3; ++c)
      along[c] = .5 *
        ((to[0] - from[0]) * (a[2][c] - a[1][c] + b[2][c] - b[1][c]) +
         (to[1] - from[1]) * (a[3][c] - a[1][c] + b[3][c] - b[1][c]));
    BOOST_CHECK_SMALL(std::hypot(rows.slip[0], rows.slip[1]) - along.norm(),
                      4e-14);
    for (unsigned int d = 0; d < 2; ++d)
      {
        BOOST_CHECK_SMALL(times_change(rows.tangential[d], a, b) - rows.slip[d],
                          4e-14);
        BOOST_CHECK_SMALL(sum_and_moment(rows.tangential[d], a, b), 1e-13);
        for (const double entry : rows.tangential[d])
          BOOST_CHECK_LT(std::abs(entry), 20.);
      }
    for (const double entry : rows.normal)
      BOOST_CHECK_LT(std::abs(entry), 20.);
  }
} // namespace



BOOST_AUTO_TEST_CASE(rows_are_exact)
{
  for (const double size : {1e-6, 1e-3, .1, .2})
    for (unsigned int k = 0; k < 200; ++k)
      {
        const Position a = random_triangle();
        check_rows(a, moved(a, size));
        if (size < .1)
          check_rows(a, moved(turned(a), size));
      }
}



// The point passes through the triangle, which turns and hardly changes its shape: all
// products q_ij come back to where they were.
BOOST_AUTO_TEST_CASE(rows_are_bounded_through_mirror_images)
{
  for (const double strain : {0., 1e-12, 1e-8, 1e-4, 1e-2})
    for (unsigned int k = 0; k < 100; ++k)
      {
        const Position a = random_triangle();
        Position       b = a;
        Tensor<1, 3>   e1, e2;
        for (unsigned int c = 0; c < 3; ++c)
          {
            e1[c] = a[2][c] - a[1][c];
            e2[c] = a[3][c] - a[1][c];
          }
        const Tensor<1, 3> n =
          cross_product_3d(e1, e2) / cross_product_3d(e1, e2).norm();
        for (unsigned int c = 0; c < 3; ++c)
          b[0][c] -= 2. * gap(a) * n[c];
        b = moved(b, strain);
        // By less than a right angle: otherwise the middle of the step is too small.
        Position c = turned(b);
        while (coordinates(c)[0] != coordinates(c)[0])
          c = turned(b);
        Position middle;
        for (unsigned int p = 0; p < 4; ++p)
          for (unsigned int d = 0; d < 3; ++d)
            middle[p][d] = .5 * (a[p][d] + c[p][d]);
        Tensor<1, 3> m1, m2;
        for (unsigned int d = 0; d < 3; ++d)
          {
            m1[d] = middle[2][d] - middle[1][d];
            m2[d] = middle[3][d] - middle[1][d];
          }
        if (cross_product_3d(m1, m2).norm() > .4)
          check_rows(a, c);
      }
}



namespace
{
  using Passing = PointPassingTriangles<double>;

  /// A point that faces the first of two triangles and moves on to the second
  /// one: over their common edge, with an angle of @p turn, or past their only
  /// common node.
  struct Passage
  {
    Passage(const bool share_edge, const double turn, const double size)
    {
      // Nodes of a surface around the origin, the point in front of the first
      // triangle.
      std::array<Tensor<1, 3>, 6> x;
      x[1] = Tensor<1, 3>({0., 0., 0.});
      x[2] = Tensor<1, 3>({0., 1., 0.});
      x[3] = Tensor<1, 3>({-1., .5, 0.});
      x[4] = Tensor<1, 3>({std::cos(turn), .5, std::sin(turn)});
      x[5] = Tensor<1, 3>({std::cos(turn), -.5, std::sin(turn)});
      x[0] = Tensor<1, 3>({-.02, share_edge ? .4 : .01, random_number(.02)});
      std::array<Tensor<1, 3>, 6> y = x;
      y[0] += Tensor<1, 3>({.04, share_edge ? .05 : -.02, random_number(.02)});
      for (unsigned int n = 0; n < 6; ++n)
        for (unsigned int c = 0; c < 3; ++c)
          {
            if (n > 0)
              x[n][c] += random_number(.05);
            y[n][c] = (n > 0 ? x[n][c] : y[n][c]) + random_number(size);
          }
      y[4][2] += random_number(10. * size);
      // The edge from node 1 to 2 is the last one of the second triangle, or none.
      const std::array<unsigned int, Passing::n_points> nodes = share_edge
        ? std::array<unsigned int, 7>{{0, 1, 2, 3, 1, 4, 2}}
        : std::array<unsigned int, 7>{{0, 1, 2, 3, 1, 5, 4}};
      if (share_edge)
        edge = SharedEdge{0, 1};
      for (unsigned int p = 0; p < Passing::n_points; ++p)
        for (unsigned int c = 0; c < 3; ++c)
          {
            old_x[p][c] = x[nodes[p]][c];
            new_x[p][c] = y[nodes[p]][c];
          }
    }

    bool
    is_one() const
    {
      return edge
        ? Passing::past_edge(old_x, *edge) < 0. &&
          Passing::past_edge(new_x, *edge) > 0.
        : Passing::difference(old_x) * Passing::difference(new_x) < 0.;
    }

    static double
    gap_before(const Passing::Points<double> &x, const unsigned int triangle)
    {
      const unsigned int a = 1 + 3 * triangle;
      return gap({{x[0], x[a], x[a + 1], x[a + 2]}});
    }

    Passing::Points<double>   old_x, new_x;
    std::optional<SharedEdge> edge;
  };
} // namespace



// A point passes from one triangle to another.
BOOST_AUTO_TEST_CASE(rows_are_exact_past_edges)
{
  unsigned int n_passages = 0;
  for (const bool share_edge : {true, false})
    for (const double turn : {-1., -.1, -1e-6, 0., 1e-6, .1, 1.})
      for (const double size : {1e-6, 1e-3, 1e-2})
        for (unsigned int k = 0; k < 40; ++k)
          {
            const Passage passage(share_edge, turn, size);
            if (!passage.is_one())
              continue;
            ++n_passages;
            Passing::Rows rows;
            Passing::evaluate(passage.old_x,
                              passage.new_x,
                              passage.edge,
                              Caution::none,
                              rows);
            const double increment = Passage::gap_before(passage.new_x, 1) -
              Passage::gap_before(passage.old_x, 0);
            BOOST_CHECK_SMALL(rows.gap_increment - increment, 2e-15);
            BOOST_CHECK_SMALL(rows.new_gap -
                                Passage::gap_before(passage.new_x, 1),
                              2e-15);
            double       product = 0.;
            Tensor<1, 3> sum, moment;
            for (unsigned int p = 0; p < Passing::n_points; ++p)
              {
                Tensor<1, 3> force, x;
                for (unsigned int c = 0; c < 3; ++c)
                  {
                    force[c] = rows.normal[3 * p + c];
                    x[c]     = .5 * (passage.old_x[p][c] + passage.new_x[p][c]);
                    product +=
                      force[c] * (passage.new_x[p][c] - passage.old_x[p][c]);
                  }
                sum += force;
                moment += cross_product_3d(x, force);
              }
            BOOST_CHECK_SMALL(product - increment, 2e-15);
            BOOST_CHECK_SMALL(sum.norm(), 1e-14);
            BOOST_CHECK_SMALL(moment.norm(), 1e-14);
            for (const double entry : rows.normal)
              BOOST_CHECK_LT(std::abs(entry), 3.);
          }
  BOOST_CHECK_GT(n_passages, 500);
}



BOOST_AUTO_TEST_CASE(derivatives_past_edges)
{
  using AD                = Sacado::Fad::SLFad<double, Passing::n_coordinates>;
  unsigned int n_passages = 0;
  for (const bool share_edge : {true, false})
    for (const double turn : {-1., -.7, -.5, -.3, -.1, .1, .3, .5, .7, 1.})
      {
        const Passage passage(share_edge, turn, 1e-3);
        if (!passage.is_one())
          continue;
        ++n_passages;
        PointPassingTriangles<AD>::Points<AD> x;
        PointPassingTriangles<AD>::Rows       exact;
        for (unsigned int p = 0; p < Passing::n_points; ++p)
          for (unsigned int c = 0; c < 3; ++c)
            x[p][c] =
              AD(Passing::n_coordinates, 3 * p + c, passage.new_x[p][c]);
        PointPassingTriangles<AD>::evaluate(passage.old_x,
                                            x,
                                            passage.edge,
                                            Caution::none,
                                            exact);
        const double h = 1e-7;
        for (unsigned int j = 0; j < Passing::n_coordinates; ++j)
          {
            const auto at = [&](const double length) {
              Passing::Points<double> y = passage.new_x;
              y[j / 3][j % 3] += length;
              Passing::Rows rows;
              Passing::evaluate(passage.old_x,
                                y,
                                passage.edge,
                                Caution::none,
                                rows);
              return rows;
            };
            const Passing::Rows up = at(h), down = at(-h);
            const auto          check =
              [&](const double u, const double d, const AD &value) {
                BOOST_CHECK_SMALL((u - d) / (2. * h) - value.dx(j), 2e-6);
              };
            check(up.new_gap, down.new_gap, exact.new_gap);
            check(up.gap_increment, down.gap_increment, exact.gap_increment);
            for (unsigned int i = 0; i < Passing::n_coordinates; ++i)
              check(up.normal[i], down.normal[i], exact.normal[i]);
          }
      }
  BOOST_CHECK_GE(n_passages, 5);
}



BOOST_AUTO_TEST_CASE(derivatives_of_rows)
{
  for (unsigned int k = 0; k < 20; ++k)
    {
      const Position                   a = random_triangle(), b = moved(a, .1);
      std::array<std::array<AD, 3>, 4> x;
      PointBeforeTriangle<AD>::Rows    exact;
      for (unsigned int p = 0; p < 4; ++p)
        for (unsigned int c = 0; c < 3; ++c)
          x[p][c] = AD(12, 3 * p + c, b[p][c]);
      PointBeforeTriangle<AD>::evaluate(a, x, exact);
      const double h = 1e-6;
      for (unsigned int j = 0; j < 12; ++j)
        {
          Position plus = b, minus = b;
          plus[j / 3][j % 3] += h;
          minus[j / 3][j % 3] -= h;
          Rows up, down;
          PointBeforeTriangle<double>::evaluate(a, plus, up);
          PointBeforeTriangle<double>::evaluate(a, minus, down);
          const auto check =
            [&](const double u, const double d, const AD &value) {
              BOOST_CHECK_SMALL((u - d) / (2. * h) - value.dx(j), 1e-7);
            };
          check(up.new_gap, down.new_gap, exact.new_gap);
          for (unsigned int d = 0; d < 2; ++d)
            check(up.slip[d], down.slip[d], exact.slip[d]);
          for (unsigned int i = 0; i < 12; ++i)
            {
              check(up.normal[i], down.normal[i], exact.normal[i]);
              check(up.tangential[0][i],
                    down.tangential[0][i],
                    exact.tangential[0][i]);
              check(up.tangential[1][i],
                    down.tangential[1][i],
                    exact.tangential[1][i]);
            }
        }
    }
}



namespace
{
  const std::vector<std::string> treatments = {"persistent contact",
                                               "Ayyad-Barboteu two-step",
                                               "improved normal compliance",
                                               "Hauret-Le Tallec",
                                               "Signorini active set",
                                               "standard normal compliance",
                                               "penalty"};

  const std::vector<std::string> with_mortar = {
    "persistent contact, dual mortar",
    "Ayyad-Barboteu two-step, mortar",
    "Signorini active set, dual mortar",
    "standard normal compliance, mortar"};

  /// Treatments with points and with mortar.
  std::vector<std::string>
  all_treatments()
  {
    std::vector<std::string> all = treatments;
    all.insert(all.end(), with_mortar.begin(), with_mortar.end());
    return all;
  }

  Material<3>
  rubber(const double stiffness)
  {
    return {std::make_shared<Hyperelastic<3>>(
              std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
                NeoHookean{stiffness, stiffness}),
              PlaneState::plane_strain),
            Viscosity{}};
  }

  /// Contact boundaries and motion.
  struct Motion
  {
    void
    set_treatment(const std::string &treatment,
                  const double       friction,
                  const std::string &scheme = "midpoint")
    {
      const auto comma             = treatment.find(", ");
      parameters.contact.treatment = treatment.substr(0, comma);
      if (comma != std::string::npos)
        parameters.contact.coupling = treatment.substr(comma + 2);
      parameters.scheme.name                              = scheme;
      parameters.contact.values["Compliance coefficient"] = 2e4;
      parameters.contact.values["Compliance exponent"]    = 2.;
      parameters.contact.values["Penalty epsilon0"]       = 1e-4;
      parameters.contact.values["Augmentation"]           = 500.;
      parameters.contact.values["Friction coefficient"]   = friction;
      parameters.contact.values["Tangential compliance"]  = 300.;
      parameters.newton.reuse_tangent_below               = 0.;
    }

    double
    mechanical_energy() const
    {
      return impact->system.kinetic_energy(state.velocity) +
        impact->bulk->energy(state.solution);
    }

    StepReport
    step(const double time_step)
    {
      State            next;
      const StepReport report =
        impact->scheme->step(impact->system, state, time_step, next);
      next.time = state.time + time_step;
      touched   = touched || next.contact_force.l2_norm() > 0.;
      state     = next;
      return report;
    }

    std::unique_ptr<Triangulation<3>> mesh;
    ImpactParameters                  parameters = on_all_ranks();
    std::unique_ptr<Impact<3>>        impact;
    State                             state;
    bool                              touched = false;
  };

  /// Two balls of radius 1, of tetrahedra and of hexahedra or both alike, that meet off
  /// their centres. Their meshes do not match. With degree 2 tetrahedra are curved.
  struct Collision : Motion
  {
    Collision(const std::string &treatment,
              const double       friction,
              const bool         tetrahedra,
              const bool         linear = false,
              const unsigned int degree = 1,
              const std::string &scheme = "midpoint")
    {
      CellNodes<3>   nodes;
      const double   offset = linear ? 0. : .5;
      const double   along  = std::sqrt(2.02 * 2.02 - offset * offset);
      const Point<3> left(-.5 * along, -.5 * offset, .1),
        right(.5 * along, .5 * offset, -.1);
      mesh = distribute_mesh<3>(
        [&](Triangulation<3> &whole) {
          Triangulation<3> bodies[2];
          if (tetrahedra)
            {
              CellNodes<3> own[2];
              for (const unsigned int p : {0, 1})
                {
                  make_ball_of_tetrahedra(p == 0 ? left : right,
                                          1.,
                                          (p == 0 ? .8 : .7) * degree,
                                          bodies[p],
                                          degree == 1 ? nullptr : &own[p]);
                  nodes.insert(nodes.end(), own[p].begin(), own[p].end());
                }
            }
          else
            {
              make_ball_of_hexahedra(left, 1., 1.2, bodies[0]);
              dealii::GridGenerator::hyper_ball(bodies[1], right, 1.);
            }
          Triangulation<3> parts[2];
          for (unsigned int p = 0; p < 2; ++p)
            {
              bodies[p].set_all_manifold_ids(dealii::numbers::flat_manifold_id);
              if (!tetrahedra && p == 1 && degree == 1)
                bodies[p].refine_global(1);
              if (tetrahedra)
                parts[p].copy_triangulation(bodies[p]);
              else
                dealii::GridGenerator::flatten_triangulation(bodies[p],
                                                             parts[p]);
              for (const auto &cell : parts[p].active_cell_iterators())
                for (const auto &face : cell->face_iterators())
                  if (face->at_boundary())
                    face->set_boundary_id(p + 1);
            }
          join_parts<3>({&parts[0], &parts[1]}, whole);
        },
        MPI_COMM_WORLD);
      set_treatment(treatment, friction, scheme);
      const Material<3> soft  = linear ? Material<3>(LinearElastic{200., 200.})
                                       : rubber(200.),
                        stiff = linear ? Material<3>(LinearElastic{300., 300.})
                                       : rubber(300.);
      ImpactSetup<3> setup{soft};
      setup.parts.push_back({"left", soft, 1.});
      setup.parts.push_back({"right", stiff, 2.});
      setup.pairs  = {{"balls", {1}, {2}}};
      setup.degree = degree;
      if (degree == 2 && tetrahedra)
        setup.geometry = make_curved_geometry(nodes, *mesh, MPI_COMM_WORLD);
      impact =
        std::make_unique<Impact<3>>(parameters, *mesh, setup, MPI_COMM_WORLD);
      state = impact->state_in_motion(dealii::FunctionFromFunctionObjects<3>(
        {[=](const Point<3> &x) {
           return x.distance(left) < x.distance(right) ? 1. : -1.;
         },
         [](const Point<3> &) { return 0.; },
         [](const Point<3> &) { return 0.; }}));
    }
  };

  /// A free block with a slit in 3D: its two arms fly at each other, turn, and
  /// the upper one slides along the lower one. Their meshes do not match.
  struct Clamp : Motion
  {
    Clamp(const std::string &treatment,
          const double       friction,
          const bool         tetrahedra,
          const bool         matching = false)
    {
      mesh = distribute_mesh<3>(
        [&](Triangulation<3> &whole) {
          // The slit is the middle one of three layers, except for the first
          // cells along x.
          dealii::Table<3, dealii::types::material_id> cells(4, 2, 3);
          for (unsigned int i = 1; i < 4; ++i)
            for (unsigned int j = 0; j < 2; ++j)
              cells(i, j, 1) = dealii::numbers::invalid_material_id;
          Triangulation<3> block, pieces;
          dealii::GridGenerator::subdivided_hyper_rectangle(block,
                                                            {{.5, .5, .5, .5},
                                                             {.5, .5},
                                                             {.4, .1, .4}},
                                                            Point<3>(),
                                                            cells);
          if (!matching)
            dealii::GridTools::transform(
              [](const Point<3> &x) {
                const double up = x[2] > .45 ? 1. : 0.;
                return Point<3>(x[0] + up * .13 * x[0],
                                x[1] + up * .17 * x[0],
                                x[2] + .02 * x[1] * (1. - 2. * up));
              },
              block);
          if (tetrahedra)
            dealii::GridGenerator::convert_hypercube_to_simplex_mesh(block,
                                                                     pieces);
          whole.copy_triangulation(tetrahedra ? pieces : block);
          for (const auto &cell : whole.active_cell_iterators())
            {
              cell->set_material_id(0);
              for (const auto &face : cell->face_iterators())
                if (face->at_boundary())
                  face->set_boundary_id(1);
            }
        },
        MPI_COMM_WORLD);
      set_treatment(treatment, friction);
      // Few points carry a whole arm.
      parameters.contact.values["Compliance coefficient"] = 4e3;
      const Material<3> soft                              = rubber(200.);
      ImpactSetup<3>    setup{soft};
      setup.pairs = {touching_itself({1})};
      impact =
        std::make_unique<Impact<3>>(parameters, *mesh, setup, MPI_COMM_WORLD);
      state = impact->state_in_motion(dealii::FunctionFromFunctionObjects<3>(
        {[](const Point<3> &x) { return x[2] - .45; },
         [=](const Point<3> &x) {
           return (matching ? 0. : 1.) * x[0] * (x[2] - .45);
         },
         [](const Point<3> &x) {
           return .5 * x[0] * (x[2] > .45 ? -1. : 1.);
         }}));
    }
  };

  constexpr double       time_step = .02;
  constexpr unsigned int n_steps   = 15;
} // namespace



namespace
{
  /// A block, part 1, above one end of a long bar, part 0.
  void
  make_block_above_bar(const bool tetrahedra, Triangulation<3> &whole)
  {
    Triangulation<3> parts[2];
    for (unsigned int p = 0; p < 2; ++p)
      {
        Triangulation<3> bricks;
        dealii::GridGenerator::subdivided_hyper_rectangle(
          bricks,
          {p == 0 ? 40U : 4U, 4, 2},
          p == 0 ? Point<3>(0., 0., -.5) : Point<3>(.1, .1, .02),
          p == 0 ? Point<3>(10., 1., 0.) : Point<3>(1.1, .9, .5));
        if (tetrahedra)
          dealii::GridGenerator::convert_hypercube_to_simplex_mesh(bricks,
                                                                   parts[p]);
        else
          parts[p].copy_triangulation(bricks);
        for (const auto &cell : parts[p].active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              face->set_boundary_id(p);
      }
    join_parts<3>({&parts[0], &parts[1]}, whole);
  }
} // namespace



// Features by hand: of a cube of 2 x 2 x 2 cells 20 nodes and 24 edges, of one face of it its 8
// border nodes, and of two faces side by side the border of both and the edge between them. Sides of
// one cube are connected, different cubes are not.
BOOST_AUTO_TEST_CASE(features_by_hand)
{
  Triangulation<3> parts[2], whole;
  for (unsigned int p = 0; p < 2; ++p)
    {
      dealii::GridGenerator::subdivided_hyper_rectangle(
        parts[p],
        {2, 2, 2},
        Point<3>(2. * p, 0., 0.),
        Point<3>(2. * p + 1., 1., 1.),
        /* colorize */ true);
      for (const auto &cell : parts[p].active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(face->boundary_id() + 6 * p);
    }
  join_parts<3>({&parts[0], &parts[1]}, whole);
  const auto mesh = distribute_mesh<3>(
    [&](Triangulation<3> &to) { to.copy_triangulation(whole); },
    MPI_COMM_WORLD);
  const std::set<dealii::types::boundary_id> first = {0, 1, 2, 3, 4, 5},
                                             other = {6, 7, 8, 9, 10, 11};
  std::set<dealii::types::boundary_id> all         = first;
  all.insert(other.begin(), other.end());
  const Body<3> body(*mesh, 1, {}, all, MultiplierSpace::none, MPI_COMM_WORLD);
  const auto    check = [&](const std::set<dealii::types::boundary_id> &ids,
                         const unsigned int                          n_nodes,
                         const unsigned int                          n_edges) {
    const SurfaceFeatures features = features_of(ContactSurface<3>(body, ids));
    BOOST_CHECK_EQUAL(std::count(features.is_on.begin(),
                                 features.is_on.end(),
                                 true),
                      n_nodes);
    BOOST_CHECK_EQUAL(features.edges.size(), n_edges);
  };
  check(first, 20, 24);
  check({5}, 8, 8);
  check({1, 5}, 13, 14);
  const auto groups = ContactSurface<3>(body, all).connected_boundaries();
  BOOST_REQUIRE_EQUAL(groups.size(), 2);
  BOOST_CHECK(groups[0] == first && groups[1] == other);
  BOOST_CHECK_EQUAL(
    ContactSurface<3>(body, {0, 1}).connected_boundaries().size(),
    2);
}



// Near patches, against the distances of all facets; and data received by
// ranks: positions of nodes of far patches are not sent, and gaps are right
// without.
BOOST_AUTO_TEST_CASE(only_what_comes_near_is_known)
{
  for (const bool tetrahedra : {false, true})
    {
      const auto mesh = distribute_mesh<3>(
        [&](Triangulation<3> &whole) {
          make_block_above_bar(tetrahedra, whole);
        },
        MPI_COMM_WORLD);
      const Body<3>           body(*mesh,
                         1,
                         {},
                         {0, 1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
      const ContactSurface<3> bar(body, {0});

      // Boxes of patches, around a place that only the last rank has.
      const FacetPatches<3>              patches(bar, MPI_COMM_WORLD);
      std::vector<std::array<double, 3>> positions;
      for (const auto &node : bar.nodes)
        positions.push_back({{node.reference_position[0],
                              node.reference_position[1],
                              node.reference_position[2]}});
      constexpr double   reach = .3;
      const Point<3>     place(9., .5, .2);
      const unsigned int n_ranks =
        dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
      const bool is_last =
        dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) + 1 == n_ranks;
      std::vector<FacetPatches<3>::Box> places;
      if (is_last)
        places.emplace_back(std::pair(place, place));
      const auto   near = patches.near(places, reach, positions, positions);
      unsigned int n_facets_near = 0;
      for (const unsigned int patch : near)
        n_facets_near += patches.facets_of(patch).size();
      if (!is_last)
        BOOST_CHECK(near.empty());
      for (unsigned int f = 0; is_last && f < bar.facets.size(); ++f)
        for (const unsigned int n : bar.facets[f].nodes)
          if (bar.nodes[n].reference_position.distance(place) < reach)
            BOOST_CHECK(std::binary_search(near.begin(),
                                           near.end(),
                                           patches.patch_of(f)));
      if (is_last)
        {
          BOOST_CHECK_GT(n_facets_near, 0);
          BOOST_CHECK_LT(n_facets_near, bar.facets.size() / 4);
        }
      // Six steps of a quarter of a metre from a patch.
      for (const unsigned int patch : near)
        {
          const auto around = patches.around(patch, 6);
          BOOST_CHECK(std::binary_search(around.begin(), around.end(), patch));
          BOOST_CHECK_GT(around.size(), 1);
          BOOST_CHECK_LT(around.size(), patches.size());
        }

      // The block hovers above the near end of the bar.
      PointsBeforeTriangles pair(body,
                                 {"block", {1}, {0}},
                                 PointsBeforeTriangles::PointsIn::nodes,
                                 /* has_coverage */ false);
      const Vector          zero = body.make_vector();
      pair.begin_step({zero, zero, zero, 1e-3});
      unsigned int n_known = 0, n_before = 0;
      for (unsigned int f = 0; f < pair.master_surface().facets.size(); ++f)
        n_known += pair.is_known(f);
      for (unsigned int p = 0; p < pair.points().size(); ++p)
        if (pair.is_before_facet(p) && pair.old_gap(p) < .1)
          {
            BOOST_CHECK_SMALL(pair.old_gap(p) - .02, 1e-14);
            ++n_before;
          }
      // The nodes of the block's lower side; tetrahedra have one more in each square.
      BOOST_CHECK_EQUAL(dealii::Utilities::MPI::sum(n_before, MPI_COMM_WORLD),
                        tetrahedra ? 25 + 16 : 25);
      if (n_ranks > 1)
        BOOST_CHECK_LT(dealii::Utilities::MPI::sum(n_known, MPI_COMM_WORLD),
                       1.5 * bar.facets.size());
    }
}



// The surface of a box has no open edge, of whatever cells.
BOOST_AUTO_TEST_CASE(surfaces_hang_together)
{
  for (const bool simplices : {false, true})
    {
      Triangulation<3> box, tetrahedra;
      dealii::GridGenerator::subdivided_hyper_rectangle(box,
                                                        {2, 3, 2},
                                                        Point<3>(),
                                                        Point<3>(2., 3., 4.));
      dealii::GridGenerator::convert_hypercube_to_simplex_mesh(box, tetrahedra);
      const auto mesh = distribute_mesh<3>(
        [&](Triangulation<3> &whole) {
          whole.copy_triangulation(simplices ? tetrahedra : box);
        },
        MPI_COMM_WORLD);
      const Body<3>           body(*mesh,
                         1,
                         {},
                         {0},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
      const ContactSurface<3> surface(body, {0});
      double                  area = 0.;
      Tensor<1, 3>            vector_area;
      for (const auto &facet : surface.facets)
        {
          area += facet.measure;
          vector_area += facet.measure * facet.normal;
          for (const auto &neighbour : facet.neighbours)
            BOOST_CHECK(neighbour.has_value());
          // Anticlockwise from outside.
          std::array<Point<3>, 3> x;
          for (unsigned int v = 0; v < 3; ++v)
            x[v] = surface.nodes[facet.nodes[v]].reference_position;
          const Tensor<1, 3> n = cross_product_3d(Tensor<1, 3>(x[1] - x[0]),
                                                  Tensor<1, 3>(x[2] - x[0]));
          BOOST_CHECK_SMALL((.5 * n - facet.measure * facet.normal).norm(),
                            1e-12);
        }
      BOOST_CHECK_CLOSE(area, 2. * (6. + 8. + 12.), 1e-10);
      BOOST_CHECK_SMALL(vector_area.norm(), 1e-12);
    }
}



// The closest facet is that of all facets one by one, also among some of them only, and
// none beyond the largest distance.
BOOST_AUTO_TEST_CASE(closest_facets_are_found)
{
  Triangulation<3> box, tetrahedra;
  dealii::GridGenerator::subdivided_hyper_rectangle(box,
                                                    {4, 5, 3},
                                                    Point<3>(),
                                                    Point<3>(4., 5., 3.));
  dealii::GridGenerator::convert_hypercube_to_simplex_mesh(box, tetrahedra);
  const auto mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) { whole.copy_triangulation(tetrahedra); },
    MPI_COMM_WORLD);
  const Body<3> body(*mesh, 1, {}, {0}, MultiplierSpace::none, MPI_COMM_WORLD);
  const ContactSurface<3>                surface(body, {0});
  std::mt19937                           generator(3);
  std::uniform_real_distribution<double> noise(-1., 1.);
  using Position = std::array<double, 3>;
  std::vector<Position> positions;
  for (const auto &node : surface.nodes)
    {
      positions.emplace_back();
      for (unsigned int c = 0; c < 3; ++c)
        positions.back()[c] =
          node.reference_position[c] + .2 * noise(generator);
    }
  std::vector<unsigned int> facets(surface.facets.size()), some;
  std::iota(facets.begin(), facets.end(), 0U);
  for (const unsigned int f : facets)
    if (f % 7 != 0)
      some.push_back(f);
  const FacetSearch<3> search(surface, positions),
    search_of_some(surface, positions, some);
  FacetsAround<3>    around(surface, positions);
  const unsigned int n_facets = facets.size();
  const auto         faces = [&](const unsigned int f, const Position &normal) {
    const auto own     = facet_normal<3>(surface, positions, f);
    double     product = 0.;
    for (unsigned int c = 0; c < 3; ++c)
      product += own[c] * normal[c];
    return product < 0.;
  };
  unsigned int n_far = 0;
  for (unsigned int k = 0; k < 300; ++k)
    {
      Position y, normal;
      // Inside and around, and some far away.
      const double size = k % 3 == 0 ? 20. : 4.;
      for (unsigned int c = 0; c < 3; ++c)
        {
          y[c]      = 2. + size * noise(generator);
          normal[c] = noise(generator);
        }
      const auto closest = [&](const std::vector<unsigned int> &of) {
        return FacetsAround<3>(surface, positions)
          .closest_facing(of, y, normal);
      };
      BOOST_REQUIRE(closest(facets));
      BOOST_CHECK(search.closest_facing(y, normal) == closest(facets));
      BOOST_CHECK(search_of_some.closest_facing(y, normal) == closest(some));
      BOOST_CHECK(search.closest_facing(y, normal, [&](const unsigned int f) {
        return f % 7 != 0 && faces(f, normal);
      }) == closest(some));
      // Any likely facet, and any earlier queries.
      for (const unsigned int likely :
           std::vector<unsigned int>{*closest(facets),
                                     n_facets / 2,
                                     n_facets + 3})
        {
          BOOST_CHECK(search_of_some.closest_facing(
                        y,
                        normal,
                        {},
                        std::numeric_limits<double>::infinity(),
                        likely) == closest(some));
          BOOST_CHECK(around.closest_facing(some, y, normal, likely) ==
                      closest(some));
        }
      const auto within = search.closest_facing(
        y,
        normal,
        [&](const unsigned int f) { return faces(f, normal); },
        3.);
      BOOST_CHECK(!within || within == closest(facets));
      n_far += within ? 0 : 1;
    }
  BOOST_CHECK_GT(n_far, 60);
  BOOST_CHECK_LT(n_far, 200);
}



namespace
{
  /// Energies and momenta over some steps.
  void
  check_balances(Motion            &motion,
                 const std::string &treatment,
                 const double       friction)
  {
    const Momenta<3> momenta(motion.impact->body,
                             motion.impact->system.mass_matrix(),
                             /* small strains */ false);
    const double     first  = motion.mechanical_energy();
    const auto       linear = momenta.linear(motion.state.velocity);
    const auto       angular =
      momenta.angular(motion.state.solution, motion.state.velocity);
    double old = first, friction_work = 0., most = first;
    for (unsigned int n = 0; n < n_steps; ++n)
      {
        const StepReport report = motion.step(time_step);
        const double     now    = motion.mechanical_energy();
        BOOST_CHECK_SMALL(
          (now - old + report.contact_work + report.friction_work) / first,
          1e-11);
        BOOST_CHECK_GE(report.friction_work, -1e-12 * first);
        friction_work += report.friction_work;
        most = std::max(most, now + friction_work);
        if (treatment.find("persistent contact") == 0 ||
            treatment.find("Ayyad-Barboteu two-step") == 0)
          BOOST_CHECK_SMALL((now + friction_work - first) / first, 1e-9);
        if (treatment.find("Signorini active set") == 0)
          BOOST_CHECK_LE(now + report.friction_work, old + 1e-11 * first);
        old = now;
      }
    BOOST_TEST_MESSAGE(treatment << ", mu = " << friction << ": energy "
                                 << old / first << ", most " << most / first
                                 << ", friction " << friction_work / first);
    BOOST_CHECK(motion.touched);
    if (friction > 0.)
      BOOST_CHECK_GT(friction_work, 1e-4 * first);
    BOOST_CHECK_SMALL((momenta.linear(motion.state.velocity) - linear).norm(),
                      1e-10);
    BOOST_CHECK_SMALL(
      (momenta.angular(motion.state.solution, motion.state.velocity) - angular)
        .norm(),
      1e-10);
  }

  /// The tangent of contact at a state near @p solution, where some points touch and
  /// slide. @param least_product contact acts there.
  void
  check_tangent(Motion &motion, Vector solution, const double least_product)
  {
    ContactOperator &contact = *motion.impact->contact;
    const Body<3>   &body    = motion.impact->body;
    Vector           noise(solution), direction(solution);
    randomise(noise, 1e-3, 1);
    randomise(direction, 1., 2);
    // No pressure becomes negative by it: friction turns with positive ones only.
    for (const auto i : body.multiplier_indices())
      noise(i) = std::abs(noise(i));
    noise.compress(dealii::VectorOperation::insert);
    solution += noise;
    check_contact_tangent(contact,
                          body,
                          motion.state,
                          motion.parameters.scheme.name,
                          time_step,
                          solution,
                          direction,
                          least_product);
  }
} // namespace



BOOST_AUTO_TEST_CASE(balances_close_and_momenta_are_kept)
{
  for (const bool tetrahedra : {true, false})
    for (const std::string &treatment : fewer_in_debug(all_treatments()))
      for (const double friction : {0., .3})
        {
          if (friction > 0. && (treatment == "penalty" || !tetrahedra))
            continue;
          BOOST_TEST_CONTEXT(treatment
                             << ", mu = " << friction << ", "
                             << (tetrahedra ? "tetrahedra" : "hexahedra"))
          {
            Collision        balls(treatment, friction, tetrahedra);
            const Momenta<3> left(balls.impact->body,
                                  balls.impact->system.mass_matrix(),
                                  false,
                                  2,
                                  0);
            const auto       left_before = left.linear(balls.state.velocity);
            check_balances(balls, treatment, friction);
            BOOST_CHECK_GT(
              (left.linear(balls.state.velocity) - left_before).norm(),
              .2);
          }
        }
}



namespace
{
  void
  check_tangent_of_balls(const std::string &treatment,
                         const double       friction,
                         const bool         tetrahedra,
                         const std::string &scheme)
  {
    BOOST_TEST_CONTEXT(treatment << ", mu = " << friction << ", " << scheme)
    {
      Collision balls(treatment, friction, tetrahedra, false, 1, scheme);
      while (balls.state.contact_force.l2_norm() < 1.)
        balls.step(time_step);
      Vector solution(balls.state.solution);
      solution.add(time_step, balls.state.velocity);
      const auto parts = balls.impact->body.parts_of_unknowns(2);
      Vector     along = balls.impact->uniform(Tensor<1, 3>({.01, 0., 0.}));
      for (unsigned int i = 0; i < parts.size(); ++i)
        if (parts[i] == 0)
          local_values(solution)[i] += local_values(along)[i];
      check_tangent(balls,
                    solution,
                    treatment.find("mortar") == std::string::npos ? 1. : .1);
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(tangents_are_quotients_of_differences)
{
  for (const bool tetrahedra : {true, false})
    for (const double friction : {0., .3})
      {
        for (const std::string &treatment : fewer_in_debug(all_treatments()))
          if (friction == 0. || treatment != "penalty")
            check_tangent_of_balls(treatment, friction, tetrahedra, "midpoint");
        for (const std::string treatment :
             {"Signorini active set", "standard normal compliance"})
          check_tangent_of_balls(treatment, friction, tetrahedra, "HHT");
      }
}



BOOST_AUTO_TEST_CASE(surfaces_against_themselves)
{
  for (const bool tetrahedra : {true, false})
    for (const std::string &treatment : fewer_in_debug(treatments))
      for (const double friction : {0., .3})
        {
          // With friction, and on hexahedra, one of each kind.
          if ((friction > 0. || !tetrahedra) &&
              treatment != "persistent contact" &&
              treatment != "improved normal compliance")
            continue;
          BOOST_TEST_CONTEXT(treatment
                             << ", mu = " << friction << ", "
                             << (tetrahedra ? "tetrahedra" : "hexahedra"))
          {
            Clamp clamp(treatment, friction, tetrahedra);
            // Nothing touches while the slit is open.
            clamp.step(time_step);
            BOOST_CHECK(!clamp.touched);
            while (clamp.state.contact_force.l2_norm() < .1)
              clamp.step(time_step);
            Vector solution(clamp.state.solution);
            solution.add(time_step, clamp.state.velocity);
            check_tangent(clamp, solution, .1);
            check_balances(clamp, treatment, friction);
          }
        }
}



// Nodes that come down on nodes: of two constraints that are the same one is left out.
BOOST_AUTO_TEST_CASE(own_nodes_on_nodes)
{
  for (const std::string treatment :
       {"persistent contact", "Signorini active set"})
    BOOST_TEST_CONTEXT(treatment)
    {
      Clamp clamp(treatment, 0., false, /* matching */ true);
      check_balances(clamp, treatment, 0.);
    }
}



// A time step, or as many halves of it as it takes, as in a run. Returns the number
// of steps that were halved.
unsigned int
step_or_halves(Impact<3>   &impact,
               State       &state,
               const double time_step,
               const double smallest = 1e-3)
{
  try
    {
      State next;
      impact.scheme->step(impact.system, state, time_step, next);
      next.time = state.time + time_step;
      state     = next;
      return 0;
    }
  catch (const NewtonFailure &)
    {
      if (time_step < smallest)
        throw;
      const unsigned int first_half =
        step_or_halves(impact, state, .5 * time_step, smallest);
      return 1 + first_half +
        step_or_halves(impact, state, .5 * time_step, smallest);
    }
}



// Cubes that meet with other parts than a point against a face: face on face
// with nodes on nodes or not, edge on face, edge across edge, corner on corner,
// and facets of very different size. Nothing fails, and no energy is created;
// with persistent contact points penetrate by the displacement of a step.
// Crossing edges, which points do not detect, penetrate until nodes are inside.
// A node on an edge or a corner is in unstable equilibrium: round-off, and so the
// processor, chooses when and to which side it slips, and that step may be halved.
BOOST_AUTO_TEST_CASE(degenerate_configurations)
{
  struct Configuration
  {
    std::string name;
    /// Cells along the edges of the left and the right cube.
    unsigned int left, right;
    /// Angles about y and z by which they are turned.
    double left_y, left_z, right_y, right_z;
    /// The right one is beside the left one by that much.
    double offset;
  };
  const double quarter                            = .25 * dealii::numbers::PI,
               corner                             = std::atan(std::sqrt(.5));
  const std::vector<Configuration> configurations = {
    {"face on face, nodes on nodes", 2, 2, 0., 0., 0., 0., 0.},
    {"face on face", 2, 3, 0., 0., 0., 0., .23},
    {"edge on face", 2, 2, 0., 0., 0., quarter, 0.},
    {"edge across edge", 2, 2, quarter, 0., 0., quarter, 0.},
    {"corner on corner", 2, 2, corner, quarter, corner, quarter, 0.},
    {"large and small facets", 1, 6, 0., 0., .1, .1, .1}};
  for (const std::string treatment : {"persistent contact",
                                      "Signorini active set",
                                      "persistent contact, mortar",
                                      "Signorini active set, dual mortar"})
    for (const Configuration &one : fewer_in_debug(configurations))
      BOOST_TEST_CONTEXT(treatment << ", " << one.name)
      {
        const auto mesh = distribute_mesh<3>(
          [&](Triangulation<3> &whole) {
            Triangulation<3> parts[2];
            double           reach[2];
            for (unsigned int p = 0; p < 2; ++p)
              {
                dealii::GridGenerator::subdivided_hyper_cube(parts[p],
                                                             p == 0 ? one.left
                                                                    : one.right,
                                                             -.5,
                                                             .5);
                dealii::GridTools::rotate(Tensor<1, 3>({0., 0., 1.}),
                                          p == 0 ? one.left_z : one.right_z,
                                          parts[p]);
                dealii::GridTools::rotate(Tensor<1, 3>({0., 1., 0.}),
                                          p == 0 ? one.left_y : one.right_y,
                                          parts[p]);
                reach[p] = 0.;
                for (const auto &x : parts[p].get_vertices())
                  reach[p] = std::max(reach[p], p == 0 ? x[0] : -x[0]);
                for (const auto &cell : parts[p].active_cell_iterators())
                  for (const auto &face : cell->face_iterators())
                    if (face->at_boundary())
                      face->set_boundary_id(p + 1);
              }
            dealii::GridTools::shift(Tensor<1, 3>({-reach[0] - .01, 0., 0.}),
                                     parts[0]);
            dealii::GridTools::shift(
              Tensor<1, 3>({reach[1] + .01, one.offset, .5 * one.offset}),
              parts[1]);
            join_parts<3>({&parts[0], &parts[1]}, whole);
          },
          MPI_COMM_WORLD);
        ImpactParameters parameters  = on_all_ranks();
        const auto       comma       = treatment.find(", ");
        parameters.contact.treatment = treatment.substr(0, comma);
        if (comma != std::string::npos)
          parameters.contact.coupling = treatment.substr(comma + 2);
        parameters.scheme.name                    = "midpoint";
        parameters.contact.values["Augmentation"] = 500.;
        const Material<3> soft                    = rubber(200.);
        ImpactSetup<3>    setup{soft};
        setup.parts.push_back({"left", soft, 1.});
        setup.parts.push_back({"right", soft, 1.});
        setup.pairs = {{"cubes", {1}, {2}}};
        Impact<3> impact(parameters, *mesh, setup, MPI_COMM_WORLD);
        State     state =
          impact.state_in_motion(dealii::FunctionFromFunctionObjects<3>(
            {[](const Point<3> &x) { return x[0] < 0. ? 1. : -1.; },
             [](const Point<3> &) { return 0.; },
             [](const Point<3> &) { return 0.; }}));
        const auto energy = [&]() {
          return impact.system.kinetic_energy(state.velocity) +
            impact.bulk->energy(state.solution);
        };
        const double first = energy();
        double       old = first, deepest = 0., largest_residual = 0.;
        bool         touched  = false;
        unsigned int n_halved = 0;
        impact.system.newton_observer =
          [&](const std::vector<NewtonSolver::Iteration> &history,
              const auto &) {
            // The guess may be far off where nothing else acts.
            for (unsigned int k = 1; k < history.size(); ++k)
              largest_residual =
                std::max(largest_residual, history[k].relative_residual);
          };
        for (unsigned int n = 0; n < 30; ++n)
          {
            n_halved += step_or_halves(impact, state, .01);
            touched          = touched || state.contact_force.l2_norm() > 0.;
            const double now = energy();
            BOOST_CHECK_LE(now, old + 1e-10 * first);
            if (treatment.find("persistent contact") == 0)
              BOOST_CHECK_SMALL(now / first - 1., 1e-10);
            old = now;
            deepest =
              std::max(deepest,
                       impact.contact
                         ->summary({state.solution, state.contact_force, 0.})
                         .at(1)
                         .max_penetration);
          }
        BOOST_TEST_MESSAGE(
          treatment << ", " << one.name << ": energy " << old / first
                    << ", deepest " << deepest << ", largest residual "
                    << largest_residual << ", halved steps " << n_halved);
        BOOST_CHECK(touched);
        BOOST_CHECK_LE(n_halved, 2);
        // Constraints that depend on each other would go to 1e15 and beyond.
        BOOST_CHECK_LT(largest_residual, 1e9);
        BOOST_CHECK_LT(deepest, .3);
      }
}



// The surface between all nodes has no open edge and is as far from a ball as that of
// cells of half the size. Constraints have a multiplier in each node.
BOOST_AUTO_TEST_CASE(displacements_of_degree_two)
{
  for (const bool tetrahedra : {true, false})
    for (const std::string &treatment :
         fewer_in_debug(std::vector<std::string>{"persistent contact",
                                                 "improved normal compliance",
                                                 "Signorini active set",
                                                 "penalty"}))
      BOOST_TEST_CONTEXT(
        treatment << (tetrahedra ? ", curved tetrahedra" : ", hexahedra"))
      {
        const double friction = treatment == "penalty" ? 0. : .3;
        Collision    balls(treatment, friction, tetrahedra, false, 2);
        const ContactSurface<3> surface(balls.impact->body, {1});
        double                  area = 0., farthest = 0.;
        for (const auto &facet : surface.facets)
          {
            area += facet.measure;
            for (const auto &neighbour : facet.neighbours)
              BOOST_CHECK(neighbour.has_value());
          }
        BOOST_CHECK_LT(area, 4. * dealii::numbers::PI);
        BOOST_CHECK_GT(area, .85 * 4. * dealii::numbers::PI);
        for (const auto &node : surface.nodes)
          farthest = std::max(
            farthest,
            std::abs(node.reference_position.distance(
                       Point<3>(-.5 * std::sqrt(2.02 * 2.02 - .25), -.25, .1)) -
                     1.));
        // All nodes of curved cells are on the ball.
        if (tetrahedra)
          BOOST_CHECK_SMALL(farthest, 1e-12);

        const Momenta<3> momenta(balls.impact->body,
                                 balls.impact->system.mass_matrix(),
                                 /* small strains */ false);
        const double     first  = balls.mechanical_energy();
        const auto       linear = momenta.linear(balls.state.velocity);
        const auto       angular =
          momenta.angular(balls.state.solution, balls.state.velocity);
        double old = first, friction_work = 0.;
        // A node of this mesh, whose facets meet at up to 30 degrees, comes onto a rounded
        // edge in a step.
        const unsigned int n_parts =
          treatment == "improved normal compliance" ? 2 : 1;
        for (unsigned int n = 0; n < n_parts * n_steps; ++n)
          {
            const StepReport report = balls.step(time_step / n_parts);
            const double     now    = balls.mechanical_energy();
            BOOST_CHECK_SMALL(
              (now - old + report.contact_work + report.friction_work) / first,
              1e-11);
            friction_work += report.friction_work;
            if (treatment == "persistent contact")
              BOOST_CHECK_SMALL((now + friction_work - first) / first, 1e-9);
            if (treatment == "Signorini active set")
              BOOST_CHECK_LE(now + report.friction_work, old + 1e-11 * first);
            old = now;
          }
        BOOST_TEST_MESSAGE(treatment << ": energy " << old / first
                                     << ", friction " << friction_work / first
                                     << ", area " << area);
        BOOST_CHECK(balls.touched);
        // The hexahedra stick, or nearly so.
        if (friction > 0. && tetrahedra)
          BOOST_CHECK_GT(friction_work, 1e-2 * first);
        else
          BOOST_CHECK_GE(friction_work, -1e-12 * first);
        BOOST_CHECK_SMALL(
          (momenta.linear(balls.state.velocity) - linear).norm(),
          1e-10);
        BOOST_CHECK_SMALL((momenta.angular(balls.state.solution,
                                           balls.state.velocity) -
                           angular)
                            .norm(),
                          1e-10);
      }
}



BOOST_AUTO_TEST_CASE(linear_bodies_and_overlaps)
{
  Collision    balls("persistent contact", 0., true, /* linear */ true);
  const double first = balls.mechanical_energy();
  for (unsigned int n = 0; n < n_steps; ++n)
    {
      balls.step(time_step);
      BOOST_CHECK_SMALL(balls.mechanical_energy() / first - 1., 1e-10);
    }
  BOOST_CHECK(balls.touched);

  // One inside of the other.
  const auto mesh = distribute_mesh<3>(
    [&](Triangulation<3> &whole) {
      Triangulation<3> parts[2];
      make_ball_of_tetrahedra(Point<3>(), 1., .8, parts[0]);
      make_ball_of_tetrahedra(Point<3>(1.5, 0., 0.), 1., .7, parts[1]);
      join_parts<3>({&parts[0], &parts[1]}, whole);
    },
    MPI_COMM_WORLD);
  const Material<3> soft(LinearElastic{200., 200.});
  ImpactSetup<3>    setup{soft};
  setup.parts.push_back({"left", soft, 1.});
  setup.parts.push_back({"right", soft, 1.});
  setup.pairs = {{"balls", {1}, {2}}};
  BOOST_CHECK_THROW(Impact<3>(balls.parameters, *mesh, setup, MPI_COMM_WORLD)
                      .state_in_flight(Tensor<1, 3>()),
                    InputError);
}

BOOST_AUTO_TEST_SUITE_END()
