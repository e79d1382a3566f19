// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/error_bars.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  namespace
  {
    const RunResult *
    find(const std::vector<RunResult> &results, const std::string &name)
    {
      const auto found = std::find_if(results.begin(),
                                      results.end(),
                                      [&](const RunResult &result) {
                                        return result.name == name;
                                      });
      return found == results.end() ? nullptr : &*found;
    }

    /// Set order and bar from @p levels of the same number.
    void
    estimate(const std::array<const RunResult *, 3> &levels, ErrorBar &result)
    {
      constexpr double factor = 3.;
      const auto      &values = result.values;
      const double     d1 = values[1] - values[0], d2 = values[2] - values[1];
      if (!std::isfinite(d1) || !std::isfinite(d2))
        {
          result.why_none = "it does not exist in each run";
          return;
        }
      const double round_off =
        1e-10 * std::max(std::abs(values[0]), std::abs(values[2]));
      const double least  = 2. * std::max(levels[0]->resolution, round_off);
      const double change = std::max(std::abs(d1), std::abs(d2));
      const auto   spike  = [&](const unsigned int k) {
        return std::abs(levels[k]->value - levels[k]->of_means);
      };
      // Values that alternate have none, and changes that are too small to be known.
      const double least_change = std::max(levels[0]->resolution, round_off);
      if (d1 * d2 > 0. && std::min(std::abs(d1), std::abs(d2)) > least_change)
        result.order = std::log2(d1 / d2);
      // Waves with fronts have no high order, whatever two changes say by chance.
      const double ratio = std::min(std::abs(d1) / std::abs(d2), 64.);
      if (spike(2) > std::max(.5 * spike(0), 1e-3 * std::abs(values[2])))
        result.why_none = "an oscillation from step to step";
      else if (change <= least)
        result.bar = least + factor * change;
      else if (!(ratio >= least_ratio) ||
               (std::isfinite(levels[0]->of_means) && d1 * d2 < 0.))
        result.why_none = "no order observed";
      else
        result.bar =
          std::max(least,
                   factor *
                     std::max(std::abs(d1),
                              std::abs(d1 + d2) + std::abs(d2) / (ratio - 1.)));
    }
  } // namespace



  std::vector<ErrorBar>
  error_bars(const std::array<std::vector<RunResult>, 3> &results)
  {
    std::vector<ErrorBar> bars;
    for (const RunResult &first : results[0])
      {
        const std::array<const RunResult *, 3> levels = {
          {&first, find(results[1], first.name), find(results[2], first.name)}};
        if (!levels[1] || !levels[2])
          continue;
        ErrorBar bar{first.name,
                     first.unit,
                     {{first.value, levels[1]->value, levels[2]->value}}};
        estimate(levels, bar);
        bars.push_back(bar);
      }
    return bars;
  }
} // namespace Ricochet
