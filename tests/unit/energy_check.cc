// SPDX-License-Identifier: LGPL-2.1-or-later
// The check of the balance and of the promises of contacts, on rows that were
// made by hand.

#include <contact/treatments/contact_treatment.h>
#include <output/energy_check.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <limits>

using namespace Ricochet;

namespace
{
  using Kind = EnergyPromise::Kind;

  EnergyCheck
  check_of(const Kind kind, const bool obstacles_move = false)
  {
    const EnergyPromise promise{kind, "of a reason"};
    return {promise, {{"joint", promise}}, obstacles_move};
  }

  /// A row with kinetic energy 10 J less the energy stored and dissipated by
  /// contact.
  EnergyCheck::Terms
  row(const double potential, const double gain)
  {
    EnergyCheck::Terms terms;
    terms.kinetic       = 10. - potential + gain;
    terms.potential     = potential;
    terms.contact_work  = potential - gain;
    terms.contact_gains = {gain};
    return terms;
  }
} // namespace

BOOST_AUTO_TEST_SUITE(energy_check)

BOOST_AUTO_TEST_CASE(what_is_kept_is_kept)
{
  EnergyCheck check = check_of(Kind::keeps);
  check.add(row(0., 0.));
  const auto values = check.add(row(4., 0.));
  BOOST_TEST(values.total == 10.);
  BOOST_TEST(values.promise_residual == 0.);
  check.add(row(0., 0.));
  BOOST_TEST(!check.is_open());
}

BOOST_AUTO_TEST_CASE(a_gain_breaks_a_promise_once)
{
  for (const Kind kind : {Kind::keeps, Kind::never_gains})
    {
      EnergyCheck check = check_of(kind);
      check.add(row(0., 0.));
      BOOST_TEST(!check.add(row(4., 5e-9)).breaks_promise);
      BOOST_TEST(!check.is_open());
      const auto values = check.add(row(4., 1e-7));
      BOOST_TEST(values.breaks_promise);
      // Scale: 10 J and 4 J stored, and 4 J of work.
      BOOST_TEST(std::abs(values.promise_residual - 1e-7 / 14.) < 1e-14);
      BOOST_TEST(!check.add(row(4., 2e-7)).breaks_promise);
      BOOST_TEST(check.is_open());
      BOOST_TEST(check.worst_contact()->name == "joint");
      BOOST_TEST(check.verdict().back().find("THE PROMISE IS BROKEN") !=
                 std::string::npos);
    }
}

BOOST_AUTO_TEST_CASE(a_loss_breaks_the_promise_to_keep_only)
{
  EnergyCheck keeps = check_of(Kind::keeps),
              falls = check_of(Kind::never_gains);
  for (EnergyCheck *check : {&keeps, &falls})
    {
      check->add(row(0., 0.));
      check->add(row(0., -1e-3));
    }
  BOOST_TEST(keeps.is_open());
  BOOST_TEST(!falls.is_open());
  // A rise after a loss is a gain.
  falls.add(row(0., -5e-4));
  BOOST_TEST(falls.is_open());
}

BOOST_AUTO_TEST_CASE(a_gain_of_one_contact_is_seen_behind_the_loss_of_another)
{
  const EnergyPromise promise{Kind::never_gains, "of a reason"};
  EnergyCheck         check(promise, {{"a", promise}, {"b", promise}}, false);
  EnergyCheck::Terms  terms;
  terms.kinetic       = 10.;
  terms.contact_gains = {0., 0.};
  check.add(terms);
  terms.kinetic -= 1.;
  terms.contact_work  = 1.;
  terms.contact_gains = {-1.5, .5};
  BOOST_TEST(check.add(terms).breaks_promise);
  BOOST_TEST(check.worst_contact()->name == "b");
}

BOOST_AUTO_TEST_CASE(friction_and_viscosity_only_take)
{
  for (const auto term : {&EnergyCheck::Terms::friction_work,
                          &EnergyCheck::Terms::viscous_dissipation})
    {
      EnergyCheck        check = check_of(Kind::never_gains);
      EnergyCheck::Terms terms = row(0., 0.);
      check.add(terms);
      terms.*term = 1.;
      terms.kinetic -= 1.;
      check.add(terms);
      BOOST_TEST(!check.is_open());
      // The total is the same, but it was given back.
      terms.*term = .5;
      terms.kinetic += .5;
      check.add(terms);
      BOOST_TEST(check.is_open());
    }
}

BOOST_AUTO_TEST_CASE(works_from_outside_are_no_gain)
{
  EnergyCheck        check = check_of(Kind::keeps);
  EnergyCheck::Terms terms = row(0., 0.);
  check.add(terms);
  terms.external_work = 3.;
  terms.imposed_work  = 4.;
  terms.obstacle_work = 2.;
  terms.kinetic += 9.;
  BOOST_TEST(check.add(terms).total == 10.);
  // As above for a moving obstacle, whose work is the rest of contact work and
  // potential.
  EnergyCheck moves = check_of(Kind::keeps, true);
  terms             = row(0., 0.);
  moves.add(terms);
  terms.contact_work = -5.;
  terms.potential    = 1.;
  terms.kinetic += 5.;
  BOOST_TEST(moves.add(terms).total == 10.);
  BOOST_TEST(!moves.is_open());
}

BOOST_AUTO_TEST_CASE(round_off_does_not_open_a_balance)
{
  EnergyCheck        check = check_of(Kind::keeps);
  EnergyCheck::Terms terms = row(0., 0.);
  terms.balance            = 5e-8;
  terms.round_off          = 6e-8;
  check.add(terms);
  BOOST_TEST(!check.is_open());
  terms.balance = 2e-7;
  check.add(terms);
  BOOST_TEST(check.is_open());
  BOOST_TEST(check.verdict().front().find("DOES NOT CLOSE") !=
             std::string::npos);
}

BOOST_AUTO_TEST_CASE(what_is_no_number_closes_nothing)
{
  EnergyCheck        check = check_of(Kind::keeps);
  EnergyCheck::Terms terms = row(0., 0.);
  terms.balance            = std::numeric_limits<double>::quiet_NaN();
  check.add(terms);
  BOOST_TEST(check.is_open());
}

BOOST_AUTO_TEST_CASE(without_a_promise_the_rise_is_told)
{
  EnergyCheck check = check_of(Kind::none);
  check.add(row(0., 0.));
  const auto values = check.add(row(0., 2.));
  BOOST_TEST(!values.breaks_promise);
  BOOST_TEST(std::abs(values.promise_residual - 2. / 14.) < 1e-14);
  BOOST_TEST(!check.is_open());
  BOOST_TEST(check.verdict().back().find("of a reason") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(the_weaker_promise_is_that_of_a_sum)
{
  const EnergyPromise keeps{Kind::keeps, "a"}, falls{Kind::never_gains, "b"},
    none{Kind::none, "c"};
  BOOST_TEST(keeps.and_also(falls).reason == "b");
  BOOST_TEST(falls.and_also(keeps).reason == "b");
  BOOST_TEST(falls.and_also(none).reason == "c");
  BOOST_TEST(keeps.and_also(keeps).reason == "a");
}

BOOST_AUTO_TEST_CASE(promises_depend_on_scheme_variant_and_coupling)
{
  ContactParameters parameters;
  const auto        kind = [&](const std::string &scheme,
                        const unsigned int mortar_dim = 0) {
    return energy_promise(parameters, scheme_traits(scheme), mortar_dim).kind;
  };
  parameters.treatment = "improved normal compliance";
  BOOST_TEST((kind("midpoint") == Kind::keeps));
  BOOST_TEST((kind("midpoint", 2) == Kind::keeps));
  BOOST_TEST((kind("midpoint", 3) == Kind::none));
  parameters.treatment = "Signorini active set";
  BOOST_TEST((kind("midpoint", 3) == Kind::never_gains));
  BOOST_TEST((kind("Crank-Nicolson") == Kind::none));
  parameters.treatment = "Nitsche-hybrid";
  BOOST_TEST((kind("midpoint") == Kind::never_gains));
  parameters.values["Nitsche theta"] = -1.;
  BOOST_TEST((kind("midpoint") == Kind::none));
  parameters.treatment = "standard normal compliance at midpoint";
  BOOST_TEST((kind("midpoint") == Kind::none));
}

BOOST_AUTO_TEST_SUITE_END()
