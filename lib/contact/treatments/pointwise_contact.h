// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_pointwise_contact_h
#define ricochet_contact_treatments_pointwise_contact_h

#include <contact/contact_operator.h>
#include <contact/treatments/closing_functionals.h>
#include <contact/treatments/displacement_functionals.h>
#include <contact/treatments/pointwise_friction.h>

#include <memory>

namespace Ricochet
{
  /**
   * The contact operator of all pointwise laws: Nitsche and its hybrid,
   * penalty, augmented Lagrangian, multipliers, normal compliance. It runs
   * through the contact points and asks the law; Coulomb's friction with a
   * tangential compliance comes beside it, with the mean slip rate of the step.
   * Forces act along the directions that the kinematics gives.
   */
  class PointwiseContact : public ContactOperator
  {
  public:
    /**
     * @param points where the law is enforced.
     * @param stress_points quadrature points at which the summary evaluates the
     * body's own stress; nodes know none.
     * @param friction none if it does not exist.
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
                     const RegularisedFriction  &friction        = {},
                     const double                augmentation    = 1.,
                     const bool                  modified_energy = true)
      : law(std::move(law))
      , friction(friction, augmentation)
      , augmentation(augmentation)
      , modified_energy(modified_energy)
      , kinematics(make_kinematics(body,
                                   std::move(points),
                                   {/* way */ friction.exists() ||
                                      prefers_displacements(),
                                    /* prediction */ false}))
      , evaluator(kinematics->evaluator)
      , stress_evaluator(body, std::move(stress_points))
      , force(body.make_vector())
      , friction_part(body.make_vector())
      , scaling(body.make_vector())
      , n_displacements_owned(body.owned_indices().n_elements() -
                              body.multiplier_indices().n_elements())
    {
      compute_row_scaling();
      if (!kinematics->has_constant_rows() || prefers_displacements())
        make_displacement_functionals();
      // Whether the law is of that kind does not depend on h_T.
      else if (closing_directions(*this->law, 1.))
        functionals.emplace(*this->law,
                            this->friction.exists(),
                            evaluator.coefficients());
    }

    ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) override;

    void
    accept_iterate() override;

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    complete_residual(const Vector &solution, Vector &residual) override;

    void
    complete_tangent(Matrix &tangent) const override;

    /// With functionals of displacements nothing that depends on directions, which may turn.
    void
    complete_constant_tangent(Matrix &tangent) const override;

    ContactStructure
    tangent_structure() const override;

    void
    look_at_change(const std::vector<double> &change,
                   const std::vector<double> &excess) override;

    void
    force_change(std::vector<double> &coefficients) const override;

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
      return friction.exists() ? &friction_part : nullptr;
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
    summary(const ContactInstant &instant) override;

    Vector
    pressure_field(const ContactInstant &instant) override;

  protected:
    /// The factor of contact in the residual of the stage.
    double
    stage_weight() const
    {
      return weight;
    }

  private:
    /// The normal force (N) in a point, at #state.
    double
    normal_force(const unsigned int p, const Vector &contact_force);

    /// The law's branch in each point at the last complete_residual().
    std::vector<int>
    branches() const;

    void
    compute_row_scaling();

    /// Unless what the law makes in closed points cannot be told from what it makes in
    /// open ones.
    void
    make_displacement_functionals();

    /// What is kept is a force on displacements; the equations of the
    /// multipliers hold at the end of a stage and are never averaged.
    void
    clear_multipliers(Vector &vector) const;

    /// Let points go on from where the last complete_residual() saw them, by @p change of
    /// the #displacement_functionals.
    void
    displace_points(const std::vector<double> &change);

    /// Whether a point is not as an open one.
    bool
    acts(const unsigned int p) const;

    /// Whether contact acts through the unknowns of the displacement where its directions
    /// stay the same, too.
    bool
    prefers_displacements() const;

    /// What complete_constant_tangent() has in a point with #displacement_functionals.
    ContactPointTangent
    constant_tangent(const unsigned int p) const;

    /// The force in a point, less what the constant tangent makes of the state.
    DisplacementFunctionals::OfPoint
    closing_force(const unsigned int p) const;

    /// Its derivatives.
    DisplacementFunctionals::TangentOfPoint
    closing_tangent(const unsigned int p) const;

    /// Bring #slips to the state of the kinematics.
    void
    find_slips();

    /// Ask law and friction for the forces at #state and #slips.
    void
    evaluate_laws();

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

    /// Derivatives of friction with respect to the way of the point over the step
    /// (Pa/m) and to the pressure.
    PointwiseFriction::Derivatives
    friction_derivatives(const unsigned int p) const;

    /// Whether there is friction in a point: whether it is pressed.
    bool
    friction_acts(const unsigned int p) const
    {
      return friction.exists() && friction.pressure(p) > 0.;
    }

    const std::unique_ptr<ContactLaw>        law;
    PointwiseFriction                        friction;
    const double                             augmentation;
    const bool                               modified_energy;
    const std::unique_ptr<ContactKinematics> kinematics;
    // That of the kinematics.
    ContactPointEvaluator           &evaluator;
    ContactPointEvaluator            stress_evaluator;
    double                           weight     = 1.;
    unsigned int                     n_iterates = 0;
    std::vector<ContactPointState<>> state, old_state, stress_state;
    // Slip over the step (m), with friction.
    std::vector<dealii::Tensor<1, 3>> slips;
    // What look_at_change() begins from: state and slips of the last
    // complete_residual(), as long as they differ from these; and displacements.
    bool                              looks_at_change = false;
    std::vector<ContactPointState<>>  state_before;
    std::vector<dealii::Tensor<1, 3>> slips_before, displacements_before,
      displaced;
    // Where the law is linearised: now, and at the last accepted iterate.
    std::vector<ContactPointState<>> linearisation, accepted_linearisation;
    // Force of the law per area (Pa) at the last complete_residual().
    std::vector<ContactPointForce<>> point_force;
    Vector                           force, friction_part, scaling;
    const unsigned int               n_displacements_owned;
    // One of them, see the constructor; none if the law does not act through such.
    std::optional<ClosingFunctionals>      functionals;
    std::optional<DisplacementFunctionals> displacement_functionals;
    // With the latter, those of the law in each point.
    std::vector<Closing> closings;
  };
} // namespace Ricochet

#endif
