// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/functional_products.h>

#include <cmath>

namespace Ricochet
{
  const FunctionalRow &
  FunctionalProducts::of(const unsigned int f)
  {
    if (const auto own = known.find(f); own != known.end())
      return own->second;
    if (at_unknown.empty())
      for (unsigned int g = 0; g < functionals.size(); ++g)
        for (std::size_t k = functionals.begin[g]; k < functionals.begin[g + 1];
             ++k)
          at_unknown[functionals.index[k]].emplace_back(g,
                                                        functionals.value[k]);
    std::map<unsigned int, double> sums;
    for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
         ++k)
      for (const auto &[g, value] : at_unknown.at(functionals.index[k]))
        sums[g] += functionals.value[k] * value;

    // Zeros and ones of orthonormal rows are made exact, so that an eliminated row
    // leaves no residual.
    FunctionalRow &row = known[f];
    for (const auto &[g, sum] : sums)
      if (g == f && std::abs(sum - 1.) < 1e-12)
        row.emplace_back(g, 1.);
      else if (std::abs(sum) > 1e-12 * std::abs(sums.at(f)))
        row.emplace_back(g, sum);
    return row;
  }



  FunctionalRow
  FunctionalProducts::times(const FunctionalRow &row)
  {
    std::map<unsigned int, double> sums;
    for (const auto &[f, factor] : row)
      for (const auto &[g, product] : of(f))
        sums[g] += factor * product;
    return {sums.begin(), sums.end()};
  }
} // namespace Ricochet
