// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_single_finest_level_h
#define ricochet_solvers_single_finest_level_h

#include <solvers/block_matrix.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <ml_operator.h>

namespace Ricochet
{
  /**
   * The finest level of Trilinos' ML in single precision: while this exists, its
   * products (of smoothers and residuals) are those with the symmetric part of the
   * matrix, half of which is stored, by blocks. The time of a cycle is that to read the
   * matrix, and a preconditioner need not be exact. The coarse levels are those of ML
   * for the matrix itself.
   */
  class SingleFinestLevel
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<float>;

    /// @param aggregation set up for @p matrix. @param dim unknowns of a node, which
    /// are consecutive. Both have to outlive this. Collective.
    SingleFinestLevel(dealii::TrilinosWrappers::PreconditionAMG &aggregation,
                      const MatrixEntries                       &matrix,
                      const unsigned int                         dim,
                      const MPI_Comm                             communicator);

    SingleFinestLevel(const SingleFinestLevel &) = delete;

    SingleFinestLevel &
    operator=(const SingleFinestLevel &) = delete;

    /// Restores ML.
    ~SingleFinestLevel();

  private:
    /// Function for ML: @p result = the matrix times @p vector; its data are this
    /// object.
    static int
    multiply(ML_Operator *level,
             int          n_columns,
             double      *vector,
             int          n_rows,
             double      *result);

    BlockMatrix<float> matrix;
    // Divisor of the matrix, a power of two.
    double     scale;
    VectorType from, to;

    ML_Operator *level;
    void        *data_of_level;
    int (*product_of_level)(ML_Operator *, int, double *, int, double *);
  };
} // namespace Ricochet

#endif
