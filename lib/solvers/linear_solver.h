// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_linear_solver_h
#define ricochet_solvers_linear_solver_h

#include <base/types.h>
#include <solvers/coarse_space.h>
#include <solvers/factorisation_choice.h>
#include <solvers/tangent_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Solves with the tangents of Newton's method, and keeps what it can.
   *
   * "direct" factors a tangent for each state of contact and keeps the last
   * few; with nonlinear materials and laws it factors each tangent.
   *
   * "corrected" keeps one factorisation of the body and treats contact as a
   * correction of low rank: for a linear body one factorisation per length of
   * the time step. With a nonlinear material the symmetric part of each new
   * tangent is factored, which costs less than half of a factorisation with
   * pivots, and GMRES does the rest.
   *
   * Bodies that are not linear, before each other in the plane, are condensed to
   * contact, with a factorisation of the bodies that serves for as many steps as it is
   * worth it; "direct" takes over where that fails.
   *
   * "multigrid" solves each system iteratively, for bodies in three dimensions
   * whose factorisation takes too long or too much memory. Chosen by "automatic", it
   * leaves systems of less than 200000 unknowns for which it does not converge to a
   * factorisation.
   */
  class LinearSolver
  {
  public:
    struct Parameters
    {
      /// "automatic", "direct", "corrected" or "multigrid".
      std::string type = "automatic";
      /// "automatic", "CHOLMOD", "KLU" or "MUMPS".
      std::string  factorisation = "automatic";
      unsigned int n_kept        = 8;
      /// Let Newton's method look at contact alone where it can.
      bool condense = true;

      void
      add_parameters(dealii::ParameterHandler &parameters);
    };

    /**
     * @param contact how contact enters the tangents.
     * @param linear_body the body's part of a tangent has a name.
     * @param clamped unknowns of this rank that are clamped.
     * @param coarse_space Body::coarse_space(), only called for multigrid.
     * @param dim dimension of the body, on which depends which factorisation is
     * fast.
     * @param n_unknowns number of unknowns on all ranks.
     * @throws InputError when the parameters do not go together.
     */
    LinearSolver(const Parameters                   &parameters,
                 const ContactStructure             &contact,
                 const bool                          linear_body,
                 const dealii::IndexSet             &clamped,
                 const std::function<CoarseSpace()> &coarse_space,
                 const unsigned int                  dim,
                 const std::size_t                   n_unknowns,
                 const unsigned int                  n_ranks);

    /**
     * Solve @p tangent * @p solution = @p right_hand_side, which must be zero in
     * clamped unknowns.
     *
     * @param may_reuse the last tangent without a name will do, if there is one.
     * @param tolerance of the residual, relative to @p right_hand_side, where
     * the solution is iterative.
     * @return what has solved it, a sum of SolverReport::Strategy.
     * @throws NewtonFailure when the matrix cannot be factored.
     */
    unsigned int
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance);

    /// Whether it solves with the whole matrix, with all that contact couples.
    bool
    needs_couplings() const
    {
      return type != "corrected";
    }

    /// Whether a linear body without multipliers, before rigid obstacles, is solved
    /// for by multigrid.
    static bool
    chooses_multigrid(const Parameters  &parameters,
                      const unsigned int dim,
                      const std::size_t  n_unknowns,
                      const unsigned int n_ranks);

    /// Whether there is a condensed() system.
    bool
    condenses() const;

    /// The matrix of the linear body of @p tangent condensed to the functionals
    /// through which contact acts, which serves until the next solve(); of a body that
    /// is not linear, the symmetric part of the first tangent since
    /// forget_condensed(). @pre condenses()
    /// @throws NewtonFailure when the body's matrix cannot be factored.
    CondensedSystem &
    condensed(const Tangent &tangent);

    /// The next condensed() system of a body that is not linear is that of its own
    /// tangent.
    void
    forget_condensed();

    /// Between two calls pivots are kept, which is faster; after one, results do
    /// not depend on what came before, so that a resumed run repeats them digit
    /// for digit.
    void
    begin_stage();

    /// Number of factorisations, or set-ups of multigrid, made so far.
    unsigned int
    n_factorisations() const;

    /// Time spent in factoring, in solving for columns of corrections, and in
    /// setting up multigrid (s).
    double
    factorisation_seconds() const;

    /// Number of solutions with factorisations, but for what is solved once and
    /// kept.
    unsigned int
    n_back_substitutions() const;

    /// Time spent in solving with factorisations or multigrid (s).
    double
    back_substitution_seconds() const;

    /// Number of solutions that a factorisation has made as multigrid did not converge.
    unsigned int
    n_multigrid_failures() const
    {
      return n_taken_over;
    }

    /// What is used, in words: "CHOLMOD, corrected for contact".
    std::string
    description() const;

  private:
    TangentSolver &
    way_to_condense() const;

    const bool                linear_body, may_condense;
    const FactorisationChoice factorisations;
    std::string               type;
    // The first way is there to condense, and solves nothing.
    bool condenses_only = false;
    // The ways to solve, one after the other until one succeeds.
    std::vector<std::unique_ptr<TangentSolver>> ways;
    // In this stage; how often something else has taken over.
    bool         multigrid_failed = false;
    unsigned int n_taken_over     = 0;
  };
} // namespace Ricochet

#endif
