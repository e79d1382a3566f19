// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_corner_compliance_h
#define ricochet_contact_laws_corner_compliance_h

#include <contact/laws/normal_compliance.h>
#include <contact/laws/penalty.h>

namespace Ricochet
{
  /**
   * The law at corners and edges of the master beside a constraint, which has
   * multipliers in the nodes of the slave alone: improved normal compliance with the
   * pressure r_0 / h times the penetration, so that its work is the change of its
   * potential.
   */
  struct CornerCompliance
  {
    /// r_0 (Pa)
    double stiffness = 0.;

    static constexpr const char *name = "corner compliance";

    static constexpr ContactLawTraits
    traits()
    {
      return ImprovedNormalCompliance::traits();
    }

    template <typename Number>
    ContactPointForce<Number>
    force(const ContactPointState<Number> &state,
          const ContactPointState<double> &old_state,
          const double                     cell_diameter) const
    {
      return compliance(cell_diameter).force(state, old_state, cell_diameter);
    }

    ContactPointTangent
    tangent(const ContactPointState<> &state,
            const ContactPointState<> &old_state,
            const double               cell_diameter) const
    {
      return compliance(cell_diameter).tangent(state, old_state, cell_diameter);
    }

    int
    branch(const ContactPointState<> &state,
           const ContactPointState<> &old_state,
           const double               cell_diameter) const
    {
      return compliance(cell_diameter).branch(state, old_state, cell_diameter);
    }

    double
    potential(const ContactPointState<> &state,
              const double               cell_diameter) const
    {
      return compliance(cell_diameter).potential(state, cell_diameter);
    }

  private:
    ImprovedNormalCompliance
    compliance(const double cell_diameter) const
    {
      return {{CompliancePotential{stiffness / cell_diameter, 2.}}};
    }
  };

  /// The law at corners beside a constraint with r_0 = @p stiffness (Pa). At an instant there
  /// is no change over which a pressure could be a quotient: there it is that of penalty.
  inline std::unique_ptr<ContactLaw>
  make_corner_law(const double stiffness, const bool acts_over_step)
  {
    if (acts_over_step)
      return std::make_unique<ContactLawImplementation<CornerCompliance>>(
        CornerCompliance{stiffness});
    return std::make_unique<ContactLawImplementation<Penalty>>(
      Penalty{1. / stiffness});
  }
} // namespace Ricochet

#endif
