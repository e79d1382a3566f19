// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_pointwise_contact_h
#define ricochet_contact_treatments_pointwise_contact_h

#include <contact/contact_operator.h>
#include <contact/laws/closing.h>
#include <contact/treatments/contact_rows.h>
#include <contact/treatments/pointwise_friction.h>

#include <memory>

namespace Ricochet
{
  /**
   * The contact operator of all pointwise laws: Nitsche and its hybrid,
   * penalty, augmented Lagrangian, multipliers, normal compliance. It evaluates
   * the law in each contact point, and Coulomb's friction with a tangential
   * compliance and the mean slip rate of the step. Forces act along the
   * directions that the kinematics gives.
   */
  class PointwiseContact : public ContactOperator
  {
  public:
    /**
     * Constructor.
     * @param stress_points quadrature points at which the summary evaluates the
     * body's own stress; there is none in nodes.
     * @param friction none if it does not exist.
     * @param augmentation r_0 (Pa); a stiffness r_0 / h_T, the body's own in
     * order of magnitude, distinguishes stick from slip and affects where power
     * laws are linearised. It does not affect the solution.
     * @param modified_energy the potential of the law is part of the modified
     * energy.
     */
    template <int dim>
    PointwiseContact(const Body<dim>            &body,
                     std::unique_ptr<ContactLaw> law,
                     ContactPoints               points,
                     ContactPoints               stress_points,
                     const RegularisedFriction  &friction        = {},
                     const double                augmentation    = 1.,
                     const bool                  modified_energy = true)
      : ContactOperator(body.make_vector())
      , law(std::move(law))
      , friction(friction, augmentation)
      , augmentation(augmentation)
      , kinematics(make_kinematics(body, std::move(points)))
      , evaluator(kinematics->evaluator)
      , stress_evaluator(body, std::move(stress_points))
      , n_displacements_owned(body.owned_indices().n_elements() -
                              body.multiplier_indices().n_elements())
    {
      compute_row_scaling();
      make_rows();
      find_open_tangents();
      set_structure();
      own_traits.has_modified_energy = modified_energy;
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

    bool
    next_pass() override;

    void
    add_residual(const Vector &solution, Vector &residual) override;

    void
    add_tangent(Matrix &tangent) const override;

    /// Add the contact-free tangent, without the terms of directions that may
    /// turn.
    void
    add_open_tangent(Matrix &tangent) const override;

    void
    evaluate_at_increment(const std::vector<double> &change,
                          const std::vector<double> &excess) override;

    void
    forces_on_rows(std::vector<double> &coefficients) const override;

    void
    differentiate_forces(
      std::vector<FunctionalRow> &with_values,
      std::vector<FunctionalRow> &with_residual) const override;

    ActiveSet
    active_set() const override;

    std::string
    active_set_description() const override;

    double
    linearisation_error() const override;

    double
    round_off() const override;

    double
    friction_dissipation() const override;

    void
    force_at(const Vector &solution, const double time, Vector &force) override;

    double
    potential(const Vector &solution, const double time) override;

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

    ContactLawTraits
    traits_of_law() const
    {
      return law->traits();
    }

  private:
    /// The normal force (N) in a point, at #state.
    double
    normal_force(const unsigned int p, const Vector &contact_force);

    /// The law's branch in each point at the last add_residual().
    std::vector<int>
    branches() const;

    void
    compute_row_scaling();

    /// Set the structure and the traits of the base, after make_rows().
    void
    set_structure();

    /// Set up the rows of the contact Jacobian; none if the law in closed points
    /// cannot be separated from that in open ones.
    void
    make_rows();

    /// Tangents of open points, after make_rows().
    void
    find_open_tangents();

    /// Rows of point @p p along which closing changes the law's tangent, and with
    /// friction along the obstacle.
    void
    add_directions(const unsigned int p);

    /// Set the entries of multipliers to zero: forces that are kept are those
    /// on displacements; the equations of the multipliers hold at the end of a
    /// stage and are never averaged.
    void
    clear_multipliers(Vector &vector) const;

    /// Whether the tangent or force of a point differs from that of an open
    /// one.
    bool
    acts(const unsigned int p) const;

    /// The force of the law on the observables of point @p p, along the direction of
    /// contact.
    PointVector
    along_direction(const unsigned int         p,
                    const ContactPointForce<> &force) const;

    /// Change of the force of the law in point @p p by its closing.
    ContactPointForce<>
    closing_force(const unsigned int p) const;

    /// Derivatives of the force on the observables of point @p p, less those that
    /// follow from @p left_out, a part of the law's tangent.
    PointMatrix
    point_tangent(const unsigned int         p,
                  const ContactPointTangent &left_out = {}) const;

    /// Evaluate the forces of law and friction at #state.
    void
    evaluate_laws();

    /// Choose the states at which the law is linearised for the residual at
    /// #state.
    void
    choose_linearisation();

    /// The force of the law in the residual: linearised at #linearisation.
    ContactPointForce<>
    linearised_force(const unsigned int p) const;

    /// Derivatives of friction with respect to the displacement increment of the
    /// point (Pa/m) and to the pressure.
    PointwiseFriction::Derivatives
    friction_derivatives(const unsigned int p) const;

    /// Whether friction acts in a point, i.e. whether it is pressed.
    bool
    friction_acts(const unsigned int p) const
    {
      return friction.exists() && friction.pressure(p) > 0.;
    }

    const std::unique_ptr<ContactLaw>        law;
    PointwiseFriction                        friction;
    const double                             augmentation;
    const std::unique_ptr<ContactKinematics> kinematics;
    // The evaluator of the kinematics.
    ContactPointEvaluator           &evaluator;
    ContactPointEvaluator            stress_evaluator;
    double                           weight     = 1.;
    unsigned int                     n_iterates = 0;
    std::vector<ContactPointState<>> state, old_state;
    // Observables at the last add_residual(), from which
    // evaluate_at_increment() begins, and at its state.
    bool                     looks_at_change = false;
    std::vector<PointVector> observables_before, observables,
      stress_observables;
    // States at which the law is linearised: now, and at the last accepted
    // iterate.
    std::vector<ContactPointState<>> linearisation, accepted_linearisation;
    // Force of the law per area (Pa) at the last add_residual().
    std::vector<ContactPointForce<>> point_force;
    const unsigned int               n_displacements_owned;
    std::optional<ContactRows>       rows;
    // With rows, in each point.
    std::vector<Closing> closings;
    // Tangent of the law in each point as add_open_tangent() has it: without the gap where
    // directions turn.
    std::vector<ContactPointTangent> open_tangents;
    // Whether the rows are along constant directions.
    bool rows_have_directions = false;
  };
} // namespace Ricochet

#endif
