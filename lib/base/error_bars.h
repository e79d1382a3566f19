// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_error_bars_h
#define ricochet_base_error_bars_h

#include <array>
#include <limits>
#include <string>
#include <vector>

namespace Ricochet
{
  /// A number of the summary of a run.
  struct RunResult
  {
    /// Its place in `summary.json`: "energy.lost.contact".
    std::string name;
    std::string unit;
    /// Not a number where it does not exist.
    double value;
    /// For an extreme over time, that of means over nine steps: the difference stays, however short the
    /// steps, where values oscillate with them. Otherwise not a number.
    double of_means = std::numeric_limits<double>::quiet_NaN();
    /// The number is known to this only, as an energy is to round-off, and a time to the length of a
    /// step, of which there may be two: that in which it is and that of the row.
    double resolution = 0.;
  };

  /// A number with its bar: the exact value is expected to be within value +- bar.
  struct ErrorBar
  {
    std::string name, unit;
    /// With cells and steps as they are, halved, and halved again.
    std::array<double, 3> values;
    /// Observed order of convergence; not a number where values alternate, or hardly change.
    double order = std::numeric_limits<double>::quiet_NaN();
    /// Not a number where there is none, for the reason #why_none.
    double      bar      = std::numeric_limits<double>::quiet_NaN();
    std::string why_none = {};
  };

  /**
   * Bars from runs whose cells and steps are halved once and twice. Let d1 and d2 be the changes
   * of a number at the first and the second halving, and R = |d1| / |d2|, so that log2 R is the observed
   * order. As a sum of a geometric series the distance to the limit is d1 + d2 + d2 / (R - 1)
   * (Richardson's extrapolation); the bar is three times that, and at least three times |d1|.
   * The factor is that of Roache's grid convergence index for two meshes (1994); here it covers the
   * orders of waves with fronts, which are low and not the same at each halving
   * (doc/certificate.md has the test against exact solutions).
   *
   * There is no bar where R is below #least_ratio, and none for an extreme whose difference to
   * that of means over nine steps is not halved at least: it belongs to an oscillation with the
   * steps. An extreme has to go to its limit from one side, too. Numbers that are known to a length of time only have a bar of two of them at least, and also
   * where they change by less than that.
   *
   * @param results of the three runs; numbers that are not in all of them are left out.
   */
  std::vector<ErrorBar>
  error_bars(const std::array<std::vector<RunResult>, 3> &results);

  /// Factor of the changes below which no order is observed: an order of 0.14.
  constexpr double least_ratio = 1.1;
} // namespace Ricochet

#endif
