// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_functional_norm_h
#define ricochet_solvers_functional_norm_h

#include <base/types.h>
#include <solvers/functionals.h>

#include <deal.II/base/index_set.h>

#include <vector>

namespace Ricochet
{
  /**
   * The norm of sums of functionals, whose entries are few of all unknowns: found from
   * these alone.
   */
  class FunctionalNorm
  {
  public:
    /// @param functionals of this rank; have to outlive this. @param owned unknowns of
    /// this rank. Collective.
    FunctionalNorm(const Functionals      &functionals,
                   const dealii::IndexSet &owned,
                   const MPI_Comm          communicator);

    /// Whether no rank has functionals with entries of another one. Without that there
    /// are no norms.
    bool
    is_known() const
    {
      return all_are_owned;
    }

    /// l2 norm of the sum of all ranks' functionals, each of which has the coefficients of
    /// its own. @param scaling a factor for each unknown; null for 1. Collective.
    /// @pre is_known()
    double
    of_sum(const std::vector<double> &coefficients, const Vector *scaling);

  private:
    const Functionals &functionals;
    const MPI_Comm     communicator;
    bool               all_are_owned = true;
    // Unknowns of this rank that have entries, and for each entry which of them it has.
    std::vector<unsigned int> unknowns, number_of_entry;
    std::vector<double>       sum;
  };
} // namespace Ricochet

#endif
