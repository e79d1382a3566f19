// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_semi_discrete_system_h
#define ricochet_time_integration_semi_discrete_system_h

#include <base/types.h>
#include <contact/contact_operator.h>
#include <discretization/bulk_operator.h>
#include <discretization/follower_load.h>
#include <solvers/body_matrix.h>
#include <solvers/linear_solver.h>
#include <solvers/known_product.h>
#include <solvers/mass_solver.h>
#include <solvers/newton.h>
#include <time_integration/condensed_stage.h>
#include <time_integration/frozen_tangent.h>
#include <time_integration/quasi_newton.h>
#include <time_integration/stage.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Ricochet
{
  /// Everything that a time scheme needs to go on from an instant. All vectors
  /// are system vectors without ghost values; the entries of the multipliers
  /// in velocity, acceleration and forces are zero.
  struct State
  {
    /// s
    double time = 0.;
    /// Displacements (m) and multipliers (Pa).
    Vector solution;
    /// m/s
    Vector velocity;
    /// At this instant; of the midpoint scheme the mean over the last step (m/s^2).
    Vector acceleration;
    /// Contact force at this instant (two-point treatments: over the last
    /// step), on the side of the internal forces (N).
    Vector contact_force;
    /// What several contacts have of contact_force (N), see ContactOperator::shares();
    /// empty where there is only one.
    std::vector<Vector> contact_shares;
    /// Mean velocity over the last step, (u_new - u_old)/dt (m/s), which
    /// predictors of the gap need; kept by the midpoint scheme.
    Vector mean_velocity;
    /// -M a as the scheme's own equation of motion gives it (N); only the
    /// energy balance reads it.
    Vector scheme_force;

    State()              = default;
    State(const State &) = default;
    State(State &&)      = default;
    State &
    operator=(State &&) = default;

    /// By copy_values().
    State &
    operator=(const State &other);
  };


  /**
 * The system of ordinary differential equations (or inclusions)
 *
 *     M a + bulk(u) + contact(u) = load(t)
 *
 * that time schemes integrate: paper C, (22), (23). It owns none of its parts
 * and knows neither material nor contact treatment nor scheme.
 */
  class SemiDiscreteSystem
  {
  public:
    /// External load (N) at a time (s); the argument comes in as zero.
    using Load = std::function<void(const double time, Vector &load)>;

    /// What is known of the unknowns of this rank.
    struct Unknowns
    {
      /// Without inertia.
      dealii::IndexSet massless;
      /// Displacements that are prescribed: zero, unless #impose says otherwise. They
      /// outlive the system.
      const Constraints *constraints = nullptr;
      /// Multipliers.
      dealii::IndexSet multipliers;
      /// Dimension of the body.
      unsigned int dim = 0;
      /// Sparsity pattern of the tangents, made when it is asked for. Collective.
      std::function<const dealii::TrilinosWrappers::SparsityPattern &()>
        pattern;
      /// Body::canonical_positions(), for checkpoints.
      std::function<std::vector<dealii::types::global_dof_index>()>
        canonical_positions;
      /// Body::mesh_checksum(), for checkpoints.
      std::function<std::uint64_t()> mesh_checksum;
      /// Body::coarse_space(), for multigrid.
      std::function<CoarseSpace()> coarse_space;
      /// Sets the prescribed displacements in a vector of displacements (m), or
      /// their rates in one of velocities (m/s), to those at a time; empty if all
      /// are zero.
      std::function<void(const double time, Vector &displacement)> impose  = {};
      std::function<void(const double time, Vector &velocity)> impose_rate = {};
    };

    /**
   * @param mass mass matrix of the equation of motion; with redistributed
   * mass its rows on the contact boundary are zero.
   * @param invertible_mass consistent mass matrix, for the initial
   * acceleration.
   * @param follower a load that depends on where the body is, with schemes whose
   * forces are those of a step, and bodies that are not linear; null for none.
   */
    SemiDiscreteSystem(const BodyMatrix               &mass,
                       const BodyMatrix               &invertible_mass,
                       const BulkOperator             &bulk,
                       ContactOperator                &contact,
                       const Unknowns                 &unknowns,
                       Load                            load,
                       const NewtonSolver::Parameters &newton_parameters,
                       const LinearSolver::Parameters &solver_parameters,
                       const FollowerLoad             *follower = nullptr);

    /// A state with @p displacement and @p velocity (system vectors) at time
    /// @p time, with the contact force and the acceleration M^{-1}(load - bulk
    /// - contact) that follow (paper C, section 4).
    State
    initial_state(const Vector &displacement,
                  const Vector &velocity,
                  const double  time);

    /**
   * Solve @p stage. The solution of @p new_state holds the initial guess and gets
   * the result, its forces of contact those at the result.
   *
   * @return how it was solved.
   * @throws NewtonFailure
   */
    SolverReport
    solve_stage(const Stage &stage, const State &old_state, State &new_state);

    /// The forces of contact at the instant of @p state, from its solution alone.
    void
    set_contact_force(State &state) const;

    /// bulk(solution) + @p contact_force - load(time).
    void
    total_force(const Vector &solution,
                const Vector &contact_force,
                const double  time,
                Vector       &force) const;

    /// Whether displacements are imposed that are not zero.
    bool
    has_imposed_displacements() const
    {
      return static_cast<bool>(unknowns.impose);
    }

    /// Work (J) on the body of the forces by which displacements are imposed, over
    /// a step with the displacement @p way, from what the equations of motion of the
    /// last solve_stage() leave over.
    double
    imposed_work(const Vector &way) const;

    /// The forces (N) on the body by which displacements are prescribed, in the rows of
    /// these: what the equations of the last solve_stage() leave over. With the midpoint
    /// scheme they are the means over the step.
    const Vector &
    reaction_forces() const
    {
      return reaction;
    }

    /// Force (N) that round-off alone could leave in the equations of the last
    /// solve_stage(), see NewtonSolver::Problem::round_off.
    double
    round_off_force() const
    {
      return stage_round_off;
    }

    /// The work (J) of the load that depends on where the body is, over the step between
    /// two states; 0 without.
    double
    follower_work(const State &old_state, const State &new_state) const;

    /// The external load at @p time, but for the one that depends on where the body is.
    void
    external_load(const double time, Vector &load) const;

    /// Backward differences for the displacements without inertia, from @p
    /// old_state over @p time_step: paper C, algorithm 1. Multipliers have
    /// neither velocity nor acceleration.
    void
    reconstruct_massless(const State &old_state,
                         const double time_step,
                         State       &new_state) const;

    /// Solve M a = force, rows of clamped displacements being zero.
    void
    solve_mass(const Vector &force, Vector &acceleration);

    /// 1/2 v.M v (J).
    double
    kinetic_energy(const Vector &velocity) const;

    /// Products of velocities with the mass matrix (kg m/s).
    const KnownProduct &
    momentum() const
    {
      return momenta;
    }

    /// Mass matrix of the equation of motion (kg).
    const BodyMatrix &
    mass_matrix() const
    {
      return mass;
    }

    const BulkOperator &bulk;
    ContactOperator    &contact;
    const Unknowns      unknowns;

    /// The record of the stage solver: the tangent that it may go on with, of a body that
    /// is not linear and schemes whose forces are those of a step. A checkpoint has it.
    FrozenTangent frozen_tangent;

    /// What solves the linear systems, in words.
    std::string
    linear_solver_description() const
    {
      return linear_solver.description();
    }

    /// See LinearSolver.
    unsigned int
    n_multigrid_failures() const
    {
      return linear_solver.n_multigrid_failures();
    }

    /// Number of factorisations made so far.
    unsigned int
    n_factorisations() const
    {
      return linear_solver.n_factorisations();
    }

    /// Number of solutions with them, see LinearSolver::n_back_substitutions().
    unsigned int
    n_back_substitutions() const
    {
      return linear_solver.n_back_substitutions();
    }

    /// Where the time of all stages went (s).
    struct Shares
    {
      double residual          = 0.;
      double tangent           = 0.;
      double factorisation     = 0.;
      double back_substitution = 0.;
    };

    Shares
    shares() const;

    /// The l2 norm of the displacements from one solution to another one (m).
    double
    distance(const Vector &from, const Vector &to) const;

    /// What each of several bodies does against a contact force (N) between two solutions
    /// (J); empty if nobody asks.
    std::function<std::vector<double>(const Vector &force,
                                      const Vector &begin,
                                      const Vector &end)>
      works_of_bodies;

    /// Called after each solution with Newton's table (residuals, step lengths, active
    /// sets) and with what was solved: the whole system with its tangent, or the one of a
    /// SolverReport::Strategy.
    std::function<void(const std::vector<NewtonSolver::Iteration> &,
                       const std::optional<SolverReport::Strategy> &)>
      newton_observer;

  private:
    /// Solve one pass of a stage from the guess @p solution by its condensed system.
    /// @return whether the whole system is solved.
    bool
    solve_condensed(StageProblem                &problem,
                    const NewtonSolver::Problem &newton_problem,
                    Vector                      &solution);

    /// The same for a body that is not linear, with one tangent for all iterates: that
    /// of earlier steps, if it serves, or one at the begin of this step. If it is not
    /// solved, @p solution is the guess, or one that is nearer.
    bool
    solve_near_last_state(StageProblem                &problem,
                          const NewtonSolver::Problem &newton_problem,
                          const Stage                 &stage,
                          const ContactStart          &start,
                          Vector                      &solution);

    /// Condense the body for a stage, with the #frozen_tangent, or with a new one if that
    /// does not serve.
    void
    condense_body(StageProblem &problem,
                  const Stage  &stage,
                  const Vector &old_solution);

    /// Where that tangent is made. @pre condense_body()
    StageProblem::TangentPoint
    frozen_point() const;

    /// The forces of contact are those of the operator's last call.
    void
    take_shares(State &state) const;

    const BodyMatrix  &mass;
    const KnownProduct momenta;
    const BodyMatrix  &invertible_mass;
    /// Prescribed displacements of this rank.
    const dealii::IndexSet clamped;
    const Load             load;
    const FollowerLoad    *follower;
    NewtonSolver           newton;
    // Of condensed systems: it keeps its vectors.
    NewtonSolver condensed_newton;
    QuasiNewton  quasi_newton;
    LinearSolver linear_solver;
    // Made when it is first needed.
    std::optional<MassSolver> mass_solver;
    double                    residual_seconds = 0., tangent_seconds = 0.;
    double                    stage_round_off = 0.;
    /// On any rank.
    const bool has_multipliers;
    // Work space, so that nothing is allocated in a time step.
    mutable Vector            work, constant_part, force;
    CondensedStage::WorkSpace condensed_space;
    // What the equations leave over in prescribed displacements (N), where
    // Newton's method may begin, the guess where it begins elsewhere, and the residual at
    // the guess (N).
    Vector reaction, safe_guess, first_guess, residual;
    // The tangent that is factored, and its state with the displacements prescribed at the
    // end of its step; in this stage, whether that was done, and how many iterations were
    // made with it.
    FrozenTangent factored_tangent;
    Vector        frozen_guess;
    bool          body_is_condensed         = false;
    unsigned int  n_iterations_with_tangent = 0;
    UnitedPattern united_pattern;
    Matrix        body_matrix;
  };
} // namespace Ricochet

#endif
