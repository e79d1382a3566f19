// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_functional_products_h
#define ricochet_solvers_functional_products_h

#include <solvers/functionals.h>

#include <map>

namespace Ricochet
{
  /**
   * Products h_i . h_j of the rows of the contact Jacobian (functionals) of a rank:
   * the components of a force along one row in the others. They are computed when
   * needed.
   */
  class FunctionalProducts
  {
  public:
    /// @param functionals have to outlive this.
    explicit FunctionalProducts(const Functionals &functionals)
      : functionals(functionals)
    {}

    /// The products of row @p f with all rows for which they are not zero.
    const FunctionalRow &
    of(const unsigned int f);

    /// The sum of the rows of products, weighted with the entries of @p row.
    FunctionalRow
    times(const FunctionalRow &row);

  private:
    const Functionals &functionals;
    // Rows with an entry for an unknown, and that entry.
    std::map<dealii::types::global_dof_index, FunctionalRow> at_unknown;
    std::map<unsigned int, FunctionalRow>                    known;
  };
} // namespace Ricochet

#endif
