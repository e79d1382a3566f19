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
  /// What multigrid wants to know of a body: its displacements of degree 1.
  struct CoarseSpace
  {
    /// Takes them to the body's own unknowns; empty if they are the same.
    Matrix prolongation;
    /// The unknowns that this rank owns or borders on, and the row of the
    /// prolongation of each, in their order.
    dealii::IndexSet relevant;
    Functionals      parents;
    /// Of matrices between coarse unknowns.
    dealii::TrilinosWrappers::SparsityPattern pattern;
    /// Owned coarse unknowns that are clamped. The prolongation does not know
    /// them.
    dealii::IndexSet clamped;
    /// Displacements that move the body without deforming it, to first order:
    /// translations, then rotations about the origin.
    std::vector<Vector> rigid_body_modes;

    /// Unknowns of a node, which stand together: translations among these
    /// dim (dim + 1) / 2 motions.
    unsigned int
    dim() const
    {
      const auto n_modes = rigid_body_modes.size();
      return n_modes == 6 ? 3 : n_modes == 3 ? 2 : 1;
    }
  };
} // namespace Ricochet

#endif
