// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_active_set_contact_h
#define ricochet_contact_treatments_active_set_contact_h

#include <contact/contact_operator.h>
#include <contact/laws/frictional_constraint.h>
#include <contact/treatments/closing_condition.h>
#include <contact/treatments/contact_rows.h>

#include <memory>

namespace Ricochet
{
  /**
   * Contact conditions in the nodes by a primal-dual active set, without
   * multiplier unknowns (paper B, section 5, for persistent contact; Hüeber,
   * Stadler and Wohlmuth 2008).
   *
   * A node is active when reaction - r closing > 0, where closing is the
   * quantity that the condition keeps at zero (the gap, or its change over the
   * step). In the rows of an active node, the component of the equation of
   * motion along the obstacle's normal is replaced by closing = 0, and the
   * reaction is the residual of that component. Inactive nodes have no
   * reaction.
   *
   * With Coulomb's friction an active node sticks or slips: if it sticks, the
   * tangential components are replaced by slip = 0; if it slips, the tangential
   * reaction is mu times the normal one, against the slip. Stick or slip is
   * found from tangential reaction - r slip in the same way (B (5.7), in the
   * form of Hüeber, Stadler and Wohlmuth).
   *
   * Several contacts may act on a node, as in a corner: each of them replaces one component,
   * along its normal less the parts along the normals before it (Gram and Schmidt), and the
   * reactions are the coefficients of the residual of the equation of motion along the normals.
   * A node that is held by two of them does not slip across the line that both leave free, so that
   * it has no friction; in 2D that obeys Coulomb's law except in the step in which the second one is met.
   */
  class ActiveSetContact : public ContactOperator
  {
  public:
    using Condition = ClosingCondition;

    /**
     * Constructor.
     * @param stress_points quadrature points at which the summary evaluates the
     * body's own stress.
     * @param augmentation r_0 (Pa); r = r_0 / h_T. It affects the choice of the
     * sets, not the solution.
     * @param friction_coefficient mu; 0 for none.
     */
    template <int dim>
    ActiveSetContact(const Body<dim> &body,
                     ContactPoints    nodes,
                     ContactPoints    stress_points,
                     const Condition  condition,
                     const double     augmentation,
                     const double     friction_coefficient)
      : ContactOperator(body.make_vector())
      , kinematics(make_kinematics(body, std::move(nodes)))
      , evaluator(kinematics->evaluator)
      , jacobian(evaluator.coefficients())
      , stress_evaluator(body, std::move(stress_points))
      , condition(condition)
      , augmentation(augmentation)
      , friction_coefficient(friction_coefficient)
      , nodes(evaluator.contact_points().size())
    {
      make_rows();
      find_held(body.constraints());
    }

    bool
    share_nodes(ContactOperator &before) override;

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    add_residual(const Vector &solution, Vector &residual) override;

    ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) override;

    void
    accept_iterate() override;

    bool
    next_pass() override;

    void
    add_tangent(Matrix &tangent) const override;

    void
    differentiate_forces(
      std::vector<FunctionalRow> &with_values,
      std::vector<FunctionalRow> &with_residual) const override;

    void
    evaluate_at_increment(const std::vector<double> &change,
                          const std::vector<double> &excess) override;

    void
    forces_on_rows(std::vector<double> &coefficients) const override;

    ActiveSet
    active_set() const override;

    std::string
    active_set_description() const override;

    double
    round_off() const override;

    double
    friction_dissipation() const override;

    /// No force: outside of a stage the constraint has no reaction. Initial
    /// states are expected without contact pressure.
    void
    force_at(const Vector & /*solution*/,
             const double /*time*/,
             Vector &force) override
    {
      force = 0.;
    }

    double
    potential(const Vector & /*solution*/, const double /*time*/) override
    {
      return 0.;
    }

    ContactSummaries
    summary(const ContactInstant &instant) override;

    Vector
    pressure_field(const ContactInstant &instant) override;

  private:
    using Status = ContactStatus;

    /// Data of a node in the current iteration.
    struct Node
    {
      FrictionalConstraint<3> constraint;
      /// The node may become active in this pass.
      bool candidate = true;
      /// Reaction (N) on the body with which the sets were chosen.
      dealii::Tensor<1, 3> reaction;
      /// The quantity that the condition keeps at zero (m).
      double closing = 0.;
      /// Slip (m); zero without friction.
      dealii::Tensor<1, 3> slip;
      /// The residual without contact in the node (N).
      dealii::Tensor<1, 3> excess;
      /// The residual of an active node less #excess (N).
      dealii::Tensor<1, 3> exchange;

      // Values at the last accepted iterate, or at the beginning of the stage.
      Status               accepted_status = Status::open;
      dealii::Tensor<1, 3> initial_reaction;
    };

    /// A node in another contact.
    struct Holder
    {
      const ActiveSetContact *contact;
      unsigned int            node;
      /// It is evaluated before this contact.
      bool is_before;
    };

    /// The component of a node's equation that a contact replaces: along a unit vector, with
    /// its derivative with respect to the displacement of the node (1/m).
    struct Direction
    {
      dealii::Tensor<1, 3> vector;
      dealii::Tensor<2, 3> derivative;
      /// Length of the normal less its parts along the normals before it; 1 if there are none.
      double length = 1.;
    };

    /// That of node @p p, with the contacts before this one that hold the node now.
    Direction
    direction(const unsigned int p) const;

    /// Whether a contact before this one holds node @p p now, so that direction() is not the
    /// normal.
    bool
    is_held_before(const unsigned int p) const;

    /// Whether another contact held node @p p at the last accepted iterate.
    bool
    is_held_elsewhere(const unsigned int p) const;

    /// The normal reaction (N) in node @p p, times the normal, if the residual of its equation of
    /// motion is that of the contacts that held it at the last accepted iterate.
    dealii::Tensor<1, 3>
    own_reaction(const unsigned int p) const;

    /// Whether node @p p is active.
    bool
    is_active(const unsigned int p) const
    {
      return nodes[p].constraint.status() != Status::open;
    }

    /// Arguments of the constraint of node @p p with this @p reaction (N).
    ConstraintState<3>
    constraint_state(const unsigned int          p,
                     const dealii::Tensor<1, 3> &reaction) const;

    /// Stiffness (N/m) with which closing and slip of node @p p enter the
    /// residual.
    double
    constraint_scale(const unsigned int p) const;

    /// The condition imposed in the current pass.
    enum class Closing
    {
      gap,
      mean_gap,
      change_of_gap
    };
    Closing
    closing_kind() const;

    /// The derivative of the closing quantity with respect to the gap.
    double
    closing_derivative() const
    {
      return closing_kind() == Closing::mean_gap ? .5 : 1.;
    }

    /// Set up the rows of the contact Jacobian along the normal of each node, and
    /// with friction in its tangent plane; along the axes where normals turn; and
    /// the properties of the base that follow.
    void
    make_rows();

    /// Set #is_free.
    void
    find_held(const Constraints &constraints);

    /// Choose the status of node @p p from its closing, slip and excess, and
    /// compute its exchange.
    void
    choose_status(const unsigned int p);

    /// Derivatives of Node::exchange with respect to the excess, and to the
    /// displacement of the node (N/m).
    struct ExchangeDerivatives
    {
      dealii::Tensor<2, 3> with_excess, with_displacement;
    };

    /// The derivatives of the active node @p p.
    ExchangeDerivatives
    exchange_derivatives(const unsigned int p) const;

    /// Bring closing and slip of node @p p to the state of #kinematics.
    void
    look_at_geometry(const unsigned int p);

    /// The quantity that the condition keeps at zero, at the last add_residual()
    /// (m).
    double
    closing(const unsigned int p) const;

    /// Status of all nodes as numbers, for cache keys of tangents.
    std::vector<int>
    statuses() const;

    const std::unique_ptr<ContactKinematics> kinematics;
    // The evaluator of the kinematics.
    ContactPointEvaluator &evaluator;
    // The rows of the contact Jacobian.
    ContactRows jacobian;
    /// For each node, 1 in the components in which it is free: the residual in others is
    /// the reaction of a support, not of contact.
    std::vector<dealii::Tensor<1, 3>> is_free;
    ContactPointEvaluator             stress_evaluator;
    const Condition                   condition;
    const double                      augmentation;
    const double                      friction_coefficient;
    double                            weight         = 1.;
    bool                              first_in_stage = true;
    unsigned int                      pass           = 0;

    std::vector<ContactPointState<>> state, old_state;
    std::vector<PointVector>         stress_observables;
    std::vector<Node>                nodes;
    /// Other contacts that act on each node; empty if there are none at all.
    std::vector<std::vector<Holder>> holders;
    // Observables at the last add_residual() and at the state of
    // evaluate_at_increment().
    bool                     looks_at_change = false;
    std::vector<PointVector> observables_before, observables;
    // Work space of add_tangent(): the rows of a node.
    mutable std::vector<double> normal_row, new_rows;
  };
} // namespace Ricochet

#endif
