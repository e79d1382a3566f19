// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_constraints_h
#define ricochet_solvers_constraints_h

#include <base/types.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/affine_constraints.h>

namespace Ricochet
{
  /// Prescribed displacements of a body on all ranks. They are homogeneous: iterates
  /// begin with the prescribed values, and Newton's updates are zero there.
  using Constraints = dealii::AffineConstraints<double>;

  /// Unknowns that are constrained, of those that are @p owned.
  dealii::IndexSet
  constrained_indices(const Constraints      &constraints,
                      const dealii::IndexSet &owned);

  /**
   * Make rows and columns of constrained unknowns zero, with @p diagonal on the diagonal.
   * A symmetric matrix stays so. Solutions are those with cleared rows alone if the
   * right-hand side is zero there, as it is in homogeneous constraints.
   *
   * The function acts on assembled matrices, since the residual needs the forces in
   * these rows (reactions), and linear bodies have one matrix for both. deal.II
   * eliminates columns of its own matrices only (MatrixTools::apply_boundary_values()).
   */
  void
  eliminate(const Constraints &constraints,
            Matrix            &matrix,
            const double       diagonal = 1.);
} // namespace Ricochet

#endif
