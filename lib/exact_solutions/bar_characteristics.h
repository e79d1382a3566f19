// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_exact_solutions_bar_characteristics_h
#define ricochet_exact_solutions_bar_characteristics_h

#include <deal.II/base/function.h>

#include <vector>

namespace Ricochet
{
  /**
   * Exact solutions of the unit bar with unit wave speed, whose ends are free,
   * held, or kept from moving outwards by an obstacle (Signorini's condition),
   * with a constant initial strain and velocity.
   *
   * The Riemann invariants u_t + u_x and u_t - u_x are constant along the
   * characteristics, so that both are constant on unit intervals of time at the
   * ends, as long as gaps close at integer times. Then an end with a gap is
   * free over an interval, and a closed end stays closed exactly if it would
   * otherwise move into the obstacle. The benchmarks 1D-SD and 1D-SS of paper
   * C, section 4, are of this kind.
   */
  class BarCharacteristics : public dealii::Function<1>
  {
  public:
    /// Condition at an end of the bar.
    struct End
    {
      /// Zero displacement; or an obstacle at a distance.
      bool held = false;
      /// Gap at time 0 (m), for an end that is not held.
      double initial_gap = 0.;
    };

    /**
     * @param left_displacement u(0, 0) (m).
     * @param strain u_x at time 0.
     * @param velocity u_t at time 0 (m/s).
     * @param final_time largest time of set_time() (s).
     */
    BarCharacteristics(const double left_displacement,
                       const double strain,
                       const double velocity,
                       const End   &left,
                       const End   &right,
                       const double final_time);

    /// u(x, t) (m) at the time of set_time().
    double
    value(const dealii::Point<1> &x,
          const unsigned int      component = 0) const override;

    /// u_x(x, t); at a jump, the value on its right.
    dealii::Tensor<1, 1>
    gradient(const dealii::Point<1> &x,
             const unsigned int      component = 0) const override;

    /// u_t(x, t) (m/s) at the time of set_time().
    double
    velocity(const double x) const;

    /// Pressure -u_x on an end (0 left, 1 right) at the time of set_time() (Pa
    /// for unit modulus).
    double
    end_pressure(const unsigned int end) const;

  private:
    /// u_t + u_x and u_t - u_x at @p x and the time of set_time().
    std::pair<double, double>
    invariants(const double x) const;

    const double initial_left_displacement;
    const double initial_left_going, initial_right_going;
    // On the interval [k, k+1) of time: the invariant u_t - u_x that leaves the
    // left end, u_t + u_x that leaves the right end, and the displacement of
    // the left end at time k.
    std::vector<double> from_left, from_right, left_displacement;
  };
} // namespace Ricochet

#endif
