// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_pointwise_contact_h
#define ricochet_contact_pointwise_contact_h

#include <contact/contact_operator.h>
#include <contact/coulomb_friction.h>

#include <memory>

namespace Ricochet
{
  /**
   * The contact operator of all pointwise laws: Nitsche and its hybrid,
   * penalty, augmented Lagrangian, multipliers, normal compliance. It runs
   * through the contact points and asks the law; Coulomb's friction with a
   * tangential compliance comes beside it, with the mean slip rate of the step.
   * Forces act along the directions that the kinematics gives.
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
      , kinematics(
          make_kinematics(body,
                          std::move(points),
                          {/* way */ friction.coefficient > 0., false}))
      , evaluator(kinematics->evaluator)
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

    double
    friction_dissipation() const override;

    void
    force_at(const Vector &solution, const double time, Vector &force) override;

    double
    potential(const Vector &solution, const double time) override;

    bool
    has_modified_energy() const override
    {
      return modified_energy;
    }

    bool
    has_moving_obstacles() const override
    {
      return kinematics->has_moving_obstacles();
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

    ContactSummaries
    summary(const Vector &solution,
            const Vector &contact_force,
            const double  time) override;

    Vector
    pressure_field(const Vector &solution,
                   const Vector &contact_force,
                   const double  time) override;

  private:
    /// The normal force (N) in a point, at #state.
    double
    normal_force(const unsigned int p, const Vector &contact_force);

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

    /// What the direction of the force in a point adds to its tangent: nothing
    /// where it stays the same.
    void
    add_turning(const unsigned int p, Matrix &tangent) const;

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

    const std::unique_ptr<ContactLaw>        law;
    const CoulombFriction                    friction;
    const double                             augmentation;
    const bool                               modified_energy;
    const std::unique_ptr<ContactKinematics> kinematics;
    // That of the kinematics.
    ContactPointEvaluator           &evaluator;
    ContactPointEvaluator            stress_evaluator;
    double                           weight     = 1.;
    double                           time_step  = 0.;
    unsigned int                     n_iterates = 0;
    std::vector<ContactPointState<>> state, old_state, stress_state;
    // Where the law is linearised: now, and at the last accepted iterate.
    std::vector<ContactPointState<>> linearisation, accepted_linearisation;
    // Force of the law per area (Pa) and slip rate (m/s) at the last
    // complete_residual().
    std::vector<ContactPointForce<>>  point_force;
    std::vector<dealii::Tensor<1, 3>> slip_rate;
    // The same as for the law, for friction.
    std::vector<CoulombFriction::Branch> friction_branch, accepted_branch;
    Vector                               force, friction_part, scaling;
    const unsigned int                   n_displacements_owned;

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
} // namespace Ricochet

#endif
