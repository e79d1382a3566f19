// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/condensed_system.h>

namespace Ricochet
{
  double
  CondensedSystem::norm_of_functionals(const std::vector<double> &coefficients,
                                       const Vector              *scaling,
                                       Vector                    &work)
  {
    if (!functional_norm)
      functional_norm.emplace(acts_through().functionals,
                              body_matrix().locally_owned_range_indices(),
                              body_matrix().get_mpi_communicator());
    if (functional_norm->is_known())
      return functional_norm->of_sum(coefficients, scaling);
    work = 0.;
    add_functionals(coefficients, work);
    if (scaling)
      entries(work).array() *= entries(*scaling).array();
    return l2_norm(work);
  }
} // namespace Ricochet
