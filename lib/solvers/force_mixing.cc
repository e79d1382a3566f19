// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/force_mixing.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  void
  ForceMixing::restart()
  {
    n_changes = 0;
    has_last  = false;
  }



  std::vector<double>
  ForceMixing::products(const Vector &vector) const
  {
    const double       *values = vector.trilinos_vector()[0];
    const auto          n      = vector.locally_owned_size();
    std::vector<double> result(n_changes);
    for (unsigned int k = 0; k < n_changes; ++k)
      result[k] = std::inner_product(values,
                                     values + n,
                                     changes[k].trilinos_vector()[0],
                                     0.);
    Utilities::MPI::sum(result, vector.get_mpi_communicator(), result);
    return result;
  }



  void
  ForceMixing::next(const Vector &residual, Vector &step)
  {
    if (has_last)
      {
        if (n_changes == n_kept)
          {
            // drop oldest (approximately: keeps the orthogonality)
            std::rotate(changes.begin(),
                        changes.begin() + 1,
                        changes.begin() + n_changes);
            std::rotate(steps.begin(),
                        steps.begin() + 1,
                        steps.begin() + n_changes);
            --n_changes;
          }
        if (changes.size() == n_changes)
          {
            changes.emplace_back(residual);
            steps.emplace_back(residual);
          }
        Vector &change = changes[n_changes];
        Vector &way    = steps[n_changes];
        change         = residual;
        change -= last_residual;
        way = last_step;
        // Twice is enough (Giraud and others, Numer. Math. 101, 2005).
        for (unsigned int repeat = 0; repeat < 2; ++repeat)
          {
            const std::vector<double> parts = products(change);
            for (unsigned int k = 0; k < n_changes; ++k)
              {
                change.add(-parts[k], changes[k]);
                way.add(-parts[k], steps[k]);
              }
          }
        const double size = change.l2_norm();
        if (size > 0.)
          {
            change *= 1. / size;
            way *= 1. / size;
            ++n_changes;
          }
      }
    last_residual                   = residual;
    const std::vector<double> parts = products(residual);
    step                            = residual;
    step *= -1.;
    for (unsigned int k = 0; k < n_changes; ++k)
      step.add(parts[k], changes[k], -parts[k], steps[k]);
    last_step = step;
    has_last  = true;
  }
} // namespace Ricochet
