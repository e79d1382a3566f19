// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/force_mixing.h>
#include <solvers/single_precision.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace Ricochet
{
  void
  ForceMixing::restart()
  {
    n_changes = 0;
    has_last  = false;
  }



  namespace
  {
    // Number of entries that stay in the cache while all columns are read.
    constexpr std::size_t stretch = 2048;

    // Eight values at once, without alignment.
    using Octet __attribute__((vector_size(32), aligned(4), may_alias)) = float;

    inline Octet
    octet(const float *values)
    {
      return *reinterpret_cast<const Octet *>(values);
    }

    double
    largest(const std::vector<double> &values)
    {
      double size = 0.;
      for (const double value : values)
        size = std::max(size, std::abs(value));
      return size;
    }

    /// @p sum += @p factors times @p columns, the first @p n_columns from entry @p
    /// begin to @p end on.
    void
    add_columns(const std::vector<std::vector<float>> &columns,
                const std::vector<float>              &factors,
                const unsigned int                     n_columns,
                const std::size_t                      begin,
                const std::size_t                      end,
                float                                 *sum)
    {
      const auto add = [&](const unsigned int k, const auto n_at_once) {
        const float *column[n_at_once];
        for (unsigned int c = 0; c < n_at_once; ++c)
          column[c] = columns[k + c].data() + begin;
        const std::size_t n = end - begin;
        std::size_t       i = 0;
        for (; i + 8 <= n; i += 8)
          {
            Octet value = octet(sum + i);
            for (unsigned int c = 0; c < n_at_once; ++c)
              value += factors[k + c] * octet(column[c] + i);
            *reinterpret_cast<Octet *>(sum + i) = value;
          }
        for (; i < n; ++i)
          for (unsigned int c = 0; c < n_at_once; ++c)
            sum[i] += factors[k + c] * column[c][i];
      };
      unsigned int k = 0;
      for (; k + 4 <= n_columns; k += 4)
        add(k, std::integral_constant<unsigned int, 4>());
      for (; k < n_columns; ++k)
        add(k, std::integral_constant<unsigned int, 1>());
    }

    float
    product(const float *a, const float *b, const std::size_t n)
    {
      // Several sums are independent of each other.
      Octet       sums[4] = {};
      std::size_t i       = 0;
      for (; i + 32 <= n; i += 32)
        for (unsigned int s = 0; s < 4; ++s)
          sums[s] += octet(a + i + 8 * s) * octet(b + i + 8 * s);
      const Octet sum    = (sums[0] + sums[1]) + (sums[2] + sums[3]);
      float       result = ((sum[0] + sum[1]) + (sum[2] + sum[3])) +
        ((sum[4] + sum[5]) + (sum[6] + sum[7]));
      for (; i < n; ++i)
        result += a[i] * b[i];
      return result;
    }
  } // namespace



  std::vector<double>
  ForceMixing::products(const std::vector<double> &vector,
                        const unsigned int         first) const
  {
    std::vector<double> result(n_changes - first, 0.);
    // Scaling to numbers of about one, whatever the units.
    const double size  = size_for_single_precision(largest(vector));
    const double scale = 1. / size;
    std::array<float, stretch> values;
    for (std::size_t begin = 0; begin < vector.size(); begin += stretch)
      {
        const std::size_t n = std::min(vector.size() - begin, stretch);
        for (std::size_t i = 0; i < n; ++i)
          values[i] = static_cast<float>(scale * vector[begin + i]);
        for (unsigned int k = first; k < n_changes; ++k)
          result[k - first] +=
            size * product(values.data(), changes[k].data() + begin, n);
      }
    return result;
  }



  void
  ForceMixing::add(const std::vector<Column> &columns,
                   const std::vector<double> &factors,
                   std::vector<double>       &vector,
                   const std::vector<double> &other_factors,
                   std::vector<double>       &other_vector) const
  {
    struct Sum
    {
      Sum(const std::vector<double> &exact, std::vector<double> &vector)
        : vector(vector)
        , size(size_for_single_precision(largest(exact)))
      {
        for (const double factor : exact)
          factors.push_back(static_cast<float>(factor / size));
      }

      std::vector<double>       &vector;
      const double               size;
      std::vector<float>         factors;
      std::array<float, stretch> sum;
    };
    std::array<Sum, 2> sums{{{factors, vector}, {other_factors, other_vector}}};
    for (std::size_t begin = 0; begin < vector.size(); begin += stretch)
      {
        const std::size_t end = std::min(vector.size(), begin + stretch);
        for (Sum &sum : sums)
          {
            sum.sum.fill(0.F);
            add_columns(columns,
                        sum.factors,
                        sum.factors.size(),
                        begin,
                        end,
                        sum.sum.data());
            for (std::size_t i = begin; i < end; ++i)
              sum.vector[i] += sum.size * sum.sum[i - begin];
          }
      }
  }



  void
  ForceMixing::next(const Vector &residual, Vector &step)
  {
    const double     *r = local_values(residual);
    const std::size_t n = residual.locally_owned_size();
    residual_now.assign(r, r + n);
    // A plain step for the part of the residual outside of the changes, and
    // former steps for the part in their span.
    step_now.resize(n);
    for (std::size_t i = 0; i < n; ++i)
      step_now[i] = -r[i];
    std::vector<double> parts = products(residual_now, 0);
    if (has_last)
      {
        // The last step and its change of the residual, orthogonalised against
        // earlier ones. In the same pass, the projections of this residual.
        std::vector<double> minus_earlier, minus_parts;
        for (unsigned int k = 0; k < n_changes; ++k)
          {
            minus_earlier.push_back(last_products[k] - parts[k]);
            minus_parts.push_back(-parts[k]);
          }
        for (std::size_t i = 0; i < n; ++i)
          last_residual[i] = r[i] - last_residual[i];
        add(changes, minus_earlier, last_residual, parts, step_now);
        add(steps, minus_earlier, last_step, minus_parts, step_now);
        const double square = std::inner_product(last_residual.begin(),
                                                 last_residual.end(),
                                                 last_residual.begin(),
                                                 0.);
        if (square > 0.)
          {
            if (n_changes == n_kept)
              {
                // Removal of the oldest one leaves the others orthogonal; this step
                // still includes it.
                std::rotate(changes.begin(),
                            changes.begin() + 1,
                            changes.begin() + n_changes);
                std::rotate(steps.begin(),
                            steps.begin() + 1,
                            steps.begin() + n_changes);
                parts.erase(parts.begin());
                --n_changes;
              }
            if (changes.size() == n_changes)
              {
                changes.emplace_back();
                steps.emplace_back();
              }
            Column &change = changes[n_changes], &its_step = steps[n_changes];
            const double scale = 1. / std::sqrt(square);
            change.resize(n);
            its_step.resize(n);
            for (std::size_t i = 0; i < n; ++i)
              {
                change[i]   = scale * last_residual[i];
                its_step[i] = scale * last_step[i];
              }
            ++n_changes;
            const double part = products(residual_now, n_changes - 1)[0];
            for (std::size_t i = 0; i < n; ++i)
              step_now[i] += part * (change[i] - its_step[i]);
            parts.push_back(part);
          }
      }
    last_residual.swap(residual_now);
    last_products.swap(parts);
    std::copy(step_now.begin(), step_now.end(), local_values(step));
    last_step.swap(step_now);
    has_last = true;
  }
} // namespace Ricochet
