// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_closing_condition_h
#define ricochet_contact_treatments_closing_condition_h

namespace Ricochet
{
  /// The condition that a constraint imposes on active points.
  enum class ClosingCondition
  {
    /// Signorini's condition at the end of the step: gap = 0.
    signorini,
    /// Persistent contact (B (3.7), 5.3): where the predictor of the mean gap,
    /// gap_old + dt/2 (rate of the step before), is not positive, the gap does
    /// not change. The work of the reaction is exactly zero.
    persistent,
    /// Ayyad and Barboteu's two steps: first Signorini's condition on the mean
    /// gap of the step; then, in the nodes that it has found in contact, the
    /// gap does not change, and the others are free.
    two_step
  };
} // namespace Ricochet

#endif
