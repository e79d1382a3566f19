// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_flexible_gmres_h
#define ricochet_solvers_flexible_gmres_h

#include <base/types.h>

#include <deal.II/base/config.h>

#include <deal.II/lac/solver_gmres.h>

namespace Ricochet
{
  /// Settings of the flexible GMRES for preconditioners in single precision: its
  /// solution is a combination of the preconditioned vectors themselves, with their
  /// rounding.
  ///
  /// The modified Gram-Schmidt process, the only one in deal.II before 9.6. Its delayed
  /// classical one, the default since, corrects a vector after the preconditioner has
  /// been applied to it and assumes that the preconditioner is linear to all digits:
  /// with rounding in single precision solutions had residuals of 3e-8 for a tolerance
  /// of 1e-11.
  inline dealii::SolverFGMRES<Vector>::AdditionalData
  flexible_gmres_settings()
  {
    constexpr unsigned int basis_size = 40;
#if DEAL_II_VERSION_GTE(9, 6, 0)
    return dealii::SolverFGMRES<Vector>::AdditionalData(
      basis_size,
      dealii::LinearAlgebra::OrthogonalizationStrategy::modified_gram_schmidt);
#else
    return dealii::SolverFGMRES<Vector>::AdditionalData(basis_size);
#endif
  }
} // namespace Ricochet

#endif
