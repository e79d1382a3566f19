// SPDX-License-Identifier: LGPL-2.1-or-later

// Impacts of deformable bodies on each other, coarse: two disks, a block on a strip,
// bars. The balance of energy closes for every treatment, what should be kept is
// kept, linear and angular momentum of both together too, friction only dissipates;
// assembled tangents are those of differences; a step is the same on two ranks.

#include "meshes.h"

#include <base/exceptions.h>
#include <materials/laws/neo_hookean.h>
#include <output/momenta.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <boost/test/unit_test.hpp>

using namespace Ricochet;
using dealii::Point;
using dealii::Tensor;

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

  bool
  keeps_energy(const std::string &treatment)
  {
    return treatment == "persistent contact" ||
      treatment == "Ayyad-Barboteu two-step" ||
      treatment == "improved normal compliance" ||
      treatment == "Hauret-Le Tallec";
  }

  ImpactParameters
  parameters_of(const std::string &treatment, const double friction)
  {
    ImpactParameters parameters;
    parameters.scheme.name                    = "midpoint";
    parameters.contact.treatment              = treatment;
    parameters.contact.compliance_coefficient = 2e4;
    parameters.contact.compliance_exponent    = 2.;
    parameters.contact.penalty_epsilon_0      = 1e-4;
    parameters.contact.augmentation           = 500.;
    parameters.contact.friction_coefficient   = friction;
    parameters.contact.tangential_compliance  = 300.;
    return parameters;
  }

  /// Two disks that meet off their centres.
  struct Collision
  {
    Collision(const std::string &treatment,
              const double       friction,
              const double       eta    = 0.,
              const double       offset = .5,
              const bool         swap   = false)
      : triangulation(MPI_COMM_WORLD)
      , parameters(parameters_of(treatment, friction))
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
      iterations += report.newton_iterations;
      state = next;
      return report;
    }

    dealii::parallel::shared::Triangulation<2> triangulation;
    ImpactParameters                           parameters;
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

BOOST_AUTO_TEST_SUITE(pair_contact)

BOOST_AUTO_TEST_CASE(balances_close_and_momenta_are_kept)
{
  for (const std::string &treatment : treatments)
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

BOOST_AUTO_TEST_SUITE_END()
