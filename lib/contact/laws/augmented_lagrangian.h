// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_augmented_lagrangian_h
#define ricochet_contact_laws_augmented_lagrangian_h

#include <contact/energy_promise.h>
#include <contact/laws/augmentation.h>
#include <contact/laws/contact_law.h>

namespace Ricochet
{
  /**
   * Proximal augmented Lagrangian (paper C, (18)-(21)), with the multiplier
   * lambda >= 0 in compression and gamma = gamma_a / h_T: the potential is
   * ([lambda - gamma g]_+^2 - lambda^2) / (2 gamma). This is Nitsche's method
   * with the multiplier in place of the body's own stress.
   */
  struct ProximalAugmentedLagrangian
  {
    /// gamma_a (Pa).
    double gamma_a = 1.;

    static constexpr const char *name = "proximal augmented Lagrangian";

    static OwnParameters
    parameters()
    {
      return augmentation_parameters();
    }

    static ProximalAugmentedLagrangian
    make(const ParameterValues &values)
    {
      return {values["Augmentation"]};
    }

    static EnergyPromise
    promise()
    {
      return {EnergyPromise::Kind::never_gains,
              "the potential, at its largest over the multipliers, is convex "
              "in the gaps, and the force is its slope at the end of the step"};
    }

    static constexpr ContactLawTraits
    traits()
    {
      ContactLawTraits traits;
      traits.needs_multiplier = true;
      traits.takes_friction   = true;
      return traits;
    }

    double
    stiffness(const double cell_diameter) const
    {
      return gamma_a / cell_diameter;
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> & /*old_state*/,
          const double cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const Number q =
        positive_part(Number(state.multiplier - gamma * state.gap));
      return {Number(-q), Number(0.), Number((q - state.multiplier) / gamma)};
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      const double gamma = stiffness(cell_diameter);
      const double on    = branch(state, old_state, cell_diameter);
      return ContactPointTangent(
        {{on * gamma, 0., -on}, {0., 0., 0.}, {-on, 0., (on - 1.) / gamma}});
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> & /*old_state*/,
           const double cell_diameter) const
    {
      return state.multiplier - stiffness(cell_diameter) * state.gap > 0.;
    }

    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const
    {
      const double q = pressure(state, cell_diameter);
      return (q * q - state.multiplier * state.multiplier) /
        (2. * stiffness(cell_diameter));
    }

    double
    pressure(const ContactPointState<> &state, const double cell_diameter) const
    {
      return positive_part(state.multiplier -
                           stiffness(cell_diameter) * state.gap);
    }
  };
} // namespace Ricochet

#endif
