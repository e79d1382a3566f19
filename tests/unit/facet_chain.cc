// SPDX-License-Identifier: LGPL-2.1-or-later
//
// The rows of contact between a point and facets that move, at random states: their
// product with the change of the positions is the change of the gap (and of the
// coordinate along the facet), their sums and moments are zero, their derivatives
// are quotients of differences. Points that pass vertices, back and forth and
// several at a time, convex and concave ones and nearly flat ones; mirror
// images.

#include <boost/test/unit_test.hpp>
#include <contact/surfaces/facet_chain.h>

#include <Sacado_Fad_SLFad.hpp>

#include <random>

using namespace Ricochet;

BOOST_AUTO_TEST_SUITE(facet_chain)

namespace
{
  using Position  = std::array<double, 2>;
  using Positions = std::vector<Position>;
  using Rows      = FacetChain<double>::Rows;
  using Roundings = std::vector<double>;
  using AD        = Sacado::Fad::SLFad<double, 14>;

  std::mt19937 generator(42);

  double
  random_number(const double size)
  {
    return std::uniform_real_distribution<double>(-size, size)(generator);
  }

  /// A point and a chain of five facets of unit length, roughly, in any direction;
  /// @p bend is the largest angle between two of them.
  Positions
  random_chain(const double bend)
  {
    Positions x(7);
    double    angle = random_number(3.);
    x[1]            = {{random_number(1.), random_number(1.)}};
    for (unsigned int i = 2; i < 7; ++i)
      {
        const double length = 1. + random_number(.2);
        x[i]                = {{x[i - 1][0] + length * std::cos(angle),
                                x[i - 1][1] + length * std::sin(angle)}};
        angle += random_number(bend);
      }
    return x;
  }

  /// Put the point at a distance in front of the facet.
  void
  put_point(Positions         &x,
            const unsigned int facet,
            const double       along,
            const double       gap)
  {
    const Position &a = x[facet + 1], &b = x[facet + 2];
    const double    l = std::hypot(b[0] - a[0], b[1] - a[1]);
    for (unsigned int c = 0; c < 2; ++c)
      x[0][c] = a[c] + along * (b[c] - a[c]) +
        gap / l * (c == 0 ? a[1] - b[1] : b[0] - a[0]);
  }

  Positions
  moved(const Positions &x, const double size)
  {
    Positions y = x;
    for (Position &position : y)
      for (double &coordinate : position)
        coordinate += random_number(size);
    return y;
  }

  struct Errors
  {
    double increment = 0., slip = 0., sum = 0., moment = 0., size = 0.;
  };

  Errors
  errors_of(const Positions   &old_x,
            const Positions   &new_x,
            const unsigned int old_facet,
            const unsigned int new_facet,
            const Roundings   *roundings = nullptr)
  {
    Rows rows;
    FacetChain<double>(old_x, new_x, Caution::none, roundings)
      .evaluate(old_facet, new_facet, rows);
    Errors       errors;
    const double old_gap = roundings
      ? FacetChain<double>::gap(old_x, old_facet, *roundings)
      : FacetChain<double>::gap(old_x, old_facet);
    errors.increment = std::abs(rows.gap_increment - (rows.new_gap - old_gap));

    // The coordinate along the facet where the point began, in both positions.
    const auto along = [&](const Positions &x) {
      const Position &a = x[old_facet + 1], &b = x[old_facet + 2];
      const double    ex = b[0] - a[0], ey = b[1] - a[1];
      return (ex * (x[0][0] - a[0]) + ey * (x[0][1] - a[1])) /
        (ex * ex + ey * ey);
    };
    Position middle_edge;
    for (unsigned int c = 0; c < 2; ++c)
      middle_edge[c] = .5 *
        (old_x[old_facet + 2][c] - old_x[old_facet + 1][c] +
         new_x[old_facet + 2][c] - new_x[old_facet + 1][c]);
    const double length = std::hypot(middle_edge[0], middle_edge[1]);
    errors.slip = std::abs(rows.slip - length * (along(new_x) - along(old_x)));

    for (const auto *row : {&rows.normal, &rows.tangential})
      {
        Position sum{};
        double   moment = 0.;
        for (unsigned int i = 0; i < old_x.size(); ++i)
          {
            const double fx = (*row)[2 * i], fy = (*row)[2 * i + 1];
            sum[0] += fx;
            sum[1] += fy;
            moment += .5 * (old_x[i][0] + new_x[i][0]) * fy -
              .5 * (old_x[i][1] + new_x[i][1]) * fx;
            errors.size = std::max({errors.size, std::abs(fx), std::abs(fy)});
          }
        errors.sum = std::max({errors.sum, std::abs(sum[0]), std::abs(sum[1])});
        errors.moment = std::max(errors.moment, std::abs(moment));
      }
    return errors;
  }

  void
  check(const Errors &errors)
  {
    BOOST_TEST(errors.increment < 2e-14);
    BOOST_TEST(errors.slip < 2e-14);
    BOOST_TEST(errors.sum < 2e-14);
    BOOST_TEST(errors.moment < 4e-14);
    // Not a balance of large numbers.
    BOOST_TEST(errors.size < 40.);
  }
} // namespace


BOOST_AUTO_TEST_CASE(rows_are_exact_before_one_facet)
{
  for (const double size : {1e-6, 1e-3, .1, .4})
    for (unsigned int n = 0; n < 200; ++n)
      {
        Positions x = random_chain(.8);
        put_point(x, 2, .5 + random_number(.7), random_number(.3));
        check(errors_of(x, moved(x, size), 2, 2));
      }
}



BOOST_AUTO_TEST_CASE(rows_are_exact_past_vertices)
{
  unsigned int n_passed = 0, n_passed_two = 0, n_back = 0;
  for (const double bend : {0., 1e-9, .1, .6})
    for (const double size : {1e-3, .05})
      for (unsigned int n = 0; n < 200; ++n)
        {
          Positions          x     = random_chain(bend);
          const unsigned int begin = n % 3;
          const unsigned int end   = (n / 3) % 5;
          put_point(x, begin, .5 + random_number(.5), random_number(.1));
          Positions later = moved(x, size);
          put_point(later, end, .5 + random_number(.5), random_number(.1));
          const unsigned int old_facet =
            FacetChain<double>::facet_before(x, begin);
          const unsigned int new_facet =
            FacetChain<double>::facet_before(later, old_facet);
          n_passed += new_facet != old_facet;
          n_back += new_facet < old_facet;
          n_passed_two += new_facet > old_facet + 1;
          check(errors_of(x, later, old_facet, new_facet));
        }
  BOOST_TEST(n_passed > 1000);
  BOOST_TEST(n_back > 200);
  BOOST_TEST(n_passed_two > 300);
}



// With rounded vertices, from which points start, at which they end, and which they pass.
BOOST_AUTO_TEST_CASE(rows_are_exact_at_rounded_vertices)
{
  unsigned int n_passed = 0, n_near = 0;
  for (const double bend : {0., 1e-9, .1, .6})
    for (const double size : {1e-12, 1e-6, 1e-3, .05})
      for (unsigned int n = 0; n < 200; ++n)
        {
          const Roundings roundings = {.1, .08, .12, .1};
          Positions       x         = random_chain(bend);
          // Every other point is at a vertex, exactly or nearly so.
          const double along = n % 2 == 0 ? .5 + random_number(.5)
            : n % 4 == 1                  ? 0.
                                          : random_number(.15);
          put_point(x, 1 + n % 3, along, random_number(.1));
          Positions later = moved(x, size);
          if (n % 3 == 0)
            put_point(later, n % 5, .5 + random_number(.5), random_number(.1));
          const unsigned int old_facet =
            FacetChain<double>::facet_before(x, 1 + n % 3);
          const unsigned int new_facet =
            FacetChain<double>::facet_before(later, old_facet);
          n_passed += new_facet != old_facet;
          if (old_facet < 4)
            n_near += std::abs(FacetChain<double>::past_vertex(x, old_facet)) <
              roundings[old_facet];
          check(errors_of(x, later, old_facet, new_facet, &roundings));
        }
  BOOST_TEST(n_passed > 500);
  BOOST_TEST(n_near > 200);
}



// The gap and the rows are the same whichever of the two facets at a rounded vertex is taken
// for the one that the point faces, however it got there; and by hand, at a right angle
// that is convex: at the vertex the gap is zero, and where the coordinate from the
// bisector is half of the width, the weight of the second facet is 27/32.
BOOST_AUTO_TEST_CASE(rounded_vertices_have_one_gap)
{
  const Roundings roundings = {.1, .1, .1, .1};
  for (unsigned int n = 0; n < 200; ++n)
    {
      Positions x = random_chain(.6);
      put_point(x, 2, random_number(.09), random_number(.05));
      Positions later = moved(x, .01);
      put_point(later, 2, random_number(.09), random_number(.05));
      BOOST_TEST(std::abs(FacetChain<double>::gap(x, 1, roundings) -
                          FacetChain<double>::gap(x, 2, roundings)) < 1e-14);
      Rows               first, second;
      FacetChain<double> chain(x, later, Caution::none, &roundings);
      chain.evaluate(1, 1, first);
      chain.evaluate(2, 2, second);
      BOOST_TEST(std::abs(first.gap_increment - second.gap_increment) < 1e-14);
      for (unsigned int i = 0; i < 14; ++i)
        BOOST_TEST(std::abs(first.normal[i] - second.normal[i]) < 1e-12);
    }

  const Positions corner = {{{0., 0.}}, {{0., 1.}}, {{1., 1.}}, {{1., 0.}}};
  Positions       x      = corner;
  x[0]                   = {{1., 1.}};
  for (const unsigned int facet : {0, 1})
    BOOST_CHECK_SMALL(FacetChain<double>::gap(x, facet, {.2}), 1e-15);
  // t is the distance from the bisector times the square root of 2, i.e. 0.1; the
  // distances from the facets are 0.1 and 0.2.
  x[0] = {{1.2, 1.1}};
  for (const unsigned int facet : {0, 1})
    BOOST_TEST(FacetChain<double>::gap(x, facet, {.2}) ==
                 .1 * 5. / 32. + .2 * 27. / 32.,
               boost::test_tools::tolerance(1e-13));
  // In front of one facet alone.
  x[0] = {{.7, 1.1}};
  BOOST_TEST(FacetChain<double>::gap(x, 0, {.2}) == .1,
             boost::test_tools::tolerance(1e-14));
}



// Where the gap from one facet is that from the next one, by hand: two facets at a
// right angle, whose bisector is the diagonal.
BOOST_AUTO_TEST_CASE(bisectors_tell_facets_apart)
{
  // Convex: the outside is above and to the right.
  const Positions corner = {{{0., 0.}}, {{0., 1.}}, {{1., 1.}}, {{1., 0.}}};
  const auto      facet  = [&](const double x, const double y) {
    Positions positions = corner;
    positions[0]        = {{x, y}};
    return FacetChain<double>::facet_before(positions, 0);
  };
  BOOST_TEST(facet(1.1, 1.2) == 0U);
  BOOST_TEST(facet(1.2, 1.1) == 1U);
  BOOST_TEST(facet(.8, .9) == 0U);
  BOOST_TEST(facet(.9, .8) == 1U);
  Positions positions = corner;
  positions[0]        = {{1.1, 1.1}};
  BOOST_TEST(std::abs(FacetChain<double>::past_vertex(positions, 0)) < 1e-15);
  BOOST_TEST(FacetChain<double>::gap(positions, 0) == .1,
             boost::test_tools::tolerance(1e-14));
  BOOST_TEST(FacetChain<double>::gap(positions, 1) == .1,
             boost::test_tools::tolerance(1e-14));
  // t is the distance from the bisector times the square root of 2.
  positions[0] = {{1.3, 1.1}};
  BOOST_TEST(FacetChain<double>::past_vertex(positions, 0) == .2,
             boost::test_tools::tolerance(1e-13));
}



// A state and its mirror image: gaps are the same, slips have the other sign.
BOOST_AUTO_TEST_CASE(mirror_images_have_mirrored_rows)
{
  for (unsigned int n = 0; n < 100; ++n)
    {
      Positions x = random_chain(.5);
      put_point(x, 1, .9, random_number(.1));
      Positions later = moved(x, .05);
      put_point(later, 3, .2, random_number(.1));
      const auto mirrored = [](const Positions &original) {
        Positions mirror = original;
        for (unsigned int i = 0; i < mirror.size(); ++i)
          {
            // The chain in reverse order.
            mirror[i] = original[i == 0 ? 0 : original.size() - i];
            mirror[i][0] *= -1.;
          }
        return mirror;
      };
      Rows rows, mirror_rows;
      FacetChain<double>(x, later).evaluate(1, 3, rows);
      const Positions mirror_x = mirrored(x), mirror_later = mirrored(later);
      FacetChain<double>(mirror_x, mirror_later).evaluate(3, 1, mirror_rows);
      BOOST_TEST(std::abs(rows.new_gap - mirror_rows.new_gap) < 1e-14);
      BOOST_TEST(std::abs(rows.slip + mirror_rows.slip) < 1e-14);
      for (unsigned int i = 0; i < x.size(); ++i)
        {
          const unsigned int j = i == 0 ? 0 : x.size() - i;
          BOOST_TEST(std::abs(rows.normal[2 * i] + mirror_rows.normal[2 * j]) <
                     1e-12);
          BOOST_TEST(std::abs(rows.normal[2 * i + 1] -
                              mirror_rows.normal[2 * j + 1]) < 1e-12);
        }
    }
}



// A block on a plane, moved along by hand: D is the normal and its reaction in the
// nodes of the facet, T the direction of the facet.
BOOST_AUTO_TEST_CASE(rows_by_hand)
{
  const Positions x     = {{{.25, .5}}, {{0., 0.}}, {{1., 0.}}};
  Positions       later = x;
  later[0]              = {{.75, .5}};
  Rows rows;
  FacetChain<double>(x, later).evaluate(0, 0, rows);
  const double normal[6] = {0., 1., 0., -.5, 0., -.5};
  for (unsigned int i = 0; i < 6; ++i)
    BOOST_TEST(rows.normal[i] == normal[i],
               boost::test_tools::tolerance(1e-14));
  BOOST_TEST(rows.slip == .5, boost::test_tools::tolerance(1e-14));
  BOOST_TEST(rows.tangential[0] == 1., boost::test_tools::tolerance(1e-14));
  // The couple of the tractions at both ends of the gap, by normal forces.
  BOOST_TEST(rows.tangential[3] - rows.tangential[5] == -1.,
             boost::test_tools::tolerance(1e-14));
}



BOOST_AUTO_TEST_CASE(derivatives_are_quotients_of_differences)
{
  const Roundings widths = {.1, .08, .12, .1};
  for (unsigned int n = 0; n < 120; ++n)
    {
      const Roundings *const roundings = n < 60 ? nullptr : &widths;
      Positions              x         = random_chain(.6);
      // Not right at a sharp vertex, where rows change fast.
      put_point(x,
                1 + n % 3,
                roundings ? 0. : .5 + random_number(.3),
                random_number(.1));
      Positions later = moved(x, .05);
      put_point(later,
                2,
                roundings && n % 2 == 0 ? random_number(.05)
                                        : .5 + random_number(.3),
                random_number(.1));
      const unsigned int old_facet =
        FacetChain<double>::facet_before(x, 1 + n % 3);
      const unsigned int new_facet =
        FacetChain<double>::facet_before(later, old_facet);
      std::vector<std::array<AD, 2>> variables(7);
      for (unsigned int i = 0; i < 14; ++i)
        variables[i / 2][i % 2] =
          AD(14, static_cast<int>(i), later[i / 2][i % 2]);
      FacetChain<AD>::Rows derivatives;
      FacetChain<AD>(x, variables, Caution::none, roundings)
        .evaluate(old_facet, new_facet, derivatives);

      for (unsigned int j = 0; j < 14; ++j)
        {
          constexpr double h = 1e-6;
          Rows             plus, minus;
          Positions        shifted = later;
          shifted[j / 2][j % 2] += h;
          FacetChain<double>(x, shifted, Caution::none, roundings)
            .evaluate(old_facet, new_facet, plus);
          shifted[j / 2][j % 2] -= 2. * h;
          FacetChain<double>(x, shifted, Caution::none, roundings)
            .evaluate(old_facet, new_facet, minus);
          const auto check_one =
            [&](const AD &derivative, const double a, const double b) {
              BOOST_TEST(std::abs(derivative.dx(j) - (a - b) / (2. * h)) <
                         (roundings ? 2e-7 : 2e-8) *
                           (1. + std::abs(derivative.dx(j))));
            };
          check_one(derivatives.new_gap, plus.new_gap, minus.new_gap);
          check_one(derivatives.slip, plus.slip, minus.slip);
          // Newton's method uses that the gradient of the increment is that of the
          // gap.
          check_one(derivatives.new_gap,
                    plus.gap_increment,
                    minus.gap_increment);
          for (unsigned int i = 0; i < 14; ++i)
            {
              check_one(derivatives.normal[i], plus.normal[i], minus.normal[i]);
              check_one(derivatives.tangential[i],
                        plus.tangential[i],
                        minus.tangential[i]);
            }
        }
    }
}

// The coverage of a point that goes from beyond one open end to beyond the other one of a
// single facet: its row, and the derivatives of that. By hand it is 27/32 at a quarter of the
// largest overhang.
BOOST_AUTO_TEST_CASE(coverage_at_both_ends)
{
  constexpr OpenEnds ends{true, true, .8};
  unsigned int       n_changes = 0;
  for (unsigned int k = 0; k < 100; ++k)
    {
      Positions old_x = {{{0., 0.}}, {{0., 0.}}, {{1., .1}}};
      put_point(old_x, 0, -.1 + random_number(.3), random_number(.1));
      Positions new_x = moved(old_x, .05);
      put_point(new_x, 0, 1.1 + random_number(.3), random_number(.1));
      Rows rows;
      FacetChain<double>(old_x, new_x, Caution::none, nullptr, ends)
        .evaluate(0, 0, rows);
      double change = 0., sum[2] = {0., 0.}, moment = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        {
          for (unsigned int c = 0; c < 2; ++c)
            {
              change += rows.coverage[2 * i + c] * (new_x[i][c] - old_x[i][c]);
              sum[c] += rows.coverage[2 * i + c];
            }
          moment +=
            .5 * (old_x[i][0] + new_x[i][0]) * rows.coverage[2 * i + 1] -
            .5 * (old_x[i][1] + new_x[i][1]) * rows.coverage[2 * i];
        }
      const double old_coverage = FacetChain<double>::coverage(old_x, ends);
      n_changes += old_coverage < 1. && rows.new_coverage < 1.;
      BOOST_CHECK_SMALL(change - (rows.new_coverage - old_coverage), 1e-14);
      BOOST_CHECK_SMALL(std::hypot(sum[0], sum[1]) + std::abs(moment), 1e-13);

      std::vector<std::array<AD, 2>> variables(3);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int c = 0; c < 2; ++c)
          variables[i][c] = AD(6, 2 * i + c, new_x[i][c]);
      FacetChain<AD>::Rows derivatives;
      FacetChain<AD>(old_x, variables, Caution::none, nullptr, ends)
        .evaluate(0, 0, derivatives);
      for (unsigned int j = 0; j < 6; ++j)
        {
          constexpr double h  = 1e-6;
          const auto       at = [&](const double length) {
            Positions x = new_x;
            x[j / 2][j % 2] += length;
            Rows shifted;
            FacetChain<double>(old_x, x, Caution::none, nullptr, ends)
              .evaluate(0, 0, shifted);
            return shifted;
          };
          const Rows up = at(h), down = at(-h);
          BOOST_CHECK_SMALL(derivatives.new_coverage.dx(j) -
                              (up.new_coverage - down.new_coverage) / (2. * h),
                            1e-6);
          for (unsigned int i = 0; i < 6; ++i)
            BOOST_CHECK_SMALL(derivatives.coverage[i].dx(j) -
                                (up.coverage[i] - down.coverage[i]) / (2. * h),
                              1e-5);
        }
    }
  BOOST_CHECK_GT(n_changes, 20);
  Positions x = {{{1.2, .3}}, {{0., 0.}}, {{1., 0.}}};
  BOOST_CHECK_CLOSE(FacetChain<double>::coverage(x, ends), 27. / 32., 1e-12);
}

BOOST_AUTO_TEST_SUITE_END()
