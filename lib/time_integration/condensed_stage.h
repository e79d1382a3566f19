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
   * The nonlinear system of one stage of a linear body, condensed to the functionals
   * through which contact acts. With the residual R = K (x - x_0) + f z(f x) all
   * iterates of Newton's method from a guess x_g are
   *
   *     x = x_g + s (x_0 - x_g) - K^{-1} f z,
   *
   * where s = 1 after the first full step; and where contact takes rows and puts others
   * there, it goes by what the residual without contact leaves over along the functionals,
   * f ((1 - s) R(x_g) - f z).
   *
   * So its unknowns are the coefficients z and s: with full steps it makes the same
   * iterates as NewtonSolver with the whole system, but for round-off, and the body is
   * solved for once or twice in all. Where steps have to be shortened, it may fail and the
   * whole system not: norms are the same, but relative to the forces of the body at the guess.
   */
  class CondensedStage
  {
  public:
    /// Vectors that serve in all stages: to allocate them takes longer than to fill them.
    struct WorkSpace
    {
      Vector                     open_residual, work;
      std::vector<FunctionalRow> change, excess_change;
    };

    /// How forces of contact count in the norms of the whole stage.
    struct ContactForces
    {
      /// Weight in the residual (1), and what contact has of the problem's force scale at
      /// the guess (N).
      double weight, scale;
      /// ContactOperator::row_scaling(); null where all of it is 1.
      const Vector *row_scaling;
    };

    /**
     * @param problem the whole stage.
     * @param system of its body.
     * @param contact has begun the stage, and looked at the guess last.
     * @param residual that of the whole stage there.
     * @param space is not used by another one as long as this one is.
     */
    CondensedStage(const NewtonSolver::Problem &problem,
                   ContactSchurComplement      &system,
                   ContactOperator             &contact,
                   const Vector                &residual,
                   const ContactForces         &contact_forces,
                   WorkSpace                   &space);

    /**
     * Solve with @p newton, from the guess @p solution to @p solution; where it gets
     * stuck or lost, it begins anew a few times (NewtonSolver::end_iteration()).
     *
     * @param report gets the iterations, also where it fails.
     * @param sufficient a residual (N) that will do, besides what Newton's method
     * tolerates.
     * @throws NewtonFailure; the guess remains.
     */
    void
    solve(NewtonSolver &newton,
          Vector       &solution,
          SolverReport &report,
          const double  sufficient = 0.);

    /// Those of solve(), also where it failed: all attempts one behind the other, without
    /// the iterate of an earlier one that an attempt begins at.
    const std::vector<NewtonSolver::Iteration> &
    iterations() const
    {
      return history;
    }

  private:
    /// z and s, from and to the small vectors of Newton's method.
    struct Unknowns
    {
      std::vector<double> coefficients;
      double              share;
    };

    static Unknowns
    read(const Vector &vector);

    static void
    write(const Unknowns &unknowns, Vector &vector);

    /// Coefficients by place.
    std::vector<double>
    by_place(const std::vector<double> &coefficients) const;

    void
    residual(const Vector &point, Vector &result);

    /// @param may_reuse solve with the tangent of the last call, if contact is in the
    /// state that it was in there.
    void
    linear_solve(const Vector &right_hand_side,
                 Vector       &update,
                 const bool    may_reuse);

    double
    norm(const Vector &small_residual);

    /// Make #flight_values reach as far as contact with these @p coefficients, by place,
    /// may; at least.
    void
    look_around(const std::vector<double> &coefficients);

    const NewtonSolver::Problem &problem;
    ContactSchurComplement      &system;
    ContactOperator             &contact;
    const ContactForces          contact_forces;
    /// Magnitude of all forces but contact's (N), and of contact's.
    double body_force_scale, contact_force_scale;
    // The residual at the guess with open contact (N), and what its solution makes
    // of the functionals, those near contact.
    Vector             &open_residual, &work;
    std::vector<double> flight_values;
    // What the former has along the functionals (N), where contact takes rows.
    std::vector<double> open_excess, excess;
    std::vector<double> forces;
    // The tangent of the last linear_solve(), and the active set that it is for.
    std::vector<FunctionalRow>  &change, &excess_change;
    std::optional<std::uint64_t> tangent_active_set;
    // Of all attempts.
    std::vector<NewtonSolver::Iteration> history;
  };
} // namespace Ricochet

#endif
