// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_signorini_multiplier_h
#define ricochet_contact_laws_signorini_multiplier_h

#include <contact/energy_promise.h>
#include <contact/laws/augmentation.h>
#include <contact/laws/contact_law.h>

namespace Ricochet
{
  /**
   * Signorini's condition in the nodes by multipliers: the quasi-Lagrangian of
   * Alart and Curnier (CMAME 92, 1991), as papers A and B use it. The force is
   * the multiplier itself, and the complementarity g >= 0, lambda >= 0,
   * lambda g = 0 is the equation lambda = [lambda - r g]_+. The augmentation r
   * = r_0 / h_T affects Newton's method only; the solution does not depend on
   * it.
   */
  struct SignoriniMultiplier
  {
    /// r_0 (Pa).
    double augmentation = 1.;

    static constexpr const char *name = "Signorini multipliers";

    static OwnParameters
    parameters()
    {
      return augmentation_parameters();
    }

    static SignoriniMultiplier
    make(const ParameterValues &values)
    {
      return {values["Augmentation"]};
    }

    static EnergyPromise
    promise()
    {
      return falls_by_complementarity();
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.nodal            = true;
      traits.needs_multiplier = true;
      traits.takes_friction   = true;
      return traits;
    }

    double
    stiffness(const double cell_diameter) const
    {
      return augmentation / cell_diameter;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double cell_diameter) const
    {
      const double r = stiffness(cell_diameter);
      return {Number(-state.multiplier),
              Number(0.),
              Number((positive_part(Number(state.multiplier - r * state.gap)) -
                      state.multiplier) /
                     r)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      const double on = branch(state, old_state, cell_diameter);
      return ContactPointTangent(
        {{0., 0., -1.},
         {0., 0., 0.},
         {-on, 0., (on - 1.) / stiffness(cell_diameter)}});
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> & /*old_state*/,
           const double cell_diameter) const
    {
      return state.multiplier - stiffness(cell_diameter) * state.gap > 0.;
    }

    /// At a solution lambda g = 0 and nothing is stored.
    double
    potential(const ContactPointState<> & /*state*/,
              const double /*cell_diameter*/) const
    {
      return 0.;
    }

    double
    pressure(const ContactPointState<> &state,
             const double /*cell_diameter*/) const
    {
      return state.multiplier;
    }
  };
} // namespace Ricochet

#endif
