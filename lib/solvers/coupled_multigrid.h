// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_coupled_multigrid_h
#define ricochet_solvers_coupled_multigrid_h

#include <solvers/coarse_space.h>
#include <solvers/iteration_budget.h>
#include <solvers/single_finest_level.h>
#include <solvers/tangent_solver.h>

#include <deal.II/lac/trilinos_precondition.h>

#include <memory>
#include <vector>

class Epetra_CrsMatrix;
class Epetra_Map;
class Epetra_Vector;

namespace Ricochet
{
  /**
   * Flexible GMRES for each system, for bodies in contact with each other that are too
   * large for a factorisation. Displacements come first, on each rank, then
   * multipliers:
   *
   *     T = | A  G |
   *         | H  C |.
   *
   * C has no inverse where points are closed. With a diagonal C~ that has one (C, less
   * the compliance of a stiffness like the body's own), the preconditioner solves with
   *
   *     | A  G  |
   *     | H  C~ |
   *
   * by its Schur complement A - G C~^-1 H, on which Trilinos' ML acts with the rigid
   * body modes as near null space, in single precision on the finest level. This adds
   * springs of the bodies' stiffness where they touch, which couple them on all
   * levels; the multipliers' own Schur complement stays well conditioned.
   */
  class CoupledMultigrid : public TangentSolver
  {
  public:
    /// @param coarse_space without a prolongation, for displacements of any
    /// degree.
    explicit CoupledMultigrid(CoarseSpace coarse_space);

    ~CoupledMultigrid() override;

    SolverReport::Strategy
    strategy() const override
    {
      return SolverReport::multigrid;
    }

    /// @return true.
    /// @return false when it does not converge.
    bool
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance) override;

    /// Apply the preconditioner.
    void
    vmult(Vector &result, const Vector &vector) const;

  private:
    /// Split T into its blocks.
    void
    split();

    /// Set A, in place if the pattern is that of the last one. @param numbers of the
    /// displacements among the columns of T, negative for others.
    void
    copy_body(const Epetra_Vector &numbers);

    /// Set ML up for the present Schur complement.
    void
    set_up();

    /// Compute the Schur complement of A and the springs of C~.
    void
    add_springs();

    /// Solve for @p forces until the residual is below @p tolerance (N).
    /// @return the number of iterations, or -1 if they do not converge.
    int
    iterate(const Vector &forces,
            Vector       &solution,
            const double  tolerance) const;

    const CoarseSpace   space;
    std::vector<double> modes;
    // T with all rows scaled to forces, and the scaling.
    Matrix        matrix;
    const Vector *scaling = nullptr;
    std::uint64_t pattern = 0;

    // Displacements and multipliers, each with numbers of their own.
    std::unique_ptr<Epetra_Map>       displacements, multipliers;
    std::unique_ptr<Epetra_CrsMatrix> body, from_multipliers, to_multipliers;
    // The pattern of T for A, and the index of each entry of A in T.
    std::uint64_t                     pattern_of_body = 0;
    std::vector<unsigned int>         places;
    std::unique_ptr<Epetra_Vector>    inverse_diagonal;
    std::unique_ptr<Epetra_CrsMatrix> schur_complement;
    std::unique_ptr<dealii::TrilinosWrappers::PreconditionAMG> aggregation;
    // Finest level, which refers to #schur_complement and #aggregation.
    std::unique_ptr<SingleFinestLevel> finest_level;
    mutable Vector                     displacement_part, displacement_result;
    mutable std::unique_ptr<Epetra_Vector> multiplier_part, work;
    IterationBudget                        budget;
    // Norm of the right-hand side of the last solve (N).
    double last_norm = 0.;
  };
} // namespace Ricochet

#endif
