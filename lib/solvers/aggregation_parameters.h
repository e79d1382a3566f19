// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_aggregation_parameters_h
#define ricochet_solvers_aggregation_parameters_h

#include <solvers/coarse_space.h>

#include <Teuchos_ParameterList.hpp>

#include <vector>

namespace Ricochet
{
  /// The rigid body modes of @p space in the form that ML takes: mode by mode,
  /// the owned entries.
  std::vector<double>
  values_of_modes(const CoarseSpace &space);

  /// ML's parameters for elasticity.
  /// @param modes values_of_modes(), which must stay where they are.
  Teuchos::ParameterList
  aggregation_parameters(const CoarseSpace &space, std::vector<double> &modes);

  /// ML starts its own estimates of eigenvalues from random vectors; they have to
  /// be the same in a resumed run. To be called right before it is set up.
  void
  seed_aggregation(const unsigned int rank);
} // namespace Ricochet

#endif
