// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_closing_h
#define ricochet_contact_laws_closing_h

#include <contact/laws/contact_law.h>

#include <optional>

namespace Ricochet
{
  /// The tangent of @p law when a point with this h_T is open.
  ContactPointTangent
  open_tangent(const ContactLaw &law, const double cell_diameter);

  /**
   * Change of the tangent of a law when a point closes: a number times
   * test trial^T, where test and trial are directions in the space of gap, stress
   * pressure and multiplier that depend on the law and h_T only. The number can be
   * read off one entry.
   */
  struct Closing
  {
    unsigned int         row = 0, column = 0;
    dealii::Tensor<1, 3> test, trial;
  };

  /// None if the law's tangent changes by more than one direction, or is not finite in
  /// closed points.
  std::optional<Closing>
  closing_directions(const ContactLaw &law, const double cell_diameter);
} // namespace Ricochet

#endif
