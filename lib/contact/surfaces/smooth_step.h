// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_smooth_step_h
#define ricochet_contact_surfaces_smooth_step_h

namespace Ricochet
{
  /// The function sigma that rises from 0 at -1 to 1 at 1 with continuous slope, 0 and 1
  /// outside, and sigma(x) + sigma(-x) = 1.
  namespace SmoothStep
  {
    template <typename Number>
    Number
    value(const Number &x)
    {
      if (x <= -1.)
        return Number(0.);
      if (x >= 1.)
        return Number(1.);
      return Number(.5 + x * (.75 - .25 * x * x));
    }

    /// The change of sigma over that of x, without a quotient where both are between
    /// -1 and 1.
    template <typename Number>
    Number
    quotient(const double old_x, const Number &new_x)
    {
      if ((old_x <= -1. && new_x <= -1.) || (old_x >= 1. && new_x >= 1.))
        return Number(0.);
      if (old_x >= -1. && old_x <= 1. && new_x >= -1. && new_x <= 1.)
        return Number(.75 -
                      .25 * (old_x * old_x + old_x * new_x + new_x * new_x));
      return Number((value(new_x) - value(old_x)) / (new_x - old_x));
    }
  } // namespace SmoothStep
} // namespace Ricochet

#endif
