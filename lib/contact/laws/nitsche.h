// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_nitsche_h
#define ricochet_contact_laws_nitsche_h

#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <contact/energy_promise.h>
#include <contact/laws/contact_law.h>

#include <string>

namespace Ricochet
{
  /**
   * Nitsche's method for the Signorini condition (paper C, (6)-(9); variants
   * after Chouly, Hild and Renard 2015): with the trial pressure
   * q = p - gamma g, where p = -sigma_n(u) and gamma = gamma_0 / h_T (C, (7)),
   *
   *     ( [q]_+ , theta p(v) - gamma g(v) ) / gamma  -  theta ( p , p(v) ) /
   *     gamma .
   *
   * theta = 1 is the symmetric method, which has the potential
   * ([q]_+^2 - p^2) / (2 gamma) of C, (13); theta = -1 the skew-symmetric and
   * theta = 0 the non-symmetric one.
   */
  struct Nitsche
  {
    /// gamma_0 (Pa).
    double gamma_0 = 1.;
    /// theta: 1, -1 or 0.
    double theta = 1.;

    static constexpr const char *name = "Nitsche";

    static OwnParameters
    parameters()
    {
      return {OwnParameter("Nitsche gamma0", 5.)
                .means("Parameter gamma_0",
                       "Pa",
                       " of Nitsche's method; gamma = gamma_0/h_T (paper C, "
                       "(7)). Used by Nitsche and Nitsche-hybrid.")
                .at_least(1e-30)
                .by_scale([](const Scales &scales, const ParameterValues &) {
                  // The inverse inequality has the depth of a cell, gamma_0 its
                  // diameter.
                  return 20. * scales.degree * scales.degree *
                    scales.wave_modulus * scales.cell_diameter /
                    scales.cell_depth;
                })
                .belongs_to("Nitsche's method"),
              OwnParameter("Nitsche theta", 1.)
                .means("Variant of Nitsche's method: 1 symmetric, -1 "
                       "skew-symmetric, 0 non-symmetric. Used by Nitsche and "
                       "Nitsche-hybrid.",
                       "",
                       "")
                .one_of("1|-1|0")
                .belongs_to("Nitsche's method")};
    }

    static Nitsche
    make(const ParameterValues &values)
    {
      return {values["Nitsche gamma0"], values["Nitsche theta"]};
    }

    static EnergyPromise
    promise()
    {
      return {EnergyPromise::Kind::never_gains,
              "the part of the potential that is convex is taken at the end of "
              "the step, the quadratic rest in its middle"};
    }

    std::string
    lacks_potential() const
    {
      return theta == 1. ? ""
                         : "with theta = " + to_text(theta) +
          " Nitsche's method has no potential";
    }

    /// The method is not stable where energy could grow without bound.
    std::string
    instability(const double trace_constant) const
    {
      const double bound = .25 * (1. + theta) * (1. + theta) * trace_constant;
      // Equal is not enough, and both come with round-off.
      if (gamma_0 > (1. + 1e-9) * bound)
        return "";
      return "Nitsche gamma0 = " + to_text(gamma_0) +
        " is too small for theta = " + to_text(theta) +
        ", this material and this mesh: the method is not stable. It must be "
        "larger than " +
        to_text(bound) + ".";
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.uses_stress    = true;
      traits.takes_friction = true;
      return traits;
    }

    double
    stiffness(const double cell_diameter) const
    {
      return gamma_0 / cell_diameter;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const Number q =
        positive_part(Number(state.stress_pressure - gamma * state.gap));
      return {Number(-q),
              Number(theta / gamma * (q - state.stress_pressure)),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const double on    = branch(state, old_state, cell_diameter);
      return ContactPointTangent({{on * gamma, -on, 0.},
                                  {-theta * on, theta / gamma * (on - 1.), 0.},
                                  {0., 0., 0.}});
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> & /*old_state*/,
           const double cell_diameter) const
    {
      return state.stress_pressure - stiffness(cell_diameter) * state.gap > 0.;
    }

    /// The non-symmetric variants have none: 0.
    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const
    {
      if (theta != 1.)
        return 0.;
      const double q = pressure(state, cell_diameter);
      return (q * q - state.stress_pressure * state.stress_pressure) /
        (2. * stiffness(cell_diameter));
    }

    double
    pressure(const ContactPointState<> &state, const double cell_diameter) const
    {
      return positive_part(state.stress_pressure -
                           stiffness(cell_diameter) * state.gap);
    }
  };
} // namespace Ricochet

#endif
