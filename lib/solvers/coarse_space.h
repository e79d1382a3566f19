// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_coarse_space_h
#define ricochet_solvers_coarse_space_h

#include <base/types.h>
#include <solvers/functionals.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <vector>

namespace Ricochet
{
  /// Data of a body for multigrid: its displacements of degree 1.
  struct CoarseSpace
  {
    /// Prolongation to the body's own unknowns; empty if both are the same.
    Matrix prolongation;
    /// Owned and neighbouring unknowns of this rank, and the row of the
    /// prolongation of each, in their order.
    dealii::IndexSet relevant;
    Functionals      parents;
    /// Sparsity pattern of matrices between coarse unknowns.
    dealii::TrilinosWrappers::SparsityPattern pattern;
    /// Owned coarse unknowns that are clamped. The prolongation does not
    /// include them.
    dealii::IndexSet clamped;
    /// Displacements that move the body without deforming it, to first order:
    /// translations, then rotations about the origin.
    std::vector<Vector> rigid_body_modes;

    /// Number of unknowns of a node, which are consecutive: translations among
    /// these dim (dim + 1) / 2 motions.
    unsigned int
    dim() const
    {
      const auto n_modes = rigid_body_modes.size();
      return n_modes == 6 ? 3 : n_modes == 3 ? 2 : 1;
    }
  };
} // namespace Ricochet

#endif
