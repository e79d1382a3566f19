// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/laws/law_check.h>

#include <cmath>
#include <functional>
#include <optional>
#include <utility>

namespace Ricochet
{
  namespace
  {
    [[noreturn]] void
    refuse(const std::string &name, const double gap, const std::string &what)
    {
      throw InputError("The contact law '" + name + "' is wrong: at the gap " +
                       to_text(gap) + " " + what + ".");
    }

    bool
    differ(const double a, const double b)
    {
      return !(std::abs(a - b) <= 1e-3 * (std::abs(a) + std::abs(b)));
    }

    /// The derivative of a @p function of the gap, by a quotient of differences; nothing at a kink,
    /// where both sides differ, where a larger step says something else, and where it is not
    /// finite.
    std::optional<double>
    derivative_of(const std::function<double(const double)> &function,
                  const double                               gap)
    {
      const double step = 1e-4 * std::abs(gap), here = function(gap);
      const auto   by_step = [&](const double h) {
        return (function(gap + h) - function(gap - h)) / (2. * h);
      };
      const double left  = (here - function(gap - step)) / step,
                   right = (function(gap + step) - here) / step,
                   small = by_step(step), large = by_step(10. * step);
      const bool is_known = std::isfinite(small) && std::isfinite(large) &&
        std::abs(right - left) <= 1e-2 * (std::abs(right) + std::abs(left)) &&
        !differ(small, large);
      return is_known ? std::optional<double>(small) : std::nullopt;
    }
  } // namespace



  void
  check_law(const ContactLaw  &law,
            const std::string &name,
            const double       cell_diameter)
  {
    const ContactLawTraits traits = law.traits();
    const bool of_gap_alone = !traits.uses_stress && !traits.needs_multiplier;
    const auto at           = [](const double gap) {
      ContactPointState<> state;
      state.gap = gap;
      return state;
    };
    std::optional<std::pair<int, double>> slope_of_branch;
    // Penetrations, and gaps, where only some laws act.
    for (const double part :
         {-1.3e-3, -1.1e-2, -9.3e-2, 1.3e-3, 1.1e-2, 9.3e-2})
      {
        const double gap = part * cell_diameter;
        // Two-point laws from the same gap.
        const auto force = [&](const double new_gap) {
          return law.force(at(new_gap), at(gap), cell_diameter).gap;
        };
        const double here = force(gap);
        // A steep law may overflow, or end, at such penetrations.
        if (!std::isfinite(here))
          continue;
        if ((traits.takes_friction || !traits.piecewise_linear) && here > 0.)
          refuse(name,
                 gap,
                 "force() is " + to_text(here) +
                   ", a pressure below zero, while traits() says that friction "
                   "may take it, or that the law is not piecewise linear");
        if (of_gap_alone && traits.has_potential)
          if (const auto work = derivative_of(
                [&](const double new_gap) {
                  return law.potential(at(new_gap), cell_diameter);
                },
                gap);
              work && differ(here, *work))
            refuse(name,
                   gap,
                   "force() is " + to_text(here) +
                     ", while the derivative of potential() is " +
                     to_text(*work) + " (a pressure p is the force -p)");
        const auto change = derivative_of(force, gap);
        if (!change)
          continue;
        const double slope = law.tangent(at(gap), at(gap), cell_diameter)[0][0];
        if (differ(slope, *change))
          refuse(name,
                 gap,
                 "tangent() is " + to_text(slope) +
                   ", while the derivative of force() is " + to_text(*change));
        const int branch = law.branch(at(gap), at(gap), cell_diameter);
        if (traits.piecewise_linear && slope_of_branch &&
            slope_of_branch->first == branch &&
            differ(slope_of_branch->second, slope))
          refuse(name,
                 gap,
                 "the slope is " + to_text(slope) + " and elsewhere " +
                   to_text(slope_of_branch->second) +
                   ", while traits() says that the law is piecewise linear");
        slope_of_branch = {branch, slope};
      }
  }
} // namespace Ricochet
