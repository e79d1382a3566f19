// SPDX-License-Identifier: LGPL-2.1-or-later

// Laws, a material and a time scheme from outside of the library: those of
// examples/own_step, registered as in a user's own program, against their
// definitions and in impacts.

#include "deformation_gradient.h"
#include "meshes.h"
#include "../../examples/own_step/backward_euler.h"
#include "../../examples/own_step/exponential_pressure.h"
#include "../../examples/own_step/gent.h"
#include "../../examples/own_step/limited_friction.h"

#include <base/exceptions.h>
#include <contact/laws/law_check.h>
#include <contact/laws/regularised_friction.h>
#include <contact/obstacles/half_space.h>
#include <materials/law_check.h>
#include <materials/material_parameters.h>
#include <output/momenta.h>
#include <problems/impact.h>

#include <deal.II/base/function.h>

#include <Sacado.hpp>
#include <boost/test/unit_test.hpp>

#include <limits>

using namespace Ricochet;
using dealii::SymmetricTensor;
using dealii::Tensor;

BOOST_AUTO_TEST_SUITE(own_laws)

namespace
{
  /// As at the beginning of a program; once for all tests of a process.
  void
  register_all()
  {
    static bool done = false;
    if (done)
      return;
    register_contact_law<ExponentialPressure>();
    register_friction_law<LimitedFriction>();
    register_material<Gent>();
    register_time_scheme<BackwardEuler>();
    done = true;
  }

  const Gent gent{.8, 5., 1.7};

  template <int dim>
  SymmetricTensor<2, dim>
  cauchy_green(const double size, const unsigned int seed)
  {
    const Tensor<2, dim> f = deformation_gradient<dim>(size, seed);
    return symmetrize(transpose(f) * f);
  }

  /// The step's work and the change of energy, down to small steps.
  template <int dim>
  void
  check_work(const PlaneState state)
  {
    const Hyperelastic<dim> material(
      std::make_shared<HyperelasticLawImplementation<Gent>>(gent),
      state);
    for (const double size : {.4, .1, 1e-2, 1e-4, 1e-6})
      for (unsigned int seed = 0; seed < 4; ++seed)
        {
          const auto old_c      = cauchy_green<dim>(.2, seed);
          const auto difference = size *
            (cauchy_green<dim>(.3, 10 + seed) -
             dealii::unit_symmetric_tensor<dim>());
          const auto stress =
            GonzalezStress<dim>::stress(material, old_c, difference);
          const double change =
            material.energy(old_c + difference) - material.energy(old_c);
          BOOST_CHECK_SMALL(.5 * (stress * difference) - change, 4e-15);
          // The stress has no round-off that a small step would magnify.
          BOOST_CHECK_SMALL(
            (stress - 2. * material.derivative(old_c + .5 * difference)).norm(),
            10. * size * size + 1e-13);
          if (dim == 2 && state == PlaneState::plane_stress)
            {
              Tensor<2, dim> f(dealii::unit_symmetric_tensor<dim>());
              f[0][0] += size;
              f[0][1] = .3 * size;
              BOOST_CHECK_SMALL(material.spatial_cauchy_stress(f)[2][2], 1e-13);
            }
        }
  }

  /// A cube of Gent's material, thrown at a plane.
  struct Throw
  {
    Throw(const std::string &scheme, const std::string &friction_law)
      : cube(false)
    {
      register_all();
      parameters.scheme.name          = scheme;
      parameters.contact.treatment    = "exponential pressure";
      parameters.contact.friction_law = friction_law;
      auto &values                    = parameters.contact.values;
      values["Exponential pressure"]  = 50.;
      values["Exponential length"]    = .02;
      values["Augmentation"]          = 500.;
      values["Tangential compliance"] = 300.;
      values["Limited coefficient"]   = .5;
      values["Shear strength"]        = strength;

      MaterialParameters material;
      material.law                          = "Gent";
      material.plane_state                  = "plane strain";
      material.values["Gent shear modulus"] = 200.;
      material.values["Gent limit"]         = 20.;
      material.values["Bulk modulus"]       = 300.;
      material.validate(3, scheme);
      parameters.validate(false);
      impact = std::make_unique<Impact<3>>(
        parameters,
        cube.triangulation,
        ImpactSetup<3>{
          material.make<3>(),
          1.,
          1,
          std::set<dealii::types::boundary_id>(),
          Obstacles{{1,
                     std::make_shared<RigidObstacle>(
                       std::make_shared<HalfSpace>(Tensor<1, 3>({0., 0., -.02}),
                                                   Tensor<1, 3>({0., 0., 1.})),
                       RigidMotion())}}},
        MPI_COMM_WORLD);
      state = impact->state_in_motion(dealii::FunctionFromFunctionObjects<3>(
        {[](const dealii::Point<3> &) { return .6; },
         [](const dealii::Point<3> &) { return .2; },
         [](const dealii::Point<3> &) { return -2.; }}));
    }

    /// @return the gain of total energy; the balance is checked.
    double
    run(const unsigned int n_steps, const double time_step)
    {
      const double begin = energy() + potential();
      double       taken = 0.;
      for (unsigned int n = 0; n < n_steps; ++n)
        {
          const double     old_energy = energy();
          State            next;
          const StepReport report =
            impact->scheme->step(impact->system, state, time_step, next);
          next.time = state.time + time_step;
          state     = next;
          BOOST_CHECK_SMALL(energy() - old_energy + report.contact_work +
                              report.friction_work +
                              report.numerical_dissipation,
                            1e-9);
          BOOST_CHECK_GE(report.friction_work, 0.);
          BOOST_CHECK_GE(report.numerical_dissipation, -1e-12);
          taken += report.friction_work + report.numerical_dissipation;
          const auto summary =
            impact->contact
              ->summary({state.solution, state.contact_force, state.time})
              .at(1);
          largest_force = std::max(largest_force, summary.force);
        }
      return energy() + potential() + taken - begin;
    }

    double
    energy() const
    {
      return impact->system.kinetic_energy(state.velocity) +
        impact->bulk->energy(state.solution);
    }

    double
    potential() const
    {
      return impact->contact->potential(state.solution, state.time);
    }

    static constexpr double    strength = .5;
    const CubeAbovePlane<3>    cube;
    ImpactParameters           parameters;
    std::unique_ptr<Impact<3>> impact;
    State                      state;
    double                     largest_force = 0.;
  };
} // namespace

BOOST_AUTO_TEST_CASE(exponential_pressure)
{
  const ContactLawImplementation<ExponentialPressure> law({7., .03});
  for (const double gap : {.1, 1e-9, -1e-9, -.01, -.2})
    {
      const ContactPointState<> state{gap, 0., 0.};
      const double expected = gap < 0. ? 7. * std::expm1(-gap / .03) : 0.;
      BOOST_CHECK_CLOSE(law.pressure(state, 1.), expected, 1e-6);
      BOOST_CHECK_EQUAL(law.branch(state, state, 1.), gap < 0.);
      // Automatic differentiation of the force.
      BOOST_CHECK_CLOSE(law.tangent(state, state, 1.)[0][0],
                        gap < 0. ? 7. / .03 * std::exp(-gap / .03) : 0.,
                        1e-10);
      // Differences of tiny energies are all round-off.
      if (std::abs(gap) < 1e-6)
        continue;
      const double eps   = 1e-6 * std::abs(gap);
      const double slope = (law.potential({gap + eps, 0., 0.}, 1.) -
                            law.potential({gap - eps, 0., 0.}, 1.)) /
        (2. * eps);
      BOOST_CHECK_SMALL(slope - law.force(state, state, 1.).gap,
                        1e-5 * (1e-6 + expected));
    }
}

BOOST_AUTO_TEST_CASE(limited_friction)
{
  const FrictionLawImplementation<LimitedFriction> law({.3, 2.});
  BOOST_CHECK_CLOSE(law.limit(4., 1.).value, 1.2, 1e-12);
  BOOST_CHECK_CLOSE(law.limit(4., 1.).with_pressure, .3, 1e-12);
  BOOST_CHECK_CLOSE(law.limit(400., 1.).value, 2., 1e-12);
  BOOST_CHECK_EQUAL(law.limit(400., 1.).with_pressure, 0.);
}

// Gent's gradient and Hessian against automatic differentiation of the energy,
// and the functions of CompletedLaw from them.
BOOST_AUTO_TEST_CASE(gent_from_its_energy)
{
  using AD  = Sacado::Fad::DFad<double>;
  using AD2 = Sacado::Fad::DFad<AD>;
  for (const double i3 : {.7, 1., 1.4})
    for (const double i1 : {3., 3.6})
      {
        const Invariants<> i{i1, 3.2, i3};
        const auto         variable = [](const unsigned int k, const double x) {
          return AD2(3, k, AD(3, k, x));
        };
        const AD2 energy = gent.energy<AD2>(
          {variable(0, i.first), variable(1, i.second), variable(2, i.third)});
        const auto gradient = gent.gradient(i);
        const auto hessian  = gent.hessian(i);
        for (unsigned int k = 0; k < 3; ++k)
          {
            BOOST_CHECK_SMALL(energy.dx(k).val() - gradient[k], 1e-14);
            for (unsigned int l = 0; l < 3; ++l)
              BOOST_CHECK_SMALL(energy.dx(k).dx(l) - hessian[k][l], 1e-13);
          }
        const auto   third = CompletedLaw<Gent>(gent).third_derivatives(i);
        const double eps   = 1e-5;
        const auto   above = gent.hessian(Invariants<>{i1, 3.2, i3 + eps});
        const auto   below = gent.hessian(Invariants<>{i1, 3.2, i3 - eps});
        for (unsigned int k = 0; k < 3; ++k)
          for (unsigned int l = 0; l < 3; ++l)
            {
              BOOST_CHECK_SMALL((above[k][l] - below[k][l]) / (2. * eps) -
                                  third[k][l][2],
                                1e-7);
              for (unsigned int m = 0; m < 3; ++m)
                BOOST_CHECK_SMALL(third[k][l][m] - third[m][l][k], 1e-13);
            }
      }
  const LinearElastic small = CompletedLaw<Gent>(gent).at_small_strains();
  BOOST_CHECK_CLOSE(small.mu, .8, 1e-12);
  BOOST_CHECK_CLOSE(small.lambda + 2. / 3. * small.mu, 1.7, 1e-12);
  check_work<2>(PlaneState::plane_strain);
  check_work<2>(PlaneState::plane_stress);
  check_work<3>(PlaneState::plane_strain);
}

namespace
{
  // Gent's law with the mistakes of a first attempt.
  struct WithEnergyAtRest : Gent
  {
    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      return Gent::energy(i) + .1;
    }
  };

  struct WithStressAtRest : Gent
  {
    template <typename Number>
    Number
    energy(const Invariants<Number> &i) const
    {
      return Gent::energy(i) + .1 * (i.first - 3.);
    }

    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      auto result = Gent::gradient(i);
      result[0] += .1;
      return result;
    }
  };

  struct WithTwiceTheGradient : Gent
  {
    template <typename Number>
    std::array<Number, 3>
    gradient(const Invariants<Number> &i) const
    {
      auto result = Gent::gradient(i);
      for (Number &entry : result)
        entry *= 2.;
      return result;
    }
  };

  struct WithoutAnEntry : Gent
  {
    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      auto result  = Gent::hessian(i);
      result[2][0] = Number(0.);
      return result;
    }
  };

  struct WithThreeTimesAnEntry : Gent
  {
    template <typename Number>
    std::array<std::array<Number, 3>, 3>
    hessian(const Invariants<Number> &i) const
    {
      auto result = Gent::hessian(i);
      result[2][2] *= 3.;
      return result;
    }
  };

  // The exponential pressure, the same way.
  struct WithWrongSign : ExponentialPressure
  {
    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> &old_state,
          const double                     cell_diameter) const
    {
      auto result = ExponentialPressure::force(state, old_state, cell_diameter);
      result.gap *= -1.;
      return result;
    }
  };

  struct WithHalfThePotential : ExponentialPressure
  {
    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const
    {
      return .5 * ExponentialPressure::potential(state, cell_diameter);
    }
  };

  struct CalledLinear : ExponentialPressure
  {
    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits = ExponentialPressure::traits();
      traits.piecewise_linear = true;
      return traits;
    }
  };

  struct WithSteepTangent : ExponentialPressure
  {
    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> & /*old_state*/,
            const double /*cell_diameter*/) const
    {
      ContactPointTangent result;
      result[0][0] =
        state.gap < 0. ? 5. * p_0 / d * std::exp(-state.gap / d) : 0.;
      return result;
    }
  };

  /// A right law whose slope doubles where a check may look.
  struct WithAKink : ExponentialPressure
  {
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
      const Number once = positive_part(Number(-state.gap)),
                   more = positive_part(Number(-state.gap - .011));
      return {Number(-p_0 * (once + more)), Number(0.), Number(0.)};
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> & /*old_state*/,
           const double /*cell_diameter*/) const
    {
      return (state.gap < 0.) + (state.gap < -.011);
    }

    double
    potential(const ContactPointState<> &state,
              const double /*cell_diameter*/) const
    {
      const double once = positive_part(-state.gap),
                   more = positive_part(-state.gap - .011);
      return .5 * p_0 * (once * once + more * more);
    }
  };

  /// A barrier that acts before bodies touch, -ln(gap/d) for gaps below d, whose @p sign may be wrong.
  template <int sign>
  struct Barrier : ExponentialPressure
  {
    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double /*cell_diameter*/) const
    {
      if (state.gap > d)
        return {};
      if (!(state.gap > 0.))
        return {Number(-std::numeric_limits<double>::infinity()),
                Number(0.),
                Number(0.)};
      return {Number(sign * p_0 / d * (1. - d / state.gap)),
              Number(0.),
              Number(0.)};
    }

    double
    potential(const ContactPointState<> &state,
              const double /*cell_diameter*/) const
    {
      return state.gap < d
        ? p_0 * (state.gap / d - 1. - std::log(state.gap / d))
        : 0.;
    }
  };

  /// Whether the check of a law refuses it with these @p words.
  template <typename Check>
  bool
  is_refused(const Check &check, const std::string &words)
  {
    try
      {
        check();
      }
    catch (const InputError &error)
      {
        BOOST_TEST_MESSAGE(error.what());
        return std::string(error.what()).find(words) != std::string::npos;
      }
    return false;
  }
} // namespace

// Laws of the library pass in every run with the values of that run.
BOOST_AUTO_TEST_CASE(wrong_laws_are_refused)
{
  const auto of_material = [](const auto &law, const std::string &words) {
    using Law = std::decay_t<decltype(law)>;
    return is_refused(
      [&]() { check_law(HyperelasticLawImplementation<Law>(law), "mine"); },
      words);
  };
  check_law(HyperelasticLawImplementation<Gent>(gent), "Gent");
  // Strains of some per cent are beyond these limits, or near them.
  for (const double limit : {2e-3, 5e-3, 1e-2})
    check_law(HyperelasticLawImplementation<Gent>({.8, limit, 1.7}), "Gent");
  // Moduli in other units, and a body that hardly changes its volume.
  for (const double unit : {1e-12, 1e12})
    check_law(HyperelasticLawImplementation<Gent>({.8 * unit, 5., 1e6 * unit}),
              "Gent");
  BOOST_CHECK(
    of_material(WithEnergyAtRest{gent}, "its energy at rest is 0.1 J"));
  BOOST_CHECK(
    of_material(WithStressAtRest{gent}, "its stress at rest is 0.2 Pa"));
  BOOST_CHECK(of_material(WithTwiceTheGradient{gent}, "gradient()[0] is"));
  BOOST_CHECK(of_material(WithoutAnEntry{gent}, "hessian()[2][0] is 0"));
  BOOST_CHECK(of_material(WithThreeTimesAnEntry{gent}, "hessian()[2][2] is"));

  const ExponentialPressure pressure{7., .03};
  const auto of_contact = [](const auto &law, const std::string &words) {
    using Law = std::decay_t<decltype(law)>;
    return is_refused(
      [&]() { check_law(ContactLawImplementation<Law>(law), "mine", 1.); },
      words);
  };
  for (const double cell_diameter : {1e-6, 1., 1e3})
    for (const double part : {.01, .1, 100.})
      check_law(ContactLawImplementation<ExponentialPressure>(
                  {7., part * cell_diameter}),
                "",
                cell_diameter);
  check_law(ContactLawImplementation<WithAKink>(WithAKink{pressure}), "", 1.);
  check_law(ContactLawImplementation<Barrier<1>>(Barrier<1>{pressure}), "", 1.);
  BOOST_CHECK(of_contact(Barrier<-1>{pressure}, "force() is "));
  BOOST_CHECK(of_contact(WithWrongSign{pressure}, "force() is "));
  BOOST_CHECK(of_contact(WithHalfThePotential{pressure}, "potential() is "));
  BOOST_CHECK(of_contact(CalledLinear{pressure}, "piecewise linear"));
  BOOST_CHECK(of_contact(WithSteepTangent{pressure}, "tangent() is "));
}

// A limit that is below zero would add energy; defaults are within users' bounds.
BOOST_AUTO_TEST_CASE(limits_and_defaults_with_a_wrong_sign)
{
  const RegularisedFriction friction(
    std::make_shared<FrictionLawImplementation<LimitedFriction>>(
      LimitedFriction{-.3, 2.}),
    1.);
  const Tensor<1, 3> slip({1., 0., 0.});
  BOOST_CHECK_THROW(friction.choose_branch(friction.creep(), 4., slip, slip),
                    NewtonFailure);
  dealii::ParameterHandler handler;
  ParameterValues          values;
  BOOST_CHECK_THROW(values.add_parameters({OwnParameter("Stiffness", -1.)
                                             .means("Stiffness", "Pa", "")
                                             .at_least(1e-30)
                                             .belongs_to("mine")},
                                          handler),
                    InputError);
}

// One table: names, parameters, defaults and notes are those of the laws' own files.
BOOST_AUTO_TEST_CASE(registered_laws_are_as_all_others)
{
  register_all();
  BOOST_CHECK_THROW(register_contact_law<ExponentialPressure>(),
                    dealii::ExceptionBase);
  BOOST_CHECK_THROW(register_friction_law<LimitedFriction>(),
                    dealii::ExceptionBase);
  BOOST_CHECK_THROW(register_material<Gent>(), dealii::ExceptionBase);
  BOOST_CHECK_THROW(register_time_scheme<BackwardEuler>(),
                    dealii::ExceptionBase);

  ImpactParameters         impact;
  MaterialParameters       material;
  dealii::ParameterHandler handler;
  impact.add_parameters(handler);
  material.add_parameters(handler);
  set_parameter("Material/Law=Gent", handler);
  set_parameter("Material/Gent shear modulus=3", handler);
  set_parameter("Contact/Treatment=exponential pressure", handler);
  set_parameter("Contact/Exponential length=0.25", handler);
  set_parameter("Contact/Friction law=limited by shear", handler);
  set_parameter("Time/Scheme=backward Euler", handler);
  BOOST_CHECK_EQUAL(material.values["Gent shear modulus"], 3.);
  BOOST_CHECK_EQUAL(impact.contact.values["Exponential length"], .25);
  BOOST_CHECK_CLOSE(material.at_small_strains().mu, 3., 1e-12);
  BOOST_CHECK_THROW(set_parameter("Contact/Exponential length=0", handler),
                    InputError);
  // The scheme knows velocities, and this law takes a treatment that regularises.
  BOOST_CHECK_NO_THROW(impact.validate(false));
  set_parameter("Time/Scheme=midpoint", handler);
  BOOST_CHECK_NO_THROW(impact.validate(false));
  set_parameter("Contact/Treatment=persistent contact", handler);
  BOOST_CHECK_THROW(impact.validate(false), InputError);
  set_parameter("Contact/Treatment=exponential pressure", handler);

  std::set<std::string> unused;
  for (const auto &list :
       {impact.unused_parameters(), material.unused_parameters()})
    for (const UnusedParameter &parameter : list)
      unused.insert(parameter.name);
  for (const std::string name : {"Material/Young modulus",
                                 "Material/c1",
                                 "Contact/Penalty epsilon0",
                                 "Contact/Friction coefficient",
                                 "Time/HHT alpha"})
    BOOST_CHECK_EQUAL(unused.count(name), 1u);
  for (const std::string name : {"Material/Gent limit",
                                 "Contact/Exponential length",
                                 "Contact/Shear strength",
                                 "Contact/Augmentation"})
    BOOST_CHECK_EQUAL(unused.count(name), 0u);

  ContactParameters open = impact.contact;
  open.leave_open();
  open.set_missing({5., 10., 1., .1, .1, 1});
  BOOST_CHECK_CLOSE(open.values["Exponential pressure"], 1., 1e-12);
  BOOST_CHECK_CLOSE(open.values["Exponential length"], 1e-3, 1e-12);
  BOOST_CHECK(promises_as_table().find(
                "| exponential pressure | never gains") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(an_impact_with_the_midpoint_scheme)
{
  Throw            impact("midpoint", "limited by shear");
  const Momenta<3> momenta(impact.impact->body,
                           impact.impact->system.mass_matrix(),
                           /* small strains */ false);
  const auto       begin  = momenta.linear(impact.state.velocity);
  const double     gained = impact.run(20, .01);
  const auto       change = momenta.linear(impact.state.velocity) - begin;
  BOOST_CHECK_GT(impact.largest_force, 1.);
  BOOST_CHECK_LE(gained, 1e-9);
  // No traction is larger than the strength, on an area of 1 over 0.2 s; Coulomb's
  // would be half of the pressure.
  const double tangential = std::hypot(change[0], change[1]);
  BOOST_CHECK_GT(tangential, .01);
  BOOST_CHECK_LE(tangential, .2 * Throw::strength * (1. + 1e-9));
  BOOST_CHECK_GT(.5 * change[2], 2. * tangential);
}

BOOST_AUTO_TEST_CASE(an_impact_with_a_scheme_of_ones_own)
{
  Throw impact("backward Euler", "Coulomb");
  impact.run(20, .01);
  BOOST_CHECK_GT(impact.largest_force, 1.);
}

BOOST_AUTO_TEST_SUITE_END()
