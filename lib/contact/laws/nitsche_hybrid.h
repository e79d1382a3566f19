// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_nitsche_hybrid_h
#define ricochet_contact_laws_nitsche_hybrid_h

#include <contact/contact_law.h>
#include <contact/laws/nitsche.h>

namespace Ricochet
{
  /**
   * The contact operator of the Nitsche-hybrid scheme (paper C, (38)-(39),
   * corrected): with q = p - gamma g and q_mid = (q_old + q_new) / 2,
   *
   *     [q]_hybrid = H(q_old) [q_mid]_+ + H(-q_old) ([q_old]_+ + [q_new]_+) / 2,
   *
   * with H(0) = 1/2: the midpoint rule where the old state is in contact, the
   * average of both ends where it is not. Printed, (39) has the two weights
   * exchanged and w for P_N(w), and then the modified energy grows. For theta
   * = 1 the modified energy never grows (Chouly, Hild and Renard 2015, part 2).
   */
  struct NitscheHybrid
  {
    /// gamma_0 (Pa).
    double gamma_0 = 1.;
    /// theta: 1, -1 or 0.
    double theta = 1.;

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.is_two_point = true;
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
      const double q_old = old_state.stress_pressure - gamma * old_state.gap;
      const Number q_new = new_state.stress_pressure - gamma * new_state.gap;
      const Number q     = heaviside(q_old) *
                         positive_part(Number(.5 * (q_old + q_new))) +
                       heaviside(-q_old) * .5 *
                         (positive_part(q_old) + positive_part(q_new));
      const Number stress_pressure =
        .5 * (old_state.stress_pressure + new_state.stress_pressure);
      return {Number(-q), Number(theta / gamma * (q - stress_pressure)), Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &new_state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      // d[q]_hybrid / dq_new
      const double slope =
        .5 * branch(new_state, old_state, cell_diameter);
      return ContactPointTangent({{slope * gamma, -slope, 0.},
               {-theta * slope, theta / gamma * (slope - .5), 0.},
               {0., 0., 0.}});
    }

    int
    branch(const ContactPointState<> &new_state,
           const ContactPointState<> &old_state,
           const double               cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const double q_old = old_state.stress_pressure - gamma * old_state.gap;
      const double q_new = new_state.stress_pressure - gamma * new_state.gap;
      // Whichever part is weighed, its slope is 1/2 when it is active.
      return q_old > 0. ? q_old + q_new > 0. : q_new > 0.;
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
  };
} // namespace Ricochet

#endif
