// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_functionals_h
#define ricochet_solvers_functionals_h

#include <deal.II/base/types.h>

#include <utility>
#include <vector>

namespace Ricochet
{
  /// Linear functionals of the unknowns (rows of the contact Jacobian H, for
  /// example), as sparse vectors in compressed rows; those of this rank.
  struct Functionals
  {
    std::vector<std::size_t>                     begin = {0};
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          value;

    unsigned int
    size() const
    {
      return begin.size() - 1;
    }

    /// Append an entry to the present functional, until end_functional() is
    /// called.
    void
    add(const dealii::types::global_dof_index unknown, const double coefficient)
    {
      index.push_back(unknown);
      value.push_back(coefficient);
    }

    void
    end_functional()
    {
      begin.push_back(index.size());
    }

    /// Append all of @p others.
    void
    add(const Functionals &others)
    {
      const std::size_t end = index.size();
      for (unsigned int f = 0; f < others.size(); ++f)
        begin.push_back(end + others.begin[f + 1]);
      index.insert(index.end(), others.index.begin(), others.index.end());
      value.insert(value.end(), others.value.begin(), others.value.end());
    }
  };

  /// A row of a sparse matrix between functionals: numbers of columns, and
  /// values.
  using FunctionalRow = std::vector<std::pair<unsigned int, double>>;

  /// Merge entries of the @p rows of a square matrix with the same column, in
  /// ascending order, and drop those that are zero.
  void
  sum_columns(std::vector<FunctionalRow> &rows);

} // namespace Ricochet

#endif
