// SPDX-License-Identifier: LGPL-2.1-or-later

// Impacts of a hyperelastic cube in 3D on obstacles of each shape: energy and
// angular momentum about the obstacle's axis of symmetry are kept, friction only
// dissipates, moving obstacles do the work that their resultants say, and Newton's
// method converges quadratically.

#include "on_all_ranks.h"
#include "meshes.h"

#include <base/exceptions.h>
#include <contact/obstacles/cylinder_shape.h>
#include <contact/obstacles/level_set.h>
#include <contact/obstacles/sphere_shape.h>
#include <contact/obstacles/torus_shape.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/neo_hookean.h>
#include <output/momenta.h>
#include <output/obstacle_work.h>
#include <problems/impact.h>

#include <boost/test/unit_test.hpp>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(obstacle_impacts)

namespace
{
  struct Target
  {
    std::string                          name;
    std::shared_ptr<const ObstacleShape> shape;
  };

  /// Each just below the cube.
  std::vector<Target>
  targets()
  {
    return {{"plane",
             std::make_shared<HalfSpace>(Tensor<1, 3>({0., 0., -.25}),
                                         Tensor<1, 3>({.2, .1, 1.}))},
            {"sphere",
             std::make_shared<SphereShape>(Tensor<1, 3>({.45, .4, -3.02}),
                                           3.,
                                           false)},
            {"tube",
             std::make_shared<CylinderShape>(Tensor<1, 3>({.4, 0., 2.9}),
                                             Tensor<1, 3>({0., 1., 0.}),
                                             3.,
                                             true)},
            {"torus",
             std::make_shared<TorusShape>(Tensor<1, 3>({4.45, .5, -1.02}),
                                          Tensor<1, 3>({0., 0., 1.}),
                                          4.,
                                          1.)},
            {"wave",
             std::make_shared<LevelSet>(
               3,
               "z + .05 - .04*sin(4*x)*cos(3*y)",
               std::vector<std::string>{"-.16*cos(4*x)*cos(3*y)",
                                        ".12*sin(4*x)*sin(3*y)",
                                        "1"},
               .1)}};
  }

  /// The cube, thrown at an obstacle.
  struct Throw
  {
    Throw(const std::shared_ptr<const ObstacleShape> &shape,
          const std::string                          &treatment,
          const double                                friction,
          const RigidMotion                          &motion = {},
          const std::string                          &scheme = "midpoint")
      : cube(false)
    {
      parameters.scheme.name                              = scheme;
      parameters.contact.treatment                        = treatment;
      parameters.contact.values["Compliance coefficient"] = 1e5;
      parameters.contact.values["Compliance exponent"]    = 2.;
      parameters.contact.values["Penalty epsilon0"]       = 1e-4;
      parameters.contact.values["Augmentation"]           = 500.;
      parameters.contact.values["Friction coefficient"]   = friction;
      parameters.contact.values["Tangential compliance"]  = 300.;
      parameters.newton.reuse_tangent_below               = 0.;
      const auto law =
        std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
          NeoHookean{200., 200.});
      impact = std::make_unique<Impact<3>>(
        parameters,
        cube.triangulation,
        ImpactSetup<3>{
          Material<3>(
            std::make_shared<Hyperelastic<3>>(law, PlaneState::plane_strain)),
          1.,
          1,
          std::set<dealii::types::boundary_id>(),
          Obstacles{{1, std::make_shared<RigidObstacle>(shape, motion)}}},
        MPI_COMM_WORLD);
      state = impact->state_in_motion(dealii::FunctionFromFunctionObjects<3>(
        {[](const Point<3> &x) { return .3 - .5 * (x[1] - .5); },
         [](const Point<3> &x) { return .2 + .5 * (x[0] - .5); },
         [](const Point<3> &) { return -2.; }}));
    }

    /// @return the energy, with that of contact.
    double
    energy() const
    {
      return impact->system.kinetic_energy(state.velocity) +
        impact->bulk->energy(state.solution) +
        impact->contact->potential(state.solution, state.time);
    }

    StepReport
    step(const double time_step)
    {
      State            next;
      const StepReport report =
        impact->scheme->step(impact->system, state, time_step, next);
      next.time = state.time + time_step;
      touched   = touched || next.contact_force.l2_norm() > 0.;
      previous  = state;
      state     = next;
      return report;
    }

    const CubeAbovePlane<3>    cube;
    ImpactParameters           parameters = on_all_ranks();
    std::unique_ptr<Impact<3>> impact;
    State                      state, previous;
    bool                       touched = false;
  };

  constexpr double       time_step = .02;
  constexpr unsigned int n_steps   = 15;
} // namespace



BOOST_AUTO_TEST_CASE(energy_and_angular_momentum_are_kept)
{
  for (const std::string treatment : {"persistent contact",
                                      "Ayyad-Barboteu two-step",
                                      "improved normal compliance",
                                      "Hauret-Le Tallec"})
    for (const Target &target : fewer_in_debug(targets()))
      BOOST_TEST_CONTEXT(treatment << ", " << target.name)
      {
        Throw            cube(target.shape, treatment, 0.);
        const Momenta<3> momenta(cube.impact->body,
                                 cube.impact->system.mass_matrix(),
                                 /* small strains */ false);
        const auto       angular_momentum = [&]() {
          const Tensor<1, 3> linear = momenta.linear(cube.state.velocity);
          return momenta.angular(cube.state.solution, cube.state.velocity) -
            cross_product_3d(target.shape->centre(), linear);
        };
        const double       energy = cube.energy();
        const Tensor<1, 3> spin   = angular_momentum();
        for (unsigned int n = 0; n < n_steps; ++n)
          cube.step(time_step);
        BOOST_CHECK(cube.touched);
        BOOST_CHECK_SMALL(cube.energy() / energy - 1., 1e-9);
        const Tensor<1, 3> change = angular_momentum() - spin;
        if (target.shape->symmetry() == ObstacleShape::Symmetry::point)
          BOOST_CHECK_SMALL(change.norm(), 1e-10);
        if (target.shape->symmetry() == ObstacleShape::Symmetry::axis)
          BOOST_CHECK_SMALL(change * target.shape->axis(), 1e-10);
        // The test is not empty: about another axis it is not kept.
        BOOST_CHECK_GT(momenta.linear(cube.state.velocity)[2], -1.5);
      }
}

// Treatments that lose energy on the plane lose it here too.
BOOST_AUTO_TEST_CASE(forces_at_the_end_of_a_step_dissipate)
{
  for (const std::string treatment :
       {"penalty", "standard normal compliance", "Signorini active set"})
    for (const Target &target : fewer_in_debug(targets()))
      BOOST_TEST_CONTEXT(treatment << ", " << target.name)
      {
        Throw        cube(target.shape, treatment, 0.);
        const double first = cube.energy();
        double       old   = first;
        for (unsigned int n = 0; n < n_steps; ++n)
          {
            cube.step(time_step);
            const double energy = cube.energy();
            BOOST_CHECK_LE(energy, old + 1e-10 * first);
            old = energy;
          }
        BOOST_CHECK_LT(old, .999 * first);
        BOOST_CHECK_GT(old, .3 * first);
      }
}

BOOST_AUTO_TEST_CASE(friction_only_dissipates)
{
  for (const std::string treatment :
       {"persistent contact", "improved normal compliance"})
    for (const Target &target : fewer_in_debug(targets()))
      BOOST_TEST_CONTEXT(treatment << ", " << target.name)
      {
        Throw        cube(target.shape, treatment, .3);
        const double first = cube.energy();
        double       work  = 0.;
        for (unsigned int n = 0; n < n_steps; ++n)
          {
            const double old    = cube.energy();
            const auto   report = cube.step(time_step);
            BOOST_CHECK_GE(report.friction_work, -1e-13 * first);
            BOOST_CHECK_SMALL(cube.energy() - old + report.friction_work,
                              1e-10 * first);
            work += report.friction_work;
          }
        BOOST_CHECK_GT(work, 1e-3 * first);
      }
}

// A moving obstacle: its work on the body, from the balance and from its
// resultants, differs by terms of second order in the step.
BOOST_AUTO_TEST_CASE(work_of_moving_obstacles)
{
  const RigidMotion motion({".1*t", "-.1*t", ".4*sin(2*t)"},
                           ".8*t",
                           Tensor<1, 3>({.5, .5, 0.}),
                           Tensor<1, 3>({.2, 0., 1.}));
  for (const std::string treatment :
       {"persistent contact", "improved normal compliance"})
    for (const Target &target : fewer_in_debug(targets()))
      BOOST_TEST_CONTEXT(treatment << ", " << target.name)
      {
        std::vector<double> differences;
        for (const unsigned int refinement : {1, 2, 4})
          {
            Throw                 cube(target.shape, treatment, .3, motion);
            const ObstacleWork<3> obstacle_work(cube.impact->body,
                                                {cube.impact->obstacles});
            double                by_balance = 0., by_resultants = 0.;
            for (unsigned int n = 0; n < 10 * refinement; ++n)
              {
                const double old    = cube.energy();
                const auto   report = cube.step(time_step / refinement);
                BOOST_CHECK_GE(report.friction_work, -1e-13);
                by_balance += cube.energy() - old + report.friction_work;
                by_resultants += obstacle_work(cube.previous.solution,
                                               cube.state.solution,
                                               {cube.state.contact_force},
                                               cube.previous.time,
                                               cube.state.time);
              }
            BOOST_CHECK(cube.touched);
            BOOST_CHECK_GT(std::abs(by_balance), .01);
            differences.push_back(std::abs(by_balance - by_resultants) /
                                  std::abs(by_balance));
          }
        BOOST_CHECK_LT(differences[0], 1e-2);
        // 1/16 for four times smaller steps, within what impacts leave of it.
        BOOST_CHECK_LT(differences[2], .15 * differences[0] + 2e-7);
      }
}

// The contact force of schemes with forces at instants is that at the end of
// the step, where the obstacle is then: a plate that flies away is not touched.
BOOST_AUTO_TEST_CASE(instants_see_the_obstacle_where_it_is)
{
  const auto plate =
    std::make_shared<HalfSpace>(Tensor<1, 3>(), Tensor<1, 3>({0., 0., 1.}));
  const RigidMotion away({"0", "0", "-3*t"},
                         "0",
                         {},
                         Tensor<1, 3>({0., 0., 1.}));
  const RigidMotion closer({"0", "0", "3*t"},
                           "0",
                           {},
                           Tensor<1, 3>({0., 0., 1.}));
  for (const std::string scheme : {"HHT", "TR-BDF2", "Crank-Nicolson"})
    BOOST_TEST_CONTEXT(scheme)
    {
      Throw left(plate, "penalty", 0., away, scheme);
      left.step(1e-3);
      BOOST_CHECK_EQUAL(left.state.contact_force.l2_norm(), 0.);
      // The pressure of the first step is that of its penetration: the body comes
      // down by 2 mm, the plate rises by 3 mm.
      Throw met(plate, "penalty", 0., closer, scheme);
      met.step(1e-3);
      const auto summary =
        met.impact->contact
          ->summary(
            {met.state.solution, met.state.contact_force, met.state.time})
          .at(1);
      BOOST_CHECK_CLOSE(summary.mean_gap, -5e-3, 8.);
    }
}

// Persistent contact predicts body and obstacle in the middle of the step: with
// 2 m/s and 4 m/s towards each other over 10 ms they come nearer by 30 mm
// there, so that a gap of 29 mm closes and one of 31 mm does not. (With the
// obstacle at the beginning of the step, contact would be missed at 29 mm.) The
// second step has the velocity from the first, which took 60 mm.
BOOST_AUTO_TEST_CASE(predictors_look_half_a_step_ahead)
{
  const RigidMotion closer({"0", "0", "4*t"},
                           "0",
                           {},
                           Tensor<1, 3>({0., 0., 1.}));
  for (const double gap : {.029, .031, .089, .091})
    {
      const bool two_steps = gap > .06;
      Throw      cube(std::make_shared<HalfSpace>(Tensor<1, 3>({0., 0., -gap}),
                                             Tensor<1, 3>({0., 0., 1.})),
                 "persistent contact",
                 0.,
                 closer);
      cube.step(.01);
      if (two_steps)
        {
          BOOST_CHECK(!cube.touched);
          cube.step(.01);
        }
      BOOST_CHECK_EQUAL(cube.touched, gap < (two_steps ? .09 : .03));
    }
}

BOOST_AUTO_TEST_CASE(newton_converges_quadratically)
{
  for (const std::string treatment :
       {"persistent contact", "improved normal compliance", "penalty"})
    for (const double friction : {0., .3})
      for (const Target &target : fewer_in_debug(targets()))
        BOOST_TEST_CONTEXT(treatment << ", " << target.name
                                     << ", mu = " << friction)
        {
          Throw        cube(target.shape, treatment, friction);
          unsigned int n_seen = 0;
          double       worst  = 0.;
          cube.impact->system.newton_observer =
            [&](const std::vector<NewtonSolver::Iteration> &history,
                const auto &) {
              for (unsigned int k = 2; k < history.size(); ++k)
                {
                  const double before = history[k - 1].relative_residual;
                  const double after  = history[k].relative_residual;
                  // Near the solution, and far from round-off.
                  if (before < 1e-3 && before > 3e-7 &&
                      history[k - 1].active_set == history[k - 2].active_set)
                    {
                      ++n_seen;
                      worst = std::max(worst, after / (before * before));
                    }
                }
            };
          for (unsigned int n = 0; n < n_steps; ++n)
            cube.step(time_step);
          BOOST_CHECK_GE(n_seen, 3u);
          // The direction of slip turns the faster the less slip there is.
          BOOST_CHECK_LT(worst, friction == 0. ? 50. : 1000.);
        }
}

BOOST_AUTO_TEST_CASE(overlaps_at_the_start_are_refused)
{
  // Below the surface; and a ball that is smaller than a cell, inside it.
  BOOST_CHECK_THROW(
    Throw(std::make_shared<HalfSpace>(Tensor<1, 3>({0., 0., .1}),
                                      Tensor<1, 3>({0., 0., 1.})),
          "penalty",
          0.),
    InputError);
  BOOST_CHECK_THROW(
    Throw(std::make_shared<SphereShape>(Tensor<1, 3>({.3, .2, .2}), .05, false),
          "penalty",
          0.),
    InputError);
  // A function whose gradient is another one's.
  BOOST_CHECK_THROW(Throw(std::make_shared<LevelSet>(
                            3,
                            "z + .1 + .01*x*x",
                            std::vector<std::string>{".01*x", "0", "1"},
                            1.),
                          "penalty",
                          0.),
                    InputError);
}

BOOST_AUTO_TEST_SUITE_END()
