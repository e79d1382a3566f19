// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_condensed_solution_h
#define ricochet_tests_unit_condensed_solution_h

#include <solvers/contact_schur_complement.h>

namespace Ricochet
{
  /// Solve (K + H^T C H + H^T E H K) x = b by the coefficients of the rows H alone.
  inline void
  solve_condensed(ContactSchurComplement           &complement,
                  const std::vector<FunctionalRow> &change,
                  const std::vector<FunctionalRow> &excess_change,
                  const Vector                     &right_hand_side,
                  Vector                           &solution)
  {
    const unsigned int  n = complement.n_rows();
    std::vector<double> values(n), coefficients(n, 0.), z(n);
    complement.begin(right_hand_side);
    complement.observe(values);
    for (double &value : values)
      value = -value;
    const auto along = complement.along_rows(right_hand_side);
    for (unsigned int f = 0; f < n; ++f)
      for (const auto &[g, value] : excess_change[f])
        coefficients[complement.place(f)] += value * along[g];
    complement.set_contact(change, excess_change);
    complement.solve_contact(coefficients, values);
    for (unsigned int f = 0; f < n; ++f)
      z[f] = coefficients[complement.place(f)];
    complement.finish(z, solution);
  }
} // namespace Ricochet

#endif
