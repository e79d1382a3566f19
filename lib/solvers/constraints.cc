// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/constraints.h>
#include <solvers/matrix_entries.h>

#include <vector>

namespace Ricochet
{
  using namespace dealii;

  IndexSet
  constrained_indices(const Constraints &constraints, const IndexSet &owned)
  {
    IndexSet indices(owned.size());
    for (const auto &line : constraints.get_lines())
      if (owned.is_element(line.index))
        indices.add_index(line.index);
    indices.compress();
    return indices;
  }



  void
  eliminate(const Constraints &constraints,
            Matrix            &matrix,
            const double       diagonal)
  {
    if (constraints.n_constraints() == 0)
      return;
    const MatrixEntries entries(matrix);
    double *const       values = entry_values(matrix);
    std::vector<bool>   is_constrained(entries.n_columns());
    for (unsigned int c = 0; c < entries.n_columns(); ++c)
      is_constrained[c] = constraints.is_constrained(entries.column_index(c));
    for (unsigned int r = 0; r < entries.n_rows(); ++r)
      {
        const auto index = entries.row_index(r);
        const bool own   = constraints.is_constrained(index);
        for (int k = entries.begin[r]; k < entries.begin[r + 1]; ++k)
          if (own || is_constrained[entries.column[k]])
            values[k] = 0.;
        if (!own)
          continue;
        const int k = entries.find(r, entries.column_number(index));
        if (k >= 0)
          values[k] = diagonal;
      }
  }
} // namespace Ricochet
