// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/active_set_contact.h>
#include <contact/treatments/active_set_signature.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <array>

namespace Ricochet
{
  using dealii::Tensor;
  using dealii::VectorOperation;

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



  void
  ActiveSetContact::begin_stage(const ContactStart &start, const double weight_)
  {
    weight         = weight_;
    first_in_stage = true;
    pass           = 0;
    kinematics->begin_step(start, old_state);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        Node &node            = nodes[p];
        node.initial_reaction = -1. * evaluator.at_node(p, start.contact_force);
        node.candidate        = true;
        // Along a curved surface the mean velocity leads away from it, and
        // nodes that are pressed would be let go.
        if (condition == Condition::persistent)
          node.candidate = kinematics->predicted_gap(p) <= 0. ||
            (!kinematics->has_constant_rows() &&
             node.initial_reaction.norm_square() > 0.);
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
        // displacement increment is that of the gap.
        steps[point.boundary_id].add_point(
          nodes[p].status == Status::open
            ? 0.
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
      node.accepted_status = node.status;
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
        node.candidate        = node.status != Status::open;
        node.initial_reaction = node.reaction;
      }
    return true;
  }



  void
  ActiveSetContact::make_functionals()
  {
    const ContactPoints &coefficients = evaluator.coefficients();
    for (const ContactPoint &point : coefficients.points)
      {
        const unsigned int         n_axes = point.end - point.begin;
        std::vector<Tensor<1, 3>> &own    = directions.emplace_back();
        if (kinematics->has_constant_rows())
          {
            own.push_back(point.obstacle_normal);
            if (friction_coefficient > 0.)
              for (const Tensor<1, 3> &direction :
                   directions_along_plane(point.obstacle_normal, n_axes))
                own.push_back(direction);
          }
        else
          for (unsigned int axis = 0; axis < n_axes; ++axis)
            {
              own.emplace_back();
              own.back()[axis] = 1.;
            }
        for (const Tensor<1, 3> &direction : own)
          {
            for (unsigned int k = point.begin; k < point.end; ++k)
              if (const double value = direction[coefficients.component[k]];
                  value != 0.)
                functionals.functionals.add(coefficients.index[k], value);
            functionals.functionals.end_functional();
            functionals.order.push_back(point.initial_gap);
          }
      }
  }



  template <typename Use>
  void
  ActiveSetContact::for_each_node(const Use &use) const
  {
    unsigned int functional = 0;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        use(p, functional, directions[p]);
        functional += directions[p].size();
      }
  }



  void
  ActiveSetContact::choose_status(const unsigned int p)
  {
    Node &node  = nodes[p];
    node.status = Status::open;
    if (!node.candidate)
      return;
    const Tensor<1, 3> &normal = kinematics->geometry(p).normal;
    const double        scale  = constraint_scale(p);

    // The reaction of the last iterate: what the equation of motion leaves
    // over in the nodes that were active. In the first iteration it is the
    // reaction of the last step.
    if (first_in_stage)
      node.reaction = node.initial_reaction;
    else if (node.accepted_status == Status::open)
      node.reaction = 0.;
    else
      node.reaction = node.excess / weight;
    const double normal_reaction = normal * node.reaction;
    if (friction_coefficient == 0.)
      node.reaction = normal_reaction * normal;

    if (!(normal_reaction - scale * node.closing > 0.))
      return;

    node.status             = Status::slip;
    node.friction_direction = 0.;
    node.friction_ratio     = 0.;
    if (friction_coefficient > 0.)
      {
        const Tensor<1, 3> friction_trial =
          node.reaction - normal_reaction * normal - scale * node.slip;
        const double size = friction_trial.norm();
        if (size < friction_coefficient * normal_reaction)
          node.status = Status::stick;
        else if (size > 0. && normal_reaction >= 0.)
          {
            // A node that just became active has no reaction yet, and
            // already the direction of its friction.
            node.friction_direction = friction_trial / size;
            node.friction_ratio = friction_coefficient * normal_reaction / size;
          }
      }

    // Replace the normal component, and the tangential ones as well.
    const double normal_excess = normal * node.excess;
    node.exchange = (scale * node.closing - normal_excess) * normal;
    if (node.status == Status::stick)
      node.exchange +=
        scale * node.slip - (node.excess - normal_excess * normal);
    else
      node.exchange -=
        friction_coefficient * normal_excess * node.friction_direction;
  }



  void
  ActiveSetContact::complete_residual(const Vector &solution, Vector &residual)
  {
    looks_at_change = false;
    kinematics->evaluate(solution, state);
    const ContactPoints &coefficients = evaluator.coefficients();

    force         = 0.;
    friction_part = 0.;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        Node &node = nodes[p];
        if (node.candidate)
          {
            look_at_geometry(p);
            node.excess = evaluator.at_node(p, residual);
          }
        choose_status(p);
        if (node.status == Status::open)
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
  ActiveSetContact::exchange_derivatives(
    const unsigned int  p,
    const Tensor<1, 3> &normal,
    const Tensor<1, 3> &friction_direction) const
  {
    // The normal component n.e of the excess e is taken out and replaced by the
    // constraint. The tangential ones stay (no friction), are replaced too (stick),
    // or lose
    //   ratio (P - d d^T) (e - scale weight way) + mu d n.e
    // (slip, d being the direction of friction, P the projection on the tangent
    // plane).
    const Node         &node  = nodes[p];
    const double        scale = constraint_scale(p);
    const Tensor<2, 3>  plane = tangent_plane(normal);
    ExchangeDerivatives derivatives;
    const Tensor<2, 3>  along_normal = outer_product(normal, normal);
    derivatives.with_excess          = -along_normal;
    derivatives.with_displacement = closing_derivative() * scale * along_normal;
    if (node.status == Status::stick)
      {
        derivatives.with_excess -= plane;
        derivatives.with_displacement += scale * plane;
      }
    else if (friction_coefficient > 0.)
      {
        const Tensor<1, 3> &d = friction_direction;
        const Tensor<2, 3>  across =
          node.friction_ratio * (plane - outer_product(d, d));
        derivatives.with_excess -=
          across + friction_coefficient * outer_product(d, normal);
        derivatives.with_displacement += scale * weight * across;
      }
    return derivatives;
  }



  template <typename Entries>
  void
  ActiveSetContact::change_of_functionals(
    const Entries              &entries_of,
    std::vector<FunctionalRow> &change) const
  {
    for_each_node(
      [&](const unsigned int p, const unsigned int first, const auto &own) {
        if (nodes[p].status == Status::open)
          return;
        Tensor<1, 3> normal             = kinematics->geometry(p).normal,
                     friction_direction = nodes[p].friction_direction;
        if (kinematics->has_constant_rows())
          {
            // In the frame of the directions, where ones and zeros are exact.
            normal    = 0.;
            normal[0] = 1.;
            for (unsigned int t = 1; t < own.size(); ++t)
              friction_direction[t] = nodes[p].friction_direction * own[t];
            friction_direction[0] = 0.;
          }
        const Tensor<2, 3> entries =
          entries_of(p, exchange_derivatives(p, normal, friction_direction));
        for (unsigned int a = 0; a < own.size(); ++a)
          for (unsigned int b = 0; b < own.size(); ++b)
            if (entries[a][b] != 0.)
              change[first + a].emplace_back(first + b, entries[a][b]);
      });
  }



  void
  ActiveSetContact::tangent_change(std::vector<FunctionalRow> &change) const
  {
    change_of_functionals(
      [&](const unsigned int p, const ExchangeDerivatives &derivatives) {
        Tensor<2, 3> entries = derivatives.with_displacement;
        if (!kinematics->has_constant_rows())
          add_turning(p, entries);
        return entries;
      },
      change);
  }



  void
  ActiveSetContact::excess_change(std::vector<FunctionalRow> &change) const
  {
    change_of_functionals(
      [&](const unsigned int /*p*/, const ExchangeDerivatives &derivatives) {
        return derivatives.with_excess;
      },
      change);
  }



  void
  ActiveSetContact::look_at_change(const std::vector<double> &change,
                                   const std::vector<double> &excess)
  {
    const bool turns = !kinematics->has_constant_rows();
    if (!looks_at_change)
      {
        for (unsigned int p = 0; p < nodes.size(); ++p)
          {
            nodes[p].gap_before     = state[p].gap;
            nodes[p].closing_before = nodes[p].closing;
            nodes[p].slip_before    = nodes[p].slip;
          }
        if (turns)
          displacements_before = kinematics->displacements();
      }
    looks_at_change = true;
    if (turns)
      displaced = displacements_before;
    for_each_node(
      [&](const unsigned int p, const unsigned int first, const auto &own) {
        Node &node  = nodes[p];
        node.excess = 0.;
        for (unsigned int a = 0; a < own.size(); ++a)
          node.excess += excess[first + a] * own[a];
        if (turns)
          {
            for (unsigned int a = 0; a < own.size(); ++a)
              displaced[p] += change[first + a] * own[a];
            return;
          }
        state[p].gap = node.gap_before + change[first];
        node.closing =
          node.closing_before + closing_derivative() * change[first];
        node.slip = node.slip_before;
        for (unsigned int t = 1; t < own.size(); ++t)
          node.slip += change[first + t] * own[t];
      });
    if (turns)
      kinematics->displace(displaced, state);
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        if (turns && nodes[p].candidate)
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
  ActiveSetContact::force_change(std::vector<double> &coefficients) const
  {
    coefficients.assign(functionals.order.size(), 0.);
    for_each_node(
      [&](const unsigned int p, const unsigned int first, const auto &own) {
        if (nodes[p].status != Status::open)
          for (unsigned int a = 0; a < own.size(); ++a)
            coefficients[first + a] = nodes[p].exchange * own[a];
      });
  }



  void
  ActiveSetContact::complete_tangent(Matrix &tangent) const
  {
    // In place, on the rows of the active nodes, which have the same columns in the
    // same order, because cells couple all components.
    const ContactPoints &coefficients = evaluator.coefficients();
    const auto          &epetra       = tangent.trilinos_matrix();
    for (unsigned int p = 0; p < nodes.size(); ++p)
      {
        const Node &node = nodes[p];
        if (node.status == Status::open)
          continue;
        const ContactPoint     &point  = coefficients.points[p];
        const unsigned int      n_rows = point.end - point.begin;
        std::array<double *, 3> rows{};
        std::array<int, 3>      own_columns{};
        int                     n_entries = 0;
        int                    *columns   = nullptr;
        for (unsigned int a = 0; a < n_rows; ++a)
          {
            const auto unknown =
              static_cast<dealii::TrilinosWrappers::types::int_type>(
                coefficients.index[point.begin + a]);
            const int error = epetra.ExtractMyRowView(epetra.LRID(unknown),
                                                      n_entries,
                                                      rows[a],
                                                      columns);
            AssertThrow(error == 0, dealii::ExcTrilinosError(error));
            own_columns[a] = epetra.LCID(unknown);
          }

        // What multiplies the old rows in the new ones, and what stands in the
        // columns of the node itself.
        const ExchangeDerivatives derivatives =
          exchange_derivatives(p,
                               kinematics->geometry(p).normal,
                               node.friction_direction);
        const Tensor<2, 3> from_rows =
          Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) +
          derivatives.with_excess;
        Tensor<2, 3> own = derivatives.with_displacement;
        if (!kinematics->has_constant_rows())
          add_turning(p, own);
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



  void
  ActiveSetContact::add_turning(const unsigned int p, Tensor<2, 3> &own) const
  {
    const Node          &node     = nodes[p];
    const PointGeometry &geometry = kinematics->geometry(p);
    const Tensor<1, 3>  &normal   = geometry.normal;
    const double         scale    = constraint_scale(p);

    // scale closing n: the gap has a gradient of its own, and n turns.
    const Tensor<2, 3> turning = geometry.normal_derivative();
    own += closing_derivative() * scale *
        outer_product(normal, geometry.gap_gradient - normal) +
      scale * node.closing * turning;

    // The slip instead of the way of the node alone.
    const Tensor<2, 3> plane = tangent_plane(normal);
    const Tensor<2, 3> slip_derivative =
      plane * geometry.relative_way_derivative +
      geometry.projection_derivative(geometry.relative_way);
    if (node.status == Status::stick)
      {
        own += scale * (slip_derivative - plane);
        return;
      }
    // P excess - mu (n . excess) d, with the direction of friction d.
    const Tensor<1, 3> &direction = node.friction_direction;
    own += geometry.projection_derivative(node.excess) -
      friction_coefficient * outer_product(direction, node.excess * turning);
    // d is the unit vector of P reaction - scale slip.
    const Tensor<2, 3> across = weight * node.friction_ratio *
      (Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) -
       outer_product(direction, direction));
    own += across *
        (scale * slip_derivative -
         geometry.projection_derivative(node.reaction)) -
      across * plane * scale;
  }



  double
  ActiveSetContact::round_off() const
  {
    double square = 0.;
    for (unsigned int p = 0; p < nodes.size(); ++p)
      if (nodes[p].status != Status::open)
        {
          const double force =
            constraint_scale(p) * kinematics->gap_round_off(p, state[p].gap);
          square += force * force;
          if (nodes[p].status == Status::stick)
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
      values[p] = static_cast<int>(nodes[p].status);
    return values;
  }



  std::optional<std::uint64_t>
  ActiveSetContact::tangent_signature() const
  {
    // The direction of slip is part of the tangent, and so are normals that turn.
    const bool turns = !kinematics->has_constant_rows();
    if (friction_coefficient > 0. || turns)
      {
        const bool has_directions =
          std::any_of(nodes.begin(), nodes.end(), [&](const Node &node) {
            return turns ? node.status != Status::open
                         : node.status == Status::slip;
          });
        if (dealii::Utilities::MPI::max(has_directions ? 1 : 0,
                                        evaluator.communicator) == 1)
          return {};
      }
    return active_set_signature();
  }



  std::uint64_t
  ActiveSetContact::active_set_signature() const
  {
    std::vector<int> values = statuses();
    values.push_back(static_cast<int>(closing_kind()));
    return global_hash(values, evaluator.communicator);
  }



  std::string
  ActiveSetContact::active_set_description() const
  {
    std::string text = count_active(statuses(), evaluator.communicator);
    if (friction_coefficient > 0.)
      text += ", " +
        std::to_string(dealii::Utilities::MPI::sum(
          static_cast<unsigned int>(std::count_if(nodes.begin(),
                                                  nodes.end(),
                                                  [](const Node &node) {
                                                    return node.status ==
                                                      Status::stick;
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
      if (nodes[p].status != Status::open)
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
      }
    add_stress_pressure(instant.solution, stress_evaluator, stress_state, sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
