// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_bulk_of_parts_h
#define ricochet_discretization_bulk_of_parts_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/material.h>
#include <solvers/body_matrix.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /// The operators of a body with these @p materials of its parts, connected or not: a
  /// LinearBulk for those with small strains and a HyperelasticBulk for those with large ones,
  /// each without stress in the other parts. One of them if all parts are of its kind.
  template <int dim>
  std::vector<std::unique_ptr<BulkOperator>>
  bulk_of_parts(const Body<dim>                  &body,
                const std::vector<Material<dim>> &materials,
                const MatrixStorage               storage);
} // namespace Ricochet

#endif
