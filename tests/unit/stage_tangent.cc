// SPDX-License-Identifier: LGPL-2.1-or-later

// The assembled contact tangent of every treatment against finite differences
// of the assembled residual, in 1D, 2D and 3D, on tensor product elements and
// simplices: open, closing, closed and opening states, with and without
// friction. Most forces are piecewise linear, so that away from kinks a
// difference quotient is exact.

#include "meshes.h"

#include <base/exceptions.h>
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/contact_sum.h>
#include <contact/treatments/contact_treatment.h>
#include <contact/treatments/nitsche_bound.h>
#include <contact/obstacles/cylinder_shape.h>
#include <contact/obstacles/level_set.h>
#include <contact/obstacles/sphere_shape.h>
#include <contact/treatments/pointwise_contact.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/neo_hookean.h>
#include <time_integration/semi_discrete_system.h>

#include <deal.II/base/function_lib.h>

#include <boost/test/unit_test.hpp>

#include <set>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(stage_tangent)

namespace
{
  const LinearElastic material{1.5, 1.};

  template <int dim>
  void
  check(const std::string            &treatment,
        const std::string            &scheme,
        const double                  theta,
        const bool                    simplices,
        const unsigned int            degree,
        const double                  friction     = 0.,
        const std::vector<Obstacles> &obstacles_of = {})
  {
    const CubeAbovePlane<dim> cube(simplices);
    ContactParameters         parameters;
    parameters.treatment                        = treatment;
    parameters.values["Nitsche theta"]          = theta;
    parameters.values["Nitsche gamma0"]         = 50.;
    parameters.values["Compliance coefficient"] = 20.;
    parameters.values["Compliance exponent"]    = 2.5;
    parameters.values["Friction coefficient"]   = friction;
    parameters.values["Tangential compliance"]  = .5;
    // A light augmentation: active nodes are then pressed, as at a solution.
    parameters.values["Augmentation"] = .5;
    const Body<dim>                               body(cube.triangulation,
                         degree,
                         {},
                         {1},
                         multiplier_space(parameters),
                         MPI_COMM_WORLD);
    std::vector<std::unique_ptr<ContactOperator>> contacts;
    for (const Obstacles &obstacles : obstacles_of.empty()
           ? std::vector<Obstacles>{cube.plane(.02)}
           : obstacles_of)
      contacts.push_back(make_contact(parameters,
                                      scheme_traits(scheme),
                                      body,
                                      material,
                                      obstacles));
    const unsigned int n_contacts = contacts.size();
    const auto         contact    = n_contacts == 1
                 ? std::move(contacts[0])
                 : std::make_unique<ContactSum>(std::move(contacts));

    Vector zero = body.make_vector(), residual(zero), perturbed_residual(zero);
    Vector solution(zero), old_solution(zero), direction(zero);
    Vector old_force(zero), difference(zero), product(zero);
    Vector mean_velocity(zero), rate_origin(zero);
    ContactStart        start{old_solution,
                       old_force,
                       mean_velocity,
                       scheme == "midpoint" ? .1 : 0.};
    std::vector<Vector> shares;
    start.shares = &shares;
    // Friction of an instant, with a velocity that is not that of a step.
    if (scheme != "midpoint" && friction > 0.)
      {
        start.rate_origin = &rate_origin;
        start.rate_time   = .07;
      }

    bool         contact_seen  = false;
    unsigned int n_comparisons = 0;
    for (const double size : {1e-3, .05, .2})
      for (unsigned int seed = 0; seed < 4; ++seed)
        {
          randomise(solution, size, seed);
          randomise(old_solution, size, seed + 10);
          randomise(rate_origin, size, seed + 30);
          randomise(direction, 1., seed + 20);
          // A mean velocity towards the plane, so that predictors touch it.
          mean_velocity = -10.;
          // And a reaction from the plane, from which active sets start.
          old_force = -.2;
          shares.assign(n_contacts, old_force);

          // A small weight of the contact force and a residual and a tangent
          // that are not empty before: contact must only add its part (or take
          // out rows).
          const double weight = .7;
          Matrix       tangent;
          tangent.reinit(body.sparsity_pattern());
          for (const auto i : zero.locally_owned_elements())
            tangent.set(i, i, 2.);
          tangent.compress(VectorOperation::insert);
          const auto evaluate = [&](const Vector &point, Vector &result) {
            result = point;
            result *= 2.;
            contact->add_residual(point, result);
          };

          // The reactions of active sets are those of the accepted iterate.
          contact->begin_stage(start, weight);
          evaluate(solution, residual);
          contact->accept_iterate();
          evaluate(solution, residual);
          contact_seen = contact_seen ||
            contact->active_set_description().substr(0, 2) != "0 ";
          const auto signature = contact->active_set().tangent_key;
          contact->add_tangent(tangent);
          tangent.vmult(product, direction);

          // Central differences over so short a step that no branch changes.
          const double eps = 1e-8;
          Vector       point(solution);
          point.add(eps, direction);
          evaluate(point, difference);
          if (contact->active_set().tangent_key != signature)
            continue;
          point.add(-2. * eps, direction);
          evaluate(point, perturbed_residual);
          if (contact->active_set().tangent_key != signature)
            continue;
          ++n_comparisons;
          difference -= perturbed_residual;
          difference *= .5 / eps;
          difference -= product;
          BOOST_CHECK_SMALL(difference.linfty_norm(),
                            4e-6 * (1. + product.linfty_norm()));
        }
    BOOST_CHECK_MESSAGE(contact_seen,
                        treatment << " never saw contact in " << dim << "D");
    BOOST_CHECK_GE(n_comparisons, 6u);
  }

  template <int dim>
  void
  check_all(const bool simplices, const unsigned int degree)
  {
    for (const double theta : {1., -1., 0.})
      {
        check<dim>("Nitsche", "HHT", theta, simplices, degree);
        check<dim>("Nitsche", "midpoint", theta, simplices, degree);
        check<dim>("Nitsche-hybrid", "midpoint", theta, simplices, degree);
      }
    if (dim > 1)
      for (const std::string treatment :
           {"Nitsche", "Nitsche-hybrid", "proximal augmented Lagrangian"})
        for (const std::string scheme : {"HHT", "midpoint"})
          if (treatment != "Nitsche-hybrid" || scheme == "midpoint")
            check<dim>(treatment, scheme, 1., simplices, degree, .3);
    check<dim>("penalty", "HHT", 1., simplices, degree);
    check<dim>("Hauret-Le Tallec", "midpoint", 1., simplices, degree);
    check<dim>("proximal augmented Lagrangian", "HHT", 1., simplices, degree);
    if (degree == 1)
      {
        check<dim>("Signorini multipliers", "HHT", 1., simplices, degree);
        check<dim>("Signorini active set", "HHT", 1., simplices, degree);
        for (const std::string treatment :
             {"standard normal compliance",
              "standard normal compliance at midpoint",
              "improved normal compliance",
              "persistent contact",
              "Ayyad-Barboteu two-step"})
          check<dim>(treatment, "midpoint", 1., simplices, degree);
        if (dim > 1)
          for (const std::string treatment : {"penalty",
                                              "Hauret-Le Tallec",
                                              "Signorini multipliers",
                                              "standard normal compliance",
                                              "improved normal compliance",
                                              "Signorini active set",
                                              "persistent contact",
                                              "Ayyad-Barboteu two-step"})
            check<dim>(treatment, "midpoint", 1., simplices, degree, .3);
        if (dim > 1)
          for (const std::string treatment :
               {"penalty", "Signorini multipliers", "Signorini active set"})
            check<dim>(treatment, "HHT", 1., simplices, degree, .3);
      }
  }
} // namespace



BOOST_AUTO_TEST_CASE(in_1d)
{
  check_all<1>(false, 1);
  check_all<1>(false, 2);
}

BOOST_AUTO_TEST_CASE(in_2d)
{
  check_all<2>(false, 1);
  check_all<2>(true, 1);
  check_all<2>(true, 2);
}

BOOST_AUTO_TEST_CASE(in_3d)
{
  check_all<3>(false, 1);
  check_all<3>(true, 1);
}

// As above against obstacles that are curved and move, where the direction of
// the force and the slip follow the point.
namespace
{
  template <int dim>
  void
  check_obstacle(const Obstacles &obstacles)
  {
    for (const std::string treatment : {"penalty",
                                        "proximal augmented Lagrangian",
                                        "Signorini multipliers",
                                        "Signorini active set"})
      for (const double friction : {0., .3})
        check<dim>(treatment, "HHT", 1., true, 1, friction, {obstacles});
    for (const double theta : {1., 0.})
      {
        check<dim>("Nitsche", "HHT", theta, true, 1, 0., {obstacles});
        check<dim>("Nitsche-hybrid",
                   "midpoint",
                   theta,
                   true,
                   1,
                   0.,
                   {obstacles});
      }
    for (const std::string treatment : {"penalty",
                                        "Hauret-Le Tallec",
                                        "Signorini multipliers",
                                        "standard normal compliance",
                                        "improved normal compliance",
                                        "Signorini active set",
                                        "persistent contact",
                                        "Ayyad-Barboteu two-step"})
      for (const double friction : {0., .3})
        check<dim>(treatment, "midpoint", 1., true, 1, friction, {obstacles});
  }

  /// As above with several obstacles that hold the same nodes.
  template <int dim>
  void
  check_corner(const std::vector<Obstacles> &obstacles)
  {
    for (const double friction : {0., .3})
      if (dim == 2 || friction == 0.)
        {
          check<dim>("Signorini active set",
                     "HHT",
                     1.,
                     true,
                     1,
                     friction,
                     obstacles);
          for (const std::string treatment : {"Signorini active set",
                                              "persistent contact",
                                              "Ayyad-Barboteu two-step"})
            check<dim>(treatment, "midpoint", 1., true, 1, friction, obstacles);
        }
  }

  Obstacles
  at_rest(const std::shared_ptr<const ObstacleShape> &shape)
  {
    return {{1, std::make_shared<RigidObstacle>(shape)}};
  }

  Obstacles
  moving(const std::shared_ptr<const ObstacleShape> &shape)
  {
    return {{1,
             std::make_shared<RigidObstacle>(
               shape,
               RigidMotion({".3*t", "-.1*t", "0"},
                           ".7*t",
                           dealii::Tensor<1, 3>({.2, -1., 0.}),
                           dealii::Tensor<1, 3>({0., 0., 1.})))}};
  }
} // namespace

BOOST_AUTO_TEST_CASE(before_a_disk)
{
  check_obstacle<2>(
    at_rest(std::make_shared<SphereShape>(dealii::Tensor<1, 3>({.5, -2., 0.}),
                                          1.99,
                                          false)));
}

BOOST_AUTO_TEST_CASE(in_a_corner)
{
  const Obstacles disk =
    at_rest(std::make_shared<SphereShape>(dealii::Tensor<1, 3>({.5, -2., 0.}),
                                          1.99,
                                          false));
  const Obstacles beside =
    at_rest(std::make_shared<SphereShape>(dealii::Tensor<1, 3>({-1.5, -1., 0.}),
                                          2.2,
                                          false));
  check_corner<2>({disk, beside});
  check_corner<2>({CubeAbovePlane<2>(true).plane(.02), beside});
  check_corner<3>(
    {CubeAbovePlane<3>(true).plane(.02),
     at_rest(
       std::make_shared<SphereShape>(dealii::Tensor<1, 3>({-1.5, .5, -1.}),
                                     2.4,
                                     false)),
     at_rest(
       std::make_shared<SphereShape>(dealii::Tensor<1, 3>({.5, -1.5, -1.}),
                                     2.4,
                                     false))});
}

BOOST_AUTO_TEST_CASE(before_a_moving_wave)
{
  check_obstacle<2>(moving(
    std::make_shared<LevelSet>(2,
                               "y + .02 - .05*sin(3*x)",
                               std::vector<std::string>{"-.15*cos(3*x)", "1"},
                               1.)));
}

BOOST_AUTO_TEST_CASE(in_a_moving_tube)
{
  check_obstacle<3>(
    moving(std::make_shared<CylinderShape>(dealii::Tensor<1, 3>({.5, 2., .9}),
                                           dealii::Tensor<1, 3>({.1, 1., 0.}),
                                           1.02,
                                           true)));
}

// The pressure field of a state depends on that state alone, whatever the
// iterates in between: after a failed step it is still that of the last good
// one.
BOOST_AUTO_TEST_CASE(pressure_fields_do_not_remember_iterates)
{
  const CubeAbovePlane<2> cube(false);
  for (const std::string treatment :
       {"Hauret-Le Tallec", "improved normal compliance", "penalty"})
    {
      ContactParameters parameters;
      parameters.treatment                        = treatment;
      parameters.values["Compliance coefficient"] = 20.;
      const Body<2> body(cube.triangulation,
                         1,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
      const auto    contact = make_contact(parameters,
                                        scheme_traits("midpoint"),
                                        body,
                                        material,
                                        cube.plane(0.));
      Vector        zero = body.make_vector(), residual(zero), velocity(zero);
      Vector        pressed(zero), failed(zero);
      pressed = -.01;
      failed  = -.3;
      const ContactStart start{zero, zero, velocity, .1};
      contact->begin_stage(start, 1.);
      contact->add_residual(pressed, residual);
      contact->accept_iterate();
      const Vector force(contact->contact_force());
      const Vector before = contact->pressure_field({pressed, force, 0.});
      BOOST_CHECK_GT(before.linfty_norm(), .05);
      residual = 0.;
      contact->add_residual(failed, residual);
      Vector after = contact->pressure_field({pressed, force, 0.});
      after -= before;
      BOOST_CHECK_EQUAL(after.linfty_norm(), 0.);
    }
}

// Vertices of quadratic tetrahedra have no boundary mass, and not one that
// round-off makes positive or negative.
BOOST_AUTO_TEST_CASE(boundary_masses_of_quadratic_tetrahedra)
{
  const CubeAbovePlane<3> cube(true);
  const Body<3>           body(cube.triangulation,
                     2,
                     {},
                     {1},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD);
  const ContactPoints nodes  = make_contact_nodes(body, cube.plane(0.), false);
  unsigned int        n_zero = 0;
  double              area   = 0.;
  for (const ContactPoint &point : nodes.points)
    {
      n_zero += point.weight == 0.;
      area += point.weight;
      BOOST_CHECK(point.weight == 0. || point.weight > 1e-3);
    }
  BOOST_CHECK_CLOSE(dealii::Utilities::MPI::sum(area, MPI_COMM_WORLD),
                    1.,
                    1e-10);
  // 3 x 3 vertices.
  BOOST_CHECK_EQUAL(dealii::Utilities::MPI::sum(n_zero, MPI_COMM_WORLD), 9u);
  BOOST_CHECK_THROW(
    make_nodal_contact_points(body, cube.plane(0.), false, true),
    InputError);
}

// A contact point with an unknown that is not on the rank is an error, and not
// a read of arbitrary memory.
BOOST_AUTO_TEST_CASE(unknowns_of_contact_points_are_checked)
{
  const CubeAbovePlane<2> cube(false);
  const Body<2>           body(cube.triangulation,
                     1,
                     {},
                     {1},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD);
  ContactPoints           points;
  points.points.emplace_back();
  points.add_displacement(100000, 1, 1., 0.);
  points.points.back().end = 1;
  BOOST_CHECK_THROW(ContactPointEvaluator(body, points), std::exception);
}

// The constant of the trace inequality on a square cell of edge a with one edge in
// contact and lambda = 0, by hand: a constant stress 2 mu e has h_T a (2 mu e)^2 on
// the edge, with h_T = sqrt(2) a, against the energy 2 mu e^2 a^2; so the constant
// is at least sqrt(2) 2 mu.
BOOST_AUTO_TEST_CASE(trace_constant_of_a_square)
{
  const CubeAbovePlane<2> square(false, 3);
  const Body<2>           body(square.triangulation,
                     1,
                     {},
                     {1},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD);
  const double            constant =
    nitsche_trace_constant(body, LinearElastic{0., 1.}, square.plane(0.));
  BOOST_CHECK_GE(constant, 2. * std::sqrt(2.) * (1. - 1e-10));
  BOOST_CHECK_LT(constant, 4. * 2. * std::sqrt(2.));
}

// An inverted element makes the force not a number, also where its mark sits in
// an unknown that is clamped.
BOOST_AUTO_TEST_CASE(inverted_elements_next_to_clamped_unknowns)
{
  const CubeAbovePlane<2> cube(false);
  for (const unsigned int clamped : {0, 1, 2})
    {
      const Body<2>             body(cube.triangulation,
                         1,
                         {clamped},
                         {},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
      const HyperelasticBulk<2> bulk(
        body,
        Material<2>(std::make_shared<Hyperelastic<2>>(
          std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
            NeoHookean{1., 1.}),
          PlaneState::plane_strain)));
      ContactParameters parameters;
      parameters.treatment                 = "penalty";
      const auto                   contact = make_contact<2>(parameters,
                                           scheme_traits("midpoint"),
                                           body,
                                           nullptr,
                                           Obstacles());
      const BodyMatrix             mass    = assemble_mass_matrix(body, 1.);
      SemiDiscreteSystem::Unknowns unknowns;
      unknowns.massless    = dealii::IndexSet(mass.m());
      unknowns.multipliers = dealii::IndexSet(mass.m());
      unknowns.constraints = &body.constraints();
      unknowns.dim         = 2;
      unknowns.pattern =
        [&body]() -> const dealii::TrilinosWrappers::SparsityPattern & {
        return body.sparsity_pattern();
      };
      const SemiDiscreteSystem system(mass,
                                      mass,
                                      bulk,
                                      *contact,
                                      unknowns,
                                      {},
                                      NewtonSolver::Parameters(),
                                      LinearSolver::Parameters());
      // Upside down.
      Vector inverted = body.make_vector(), zero(inverted), force(inverted);
      body.interpolate(dealii::Functions::ConstantFunction<2>(
                         std::vector<double>{0., 1.}),
                       inverted);
      Vector               heights(inverted);
      dealii::Tensor<1, 2> up({0., 1.});
      body.interpolate(dealii::Functions::Monomial<2>(up, 2), heights);
      inverted.add(-2., heights);
      system.total_force(inverted, zero, 0., force);
      BOOST_CHECK(std::isnan(force.l2_norm()));
    }
}

// Factorisations are found again by a hash of the branches of all contact
// points: no two states may have the same one.
BOOST_AUTO_TEST_CASE(signatures_differ)
{
  const unsigned int n_points = 6;
  const unsigned int n_ranks =
    dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD);
  const unsigned int rank =
    dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  std::set<std::uint64_t> signatures;
  const unsigned int      n_states = 1u << (n_points * n_ranks);
  for (unsigned int state = 0; state < n_states; ++state)
    {
      std::vector<int> branches;
      for (unsigned int p = 0; p < n_points; ++p)
        branches.push_back((state >> (rank * n_points + p)) & 1);
      signatures.insert(global_hash(branches, MPI_COMM_WORLD));
    }
  BOOST_CHECK_EQUAL(signatures.size(), n_states);
}

BOOST_AUTO_TEST_CASE(clamped_contact_nodes_are_refused)
{
  const CubeAbovePlane<2> cube(false);
  for (const std::string treatment :
       {"Signorini multipliers", "Signorini active set"})
    {
      ContactParameters parameters;
      parameters.treatment = treatment;
      // The sides (id 0) have common corners with the contact boundary (id 1).
      const Body<2> body(cube.triangulation,
                         1,
                         {0},
                         {1},
                         multiplier_space(parameters),
                         MPI_COMM_WORLD);
      BOOST_CHECK_THROW(make_contact(parameters,
                                     scheme_traits("HHT"),
                                     body,
                                     material,
                                     cube.plane(.02)),
                        InputError);
    }
}

BOOST_AUTO_TEST_SUITE_END()
