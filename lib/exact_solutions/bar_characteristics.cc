// SPDX-License-Identifier: LGPL-2.1-or-later
#include <exact_solutions/bar_characteristics.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Times a little below an integer by round-off belong to the interval that
    /// begins there.
    constexpr double round_off = 1e-9;
  } // namespace



  BarCharacteristics::BarCharacteristics(const double left_displacement_0,
                                         const double strain,
                                         const double velocity,
                                         const End   &left,
                                         const End   &right,
                                         const double final_time)
    : initial_left_displacement(left_displacement_0)
    , initial_left_going(velocity + strain)
    , initial_right_going(velocity - strain)
  {
    // Follow both ends from one unit of time to the next. A free end reflects
    // the invariant with its sign, a held end against it; the velocity of a
    // free end is the invariant itself.
    double left_gap  = left.initial_gap;
    double right_gap = right.initial_gap;
    double u_left    = left_displacement_0;
    for (unsigned int k = 0; k < final_time + 2.; ++k)
      {
        const double to_left  = k == 0 ? initial_left_going : from_right[k - 1];
        const double to_right = k == 0 ? initial_right_going : from_left[k - 1];

        // The left obstacle is on the left: moving left (velocity < 0) closes
        // the gap.
        const bool left_closed =
          left.held || (std::abs(left_gap) < round_off && to_left <= 0.);
        const bool right_closed =
          right.held || (std::abs(right_gap) < round_off && to_right >= 0.);
        from_left.push_back(left_closed ? -to_left : to_left);
        from_right.push_back(right_closed ? -to_right : to_right);
        left_displacement.push_back(u_left);
        if (!left_closed)
          {
            u_left += to_left;
            left_gap += to_left;
          }
        if (!right_closed)
          right_gap -= to_right;
        Assert(left.held || left_gap > -round_off, ExcInternalError());
        Assert(right.held || right_gap > -round_off, ExcInternalError());
      }
  }



  std::pair<double, double>
  BarCharacteristics::invariants(const double x) const
  {
    // u_t + u_x travels to the left, from the right end or from time 0.
    const double t              = get_time();
    const double from_right_end = t - (1. - x) + round_off;
    const double from_left_end  = t - x + round_off;
    const auto   interval       = [](const double time) {
      return static_cast<unsigned int>(std::floor(time));
    };
    return {from_right_end >= 0. ? from_right.at(interval(from_right_end))
                                 : initial_left_going,
            from_left_end >= 0. ? from_left.at(interval(from_left_end))
                                : initial_right_going};
  }



  double
  BarCharacteristics::velocity(const double x) const
  {
    const auto [left_going, right_going] = invariants(x);
    return .5 * (left_going + right_going);
  }



  Tensor<1, 1>
  BarCharacteristics::gradient(const Point<1> &x, const unsigned int) const
  {
    const auto [left_going, right_going] = invariants(x[0]);
    Tensor<1, 1> gradient;
    gradient[0] = .5 * (left_going - right_going);
    return gradient;
  }



  double
  BarCharacteristics::value(const Point<1> &x, const unsigned int) const
  {
    // Displacement of the left end, then the integral of the strain, which is
    // constant between the two characteristics that leave the ends at integer
    // times.
    const double       t        = get_time() + round_off;
    const unsigned int k        = static_cast<unsigned int>(std::floor(t));
    const double       fraction = get_time() - k;
    double             u = left_displacement.at(k) + velocity(0.) * fraction;

    std::vector<double> breaks = {0., fraction, 1. - fraction, x[0]};
    std::sort(breaks.begin(), breaks.end());
    for (unsigned int i = 0; i + 1 < breaks.size(); ++i)
      if (breaks[i] >= 0. && breaks[i + 1] <= x[0])
        u += (breaks[i + 1] - breaks[i]) *
          gradient(Point<1>(.5 * (breaks[i] + breaks[i + 1])))[0];
    return u;
  }



  double
  BarCharacteristics::end_pressure(const unsigned int end) const
  {
    return -gradient(Point<1>(end == 0 ? 0. : 1.))[0];
  }
} // namespace Ricochet
