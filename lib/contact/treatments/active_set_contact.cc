// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/active_set_contact.h>
#include <contact/treatments/active_set_signature.h>
#include <solvers/matrix_entries.h>

#include <deal.II/base/mpi.h>

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <map>

namespace Ricochet
{
  using dealii::Tensor;
  using dealii::VectorOperation;

  namespace
  {
    /// Angle (rad) between two obstacles below which they are one surface for a node.
    constexpr double smallest_angle = .05;
  } // namespace



  double
  ActiveSetContact::constraint_scale(const unsigned int p) const
  {
    const ContactPoint &point = evaluator.contact_points()[p];
    return augmentation / point.cell_diameter * point.weight;
  }



  ActiveSetContact::Closing
  ActiveSetContact::closing_kind() const
  {
    if (condition == Condition::signorini)
      return Closing::gap;
    return condition == Condition::two_step && pass == 0
      ? Closing::mean_gap
      : Closing::change_of_gap;
  }



  double
  ActiveSetContact::closing(const unsigned int p) const
  {
    switch (closing_kind())
      {
        case Closing::gap:
          return state[p].gap;
        case Closing::mean_gap:
          return .5 * (old_state[p].gap + state[p].gap);
        default:
          return kinematics->geometry(p).gap_increment;
      }
  }



  bool
  ActiveSetContact::share_nodes(ContactOperator &before)
  {
    auto *const other = dynamic_cast<ActiveSetContact *>(&before);
    if (!other)
      return false;
    const auto first_unknown = [](const ActiveSetContact &contact,
                                  const unsigned int      p) {
      const ContactPoints &points = contact.evaluator.coefficients();
      return points.index[points.points[p].begin];
    };
    std::map<dealii::types::global_dof_index, unsigned int> node_of;
    for (unsigned int q = 0; q < other->nodes.size(); ++q)
      node_of[first_unknown(*other, q)] = q;
    bool some = false;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (const auto known = node_of.find(first_unknown(*this, p));
          known != node_of.end())
        {
          some = true;
          holders.resize(nodes.size());
          other->holders.resize(other->nodes.size());
          holders[p].push_back({other, known->second, true});
          other->holders[known->second].push_back({this, p, false});
        }
    return some;
  }



  bool
  ActiveSetContact::is_held_before(const unsigned int p) const
  {
    return !holders.empty() &&
      std::any_of(holders[p].begin(),
                  holders[p].end(),
                  [](const Holder &holder) {
                    return holder.is_before &&
                      holder.contact->is_active(holder.node);
                  });
  }



  bool
  ActiveSetContact::is_held_elsewhere(const unsigned int p) const
  {
    return !holders.empty() &&
      std::any_of(holders[p].begin(),
                  holders[p].end(),
                  [](const Holder &holder) {
                    return holder.contact->nodes[holder.node].accepted_status !=
                      Status::open;
                  });
  }



  ActiveSetContact::Direction
  ActiveSetContact::direction(const unsigned int p) const
  {
    const PointGeometry &geometry = kinematics->geometry(p);
    Direction            result{geometry.normal, geometry.normal_derivative()};
    for (const Holder &holder : holders[p])
      {
        if (!holder.is_before || !holder.contact->is_active(holder.node))
          continue;
        const Direction    other = holder.contact->direction(holder.node);
        const double       along = result.vector * other.vector;
        const Tensor<1, 3> of_along =
          other.vector * result.derivative + result.vector * other.derivative;
        result.derivative -=
          outer_product(other.vector, of_along) + along * other.derivative;
        result.vector -= along * other.vector;
      }
    result.length = result.vector.norm();
    result.vector /= result.length;
    result.derivative =
      tangent_plane(result.vector) * result.derivative / result.length;
    return result;
  }



  Tensor<1, 3>
  ActiveSetContact::own_reaction(const unsigned int p) const
  {
    // The residual without any contact is that of the first one.
    const Node *first = &nodes[p];
    // Normals as columns: the own one, and at most two others.
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::ColMajor, 3, 3> normals(3,
                                                                            1);
    const auto add = [&](const Tensor<1, 3> &normal) {
      for (unsigned int c = 0; c < 3; ++c)
        normals(c, normals.cols() - 1) = normal[c];
    };
    const Tensor<1, 3> &own = kinematics->geometry(p).normal;
    add(own);
    for (auto holder = holders[p].rbegin(); holder != holders[p].rend();
         ++holder)
      {
        const Node &node = holder->contact->nodes[holder->node];
        if (holder->is_before)
          first = &node;
        if (node.accepted_status != Status::open && normals.cols() < 3)
          {
            normals.conservativeResize(3, normals.cols() + 1);
            add(holder->contact->kinematics->geometry(holder->node).normal);
          }
      }
    const Eigen::Vector3d residual(first->excess[0],
                                   first->excess[1],
                                   first->excess[2]);
    return normals.colPivHouseholderQr().solve(residual)[0] / weight * own;
  }



  void
  ActiveSetContact::begin_stage(const ContactStart &start, const double weight_)
  {
    weight         = weight_;
    first_in_stage = true;
    pass           = 0;
    kinematics->begin_step(start, old_state);
    if (condition == Condition::persistent)
      kinematics->predict(start.mean_velocity);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        Node &node            = nodes[p];
        node.initial_reaction = -1. * evaluator.at_node(p, start.contact_force);
        node.candidate        = true;
        // The mean velocity leads away from a curved surface, and pressed nodes
        // would be released; so would be nodes that rest on a plane with a gap of round-off.
        if (condition == Condition::persistent)
          {
            const double gap         = kinematics->predicted_gap(p);
            const bool   was_pressed = node.initial_reaction.norm_square() > 0.;
            const bool   is_near     = !kinematics->has_constant_rows() ||
              gap <= 1e-12 * evaluator.contact_points()[p].cell_diameter;
            node.candidate = gap <= 0. || (was_pressed && is_near);
          }
      }
  }



  ContactSteps
  ActiveSetContact::end_step(const Vector &begin,
                             const Vector &end,
                             const double  begin_time,
                             const double  end_time)
  {
    ContactSteps steps;
    kinematics->add_passing(begin, end, begin_time, end_time, steps);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        const ContactPoint  &point    = evaluator.contact_points()[p];
        const PointGeometry &geometry = kinematics->geometry(p);
        // The reaction is pressure times the direction, whose product with the
        // displacement increment is the gap increment.
        steps[point.boundary_id].add_point(
          !is_active(p) ? 0.
                        : (nodes[p].reaction * geometry.normal) /
              geometry.direction_length * (state[p].gap - old_state[p].gap),
          dealii::Point<3>(point.reference_position));
      }
    return reduce_steps(steps, evaluator.communicator);
  }



  void
  ActiveSetContact::accept_iterate()
  {
    for (Node &node : nodes)
      node.accepted_status = node.constraint.status();
    first_in_stage = false;
  }



  bool
  ActiveSetContact::next_pass()
  {
    if (condition != Condition::two_step || pass == 1)
      return false;
    pass           = 1;
    first_in_stage = true;
    for (Node &node : nodes)
      {
        node.candidate        = node.constraint.status() != Status::open;
        node.initial_reaction = node.reaction;
      }
    return true;
  }



  void
  ActiveSetContact::make_rows()
  {
    const std::vector<ContactPoint> &points = evaluator.contact_points();
    for (unsigned int p = 0; p < points.size(); ++p)
      {
        if (!kinematics->has_constant_rows())
          {
            jacobian.add_observables(p);
            continue;
          }
        const auto add = [&](const Tensor<1, 3> &vector) {
          const PointVector direction = on_displacement(vector);
          jacobian.add_direction(p, direction, direction, direction);
        };
        add(points[p].obstacle_normal);
        if (friction_coefficient > 0.)
          for (const Tensor<1, 3> &direction :
               tangent_directions(points[p].obstacle_normal,
                                  points[p].end - points[p].begin))
            add(direction);
      }
    own_structure.rows               = evaluator.unknowns();
    own_structure.functionals        = jacobian.all();
    own_structure.eliminates_rows    = true;
    own_traits.has_friction          = friction_coefficient > 0.;
    own_traits.has_moving_obstacles  = kinematics->has_moving_obstacles();
    own_traits.knows_stress_pressure = stress_evaluator.has_points();
  }



  void
  ActiveSetContact::find_held(const Constraints &constraints)
  {
    const ContactPoints &coefficients = evaluator.coefficients();
    for (const ContactPoint &point : evaluator.contact_points())
      {
        Tensor<1, 3> &free = is_free.emplace_back();
        for (unsigned int k = point.begin; k < point.end; ++k)
          free[coefficients.component[k]] =
            constraints.is_constrained(coefficients.index[k]) ? 0. : 1.;
      }
  }



  void
  ActiveSetContact::choose_status(const unsigned int p)
  {
    Node &node = nodes[p];
    node.constraint.set_status(Status::open);
    if (!node.candidate)
      return;
    const Tensor<1, 3> &normal = kinematics->geometry(p).normal;

    // The reaction of the last iterate: the residual of the equation of motion
    // in the nodes that were active. In the first iteration it is the reaction
    // of the last step.
    const bool is_before    = is_held_before(p),
               is_elsewhere = is_held_elsewhere(p);
    if (first_in_stage)
      node.reaction = node.initial_reaction;
    else if (node.accepted_status == Status::open)
      node.reaction = 0.;
    else
      node.reaction = is_elsewhere ? own_reaction(p) : node.excess / weight;
    const double friction =
      is_before || is_elsewhere ? 0. : friction_coefficient;
    const double normal_reaction = normal * node.reaction;
    if (friction == 0.)
      node.reaction = normal_reaction * normal;

    node.constraint.choose(constraint_state(p, node.reaction),
                           constraint_scale(p),
                           friction);
    if (!is_active(p))
      return;
    if (is_before)
      {
        const Direction along = direction(p);
        // Two obstacles there are one surface.
        if (along.length < smallest_angle)
          return node.constraint.set_status(Status::open);
        const double equation =
          node.constraint.equations(constraint_state(p, node.reaction)).normal;
        node.exchange =
          (weight * equation - along.vector * node.excess) * along.vector;
        return;
      }

    // The reaction is the residual of the equation of motion: together with it, the
    // equations of the constraint replace the rows of the node.
    const auto equations =
      node.constraint.equations(constraint_state(p, node.excess / weight));
    node.exchange =
      weight * (equations.normal * normal - equations.tangential) - node.excess;
  }



  ConstraintState<3>
  ActiveSetContact::constraint_state(const unsigned int  p,
                                     const Tensor<1, 3> &reaction) const
  {
    const Tensor<1, 3> &normal   = kinematics->geometry(p).normal;
    const double        pressure = normal * reaction;
    return {pressure,
            nodes[p].closing,
            pressure * normal - reaction,
            nodes[p].slip};
  }



  void
  ActiveSetContact::add_residual(const Vector &solution, Vector &residual)
  {
    looks_at_change = false;
    kinematics->evaluate(solution, state);
    const ContactPoints &coefficients = evaluator.coefficients();

    force         = 0.;
    friction_part = 0.;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        Node &node = nodes[p];
        if (node.candidate || (!holders.empty() && !holders[p].empty()))
          {
            look_at_geometry(p);
            node.excess = evaluator.at_node(p, residual);
            for (unsigned int c = 0; c < 3; ++c)
              node.excess[c] *= is_free[p][c];
          }
        choose_status(p);
        if (!is_active(p))
          continue;
        const ContactPoint &point = coefficients.points[p];
        const Tensor<1, 3>  tangential_reaction =
          tangent_plane(kinematics->geometry(p).normal) * node.reaction;
        for (unsigned int k = point.begin; k < point.end; ++k)
          {
            const unsigned int c = coefficients.component[k];
            residual(coefficients.index[k]) += node.exchange[c];
            force(coefficients.index[k]) = -node.reaction[c];
            if (friction_coefficient > 0.)
              friction_part(coefficients.index[k]) = -tangential_reaction[c];
          }
      }
    residual.compress(VectorOperation::add);
    force.compress(VectorOperation::insert);
    friction_part.compress(VectorOperation::insert);
  }



  ActiveSetContact::ExchangeDerivatives
  ActiveSetContact::exchange_derivatives(const unsigned int p) const
  {
    const Node          &node     = nodes[p];
    const PointGeometry &geometry = kinematics->geometry(p);
    const Tensor<1, 3>  &normal   = geometry.normal;
    const Tensor<2, 3>   one(dealii::unit_symmetric_tensor<3>()),
      plane                  = tangent_plane(normal);
    const auto of_constraint = node.constraint.derivatives();
    if (is_held_before(p))
      {
        const Direction along = direction(p);
        return {-outer_product(along.vector, along.vector),
                weight * of_constraint.normal_with_closing *
                    (outer_product(closing_derivative() * along.vector,
                                   geometry.gap_gradient) +
                     node.closing * along.derivative) -
                  (along.vector * node.excess) * along.derivative -
                  outer_product(along.vector, node.excess * along.derivative)};
      }
    // Derivatives by pressure n.e and traction -P e of the residual without
    // contact e (excess), over the weight.
    ExchangeDerivatives derivatives;
    derivatives.with_excess = of_constraint.tangential_with_traction * plane -
      one +
      outer_product(of_constraint.normal_with_pressure * normal -
                      of_constraint.tangential_with_pressure,
                    normal);

    // Derivatives by gap and slip, and by the turning normal and tangent plane.
    const Tensor<2, 3> turning = geometry.normal_derivative(),
                       slip_derivative =
                         plane * geometry.relative_way_derivative +
      geometry.projection_derivative(geometry.relative_way);
    derivatives.with_displacement = weight *
        (outer_product(closing_derivative() *
                         of_constraint.normal_with_closing * normal,
                       geometry.gap_gradient) +
         of_constraint.normal_with_closing * node.closing * turning -
         of_constraint.tangential_with_slip * slip_derivative) +
      of_constraint.tangential_with_traction *
        geometry.projection_derivative(node.excess) -
      outer_product(of_constraint.tangential_with_pressure,
                    node.excess * turning);
    return derivatives;
  }



  void
  ActiveSetContact::differentiate_forces(
    std::vector<FunctionalRow> &with_values,
    std::vector<FunctionalRow> &with_residual) const
  {
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (is_active(p))
        {
          const ExchangeDerivatives derivatives = exchange_derivatives(p);
          jacobian.add(p,
                       on_displacement(derivatives.with_displacement),
                       with_values);
          jacobian.add(p,
                       on_displacement(derivatives.with_excess),
                       with_residual);
        }
    sum_columns(with_values);
    sum_columns(with_residual);
  }



  void
  ActiveSetContact::evaluate_at_increment(const std::vector<double> &change,
                                          const std::vector<double> &excess)
  {
    if (!looks_at_change)
      observables_before = kinematics->observables();
    looks_at_change = true;
    observables.resize(nodes.size());
    for (unsigned int p = 0; p < nodes.size(); ++p)
      observables[p] = observables_before[p] + jacobian.in_point(p, change);
    kinematics->evaluate(observables, state);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        // Rows are orthonormal.
        nodes[p].excess = displacement_of(jacobian.in_point(p, excess));
        if (nodes[p].candidate)
          look_at_geometry(p);
        choose_status(p);
      }
  }



  void
  ActiveSetContact::look_at_geometry(const unsigned int p)
  {
    kinematics->update_geometry(p);
    nodes[p].closing = closing(p);
    if (friction_coefficient > 0.)
      nodes[p].slip = kinematics->geometry(p).slip();
  }



  void
  ActiveSetContact::forces_on_rows(std::vector<double> &coefficients) const
  {
    coefficients.assign(jacobian.all().functionals.size(), 0.);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (is_active(p))
        jacobian.add(p, on_displacement(nodes[p].exchange), coefficients);
  }



  void
  ActiveSetContact::add_tangent(Matrix &tangent) const
  {
    // Changed in place: the rows of an active node have the same columns in the
    // same order, because cells couple all components.
    const ContactPoints &coefficients = evaluator.coefficients();
    const MatrixEntries  entries(tangent);
    double *const        values = entry_values(tangent);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        if (!is_active(p))
          continue;
        const ContactPoint     &point  = coefficients.points[p];
        const unsigned int      n_rows = point.end - point.begin;
        std::array<double *, 3> rows{};
        std::array<int, 3>      own_columns{};
        int                     n_entries = 0;
        const int              *columns   = nullptr;
        for (unsigned int a = 0; a < n_rows; ++a)
          {
            const auto unknown = coefficients.index[point.begin + a];
            const int  row     = entries.row_number(unknown);
            rows[a]            = values + entries.begin[row];
            columns            = entries.column + entries.begin[row];
            n_entries          = entries.begin[row + 1] - entries.begin[row];
            own_columns[a]     = entries.column_number(unknown);
          }

        // Factors of the old rows in the new ones, and the entries in the
        // columns of the node itself.
        const ExchangeDerivatives derivatives = exchange_derivatives(p);
        const Tensor<2, 3>        from_rows =
          Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) +
          derivatives.with_excess;
        const Tensor<2, 3> &own = derivatives.with_displacement;
        new_rows.assign(n_rows * n_entries, 0.);
        for (unsigned int a = 0; a < n_rows; ++a)
          for (unsigned int b = 0; b < n_rows; ++b)
            for (int j = 0; j < n_entries; ++j)
              new_rows[a * n_entries + j] += from_rows[a][b] * rows[b][j];
        for (int j = 0; j < n_entries; ++j)
          for (unsigned int b = 0; b < n_rows; ++b)
            if (columns[j] == own_columns[b])
              for (unsigned int a = 0; a < n_rows; ++a)
                new_rows[a * n_entries + j] += own[a][b];
        for (unsigned int a = 0; a < n_rows; ++a)
          std::copy(&new_rows[a * n_entries],
                    &new_rows[a * n_entries] + n_entries,
                    rows[a]);
      }
  }



  double
  ActiveSetContact::round_off() const
  {
    double square = 0.;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (is_active(p))
        {
          const double force =
            constraint_scale(p) * kinematics->gap_round_off(p, state[p].gap);
          square += force * force;
          if (nodes[p].constraint.status() == Status::stick)
            {
              const double stick =
                constraint_scale(p) * kinematics->way_round_off(p);
              square += stick * stick;
            }
        }
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, evaluator.communicator));
  }



  std::vector<int>
  ActiveSetContact::statuses() const
  {
    std::vector<int> values(nodes.size());
    for (unsigned int p = 0; p < nodes.size(); ++p)
      values[p] = static_cast<int>(nodes[p].constraint.status());
    return values;
  }



  ActiveSet
  ActiveSetContact::active_set() const
  {
    std::vector<int> values = statuses();
    values.push_back(static_cast<int>(closing_kind()));
    ActiveSet result{global_hash(values, evaluator.communicator), {}};
    // The direction of slip is part of the tangent, and so are variable normals.
    const bool turns = !kinematics->has_constant_rows();
    if (friction_coefficient > 0. || turns)
      {
        const bool has_directions =
          std::any_of(nodes.begin(), nodes.end(), [&](const Node &node) {
            return turns ? node.constraint.status() != Status::open
                         : node.constraint.status() == Status::slip;
          });
        if (dealii::Utilities::MPI::max(has_directions ? 1 : 0,
                                        evaluator.communicator) == 1)
          return result;
      }
    result.tangent_key = result.hash;
    return result;
  }



  std::string
  ActiveSetContact::active_set_description() const
  {
    std::string text = count_active(statuses(), evaluator.communicator);
    if (friction_coefficient > 0.)
      text += ", " +
        std::to_string(dealii::Utilities::MPI::sum(
          static_cast<unsigned int>(
            std::count_if(nodes.begin(),
                          nodes.end(),
                          [](const Node &node) {
                            return node.constraint.status() == Status::stick;
                          })),
          evaluator.communicator)) +
        " stick";
    return text;
  }



  double
  ActiveSetContact::friction_dissipation() const
  {
    if (friction_coefficient == 0.)
      return 0.;
    double sum = 0.;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (is_active(p))
        sum -= nodes[p].reaction * nodes[p].slip;
    return dealii::Utilities::MPI::sum(sum, evaluator.communicator);
  }



  Vector
  ActiveSetContact::pressure_field(const ContactInstant &instant)
  {
    kinematics->begin_instant(instant.time);
    kinematics->evaluate(instant.solution, state);
    std::vector<double> pressures;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        kinematics->update_geometry(p);
        pressures.push_back(
          kinematics->nodal_normal_force(p, instant.contact_force) /
          evaluator.contact_points()[p].weight);
      }
    return evaluator.nodal_averages(pressures);
  }



  ContactSummaries
  ActiveSetContact::summary(const ContactInstant &instant)
  {
    kinematics->begin_instant(instant.time);
    kinematics->evaluate(instant.solution, state);
    ContactSummaries sums;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        kinematics->update_geometry(p);
        const double node_reaction =
          kinematics->nodal_normal_force(p, instant.contact_force);
        sums[point.boundary_id].add(point,
                                    state[p].gap,
                                    node_reaction,
                                    node_reaction > 0.);
        if (instant.report)
          instant.report({point.boundary_id,
                          kinematics->position(p),
                          state[p].gap,
                          node_reaction,
                          point.weight,
                          node_reaction > 0.});
      }
    add_stress_pressure(instant.solution,
                        stress_evaluator,
                        stress_observables,
                        sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
