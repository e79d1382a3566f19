// SPDX-License-Identifier: LGPL-2.1-or-later

// Rows of contact between two wavy surfaces over random steps, in which they slide past
// each other's nodes: D . change is the change of the gap and T . change the slip, forces
// and moments add up to zero, and derivatives are quotients of differences.
// Gaps depend on the positions of the surfaces only.

#include "meshes.h"

#include <contact/kinematics/mortar_pair.h>
#include <contact/kinematics/points_before_facets.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <deal.II/dofs/dof_tools.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Ricochet;
using dealii::Point;

BOOST_AUTO_TEST_SUITE(surface_pair)

namespace
{
  using Pair = SurfacePair<2>;

  const std::vector<std::string> couplings = {"nodes",
                                              "nodes, rounded",
                                              "quadrature points",
                                              "mortar",
                                              "dual mortar"};

  /// Two strips of which the lower one is wavy above, the upper one below.
  struct Strips
  {
    /// @param right end of the lower strip; the upper one ends at 1.
    explicit Strips(const unsigned int seed,
                    const double       gap   = .02,
                    const double       right = 1.4)
      : triangulation(MPI_COMM_WORLD)
      , random(seed)
    {
      make_rectangles(
        {{Point<2>(-.4, -1.), Point<2>(right, 0.), {{9, 2}}, 0., {}},
         {Point<2>(0., gap), Point<2>(1., 1.), {{7, 2}}, 0., {}}},
        CellShape::triangles,
        triangulation);
      body = std::make_unique<Body<2>>(triangulation,
                                       1,
                                       Body<2>::BoundaryIds{},
                                       Body<2>::BoundaryIds{},
                                       MultiplierSpace::none,
                                       MPI_COMM_WORLD);
      std::map<dealii::types::global_dof_index, Point<2>> positions;
      dealii::DoFTools::map_dofs_to_support_points(body->mapping(),
                                                   body->dof_handler(),
                                                   positions);
      for (const auto &[i, x] : positions)
        reference[body->system_index(i)] = x;
    }

    std::unique_ptr<Pair>
    pair(const std::string &coupling) const
    {
      const ContactPair surfaces = {"strips",
                                    {rectangle_side(1, Rectangle::lower)},
                                    {rectangle_side(0, Rectangle::upper)}};
      using Points               = PointsBeforeFacets<2>;
      if (coupling == "nodes" || coupling == "nodes, rounded")
        return std::make_unique<Points>(*body,
                                        surfaces,
                                        Points::PointsIn::nodes,
                                        coupling == "nodes, rounded");
      if (coupling == "quadrature points")
        return std::make_unique<Points>(*body,
                                        surfaces,
                                        Points::PointsIn::quadrature_points,
                                        /* is_smooth */ true);
      return std::make_unique<MortarPair>(*body,
                                          surfaces,
                                          coupling == "mortar"
                                            ? MortarShape::standard
                                            : MortarShape::dual);
    }

    /// Displacements that make waves of @p amplitude, and move the upper strip
    /// along by @p slide and down by @p press.
    Vector
    displacements(const double amplitude,
                  const double slide,
                  const double press)
    {
      std::uniform_real_distribution<double> noise(-amplitude, amplitude);
      Vector                                 vector = body->make_vector();
      // One number for each unknown, on whichever rank.
      for (dealii::types::global_dof_index i = 0; i < vector.size(); ++i)
        {
          const double value = noise(random);
          if (!vector.in_local_range(i))
            continue;
          const bool   upper = reference.at(i)[1] > .5 * .02;
          const double moved =
            !upper ? 0. : (component_of(i) == 0 ? slide : -press);
          vector(i) = value + moved;
        }
      vector.compress(dealii::VectorOperation::insert);
      return vector;
    }

    unsigned int
    component_of(const dealii::types::global_dof_index i) const
    {
      if (components.empty())
        for (unsigned int c = 0; c < 2; ++c)
          {
            std::vector<bool>      mask = {c == 0, c == 1};
            const dealii::IndexSet dofs =
              dealii::DoFTools::extract_dofs(body->dof_handler(),
                                             dealii::ComponentMask(mask));
            for (const auto k : dofs)
              components[body->system_index(k)] = c;
          }
      return components.at(i);
    }

    dealii::parallel::shared::Triangulation<2>          triangulation;
    std::mt19937                                        random;
    std::unique_ptr<Body<2>>                            body;
    std::map<dealii::types::global_dof_index, Point<2>> reference;
    mutable std::map<dealii::types::global_dof_index, unsigned int> components;
  };

  /// Some lower strips end under the upper one, which overhangs.
  double
  end_of_lower(const unsigned int seed)
  {
    return seed % 2 == 0 ? 1.4 : .94;
  }

  ContactStart
  start_at(const Vector &solution, const Vector &zero)
  {
    return {solution, zero, zero, 1., 1.};
  }
} // namespace


BOOST_AUTO_TEST_CASE(rows_are_exact)
{
  for (const std::string &coupling : couplings)
    {
      unsigned int n_points = 0, n_at_ends = 0;
      double       of_gap = 0., of_slip = 0., of_coverage = 0., of_sums = 0.,
             of_moments = 0.;
      for (unsigned int seed = 0; seed < 40; ++seed)
        {
          Strips       strips(seed, .02, end_of_lower(seed));
          const auto   pair   = strips.pair(coupling);
          const Vector zero   = strips.body->make_vector();
          const double slide  = .02 * (seed % 7) * (seed % 2 == 0 ? 1. : -1.);
          const Vector before = strips.displacements(.02, .1 * slide, .01);
          const Vector after  = strips.displacements(.02, slide, .03);
          pair->begin_step(start_at(before, zero));
          pair->evaluate(after);
          for (unsigned int p = 0; p < pair->points().size(); ++p)
            {
              if (!pair->is_before_facet(p))
                continue;
              ++n_points;
              const auto &rows      = pair->rows(p);
              const bool  is_at_end = !rows.coverage.empty();
              double      gap = 0., slip = 0., coverage = 0.;
              double      sum[3][2] = {{0., 0.}, {0., 0.}, {0., 0.}},
                     moment[3]      = {0., 0., 0.};
              n_at_ends += pair->new_coverage(p) < 1.;
              for (unsigned int k = 0; k < rows.unknowns.size(); ++k)
                {
                  const auto   i      = rows.unknowns[k];
                  const double change = after(i) - before(i);
                  gap += rows.normal[k] * change;
                  slip += rows.tangential[0][k] * change;
                  const unsigned int c = strips.component_of(i);
                  if (is_at_end)
                    {
                      coverage += rows.coverage[k] * change;
                      sum[2][c] += rows.coverage[k];
                    }
                  sum[0][c] += rows.normal[k];
                  sum[1][c] += rows.tangential[0][k];
                }
              // The other component of a node is its neighbour.
              for (unsigned int k = 0; k < rows.unknowns.size(); k += 2)
                {
                  const auto   i = rows.unknowns[k], j = rows.unknowns[k + 1];
                  const double x =
                    strips.reference.at(i)[0] + .5 * (before(i) + after(i));
                  const double y =
                    strips.reference.at(j)[1] + .5 * (before(j) + after(j));
                  moment[0] += x * rows.normal[k + 1] - y * rows.normal[k];
                  moment[1] +=
                    x * rows.tangential[0][k + 1] - y * rows.tangential[0][k];
                  if (is_at_end)
                    moment[2] +=
                      x * rows.coverage[k + 1] - y * rows.coverage[k];
                }
              of_gap =
                std::max({of_gap,
                          std::abs(gap - rows.gap_increment),
                          std::abs(gap - pair->new_gap(p) + pair->old_gap(p))});
              of_slip     = std::max(of_slip, std::abs(slip - rows.slip[0]));
              of_coverage = std::max(of_coverage,
                                     std::abs(coverage - pair->new_coverage(p) +
                                              pair->old_coverage(p)));
              for (const unsigned int r : {0U, 1U, 2U})
                {
                  of_moments = std::max(of_moments, std::abs(moment[r]));
                  for (const unsigned int c : {0U, 1U})
                    of_sums = std::max(of_sums, std::abs(sum[r][c]));
                }
            }
        }
      BOOST_TEST_MESSAGE(coupling << ": " << n_points << " points; gap "
                                  << of_gap << ", slip " << of_slip
                                  << ", coverage " << of_coverage << ", sums "
                                  << of_sums << ", moments " << of_moments);
      BOOST_CHECK_GT(n_points, 200);
      const bool has_coverage =
        coupling == "nodes, rounded" || coupling == "quadrature points";
      BOOST_CHECK_EQUAL(n_at_ends > 5, has_coverage);
      for (const double error :
           {of_gap, of_slip, of_coverage, of_sums, of_moments})
        BOOST_CHECK_LT(error, 1e-13);
    }
}

// At the beginning of the next step gaps and coverages are those at the end of the last
// one, where no point leaves the end of the other surface.
BOOST_AUTO_TEST_CASE(no_history_enters)
{
  for (const std::string &coupling : couplings)
    {
      double       worst    = 0.;
      unsigned int n_points = 0;
      for (unsigned int seed = 0; seed < 40; ++seed)
        {
          Strips       strips(seed, .02, end_of_lower(seed));
          const auto   pair   = strips.pair(coupling);
          const Vector zero   = strips.body->make_vector();
          const double slide  = .02 * (seed % 7) * (seed % 2 == 0 ? 1. : -1.);
          const Vector before = strips.displacements(.01, 0., .01);
          const Vector after  = strips.displacements(.01, slide, .02);
          pair->begin_step(start_at(before, zero));
          pair->evaluate(after);
          std::map<unsigned int, std::pair<double, double>> ends;
          for (unsigned int p = 0; p < pair->points().size(); ++p)
            if (pair->is_before_facet(p))
              ends[p] = {pair->new_gap(p), pair->new_coverage(p)};
          pair->begin_step(start_at(after, zero));
          for (const auto &[p, at] : ends)
            if (pair->is_before_facet(p))
              {
                ++n_points;
                worst = std::max({worst,
                                  std::abs(pair->old_gap(p) - at.first),
                                  std::abs(pair->old_coverage(p) - at.second)});
              }
        }
      BOOST_TEST_MESSAGE(coupling << ": " << n_points
                                  << " points, gaps differ by " << worst);
      BOOST_CHECK_GT(n_points, 200);
      BOOST_CHECK_LT(worst, 1e-13);
    }
}

BOOST_AUTO_TEST_CASE(derivatives_are_quotients_of_differences)
{
  constexpr double pressure = 2., traction = -.7, energy = .4, h = 1e-7;
  for (const std::string &coupling : couplings)
    {
      double of_gap = 0., of_slip = 0., of_forces = 0.;
      for (unsigned int seed = 0; seed < 6; ++seed)
        {
          Strips       strips(seed, .02, end_of_lower(seed));
          const auto   pair      = strips.pair(coupling);
          const Vector zero      = strips.body->make_vector();
          const Vector before    = strips.displacements(.02, 0., .01);
          const Vector after     = strips.displacements(.02, .01 * seed, .03);
          const Vector direction = strips.displacements(1., 0., 0.);
          const auto   force_at  = [&](const double       length,
                                    const unsigned int p,
                                    double            &gap,
                                    double            &slip) {
            Vector point(after);
            point.add(length, direction);
            pair->evaluate(point);
            const auto &rows = pair->rows(p);
            std::map<dealii::types::global_dof_index, double> force;
            for (unsigned int k = 0; k < rows.unknowns.size(); ++k)
              force[rows.unknowns[k]] += traction * rows.tangential[0][k] -
                pressure * rows.normal[k] +
                (rows.coverage.empty() ? 0. : energy * rows.coverage[k]);
            gap  = pair->new_gap(p) + pair->new_coverage(p);
            slip = rows.slip[0];
            return force;
          };
          pair->begin_step(start_at(before, zero));
          for (unsigned int p = 0; p < pair->points().size(); ++p)
            {
              if (!pair->is_before_facet(p))
                continue;
              double     gap[2], slip[2];
              const auto up   = force_at(h, p, gap[1], slip[1]);
              auto       down = force_at(-h, p, gap[0], slip[0]);
              pair->evaluate(after);
              const auto &rows        = pair->rows(p);
              const auto &derivatives = pair->derivatives(
                p,
                {pressure, dealii::Tensor<1, 1>({traction}), energy},
                Caution::none);
              const unsigned int m         = rows.unknowns.size();
              double             along_gap = 0., along_slip = 0.;
              for (unsigned int b = 0; b < m; ++b)
                {
                  along_gap += derivatives.gap[b] * direction(rows.unknowns[b]);
                  if (!derivatives.coverage.empty())
                    along_gap +=
                      derivatives.coverage[b] * direction(rows.unknowns[b]);
                  along_slip +=
                    derivatives.slip[0][b] * direction(rows.unknowns[b]);
                }
              of_gap =
                std::max(of_gap,
                         std::abs(along_gap - .5 * (gap[1] - gap[0]) / h));
              of_slip =
                std::max(of_slip,
                         std::abs(along_slip - .5 * (slip[1] - slip[0]) / h));
              double error = 0., size = 0.;
              for (unsigned int a = 0; a < m; ++a)
                {
                  double along = 0.;
                  for (unsigned int b = 0; b < m; ++b)
                    along += derivatives.forces[a * m + b] *
                      direction(rows.unknowns[b]);
                  const auto   i = rows.unknowns[a];
                  const double quotient =
                    .5 * ((up.count(i) ? up.at(i) : 0.) - down[i]) / h;
                  error = std::max(error, std::abs(along - quotient));
                  size  = std::max(size, std::abs(quotient));
                }
              of_forces = std::max(of_forces, error / size);
            }
        }
      BOOST_TEST_MESSAGE(coupling << ": gap " << of_gap << ", slip " << of_slip
                                  << ", forces " << of_forces);
      BOOST_CHECK_LT(of_gap, 1e-6);
      // The gap with the coverage. Mortar leaves out where the facets are cut, which matters where a point
      // passes a vertex in between.
      const bool is_cut = coupling.find("mortar") != std::string::npos;
      BOOST_CHECK_LT(of_slip, is_cut ? .01 : 1e-6);
      BOOST_CHECK_LT(of_forces, is_cut ? .01 : 1e-5);
    }
}

// Points that move along the other surface over several of its nodes, or face
// it only in this step, are assigned to the facets that they reach: their gaps
// are those of a search at the end of the step.
BOOST_AUTO_TEST_CASE(fast_points_are_before_the_facets_they_come_to)
{
  for (const bool comes_in : {false, true})
    {
      // The lower strip ends at 1.4, with nine facets of .2.
      const double first = comes_in ? .9 : -.3, last = comes_in ? .3 : .35;
      Strips       strips(11, .04);
      const Vector begin = strips.displacements(1e-3, first, 0.),
                   way   = strips.displacements(0., last - first, .02),
                   zero  = strips.body->make_vector();
      Vector end(begin);
      end += way;
      const auto pair = strips.pair("nodes"), later = strips.pair("nodes");
      pair->begin_step({begin, zero, way, 1., 1.});
      pair->evaluate(end);
      later->begin_step({end, zero, zero, 0., 1.});
      unsigned int n_seen = 0, n_before = 0;
      for (unsigned int p = 0; p < pair->points().size(); ++p)
        {
          const bool is_inside = later->is_before_facet(p);
          n_before += is_inside ? 1 : 0;
          if (!is_inside || !pair->is_before_facet(p))
            continue;
          ++n_seen;
          BOOST_CHECK_SMALL(pair->new_gap(p) - later->old_gap(p), 1e-12);
        }
      n_seen = dealii::Utilities::MPI::sum(n_seen, MPI_COMM_WORLD);
      BOOST_TEST(n_seen ==
                 dealii::Utilities::MPI::sum(n_before, MPI_COMM_WORLD));
      BOOST_TEST(n_seen == 8u);
    }
}

// The unknowns that a pair announces for the pattern of the tangent include all
// unknowns of its rows, also in a step over several facets.
BOOST_AUTO_TEST_CASE(patterns_have_the_unknowns_of_fast_points)
{
  for (const std::string &coupling : couplings)
    {
      Strips       strips(11, .04);
      const auto   pair = strips.pair(coupling);
      const Vector zero = strips.body->make_vector();
      pair->begin_step(start_at(strips.displacements(1e-3, .35, 0.), zero));
      pair->evaluate(strips.displacements(1e-3, -.3, .02));
      unsigned int n_points = 0, n_missing = 0;
      for (unsigned int p = 0; p < pair->points().size(); ++p)
        {
          if (!pair->is_before_facet(p))
            continue;
          ++n_points;
          const auto nearby = pair->unknowns_nearby(p);
          for (const auto index : pair->rows(p).unknowns)
            n_missing +=
              !std::binary_search(nearby.begin(), nearby.end(), index);
        }
      BOOST_TEST(dealii::Utilities::MPI::sum(n_points, MPI_COMM_WORLD) > 5u);
      BOOST_TEST(n_missing == 0u);
    }
}

BOOST_AUTO_TEST_SUITE_END()
