// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_functional_products_h
#define ricochet_solvers_functional_products_h

#include <solvers/functionals.h>

#include <map>

namespace Ricochet
{
  /**
   * Products f_i . f_j of the functionals of a rank, as sparse vectors: what a force
   * along one of them has along the others. They are made when asked for.
   */
  class FunctionalProducts
  {
  public:
    /// @param functionals have to outlive this.
    explicit FunctionalProducts(const Functionals &functionals)
      : functionals(functionals)
    {}

    /// The products of functional @p f with all that have one.
    const FunctionalRow &
    of(const unsigned int f);

    /// The sum of rows of products with the entries of @p row.
    FunctionalRow
    times(const FunctionalRow &row);

  private:
    const Functionals &functionals;
    // Functionals with an entry for an unknown, and that entry.
    std::map<dealii::types::global_dof_index, FunctionalRow> at_unknown;
    std::map<unsigned int, FunctionalRow>                    known;
  };
} // namespace Ricochet

#endif
