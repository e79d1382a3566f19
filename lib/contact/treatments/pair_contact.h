// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_pair_contact_h
#define ricochet_contact_treatments_pair_contact_h

#include <contact/contact_operator.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/laws/frictional_constraint.h>
#include <contact/treatments/closing_condition.h>
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/pointwise_friction.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

namespace Ricochet
{
  /// How the points of one surface are coupled with the facets of another one.
  enum class PairCoupling
  {
    /// See PointsBeforeFacets.
    points,
    /// See MortarPair and, in 3D, MortarTriangles.
    mortar,
    dual_mortar
  };

  /// Contact method of a pair of surfaces.
  struct PairMethod
  {
    PairCoupling coupling = PairCoupling::points;
    /// A law for the pressure; null for a constraint.
    std::unique_ptr<ContactLaw> law;
    /// The law at corners of the master, beside a constraint.
    std::unique_ptr<ContactLaw> corner_law;
    /// The condition of a constraint.
    ClosingCondition condition = ClosingCondition::signorini;
    /// r_0 (Pa): r = r_0 / h_T affects Newton's method, but not the solution.
    double augmentation = 1.;
    /// Friction of a law; with a constraint it is only used as a flag for
    /// friction.
    RegularisedFriction friction;
    /// Coulomb's mu of a constraint, whose friction is exact.
    double exact_coefficient = 0.;
    /// Corners of the master are points, too.
    bool corners = false;
    /// Forces act over the step between two states; otherwise at an instant.
    bool acts_over_step = true;
  };

  /**
   * Contact of deformable bodies: pairs of surfaces, over the steps of the midpoint
   * scheme or at the instants of other schemes.
   *
   * The force of a point is pressure times D, and its friction traction times T,
   * rows on the unknowns of both surfaces (see FacetChain): for any pressure the
   * work over a step is pressure times the change of the gap, and the sum of the
   * forces and of their moments is zero.
   *
   * At an instant (SchemeTraits::contact_over_step is false) both ends of the step are the
   * same state: D is the gradient of the gap there, and its derivative twice the one with
   * respect to the end, since the rows are symmetric in both ends. The facet that a point
   * faces is found anew in each evaluation, without memory. Slip is T times the increment
   * since ContactStart::rate_origin.
   *
   * Corners, edges and open ends of the master would enter the facets of the slave between
   * its nodes. So the nodes of the master on such features are points, too, against the
   * facets of the slave, with the same law, or with a law of their own beside a constraint.
   *
   * Laws give the pressure as a function of the gaps at both ends of the step. A
   * constraint has the pressure as a multiplier in the node, and with friction the
   * traction as another one, with one equation for each: active nodes (multiplier -
   * r closing > 0) keep zero what the condition closes, the others have no
   * multiplier; active nodes with |traction + r slip| < mu pressure do not slip, the
   * others have the traction mu pressure along the slip (paper B, section 5;
   * Hueeber, Stadler and Wohlmuth 2008).
   */
  template <int dim>
  class PairContact : public ContactOperator
  {
  public:
    /// @param body with multipliers for a constraint: one in each node, dim with
    /// friction.
    /// @throws InputError see SurfacePair; and when a node is a slave twice.
    PairContact(const Body<dim>                &body,
                const std::vector<ContactPair> &pairs,
                PairMethod                      method);

    bool
    share_nodes(ContactOperator &before) override;

    void
    begin_stage(const ContactStart &start, const double weight) override;

    void
    add_residual(const Vector &solution, Vector &residual) override;

    void
    accept_iterate() override;

    void
    forget_iterates() override
    {
      forget_patterns();
    }

    bool
    next_pass() override;

    double
    friction_dissipation() const override;

    ContactWork
    contact_work(const dealii::types::boundary_id boundary_id) const override;

    ContactSteps
    end_step(const Vector &begin,
             const Vector &end,
             const double  begin_time,
             const double  end_time) override;

    double
    linearisation_error() const override;

    double
    round_off() const override;

    std::string
    active_set_description() const override;

    void
    add_tangent(Matrix &tangent) const override;

    /// Without contact, the equations of the multipliers remain.
    void
    add_open_tangent(Matrix &tangent) const override;

    /// The rows of the contact Jacobian are the surface dofs, on which contact
    /// depends by any function.
    void
    differentiate_forces(
      std::vector<FunctionalRow> &with_values,
      std::vector<FunctionalRow> &with_residual) const override;

    void
    evaluate_at_increment(const std::vector<double> &change,
                          const std::vector<double> &excess) override;

    void
    forces_on_rows(std::vector<double> &coefficients) const override;

    const Couplings *
    couplings() override;

    ActiveSet
    active_set() const override;

    void
    force_at(const Vector &solution, const double time, Vector &force) override;

    double
    potential(const Vector &solution, const double time) override;

    Vector
    pressure_field(const ContactInstant &instant) override;

    ContactSummaries
    summary(const ContactInstant &instant) override;

  private:
    using Status = ContactStatus;

    using Tangential = typename SurfacePair<dim>::Tangential;
    static constexpr unsigned int n_tangents = SurfacePair<dim>::n_tangents;

    /// Data of a point in the current iteration.
    struct PointState
    {
      unsigned int pair = 0, point = 0;
      /// The point may be pressed in this pass.
      bool   candidate = false;
      Status status    = Status::open;
      // Status at the last accepted iterate, or at the beginning of the stage.
      Status accepted_status = Status::open;
      /// Pressure (Pa) in the residual, and its derivative (Pa/m) for laws.
      double pressure = 0., with_gap = 0.;
      /// Traction (Pa) along T.
      Tangential traction;
      /// Where the coverage is not 1: mean energy of the law, without coverage, at the
      /// beginning and the end of the step (J/m^(dim-1)).
      double energy = 0.;
      /// The normal force of a corner in the last evaluation (N).
      double corner_force = 0.;
      /// The gap at the beginning of the step or stage, without interference (m).
      double begin_gap = 0.;
      /// The constraint, where there is no law.
      FrictionalConstraint<n_tangents> constraint;
      /// Difference between the equations in use and those of the state (Pa).
      double              error = 0.;
      ContactPointState<> old_state, state;
      // States at which the law is linearised: now, and at the last accepted
      // iterate.
      ContactPointState<> linearisation, accepted_linearisation;
      /// SurfacePair::passage() at the last accepted iterate, and how often it has
      /// changed.
      int          accepted_passage   = 0;
      unsigned int n_passages_changed = 0;
      /// The same node in other contacts.
      std::vector<const PointState *> doubles;
      /// Unknowns coupled by the contact sparsity, sorted.
      std::vector<dealii::types::global_dof_index> coupled;
    };

    using Pair  = SurfacePair<dim>;
    using Point = typename Pair::Point;

    const Pair &
    pair_of(const PointState &state) const
    {
      return *pairs[state.pair];
    }

    const Point &
    point_of(const PointState &state) const
    {
      return pair_of(state).points()[state.point];
    }

    /// Whether the point is a corner of the master.
    bool
    is_corner(const PointState &state) const
    {
      return state.pair >= n_own_pairs;
    }

    /// Whether the point is in front of several parts of a master, so that the force on its node
    /// is not of one of them.
    bool
    has_parts(const PointState &state) const
    {
      const unsigned int k = state.pair;
      return first_part[k] != k ||
        (k + 1 < n_own_pairs && first_part[k + 1] == k);
    }

    /// The law of a point; null for a constraint.
    const ContactLaw *
    law_of(const PointState &state) const
    {
      return is_corner(state) && !method.law ? method.corner_law.get()
                                             : method.law.get();
    }

    /// r = r_0 / h_T (Pa/m)
    double
    stiffness(const PointState &state) const
    {
      return method.augmentation / point_of(state).cell_diameter;
    }

    /// Pressure (Pa) of a constraint that round-off in the gap can cause.
    double
    pressure_round_off(const PointState &state) const
    {
      return stiffness(state) * pair_of(state).round_off(state.point);
    }

    /// Whether the @p pressure (Pa) of a point is more than round-off: multipliers of open
    /// points are not quite zero, laws are.
    bool
    is_pressed(const PointState &state, const double pressure) const
    {
      return pressure > (law_of(state) ? 0. : pressure_round_off(state));
    }

    /// Whether the point has forces.
    static bool
    has_force(const PointState &state)
    {
      return state.pressure != 0. || state.energy != 0. ||
        state.traction.norm_square() != 0.;
    }

    /// Whether the point has forces, or derivatives of forces.
    bool
    is_in_contact(const PointState &state) const
    {
      return state.candidate &&
        (!law_of(state) || has_force(state) || state.with_gap != 0.);
    }

    bool
    has_exact_friction(const PointState &state) const
    {
      return has_friction && !law_of(state);
    }

    /// Slip over the step, or since ContactStart::rate_origin (m).
    Tangential
    slip(const PointState &state) const;

    /// Directions of the tangential components for friction, which remembers directions of
    /// iterates: over a step, whose facets stay, axes of their own; at an instant unit
    /// vectors, as the facet may change from one iterate to the next.
    std::array<dealii::Tensor<1, 3>, n_tangents>
    axes(const PointState &state) const;

    /// The derivatives of slip() at an instant beyond those of SurfacePair::Derivatives:
    /// directions turn while the increment since the rate origin stays.
    using Turning = std::array<std::vector<double>, n_tangents>;
    void
    find_turning(const PointState &state,
                 const Caution     caution,
                 Turning          &turning) const;

    /// Derivatives with respect to the end of a step count for both ends at an instant.
    double
    n_moving_ends() const
    {
      return method.acts_over_step ? 1. : 2.;
    }

    /// Compliance (m/Pa) in the equation of multiplier @p c of a closed point, see
    /// SurfacePair::softness(). At an instant nodes of a surface against itself come to lie on
    /// each other in any iterate. A point that sticks to two walls is held more often than it can
    /// move: the walls carry it by their pressures, rather than each other's by friction.
    double
    softness(const PointState &state, const unsigned int c) const
    {
      const Pair &pair = pair_of(state);
      double      part = pair.softness(state.point);
      if (pair.touches_itself() && !method.acts_over_step)
        part = Pair::softness_of_doubles;
      else if (c > 0 && is_held_elsewhere(state))
        part = Pair::softness_of_stuck;
      return part / stiffness(state);
    }

    /// Whether another contact held the node at the last accepted iterate.
    static bool
    is_held_elsewhere(const PointState &state)
    {
      return std::any_of(state.doubles.begin(),
                         state.doubles.end(),
                         [](const PointState *other) {
                           return other->accepted_status != Status::open;
                         });
    }

    /// Whether the equation of multiplier @p c of a point has the softness().
    bool
    is_soft(const PointState &state, const unsigned int c) const
    {
      return softness(state, c) > 0. &&
        (c == 0 ? state.status != Status::open : state.status == Status::stick);
    }

    /// Where two contacts would hold a node in the same direction, leave it to that whose
    /// master it is in front of: at a seam, a node goes over from one to the other.
    void
    choose_holders();

    /// The quantity that the condition keeps at zero in the current pass (m).
    double
    closing(const PointState &state) const;

    void
    evaluate_law(PointState &state) const;

    /// Set the state of a point, from that of its pair.
    void
    evaluate_point(const unsigned int s);

    /// Call @p action(begin, end) for ranges from 0 to @p n, not shorter than @p smallest:
    /// on several threads if the points of the pairs allow that.
    void
    for_each_range(const unsigned int                             n,
                   const unsigned int                             smallest,
                   const std::function<void(const unsigned int,
                                            const unsigned int)> &action) const;

    /// Begin a stage. @return whether its coupled unknowns have changed.
    bool
    begin_point(PointState &state) const;

    /// Derivatives of the forces of a law, for differentiate_forces().
    void
    add_change_of_law(std::vector<FunctionalRow> &change) const;

    /// Arguments of the constraint of a point: its multipliers, and, if it is not
    /// open, closing and slip.
    ConstraintState<n_tangents>
    constraint_state(const PointState &state) const;

    void
    set_constraint(PointState &state) const;

    /// Begin an iteration anew, without former patterns.
    void
    forget_patterns();

    /// Keep the sets of the last iterate except for the point with the largest
    /// error.
    void
    change_worst_only();

    /// Take traction and status of the pressed point @p state of a law from #friction. @param
    /// along its axes().
    void
    take_friction(
      PointState                                         &state,
      const std::array<dealii::Tensor<1, 3>, n_tangents> &along) const;

    /// Add the force of a point and the residual of its equations.
    void
    add_force(const PointState &state);

    /// Set #corner_part, and add it to @p forces, the local values of #force.
    void
    add_corners(double *forces);

    /// @param add gets rows of the tangent: an unknown, and n other ones with values.
    template <typename Add>
    void
    add_tangent(const PointState &state, const Add &add) const;

    /// Evaluate contact at @p solution: states of points and #force, with the
    /// equations of the multipliers.
    void
    evaluate(const Vector &solution);

    /// Call @p action with the unknown of each multiplier of a point of a constraint.
    template <typename Action>
    void
    for_each_multiplier(const PointState &state, const Action &action) const
    {
      if (!law_of(state))
        for (const auto index : point_of(state).multipliers)
          if (index != dealii::numbers::invalid_dof_index)
            action(index);
    }

    /// Index of a surface dof in #skin, or behind all of these its index in
    /// #other_skin.
    unsigned int
    skin_place(const dealii::types::global_dof_index index) const;

    /// Diagonal of the equation of an open point's multiplier (m/Pa times the area).
    double
    open_diagonal(const PointState &state) const
    {
      return -weight * point_of(state).weight / stiffness(state);
    }

    /// Works against contact of this rank's points, of all or of those with
    /// @p boundary_id.
    ContactWork
    my_contact_work(
      const std::optional<dealii::types::boundary_id> boundary_id) const;

    void
    clear_multipliers(Vector &vector) const;

    /// Energy stored at a state of a point with a coverage (J); zero for a constraint.
    double
    potential_of(const PointState          &state,
                 const ContactPointState<> &at,
                 const double               coverage) const
    {
      return law_of(state) ? coverage * point_of(state).weight *
          law_of(state)->potential(at, point_of(state).cell_diameter)
                           : 0.;
    }

    /// The factor of the force; 1 for a constraint, whose multiplier is free.
    double
    mean_coverage(const PointState &state) const
    {
      return law_of(state) ? .5 *
          (pair_of(state).old_coverage(state.point) +
           pair_of(state).new_coverage(state.point))
                           : 1.;
    }

    /// Set PointState::energy.
    void
    set_energy(PointState &state) const
    {
      const Pair        &pair = pair_of(state);
      const unsigned int p    = state.point;
      const double       h    = point_of(state).cell_diameter;
      const bool         is_in_front =
        pair.old_coverage(p) == 1. && pair.new_coverage(p) == 1.;
      state.energy = is_in_front ? 0.
                                 : .5 *
          (law_of(state)->potential(state.old_state, h) +
           law_of(state)->potential(state.state, h));
    }

    /// Work of this step against the pressure of a point, and against its energy where its
    /// coverage changes (J).
    double
    normal_work(const PointState &state) const
    {
      const Pair        &pair = pair_of(state);
      const unsigned int p    = state.point;
      return point_of(state).weight *
        (state.energy * (pair.new_coverage(p) - pair.old_coverage(p)) -
         mean_coverage(state) * state.pressure * pair.rows(p).gap_increment);
    }

    bool
    has_corners() const
    {
      return pairs.size() > n_own_pairs;
    }

    /// The contact force at an instant without that of corners (N).
    Vector
    force_of_own_points(const ContactInstant &instant) const;

    /// Begin an instant at @p solution.
    void
    begin_instant(const Vector &solution, const double time);

    /// Normal force of a point (N), from the @p contact_force where points are
    /// nodes, and otherwise from the law at the current instant.
    double
    normal_force(const PointState &state, const Vector &contact_force) const;

    std::vector<int>
    statuses() const;

    /// Hash of the facets that points face at the end of the step, of those
    /// that have passed a vertex.
    std::uint64_t
    facets_signature() const;

    const MPI_Comm         communicator;
    const dealii::IndexSet owned;
    const PairMethod       method;
    const bool             has_friction;
    PointwiseFriction      friction;
    /// Pairs of the contacts, and then pairs of corners.
    std::vector<std::unique_ptr<Pair>> pairs;
    unsigned int                       n_own_pairs = 0;
    /// For each pair of a contact the first one of that contact, if its master has several
    /// unconnected parts.
    std::vector<unsigned int> first_part;
    std::vector<PointState>   states;
    /// A point that is the same node in another contact, whose stages begin before.
    struct Double
    {
      unsigned int state;
      PairContact *before;
      /// Its number there.
      unsigned int other;
    };
    std::vector<Double> doubles;
    const unsigned int  n_displacements_owned;
    double              weight    = 1.;
    double              time_step = 0.;
    /// Time of the instant (s), and the origin of slip (m).
    double       end_time = 0.;
    Vector       rate_origin, increments;
    unsigned int n_iterates = 0;
    unsigned int pass       = 0;
    // Active sets of this pass, and whether one has returned: then one point at a
    // time changes.
    FormerPatterns sets;
    bool           sets_recur = false;
    // Patterns of the facets that points face, and the number of iterations for
    // which tangents leave out the terms that make points oscillate.
    FormerPatterns facets;
    unsigned int   n_frozen = 0, n_returns = 0;
    Couplings      all_couplings;
    // The surface dofs of this rank in ascending order, the order in which
    // contact is expected to spread over them, their values at the last
    // add_residual(), and the contact force on each.
    std::vector<dealii::types::global_dof_index> skin;
    /// Index of each surface dof among this rank's unknowns.
    std::vector<unsigned int>     own_place;
    std::vector<double>           skin_values, skin_force;
    static constexpr unsigned int no_place =
      dealii::numbers::invalid_unsigned_int;
    /// Index in #skin of each unknown from its first one on.
    std::vector<unsigned int> place_in_skin;
    // State of evaluate_at_increment().
    Vector point_of_change;
    /// The part of the last evaluated force that is of corners (N).
    Vector corner_part;
    // Work space.
    std::vector<double> values;
  };
} // namespace Ricochet

#endif
