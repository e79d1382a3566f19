// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_multigrid_h
#define ricochet_solvers_multigrid_h

#include <base/types.h>
#include <solvers/coarse_space.h>
#include <solvers/contact_subspace.h>
#include <solvers/single_tangent.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>
#include <deal.II/lac/trilinos_precondition.h>

#include <map>
#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Multigrid for elasticity, as a preconditioner of conjugate gradients or
   * GMRES: from the body's own elements to those of degree 1 (with Chebyshev's
   * polynomials as smoothers), and from there by aggregation, with Trilinos' ML
   * and the rigid body modes as near null space.
   *
   * On the level of the body's own elements a cycle works in single precision, with
   * half of a symmetric matrix of blocks: a preconditioner need not be exact, and
   * the time of a cycle is that to read the matrix. The Krylov method and the coarse
   * levels are in double precision.
   *
   * Where contact is stiff, its unknowns are solved for directly before and after a
   * cycle (see ContactSubspace).
   */
  class Multigrid
  {
  public:
    /// @param is_symmetric whether tangents are symmetric: conjugate gradients
    /// are used then.
    Multigrid(CoarseSpace coarse_space, const bool is_symmetric);

    /**
     * Set a new body: the terms of @p tangent, which must stay where it is. To
     * be followed by setup(). Collective, like all functions.
     *
     * @param n_constant the first terms, as many as this, are constant:
     * products computed from them are kept.
     */
    void
    set_body(const TangentOperator &tangent, const unsigned int n_constant);

    /// Set up for contact as it is in the tangent now. If it changes later, the
    /// coarse levels are still those of the old one.
    /// @throws NewtonFailure where the diagonal of the tangent is not positive.
    void
    setup();

    /// Set up for contact as it is now except for the coarse levels, which stay those
    /// of the last setup().
    /// @throws NewtonFailure as setup() does.
    void
    update_smoother();

    /**
     * Solve with the tangent of set_body(), as it is now.
     *
     * @param tolerance of the residual, relative to the right hand side.
     * @return the number of iterations, or -1 if they do not converge.
     */
    int
    solve(const Vector &right_hand_side,
          Vector       &solution,
          const double  tolerance) const;

    /// Bytes of the matrix of the finest level on this rank.
    std::size_t
    memory_of_finest_level() const
    {
      return single.memory_consumption();
    }

    /// Apply one cycle: the preconditioner.
    void
    vmult(Vector &result, const Vector &vector) const;

  private:
    using SingleVector = SingleTangent::VectorType;
    using Smoother =
      dealii::PreconditionChebyshev<SingleTangent,
                                    SingleVector,
                                    dealii::DiagonalMatrix<SingleVector>>;

    class CoarseProducts;

    /// Apply one cycle to #single_right_hand_side, in #single_result.
    void
    cycle() const;

    /// Add to #single_result the correction by which the residual of
    /// @p right_hand_side is zero in the subspace of contact. @param starts
    /// #single_result is zero.
    void
    solve_in_subspace(const SingleVector &right_hand_side,
                      const bool          starts) const;

    /// Set up Chebyshev's polynomials for the tangent as it is now.
    /// @throws NewtonFailure where its diagonal is not positive.
    void
    initialize_smoother();

    const CoarseSpace      space;
    const bool             is_symmetric;
    const bool             has_smoother;
    std::vector<double>    modes;
    const TangentOperator *tangent = nullptr;
    SingleTangent          single;
    Smoother               smoother;
    // Matrices between coarse unknowns: constant terms, the body, and the whole
    // tangent.
    std::map<const BodyMatrix *, Matrix>                       constant_terms;
    Matrix                                                     coarse_body;
    Matrix                                                     coarse;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> aggregation;
    ContactSubspace                                            subspace;
    mutable SingleVector single_right_hand_side, single_result, single_residual;
    // The whole right-hand side, and the solution before the cycle, if there is a
    // subspace.
    mutable SingleVector        whole_right_hand_side, single_start;
    mutable std::vector<double> subspace_values;
    mutable Vector              fine, coarse_residual, coarse_correction;
  };
} // namespace Ricochet

#endif
