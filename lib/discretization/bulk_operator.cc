// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/bulk_operator.h>
#include <solvers/body_matrix.h>

namespace Ricochet
{
  using namespace dealii;

  void
  BulkOperator::add_viscous_tangent(const double factor,
                                    const Vector & /*rate_origin*/,
                                    const Vector & /*solution*/,
                                    const double rate_time,
                                    Matrix      &tangent) const
  {
    AssertThrow(is_linear() && is_viscous(),
                ExcMessage("This body has no viscous tangent."));
    for (const MatrixTerm &term : viscous_tangent_terms(factor, rate_time))
      term.matrix->add_to(term.weight, tangent);
  }
} // namespace Ricochet
