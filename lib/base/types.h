// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_types_h
#define ricochet_base_types_h

#include <deal.II/lac/trilinos_sparse_matrix.h>
#include <deal.II/lac/trilinos_vector.h>

#include <vector>

/**
 * Ricochet: the dynamics of elastic bodies that hit obstacles and each other.
 */
namespace Ricochet
{
  /// Distributed vector of all unknowns (displacements, then multipliers).
  using Vector = dealii::TrilinosWrappers::MPI::Vector;

  /// Distributed sparse matrix on the same unknowns.
  using Matrix = dealii::TrilinosWrappers::SparseMatrix;

  class BodyMatrix;

  /// A matrix, and its factor in a sum.
  struct MatrixTerm
  {
    double            weight;
    const BodyMatrix *matrix;
  };

  using MatrixSum = std::vector<MatrixTerm>;
} // namespace Ricochet

#endif
