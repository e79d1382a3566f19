// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/aggregation_parameters.h>

#include <ml_MultiLevelPreconditioner.h>
#include <ml_epetra_utils.h>
#include <ml_utils.h>

namespace Ricochet
{
  std::vector<double>
  values_of_modes(const CoarseSpace &space)
  {
    std::vector<double> modes;
    for (const Vector &mode : space.rigid_body_modes)
      {
        const double *values = local_values(mode);
        modes.insert(modes.end(), values, values + mode.locally_owned_size());
      }
    return modes;
  }



  Teuchos::ParameterList
  aggregation_parameters(const CoarseSpace &space, std::vector<double> &modes)
  {
    const unsigned int     n_modes = space.rigid_body_modes.size();
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    // Smoothed aggregates need as many iterations here, more memory, and twice
    // the time to be set up.
    list.set("aggregation: damping factor", 0.);
    list.set("PDE equations", static_cast<int>(space.dim()));
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", static_cast<int>(n_modes));
    list.set("null space: vectors", modes.data());
    list.set("aggregation: type", "Uncoupled");
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", 2);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 1000);
    return list;
  }



  void
  seed_aggregation(const unsigned int rank)
  {
    ML_set_random_seed(1 + rank);
  }
} // namespace Ricochet
