// SPDX-License-Identifier: LGPL-2.1-or-later

// Impacts of deformable bodies on each other, coarse: two disks, a block on a strip,
// bars. The balance of energy closes for every treatment, conserved quantities
// are kept, including linear and angular momentum of both bodies together,
// friction only dissipates; assembled tangents are those of differences; a step
// is the same on two ranks.

#include "on_all_ranks.h"
#include "contact_tangent.h"
#include "meshes.h"

#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <discretization/boundary_load.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/neo_hookean.h>
#include <output/momenta.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <Eigen/SVD>

#include <boost/test/unit_test.hpp>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(pair_contact)

namespace
{
  Material<2>
  rubber(const double stiffness, const double eta = 0.)
  {
    const auto law =
      std::make_shared<HyperelasticLawImplementation<NeoHookean>>(
        NeoHookean{stiffness, stiffness});
    Viscosity viscosity;
    if (eta > 0.)
      viscosity = {Viscosity::Law::curnier, eta};
    return {std::make_shared<Hyperelastic<2>>(law, PlaneState::plane_strain),
            viscosity};
  }

  const std::vector<std::string> treatments = {"persistent contact",
                                               "Ayyad-Barboteu two-step",
                                               "improved normal compliance",
                                               "Hauret-Le Tallec",
                                               "Signorini active set",
                                               "standard normal compliance",
                                               "penalty"};

  /// Treatments, with the coupling after the comma.
  const std::vector<std::string> with_mortar = {
    "persistent contact, mortar",
    "persistent contact, dual mortar",
    "Ayyad-Barboteu two-step, mortar",
    "improved normal compliance, mortar",
    "improved normal compliance, dual mortar",
    "Signorini active set, mortar",
    "Signorini active set, dual mortar",
    "standard normal compliance, mortar"};

  std::vector<std::string>
  all_methods()
  {
    std::vector<std::string> all = treatments;
    all.insert(all.end(), with_mortar.begin(), with_mortar.end());
    return all;
  }

  bool
  keeps_energy(const std::string &method)
  {
    for (const std::string treatment : {"persistent contact",
                                        "Ayyad-Barboteu two-step",
                                        "improved normal compliance",
                                        "Hauret-Le Tallec"})
      if (method.rfind(treatment, 0) == 0)
        return true;
    return false;
  }

  ImpactParameters
  parameters_of(const std::string &method,
                const double       friction,
                const std::string &scheme = "midpoint")
  {
    ImpactParameters parameters  = on_all_ranks();
    const auto       comma       = method.find(", ");
    parameters.contact.treatment = method.substr(0, comma);
    if (comma != std::string::npos)
      parameters.contact.coupling = method.substr(comma + 2);
    parameters.scheme.name                              = scheme;
    parameters.contact.values["Compliance coefficient"] = 2e4;
    parameters.contact.values["Compliance exponent"]    = 2.;
    parameters.contact.values["Penalty epsilon0"]       = 1e-4;
    parameters.contact.values["Augmentation"]           = 500.;
    parameters.contact.values["Friction coefficient"]   = friction;
    parameters.contact.values["Tangential compliance"]  = 300.;
    parameters.newton.reuse_tangent_below               = 0.;
    return parameters;
  }

  /// Two disks that meet off their centres.
  struct Collision
  {
    Collision(const std::string &treatment,
              const double       friction,
              const double       eta    = 0.,
              const double       offset = .5,
              const bool         swap   = false,
              const std::string &scheme = "midpoint")
      : triangulation(MPI_COMM_WORLD)
      , parameters(parameters_of(treatment, friction, scheme))
    {
      const double along = std::sqrt(2.01 * 2.01 - offset * offset);
      make_ringed_disks({{Point<2>(-.5 * along, -.5 * offset), 1., 4, 0.},
                         {Point<2>(.5 * along, .5 * offset), 1., 3, .02}},
                        triangulation);
      ImpactSetup<2> setup{rubber(200.)};
      setup.parts.push_back({"left", rubber(200., eta), 1.});
      setup.parts.push_back({"right", rubber(300., eta), 2.});
      setup.pairs = {{"disks", {swap ? 1U : 0U}, {swap ? 0U : 1U}}};
      impact      = std::make_unique<Impact<2>>(parameters,
                                           triangulation,
                                           setup,
                                           MPI_COMM_WORLD);
      state = impact->state_in_motion(dealii::FunctionFromFunctionObjects<2>(
        {[](const Point<2> &x) { return x[0] < 0. ? 1. : -1.; },
         [](const Point<2> &) { return 0.; }}));
    }

    double
    mechanical_energy() const
    {
      return impact->system.kinetic_energy(state.velocity) +
        impact->bulk->energy(state.solution);
    }

    double
    energy() const
    {
      return mechanical_energy() +
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
      iterations += report.solver.newton_iterations;
      state = next;
      return report;
    }

    dealii::parallel::shared::Triangulation<2> triangulation;
    ImpactParameters                           parameters = on_all_ranks();
    std::unique_ptr<Impact<2>>                 impact;
    State                                      state;
    bool                                       touched    = false;
    unsigned int                               iterations = 0;
  };

  /// The terms of the balance of a step (J).
  double
  balance(const StepReport &report, const double change)
  {
    return change - report.external_work - report.imposed_work +
      report.contact_work + report.friction_work + report.viscous_dissipation +
      report.numerical_dissipation;
  }

  constexpr double       time_step = .01;
  constexpr unsigned int n_steps   = 25;
} // namespace


BOOST_AUTO_TEST_CASE(balances_close_and_momenta_are_kept)
{
  for (const std::string &treatment : all_methods())
    for (const double friction : {0., .3})
      {
        if (friction > 0. && treatment == "penalty")
          continue;
        BOOST_TEST_CONTEXT(treatment << ", mu = " << friction)
        {
          Collision        disks(treatment, friction);
          const Momenta<2> momenta(disks.impact->body,
                                   disks.impact->system.mass_matrix(),
                                   /* small strains */ false);
          const double     first  = disks.energy();
          const auto       linear = momenta.linear(disks.state.velocity);
          const auto       angular =
            momenta.angular(disks.state.solution, disks.state.velocity);
          const Momenta<2> left(disks.impact->body,
                                disks.impact->system.mass_matrix(),
                                false,
                                2,
                                0);
          const auto       left_before   = left.linear(disks.state.velocity);
          double           old           = disks.mechanical_energy();
          double           old_all       = first;
          double           friction_work = 0.;
          for (unsigned int n = 0; n < n_steps; ++n)
            {
              const StepReport report = disks.step(time_step);
              const double     now    = disks.mechanical_energy();
              BOOST_CHECK_SMALL(balance(report, now - old) / first, 1e-11);
              old = now;
              // Not by the ledger alone: a wrong sign closes it, too.
              BOOST_CHECK_GE(report.friction_work, -1e-12 * first);
              BOOST_CHECK_SMALL(report.friction_work -
                                  disks.impact->contact->friction_dissipation(),
                                1e-12 * first);
              friction_work += report.friction_work;
              const double all = disks.energy();
              if (keeps_energy(treatment))
                BOOST_CHECK_SMALL((all + friction_work - first) / first, 1e-9);
              else
                BOOST_CHECK_LE(all + report.friction_work,
                               old_all + 1e-11 * first);
              old_all = all;
            }
          BOOST_CHECK(disks.touched);
          if (friction > 0.)
            BOOST_CHECK_GT(friction_work, 1e-3 * first);
          BOOST_CHECK_SMALL(
            (momenta.linear(disks.state.velocity) - linear).norm(),
            1e-11);
          BOOST_CHECK_SMALL((momenta.angular(disks.state.solution,
                                             disks.state.velocity) -
                             angular)
                              .norm(),
                            1e-10);
          // One gives to the other.
          BOOST_CHECK_GT(
            (left.linear(disks.state.velocity) - left_before).norm(),
            .5);
        }
      }
}

namespace
{
  /// The part of residual and tangent by contact of two disks pressed into each other, at a
  /// random state with all rotations: the derivative is the quotient of differences.
  void
  check_tangent(const std::string &method,
                const double       friction,
                const std::string &scheme)
  {
    BOOST_TEST_CONTEXT(method << ", mu = " << friction << ", " << scheme)
    {
      Collision disks(method, friction, 0., .5, false, scheme);
      while (disks.state.contact_force.l2_norm() < 1.)
        disks.step(time_step);

      ContactOperator &contact = *disks.impact->contact;
      const Body<2>   &body    = disks.impact->body;
      Vector           solution(disks.state.solution);
      Vector           noise(solution), direction(solution);
      randomise(noise, 1e-3, 1);
      randomise(direction, 1., 2);
      solution.add(time_step, disks.state.velocity);
      solution += noise;
      // Into each other.
      const auto parts = body.parts_of_unknowns(2);
      Vector     along = disks.impact->uniform(Tensor<1, 2>({.01, 0.}));
      for (unsigned int i = 0; i < parts.size(); ++i)
        if (parts[i] == 0)
          local_values(solution)[i] += local_values(along)[i];
      // Mortar's tangent leaves out how the cuts move.
      check_contact_tangent(contact,
                            body,
                            disks.state,
                            scheme,
                            time_step,
                            solution,
                            direction,
                            1.,
                            method.find("mortar") == std::string::npos ? 0.
                                                                       : 1e-5);
    }
  }
} // namespace

BOOST_AUTO_TEST_CASE(tangents_are_quotients_of_differences)
{
  for (const double friction : {0., .3})
    {
      for (const std::string &method : all_methods())
        if (friction == 0. || method != "penalty")
          check_tangent(method, friction, "midpoint");
      for (const std::string method :
           {"Signorini active set", "standard normal compliance", "penalty"})
        check_tangent(method, friction, "HHT");
    }
}



// Cost of couplings, in the same collision with Signorini's condition:
// iterations, entries of the tangent, and its condition when every unknown is
// scaled so that the largest entry of its column is 1, and then every row.
// Mortar couples more, and is no worse to solve.
BOOST_AUTO_TEST_CASE(cost_of_couplings)
{
  if (dealii::Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 1)
    return;
  std::map<std::string, double> conditions, entries;
  for (const std::string coupling : {"points", "mortar", "dual mortar"})
    {
      Collision    disks("Signorini active set, " + coupling, 0.);
      unsigned int n_steps_in_contact = 0;
      while (n_steps_in_contact < 8)
        {
          disks.step(time_step);
          n_steps_in_contact += disks.state.contact_force.l2_norm() > 1.;
        }
      Impact<2>       &impact  = *disks.impact;
      const Body<2>   &body    = impact.body;
      ContactOperator &contact = *impact.contact;
      const Vector    &old     = disks.state.solution;
      contact.begin_stage({old,
                           disks.state.contact_force,
                           disks.state.mean_velocity,
                           time_step,
                           disks.state.time + time_step},
                          1.);
      Vector residual = body.make_vector();
      contact.add_residual(old, residual);
      Matrix of_bodies, matrix;
      of_bodies.reinit(body.sparsity_pattern());
      impact.system.mass_matrix().add_to(4. / (time_step * time_step),
                                         of_bodies);
      impact.bulk->add_tangent(1., old, of_bodies);
      UnitedPattern united;
      united.update(body.sparsity_pattern(), *contact.couplings());
      united.embed(of_bodies, matrix);
      contact.add_tangent(matrix);

      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(matrix.m(), matrix.n());
      for (const auto &entry : matrix)
        dense(entry.row(), entry.column()) = entry.value();
      for (Eigen::Index i = 0; i < dense.cols(); ++i)
        dense.col(i) /= dense.col(i).cwiseAbs().maxCoeff();
      for (Eigen::Index i = 0; i < dense.rows(); ++i)
        dense.row(i) /= dense.row(i).cwiseAbs().maxCoeff();
      const Eigen::VectorXd values =
        Eigen::BDCSVD<Eigen::MatrixXd>(dense).singularValues();
      conditions[coupling] = values[0] / values[values.size() - 1];
      entries[coupling]    = (dense.array() != 0.).count();
      BOOST_TEST_MESSAGE(coupling << ": " << disks.iterations
                                  << " iterations, condition "
                                  << conditions[coupling] << ", "
                                  << entries[coupling] << " entries");
    }
  for (const std::string coupling : {"mortar", "dual mortar"})
    {
      BOOST_CHECK_LT(conditions[coupling], 3. * conditions["points"]);
      BOOST_CHECK_LT(entries[coupling], 1.5 * entries["points"]);
    }
}



// Newton's method converges quadratically near the solution, and does not need
// many iterations before.
BOOST_AUTO_TEST_CASE(newton_converges_quadratically)
{
  for (const std::string treatment :
       {"persistent contact", "improved normal compliance"})
    BOOST_TEST_CONTEXT(treatment)
    {
      Collision disks(treatment, 0.);
      double    constant = 0.;
      disks.impact->system.newton_observer =
        [&](const std::vector<NewtonSolver::Iteration> &history, const auto &) {
          // The last three residuals that are not round-off.
          for (unsigned int k = 2; k + 1 < history.size(); ++k)
            {
              const double before = history[k - 1].relative_residual;
              const double now    = history[k].relative_residual;
              if (before < 1e-4 && now > 1e-13 && before > 1e-9)
                constant = std::max(constant, now / (before * before));
            }
        };
      for (unsigned int n = 0; n < n_steps; ++n)
        disks.step(time_step);
      BOOST_CHECK_LT(constant, 2000.);
      BOOST_CHECK_LE(disks.iterations, 8 * n_steps);
    }
}



// Swapping slave and master gives another discretisation of the same problem:
// on coarse disks results differ by a few per cent.
BOOST_AUTO_TEST_CASE(master_and_slave_may_be_swapped)
{
  Tensor<1, 2> velocity[2];
  for (const bool swap : {false, true})
    {
      Collision        disks("persistent contact", .3, 0., .5, swap);
      const Momenta<2> left(disks.impact->body,
                            disks.impact->system.mass_matrix(),
                            false,
                            2,
                            0);
      for (unsigned int n = 0; n < n_steps; ++n)
        disks.step(time_step);
      velocity[swap] = left.linear(disks.state.velocity);
    }
  BOOST_CHECK_LT((velocity[0] - velocity[1]).norm(), .1 * velocity[0].norm());
  BOOST_CHECK_GT((velocity[0] - velocity[1]).norm(), 1e-8);
}



namespace
{
  /// Two blocks, the upper one pressed onto the lower one and moved sideways by an
  /// imposed displacement, a traction at its side, gravity, on a roller.
  struct Press
  {
    Press(const Material<2> &material,
          const std::string &treatment,
          const double       friction,
          const std::string &mass = "consistent")
      : triangulation(MPI_COMM_WORLD)
      , parameters(parameters_of(treatment, friction))
    {
      parameters.mass = mass;
      make_rectangles(
        {{Point<2>(.3, .01), Point<2>(1.3, .51), {{6, 6}}, 0., {}},
         {Point<2>(0., -.5), Point<2>(2., 0.), {{8, 6}}, 0., {}}},
        CellShape::quadrilaterals,
        triangulation);
      ImpactSetup<2> setup{material};
      setup.parts.push_back({"upper", material, 1.});
      setup.parts.push_back({"lower", material, 2.});
      setup.pairs = {{"blocks",
                      {rectangle_side(0, Rectangle::lower)},
                      {rectangle_side(1, Rectangle::upper)}}};
      setup.imposed[rectangle_side(0, Rectangle::upper)] =
        {{{true, true}}, [](const double t, const Point<2> &) {
           return Tensor<1, 2>({2. * t * t, -4. * t * t});
         }};
      // Rollers: held across, free along.
      setup.imposed[rectangle_side(1, Rectangle::lower)] = {{{false, true}},
                                                            {}};
      setup.clamped = {rectangle_side(1, Rectangle::left)};
      setup.tractions[rectangle_side(1, Rectangle::right)] =
        [](const double t, const Point<2> &) {
          return Tensor<1, 2>({3. * t, 1.});
        };
      setup.gravity = Tensor<1, 2>({.5, -1.});
      impact        = std::make_unique<Impact<2>>(parameters,
                                           triangulation,
                                           setup,
                                           MPI_COMM_WORLD);
      state         = impact->state_of_parts();
    }

    dealii::parallel::shared::Triangulation<2> triangulation;
    ImpactParameters                           parameters = on_all_ranks();
    std::unique_ptr<Impact<2>>                 impact;
    State                                      state;
  };
} // namespace

BOOST_AUTO_TEST_CASE(balances_close_with_work_from_outside)
{
  const Viscosity viscous{Viscosity::Law::linear, 2.};
  const std::vector<std::pair<std::string, Material<2>>> materials = {
    {"linear", Material<2>(LinearElastic{200., 200.})},
    {"linear viscous", Material<2>(LinearElastic{200., 200.}, viscous)},
    {"neo-Hookean", rubber(200.)},
    {"neo-Hookean viscous", rubber(200., 2.)}};
  for (const auto &[name, material] : materials)
    for (const std::string &treatment : treatments)
      for (const double friction : {0., .3})
        for (const std::string mass : {"consistent", "redistributed"})
          {
            if (friction > 0. && treatment == "penalty")
              continue;
            // Once is enough.
            if (mass == "redistributed" && name != "neo-Hookean")
              continue;
            BOOST_TEST_CONTEXT(name << ", " << treatment
                                    << ", mu = " << friction << ", " << mass)
            {
              Press  press(material, treatment, friction, mass);
              double old = 0., largest = 0., worst = 0.;
              double imposed = 0., viscosity = 0.;
              bool   touched = false;
              for (unsigned int n = 0; n < 12; ++n)
                {
                  State            next;
                  const StepReport report =
                    press.impact->scheme->step(press.impact->system,
                                               press.state,
                                               .01,
                                               next);
                  next.time   = press.state.time + .01;
                  press.state = next;
                  touched     = touched || next.contact_force.l2_norm() > 0.;
                  const double now =
                    press.impact->system.kinetic_energy(next.velocity) +
                    press.impact->bulk->energy(next.solution);
                  largest = std::max(largest, now);
                  worst = std::max(worst, std::abs(balance(report, now - old)));
                  old   = now;
                  imposed += report.imposed_work;
                  viscosity += report.viscous_dissipation;
                  BOOST_CHECK_GE(report.friction_work, -1e-12 * largest);
                }
              BOOST_CHECK(touched);
              BOOST_CHECK_LT(worst, 1e-11 * largest);
              BOOST_CHECK_GT(imposed, .1 * largest);
              if (name.find("viscous") != std::string::npos)
                BOOST_CHECK_GT(viscosity, 1e-4 * largest);
            }
          }
}



// The displacement of the boundary is the prescribed one, and the roller rolls.
BOOST_AUTO_TEST_CASE(conditions_hold)
{
  Press press(rubber(200.), "persistent contact", .3);
  for (unsigned int n = 0; n < 5; ++n)
    {
      State next;
      press.impact->scheme->step(press.impact->system, press.state, .01, next);
      next.time   = press.state.time + .01;
      press.state = next;
    }
  const Body<2> &body = press.impact->body;
  for (unsigned int c = 0; c < 2; ++c)
    for (const auto i :
         body.boundary_displacements(rectangle_side(0, Rectangle::upper), c))
      BOOST_CHECK_CLOSE(static_cast<double>(press.state.solution(i)),
                        c == 0 ? .005 : -.01,
                        1e-10);
  double along = 0.;
  for (const auto i :
       body.boundary_displacements(rectangle_side(1, Rectangle::lower), 1))
    BOOST_TEST(press.state.solution(i) == 0.);
  for (const auto i :
       body.boundary_displacements(rectangle_side(1, Rectangle::lower), 0))
    along = std::max(along, std::abs(press.state.solution(i)));
  BOOST_TEST(dealii::Utilities::MPI::max(along, MPI_COMM_WORLD) > 1e-6);
}



namespace
{
  /// Bars of 1 mm, of which some fly at others that they touch: E = 1 GPa, rho = 1000
  /// kg/m^3, no lateral contraction, so that waves need 1 us from end to end (the
  /// bars of Norma.jl, 100 m/s).
  struct Bars
  {
    Bars(const std::string         &treatment,
         const std::vector<double> &velocities,
         const unsigned int         n_cells)
      : triangulation(MPI_COMM_WORLD)
      , parameters(parameters_of(treatment, 0.))
      , velocities(velocities)
    {
      parameters.contact.values["Augmentation"]           = 1e9;
      parameters.contact.values["Compliance coefficient"] = 1e14;
      parameters.contact.values["Penalty epsilon0"]       = 1e-10;
      std::vector<Rectangle> rectangles;
      for (unsigned int b = 0; b < velocities.size(); ++b)
        rectangles.push_back({Point<2>(b * 1e-3, 0.),
                              Point<2>((b + 1) * 1e-3, 1e-4),
                              {{n_cells, 2}},
                              0.,
                              {}});
      make_rectangles(rectangles, CellShape::quadrilaterals, triangulation);
      const Material<2> material(LinearElastic::from_young(1e9, 0.));
      ImpactSetup<2>    setup{material};
      for (unsigned int b = 0; b < velocities.size(); ++b)
        {
          setup.parts.push_back({"bar " + std::to_string(b),
                                 material,
                                 1000.,
                                 Tensor<1, 2>({velocities[b], 0.})});
          if (b > 0)
            setup.pairs.push_back({"contact " + std::to_string(b),
                                   {rectangle_side(b - 1, Rectangle::right)},
                                   {rectangle_side(b, Rectangle::left)}});
        }
      impact = std::make_unique<Impact<2>>(parameters,
                                           triangulation,
                                           setup,
                                           MPI_COMM_WORLD);
      state  = impact->state_of_parts();
    }

    /// As the time loop does it: in halves, if Newton's method fails.
    void
    step(const double time_step, const unsigned int n_halvings = 0)
    {
      State next;
      try
        {
          impact->scheme->step(impact->system, state, time_step, next);
        }
      catch (const NewtonFailure &)
        {
          if (n_halvings == 4)
            throw;
          step(.5 * time_step, n_halvings + 1);
          step(.5 * time_step, n_halvings + 1);
          return;
        }
      next.time = state.time + time_step;
      state     = next;
    }

    /// Mean velocity of a bar (m/s).
    double
    velocity(const unsigned int bar) const
    {
      const Momenta<2> momenta(impact->body,
                               impact->system.mass_matrix(),
                               true,
                               velocities.size(),
                               bar);
      return momenta.linear(state.velocity)[0] / 1e-4;
    }

    /// J/m
    double
    kinetic_energy() const
    {
      return impact->system.kinetic_energy(state.velocity);
    }

    dealii::parallel::shared::Triangulation<2> triangulation;
    ImpactParameters                           parameters = on_all_ranks();
    const std::vector<double>                  velocities;
    std::unique_ptr<Impact<2>>                 impact;
    State                                      state;
  };

  /// Mean error of kinetic energy until the bars have parted, relative to what it was:
  /// it falls linearly to zero in 1 us and comes back in another one.
  double
  error_of_two_bars(const std::string &treatment, const unsigned int n_cells)
  {
    Bars               bars(treatment, {100., -100.}, n_cells);
    const double       first     = bars.kinetic_energy();
    const double       time_step = 2e-7 / n_cells;
    const unsigned int n   = static_cast<unsigned int>(2.2e-6 / time_step);
    double             sum = 0.;
    for (unsigned int k = 0; k < n; ++k)
      {
        bars.step(time_step);
        const double part = bars.state.time / 1e-6;
        sum += std::abs(bars.kinetic_energy() / first -
                        (part < 1. ? 1. - part : std::min(1., part - 1.)));
      }
    // 1000 kg/m^3 1 mm 0.1 mm (100 m/s)^2: 5e-5 J each for a depth of 0.1 mm.
    BOOST_TEST(first == 1., boost::test_tools::tolerance(1e-12));
    return sum / n;
  }
} // namespace

BOOST_AUTO_TEST_CASE(bars_exchange_their_velocities)
{
  for (const std::string &treatment : treatments)
    {
      const double coarse = error_of_two_bars(treatment, 10);
      const double fine   = error_of_two_bars(treatment, 20);
      BOOST_TEST_MESSAGE("two bars, " << treatment << ": error " << coarse
                                      << ", " << fine);
      BOOST_TEST(fine < .75 * coarse, treatment);
      BOOST_TEST(fine < .04, treatment);
    }
  // At rest in the middle, with a pressure of rho c v = 1e8 Pa over 0.1 mm until then;
  // at the end with exchanged velocities. Waves of short length stay behind.
  Bars   bars("persistent contact", {100., -100.}, 20);
  double mean_force = 0.;
  for (unsigned int n = 0; n < 100; ++n)
    {
      bars.step(1e-8);
      mean_force += .01 *
        bars.impact->contact
          ->summary(
            {bars.state.solution, bars.state.contact_force, bars.state.time})
          .at(rectangle_side(0, Rectangle::right))
          .force;
    }
  BOOST_CHECK_SMALL(bars.velocity(0), 5.);
  BOOST_CHECK_LT(bars.kinetic_energy(), .06);
  BOOST_CHECK_CLOSE(mean_force, 1e4, 5.);
  for (unsigned int n = 0; n < 120; ++n)
    bars.step(1e-8);
  BOOST_CHECK_SMALL(bars.velocity(0) + 100., 4.);
  BOOST_CHECK_SMALL(bars.velocity(1) - 100., 4.);
}

// The energy of each contact of a cradle is the work of its forces on the faces
// of its two bars: a spring stores something, first in one contact and then in
// the other.
BOOST_AUTO_TEST_CASE(each_contact_has_its_work)
{
  Bars   bars("improved normal compliance", {100., 0., 0.}, 10);
  double stored[2] = {0., 0.};
  for (unsigned int n = 0; n < 60; ++n)
    {
      const State before = bars.state;
      bars.step(2e-8);
      for (unsigned int b = 0; b < 2; ++b)
        {
          double work = 0.;
          for (const auto id : {rectangle_side(b, Rectangle::right),
                                rectangle_side(b + 1, Rectangle::left)})
            for (unsigned int c = 0; c < 2; ++c)
              for (const auto i :
                   bars.impact->body.boundary_displacements(id, c))
                work += bars.state.contact_force(i) *
                  (bars.state.solution(i) - before.solution(i));
          work = dealii::Utilities::MPI::sum(work, MPI_COMM_WORLD);
          const ContactWork told = bars.impact->contact->contact_work(
            rectangle_side(b, Rectangle::right));
          BOOST_CHECK_SMALL(told.normal - work, 1e-12);
          BOOST_TEST(told.friction == 0.);
          stored[b] = std::max(stored[b], work);
        }
      // The wave needs 1 us to the second contact.
      if (n < 40)
        BOOST_CHECK_LT(stored[1], .02 * stored[0]);
    }
  BOOST_TEST_MESSAGE("largest work in a step: " << stored[0] << ", "
                                                << stored[1] << " J/m");
  BOOST_CHECK_GT(stored[1], .1 * stored[0]);
}

// Three bars: the outer two meet the one between them at the same time and leave it at
// rest after 3 us; and a cradle, in which the last one takes it all.
BOOST_AUTO_TEST_CASE(three_bars_and_a_cradle)
{
  for (const std::string treatment :
       {"persistent contact", "improved normal compliance"})
    {
      double errors[2][2];
      for (const unsigned int fine : {0U, 1U})
        for (const unsigned int cradle : {0U, 1U})
          {
            const std::vector<double> before  = cradle
               ? std::vector<double>{100., 0., 0.}
               : std::vector<double>{100., 0., -100.};
            const unsigned int        n_cells = fine ? 20 : 10;
            Bars                      bars(treatment, before, n_cells);
            for (unsigned int n = 0; n < 17 * n_cells; ++n)
              bars.step(2e-7 / n_cells);
            double error = 0.;
            for (unsigned int b = 0; b < 3; ++b)
              error =
                std::max(error, std::abs(bars.velocity(b) - before[2 - b]));
            errors[cradle][fine] = error;
          }
      for (const unsigned int cradle : {0U, 1U})
        {
          BOOST_TEST_MESSAGE((cradle ? "cradle" : "three bars")
                             << ", " << treatment << ": error of velocities "
                             << errors[cradle][0] << ", " << errors[cradle][1]
                             << " m/s");
          BOOST_TEST(errors[cradle][1] < 8.);
          BOOST_TEST(errors[cradle][1] < errors[cradle][0]);
        }
    }
}



// Each part has its own material, by hand: two plates of different stiffness
// and density under the same uniform strain.
BOOST_AUTO_TEST_CASE(parts_have_data_of_their_own)
{
  constexpr double strain = .01;
  for (const bool linear : {true, false})
    {
      dealii::parallel::shared::Triangulation<2> triangulation(MPI_COMM_WORLD);
      make_rectangles({{Point<2>(0., 0.), Point<2>(2., 1.), {{3, 2}}, 0., {}},
                       {Point<2>(5., 0.), Point<2>(6., 1.), {{2, 3}}, 0., {}}},
                      CellShape::triangles,
                      triangulation);
      const auto material = [&](const double stiffness) {
        return linear ? Material<2>(LinearElastic{0., stiffness})
                      : rubber(stiffness);
      };
      ImpactSetup<2> setup{material(1.)};
      setup.parts.push_back(
        {"soft", material(200.), 3., Tensor<1, 2>({1., 2.})});
      setup.parts.push_back(
        {"stiff", material(500.), 7., Tensor<1, 2>({-4., 0.})});
      setup.pairs = {{"gap",
                      {rectangle_side(0, Rectangle::right)},
                      {rectangle_side(1, Rectangle::left)}}};
      Impact<2>   impact(parameters_of("persistent contact", 0.),
                       triangulation,
                       setup,
                       MPI_COMM_WORLD);
      const State state = impact.state_of_parts();
      for (const unsigned int part : {0U, 1U})
        {
          const Momenta<2> momenta(impact.body,
                                   impact.system.mass_matrix(),
                                   linear,
                                   2,
                                   part);
          const auto       momentum = momenta.linear(state.velocity);
          BOOST_CHECK_CLOSE(momentum[0], part == 0 ? 6. : -28., 1e-10);
          BOOST_CHECK_CLOSE(momentum[1], part == 0 ? 12. : 0., 1e-10);
        }
      BOOST_CHECK_CLOSE(impact.system.kinetic_energy(state.velocity),
                        .5 * (6. * 5. + 7. * 16.),
                        1e-10);

      Vector stretched;
      impact.body.interpolate(dealii::FunctionFromFunctionObjects<2>(
                                {[](const Point<2> &x) {
                                   return strain * x[0];
                                 },
                                 [](const Point<2> &) { return 0.; }}),
                              stretched);
      const auto   energies = impact.bulk->energies_of_parts(stretched);
      const double total    = impact.bulk->energy(stretched);
      BOOST_CHECK_CLOSE(energies[0] + energies[1], total, 1e-10);
      // mu strain^2 times the area; and any law of the same form in proportion.
      if (linear)
        {
          BOOST_CHECK_CLOSE(energies[0], 200. * strain * strain * 2., 1e-9);
          BOOST_CHECK_CLOSE(energies[1], 500. * strain * strain, 1e-9);
        }
      BOOST_CHECK_CLOSE(energies[1] / energies[0], 1.25, 1e-8);

      // The load of 1 Pa on a side of 1 m, in one direction.
      Vector load = impact.body.make_vector();
      boundary_load<2>(impact.body,
                       rectangle_side(0, Rectangle::upper),
                       [](const double, const Point<2> &) {
                         return Tensor<1, 2>({0., 1.});
                       })(/* time */ 0., load);
      BOOST_CHECK_CLOSE(load * impact.uniform(Tensor<1, 2>({0., 1.})),
                        2.,
                        1e-10);
      BOOST_CHECK_SMALL(load * impact.uniform(Tensor<1, 2>({1., 0.})), 1e-14);
    }
}



// Input that is refused before any time is spent.
BOOST_AUTO_TEST_CASE(bad_input)
{
  const auto throws = [](const std::string           &text,
                         const std::function<void()> &action) {
    BOOST_CHECK_EXCEPTION(action(), InputError, [&](const InputError &error) {
      const bool found =
        std::string(error.what()).find(text) != std::string::npos;
      if (!found)
        BOOST_TEST_MESSAGE(error.what());
      return found;
    });
  };
  const auto two_blocks = [](const double                     gap,
                             const Rectangle::Side            slave_side,
                             const dealii::types::boundary_id master,
                             const std::string               &treatment) {
    dealii::parallel::shared::Triangulation<2> triangulation(MPI_COMM_WORLD);
    make_rectangles({{Point<2>(0., gap), Point<2>(1., 1.), {{2, 2}}, 0., {}},
                     {Point<2>(0., -1.), Point<2>(1., 0.), {{2, 2}}, 0., {}}},
                    CellShape::quadrilaterals,
                    triangulation);
    ImpactSetup<2> setup{rubber(200.)};
    setup.parts.push_back({"upper", rubber(200.), 1.});
    setup.parts.push_back({"lower", rubber(200.), 1.});
    setup.pairs = {{"blocks", {rectangle_side(0, slave_side)}, {master}}};
    Impact<2> impact(parameters_of(treatment, 0.),
                     triangulation,
                     setup,
                     MPI_COMM_WORLD);
    impact.state_of_parts();
  };
  const auto upper = rectangle_side(1, Rectangle::upper);
  BOOST_CHECK_NO_THROW(
    two_blocks(0., Rectangle::lower, upper, "persistent contact"));
  throws("overlap", [&]() {
    two_blocks(-.1, Rectangle::lower, upper, "persistent contact");
  });
  throws("wrong way", [&]() {
    two_blocks(.1, Rectangle::upper, upper, "persistent contact");
  });
  throws("no boundary with the id 77",
         [&]() { two_blocks(.1, Rectangle::lower, 77, "persistent contact"); });
  throws("rigid obstacles", [&]() {
    two_blocks(.1, Rectangle::lower, upper, "Signorini multipliers");
  });
}

BOOST_AUTO_TEST_SUITE_END()
