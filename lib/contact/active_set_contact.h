// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_active_set_contact_h
#define ricochet_contact_active_set_contact_h

#include <contact/contact_operator.h>

namespace Ricochet
{
  /**
   * Signorini's condition in the nodes by a primal-dual active set, without
   * multiplier unknowns (papers A and B, section 5; Hüeber, Stadler and
   * Wohlmuth 2008).
   *
   * A node is active when reaction/mass - r gap > 0. In the rows of an active
   * node, the component of the equation of motion along the obstacle's normal
   * is replaced by gap = 0, and the reaction is what that component leaves
   * over. Inactive nodes have no reaction.
   */
  class ActiveSetContact : public ContactOperator
  {
  public:
    /**
     * @param nodes from make_nodal_contact_points().
     * @param stress_points quadrature points at which the summary evaluates the
     * body's own stress.
     * @param augmentation r_0 (Pa); r = r_0 / h_T. It steers the choice of the
     * sets, not the solution.
     */
    template <int dim>
    ActiveSetContact(const Body<dim> &body,
                     ContactPoints    nodes,
                     ContactPoints    stress_points,
                     const double     augmentation)
      : evaluator(body, std::move(nodes))
      , stress_evaluator(body, std::move(stress_points))
      , augmentation(augmentation)
      , force(body.make_vector())
      , scaling(body.make_vector())
      , reaction(evaluator.contact_points().size(), 0.)
      , active(evaluator.contact_points().size(), 0)
    {
      scaling = 1.;
    }

    void
    begin_stage(const Vector &old_solution,
                const Vector &old_contact_force,
                const double  weight) override;

    void
    complete_residual(const Vector &solution, Vector &residual) override;

    void
    complete_tangent(Matrix &tangent) const override;

    std::optional<std::uint64_t>
    tangent_signature() const override;

    std::string
    active_set_description() const override;

    const Vector &
    contact_force() const override
    {
      return force;
    }

    /// No force: outside of a stage the constraint has no reaction. Initial
    /// states are expected not to be pressed.
    void
    force_at(const Vector &solution, Vector &force) override;

    double
    potential(const Vector & /*solution*/) override
    {
      return 0.;
    }

    const Vector &
    row_scaling() const override
    {
      return scaling;
    }

    std::map<dealii::types::boundary_id, ContactSummary>
    summary(const Vector &solution, const Vector &contact_force) override;

  private:
    /// Component of @p vector at node @p p along the obstacle's normal.
    double
    normal_component(const unsigned int p, const Vector &vector) const;

    /// Stiffness (N/m) with which the gap of node @p p enters the residual.
    double
    constraint_scale(const unsigned int p) const;

    ContactPointEvaluator            evaluator;
    ContactPointEvaluator            stress_evaluator;
    const double                     augmentation;
    double                           weight         = 1.;
    bool                             first_in_stage = true;
    std::vector<ContactPointState<>> state, stress_state;
    Vector                           force, scaling;
    // Reaction (N) and activity of each node in the current iteration.
    std::vector<double> reaction;
    std::vector<int>    active;
  };
} // namespace Ricochet

#endif
