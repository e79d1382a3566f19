// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_single_precision_h
#define ricochet_solvers_single_precision_h

#include <cmath>

namespace Ricochet
{
  /// Divisor of values, of which @p largest is the largest, for single precision:
  /// the power of two at or below it, which causes no rounding; 1 where it is
  /// zero or not finite.
  inline double
  size_for_single_precision(const double largest)
  {
    return largest > 0. && std::isfinite(largest)
      ? std::ldexp(1., std::ilogb(largest))
      : 1.;
  }
} // namespace Ricochet

#endif
