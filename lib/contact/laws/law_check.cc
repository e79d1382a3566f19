// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/laws/law_check.h>

#include <algorithm>
#include <cmath>
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

    /// Quotients of differences are right to a part in a thousand, unless the law bends within
    /// a ten-thousandth of the gap.
    bool
    differ(const double a, const double b)
    {
      return !(std::abs(a - b) <= 1e-3 * std::max(std::abs(a), std::abs(b)));
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
    for (const double part : {1e-3, 1e-2, 1e-1})
      {
        const double gap = -part * cell_diameter, step = 1e-4 * gap;
        // Two-point laws from the same gap.
        const auto force = [&](const double new_gap) {
          return law.force(at(new_gap), at(gap), cell_diameter).gap;
        };
        const auto potential = [&](const double new_gap) {
          return law.potential(at(new_gap), cell_diameter);
        };
        const double here  = force(gap);
        const double slope = law.tangent(at(gap), at(gap), cell_diameter)[0][0];
        const double work =
          (potential(gap + step) - potential(gap - step)) / (2. * step);
        const double change =
          (force(gap + step) - force(gap - step)) / (2. * step);
        // A steep law may overflow, or end, at such penetrations.
        if (!std::isfinite(here) || !std::isfinite(slope) ||
            !std::isfinite(work) || !std::isfinite(change))
          continue;
        if (of_gap_alone && traits.has_potential && differ(here, work))
          refuse(name,
                 gap,
                 "force() is " + to_text(here) +
                   ", and the derivative of potential() is " + to_text(work) +
                   " (a pressure p is the force -p)");
        if (traits.takes_friction && here > 0.)
          refuse(name,
                 gap,
                 "force() is " + to_text(here) +
                   ", a pressure below zero, which friction cannot take");
        if (differ(slope, change))
          refuse(name,
                 gap,
                 "tangent() is " + to_text(slope) +
                   ", and the derivative of force() is " + to_text(change));
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
