// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/force_mixing.h>

#include <deal.II/base/mpi.h>

#include <numeric>
#include <algorithm>
#include <array>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  void
  ForceMixing::restart()
  {
    n_changes = 0;
    has_last  = false;
  }



  namespace
  {
    // So many entries at once stay near while all columns pass.
    constexpr std::size_t stretch = 2048;
  } // namespace



  std::vector<double>
  ForceMixing::products(const double *values) const
  {
    std::vector<double> result(n_changes, 0.);
    const std::size_t   n = last_residual.size();
    for (std::size_t begin = 0; begin < n; begin += stretch)
      for (unsigned int k = 0; k < n_changes; ++k)
        {
          const std::size_t end = std::min(n, begin + stretch);
          // Several sums do not wait for each other.
          std::array<double, 4> sums{};
          std::size_t           i = begin;
          for (; i + 4 <= end; i += 4)
            for (unsigned int s = 0; s < 4; ++s)
              sums[s] += values[i + s] * changes[k][i + s];
          for (; i < end; ++i)
            sums[0] += values[i] * changes[k][i];
          result[k] += (sums[0] + sums[1]) + (sums[2] + sums[3]);
        }
    Utilities::MPI::sum(result, communicator, result);
    return result;
  }



  void
  ForceMixing::add(const std::vector<double> &factors,
                   const std::vector<Column> &columns,
                   double                    *values) const
  {
    const std::size_t n = last_residual.size();
    for (std::size_t begin = 0; begin < n; begin += stretch)
      for (unsigned int k = 0; k < n_changes; ++k)
        for (std::size_t i = begin; i < std::min(n, begin + stretch); ++i)
          values[i] += factors[k] * columns[k][i];
  }



  void
  ForceMixing::next(const Vector &residual, Vector &step)
  {
    const double     *r = residual.trilinos_vector()[0];
    double           *s = step.trilinos_vector()[0];
    const std::size_t n = residual.locally_owned_size();
    communicator        = residual.get_mpi_communicator();
    if (has_last)
      {
        if (n_changes == n_kept)
          {
            // Without the oldest one the others stay orthogonal.
            std::rotate(changes.begin(), changes.begin() + 1, changes.end());
            std::rotate(steps.begin(), steps.begin() + 1, steps.end());
            --n_changes;
          }
        if (changes.size() == n_changes)
          {
            changes.emplace_back();
            steps.emplace_back();
          }
        // The last residual and step become the change and its step.
        for (std::size_t i = 0; i < n; ++i)
          last_residual[i] = r[i] - last_residual[i];
        std::vector<double> parts = products(last_residual.data());
        for (double &part : parts)
          part = -part;
        add(parts, changes, last_residual.data());
        add(parts, steps, last_step.data());
        const double square =
          Utilities::MPI::sum(std::inner_product(last_residual.begin(),
                                                 last_residual.end(),
                                                 last_residual.begin(),
                                                 0.),
                              communicator);
        if (square > 0.)
          {
            const double scale = 1. / std::sqrt(square);
            changes[n_changes].resize(n);
            steps[n_changes].resize(n);
            for (std::size_t i = 0; i < n; ++i)
              {
                changes[n_changes][i] = scale * last_residual[i];
                steps[n_changes][i]   = scale * last_step[i];
              }
            ++n_changes;
          }
      }
    last_residual.assign(r, r + n);
    std::vector<double> parts = products(r);
    for (std::size_t i = 0; i < n; ++i)
      s[i] = -r[i];
    add(parts, changes, s);
    for (double &part : parts)
      part = -part;
    add(parts, steps, s);
    last_step.assign(s, s + n);
    has_last = true;
  }
} // namespace Ricochet
