// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_condensed_stage_h
#define ricochet_time_integration_condensed_stage_h

#include <contact/contact_operator.h>
#include <solvers/contact_schur_complement.h>
#include <solvers/newton.h>
#include <solvers/solver_report.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * The nonlinear system of one stage of a linear body, condensed to the rows of the
   * contact Jacobian H. With the residual R = K (x - x_0) + H^T z(H x) all iterates
   * of Newton's method from a guess x_g are
   *
   *     x = x_g + s (x_0 - x_g) - K^{-1} H^T z,
   *
   * where s = 1 after the first full step. Contact that eliminates rows and replaces
   * them depends on the residual without contact along the rows of H, too, which is H
   * ((1 - s) R(x_g) - H^T z).
   *
   * So the unknowns are the coefficients z and s: with full steps the iterates are
   * those of NewtonSolver with the whole system, except for round-off, and the body is
   * solved for once or twice in all. Where steps have to be shortened, it may fail
   * where the whole system does not: norms are the same, but relative to the forces of
   * the body at the guess.
   */
  class CondensedStage
  {
  public:
    /// Vectors that are shared by all stages: to allocate them takes longer than to
    /// fill them.
    struct WorkSpace
    {
      Vector                     open_residual, work;
      std::vector<FunctionalRow> change, excess_change;
    };

    /// Weights of contact forces in the norms of the whole stage.
    struct ContactForces
    {
      /// Weight in the residual (1), and contribution of contact to the problem's force
      /// scale at the guess (N).
      double weight, scale;
      /// ContactOperator::row_scaling(); null if all entries are 1.
      const Vector *row_scaling;
    };

    /**
     * @param problem the whole stage.
     * @param system the contact Schur complement of its body.
     * @param contact has begun the stage; its last evaluation is that of the
     * guess.
     * @param residual residual of the whole stage there.
     * @param space must not be used by another stage at the same time.
     */
    CondensedStage(const NewtonSolver::Problem &problem,
                   ContactSchurComplement      &system,
                   ContactOperator             &contact,
                   const Vector                &residual,
                   const ContactForces         &contact_forces,
                   WorkSpace                   &space);

    /**
     * Solve with @p newton, from the guess @p solution to @p solution; if it
     * stagnates or diverges, it is restarted a few times
     * (NewtonSolver::end_iteration()).
     *
     * @param report gets the iterations, also where it fails.
     * @param sufficient a residual (N) that is accepted, in addition to Newton's
     * tolerance.
     * @throws NewtonFailure; @p solution is unchanged.
     */
    void
    solve(NewtonSolver &newton,
          Vector       &solution,
          SolverReport &report,
          const double  sufficient = 0.);

    /// The iterations of solve(), also if it failed: all attempts in order, without the
    /// initial iterates of later ones.
    const std::vector<NewtonSolver::Iteration> &
    iterations() const
    {
      return history;
    }

  private:
    /// The unknowns z and s, from and to the small vectors of Newton's method.
    struct Unknowns
    {
      std::vector<double> coefficients;
      double              share;
    };

    static Unknowns
    read(const Vector &vector);

    static void
    write(const Unknowns &unknowns, Vector &vector);

    /// Coefficients by position, see ContactSchurComplement::place().
    std::vector<double>
    by_place(const std::vector<double> &coefficients) const;

    void
    residual(const Vector &point, Vector &result);

    /// @param may_reuse solve with the tangent of the last call, if the active set is
    /// the same.
    void
    linear_solve(const Vector &right_hand_side,
                 Vector       &update,
                 const bool    may_reuse);

    double
    norm(const Vector &small_residual);

    /// Extend #flight_values at least as far as contact with these @p coefficients, by
    /// position, may reach.
    void
    look_around(const std::vector<double> &coefficients);

    const NewtonSolver::Problem &problem;
    ContactSchurComplement      &system;
    ContactOperator             &contact;
    const ContactForces          contact_forces;
    /// Magnitude of all forces except contact (N), and of contact forces (N).
    double body_force_scale, contact_force_scale;
    // The residual at the guess with open contact (N), and the values of rows H of
    // the corresponding solution, near contact.
    Vector             &open_residual, &work;
    std::vector<double> flight_values;
    // That residual along the rows (N), where contact eliminates rows.
    std::vector<double> open_excess, excess;
    std::vector<double> forces;
    // The tangent of the last linear_solve(), and its active set.
    std::vector<FunctionalRow>  &change, &excess_change;
    std::optional<std::uint64_t> tangent_active_set;
    // Iterations of all attempts.
    std::vector<NewtonSolver::Iteration> history;
  };
} // namespace Ricochet

#endif
