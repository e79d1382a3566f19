// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The gap to surfaces with rounded edges: increments are exact at random states, factors
// are quotients of differences, and points in front of one triangle have its distance;
// rows of points on random surfaces.

#include <base/types.h>
#include <boost/test/unit_test.hpp>
#include <contact/kinematics/points_before_triangles.h>
#include <contact/surfaces/rounded_gap.h>
#include <discretization/body.h>
#include <problems/part_meshes.h>

#include <deal.II/distributed/shared_tria.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_generator.h>

#include <Sacado_Fad_SLFad.hpp>

#include <map>
#include <random>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;
using dealii::Triangulation;

BOOST_AUTO_TEST_SUITE(rounded_gap)

namespace
{
  std::mt19937 generator(7);

  double
  random_number(const double size)
  {
    return std::uniform_real_distribution<double>(-size, size)(generator);
  }

  /// Triangles around a node, in a ring, with the point near the middle: triangle
  /// k has an edge with the next one, and the first and the third one also have open edges.
  /// The values are the distances from the planes, and the coordinates of edges and of open edges.
  template <typename Number>
  void
  set_ring(RoundedGap<Number>        &gap,
           const std::vector<double> &old_values,
           const std::vector<Number> &new_values)
  {
    const unsigned int n = (old_values.size() - 3) / 2;
    gap.old_gaps.assign(old_values.begin(), old_values.begin() + n);
    gap.new_gaps.assign(new_values.begin(), new_values.begin() + n);
    gap.counts.assign(n, true);
    gap.edges.clear();
    for (unsigned int k = 0; k < n; ++k)
      gap.edges.push_back(
        {k, (k + 1) % n, .1, old_values[n + k], new_values[n + k]});
    gap.open_edges.clear();
    for (unsigned int k = 0; k < 3; ++k)
      gap.open_edges.push_back(
        {k == 2 ? 2U : 0U, .12, old_values[2 * n + k], new_values[2 * n + k]});
  }
} // namespace



BOOST_AUTO_TEST_CASE(increments_are_exact)
{
  constexpr unsigned int n        = 8;
  unsigned int           n_states = 0;
  for (const double size : {1e-12, 1e-6, 1e-2, .3})
    for (unsigned int k = 0; k < 200; ++k)
      {
        std::vector<double> old_values(2 * n + 3), new_values(2 * n + 3);
        for (unsigned int i = 0; i < 2 * n + 3; ++i)
          {
            old_values[i] = random_number(.15);
            new_values[i] = old_values[i] + random_number(size);
          }
        RoundedGap<double> gap;
        set_ring(gap, old_values, new_values);
        if (!gap.evaluate())
          continue;
        ++n_states;
        double     of_gap = 0., of_coverage = 0.;
        const auto change = [&](const unsigned int i) {
          return new_values[i] - old_values[i];
        };
        for (unsigned int i = 0; i < n; ++i)
          {
            of_gap +=
              gap.of_gaps[i] * change(i) + gap.of_edges[i] * change(n + i);
            of_coverage += gap.coverage_of_edges[i] * change(n + i);
          }
        for (unsigned int i = 0; i < 3; ++i)
          of_coverage += gap.coverage_of_open[i] * change(2 * n + i);
        BOOST_CHECK_SMALL(of_gap - (gap.new_gap - gap.old_gap), 1e-13);
        BOOST_CHECK_SMALL(of_coverage - (gap.new_coverage - gap.old_coverage),
                          1e-13);
      }
  BOOST_CHECK_GT(n_states, 400);
}



BOOST_AUTO_TEST_CASE(factors_are_quotients_of_differences)
{
  constexpr unsigned int n = 4;
  constexpr unsigned int m = 2 * n + 3;
  using AD                 = Sacado::Fad::SLFad<double, m>;
  for (unsigned int k = 0; k < 50; ++k)
    {
      std::vector<double> old_values(m), new_values(m);
      std::vector<AD>     variables;
      for (unsigned int i = 0; i < m; ++i)
        {
          old_values[i] = random_number(.08);
          new_values[i] = random_number(.08);
          variables.emplace_back(m, i, new_values[i]);
        }
      RoundedGap<AD> derivatives;
      set_ring(derivatives, old_values, variables);
      BOOST_REQUIRE(derivatives.evaluate());
      for (unsigned int j = 0; j < m; ++j)
        {
          constexpr double    h = 1e-6;
          RoundedGap<double>  up, down;
          std::vector<double> shifted = new_values;
          shifted[j] += h;
          set_ring(up, old_values, shifted);
          shifted[j] -= 2. * h;
          set_ring(down, old_values, shifted);
          BOOST_REQUIRE(up.evaluate() && down.evaluate());
          const auto check =
            [&](const AD &value, const double a, const double b) {
              BOOST_CHECK_SMALL(value.dx(j) - (a - b) / (2. * h),
                                1e-6 * (1. + std::abs(value.dx(j))));
            };
          check(derivatives.new_gap, up.new_gap, down.new_gap);
          check(derivatives.new_coverage, up.new_coverage, down.new_coverage);
          for (unsigned int i = 0; i < 3; ++i)
            check(derivatives.coverage_of_open[i],
                  up.coverage_of_open[i],
                  down.coverage_of_open[i]);
          for (unsigned int i = 0; i < n; ++i)
            {
              check(derivatives.of_gaps[i], up.of_gaps[i], down.of_gaps[i]);
              check(derivatives.of_edges[i], up.of_edges[i], down.of_edges[i]);
              check(derivatives.coverage_of_edges[i],
                    up.coverage_of_edges[i],
                    down.coverage_of_edges[i]);
            }
        }
    }
}



// By hand: two triangles; on the edge the mean of both distances, behind it the second one,
// and in between by sigma(1/2) = 27/32.
BOOST_AUTO_TEST_CASE(two_triangles_by_hand)
{
  RoundedGap<double> gap;
  gap.counts   = {true, true};
  gap.old_gaps = gap.new_gaps = {1., 3.};
  const auto at               = [&](const double t) {
    gap.edges = {{0, 1, .2, t, t}};
    BOOST_REQUIRE(gap.evaluate());
    return gap.new_gap;
  };
  BOOST_CHECK_CLOSE(at(0.), 2., 1e-12);
  BOOST_CHECK_CLOSE(at(.2), 3., 1e-12);
  BOOST_CHECK_CLOSE(at(-.3), 1., 1e-12);
  BOOST_CHECK_CLOSE(at(.1), 1. + 2. * 27. / 32., 1e-12);
}



// By hand: the coverage is 1 at an open edge, 27/32 at a quarter of the largest overhang,
// 1/2 at half of it and 0 at all of it; at a corner it is the product of both.
BOOST_AUTO_TEST_CASE(coverage_by_hand)
{
  RoundedGap<double> gap;
  gap.counts   = {true};
  gap.old_gaps = gap.new_gaps = {1.};
  constexpr double largest    = .4;
  const auto       at         = [&](const double first, const double second) {
    gap.open_edges.clear();
    for (const double overhang : {first, second})
      gap.open_edges.push_back(
        {0, .5 * largest, overhang - .5 * largest, overhang - .5 * largest});
    BOOST_REQUIRE(gap.evaluate());
    return gap.new_coverage;
  };
  BOOST_CHECK_CLOSE(at(0., -1.), 1., 1e-12);
  BOOST_CHECK_CLOSE(at(.1, -1.), 27. / 32., 1e-12);
  BOOST_CHECK_CLOSE(at(-1., .2), .5, 1e-12);
  BOOST_CHECK_CLOSE(at(.1, .2), 27. / 64., 1e-12);
  BOOST_CHECK_SMALL(at(.4, -1.), 1e-15);
}



namespace
{
  /// Two bodies: points of the second one, whose boundary id is 1, in front of the first one,
  /// with 0.
  struct TwoBodies
  {
    explicit TwoBodies(const Triangulation<3> (&parts)[2])
      : triangulation(MPI_COMM_WORLD)
    {
      join_parts<3>({&parts[0], &parts[1]}, triangulation);
      body = std::make_unique<Body<3>>(triangulation,
                                       1,
                                       Body<3>::BoundaryIds{},
                                       Body<3>::BoundaryIds{0, 1},
                                       MultiplierSpace::none,
                                       MPI_COMM_WORLD);
      pair = std::make_unique<PointsBeforeTriangles>(
        *body,
        ContactPair{"pair", {1}, {0}},
        PointsBeforeTriangles::PointsIn::nodes,
        /* has_coverage */ true);
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

    Vector
    displacements(const double noise, const Tensor<1, 3> &of_second)
    {
      const auto parts  = body->parts_of_unknowns(2);
      Vector     result = body->make_vector();
      for (const auto &[i, x] : reference)
        result(i) = random_number(noise) +
          (parts[i] == 1 ? of_second[component.at(i)] : 0.);
      result.compress(dealii::VectorOperation::insert);
      return result;
    }

    dealii::parallel::shared::Triangulation<3>              triangulation;
    std::unique_ptr<Body<3>>                                body;
    std::unique_ptr<PointsBeforeTriangles>                  pair;
    std::map<dealii::types::global_dof_index, Point<3>>     reference;
    std::map<dealii::types::global_dof_index, unsigned int> component;
  };

  /// A block on a block; nodes meet nodes, or not.
  TwoBodies
  make_blocks(const bool matching)
  {
    Triangulation<3> parts[2];
    for (unsigned int p = 0; p < 2; ++p)
      {
        const double shift = matching || p == 0 ? 0. : .07;
        dealii::GridGenerator::subdivided_hyper_rectangle(
          parts[p],
          {4, 4, 1},
          p == 0 ? Point<3>(0., 0., -.3) : Point<3>(shift, shift, .0),
          p == 0 ? Point<3>(1., 1., 0.) : Point<3>(1. - shift, 1. - shift, .3));
        for (const auto &cell : parts[p].active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              face->set_boundary_id(std::abs(face->center()[2]) < 1e-10 ? p
                                                                        : 2);
      }
    return TwoBodies(parts);
  }
} // namespace



// The product of rows and displacements is the change of the gap, sums and moments of rows are
// zero, the gap at the end is that of a search there, and derivatives are quotients
// of differences; steps begin on nodes and diagonals exactly, and pass facets.
BOOST_AUTO_TEST_CASE(rows_on_surfaces)
{
  constexpr double       h = 1e-7, pressure = 2., energy = .4;
  const Tensor<1, 2>     traction({.7, -.4});
  constexpr unsigned int n_states = 12;
  unsigned int           n_points = 0, n_near_edges = 0, n_over_ends = 0;
  for (const bool matching : {true, false})
    for (unsigned int k = 0; k < n_states; ++k)
      {
        TwoBodies    blocks = make_blocks(matching);
        auto        &pair   = *blocks.pair;
        const Vector zero   = blocks.body->make_vector();
        // The first steps begin where the mesh was made.
        const double noise = k < 4 ? 0. : .02;
        const double slide = k % 2 == 0 ? .01 : .2;
        const Vector begin =
          blocks.displacements(noise, Tensor<1, 3>({0., 0., -.001}));
        const Vector end = blocks.displacements(
          .02,
          Tensor<1, 3>({random_number(slide), random_number(slide), -.01}));
        const Vector direction = blocks.displacements(1., Tensor<1, 3>());
        pair.begin_step({begin, zero, zero, 1., 1.});
        pair.evaluate(end);
        std::map<unsigned int, std::pair<double, double>> ends;
        for (unsigned int p = 0; p < pair.points().size(); ++p)
          {
            if (!pair.is_before_facet(p))
              continue;
            ++n_points;
            ends[p]         = {pair.new_gap(p), pair.new_coverage(p)};
            const auto rows = pair.rows(p);
            n_near_edges += rows.unknowns.size() > 3 * 5;
            const bool is_over_end = !rows.coverage.empty();
            n_over_ends +=
              pair.new_coverage(p) > 0. && pair.new_coverage(p) < 1.;
            double       change = 0., of_coverage = 0.;
            Tensor<1, 3> sum, moment, sum_of_coverage, moment_of_coverage;
            for (unsigned int i = 0; i < rows.unknowns.size(); i += 3)
              {
                Tensor<1, 3> x, force, along_surface;
                for (unsigned int c = 0; c < 3; ++c)
                  {
                    const auto unknown = rows.unknowns[i + c];
                    x[c]               = blocks.reference.at(unknown)[c] +
                      .5 * (begin(unknown) + end(unknown));
                    force[c] = rows.normal[i + c];
                    change += force[c] * (end(unknown) - begin(unknown));
                    if (is_over_end)
                      along_surface[c] = rows.coverage[i + c];
                    of_coverage +=
                      along_surface[c] * (end(unknown) - begin(unknown));
                  }
                sum += force;
                moment += dealii::cross_product_3d(x, force);
                sum_of_coverage += along_surface;
                moment_of_coverage +=
                  dealii::cross_product_3d(x, along_surface);
              }
            BOOST_CHECK_SMALL(of_coverage -
                                (pair.new_coverage(p) - pair.old_coverage(p)),
                              1e-13);
            BOOST_CHECK_SMALL(sum_of_coverage.norm(), 1e-11);
            BOOST_CHECK_SMALL(moment_of_coverage.norm(), 1e-11);
            BOOST_CHECK_SMALL(change - (pair.new_gap(p) - pair.old_gap(p)),
                              1e-13);
            BOOST_CHECK_SMALL(sum.norm(), 1e-12);
            BOOST_CHECK_SMALL(moment.norm(), 1e-12);
          }

        for (const auto &[p, at_end] : ends)
          {
            const auto derivatives =
              pair.derivatives(p, {pressure, traction, energy}, Caution::none);
            const auto unknowns  = pair.rows(p).unknowns;
            const auto forces_at = [&](const double length) {
              Vector point(end);
              point.add(length, direction);
              pair.evaluate(point);
              std::map<dealii::types::global_dof_index, double> forces;
              const auto &rows = pair.rows(p);
              for (unsigned int i = 0; i < rows.unknowns.size(); ++i)
                forces[rows.unknowns[i]] = -pressure * rows.normal[i] +
                  traction[0] * rows.tangential[0][i] +
                  traction[1] * rows.tangential[1][i] +
                  (rows.coverage.empty() ? 0. : energy * rows.coverage[i]);
              return std::tuple(pair.new_gap(p) + pair.new_coverage(p),
                                rows.slip,
                                forces);
            };
            auto [up_gap, up_slip, up]       = forces_at(h);
            auto [down_gap, down_slip, down] = forces_at(-h);
            pair.evaluate(end);
            const unsigned int m         = unknowns.size();
            double             along_gap = 0., error = 0., size = 1.;
            Tensor<1, 2>       along_slip;
            for (unsigned int a = 0; a < m; ++a)
              {
                along_gap += derivatives.gap[a] * direction(unknowns[a]);
                if (!derivatives.coverage.empty())
                  along_gap += derivatives.coverage[a] * direction(unknowns[a]);
                for (unsigned int d = 0; d < 2; ++d)
                  along_slip[d] +=
                    derivatives.slip[d][a] * direction(unknowns[a]);
                double along = 0.;
                for (unsigned int b = 0; b < m; ++b)
                  along +=
                    derivatives.forces[a * m + b] * direction(unknowns[b]);
                const double quotient =
                  .5 * (up[unknowns[a]] - down[unknowns[a]]) / h;
                error = std::max(error, std::abs(along - quotient));
                size  = std::max(size, std::abs(quotient));
              }
            BOOST_CHECK_SMALL(along_gap - .5 * (up_gap - down_gap) / h, 1e-6);
            for (unsigned int d = 0; d < 2; ++d)
              BOOST_CHECK_SMALL(along_slip[d] -
                                  .5 * (up_slip[d] - down_slip[d]) / h,
                                1e-6);
            BOOST_CHECK_SMALL(error / size, 1e-5);
          }

        pair.begin_step({end, zero, zero, 1., 1.});
        for (const auto &[p, at] : ends)
          if (pair.is_before_facet(p))
            {
              // A gap without coverage is of no use.
              BOOST_CHECK_SMALL(pair.old_coverage(p) - at.second, 1e-12);
              BOOST_CHECK_SMALL(at.second * (pair.old_gap(p) - at.first),
                                1e-13);
            }
          else
            BOOST_CHECK_SMALL(at.second, 1e-13);
      }
  BOOST_CHECK_GT(n_points, 200);
  BOOST_CHECK_GT(n_near_edges, 100);
  BOOST_CHECK_GT(n_over_ends, 20);
}



// Deep behind a fold of 72 degrees facets that are no neighbours may both be in front of a
// point: the gap at the beginning of the step stays that of the facets there, wherever
// the iterate at the end is, and the increment stays exact.
BOOST_AUTO_TEST_CASE(gap_of_the_beginning_behind_sharp_folds)
{
  Triangulation<3> parts[2];
  dealii::GridGenerator::torus(parts[0], 1., .25, 12);
  dealii::GridGenerator::hyper_cube(parts[1], -.02, .02);
  for (unsigned int p = 0; p < 2; ++p)
    for (const auto &cell : parts[p].active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(p);
  TwoBodies    bodies(parts);
  auto        &pair     = *bodies.pair;
  const Vector zero     = bodies.body->make_vector();
  unsigned int n_points = 0;
  for (unsigned int k = 0; k < 300; ++k)
    {
      // The cube near the surface of the torus at the beginning and the end.
      const double phi = random_number(dealii::numbers::PI),
                   psi = random_number(dealii::numbers::PI),
                   r   = .2 + random_number(.06);
      const Tensor<1, 3> place({(1. + r * std::cos(psi)) * std::cos(phi),
                                r * std::sin(psi),
                                (1. + r * std::cos(psi)) * std::sin(phi)});
      const Tensor<1, 3> change(
        {random_number(.06), random_number(.06), random_number(.06)});
      const Vector begin = bodies.displacements(0., place);
      const Vector end   = bodies.displacements(.01, place + change);
      pair.begin_step({begin, zero, zero, 1., 1.});
      std::map<unsigned int, double> known;
      for (unsigned int p = 0; p < pair.points().size(); ++p)
        if (pair.is_before_facet(p))
          known[p] = pair.old_gap(p);
      pair.evaluate(end);
      for (const auto &[p, old_gap] : known)
        {
          ++n_points;
          BOOST_CHECK_SMALL(pair.old_gap(p) - old_gap, 1e-9);
          double      change_of_gap = 0.;
          const auto &rows          = pair.rows(p);
          for (unsigned int i = 0; i < rows.unknowns.size(); ++i)
            change_of_gap += rows.normal[i] *
              (end(rows.unknowns[i]) - begin(rows.unknowns[i]));
          BOOST_CHECK_SMALL(change_of_gap - (pair.new_gap(p) - old_gap), 1e-9);
        }
    }
  BOOST_CHECK_GT(n_points, 500);
}

BOOST_AUTO_TEST_SUITE_END()
