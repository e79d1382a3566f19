// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/laws/closing.h>

#include <cmath>

namespace Ricochet
{
  ContactPointTangent
  open_tangent(const ContactLaw &law, const double cell_diameter)
  {
    ContactPointState<> open;
    open.gap = cell_diameter;
    return law.tangent(open, open, cell_diameter);
  }



  std::optional<Closing>
  closing_directions(const ContactLaw &law, const double cell_diameter)
  {
    ContactPointState<> open, closed;
    open.gap = cell_diameter;
    // Where it has penetrated by h_T, a steep law may overflow, and one that saturates may
    // have no slope any more: less is enough.
    ContactPointTangent change;
    double              depth = cell_diameter;
    do
      {
        closed.gap = -depth;
        change     = law.tangent(closed, open, cell_diameter) -
          open_tangent(law, cell_diameter);
        depth /= 16.;
    } while ((!std::isfinite(change.norm()) || change.norm() == 0.) &&
             depth > 1e-12 * cell_diameter);
    if (!std::isfinite(change.norm()))
      return {};
    Closing closing;
    while (closing.row < 2 && change[closing.row].norm() == 0.)
      ++closing.row;
    while (closing.column < 2 && change[closing.row][closing.column] == 0.)
      ++closing.column;
    const double entry = change[closing.row][closing.column];
    if (entry == 0.)
      return {};
    // In the same way, so that they are equal to the last digit where the law is
    // symmetric.
    for (unsigned int c = 0; c < 3; ++c)
      {
        closing.trial[c] = change[closing.row][c] / entry;
        closing.test[c]  = change[c][closing.column] / entry;
      }
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(change[c][d] -
                     entry * closing.test[c] * closing.trial[d]) >
            1e-12 * std::abs(change[c][d]))
          return {};
    return closing;
  }
} // namespace Ricochet
