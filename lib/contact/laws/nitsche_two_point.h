// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_nitsche_two_point_h
#define ricochet_contact_laws_nitsche_two_point_h

#include <contact/laws/contact_law.h>
#include <contact/laws/nitsche.h>

namespace Ricochet
{
  /**
   * Nitsche's method within a midpoint step, as a two-point law. The linear
   * part, theta (p, p(v)) / gamma, is taken at the midpoint, like the bulk
   * force, so that its work is exact. For the positive part of q = p - gamma g
   * there are two choices; with either the modified energy of C, (13) never
   * grows when theta = 1.
   *
   * The hybrid (paper C, (38)-(39), corrected), with q_mid = (q_old + q_new)/2:
   *
   *     H(q_old) [q_mid]_+ + H(-q_old) ([q_old]_+ + [q_new]_+) / 2,  H(0) = 1/2,
   *
   * the midpoint where the old state is in contact, the average of both ends
   * where it is not. Printed, (39) has the two weights exchanged and w for
   * P_N(w), and then the modified energy grows (Chouly, Hild and Renard 2015,
   * part 2).
   *
   * The end of the step: [q_new]_+, the derivative of a convex function at the
   * new state, which dissipates. (With the linear part at the end as well,
   * energy grows without bound: that part of the potential is concave.)
   */
  struct NitscheTwoPoint
  {
    enum class Evaluation
    {
      hybrid,
      end_of_step
    };

    /// gamma_0 (Pa).
    double gamma_0 = 1.;
    /// theta: 1, -1 or 0.
    double     theta      = 1.;
    Evaluation evaluation = Evaluation::hybrid;

    static constexpr const char *name = "Nitsche-hybrid";

    static OwnParameters
    parameters()
    {
      return Nitsche::parameters();
    }

    static NitscheTwoPoint
    make(const ParameterValues &values)
    {
      return {values["Nitsche gamma0"],
              values["Nitsche theta"],
              Evaluation::hybrid};
    }

    /// Nitsche's method itself, over a step.
    static NitscheTwoPoint
    at_end_of_step(const ParameterValues &values)
    {
      return {values["Nitsche gamma0"],
              values["Nitsche theta"],
              Evaluation::end_of_step};
    }

    static EnergyPromise
    promise()
    {
      return {EnergyPromise::Kind::never_gains,
              "each of its two means grows by no more than its work where it "
              "is taken (Chouly et al. 2015, part 2; paper C, A.3, says that "
              "it is stable)"};
    }

    std::string
    lacks_potential() const
    {
      return Nitsche{gamma_0, theta}.lacks_potential();
    }

    std::string
    instability(const double trace_constant) const
    {
      return Nitsche{gamma_0, theta}.instability(trace_constant);
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.is_two_point   = true;
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
    force(const ContactPointState<Number> &new_state,
          const ContactPointState<double> &old_state,
          const double                     cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const double q_old = trial_pressure(old_state, cell_diameter);
      const Number q_new = trial_pressure(new_state, cell_diameter);
      const Number q     = evaluation == Evaluation::end_of_step
            ? positive_part(q_new)
            : Number(heaviside(q_old) *
                   positive_part(Number(.5 * (q_old + q_new))) +
                 heaviside(-q_old) * .5 *
                   (positive_part(q_old) + positive_part(q_new)));
      const Number stress_pressure =
        .5 * (old_state.stress_pressure + new_state.stress_pressure);
      return {Number(-q),
              Number(theta / gamma * (q - stress_pressure)),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &new_state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      // Derivative of the positive part with respect to q_new. It is 1/2 for
      // either part of the hybrid when that part is active.
      const double slope = (evaluation == Evaluation::end_of_step ? 1. : .5) *
        branch(new_state, old_state, cell_diameter);
      return ContactPointTangent(
        {{slope * gamma, -slope, 0.},
         {-theta * slope, theta / gamma * (slope - .5), 0.},
         {0., 0., 0.}});
    }

    int
    branch(const ContactPointState<> &new_state,
           const ContactPointState<> &old_state,
           const double               cell_diameter) const
    {
      const double q_old = trial_pressure(old_state, cell_diameter);
      const double q_new = trial_pressure(new_state, cell_diameter);
      return evaluation == Evaluation::hybrid && q_old > 0. ? q_old + q_new > 0.
                                                            : q_new > 0.;
    }

    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const
    {
      return Nitsche{gamma_0, theta}.potential(state, cell_diameter);
    }

    double
    pressure(const ContactPointState<> &state, const double cell_diameter) const
    {
      return Nitsche{gamma_0, theta}.pressure(state, cell_diameter);
    }

  private:
    /// q = p - gamma g, that is -P_N(u) of paper C.
    template <typename Number>
    Number
    trial_pressure(const ContactPointState<Number> &state,
                   const double                     cell_diameter) const
    {
      return state.stress_pressure - stiffness(cell_diameter) * state.gap;
    }
  };
} // namespace Ricochet

#endif
