// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_power_law_linearisation_h
#define ricochet_contact_treatments_power_law_linearisation_h

#include <contact/laws/contact_law.h>

namespace Ricochet
{
  /**
   * Linearisation of a stiff power law at the gap converges slowly: from far too
   * deep a penetration, or from contact at a point that opens, Newton's method
   * reduces the error by a constant factor per iteration. So such laws are
   * linearised where they meet the body's own line: the pressure that the last
   * linearisation predicts at the new gap, and the body's stiffness.
   *
   * @param last where the law was linearised at the last iterate.
   * @param now the state of the point.
   * @param body_stiffness Pa/m
   * @return the gap at which to linearise (m).
   */
  double
  linearisation_gap(const ContactLaw          &law,
                    const ContactPointState<> &last,
                    const ContactPointState<> &now,
                    const ContactPointState<> &old_state,
                    const double               cell_diameter,
                    const double               body_stiffness);
} // namespace Ricochet

#endif
