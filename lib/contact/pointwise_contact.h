// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_pointwise_contact_h
#define ricochet_contact_pointwise_contact_h

#include <contact/contact_operator.h>
#include <contact/coulomb_friction.h>

namespace Ricochet
{
  /**
   * The contact operator of all pointwise laws: Nitsche and its hybrid,
   * penalty, augmented Lagrangian, multipliers, normal compliance. It runs
   * through the contact points and asks the law; Coulomb's friction with a
   * tangential compliance comes beside it, with the mean slip rate of the step.
   *
   * A stiff power law is a poor thing to linearise at a gap: from far too deep a
   * penetration, or from contact at a point that leaves, Newton's method comes
   * to the solution by a constant factor per iteration. So these laws are
   * linearised where they meet the body's own line: the pressure that the last
   * linearisation predicts at the new gap, and a stiffness r_0 / h_T.
   */
  class PointwiseContact : public ContactOperator
  {
  public:
    /**
     * @param points where the law is enforced.
     * @param stress_points quadrature points at which the summary evaluates the
     * body's own stress; nodes know none.
     * @param friction none if its coefficient is 0.
     * @param augmentation r_0 (Pa); a stiffness r_0 / h_T, the body's own in
     * order of magnitude, tells stick and slip apart and chooses where power
     * laws are linearised. It leaves the solution alone.
     * @param modified_energy the potential of the law makes a modified energy.
     */
    template <int dim>
    PointwiseContact(const Body<dim>            &body,
                     std::unique_ptr<ContactLaw> law,
                     ContactPoints               points,
                     ContactPoints               stress_points,
                     const CoulombFriction      &friction        = {},
                     const double                augmentation    = 1.,
                     const bool                  modified_energy = true)
      : law(std::move(law))
      , friction(friction)
      , augmentation(augmentation)
      , modified_energy(modified_energy)
      , evaluator(body, std::move(points))
      , stress_evaluator(body, std::move(stress_points))
      , force(body.make_vector())
      , friction_part(body.make_vector())
      , scaling(body.make_vector())
      , n_displacements_owned(body.owned_indices().n_elements() -
                              body.multiplier_indices().n_elements())
    {
      compute_row_scaling();
      find_directions();
    }

    void
    accept_iterate() override;

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    complete_residual(const Vector &solution, Vector &residual) override;

    void
    complete_tangent(Matrix &tangent) const override;

    void
    complete_open_tangent(Matrix &tangent) const override;

    ContactStructure
    tangent_structure() const override;

    void
    tangent_change(std::vector<FunctionalRow> &change) const override;

    std::optional<std::uint64_t>
    tangent_signature() const override;

    std::uint64_t
    active_set_signature() const override;

    std::string
    active_set_description() const override;

    const Vector &
    contact_force() const override
    {
      return force;
    }

    double
    linearisation_error() const override;

    double
    round_off() const override;

    const Vector *
    friction_force() const override
    {
      return friction.coefficient > 0. ? &friction_part : nullptr;
    }

    void
    force_at(const Vector &solution, Vector &force) override;

    double
    potential(const Vector &solution) override;

    bool
    has_modified_energy() const override
    {
      return modified_energy;
    }

    const Vector &
    row_scaling() const override
    {
      return scaling;
    }

    bool
    knows_stress_pressure() const override
    {
      return stress_evaluator.has_points();
    }

    std::map<dealii::types::boundary_id, ContactSummary>
    summary(const Vector &solution, const Vector &contact_force) override;

    Vector
    pressure_field(const Vector &solution,
                   const Vector &contact_force) override;

  private:
    /// The normal force (N) in a point, at #state.
    double
    normal_force(const unsigned int p, const Vector &contact_force) const;

    /// The law's branch in each point at the last complete_residual().
    std::vector<int>
    branches() const;

    void
    compute_row_scaling();

    /**
     * How closing changes the tangent of the law in a point: by a number times
     * test trial^T, where test and trial are directions in the space of gap,
     * stress pressure and multiplier that depend on the law and h_T only. The
     * number can be read off one entry.
     */
    struct Closing
    {
      unsigned int         row = 0, column = 0;
      dealii::Tensor<1, 3> test, trial;
    };

    /// None if the law's tangent changes by more than one direction.
    std::optional<Closing>
    closing_directions(const double cell_diameter) const;

    void
    find_directions();

    /// The law's tangent when a point with this h_T is open.
    ContactPointTangent
    open_tangent(const double cell_diameter) const;

    /// What is kept is a force on displacements; the equations of the
    /// multipliers hold at the end of a stage and are never averaged.
    void
    clear_multipliers(Vector &vector) const;

    /// Choose the states at which the law is linearised for the residual at
    /// #state.
    void
    choose_linearisation();

    /// The force of the law in the residual: linearised at #linearisation.
    ContactPointForce<>
    linearised_force(const unsigned int p) const;

    /// The pressure that friction sees (Pa).
    double
    friction_pressure(const unsigned int p) const;

    /// Derivatives of the friction traction with respect to the slip rate and the
    /// pressure.
    struct FrictionDerivatives
    {
      dealii::Tensor<2, 3> with_slip_rate;
      dealii::Tensor<1, 3> with_pressure;
    };

    /// None without pressure or friction.
    std::optional<FrictionDerivatives>
    friction_derivatives(const unsigned int p) const;

    /// Choose stick or slip for the residual at #state.
    void
    choose_friction_branches();

    const std::unique_ptr<ContactLaw> law;
    const CoulombFriction             friction;
    const double                      augmentation;
    const bool                        modified_energy;
    ContactPointEvaluator             evaluator;
    ContactPointEvaluator             stress_evaluator;
    double                            weight     = 1.;
    double                            time_step  = 0.;
    unsigned int                      n_iterates = 0;
    std::vector<ContactPointState<>>  state, old_state, stress_state;
    // Where the law is linearised: now, and at the last accepted iterate.
    std::vector<ContactPointState<>> linearisation, accepted_linearisation;
    // Force of the law per area (Pa) and slip rate (m/s) at the last
    // complete_residual().
    std::vector<ContactPointForce<>>  point_force;
    std::vector<dealii::Tensor<1, 3>> slip_rate;
    // The same as for the law, for friction.
    std::vector<CoulombFriction::Branch> friction_branch, accepted_branch;
    // Displacements of the points, for slip; empty without friction.
    std::vector<dealii::Tensor<1, 3>> displacement, old_displacement;
    Vector                            force, friction_part, scaling;
    const unsigned int                n_displacements_owned;

    // The functionals of a point: of the law (test and trial, often the same),
    // and of the displacement along the foundation, with friction.
    struct PointDirections
    {
      Closing                           closing;
      unsigned int                      test, trial, first_tangential;
      std::vector<dealii::Tensor<1, 3>> tangential;
    };
    // Empty if the law is not of that kind.
    std::vector<PointDirections>                 directions;
    std::optional<ContactStructure::ActsThrough> acts_through;
  };



  /// Complete the entries of @p summaries that are means or totals over all
  /// ranks, from weighted sums on each rank.
  std::map<dealii::types::boundary_id, ContactSummary>
  reduce_summaries(
    const std::map<dealii::types::boundary_id, ContactSummary> &my_sums,
    const MPI_Comm                                              communicator);

  /// Add the weighted stress pressures of @p evaluator to @p sums.
  void
  add_stress_pressure(
    const Vector                                         &solution,
    ContactPointEvaluator                                &evaluator,
    std::vector<ContactPointState<>>                     &work,
    std::map<dealii::types::boundary_id, ContactSummary> &sums);

  /// "3 of 20": the number of entries of @p values that are not zero, and of
  /// all, on all ranks.
  std::string
  count_active(const std::vector<int> &values, const MPI_Comm communicator);

  /// Hash of a sequence of small integers on all ranks, the same on all.
  std::uint64_t
  global_hash(const std::vector<int> &values, const MPI_Comm communicator);
} // namespace Ricochet

#endif
