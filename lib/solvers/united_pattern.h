// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_united_pattern_h
#define ricochet_solvers_united_pattern_h

#include <base/types.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <cstdint>
#include <vector>

namespace Ricochet
{
  /// Unknowns that contact couples beyond what the body's matrices couple, and that
  /// may change in the course of a run.
  struct Couplings
  {
    /// The unknowns of each list are coupled with each other. Lists of this rank;
    /// the unknowns may be of others.
    std::vector<std::vector<dealii::types::global_dof_index>> lists;
    /// Another number whenever the lists of any rank have changed.
    std::uint64_t version = 0;
  };

  /// The sparsity pattern of bodies and of what contact couples, and a matrix of
  /// the bodies put into it.
  class UnitedPattern
  {
  public:
    /// Unite the pattern of @p body with @p couplings, unless it is done already.
    /// Collective.
    void
    update(const dealii::TrilinosWrappers::SparsityPattern &body,
           const Couplings                                 &couplings);

    /// Fill @p matrix, which is empty or on the united pattern, with the values of
    /// @p body, a matrix on the body's pattern. Collective if it is empty.
    void
    embed(const Matrix &body, Matrix &matrix) const;

  private:
    std::uint64_t                             version = 0;
    dealii::TrilinosWrappers::SparsityPattern united;
    // Where each entry of the body's matrix lies in the united one, on this rank.
    std::vector<int> places;
  };
} // namespace Ricochet

#endif
