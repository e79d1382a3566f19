// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_normal_compliance_h
#define ricochet_contact_laws_normal_compliance_h

#include <base/exceptions.h>
#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <contact/energy_promise.h>
#include <contact/laws/contact_law.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  /**
   * The compliance potential c_nu/2 [penetration]_+^alpha (J/m^2), the
   * Moreau-Yosida regularisation of the unilateral condition (paper A, 2.2.3),
   * with its derivative and its discrete derivative. The signed penetration is
   * minus the gap.
   */
  struct CompliancePotential
  {
    /// c_nu (Pa/m^(alpha-1))
    double coefficient = 0.;
    /// alpha >= 2
    double exponent = 2.;

    static OwnParameter
    coefficient_parameter()
    {
      return OwnParameter("Compliance coefficient", 1e9)
        .means("Parameter c_nu",
               "Pa/m^(alpha-1)",
               " of normal compliance: pressure c_nu alpha/2 "
               "penetration^(alpha-1) (paper A, (2.10)). Used by standard and "
               "improved normal compliance and, with alpha = 2, Hauret-Le "
               "Tallec.")
        .at_least(1e-30)
        .by_scale([](const Scales &scales, const ParameterValues &values) {
          return 10. * scales.wave_modulus /
            std::pow(scales.cell_depth, values["Compliance exponent"] - 1.);
        })
        .belongs_to("normal compliance");
    }

    static OwnParameters
    parameters()
    {
      return {coefficient_parameter(),
              OwnParameter("Compliance exponent", 2.)
                .means("Exponent alpha of normal compliance, at least 2. Used "
                       "by standard and improved normal compliance.",
                       "",
                       "")
                .must([](const double value) {
                  if (value < 2.)
                    throw InputError(
                      "The exponent alpha of normal compliance must be at "
                      "least 2 (the regularisation of paper A, (2.7)); it is " +
                      to_text(value) + ".");
                })
                .belongs_to("standard and improved normal compliance")};
    }

    static CompliancePotential
    make(const ParameterValues &values)
    {
      return {values["Compliance coefficient"], values["Compliance exponent"]};
    }

    double
    value(const double penetration) const
    {
      return penetration > 0.
        ? .5 * coefficient * std::pow(penetration, exponent)
        : 0.;
    }

    /// The pressure (Pa) of paper A, (2.10).
    template <typename Number>
    Number
    derivative(const Number &penetration) const
    {
      using std::pow;
      return penetration > 0.
        ? Number(.5 * coefficient * exponent * pow(penetration, exponent - 1.))
        : Number(0.);
    }

    double
    second_derivative(const double penetration) const
    {
      return penetration > 0. ? .5 * coefficient * exponent * (exponent - 1.) *
          std::pow(penetration, exponent - 2.)
                              : 0.;
    }

    /**
     * The quotient of differences between @p old_value and @p new_value (Pa;
     * paper A, (3.10) and (3.11)). It is positive when either end penetrates.
     * Where both do and are close, the quotient is 0/0 and its series takes
     * over.
     */
    template <typename Number>
    Number
    discrete_derivative(const double old_value, const Number &new_value) const
    {
      using std::pow;
      if (is_close(old_value, new_value))
        {
          const Number x = (new_value - old_value) / old_value;
          const double a = exponent;
          return Number(
            .5 * coefficient * a * std::pow(old_value, a - 1.) *
            (1. +
             (a - 1.) / 2. * x *
               (1. + (a - 2.) / 3. * x * (1. + (a - 3.) / 4. * x))));
        }
      if (!(old_value > 0.) && !(new_value > 0.))
        return Number(0.);
      const Number new_power =
        new_value > 0. ? Number(pow(new_value, exponent)) : Number(0.);
      const double old_power =
        old_value > 0. ? std::pow(old_value, exponent) : 0.;
      return Number(.5 * coefficient * (new_power - old_power) /
                    (new_value - old_value));
    }

    /// The derivative of discrete_derivative() with respect to @p new_value
    /// (paper A, (4.15), where the tilde lacks a factor alpha; (5.6) has it).
    double
    discrete_derivative_tangent(const double old_value,
                                const double new_value) const
    {
      if (is_close(old_value, new_value))
        {
          const double x = (new_value - old_value) / old_value;
          const double a = exponent;
          return .5 * coefficient * a * std::pow(old_value, a - 2.) *
            ((a - 1.) / 2. + (a - 1.) * (a - 2.) / 3. * x +
             (a - 1.) * (a - 2.) * (a - 3.) / 8. * x * x);
        }
      if (!(old_value > 0.) && !(new_value > 0.))
        return 0.;
      return (derivative(new_value) -
              discrete_derivative(old_value, new_value)) /
        (new_value - old_value);
    }

  private:
    /// Both penetrate, and the relative difference is so small that the series
    /// of fourth order is better than the quotient.
    template <typename Number>
    static bool
    is_close(const double old_value, const Number &new_value)
    {
      return old_value > 0. && new_value > 0. &&
        new_value - old_value < 1e-3 * old_value &&
        old_value - new_value < 1e-3 * old_value;
    }
  };



  /**
   * Standard normal compliance (SNC; paper A, (2.10)), in the nodes. Within the
   * midpoint scheme it is enforced at the end of the step (A (4.11), (5.2)),
   * where it dissipates.
   */
  struct StandardNormalCompliance
  {
    CompliancePotential compliance;

    static constexpr const char *name = "standard normal compliance";

    static OwnParameters
    parameters()
    {
      return CompliancePotential::parameters();
    }

    static StandardNormalCompliance
    make(const ParameterValues &values)
    {
      return {CompliancePotential::make(values)};
    }

    static EnergyPromise
    promise()
    {
      return falls_by_convexity();
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.nodal            = true;
      traits.takes_friction   = true;
      traits.piecewise_linear = false;
      return traits;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double /*cell_diameter*/) const
    {
      return {Number(-compliance.derivative(Number(-state.gap))),
              Number(0.),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> & /*old_state*/,
            const double /*cell_diameter*/) const
    {
      ContactPointTangent tangent;
      tangent[0][0] = compliance.second_derivative(-state.gap);
      return tangent;
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> & /*old_state*/,
           const double /*cell_diameter*/) const
    {
      return state.gap < 0.;
    }

    double
    potential(const ContactPointState<> &state,
              const double /*cell_diameter*/) const
    {
      return compliance.value(-state.gap);
    }

    double
    pressure(const ContactPointState<> &state,
             const double /*cell_diameter*/) const
    {
      return compliance.derivative(-state.gap);
    }
  };



  /**
   * Standard normal compliance evaluated at the mean of the gaps of a midpoint
   * step, as printed in paper A, (3.4). Not stable: its energy can grow without
   * bound.
   */
  struct MidpointNormalCompliance : public StandardNormalCompliance
  {
    static constexpr const char *name =
      "standard normal compliance at midpoint";

    static MidpointNormalCompliance
    make(const ParameterValues &values)
    {
      return {{CompliancePotential::make(values)}};
    }

    static EnergyPromise
    promise()
    {
      return {EnergyPromise::Kind::none,
              "the pressure of the mean gap is neither a quotient nor a slope "
              "of the potential, and its work can be any"};
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits = StandardNormalCompliance::traits();
      traits.is_two_point     = true;
      return traits;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> &old_state,
          const double /*cell_diameter*/) const
    {
      return {Number(-compliance.derivative(
                Number(-.5 * (state.gap + old_state.gap)))),
              Number(0.),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double /*cell_diameter*/) const
    {
      ContactPointTangent tangent;
      tangent[0][0] =
        .5 * compliance.second_derivative(-.5 * (state.gap + old_state.gap));
      return tangent;
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> &old_state,
           const double /*cell_diameter*/) const
    {
      return state.gap + old_state.gap < 0.;
    }
  };



  /**
   * Improved normal compliance (INC; paper A, (3.10), (3.11)): the discrete
   * derivative of the compliance potential over the step, so that the work
   * against contact is exactly the change of the potential. A point is active
   * when either end of the step penetrates.
   *
   * @tparam in_nodes evaluated in the nodes (paper A), or in the quadrature
   * points of the boundary, with alpha = 2: the penalised form of Hauret and Le
   * Tallec (CMAME 195, 2006), on which paper A builds.
   */
  template <bool in_nodes>
  struct DiscreteDerivativeCompliance : public StandardNormalCompliance
  {
    static constexpr const char *name =
      in_nodes ? "improved normal compliance" : "Hauret-Le Tallec";

    static OwnParameters
    parameters()
    {
      if constexpr (in_nodes)
        return CompliancePotential::parameters();
      else
        return {CompliancePotential::coefficient_parameter()};
    }

    static DiscreteDerivativeCompliance
    make(const ParameterValues &values)
    {
      if constexpr (in_nodes)
        return {{CompliancePotential::make(values)}};
      else
        return {{CompliancePotential{values["Compliance coefficient"], 2.}}};
    }

    static void
    check(const ParameterValues &values)
    {
      if (!in_nodes && values["Compliance exponent"] != 2.)
        throw InputError(
          "Hauret-Le Tallec is a penalisation with the exponent 2; Contact/"
          "Compliance exponent is " +
          to_text(values["Compliance exponent"]) +
          ". For others take improved normal compliance.");
    }

    static EnergyPromise
    promise()
    {
      return keeps_by_quotient();
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits = StandardNormalCompliance::traits();
      traits.nodal            = in_nodes;
      traits.is_two_point     = true;
      return traits;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> &old_state,
          const double /*cell_diameter*/) const
    {
      return {Number(-compliance.discrete_derivative(-old_state.gap,
                                                     Number(-state.gap))),
              Number(0.),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double /*cell_diameter*/) const
    {
      ContactPointTangent tangent;
      tangent[0][0] =
        compliance.discrete_derivative_tangent(-old_state.gap, -state.gap);
      return tangent;
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> &old_state,
           const double /*cell_diameter*/) const
    {
      return state.gap < 0. || old_state.gap < 0.;
    }
  };

  using ImprovedNormalCompliance = DiscreteDerivativeCompliance<true>;
  using HauretLeTallec           = DiscreteDerivativeCompliance<false>;
} // namespace Ricochet

#endif
