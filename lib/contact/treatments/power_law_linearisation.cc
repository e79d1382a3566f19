// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/power_law_linearisation.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  double
  linearisation_gap(const ContactLaw          &law,
                    const ContactPointState<> &last,
                    const ContactPointState<> &now,
                    const ContactPointState<> &old_state,
                    const double               cell_diameter,
                    const double               body_stiffness)
  {
    // The pressure that the last linearisation predicts at the new gap.
    const double predicted = -law.force(last, old_state, cell_diameter).gap -
      law.tangent(last, old_state, cell_diameter)[0][0] * (now.gap - last.gap);

    // The gap where the law meets the body's line through gap and predicted
    // pressure: excess(gap) = law's pressure - body's pressure falls with the
    // gap. The law's pressure being never negative and falling, the zero lies
    // between the gap and the point where the body alone would compensate the
    // excess.
    ContactPointState<> trial  = now;
    const auto          excess = [&]() {
      return -law.force(trial, old_state, cell_diameter).gap - predicted -
        body_stiffness * (trial.gap - now.gap);
    };
    double       value = excess();
    const double far   = now.gap + value / body_stiffness;
    double       low   = std::min(now.gap, far);
    double       high  = std::max(now.gap, far);
    const double close = 1e-3 * (high - low);
    for (unsigned int k = 0; k < 60 && high - low > close; ++k)
      {
        (value > 0. ? low : high) = trial.gap;
        const double slope =
          -law.tangent(trial, old_state, cell_diameter)[0][0] - body_stiffness;
        const double step = -value / slope;
        if (std::abs(step) < close)
          break;
        trial.gap += step;
        if (!(trial.gap > low && trial.gap < high))
          trial.gap = .5 * (low + high);
        value = excess();
      }
    return trial.gap;
  }
} // namespace Ricochet
