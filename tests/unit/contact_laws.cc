// SPDX-License-Identifier: LGPL-2.1-or-later

// Pointwise contact laws against automatic differentiation (Sacado), in open,
// closed and grazing states, and against their own potentials.

#include <contact/laws/coulomb_friction.h>
#include <contact/laws/regularised_friction.h>
#include <contact/laws/augmented_lagrangian.h>
#include <contact/laws/closing.h>
#include <contact/laws/frictional_constraint.h>
#include <contact/laws/nitsche.h>
#include <contact/laws/nitsche_two_point.h>
#include <contact/laws/normal_compliance.h>
#include <contact/laws/penalty.h>
#include <contact/laws/signorini_multiplier.h>

#include <Sacado.hpp>
#include <boost/test/unit_test.hpp>

#include <array>
#include <cmath>
#include <vector>

using namespace Ricochet;
using AD = Sacado::Fad::DFad<double>;

BOOST_AUTO_TEST_SUITE(contact_laws)

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

  /// Work of a two-point law over a step less the increase of its potential.
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
  for (const double alpha : {2., 2.5, 3., 4.})
    {
      const CompliancePotential compliance{7., alpha};
      compare_tangent(StandardNormalCompliance{compliance});
      compare_tangent(MidpointNormalCompliance{{compliance}});
      compare_tangent(ImprovedNormalCompliance{{compliance}});
      compare_tangent(HauretLeTallec{{compliance}});
    }
}

BOOST_AUTO_TEST_CASE(forces_derive_from_potentials)
{
  compare_potential(Nitsche{5., 1.});
  compare_potential(Penalty{.2});
  compare_potential(ProximalAugmentedLagrangian{5.});
  compare_potential(StandardNormalCompliance{{7., 2.5}});
  // With both ends of the step the same, a two-point law is the derivative.
  compare_potential(
    NitscheTwoPoint{5., 1., NitscheTwoPoint::Evaluation::hybrid});
  compare_potential(
    NitscheTwoPoint{5., 1., NitscheTwoPoint::Evaluation::end_of_step});
  compare_potential(ImprovedNormalCompliance{{{7., 3.}}});
}

// The work of the improved normal compliance over a step is the difference of
// its potential, whether the step presses, releases, enters or leaves: a point
// counts when either end penetrates (Algorithm 2 of paper A looks at the end
// only, which loses the release).
BOOST_AUTO_TEST_CASE(improved_compliance_is_a_discrete_derivative)
{
  for (const double alpha : {2., 2.5, 3., 5.})
    {
      const CompliancePotential compliance{7., alpha};
      for (const double old_value : {-.3, -1e-9, 0., 1e-9, .02, .4})
        for (const double new_value :
             {-.3, -1e-9, 0., 1e-9, .02, .02 * (1. + 1e-5), .4, .41})
          {
            const double pressure =
              compliance.discrete_derivative(old_value, new_value);
            BOOST_CHECK_GE(pressure, 0.);
            BOOST_CHECK_EQUAL(pressure > 0., old_value > 0. || new_value > 0.);
            const double potential_difference =
              compliance.value(new_value) - compliance.value(old_value);
            BOOST_CHECK_SMALL(pressure * (new_value - old_value) -
                                potential_difference,
                              1e-15 * (1. + compliance.value(.4)));
          }
    }
}

// Where both ends come together, value and derivative pass from the quotient to
// its series without a jump, and reach the limits.
BOOST_AUTO_TEST_CASE(improved_compliance_is_continuous)
{
  for (const double alpha : {2., 2.5, 3., 5.})
    for (const double old_value : {1e-6, .02, 3.})
      {
        const CompliancePotential compliance{7., alpha};
        const double stiffness = compliance.second_derivative(old_value);
        for (const double sign : {-1., 1.})
          {
            const double outside = old_value * (1. + sign * 1.0000001e-3);
            const double inside  = old_value * (1. + sign * .9999999e-3);
            BOOST_CHECK_SMALL(
              compliance.discrete_derivative(old_value, outside) -
                compliance.discrete_derivative(old_value, inside),
              stiffness * old_value * 2e-10);
            BOOST_CHECK_SMALL(
              compliance.discrete_derivative_tangent(old_value, outside) -
                compliance.discrete_derivative_tangent(old_value, inside),
              stiffness * 1e-9);
          }
        BOOST_CHECK_CLOSE(compliance.discrete_derivative(old_value, old_value),
                          compliance.derivative(old_value),
                          1e-12);
        BOOST_CHECK_CLOSE(compliance.discrete_derivative_tangent(old_value,
                                                                 old_value),
                          .5 * stiffness,
                          1e-12);
      }
}

namespace
{
  /// A law whose limit falls with the slip speed.
  struct WeakeningFriction
  {
    template <typename Number>
    Number
    limit(const Number &pressure, const Number &slip_speed) const
    {
      return Number(.3 * pressure * (1. + 1. / (1. + slip_speed)) / 2.);
    }
  };

  template <typename Law>
  void
  compare_friction(const Law &law, const double at_rest)
  {
    const double              c_tau = 2.;
    const RegularisedFriction friction(
      std::make_shared<FrictionLawImplementation<Law>>(law),
      c_tau);
    const dealii::Tensor<1, 3> normal({0., .6, .8});
    const dealii::Tensor<2, 3> plane =
      dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) -
      outer_product(normal, normal);
    RegularisedFriction::Stick stick = friction.creep();
    stick.at_rest = at_rest * (plane * dealii::Tensor<1, 3>({.3, 1., 0.}));
    for (const double pressure : {1e-6, .5, 4.})
      for (const double size : {0., 1e-9, .1, 3.})
        {
          const dealii::Tensor<1, 3> velocity({size, -.4 * size, .7 * size});
          const dealii::Tensor<1, 3> slip = plane * velocity;
          dealii::Tensor<2, 3>       with_slip_rate;
          dealii::Tensor<1, 3>       with_pressure;
          // The branch that the slip rate itself chooses.
          const auto branch =
            friction.choose_branch(stick, pressure, slip, stick(slip));
          friction.derivatives(branch,
                               pressure,
                               slip,
                               plane,
                               with_slip_rate,
                               with_pressure);
          const auto traction = friction.traction(stick, pressure, slip);
          BOOST_CHECK_SMALL(
            (friction.traction_on(branch, pressure, slip) - traction).norm(),
            1e-14);
          if (at_rest == 0.)
            BOOST_CHECK_GE(traction * slip, 0.);
          BOOST_CHECK_LE(traction.norm(),
                         law.limit(pressure, slip.norm()) * (1. + 1e-12));
          // At rest the traction is zero by definition; its derivative is that of
          // sticking.
          if (size == 0.)
            continue;

          // The definition, differentiated automatically.
          dealii::Tensor<1, 3, AD> ad_slip;
          for (unsigned int c = 0; c < 3; ++c)
            for (unsigned int d = 0; d < 3; ++d)
              ad_slip[c] += plane[c][d] * AD(4, d, velocity[d]);
          const AD speed =
            sqrt(ad_slip[0] * ad_slip[0] + ad_slip[1] * ad_slip[1] +
                 ad_slip[2] * ad_slip[2]);
          const AD limit = law.template limit<AD>(AD(4, 3, pressure), speed);
          dealii::Tensor<1, 3, AD> sticking;
          for (unsigned int c = 0; c < 3; ++c)
            sticking[c] = stick.at_rest[c] + c_tau * ad_slip[c];
          const AD size_of_stick =
            sqrt(sticking[0] * sticking[0] + sticking[1] * sticking[1] +
                 sticking[2] * sticking[2]);
          const AD factor = size_of_stick.val() < limit.val()
            ? AD(1.)
            : AD(limit / size_of_stick);
          for (unsigned int c = 0; c < 3; ++c)
            {
              const AD expected = factor * sticking[c];
              BOOST_CHECK_SMALL(expected.val() - traction[c], 1e-14);
              for (unsigned int d = 0; d < 3; ++d)
                BOOST_CHECK_SMALL(expected.dx(d) -
                                    (with_slip_rate * plane)[c][d],
                                  1e-10 * (1. + with_slip_rate.norm()));
              BOOST_CHECK_SMALL(expected.dx(3) - with_pressure[c], 1e-12);
            }
        }
  }
} // namespace

// Regularised friction against automatic differentiation in stick, slip and at
// rest; its power is never negative and its traction never above the limit. The same with
// a traction of sticking points at rest, as in passes of exact stick.
BOOST_AUTO_TEST_CASE(friction_tangents_are_derivatives)
{
  for (const double at_rest : {0., .4})
    {
      compare_friction(CoulombFriction{.3}, at_rest);
      compare_friction(WeakeningFriction(), at_rest);
    }
}

namespace
{
  /// FrictionalConstraint against pressure - [pressure - r closing]_+ and
  /// traction - P(traction + r slip), differentiated automatically.
  template <int n>
  void
  compare_constraint(const double coefficient)
  {
    const double                r = 5.;
    std::array<unsigned int, 3> n_found{};
    const std::array<double, 3> pressures = {{.7, -.1, 2.}};
    const std::array<double, 3> gaps      = {{-.1, .05, .9}};
    const dealii::Tensor<1, 3>  sliding({.8, -.3, .5});
    for (const double pressure : pressures)
      for (const double closing : gaps)
        for (const double size : {1e-3, .02, .4})
          {
            ConstraintState<n> state;
            state.pressure = pressure;
            state.closing  = closing;
            for (unsigned int d = 0; d < n; ++d)
              {
                state.slip[d]     = size * sliding[d];
                state.traction[d] = .02 * sliding[(d + 1) % 3];
              }
            FrictionalConstraint<n> constraint;
            constraint.choose(state, r, coefficient);
            ++n_found[static_cast<unsigned int>(constraint.status())];
            const auto equations   = constraint.equations(state);
            const auto derivatives = constraint.derivatives();

            constexpr unsigned int n_variables = 2 + 2 * n;
            const AD               p(n_variables, 0, pressure);
            const AD               trial  = p - r * AD(n_variables, 1, closing);
            const AD               normal = p - positive_part(trial);
            BOOST_CHECK_SMALL(normal.val() - equations.normal, 1e-14);
            BOOST_CHECK_SMALL(normal.dx(0) - derivatives.normal_with_pressure,
                              1e-14);
            BOOST_CHECK_SMALL(normal.dx(1) - derivatives.normal_with_closing,
                              1e-14);

            std::array<AD, n> traction, friction_trial;
            AD                square = 0.;
            for (unsigned int d = 0; d < n; ++d)
              {
                traction[d] = AD(n_variables, 2 + d, state.traction[d]);
                friction_trial[d] =
                  traction[d] + r * AD(n_variables, 2 + n + d, state.slip[d]);
                square += friction_trial[d] * friction_trial[d];
              }
            // The radius of an open point is zero.
            const AD radius =
              trial.val() > 0. ? AD(coefficient * positive_part(p)) : AD(0.);
            const AD size_of_trial = sqrt(square);
            for (unsigned int d = 0; d < n; ++d)
              {
                const AD projection = size_of_trial.val() < radius.val()
                  ? friction_trial[d]
                  : AD(radius / size_of_trial * friction_trial[d]);
                const AD tangential = traction[d] - projection;
                BOOST_CHECK_SMALL(tangential.val() - equations.tangential[d],
                                  1e-14);
                BOOST_CHECK_SMALL(tangential.dx(0) -
                                    derivatives.tangential_with_pressure[d],
                                  1e-13);
                for (unsigned int e = 0; e < n; ++e)
                  {
                    BOOST_CHECK_SMALL(
                      tangential.dx(2 + e) -
                        derivatives.tangential_with_traction[d][e],
                      1e-13);
                    BOOST_CHECK_SMALL(tangential.dx(2 + n + e) -
                                        derivatives.tangential_with_slip[d][e],
                                      1e-13);
                  }
              }
          }
    // All pieces, sticking only with friction.
    BOOST_CHECK_GT(n_found[0], 0);
    BOOST_CHECK_GT(n_found[1], 0);
    BOOST_CHECK_EQUAL(n_found[2] > 0, coefficient > 0.);
  }
} // namespace

// The one constraint of active sets and of multipliers between bodies, open, slipping
// and sticking, in 2D and 3D.
BOOST_AUTO_TEST_CASE(constraint_is_a_projection)
{
  for (const double coefficient : {0., .3})
    {
      compare_constraint<1>(coefficient);
      compare_constraint<2>(coefficient);
      compare_constraint<3>(coefficient);
    }
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
// place of the stress (paper C, remark after (18)).
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

namespace
{
  /// The pressure tanh(penetration/length).
  struct TanhLaw
  {
    double length;

    static constexpr ContactLawTraits
    traits()
    {
      return {};
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double /*cell_diameter*/) const
    {
      if (!(state.gap < 0.))
        return {};
      return {Number(tanh(state.gap / length)), Number(0.), Number(0.)};
    }

    double
    potential(const ContactPointState<> &state,
              const double /*cell_diameter*/) const
    {
      return state.gap < 0. ? length * std::log(std::cosh(state.gap / length))
                            : 0.;
    }
  };

  /// The pressure exp(penetration/length) - 1.
  struct ExponentialLaw
  {
    double length;

    static constexpr ContactLawTraits
    traits()
    {
      return {};
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double /*cell_diameter*/) const
    {
      if (!(state.gap < 0.))
        return {};
      return {Number(1. - exp(-state.gap / length)), Number(0.), Number(0.)};
    }

    double
    potential(const ContactPointState<> &state,
              const double /*cell_diameter*/) const
    {
      return state.gap < 0.
        ? length * std::expm1(-state.gap / length) + state.gap
        : 0.;
    }
  };
} // namespace

// At a penetration of h_T the slope of a law over a thousandth of h_T is not a number of
// double precision; the direction that it presses along is that of the gap all the same.
BOOST_AUTO_TEST_CASE(steep_laws_close_along_the_gap)
{
  for (const double length : {.1, 1e-3, 1e-9})
    {
      const ContactLawImplementation<ExponentialLaw> law({length});
      const auto closing = closing_directions(law, 1.);
      BOOST_REQUIRE(closing.has_value());
      BOOST_CHECK_EQUAL(closing->row, 0);
      BOOST_CHECK_EQUAL(closing->column, 0);
      BOOST_CHECK_EQUAL(closing->test, (dealii::Tensor<1, 3>({1., 0., 0.})));
      BOOST_CHECK_EQUAL(closing->trial, (dealii::Tensor<1, 3>({1., 0., 0.})));
    }
  // One that saturates has no slope there: in metres and in millimetres.
  for (const double length : {1e-2, 1e-5})
    for (const double cell_diameter : {1e-2, 1., 1e3})
      {
        const ContactLawImplementation<TanhLaw> law({length});
        const auto closing = closing_directions(law, cell_diameter);
        BOOST_REQUIRE(closing.has_value());
        BOOST_CHECK_EQUAL(closing->test, (dealii::Tensor<1, 3>({1., 0., 0.})));
        BOOST_CHECK_EQUAL(closing->trial, (dealii::Tensor<1, 3>({1., 0., 0.})));
      }
  // One whose slope is never finite has none.
  BOOST_CHECK(
    !closing_directions(ContactLawImplementation<ExponentialLaw>({1e-18}), 1.));
}

BOOST_AUTO_TEST_SUITE_END()
