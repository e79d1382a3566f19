// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_multigrid_h
#define ricochet_solvers_multigrid_h

#include <base/types.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Algebraic multigrid for elasticity: aggregation by Trilinos' ML, with the
   * rigid body modes as what the coarse levels must be able to represent, as a preconditioner of conjugate gradients or GMRES.
   */
  class Multigrid
  {
  public:
    /**
     * @param rigid_body_modes Body::rigid_body_modes().
     * @param is_symmetric the matrices are: conjugate gradients will do.
     */
    Multigrid(const std::vector<Vector> &rigid_body_modes,
              const bool                 is_symmetric);

    /// Set up for @p matrix, which must stay where it is. Should its values
    /// change, the coarse levels are those of the old ones.
    void
    setup(const Matrix &matrix);

    /**
     * Solve @p matrix * @p solution = @p right_hand_side, with the matrix of
     * setup() and its values of now.
     *
     * @param tolerance of the residual, relative to the right hand side.
     * @return the number of iterations, or -1 if they do not converge.
     */
    int
    solve(const Matrix &matrix,
          const Vector &right_hand_side,
          Vector       &solution,
          const double  tolerance) const;

  private:
    const bool         is_symmetric;
    const unsigned int n_modes;
    // Mode by mode, the owned entries.
    std::vector<double>                                        modes;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> preconditioner;
  };
} // namespace Ricochet

#endif
