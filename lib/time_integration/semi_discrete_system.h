// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_semi_discrete_system_h
#define ricochet_time_integration_semi_discrete_system_h

#include <base/types.h>
#include <contact/contact_operator.h>
#include <discretization/bulk_operator.h>
#include <discretization/follower_load.h>
#include <solvers/body_matrix.h>
#include <solvers/linear_solver.h>
#include <solvers/mass_solver.h>
#include <solvers/newton.h>
#include <time_integration/condensed_stage.h>
#include <time_integration/frozen_tangent.h>
#include <time_integration/quasi_newton.h>
#include <time_integration/stage.h>
#include <time_integration/state.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The system of ordinary differential equations (or inclusions)
   *
   *     M a + bulk(u) + contact(u) = load(t)
   *
   * that time schemes integrate: paper C, (22), (23). It owns none of its parts
   * and is independent of material, contact treatment and scheme.
   */
  class SemiDiscreteSystem
  {
  public:
    /// External load (N) at a time (s); the argument is zero on entry.
    using Load = std::function<void(const double time, Vector &load)>;

    /// Data of the unknowns of this rank.
    struct Unknowns
    {
      /// Displacements without inertia.
      dealii::IndexSet massless;
      /// Displacements that are prescribed: zero, unless #impose says otherwise. They
      /// have to outlive the system.
      const Constraints *constraints = nullptr;
      /// Multipliers.
      dealii::IndexSet multipliers;
      /// Dimension of the body.
      unsigned int dim = 0;
      /// Sparsity pattern of the tangents, set up when first needed. Collective.
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

      /// Bodies that no support holds in all directions, by their names, and their
      /// smallest cell (m): they have no inertia to hold them in a static analysis.
      struct Unheld
      {
        std::vector<std::string> bodies;
        double                   cell_size = 0.;
      };
      Unheld unheld = {};
      /// Names of the contacts in the order of State::contact_shares, for checkpoints.
      std::vector<std::string> contact_names = {};
    };

    /**
     * @param mass mass matrix of the equation of motion; with redistributed
     * mass its rows on the contact boundary are zero.
     * @param invertible_mass consistent mass matrix, for the initial
     * acceleration.
     * @param follower a load that depends on the displacement, with schemes whose
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
    ///
    /// @param contact_forces the force (N) of each contact where it does not follow from
    /// the displacement, or vectors of size 0.
    State
    initial_state(const Vector              &displacement,
                  const Vector              &velocity,
                  const double               time,
                  const std::vector<Vector> &contact_forces = {});

    /**
     * Solve @p stage. The solution of @p new_state is the initial guess on entry;
     * it is overwritten with the result, and contact forces with those of the
     * result.
     *
     * @return how it was solved.
     * @throws NewtonFailure
     */
    SolverReport
    solve_stage(const Stage &stage, const State &old_state, State &new_state);

    /// Set the contact forces at the instant of @p state, from its solution
    /// alone.
    void
    set_contact_force(State &state) const;

    /// All forces of @p state less the load: bulk, viscous and contact forces.
    void
    total_force(const State &state, Vector &force) const;

    /// bulk(solution) + @p contact_force - load(time), without viscous forces.
    void
    total_force(const Vector &solution,
                const Vector &contact_force,
                const double  time,
                Vector       &force) const;

    /// Whether there are forces that depend on the velocity: schemes with forces of
    /// instants have to set Stage::rate_origin and rate_time.
    bool
    needs_rates() const
    {
      return contact.traits().has_friction || bulk.is_viscous();
    }

    /// Whether displacements are imposed that are not zero.
    bool
    has_imposed_displacements() const
    {
      return static_cast<bool>(unknowns.impose);
    }

    /// Work (J) on the body of the forces by which displacements are imposed, over a
    /// step with the displacement @p way, from the residual of the equations of
    /// motion in the last solve_stage().
    double
    imposed_work(const Vector &way) const;

    /// Forces (N) on the body at prescribed displacements that keep it in equilibrium at
    /// @p state without inertia, in their rows.
    void
    static_reactions(const State &state, Vector &forces) const;

    /// Reactions (N) on the body at prescribed displacements, in their rows: the
    /// residual of the equations of the last solve_stage(). With the midpoint scheme
    /// they are means over the step.
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

    /// The work (J) of the load that depends on the displacement, over the step between
    /// two states; 0 without.
    double
    follower_work(const State &old_state, const State &new_state) const;

    /// The same by the trapezoidal rule, for schemes with forces of instants.
    double
    trapezoidal_follower_work(const State &old_state,
                              const State &new_state) const;

    /// The external load at @p time, except for the one that depends on the
    /// displacement.
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

    /// Mass matrix of the equation of motion (kg).
    const BodyMatrix &
    mass_matrix() const
    {
      return mass;
    }

    const BulkOperator &bulk;
    ContactOperator    &contact;
    const Unknowns      unknowns;

    /// The record of the stage solver: the frozen tangent of a nonlinear body, for
    /// schemes whose forces are those of a step. It is part of a checkpoint.
    FrozenTangent frozen_tangent;

    /// The linear solvers in words.
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

    /// Number of factorisations so far.
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

    /// Timing of all stages (s).
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

    /// Works of several bodies against a contact force (N) between two solutions (J);
    /// empty if not needed.
    std::function<std::vector<double>(const Vector &force,
                                      const Vector &begin,
                                      const Vector &end)>
      works_of_bodies;

    /// Called after each solution with Newton's table (residuals, step lengths, active
    /// sets) and with the kind of system: the whole one with its tangent, or that of a
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

    /// As above for a nonlinear body, with one tangent for all iterates: that of
    /// earlier steps, if it converges, or one at the beginning of this step. If it is
    /// not solved, @p solution is the guess, or an iterate nearer to the solution.
    bool
    solve_near_last_state(StageProblem                &problem,
                          const NewtonSolver::Problem &newton_problem,
                          const Stage                 &stage,
                          const ContactStart          &start,
                          Vector                      &solution);

    /// Condense the body for a stage, with the #frozen_tangent, or with a new one if
    /// that is not to be used.
    void
    condense_body(StageProblem &problem,
                  const Stage  &stage,
                  const Vector &old_solution);

    /// total_force() with the rows of prescribed displacements.
    void
    sum_of_forces(const Vector &solution,
                  const Vector &contact_force,
                  const double  time,
                  Vector       &result) const;

    /// Take the contact forces from the operator's last evaluation.
    void
    take_shares(State &state) const;

    const BodyMatrix &mass;
    const BodyMatrix &invertible_mass;
    /// Prescribed displacements of this rank.
    const dealii::IndexSet clamped;
    const Load             load;
    const FollowerLoad    *follower;
    NewtonSolver           newton;
    // Newton's method for condensed systems; it keeps its vectors.
    NewtonSolver condensed_newton;
    QuasiNewton  quasi_newton;
    LinearSolver linear_solver;
    // Set up when first needed.
    std::optional<MassSolver> mass_solver;
    double                    residual_seconds = 0., tangent_seconds = 0.;
    double                    stage_round_off = 0.;
    /// Whether any rank has multipliers.
    const bool has_multipliers;
    // Work space, so that nothing is allocated in a time step.
    mutable Vector            work, constant_part, force;
    CondensedStage::WorkSpace condensed_space;
    // The residual of the equations at prescribed displacements (N), the iterate where
    // Newton's method may begin instead of the guess, the guess if it is replaced, and
    // the residual at the guess (N).
    Vector reaction, safe_guess, first_guess, residual;
    // The tangent that is factored, and its state with the displacements prescribed at
    // the end of its step; whether it was factored in this stage, and the number of
    // iterations with it.
    FrozenTangent factored_tangent;
    Vector        frozen_guess;
    bool          body_is_condensed         = false;
    unsigned int  n_iterations_with_tangent = 0;
    UnitedPattern united_pattern;
    Matrix        body_matrix;
  };
} // namespace Ricochet

#endif
