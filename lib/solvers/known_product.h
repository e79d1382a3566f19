// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_known_product_h
#define ricochet_solvers_known_product_h

#include <base/types.h>
#include <solvers/body_matrix.h>

namespace Ricochet
{
  /**
   * Product of a matrix with a vector, kept for the next call with the same vector, so
   * that several callers share one product.
   */
  class KnownProduct
  {
  public:
    /// @param matrix has to outlive this.
    explicit KnownProduct(const BodyMatrix &matrix)
      : matrix(matrix)
    {}

    /// The product with @p vector, valid until the next call with another one.
    /// Collective.
    const Vector &
    with(const Vector &vector) const;

  private:
    const BodyMatrix &matrix;
    mutable Vector    known, product;
  };
} // namespace Ricochet

#endif
