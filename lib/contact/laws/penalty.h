// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_penalty_h
#define ricochet_contact_laws_penalty_h

#include <base/own_parameter.h>
#include <contact/energy_promise.h>
#include <contact/laws/contact_law.h>

namespace Ricochet
{
  /**
   * Penalty method (paper C, (14)-(17)): pressure [-g]_+ / epsilon with
   * epsilon = epsilon_0 h_T, and the potential [-g]_+^2 / (2 epsilon).
   */
  struct Penalty
  {
    /// epsilon_0 (1/Pa).
    double epsilon_0 = 1.;

    static constexpr const char *name = "penalty";

    static OwnParameters
    parameters()
    {
      return {OwnParameter("Penalty epsilon0", .2)
                .means("Parameter epsilon_0",
                       "1/Pa",
                       " of the penalty method; epsilon = epsilon_0 h_T "
                       "(paper C, (14)). Used by penalty.")
                .at_least(1e-30)
                .by_scale([](const Scales &scales, const ParameterValues &) {
                  return .1 / scales.wave_modulus * scales.cell_depth /
                    scales.cell_diameter;
                })
                .belongs_to("penalty")};
    }

    static Penalty
    make(const ParameterValues &values)
    {
      return {values["Penalty epsilon0"]};
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
      traits.takes_friction = true;
      return traits;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double cell_diameter) const
    {
      return {Number(-positive_part(Number(-state.gap)) /
                     (epsilon_0 * cell_diameter)),
              Number(0.),
              Number(0.)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      ContactPointTangent tangent;
      if (branch(state, old_state, cell_diameter))
        tangent[0][0] = 1. / (epsilon_0 * cell_diameter);
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
              const double               cell_diameter) const
    {
      const double penetration = positive_part(-state.gap);
      return penetration * penetration / (2. * epsilon_0 * cell_diameter);
    }

    double
    pressure(const ContactPointState<> &state, const double cell_diameter) const
    {
      return positive_part(-state.gap) / (epsilon_0 * cell_diameter);
    }
  };
} // namespace Ricochet

#endif
