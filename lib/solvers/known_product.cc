// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/known_product.h>

#include <algorithm>

namespace Ricochet
{
  const Vector &
  KnownProduct::with(const Vector &vector) const
  {
    const unsigned int n      = vector.locally_owned_size();
    const double      *values = local_values(vector);
    // Compared to the last digit, so that results do not depend on the cache.
    const bool is_known = product.size() == vector.size() &&
      std::equal(values, values + n, local_values(known));
    if (dealii::Utilities::MPI::min(is_known ? 1 : 0,
                                    vector.get_mpi_communicator()) == 1)
      return product;
    copy_values(vector, known);
    if (product.size() != vector.size())
      product.reinit(vector);
    matrix.vmult(product, known);
    return product;
  }
} // namespace Ricochet
