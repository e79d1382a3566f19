// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_iteration_budget_h
#define ricochet_solvers_iteration_budget_h

#include <cmath>

namespace Ricochet
{
  /// Limit of the iterations with a preconditioner that was set up for the first system
  /// of a stage, beyond which the next system gets a new one.
  class IterationBudget
  {
  public:
    /// The first system of a stage took @p n iterations (-1: did not converge) to a
    /// residual of @p tolerance, relative to the right hand side.
    void
    begin(const int n, const double tolerance)
    {
      first_per_decade = n / decades(tolerance);
    }

    /// Whether @p n iterations for another one are too many.
    bool
    is_exceeded(const int n, const double tolerance) const
    {
      return n < 0 || n > 5 + 2. * decades(tolerance) * first_per_decade;
    }

  private:
    static double
    decades(const double tolerance)
    {
      return -std::log10(tolerance);
    }

    double first_per_decade = 0.;
  };
} // namespace Ricochet

#endif
