// SPDX-License-Identifier: LGPL-2.1-or-later

// The geometry of rigid obstacles, one point at a time: the identities on which
// energy and momenta hang, at random, resting, grazing and crossing states, with
// and without a motion; and derivatives against differences.

#include <base/exceptions.h>
#include <contact/obstacles/cylinder_shape.h>
#include <contact/obstacles/half_space.h>
#include <contact/obstacles/level_set.h>
#include <contact/obstacles/rigid_obstacle.h>
#include <contact/obstacles/sphere_shape.h>
#include <contact/obstacles/torus_shape.h>

#include <boost/test/unit_test.hpp>

#include <random>

using namespace Ricochet;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(obstacles)

namespace
{
  std::mt19937 generator(1);

  double
  random_number()
  {
    return std::uniform_real_distribution<double>(-1., 1.)(generator);
  }

  Tensor<1, 3>
  random_vector()
  {
    return Tensor<1, 3>({random_number(), random_number(), random_number()});
  }

  const Tensor<1, 3> centre({.3, -.2, .1}), direction({.2, .1, 1.});

  struct NamedShape
  {
    std::string                          name;
    std::shared_ptr<const ObstacleShape> shape;
    // A point near the surface.
    Tensor<1, 3> surface_point;
  };

  const std::vector<NamedShape> &
  shapes()
  {
    const auto point = [](const double x, const double y, const double z) {
      return Tensor<1, 3>({x, y, z});
    };
    static const std::vector<NamedShape> list = {
      {"half space", std::make_shared<HalfSpace>(centre, direction), centre},
      {"sphere",
       std::make_shared<SphereShape>(centre, 2., false),
       centre + point(2., 0., 0.)},
      {"bowl",
       std::make_shared<SphereShape>(centre, 2., true),
       centre + point(0., -2., 0.)},
      {"cylinder",
       std::make_shared<CylinderShape>(centre, point(0., 1., 1.), 1.5, false),
       centre + point(1.5, 1., 1.)},
      {"tube",
       std::make_shared<CylinderShape>(centre, point(0., 0., 3.), 1.5, true),
       centre + point(1.5, 0., 7.)},
      {"torus",
       std::make_shared<TorusShape>(centre, point(0., 0., 1.), 3., .8),
       centre + point(0., 3., .8)},
      {"wave",
       std::make_shared<LevelSet>(
         3,
         "2*z - sin(x)*cos(y)",
         std::vector<std::string>{"-cos(x)*cos(y)", "sin(x)*sin(y)", "2"},
         1.),
       point(.5 * dealii::numbers::PI, 0., .5)}};
    return list;
  }

  /// The beginning and the end of a displacement near the surface: random, at
  /// rest, grazing (along the surface), crossing it.
  std::vector<std::pair<Tensor<1, 3>, Tensor<1, 3>>>
  ways(const NamedShape &named)
  {
    std::vector<std::pair<Tensor<1, 3>, Tensor<1, 3>>> list;
    const Tensor<1, 3> x = named.surface_point, n = named.shape->normal(x);
    for (const double size : {1e-6, 1e-3, .1, .5})
      {
        for (unsigned int k = 0; k < 5; ++k)
          {
            const Tensor<1, 3> begin = x + size * random_vector();
            list.emplace_back(begin, begin + size * random_vector());
          }
        const Tensor<1, 3> along = tangent_plane(n) * random_vector();
        list.emplace_back(x, x + size * along);
        list.emplace_back(x - size * n, x + size * n + .1 * size * along);
      }
    list.emplace_back(x, x);
    list.emplace_back(x + .1 * n, x + .1 * n);
    return list;
  }

  const RigidMotion &
  motion()
  {
    static const RigidMotion motion({".3*t", "sin(t)", "-.2*t*t"},
                                    ".9*t + .1*t*t",
                                    Tensor<1, 3>({1., .5, -.3}),
                                    Tensor<1, 3>({.3, 1., -.5}));
    return motion;
  }

  Tensor<1, 3>
  unit_vector(const unsigned int c)
  {
    Tensor<1, 3> vector;
    vector[c] = 1.;
    return vector;
  }
} // namespace



BOOST_AUTO_TEST_CASE(gaps_are_distances)
{
  // By hand, in points with a simple distance.
  BOOST_CHECK_CLOSE(
    HalfSpace({}, Tensor<1, 3>({0., 2., 0.})).gap(Tensor<1, 3>({7., .25, 1.})),
    .25,
    1e-12);
  BOOST_CHECK_CLOSE(SphereShape({}, 5., false).gap(Tensor<1, 3>({3., 4., 12.})),
                    8.,
                    1e-12);
  BOOST_CHECK_CLOSE(SphereShape({}, 5., true).gap(Tensor<1, 3>({0., 3., 0.})),
                    2.,
                    1e-12);
  BOOST_CHECK_CLOSE(CylinderShape({}, Tensor<1, 3>({0., 0., 9.}), 3., false)
                      .gap(Tensor<1, 3>({3., 4., 55.})),
                    2.,
                    1e-12);
  BOOST_CHECK_CLOSE(CylinderShape({}, Tensor<1, 3>({0., 0., 9.}), 7., true)
                      .gap(Tensor<1, 3>({3., 4., 55.})),
                    2.,
                    1e-12);
  // Above the circle of radius 5 at (3, 4, 0).
  BOOST_CHECK_CLOSE(TorusShape({}, Tensor<1, 3>({0., 0., 1.}), 5., .5)
                      .gap(Tensor<1, 3>({3., 4., 2.})),
                    1.5,
                    1e-12);
  // On its axis.
  BOOST_CHECK_CLOSE(TorusShape({}, Tensor<1, 3>({0., 0., 1.}), 3., .5)
                      .gap(Tensor<1, 3>({1e-9, 0., 4.})),
                    4.5,
                    1e-6);
  // phi = x^2 + y^2 - 4 is 5 at (0, 3), where its gradient has the length 6.
  BOOST_CHECK_CLOSE(LevelSet(2, "x^2+y^2-4", {"2*x", "2*y"}, 1.)
                      .gap(Tensor<1, 3>({0., 3., 0.})),
                    5. / 6.,
                    1e-12);
}

// A node in the centre of a bowl, equally far from all of it, or moving there.
BOOST_AUTO_TEST_CASE(the_middle_of_a_circle)
{
  const SphereShape  bowl({}, 2., true);
  const Tensor<1, 3> middle, beside({.5, 0., 0.});
  for (const auto &[begin, end] : {std::make_pair(middle, middle),
                                   std::make_pair(beside, middle),
                                   std::make_pair(beside, -beside),
                                   std::make_pair(middle, beside)})
    {
      const Tensor<1, 3> normal = bowl.discrete_normal(begin, end);
      BOOST_CHECK_SMALL(normal * (end - begin) -
                          (bowl.gap(end) - bowl.gap(begin)),
                        1e-15);
      BOOST_CHECK_GT(normal.norm(), .5);
      BOOST_CHECK(
        std::isfinite(bowl.discrete_normal_derivative(begin, end).norm()));
    }
}

// direction . displacement = change of the gap, less the work of the motion,
// which is here measured in the obstacle's own frame; and gap increments are
// differences of gaps.
BOOST_AUTO_TEST_CASE(increments_are_differences_of_gaps)
{
  for (const bool moves : {false, true})
    for (const NamedShape &named : shapes())
      {
        const RigidObstacle obstacle(named.shape,
                                     moves ? motion() : RigidMotion());
        const double        begin_time = .4;
        for (const double time_step : {1e-4, .05, .5})
          for (const auto &[old_X, X] : ways(named))
            {
              const Placement begin = obstacle.motion().placement(begin_time);
              const Placement end =
                obstacle.motion().placement(begin_time + time_step);
              const Tensor<1, 3> old_x = begin.push_forward(old_X);
              const Tensor<1, 3> x     = end.push_forward(X);
              const auto         step =
                obstacle.step(begin_time, begin_time + time_step);
              const auto rows = obstacle.rows(step, old_x, x, x - old_x);
              BOOST_TEST_CONTEXT(named.name << (moves ? ", moving" : ""))
              {
                BOOST_CHECK_SMALL(rows.gap_increment -
                                    (obstacle.gap(x, begin_time + time_step) -
                                     obstacle.gap(old_x, begin_time)),
                                  4e-15 * 20.);
                if (!moves)
                  BOOST_CHECK_SMALL(rows.direction * (x - old_x) -
                                      rows.gap_increment,
                                    1e-15);
                // A point that the obstacle carries along does not slip.
                const auto carried =
                  obstacle.rows(step,
                                old_x,
                                end.push_forward(old_X),
                                end.push_forward(old_X) - old_x);
                BOOST_CHECK_SMALL(carried.relative_way.norm(), 1e-14);
                BOOST_CHECK_SMALL(carried.gap_increment, 4e-14);
              }
            }
      }
}

BOOST_AUTO_TEST_CASE(derivatives_are_derivatives)
{
  for (const bool moves : {false, true})
    for (const NamedShape &named : shapes())
      {
        const RigidObstacle obstacle(named.shape,
                                     moves ? motion() : RigidMotion());
        const auto          step = obstacle.step(.4, .5);
        for (const auto &[old_x, x] : ways(named))
          {
            const auto   rows = obstacle.rows(step, old_x, x, x - old_x);
            const double h    = 1e-5;
            // Round-off of the correction of Gonzalez' gradient.
            const double tolerance =
              named.name == "wave" && (x - old_x).norm() < 1e-4 ? 1e-4 : 1e-7;
            BOOST_TEST_CONTEXT(named.name << (moves ? ", moving" : "")
                                          << ", way " << (x - old_x).norm())
            for (unsigned int c = 0; c < 3; ++c)
              {
                const Tensor<1, 3> shift = h * unit_vector(c);
                const auto         plus =
                  obstacle.rows(step, old_x, x + shift, x + shift - old_x);
                const auto minus =
                  obstacle.rows(step, old_x, x - shift, x - shift - old_x);
                BOOST_CHECK_SMALL(((plus.direction - minus.direction) /
                                     (2. * h) -
                                   rows.direction_derivative * unit_vector(c))
                                    .norm(),
                                  tolerance);
                BOOST_CHECK_SMALL((plus.gap_increment - minus.gap_increment) /
                                      (2. * h) -
                                    rows.gap_gradient[c],
                                  1e-8);
                BOOST_CHECK_SMALL(
                  ((plus.relative_way - minus.relative_way) / (2. * h) -
                   rows.relative_way_derivative * unit_vector(c))
                    .norm(),
                  1e-9);
              }
          }
      }
}

// A force along the discrete normal has no moment about an axis of symmetry, with
// the arm in the middle of the step.
BOOST_AUTO_TEST_CASE(no_moment_about_an_axis_of_symmetry)
{
  for (const NamedShape &named : shapes())
    {
      if (named.shape->symmetry() == ObstacleShape::Symmetry::none)
        continue;
      for (const auto &[old_x, x] : ways(named))
        {
          const Tensor<1, 3> moment =
            cross_product_3d(.5 * (old_x + x) - named.shape->centre(),
                             named.shape->discrete_normal(old_x, x));
          BOOST_TEST_CONTEXT(named.name)
          if (named.shape->symmetry() == ObstacleShape::Symmetry::point)
            BOOST_CHECK_SMALL(moment.norm(), 2e-15);
          else
            BOOST_CHECK_SMALL(moment * named.shape->axis(), 1e-14);
        }
    }
}

// A wheel that turns about its axis is as good as one at rest, but drags
// touching points along.
BOOST_AUTO_TEST_CASE(a_turning_wheel)
{
  const Tensor<1, 3> axis({0., 0., 1.});
  const auto         shape =
    std::make_shared<CylinderShape>(Tensor<1, 3>(), axis, 2., false);
  const RigidObstacle wheel(shape,
                            RigidMotion({"0", "0", "0"}, "3*t", {}, axis));
  const RigidObstacle rest(shape);
  const Tensor<1, 3>  old_x({2.01, 0., 0.}), x({1.99, .1, 0.});
  const auto turning = wheel.rows(wheel.step(1., 1.01), old_x, x, x - old_x);
  const auto still   = rest.rows(rest.step(1., 1.01), old_x, x, x - old_x);
  BOOST_CHECK_SMALL((turning.direction - still.direction).norm(), 1e-15);
  BOOST_CHECK_SMALL(turning.gap_increment - still.gap_increment, 1e-16);
  // 3 rad/s at 2 m for 10 ms.
  BOOST_CHECK_CLOSE((still.relative_way - turning.relative_way)[1], .06, .5);
}

BOOST_AUTO_TEST_CASE(work_of_a_motion)
{
  // A force of (1, 2, 0) N at (3, 0, 0) m: 2 N along y over 1 m, and 6 N m about
  // the origin over a quarter of a turn.
  const Tensor<1, 3> force({1., 2., 0.}), moment({0., 0., 6.});
  const Tensor<1, 3> axis({0., 0., 1.});
  const RigidMotion  rise({"0", "t", "0"}, "0", {}, axis);
  BOOST_CHECK_CLOSE(rise.work(force, moment, 2., 3.), 2., 1e-10);
  const RigidMotion turn({"0", "0", "0"}, "pi/2*t", {}, axis);
  BOOST_CHECK_CLOSE(turn.work(force, moment, 2., 3.),
                    3. * dealii::numbers::PI,
                    1e-10);
  // About (3, 0, 0) the force has no moment.
  const RigidMotion about({"0", "0", "0"},
                          "t",
                          Tensor<1, 3>({3., 0., 0.}),
                          axis);
  BOOST_CHECK_SMALL(about.work(force, moment, 2., 3.), 1e-13);
}

BOOST_AUTO_TEST_CASE(expressions_are_checked)
{
  BOOST_CHECK_THROW(LevelSet(2, "y +* x", {"0", "1"}, 1.), InputError);
  BOOST_CHECK_THROW(LevelSet(2, "y", {"1"}, 1.), InputError);
  BOOST_CHECK_THROW(RigidMotion({"q", "0", "0"}, "0", {}, unit_vector(2)),
                    InputError);
  const RigidMotion bursts({"1/(t-1)", "0", "0"}, "0", {}, unit_vector(2));
  BOOST_CHECK_THROW(bursts.placement(1.), ComputationError);
  BOOST_CHECK(
    RigidMotion({" 0", "0 ", "0"}, "0", {}, unit_vector(2)).is_at_rest());
}

BOOST_AUTO_TEST_SUITE_END()
