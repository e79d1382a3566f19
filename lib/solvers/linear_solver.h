// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_linear_solver_h
#define ricochet_solvers_linear_solver_h

#include <base/types.h>
#include <solvers/coarse_space.h>
#include <solvers/contact_schur_complement.h>
#include <solvers/tangent_solver.h>

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <list>
#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The two strategies to solve a stage, and their selection for a run.
   *
   * The reference assembles the whole tangent and solves with it. "direct" factors a
   * tangent for each state of contact and keeps the last few; with nonlinear materials
   * and laws it factors each tangent. "multigrid" solves each system iteratively, for
   * bodies in 3D whose factorisation takes too long or too much memory; if chosen by
   * "automatic", systems of less than 200000 unknowns for which it does not converge
   * are factored.
   *
   * "condensed" solves for contact alone, by the contact Schur complement of the body:
   * that of a linear body is computed once for each length of the time step, that of
   * another one with a frozen tangent. It runs on one rank; where it does not solve a
   * stage, the reference takes over.
   */
  class LinearSolver
  {
  public:
    struct Parameters
    {
      /// "automatic", "direct", "condensed" or "multigrid".
      std::string type = "automatic";
      /// "automatic", "KLU" or "MUMPS".
      std::string  factorisation = "automatic";
      unsigned int n_kept        = 8;
      /// Take all MPI ranks, even where one of them is faster.
      bool distribute = false;

      void
      add_parameters(dealii::ParameterHandler &parameters);
    };

    /**
     * @param contact how contact enters the tangents.
     * @param linear_body the body's part of a tangent has a cache key.
     * @param clamped unknowns of this rank that are clamped.
     * @param coarse_space Body::coarse_space(), only called for multigrid.
     * @param dim dimension of the body, which determines the fastest
     * factorisation.
     * @param n_unknowns number of unknowns on all ranks.
     * @throws InputError when the parameters do not go together.
     * @throws OneRankSuffices for a condensed solution on several ranks.
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
     * @param may_reuse the last tangent without a cache key may be used, if
     * there is one.
     * @param tolerance of the residual, relative to @p right_hand_side, where
     * the solution is iterative.
     * @return the solvers that were used, a sum of SolverReport::Strategy.
     * @throws NewtonFailure when the matrix cannot be factored.
     */
    unsigned int
    solve(const Tangent &tangent,
          const Vector  &right_hand_side,
          Vector        &solution,
          const bool     may_reuse,
          const double   tolerance);

    /// Whether multigrid is chosen for a linear body without multipliers, against
    /// rigid obstacles.
    static bool
    chooses_multigrid(const Parameters  &parameters,
                      const unsigned int dim,
                      const std::size_t  n_unknowns,
                      const unsigned int n_ranks);

    /// Whether stages are condensed() first.
    bool
    condenses() const
    {
      return is_condensed;
    }

    /// The contact Schur complement of the body of @p tangent; for a nonlinear body,
    /// that of the first tangent since forget_condensed(). @pre condenses()
    /// @throws NewtonFailure when the body's matrix cannot be factored.
    ContactSchurComplement &
    condensed(const Tangent &tangent);

    /// Let the next condensed() system of a nonlinear body have its own tangent.
    void
    forget_condensed()
    {
      has_frozen = false;
    }

    /// Begin a stage. Pivots are kept between two calls, which is faster; after
    /// a call, results do not depend on the history, so that a resumed run
    /// repeats them digit for digit.
    void
    begin_stage();

    /// Number of factorisations, or set-ups of multigrid, so far.
    unsigned int
    n_factorisations() const;

    /// Time spent in factoring, in forward solves of the rows of contact, and in
    /// setting up multigrid (s).
    double
    factorisation_seconds() const;

    /// Number of solutions with factorisations; forward solves of contact rows, which
    /// are kept, do not count.
    unsigned int
    n_back_substitutions() const;

    /// Time spent in solving with factorisations or multigrid (s).
    double
    back_substitution_seconds() const;

    /// Number of solutions by a factorisation after multigrid did not converge.
    unsigned int
    n_multigrid_failures() const
    {
      return n_taken_over;
    }

    /// The solvers in words, for the log.
    std::string
    description() const;

  private:
    /// The sum of one of the costs of all solvers.
    template <typename Cost>
    Cost
    sum_of(const Cost TangentSolver::Costs::*cost) const;

    std::unique_ptr<ContactSchurComplement>
    make_schur_complement(const Tangent &tangent);

    /// The Schur complement of a linear body, with the weights of its matrices.
    struct Condensed
    {
      std::optional<BodyKey>                  body;
      std::unique_ptr<ContactSchurComplement> complement;
    };

    const bool             linear_body;
    const ContactStructure contact;
    /// Package of the LU factorisation of whole tangents.
    const std::string    package;
    const unsigned int   n_kept;
    bool                 is_condensed = false;
    std::list<Condensed> condensed_bodies;
    // The Schur complement of a nonlinear body with its frozen tangent.
    std::unique_ptr<ContactSchurComplement> frozen;
    bool                                    has_frozen = false;
    TangentSolver::Costs                    condensed_costs;
    // The reference: solvers in order, until one succeeds.
    std::vector<std::unique_ptr<TangentSolver>> solvers;
    bool                                        has_multigrid = false;
    // Whether multigrid has failed in this stage, and how often another solver
    // has taken over.
    bool         multigrid_failed = false;
    unsigned int n_taken_over     = 0;
  };
} // namespace Ricochet

#endif
