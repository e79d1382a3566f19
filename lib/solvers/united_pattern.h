// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_united_pattern_h
#define ricochet_solvers_united_pattern_h

#include <base/types.h>

#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <cstdint>
#include <vector>

namespace Ricochet
{
  /// Contact sparsity beyond the pattern of the body's matrices, which may change
  /// during a run.
  struct Couplings
  {
    /// Lists of unknowns that are coupled with each other. Lists of this rank;
    /// the unknowns may be of others.
    std::vector<std::vector<dealii::types::global_dof_index>> lists;
    /// A number that changes with the lists of any rank.
    std::uint64_t version = 0;
  };

  /// The extended sparsity pattern of bodies and contact, and the copy of the
  /// bodies' matrix into it.
  class UnitedPattern
  {
  public:
    /// Unite the pattern of @p body with @p couplings, unless it is up to date.
    /// Collective.
    void
    update(const dealii::TrilinosWrappers::SparsityPattern &body,
           const Couplings                                 &couplings);

    /// Fill @p matrix, which is empty or on the extended pattern, with the values
    /// of @p body, a matrix on the body's pattern. Collective if it is empty.
    void
    embed(const Matrix &body, Matrix &matrix) const;

  private:
    std::uint64_t                             version = 0;
    dealii::TrilinosWrappers::SparsityPattern united;
    // Index of each entry of the body's matrix in the extended pattern, on this
    // rank.
    std::vector<int> places;
  };
} // namespace Ricochet

#endif
