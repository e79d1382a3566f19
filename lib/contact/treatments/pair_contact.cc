// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/threads.h>
#include <base/vector_operations.h>
#include <contact/kinematics/mortar_pair.h>
#include <contact/kinematics/mortar_triangles.h>
#include <contact/kinematics/points_before_facets.h>
#include <contact/kinematics/points_before_triangles.h>
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/pair_contact.h>
#include <contact/treatments/power_law_linearisation.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    constexpr auto no_index = numbers::invalid_dof_index;

    MortarShape
    mortar_shape(const PairMethod &method)
    {
      return method.coupling == PairCoupling::dual_mortar
        ? MortarShape::dual
        : MortarShape::standard;
    }

    /// Methods in 2D and 1D.
    template <int dim>
    std::unique_ptr<SurfacePair<dim>>
    make_pair_before_chains(const Body<dim>   &body,
                            const ContactPair &pair,
                            const PairMethod  &method,
                            const bool         nodal)
    {
      using Points = PointsBeforeFacets<dim>;
      if (method.coupling == PairCoupling::points)
        return std::make_unique<Points>(
          body,
          pair,
          !nodal ? Points::PointsIn::quadrature_points
            : !method.law && method.acts_over_step &&
              method.condition == ClosingCondition::signorini &&
              !method.friction.exists()
            ? Points::PointsIn::nodes_and_valleys
            : Points::PointsIn::nodes,
          /* is_smooth */ method.law || !method.acts_over_step);
      AssertThrow(nodal, ExcMessage("Mortar couples nodes."));
      if constexpr (dim == 2)
        return std::make_unique<MortarPair>(body, pair, mortar_shape(method));
      else
        throw InputError(
          "In 1D surfaces are points, which match: "
          "Contact/Coupling can only be 'points'.");
    }

    template <int dim>
    std::unique_ptr<SurfacePair<dim>>
    make_surface_pair(const Body<dim>   &body,
                      const ContactPair &pair,
                      const PairMethod  &method)
    {
      const bool nodal = !method.law || method.law->traits().nodal;
      if constexpr (dim == 3)
        {
          using Points = PointsBeforeTriangles;
          if (method.coupling != PairCoupling::points)
            {
              AssertThrow(nodal, ExcMessage("Mortar couples nodes."));
              return std::make_unique<MortarTriangles>(body,
                                                       pair,
                                                       mortar_shape(method));
            }
          return std::make_unique<Points>(
            body,
            pair,
            nodal ? Points::PointsIn::nodes
                  : Points::PointsIn::quadrature_points,
            /* has_coverage */ method.law || !method.acts_over_step);
        }
      else
        return make_pair_before_chains(body, pair, method, nodal);
    }

    /// A pair for each group of connected boundaries of the master. A law has a coverage by
    /// each of them: energy would be made where the nearest one changes.
    template <int dim>
    std::vector<ContactPair>
    parts_of(const Body<dim> &body, const ContactPair &pair)
    {
      std::vector<ContactPair> parts;
      for (const auto &group :
           ContactSurface<dim>(body, pair.master).connected_boundaries())
        {
          ContactPair &part = parts.emplace_back(pair);
          part.master       = group;
          part.is_part      = true;
        }
      if (parts.size() == 1)
        return {pair};
      return parts;
    }

    /// The corners of the master, in front of the facets of the slave.
    template <int dim>
    std::unique_ptr<SurfacePair<dim>>
    make_corner_pair(const Body<dim> &body, const ContactPair &corners)
    {
      using Points = std::conditional_t<dim == 3,
                                        PointsBeforeTriangles,
                                        PointsBeforeFacets<dim == 3 ? 2 : dim>>;
      return std::make_unique<Points>(body,
                                      corners,
                                      Points::PointsIn::corners,
                                      /* smooth, with a coverage */ true);
    }
  } // namespace



  template <int dim>
  PairContact<dim>::PairContact(const Body<dim>                &body,
                                const std::vector<ContactPair> &pair_list,
                                PairMethod                      pair_method)
    : ContactOperator(body.make_vector())
    , communicator(body.communicator)
    , owned(body.owned_indices())
    , method(std::move(pair_method))
    , has_friction(dim > 1 && method.friction.exists())
    , friction(method.friction, method.augmentation)
    , n_displacements_owned(body.owned_indices().n_elements() -
                            body.multiplier_indices().n_elements())
    , corner_part(body.make_vector())
  {
    AssertThrow(method.law || body.has_multipliers(),
                ExcMessage("Constraints between bodies need multipliers."));
    std::set<types::boundary_id> slaves;
    for (const ContactPair &pair : pair_list)
      for (const auto id : pair.slave)
        if (!slaves.insert(id).second)
          throw InputError("The boundary " + std::to_string(id) +
                           " is the slave of more than one contact.");
    const bool has_coverage =
      dim > 1 && method.law && method.coupling == PairCoupling::points;
    for (const ContactPair &pair : pair_list)
      {
        const unsigned int             first = pairs.size();
        const std::vector<ContactPair> parts = has_coverage && !pair.is_self
          ? parts_of(body, pair)
          : std::vector<ContactPair>{pair};
        for (const ContactPair &part : parts)
          {
            pairs.push_back(make_surface_pair(body, part, method));
            first_part.push_back(first);
          }
      }
    n_own_pairs = pairs.size();
    for (const ContactPair &pair : pair_list)
      {
        if (dim == 1 || !method.corners || pair.is_self)
          continue;
        ContactPair of_master = pair;
        std::swap(of_master.slave, of_master.master);
        for (const ContactPair &part : parts_of(body, of_master))
          {
            auto corners = make_corner_pair(body, part);
            corners->report_as(*pair.slave.begin());
            if (Utilities::MPI::sum(static_cast<unsigned int>(
                                      corners->points().size()),
                                    communicator) > 0)
              pairs.push_back(std::move(corners));
          }
      }
    for (unsigned int k = 0; k < pairs.size(); ++k)
      {
        if (!has_friction)
          pairs[k]->leave_out_slip();
        for (unsigned int p = 0; p < pairs[k]->points().size(); ++p)
          {
            PointState state;
            state.pair  = k;
            state.point = p;
            states.push_back(state);
          }
      }

    // Row scaling: the equations of a multiplier become forces when its
    // pressure is replaced by the force that it has in the equations of motion.
    std::set<types::global_dof_index> multipliers;
    for (const PointState &state : states)
      for (const auto index : point_of(state).multipliers)
        if (index != no_index)
          {
            if (!multipliers.insert(index).second)
              throw InputError(
                "A node is the slave of more than one contact. "
                "Leave a part of the boundary free between "
                "them.");
            scaling(index) = stiffness(state);
          }
    scaling.compress(VectorOperation::insert);

    std::map<types::global_dof_index, double> distances;
    for (const auto &pair : pairs)
      for (const auto &[index, distance] : pair->unknowns())
        {
          const auto known = distances.emplace(index, distance).first;
          known->second    = std::min(known->second, distance);
        }
    own_structure.functionals.emplace();
    for (const auto &[index, distance] : distances)
      if (owned.is_element(index))
        {
          skin.push_back(index);
          own_structure.functionals->order.push_back(distance);
        }
    if (!skin.empty())
      place_in_skin.resize(skin.back() - skin.front() + 1, no_place);
    for (unsigned int f = 0; f < skin.size(); ++f)
      place_in_skin[skin[f] - skin.front()] = f;
    for (const auto index : skin)
      own_place.push_back(owned.index_within_set(index));
    skin_values.resize(skin.size());
    skin_force.resize(skin.size());

    own_structure.has_multipliers  = !method.law;
    own_structure.couplings_change = true;
    for (const auto index : skin)
      {
        own_structure.functionals->functionals.add(index, 1.);
        own_structure.functionals->functionals.end_functional();
      }
    own_traits.has_friction        = has_friction;
    own_traits.gaps_may_be_unknown = true;
    own_traits.knows_work          = method.acts_over_step;
  }



  template <int dim>
  bool
  PairContact<dim>::begin_point(PointState &state) const
  {
    const Pair        &pair  = pair_of(state);
    const unsigned int p     = state.point;
    state.candidate          = pair.is_before_facet(p);
    state.accepted_status    = Status::open;
    state.accepted_passage   = 0;
    state.n_passages_changed = 0;
    state.old_state          = {};
    state.begin_gap          = 0.;
    if (state.candidate)
      {
        // A threshold, as Newton's method leaves pressures of round-off size in
        // open points.
        const bool was_pressed =
          !law_of(state) && is_pressed(state, pair.multipliers(p)[0]);
        state.old_state.gap = pair.old_gap(p);
        state.begin_gap     = pair.old_gap_without_interference(p);
        // The predictor leads away from a surface that is not flat, and pressed
        // points would be released.
        if (!law_of(state) && method.condition == ClosingCondition::persistent)
          state.candidate =
            pair.predicted_gap(p) <= pair.round_off(p) || was_pressed;
        if (state.candidate && was_pressed)
          state.accepted_status = Status::slip;
      }
    // Contact sparsity of the points that may be pressed in this step; others
    // are added when they are pressed.
    const bool is_near = state.candidate &&
      std::min(pair.old_gap(p), pair.predicted_gap(p)) <
        std::abs(pair.old_gap(p) - pair.predicted_gap(p)) +
          .1 * point_of(state).cell_diameter;
    std::vector<types::global_dof_index> coupled;
    if (is_near)
      coupled = pair.unknowns_nearby(p);
    const bool changed = coupled != state.coupled;
    state.coupled.swap(coupled);
    return changed;
  }



  template <int dim>
  void
  PairContact<dim>::begin_stage(const ContactStart &start, const double weight_)
  {
    weight     = weight_;
    time_step  = start.time_step;
    n_iterates = 0;
    pass       = 0;
    forget_patterns();
    end_time = start.end_time;
    friction.begin_stage(start.slip_time());
    if (has_friction && start.rate_origin)
      copy_values(*start.rate_origin, rate_origin);
    for (const auto &pair : pairs)
      {
        pair->keep_facets(false);
        pair->set_interference(start.end_time);
        pair->begin_step(start);
      }
    std::atomic<bool> changed = false;
    for_each_range(states.size(),
                   64,
                   [&](const unsigned int begin, const unsigned int end) {
                     for (unsigned int s = begin; s < end; ++s)
                       if (begin_point(states[s]))
                         changed = true;
                   });
    if (Utilities::MPI::max(changed ? 1 : 0, communicator) == 1)
      ++all_couplings.version;
    choose_holders();
  }



  template <int dim>
  bool
  PairContact<dim>::share_nodes(ContactOperator &before)
  {
    auto *const other = dynamic_cast<PairContact *>(&before);
    if (!other)
      return false;
    const auto unknown = [](const PairContact &contact,
                            const PointState  &state) {
      return contact.pair_of(state).first_unknown(state.point);
    };
    std::map<types::global_dof_index, unsigned int> state_of;
    for (unsigned int s = 0; s < other->states.size(); ++s)
      if (other->point_of(other->states[s]).is_shared &&
          !other->pair_of(other->states[s])
             .is_other_side(other->states[s].point))
        state_of[unknown(*other, other->states[s])] = s;
    for (unsigned int s = 0; s < states.size(); ++s)
      if (point_of(states[s]).is_shared &&
          !pair_of(states[s]).is_other_side(states[s].point))
        if (const auto known = state_of.find(unknown(*this, states[s]));
            known != state_of.end())
          {
            doubles.push_back({s, other, known->second});
            states[s].doubles.push_back(&other->states[known->second]);
            other->states[known->second].doubles.push_back(&states[s]);
          }
    // Both have multipliers of their own.
    return false;
  }



  template <int dim>
  void
  PairContact<dim>::choose_holders()
  {
    // Angle (as cosine) between two masters below which they are one surface for a node.
    constexpr double small_angle = .995;
    for (const Double &one : doubles)
      {
        PointState &own   = states[one.state],
                   &other = one.before->states[one.other];
        if (!own.candidate || !other.candidate)
          continue;
        const Pair &pair       = pair_of(own),
                   &other_pair = one.before->pair_of(other);
        const auto &n          = pair.rows(own.point).direction;
        const auto &other_n    = other_pair.rows(other.point).direction;
        if (std::inner_product(n.begin(), n.end(), other_n.begin(), 0.) <
            small_angle)
          continue;
        const bool is_ours =
          pair.overhang(own.point) < other_pair.overhang(other.point);
        (is_ours ? other : own).candidate       = false;
        (is_ours ? other : own).accepted_status = Status::open;
      }
  }



  template <int dim>
  void
  PairContact<dim>::accept_iterate()
  {
    ++n_iterates;
    friction.accept_iterate();
    for (PointState &state : states)
      {
        state.accepted_status        = state.status;
        state.accepted_linearisation = state.linearisation;
      }
    if (!method.law && sets.returns(global_hash(statuses(), communicator)))
      sets_recur = true;
    if (n_frozen > 0)
      --n_frozen;
    const bool facets_return = facets.returns(facets_signature());
    if (facets_return && !method.acts_over_step)
      {
        // Between two facets gaps are differentiable, but the rates of slip along them are
        // not beyond their ends: points that alternate stay until the stage is solved.
        if (++n_returns > 1)
          for (const auto &pair : pairs)
            pair->keep_facets(true);
      }
    else if (facets_return)
      {
        // Oscillation of points between two facets, at a vertex that supports them: if
        // it goes on, they stay with the facet where they began. A condition on the
        // increment is unaffected by the mismatch between the gap at the end of the
        // step and that at the beginning of the next one. Signorini's condition with
        // friction, or in 3D, has no solution where a node is pressed into a concave
        // corner from both sides; there the tolerance is raised gradually.
        const double tolerance = method.law ? 1e-10
          : method.condition != ClosingCondition::signorini
          ? std::min(1e-2,
                     1e-4 * std::pow(10., .5 * std::max(0., n_returns - 4.)))
          : std::min(has_friction || dim == 3 ? 1e-2 : 1e-9,
                     1e-10 * std::pow(10., n_returns));
        ++n_returns;
        // Rounded vertices and edges of laws only need a few iterates with weights
        // that stay.
        n_frozen = method.law ? 4 : 4 * std::max(1u, n_returns - 1);
        if (n_returns > 1)
          for (PointState &state : states)
            if (state.candidate && !is_corner(state) &&
                pair_of(state).passage(state.point) != state.accepted_passage)
              pairs[state.pair]->stay_at_vertex(state.point, tolerance);
        // Other sides of concave corners may have become candidates.
        if (n_returns > 1)
          for (PointState &state : states)
            if (pair_of(state).is_other_side(state.point))
              state.candidate = pair_of(state).is_before_facet(state.point);
      }
    // Early treatment for conditions on the increment, without waiting for the return
    // of a pattern of all facets: many points at vertices may each oscillate with a
    // period of their own. Measured with disks of 540 facets: a point that has returned
    // once rarely settles.
    constexpr double near_vertex = 1e-3;
    const bool       stays_early =
      !method.law && method.condition != ClosingCondition::signorini;
    for (PointState &state : states)
      if (state.candidate)
        {
          const int passage = pair_of(state).passage(state.point);
          if (passage != state.accepted_passage &&
              ++state.n_passages_changed >= 2 && stays_early &&
              !is_corner(state))
            pairs[state.pair]->stay_at_vertex(state.point, near_vertex);
          state.accepted_passage = passage;
        }
  }



  template <int dim>
  void
  PairContact<dim>::forget_patterns()
  {
    sets.seen.clear();
    facets.seen.clear();
    sets_recur = false;
    n_frozen   = 0;
    n_returns  = 0;
  }



  template <int dim>
  bool
  PairContact<dim>::next_pass()
  {
    if (method.law)
      return friction.next_pass(
        [&](const unsigned int s) {
          return pair_of(states[s]).round_off(states[s].point);
        },
        communicator);
    if (method.condition != ClosingCondition::two_step || pass == 1)
      return false;
    pass       = 1;
    n_iterates = 0;
    forget_patterns();
    for (PointState &state : states)
      {
        if (!law_of(state))
          state.candidate = state.status != Status::open;
        state.accepted_status = state.status;
      }
    return true;
  }



  template <int dim>
  double
  PairContact<dim>::closing(const PointState &state) const
  {
    if (method.condition == ClosingCondition::signorini)
      {
        // A point that is behind a facet at the beginning of the step, not detected
        // by the contact of nodes, is not pushed out, which would generate energy;
        // but it is kept from going deeper.
        const double begin_gap = method.acts_over_step
          ? pair_of(state).old_gap(state.point)
          : state.begin_gap;
        return begin_gap < -1e-11 * point_of(state).cell_diameter
          ? state.state.gap - begin_gap
          : state.state.gap;
      }
    if (method.condition == ClosingCondition::two_step && pass == 0)
      return .5 * (state.old_state.gap + state.state.gap);
    return pair_of(state).rows(state.point).gap_increment;
  }



  template <int dim>
  void
  PairContact<dim>::evaluate_law(PointState &state) const
  {
    const ContactLaw &law = *law_of(state);
    const double      h   = point_of(state).cell_diameter;
    state.old_state.gap   = pair_of(state).old_gap(state.point);
    // Power laws are linearised where they meet the body's line; if that does
    // not help, at the gap again.
    state.linearisation = state.state;
    if (!law.traits().piecewise_linear && n_iterates > 0 && n_iterates <= 8)
      state.linearisation.gap = linearisation_gap(law,
                                                  state.accepted_linearisation,
                                                  state.state,
                                                  state.old_state,
                                                  h,
                                                  method.augmentation / h);
    state.pressure = -law.force(state.linearisation, state.old_state, h).gap;
    state.with_gap = law.tangent(state.linearisation, state.old_state, h)[0][0];
    const double distance = state.state.gap - state.linearisation.gap;
    if (distance != 0.)
      state.pressure -= state.with_gap * distance;
    state.error =
      state.pressure + law.force(state.state, state.old_state, h).gap;
    state.status = law.branch(state.state, state.old_state, h) != 0
      ? Status::slip
      : Status::open;
  }



  template <int dim>
  ConstraintState<PairContact<dim>::n_tangents>
  PairContact<dim>::constraint_state(const PointState &state) const
  {
    const Pair                 &pair = pair_of(state);
    ConstraintState<n_tangents> result;
    result.pressure = pair.multipliers(state.point)[0];
    // Multipliers for tractions may exist without friction, and are kept at
    // zero.
    for (unsigned int d = 0; d + 1 < dim; ++d)
      result.traction[d] = pair.multipliers(state.point)[d + 1];
    if (state.status == Status::open)
      return result;
    result.closing = closing(state);
    if (has_exact_friction(state))
      result.slip = slip(state);
    return result;
  }



  template <int dim>
  typename PairContact<dim>::Tangential
  PairContact<dim>::slip(const PointState &state) const
  {
    const Pair &pair = pair_of(state);
    const auto &rows = pair.rows(state.point);
    if (method.acts_over_step)
      return rows.slip;
    Tangential result;
    for (unsigned int a = 0; a < rows.unknowns.size(); ++a)
      for (unsigned int d = 0; d < n_tangents; ++d)
        result[d] += rows.tangential[d][a] * pair.increment(rows.unknowns[a]);
    return result;
  }



  template <int dim>
  std::array<Tensor<1, 3>, PairContact<dim>::n_tangents>
  PairContact<dim>::axes(const PointState &state) const
  {
    std::array<Tensor<1, 3>, n_tangents> result;
    for (unsigned int d = 0; d < n_tangents; ++d)
      if (method.acts_over_step)
        result[d][d] = 1.;
      else
        {
          // The force on the point, as a sum over its nodes.
          const auto &row = pair_of(state).rows(state.point).tangential[d];
          for (unsigned int k = 0; k < point_of(state).nodes.size(); ++k)
            for (unsigned int c = 0; c < dim; ++c)
              result[d][c] += row[k * dim + c];
        }
    return result;
  }



  template <int dim>
  void
  PairContact<dim>::find_turning(const PointState &state,
                                 const Caution     caution,
                                 Turning          &turning) const
  {
    const Pair        &pair     = pair_of(state);
    const auto        &unknowns = pair.rows(state.point).unknowns;
    const unsigned int m        = unknowns.size();
    for (unsigned int d = 0; d < n_tangents; ++d)
      {
        typename Pair::Coefficients along;
        along.traction[d] = n_moving_ends();
        const auto &forces =
          pair.derivatives(state.point, along, caution).forces;
        turning[d].assign(m, 0.);
        for (unsigned int a = 0; a < m; ++a)
          for (unsigned int b = 0; b < m; ++b)
            turning[d][b] += pair.increment(unknowns[a]) * forces[a * m + b];
      }
  }



  template <int dim>
  void
  PairContact<dim>::set_constraint(PointState &state) const
  {
    // The forces are the multipliers, whatever the active sets.
    const Pair                 &pair    = pair_of(state);
    ConstraintState<n_tangents> current = constraint_state(state);
    state.pressure                      = current.pressure;
    if (has_exact_friction(state))
      state.traction = current.traction;

    // A margin, so that round-off neither opens nor closes a point.
    const double r      = stiffness(state);
    const double margin = state.accepted_status == Status::open
      ? pressure_round_off(state)
      : -pressure_round_off(state);
    current.closing     = closing(state);
    // Slip is not evaluated in open points.
    if (!FrictionalConstraint<n_tangents>::closes(current, r, margin))
      return;
    bool new_sticks = false;
    if (has_exact_friction(state))
      {
        current.slip = slip(state);
        // A point that is only about to close has no pressure yet. It sticks if the
        // displacement up to closure was within the cone of friction, unless this
        // choice has led back to an open point.
        const double approach = method.acts_over_step
          ? pair.rows(state.point).gap_increment
          : state.state.gap - state.begin_gap;
        new_sticks            = !sets_recur &&
          current.slip.norm() <= method.exact_coefficient * std::abs(approach);
      }
    state.constraint.choose(current,
                            r,
                            has_exact_friction(state) ? method.exact_coefficient
                                                      : 0.,
                            margin,
                            new_sticks);
    state.status = state.constraint.status();
  }



  template <int dim>
  void
  PairContact<dim>::evaluate_point(const unsigned int s)
  {
    PointState        &state = states[s];
    const Pair        &pair  = pair_of(state);
    const unsigned int p     = state.point;
    state.status             = Status::open;
    state.constraint.set_status(Status::open);
    state.pressure = state.with_gap = state.error = state.energy = 0.;
    state.corner_force                                           = 0.;
    state.traction                                               = 0.;
    if (!state.candidate)
      return;
    state.state.gap = pair.new_gap(p);
    if (!law_of(state))
      return set_constraint(state);
    evaluate_law(state);
    set_energy(state);
    if (is_corner(state))
      state.corner_force =
        point_of(state).weight * mean_coverage(state) * state.pressure;
    if (has_friction && state.pressure > 0.)
      {
        const auto       along     = axes(state);
        const Tangential slip_here = slip(state);
        Tensor<1, 3>     slip_vector;
        for (unsigned int d = 0; d < n_tangents; ++d)
          slip_vector += slip_here[d] * along[d];
        friction.evaluate(s,
                          state.pressure,
                          slip_vector,
                          point_of(state).cell_diameter);
        take_friction(state, along);
      }
    // Computed now, on this thread, for the assembly that follows.
    if (has_force(state))
      pair.rows(p);
  }



  template <int dim>
  void
  PairContact<dim>::for_each_range(
    const unsigned int                                                 n,
    const unsigned int                                                 smallest,
    const std::function<void(const unsigned int, const unsigned int)> &action)
    const
  {
    const bool share_nothing =
      std::all_of(pairs.begin(), pairs.end(), [](const auto &pair) {
        return pair->points_share_nothing();
      });
    if (share_nothing)
      Threads::for_each_range(n, smallest, action);
    else
      action(0, n);
  }



  template <int dim>
  void
  PairContact<dim>::change_worst_only()
  {
    // The largest error of all ranks.
    double largest = 0.;
    for (PointState &state : states)
      if (!law_of(state) && state.status != state.accepted_status)
        {
          const double r     = stiffness(state);
          const double error = std::abs(state.pressure - r * closing(state)) *
            point_of(state).weight;
          state.error = std::max(error, std::numeric_limits<double>::min());
          largest     = std::max(largest, state.error);
        }
    largest = Utilities::MPI::max(largest, communicator);
    for (PointState &state : states)
      if (!law_of(state) && state.status != state.accepted_status)
        {
          if (state.error == largest)
            state.error = 0.;
          else
            {
              state.status = state.accepted_status;
              state.constraint.set_status(state.status);
              state.error /= point_of(state).weight;
            }
        }
  }



  template <int dim>
  void
  PairContact<dim>::take_friction(
    PointState                                 &state,
    const std::array<Tensor<1, 3>, n_tangents> &along) const
  {
    const unsigned int s = &state - states.data();
    for (unsigned int d = 0; d < n_tangents; ++d)
      state.traction[d] = along[d] * friction.traction(s);
    if (friction.sticks(s))
      state.status = Status::stick;
    else if (state.status == Status::stick)
      state.status = Status::slip;
  }



  template <int dim>
  void
  PairContact<dim>::add_residual(const Vector &solution, Vector &residual)
  {
    evaluate(solution);
    residual.add(weight, force);
    clear_multipliers(force);
    copy_values(solution, point_of_change);
    for (unsigned int f = 0; f < skin.size(); ++f)
      skin_values[f] = local_values(solution)[own_place[f]];
  }



  template <int dim>
  void
  PairContact<dim>::evaluate_at_increment(
    const std::vector<double> &change,
    const std::vector<double> & /*excess*/)
  {
    for (unsigned int f = 0; f < skin.size(); ++f)
      local_values(point_of_change)[own_place[f]] = skin_values[f] + change[f];
    evaluate(point_of_change);
    clear_multipliers(force);
  }



  template <int dim>
  void
  PairContact<dim>::forces_on_rows(std::vector<double> &coefficients) const
  {
    coefficients = skin_force;
  }



  template <int dim>
  void
  PairContact<dim>::evaluate(const Vector &solution)
  {
    if (method.acts_over_step)
      for (const auto &pair : pairs)
        pair->evaluate(solution);
    else
      begin_instant(solution, end_time);
    if (!method.acts_over_step && has_friction)
      {
        increments = solution;
        increments -= rate_origin;
        for (const auto &pair : pairs)
          pair->set_increments(increments);
      }
    friction.begin_evaluation(states.size());
    for_each_range(states.size(),
                   64,
                   [&](const unsigned int begin, const unsigned int end) {
                     for (unsigned int s = begin; s < end; ++s)
                       evaluate_point(s);
                   });
    if (sets_recur)
      change_worst_only();
    if (has_friction && friction.change_worst_only(communicator))
      for (PointState &state : states)
        if (law_of(state) && state.pressure > 0.)
          take_friction(state, axes(state));

    // The other entries are zero.
    double *const forces = local_values(force);
    double *const friction_forces =
      has_friction ? local_values(friction_part) : nullptr;
    for (const unsigned int place : own_place)
      forces[place] = 0.;
    if (has_friction)
      for (const unsigned int place : own_place)
        friction_forces[place] = 0.;
    for (const PointState &state : states)
      if (!is_corner(state))
        add_force(state);
    force.compress(VectorOperation::add);
    if (has_corners())
      add_corners(forces);
    if (has_friction)
      {
        friction_part.compress(VectorOperation::add);
        for (const unsigned int place : own_place)
          forces[place] += friction_forces[place];
      }

    // Residual of the multipliers of open points, which is part of open contact
    // and so subtracted.
    for (unsigned int f = 0; f < skin.size(); ++f)
      skin_force[f] = weight * forces[own_place[f]];
    const double *const values_now = local_values(solution);
    for (const PointState &state : states)
      for_each_multiplier(state, [&](const types::global_dof_index index) {
        const unsigned int f = skin_place(index);
        skin_force[f] -= open_diagonal(state) * values_now[own_place[f]];
      });
  }



  template <int dim>
  void
  PairContact<dim>::add_corners(double *forces)
  {
    double *of_corners = local_values(corner_part);
    for (const unsigned int place : own_place)
      of_corners[place] = 0.;
    corner_part.swap(force);
    for (const PointState &state : states)
      if (is_corner(state))
        add_force(state);
    force.compress(VectorOperation::add);
    corner_part.swap(force);
    of_corners = local_values(corner_part);
    for (const unsigned int place : own_place)
      forces[place] += of_corners[place];
  }



  template <int dim>
  void
  PairContact<dim>::add_force(const PointState &state)
  {
    const Point       &point = point_of(state);
    const Pair        &pair  = pair_of(state);
    const unsigned int p     = state.point;
    if (has_force(state))
      {
        const auto &rows = pair.rows(p);
        const auto  add  = [&](const double               factor,
                             const std::vector<double> &row,
                             Vector                    &vector) {
          values.clear();
          for (const double entry : row)
            values.push_back(factor * entry);
          vector.add(values.size(), rows.unknowns.data(), values.data());
        };
        const double covered = mean_coverage(state) * point.weight;
        add(-covered * state.pressure, rows.normal, force);
        if (law_of(state) && !rows.coverage.empty())
          add(point.weight * state.energy, rows.coverage, force);
        for (unsigned int d = 0; d < n_tangents; ++d)
          if (state.traction[d] != 0.)
            add(covered * state.traction[d], rows.tangential[d], friction_part);
      }
    if (law_of(state))
      return;

    // The residual of the multipliers' equations.
    const auto equations = state.constraint.equations(constraint_state(state));
    for (unsigned int c = 0; c < dim; ++c)
      if (point.multipliers[c] != no_index)
        {
          double equation =
            -(c == 0 ? equations.normal : equations.tangential[c - 1]) /
            stiffness(state);
          if (is_soft(state, c))
            equation -= softness(state, c) * pair.multipliers(p)[c];
          force(point.multipliers[c]) += point.weight * equation;
        }
  }



  template <int dim>
  void
  PairContact<dim>::clear_multipliers(Vector &vector) const
  {
    double *entries = local_values(vector);
    for (unsigned int i = n_displacements_owned;
         i < vector.locally_owned_size();
         ++i)
      entries[i] = 0.;
  }



  template <int dim>
  ContactWork
  PairContact<dim>::my_contact_work(
    const std::optional<types::boundary_id> boundary_id) const
  {
    ContactWork work;
    for (const PointState &state : states)
      {
        const Point &point = point_of(state);
        if (!has_force(state) ||
            (boundary_id && point.boundary_id != *boundary_id))
          continue;
        const auto &rows = pair_of(state).rows(state.point);
        work.normal += normal_work(state);
        work.friction +=
          mean_coverage(state) * point.weight * (state.traction * rows.slip);
      }
    return work;
  }



  template <int dim>
  ContactWork
  PairContact<dim>::contact_work(const types::boundary_id boundary_id) const
  {
    const ContactWork mine = my_contact_work(boundary_id);
    return {Utilities::MPI::sum(mine.normal, communicator),
            Utilities::MPI::sum(mine.friction, communicator)};
  }



  template <int dim>
  double
  PairContact<dim>::friction_dissipation() const
  {
    return Utilities::MPI::sum(my_contact_work({}).friction, communicator);
  }



  template <int dim>
  ContactSteps
  PairContact<dim>::end_step(const Vector &begin,
                             const Vector &end,
                             const double /*begin_time*/,
                             const double end_time)
  {
    // The search at the end of the step is the one at the beginning of the next
    // one: the potential jumps for a point that faces another facet there, or none.
    struct Before
    {
      double made = 0., gap = 0.;
      bool   is_pressed = false, is_before_facet = false, is_covered = false;
    };
    std::vector<Before> before;
    for (const PointState &state : states)
      {
        const Pair        &pair = pair_of(state);
        const unsigned int p    = state.point;
        Before            &own  = before.emplace_back();
        own.is_before_facet     = pair.is_before_facet(p);
        if (!own.is_before_facet)
          continue;
        own.gap        = pair.new_gap(p);
        own.is_pressed = state.candidate && is_pressed(state, state.pressure);
        own.made = -potential_of(state, state.old_state, pair.old_coverage(p));
        own.is_covered = pair.new_coverage(p) > 0.;
        if (state.candidate && has_force(state))
          own.made -= normal_work(state);
      }
    std::vector<std::vector<bool>> crosses;
    for (const auto &pair : pairs)
      {
        crosses.emplace_back(pair->points().size(), false);
        for (const unsigned int p : pair->crossing_points(begin, end))
          crosses.back()[p] = true;
      }
    begin_instant(end, end_time);
    ContactSteps steps;
    for (unsigned int s = 0; s < states.size(); ++s)
      {
        const PointState &state = states[s];
        const Before     &own   = before[s];
        // Depth behind a facet that is more than round-off.
        const double depth = 1e-6 * point_of(state).cell_diameter;
        ContactStep &step  = steps[point_of(state).boundary_id];
        step.add_point(own.made +
                         (state.candidate
                            ? potential_of(state,
                                           state.state,
                                           pair_of(state).old_coverage(
                                             state.point))
                            : 0.),
                       pair_of(state).reference_place(state.point),
                       pair_of(state).part_of(state.point));
        if (pair_of(state).is_other_side(state.point))
          continue;
        // A point has passed if it has crossed a facet, was not pressed, and is out of
        // reach at the end.
        if (crosses[state.pair][state.point] && !own.is_pressed &&
            !state.candidate)
          {
            ++step.n_passed;
            step.place_passed = pair_of(state).reference_place(state.point);
          }
        step.n_dropped += own.is_pressed && !state.candidate &&
          (!law_of(state) || (own.gap < -depth && own.is_covered));
        step.n_entered += state.candidate && state.state.gap < -depth &&
          !own.is_pressed &&
          !(own.is_before_facet && (own.gap < 0. || !own.is_covered));
      }
    return reduce_steps(steps, communicator);
  }



  template <int dim>
  double
  PairContact<dim>::linearisation_error() const
  {
    double square = 0.;
    for (unsigned int s = 0; s < states.size(); ++s)
      {
        const PointState &state  = states[s];
        const double      weight = point_of(state).weight;
        square += std::pow(weight * mean_coverage(state) * state.error, 2);
        if (law_of(state) && has_friction && state.pressure > 0.)
          square += friction.error(s).norm_square() * weight * weight;
      }
    return std::sqrt(Utilities::MPI::sum(square, communicator));
  }



  template <int dim>
  double
  PairContact<dim>::round_off() const
  {
    double square = 0.;
    for (const PointState &state : states)
      if (state.status != Status::open)
        {
          double factor =
            law_of(state) ? std::abs(state.with_gap) : stiffness(state);
          if (law_of(state) && state.status == Status::stick)
            factor += friction.round_off(&state - states.data(), 1.);
          square += std::pow(point_of(state).weight * factor *
                               pair_of(state).round_off(state.point),
                             2);
        }
    return std::sqrt(Utilities::MPI::sum(square, communicator));
  }



  template <int dim>
  void
  PairContact<dim>::add_tangent(Matrix &tangent) const
  {
    const auto add = [&](const types::global_dof_index  row,
                         const unsigned int             n_columns,
                         const types::global_dof_index *columns,
                         const double                  *entries) {
      tangent.add(row, n_columns, columns, entries, /* elide zeros */ true);
    };
    for (const PointState &state : states)
      add_tangent(state, add);
    tangent.compress(VectorOperation::add);
  }



  template <int dim>
  void
  PairContact<dim>::add_open_tangent(Matrix &tangent) const
  {
    for (const PointState &state : states)
      for_each_multiplier(state, [&](const types::global_dof_index index) {
        tangent.add(index, index, open_diagonal(state));
      });
    tangent.compress(VectorOperation::add);
  }



  template <int dim>
  unsigned int
  PairContact<dim>::skin_place(const types::global_dof_index index) const
  {
    Assert(owned.is_element(index), ExcInternalError());
    const unsigned int place = place_in_skin[index - skin.front()];
    Assert(place != no_place, ExcInternalError());
    return place;
  }



  template <int dim>
  void
  PairContact<dim>::add_change_of_law(std::vector<FunctionalRow> &change) const
  {
    // Points of a facet that face the same other one act on the same unknowns: their
    // derivatives are summed first. In chunks, so that sums do not depend on the number
    // of threads.
    struct Sum
    {
      const std::vector<types::global_dof_index> *unknowns;
      /// Row by row.
      std::vector<double> entries;
    };
    constexpr unsigned int        chunk_size = 64;
    const unsigned int            n_states   = states.size();
    std::vector<std::vector<Sum>> chunks((n_states + chunk_size - 1) /
                                         chunk_size);
    for_each_range(
      chunks.size(),
      1,
      [&](const unsigned int begin, const unsigned int end) {
        for (unsigned int c = begin; c < end; ++c)
          for (unsigned int s = c * chunk_size;
               s < std::min(n_states, (c + 1) * chunk_size);
               ++s)
            {
              const PointState &state = states[s];
              if (!is_in_contact(state))
                continue;
              const auto &own = pair_of(state).rows(state.point).unknowns;
              if (chunks[c].empty() || *chunks[c].back().unknowns != own)
                chunks[c].push_back(
                  {&own, std::vector<double>(own.size() * own.size(), 0.)});
              double *sum = chunks[c].back().entries.data();
              add_tangent(state,
                          [&](const types::global_dof_index /*row*/,
                              const unsigned int n_columns,
                              const types::global_dof_index * /*columns*/,
                              const double *entries) {
                            for (unsigned int k = 0; k < n_columns; ++k)
                              *sum++ += entries[k];
                          });
            }
      });
    std::vector<unsigned int> places;
    for (const auto &chunk : chunks)
      for (const Sum &sum : chunk)
        {
          places.clear();
          for (const auto index : *sum.unknowns)
            places.push_back(skin_place(index));
          const double *entry = sum.entries.data();
          for (const unsigned int row : places)
            for (const unsigned int column : places)
              if (const double value = *entry++; value != 0.)
                change[row].emplace_back(column, value);
        }
  }



  template <int dim>
  void
  PairContact<dim>::differentiate_forces(
    std::vector<FunctionalRow> &change,
    std::vector<FunctionalRow> & /*with_residual*/) const
  {
    const auto add = [&](const types::global_dof_index  row,
                         const unsigned int             n_columns,
                         const types::global_dof_index *columns,
                         const double                  *entries) {
      FunctionalRow &own = change[skin_place(row)];
      for (unsigned int k = 0; k < n_columns; ++k)
        if (entries[k] != 0.)
          own.emplace_back(skin_place(columns[k]), entries[k]);
    };
    if (method.law)
      add_change_of_law(change);
    else
      for (const PointState &state : states)
        {
          // The zero multiplier of an open point stays zero: its effect on the forces
          // is irrelevant.
          const auto &multipliers = pair_of(state).multipliers(state.point);
          const bool  is_open     = law_of(state) ? !is_in_contact(state)
                                                  : state.status == Status::open &&
              std::all_of(multipliers.begin(),
                          multipliers.end(),
                          [](const double value) { return value == 0.; });
          if (is_open)
            continue;
          add_tangent(state, add);
          for_each_multiplier(state, [&](const types::global_dof_index index) {
            const double open = -open_diagonal(state);
            add(index, 1, &index, &open);
          });
        }
    // Terms of open points cancel.
    sum_columns(change);
  }



  template <int dim>
  template <typename Add>
  void
  PairContact<dim>::add_tangent(const PointState &state, const Add &add) const
  {
    const auto add_entry = [&](const types::global_dof_index row,
                               const types::global_dof_index column,
                               const double                  entry) {
      if (entry != 0.)
        add(row, 1, &column, &entry);
    };
    const Point       &point = point_of(state);
    const Pair        &pair  = pair_of(state);
    const unsigned int p     = state.point;
    const double       r     = stiffness(state);

    const auto  of_constraint = state.constraint.derivatives();
    const auto &multipliers   = point.multipliers;
    // Entries in the rows and columns of multipliers.
    if (!law_of(state))
      {
        const double on_multipliers = -weight * point.weight / r;
        for (unsigned int c = 0; c < dim; ++c)
          {
            if (multipliers[c] == no_index)
              continue;
            if (is_soft(state, c))
              add_entry(multipliers[c],
                        multipliers[c],
                        -weight * point.weight * softness(state, c));
            if (c == 0)
              add_entry(multipliers[0],
                        multipliers[0],
                        on_multipliers * of_constraint.normal_with_pressure);
            else
              {
                add_entry(multipliers[c],
                          multipliers[0],
                          on_multipliers *
                            of_constraint.tangential_with_pressure[c - 1]);
                for (unsigned int d = 0; d < n_tangents; ++d)
                  add_entry(multipliers[c],
                            multipliers[d + 1],
                            on_multipliers *
                              of_constraint.tangential_with_traction[c - 1][d]);
              }
          }
      }
    if (!is_in_contact(state))
      return;

    const auto   &rows        = pair.rows(p);
    const double  covered     = mean_coverage(state);
    const bool    is_over_end = law_of(state) && !rows.coverage.empty();
    const Caution caution     = n_frozen == 0 ? Caution::none
          : n_returns <= 2                    ? Caution::at_convex_vertices
                                              : Caution::at_all_vertices;
    static thread_local Turning turning;
    const bool                  turns = has_friction && !method.acts_over_step;
    if (turns)
      find_turning(state, caution, turning);
    const double       ends        = n_moving_ends();
    const auto        &derivatives = pair.derivatives(p,
                                               {ends * covered * state.pressure,
                                                       ends * covered * state.traction,
                                                       ends * state.energy},
                                               caution);
    const unsigned int m           = rows.unknowns.size();
    const double       factor      = weight * point.weight;
    // The mean energy changes with the gaps at the ends that move.
    const double energy_with_gap = is_over_end
      ? -.5 * ends * law_of(state)->pressure(state.state, point.cell_diameter)
      : 0.;
    const auto   slip_with = [&](const unsigned int d, const unsigned int b) {
      return derivatives.slip[d][b] + (turns ? turning[d][b] : 0.);
    };

    // Pressure and traction along variable directions, and their derivatives.
    Tensor<2, n_tangents> with_slip;
    Tangential            with_pressure;
    if (law_of(state) && has_friction && state.pressure > 0.)
      {
        const auto of_friction = friction.derivatives(&state - states.data());
        const auto along       = axes(state);
        for (unsigned int d = 0; d < n_tangents; ++d)
          {
            with_pressure[d] = along[d] * of_friction.with_pressure;
            for (unsigned int e = 0; e < n_tangents; ++e)
              with_slip[d][e] = along[d] * (of_friction.with_slip * along[e]);
          }
      }
    static thread_local std::vector<double> values;
    values.resize(m);
    for (unsigned int a = 0; a < m; ++a)
      {
        for (unsigned int b = 0; b < m; ++b)
          {
            double entry = derivatives.forces[a * m + b];
            if (law_of(state))
              {
                double change =
                  state.with_gap * rows.normal[a] * derivatives.gap[b];
                for (unsigned int d = 0; has_friction && d < n_tangents; ++d)
                  {
                    double with_b = 0.;
                    for (unsigned int e = 0; e < n_tangents; ++e)
                      with_b += with_slip[d][e] * slip_with(e, b);
                    with_b -=
                      with_pressure[d] * state.with_gap * derivatives.gap[b];
                    change += rows.tangential[d][a] * with_b;
                  }
                entry += covered * change;
                if (is_over_end)
                  {
                    double along = -state.pressure * rows.normal[a];
                    for (unsigned int d = 0; has_friction && d < n_tangents;
                         ++d)
                      along += state.traction[d] * rows.tangential[d][a];
                    entry += .5 * ends * along * derivatives.coverage[b] +
                      energy_with_gap * rows.coverage[a] * derivatives.gap[b];
                  }
              }
            values[b] = factor * entry;
          }
        add(rows.unknowns[a], m, rows.unknowns.data(), values.data());
      }
    if (law_of(state))
      return;

    // Columns and rows of the multipliers.
    const double half =
      method.condition == ClosingCondition::two_step && pass == 0 ? .5 : 1.;
    for (unsigned int a = 0; a < m; ++a)
      {
        const auto i = rows.unknowns[a];
        add_entry(i, multipliers[0], -factor * rows.normal[a]);
        add_entry(multipliers[0],
                  i,
                  -factor / r * of_constraint.normal_with_closing * half *
                    derivatives.gap[a]);
        for (unsigned int d = 0; has_exact_friction(state) && d < n_tangents;
             ++d)
          {
            add_entry(i, multipliers[d + 1], factor * rows.tangential[d][a]);
            double with_slip_of_a = 0.;
            for (unsigned int e = 0; e < n_tangents; ++e)
              with_slip_of_a +=
                of_constraint.tangential_with_slip[d][e] * slip_with(e, a);
            add_entry(multipliers[d + 1], i, -factor / r * with_slip_of_a);
          }
      }
  }



  template <int dim>
  const Couplings *
  PairContact<dim>::couplings()
  {
    bool more = false;
    for (PointState &state : states)
      {
        if (!is_in_contact(state))
          continue;
        for (const auto index : pair_of(state).rows(state.point).unknowns)
          if (!std::binary_search(state.coupled.begin(),
                                  state.coupled.end(),
                                  index))
            {
              more = true;
              std::vector<types::global_dof_index> now =
                pair_of(state).unknowns_nearby(state.point);
              now.insert(now.end(), state.coupled.begin(), state.coupled.end());
              std::sort(now.begin(), now.end());
              now.erase(std::unique(now.begin(), now.end()), now.end());
              state.coupled.swap(now);
              break;
            }
      }
    if (Utilities::MPI::max(more ? 1 : 0, communicator) == 1)
      ++all_couplings.version;
    if (all_couplings.version == 0)
      all_couplings.version = 1;
    all_couplings.lists.clear();
    for (const PointState &state : states)
      if (!state.coupled.empty())
        all_couplings.lists.push_back(state.coupled);
    return &all_couplings;
  }



  template <int dim>
  std::vector<int>
  PairContact<dim>::statuses() const
  {
    std::vector<int> values_of_points;
    for (const PointState &state : states)
      values_of_points.push_back(static_cast<int>(state.status));
    return values_of_points;
  }



  template <int dim>
  std::uint64_t
  PairContact<dim>::facets_signature() const
  {
    std::vector<int> values_of_points;
    for (const PointState &state : states)
      values_of_points.push_back(
        state.status != Status::open ? pair_of(state).passage(state.point) : 0);
    return global_hash(values_of_points, communicator);
  }



  template <int dim>
  ActiveSet
  PairContact<dim>::active_set() const
  {
    ActiveSet result{global_hash(statuses(), communicator), {}};
    // Directions are variable: only a tangent without contact is constant.
    const bool none = std::none_of(states.begin(),
                                   states.end(),
                                   [this](const PointState &state) {
                                     return is_in_contact(state);
                                   });
    if (Utilities::MPI::min(none ? 1 : 0, communicator) == 1)
      result.tangent_key = global_hash({}, communicator);
    return result;
  }



  template <int dim>
  std::string
  PairContact<dim>::active_set_description() const
  {
    const std::vector<int> all  = statuses();
    std::string            text = count_active(all, communicator);
    if (has_friction)
      text += ", " +
        std::to_string(Utilities::MPI::sum(static_cast<unsigned int>(std::count(
                                             all.begin(),
                                             all.end(),
                                             static_cast<int>(Status::stick))),
                                           communicator)) +
        " stick";
    return text;
  }



  template <int dim>
  void
  PairContact<dim>::begin_instant(const Vector &solution, const double time)
  {
    // Force and velocity are not used in an instant.
    const ContactStart start{solution, solution, solution, 0., time};
    for (const auto &pair : pairs)
      {
        pair->set_interference(start.end_time);
        pair->begin_step(start);
      }
    for (PointState &state : states)
      {
        state.candidate = pair_of(state).is_before_facet(state.point) &&
          pair_of(state).old_coverage(state.point) > 0.;
        state.state = {};
        if (state.candidate)
          state.state.gap = pair_of(state).old_gap(state.point);
        state.old_state = state.state;
      }
  }



  template <int dim>
  void
  PairContact<dim>::force_at(const Vector &solution,
                             const double  time,
                             Vector       &result)
  {
    result = 0.;
    // A constraint has no reaction outside of a stage.
    if (!method.law && !has_corners())
      return;
    begin_instant(solution, time);
    force = 0.;
    for (PointState &state : states)
      {
        if (!law_of(state))
          continue;
        state.traction = 0.;
        state.pressure = state.candidate
          ? -law_of(state)
               ->force(state.state, state.state, point_of(state).cell_diameter)
               .gap
          : 0.;
        state.energy   = 0.;
        if (state.candidate)
          set_energy(state);
        add_force(state);
      }
    force.compress(VectorOperation::add);
    result = force;
  }



  template <int dim>
  double
  PairContact<dim>::potential(const Vector &solution, const double time)
  {
    if (!method.law && !has_corners())
      return 0.;
    begin_instant(solution, time);
    double sum = 0.;
    for (const PointState &state : states)
      if (state.candidate)
        sum += potential_of(state,
                            state.state,
                            pair_of(state).old_coverage(state.point));
    return Utilities::MPI::sum(sum, communicator);
  }



  template <int dim>
  Vector
  PairContact<dim>::force_of_own_points(const ContactInstant &instant) const
  {
    Vector result(instant.contact_force);
    if (has_corners())
      result.add(-1., corner_part);
    return result;
  }



  template <int dim>
  double
  PairContact<dim>::normal_force(const PointState &state,
                                 const Vector     &contact_force) const
  {
    if (!state.candidate)
      return 0.;
    const Point &point = point_of(state);
    // Nodes of a surface with self-contact also have forces of other points.
    if (is_corner(state))
      return state.corner_force;
    if (method.law &&
        (!method.law->traits().nodal || pair_of(state).touches_itself() ||
         has_parts(state)))
      return point.weight * pair_of(state).old_coverage(state.point) *
        method.law->pressure(state.state, point.cell_diameter);
    if (pair_of(state).touches_itself())
      {
        double pressure = pair_of(state).multipliers(state.point)[0];
        if (const auto other = pair_of(state).other_side(state.point))
          pressure += pair_of(state).multipliers(*other)[0];
        return point.weight * pressure;
      }
    const auto &rows = pair_of(state).rows(state.point);
    double      sum  = 0.;
    for (unsigned int c = 0; c < dim; ++c)
      sum -= rows.direction[c] * contact_force(rows.unknowns[c]);
    return sum;
  }



  template <int dim>
  Vector
  PairContact<dim>::pressure_field(const ContactInstant &instant)
  {
    begin_instant(instant.solution, instant.time);
    const Vector own_force = force_of_own_points(instant);
    Vector       sums(instant.contact_force), weights(instant.contact_force);
    sums = weights = 0.;
    for (const PointState &state : states)
      {
        if (!state.candidate || is_corner(state) ||
            pair_of(state).is_other_side(state.point))
          continue;
        const double normal   = normal_force(state, own_force);
        const Point &point    = point_of(state);
        const auto  &unknowns = pair_of(state).rows(state.point).unknowns;
        for (unsigned int k = 0; k < point.nodes.size(); ++k)
          {
            const double part = point.nodes[k].second * point.nodes[k].second;
            sums(unknowns[k * dim]) += part * normal;
            weights(unknowns[k * dim]) += part * point.weight;
          }
      }
    sums.compress(VectorOperation::add);
    weights.compress(VectorOperation::add);
    for (const auto i : owned)
      {
        const double area = weights(i), total = sums(i);
        sums(i) = area > 0. ? total / area : 0.;
      }
    sums.compress(VectorOperation::insert);
    return sums;
  }



  template <int dim>
  ContactSummaries
  PairContact<dim>::summary(const ContactInstant &instant)
  {
    begin_instant(instant.solution, instant.time);
    const Vector     own_force = force_of_own_points(instant);
    ContactSummaries my_sums;
    // Area of the points that face a facet: only they have a gap. Each is counted once, in
    // front of one of the parts of the master; corners of the master have no area.
    std::map<types::boundary_id, double> my_area;
    std::vector<std::vector<bool>>       is_counted(n_own_pairs);
    for (unsigned int k = 0; k < n_own_pairs; ++k)
      is_counted[k].assign(pairs[k]->points().size(), false);
    for (const PointState &state : states)
      {
        if (!state.candidate || pair_of(state).is_other_side(state.point))
          continue;
        const Point    &point  = point_of(state);
        const double    normal = normal_force(state, own_force);
        ContactPoint    numbers;
        ContactSummary &sums = my_sums[point.boundary_id];
        if (!is_corner(state) &&
            !is_counted[first_part[state.pair]][state.point])
          {
            is_counted[first_part[state.pair]][state.point] = true;
            numbers.weight                                  = point.weight;
          }
        sums.add(numbers,
                 state.state.gap,
                 normal,
                 is_pressed(state, normal / point.weight));
        my_area[point.boundary_id] += numbers.weight;
        if (instant.report)
          instant.report({point.boundary_id,
                          pair_of(state).position(state.point),
                          state.state.gap,
                          normal,
                          numbers.weight,
                          is_pressed(state, normal / point.weight)});
      }
    for (unsigned int k = 0; k < n_own_pairs; ++k)
      for (unsigned int p = 0; p < pairs[k]->points().size(); ++p)
        if (first_part[k] == k && !is_counted[k][p] &&
            !pairs[k]->is_other_side(p))
          {
            const Point &point = pairs[k]->points()[p];
            my_sums[point.boundary_id].area += point.weight;
          }
    ContactSummaries summaries = reduce_summaries(my_sums, communicator);
    for (auto &[id, total] : summaries)
      {
        const double area = Utilities::MPI::sum(my_area[id], communicator);
        total.mean_gap *= total.area / area;
        if (area == 0.)
          total.mean_gap = total.smallest_gap =
            std::numeric_limits<double>::quiet_NaN();
      }
    return summaries;
  }


  template class PairContact<1>;
  template class PairContact<2>;
  template class PairContact<3>;
} // namespace Ricochet
