// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/functional_norm.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  FunctionalNorm::FunctionalNorm(const Functionals &functionals,
                                 const IndexSet    &owned,
                                 const MPI_Comm     communicator)
    : functionals(functionals)
    , communicator(communicator)
  {
    const bool mine = std::all_of(functionals.index.begin(),
                                  functionals.index.end(),
                                  [&](const types::global_dof_index index) {
                                    return owned.is_element(index);
                                  });
    all_are_owned   = Utilities::MPI::min(mine ? 1 : 0, communicator) == 1;
    if (!all_are_owned)
      return;
    for (const auto index : functionals.index)
      number_of_entry.push_back(owned.index_within_set(index));
    unknowns = number_of_entry;
    std::sort(unknowns.begin(), unknowns.end());
    unknowns.erase(std::unique(unknowns.begin(), unknowns.end()),
                   unknowns.end());
    for (unsigned int &number : number_of_entry)
      number = std::lower_bound(unknowns.begin(), unknowns.end(), number) -
        unknowns.begin();
    sum.resize(unknowns.size());
  }



  double
  FunctionalNorm::of_sum(const std::vector<double> &coefficients,
                         const Vector              *scaling)
  {
    Assert(is_known(), ExcInternalError());
    std::fill(sum.begin(), sum.end(), 0.);
    for (unsigned int f = 0; f < coefficients.size(); ++f)
      if (coefficients[f] != 0.)
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          sum[number_of_entry[k]] += coefficients[f] * functionals.value[k];
    double square = 0.;
    for (unsigned int u = 0; u < sum.size(); ++u)
      {
        const double entry = scaling
          ? sum[u] * scaling->trilinos_vector()[0][unknowns[u]]
          : sum[u];
        square += entry * entry;
      }
    return std::sqrt(Utilities::MPI::sum(square, communicator));
  }
} // namespace Ricochet
