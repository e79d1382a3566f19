// SPDX-License-Identifier: LGPL-2.1-or-later

// Pointwise contact laws against automatic differentiation (Sacado), in open,
// closed and grazing states, and against their own potentials.

#include <contact/laws/augmented_lagrangian.h>
#include <contact/laws/nitsche.h>
#include <contact/laws/nitsche_two_point.h>
#include <contact/laws/penalty.h>
#include <contact/laws/signorini_multiplier.h>

#include <Sacado.hpp>
#include <boost/test/unit_test.hpp>

#include <cmath>
#include <vector>

using namespace Ricochet;
using AD = Sacado::Fad::DFad<double>;

namespace
{
  constexpr double cell_diameter = .25;

  // Open, closed, nearly grazing from both sides, with and without stress and
  // multiplier. None sits on a kink of any of the laws.
  const std::vector<ContactPointState<>> states = {{.3, 0., 0.},
                                                   {.3, .5, .2},
                                                   {-.02, .1, .1},
                                                   {-.02, -.4, -.3},
                                                   {1e-9, 1e-3, 1e-3},
                                                   {-1e-9, 1e-3, -1e-3},
                                                   {1e-3, .021, .019},
                                                   {1e-3, .019, .021},
                                                   {0., 2., 3.}};

  template <typename Law>
  void
  compare_tangent(const Law &law)
  {
    for (const auto &old_state : states)
      for (const auto &state : states)
        {
          ContactPointState<AD> ad_state;
          ad_state.gap             = AD(3, 0, state.gap);
          ad_state.stress_pressure = AD(3, 1, state.stress_pressure);
          ad_state.multiplier      = AD(3, 2, state.multiplier);
          const auto ad_force =
            law.template force<AD>(ad_state, old_state, cell_diameter);
          const auto tangent = law.tangent(state, old_state, cell_diameter);
          const AD   rows[3] = {ad_force.gap,
                                ad_force.stress_pressure,
                                ad_force.multiplier};
          for (unsigned int r = 0; r < 3; ++r)
            for (unsigned int c = 0; c < 3; ++c)
              {
                const double derivative =
                  rows[r].size() == 0 ? 0. : rows[r].dx(c);
                BOOST_CHECK_SMALL(derivative - tangent[r][c],
                                  1e-12 * (1. + std::abs(derivative)));
              }
        }
  }

  /// force() must be the derivative of potential().
  template <typename Law>
  void
  compare_potential(const Law &law)
  {
    const double eps = 1e-6;
    for (const auto &state : states)
      {
        const auto force =
          law.template force<double>(state, state, cell_diameter);
        const auto central_difference =
          [&](double ContactPointState<>::*entry) {
            auto plus = state, minus = state;
            plus.*entry += eps;
            minus.*entry -= eps;
            return (law.potential(plus, cell_diameter) -
                    law.potential(minus, cell_diameter)) /
              (2. * eps);
          };
        // Kinks of the force within eps smear it by stiffness times eps.
        const double tolerance = 1e-4;
        BOOST_CHECK_SMALL(central_difference(&ContactPointState<>::gap) -
                            force.gap,
                          tolerance);
        BOOST_CHECK_SMALL(central_difference(
                            &ContactPointState<>::stress_pressure) -
                            force.stress_pressure,
                          tolerance);
        BOOST_CHECK_SMALL(central_difference(&ContactPointState<>::multiplier) -
                            force.multiplier,
                          tolerance);
      }
  }

  /// Work of a two-point law over a step less what its potential gains.
  double
  excess_work(const NitscheTwoPoint     &law,
              const ContactPointState<> &old_state,
              const ContactPointState<> &new_state)
  {
    const auto force = law.force<double>(new_state, old_state, cell_diameter);
    return force.gap * (new_state.gap - old_state.gap) +
      force.stress_pressure *
      (new_state.stress_pressure - old_state.stress_pressure) -
      (law.potential(new_state, cell_diameter) -
       law.potential(old_state, cell_diameter));
  }
} // namespace


BOOST_AUTO_TEST_SUITE(contact_laws)

BOOST_AUTO_TEST_CASE(tangents_are_derivatives)
{
  for (const double theta : {1., -1., 0.})
    {
      compare_tangent(Nitsche{5., theta});
      compare_tangent(
        NitscheTwoPoint{5., theta, NitscheTwoPoint::Evaluation::hybrid});
      compare_tangent(
        NitscheTwoPoint{5., theta, NitscheTwoPoint::Evaluation::end_of_step});
    }
  compare_tangent(Penalty{.2});
  compare_tangent(ProximalAugmentedLagrangian{5.});
  compare_tangent(SignoriniMultiplier{5.});
}

BOOST_AUTO_TEST_CASE(forces_derive_from_potentials)
{
  compare_potential(Nitsche{5., 1.});
  compare_potential(Penalty{.2});
  compare_potential(ProximalAugmentedLagrangian{5.});
  // With both ends of the step the same, a two-point law is the derivative.
  compare_potential(
    NitscheTwoPoint{5., 1., NitscheTwoPoint::Evaluation::hybrid});
  compare_potential(
    NitscheTwoPoint{5., 1., NitscheTwoPoint::Evaluation::end_of_step});
}

// In the kink itself (grazing contact, q = 0) the tangent must be one of the
// two one-sided derivatives.
BOOST_AUTO_TEST_CASE(grazing_tangent_is_one_sided)
{
  const Nitsche             law{5., 1.};
  const ContactPointState<> grazing{0., 0., 0.};
  const auto   tangent = law.tangent(grazing, grazing, cell_diameter);
  const double gamma   = law.stiffness(cell_diameter);
  BOOST_CHECK(tangent[0][0] == 0. || tangent[0][0] == gamma);
  BOOST_CHECK_EQUAL(heaviside(0.), .5);
}

// The proximal augmented Lagrangian is Nitsche's method with the multiplier in
// the place of the stress (paper C, remark after (18)).
BOOST_AUTO_TEST_CASE(augmented_lagrangian_is_nitsche_with_multiplier)
{
  const Nitsche                     nitsche{5., 1.};
  const ProximalAugmentedLagrangian lagrangian{5.};
  for (const auto &state : states)
    {
      ContactPointState<> exchanged = state;
      exchanged.stress_pressure     = state.multiplier;
      const auto a = nitsche.force<double>(exchanged, state, cell_diameter);
      const auto b = lagrangian.force<double>(state, state, cell_diameter);
      BOOST_CHECK_SMALL(a.gap - b.gap, 1e-14);
      BOOST_CHECK_SMALL(a.stress_pressure - b.multiplier, 1e-14);
    }
}

// Over any step, the symmetric two-point laws take at least as much work as
// their potential gains: the modified energy cannot grow.
BOOST_AUTO_TEST_CASE(two_point_laws_dissipate)
{
  for (const auto evaluation : {NitscheTwoPoint::Evaluation::hybrid,
                                NitscheTwoPoint::Evaluation::end_of_step})
    {
      const NitscheTwoPoint law{5., 1., evaluation};
      bool                  dissipates_somewhere = false;
      for (const auto &old_state : states)
        for (const auto &new_state : states)
          {
            const double excess = excess_work(law, old_state, new_state);
            BOOST_CHECK_GE(excess, -1e-14);
            dissipates_somewhere = dissipates_somewhere || excess > 1e-6;
          }
      BOOST_CHECK(dissipates_somewhere);
    }
}

BOOST_AUTO_TEST_SUITE_END()
