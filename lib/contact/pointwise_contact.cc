// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/active_set_signature.h>
#include <contact/pointwise_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  using dealii::VectorOperation;

  namespace
  {
    const dealii::Tensor<2, 3> identity(dealii::unit_symmetric_tensor<3>());
  }

  void
  PointwiseContact::begin_stage(const ContactStart &start, const double weight_)
  {
    weight     = weight_;
    time_step  = start.time_step;
    n_iterates = 0;
    point_force.assign(evaluator.contact_points().size(), {});
    kinematics->begin_step(start, old_state);
  }



  void
  PointwiseContact::accept_iterate()
  {
    ++n_iterates;
    if (!law->traits().piecewise_linear)
      accepted_linearisation = linearisation;
    accepted_branch = friction_branch;
  }



  void
  PointwiseContact::choose_linearisation()
  {
    // It helps to come near the solution; should it not, the law is linearised
    // at the gap again.
    linearisation = state;
    if (law->traits().piecewise_linear || n_iterates == 0 || n_iterates > 8)
      return;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        // The pressure that the last linearisation has at the new gap.
        const double h = evaluator.contact_points()[p].cell_diameter;
        const ContactPointState<> &at = accepted_linearisation[p];
        const double predicted        = -law->force(at, old_state[p], h).gap -
          law->tangent(at, old_state[p], h)[0][0] * (state[p].gap - at.gap);

        // Where the law meets the body's line through gap and predicted pressure:
        // excess(gap) = law's pressure - body's pressure falls with the gap. The
        // law's pressure being never negative and falling, the zero lies between
        // the gap and where the excess there would be used up by the body alone.
        const double        body_stiffness = augmentation / h;
        ContactPointState<> trial          = state[p];
        const auto          excess         = [&]() {
          return -law->force(trial, old_state[p], h).gap - predicted -
            body_stiffness * (trial.gap - state[p].gap);
        };
        double       value = excess();
        const double far   = state[p].gap + value / body_stiffness;
        double       low   = std::min(state[p].gap, far);
        double       high  = std::max(state[p].gap, far);
        const double close = 1e-3 * (high - low);
        for (unsigned int k = 0; k < 60 && high - low > close; ++k)
          {
            (value > 0. ? low : high) = trial.gap;
            const double slope =
              -law->tangent(trial, old_state[p], h)[0][0] - body_stiffness;
            const double step = -value / slope;
            if (std::abs(step) < close)
              break;
            trial.gap += step;
            if (!(trial.gap > low && trial.gap < high))
              trial.gap = .5 * (low + high);
            value = excess();
          }
        linearisation[p].gap = trial.gap;
      }
  }



  ContactPointForce<>
  PointwiseContact::linearised_force(const unsigned int p) const
  {
    const double        h      = evaluator.contact_points()[p].cell_diameter;
    ContactPointForce<> result = law->force(linearisation[p], old_state[p], h);
    const double        distance = state[p].gap - linearisation[p].gap;
    if (distance != 0.)
      result.gap +=
        law->tangent(linearisation[p], old_state[p], h)[0][0] * distance;
    return result;
  }



  double
  PointwiseContact::linearisation_error() const
  {
    if (law->traits().piecewise_linear && friction.coefficient == 0.)
      return 0.;
    double square = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        const double        error = point.weight *
          (point_force[p].gap -
           law->force(state[p], old_state[p], point.cell_diameter).gap);
        square += error * error;
        const double pressure =
          friction.coefficient > 0. ? friction_pressure(p) : 0.;
        if (pressure > 0.)
          square += point.weight * point.weight *
            (friction.traction_on(friction_branch[p], pressure, slip_rate[p]) -
             friction.traction(pressure, slip_rate[p]))
              .norm_square();
      }
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, evaluator.communicator));
  }



  double
  PointwiseContact::friction_pressure(const unsigned int p) const
  {
    return positive_part(-point_force[p].gap);
  }



  void
  PointwiseContact::choose_friction_branches()
  {
    friction_branch.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const double               pressure = friction_pressure(p);
        const dealii::Tensor<1, 3> rate     = slip_rate[p];
        dealii::Tensor<1, 3> trial = friction.tangential_compliance * rate;
        if (n_iterates > 0 && accepted_branch.size() == state.size())
          {
            // The traction that the last iterate predicts.
            const dealii::Tensor<1, 3> traction =
              friction.traction_on(accepted_branch[p], pressure, rate);
            const double r =
              std::min(friction.tangential_compliance,
                       augmentation * time_step /
                         evaluator.contact_points()[p].cell_diameter);
            trial =
              traction + r * (rate - traction / friction.tangential_compliance);
          }
        friction_branch[p] = friction.choose_branch(pressure, rate, trial);
      }
  }



  void
  PointwiseContact::clear_multipliers(Vector &vector) const
  {
    double *values = vector.trilinos_vector()[0];
    for (unsigned int i = n_displacements_owned;
         i < vector.locally_owned_size();
         ++i)
      values[i] = 0.;
  }



  void
  PointwiseContact::complete_residual(const Vector &solution, Vector &residual)
  {
    kinematics->evaluate(solution, state);
    choose_linearisation();
    force = 0.;
    point_force.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        point_force[p] = linearised_force(p);
        if (point_force[p].gap != 0.)
          kinematics->update_geometry(p);
        evaluator.add(p, point_force[p], force);
      }
    force.compress(VectorOperation::add);
    if (friction.coefficient > 0.)
      {
        slip_rate.assign(state.size(), dealii::Tensor<1, 3>());
        for (unsigned int p = 0; p < state.size(); ++p)
          if (kinematics->has_constant_rows() || friction_pressure(p) > 0.)
            slip_rate[p] = kinematics->geometry(p).slip() / time_step;
        choose_friction_branches();
        friction_part = 0.;
        for (unsigned int p = 0; p < state.size(); ++p)
          {
            const double pressure = friction_pressure(p);
            if (pressure > 0.)
              evaluator.add(p,
                            friction.traction_on(friction_branch[p],
                                                 pressure,
                                                 slip_rate[p]),
                            friction_part);
          }
        friction_part.compress(VectorOperation::add);
        force += friction_part;
      }
    residual.add(weight, force);

    clear_multipliers(force);
  }



  double
  PointwiseContact::friction_dissipation() const
  {
    if (friction.coefficient == 0.)
      return 0.;
    double sum = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      if (const double pressure = friction_pressure(p); pressure > 0.)
        sum += evaluator.contact_points()[p].weight * time_step *
          (friction.traction_on(friction_branch[p], pressure, slip_rate[p]) *
           slip_rate[p]);
    return dealii::Utilities::MPI::sum(sum, evaluator.communicator);
  }



  std::optional<PointwiseContact::FrictionDerivatives>
  PointwiseContact::friction_derivatives(const unsigned int p) const
  {
    const double pressure =
      friction.coefficient > 0. ? friction_pressure(p) : 0.;
    if (pressure == 0.)
      return {};
    FrictionDerivatives  derivatives;
    const PointGeometry &geometry = kinematics->geometry(p);
    const bool           constant = kinematics->has_constant_rows();
    friction.derivatives(friction_branch[p],
                         pressure,
                         slip_rate[p],
                         constant ? tangent_plane(geometry.normal) : identity,
                         derivatives.with_slip_rate,
                         derivatives.with_pressure);
    // Slip follows the way, and the turning of the plane in which it is.
    if (!constant)
      derivatives.with_slip_rate = derivatives.with_slip_rate *
        (tangent_plane(geometry.normal) * geometry.relative_way_derivative +
         geometry.projection_derivative(geometry.relative_way));
    return derivatives;
  }



  void
  PointwiseContact::complete_tangent(Matrix &tangent) const
  {
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint       &point = evaluator.contact_points()[p];
        const ContactPointTangent law_tangent =
          law->tangent(linearisation[p], old_state[p], point.cell_diameter);
        if (law_tangent[0].norm_square() > 0. || point_force[p].gap != 0.)
          kinematics->update_geometry(p);
        evaluator.add(p, weight, law_tangent, tangent);
        add_turning(p, tangent);

        if (const auto derivatives = friction_derivatives(p))
          {
            const dealii::Tensor<1, 3> &slope = derivatives->with_pressure;
            evaluator.add(p,
                          weight,
                          derivatives->with_slip_rate / time_step,
                          {{-law_tangent[0][0] * slope,
                            -law_tangent[0][1] * slope,
                            -law_tangent[0][2] * slope}},
                          tangent);
          }
      }
    tangent.compress(VectorOperation::add);
  }



  void
  PointwiseContact::add_turning(const unsigned int p, Matrix &tangent) const
  {
    if (kinematics->has_constant_rows() || point_force[p].gap == 0.)
      return;
    evaluator.add(p,
                  weight,
                  point_force[p].gap *
                    kinematics->geometry(p).direction_derivative,
                  {},
                  tangent);
  }



  void
  PointwiseContact::complete_open_tangent(Matrix &tangent) const
  {
    for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
      evaluator.add(p,
                    weight,
                    open_tangent(evaluator.contact_points()[p].cell_diameter),
                    tangent);
    tangent.compress(VectorOperation::add);
  }



  ContactPointTangent
  PointwiseContact::open_tangent(const double cell_diameter) const
  {
    ContactPointState<> open;
    open.gap = cell_diameter;
    return law->tangent(open, open, cell_diameter);
  }



  std::optional<PointwiseContact::Closing>
  PointwiseContact::closing_directions(const double cell_diameter) const
  {
    ContactPointState<> open, closed;
    open.gap   = cell_diameter;
    closed.gap = -cell_diameter;
    const ContactPointTangent change =
      law->tangent(closed, open, cell_diameter) - open_tangent(cell_diameter);
    Closing closing;
    while (closing.row < 2 && change[closing.row].norm() == 0.)
      ++closing.row;
    while (closing.column < 2 && change[closing.row][closing.column] == 0.)
      ++closing.column;
    const double entry = change[closing.row][closing.column];
    if (entry == 0.)
      return {};
    closing.trial = change[closing.row] / entry;
    for (unsigned int c = 0; c < 3; ++c)
      closing.test[c] = change[c][closing.column] / entry;
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        if (std::abs(change[c][d] -
                     entry * closing.test[c] * closing.trial[d]) >
            1e-12 * std::abs(change[c][d]))
          return {};
    return closing;
  }



  void
  PointwiseContact::find_directions()
  {
    // Whether the law is of that kind does not depend on h_T.
    if (!kinematics->has_constant_rows() || !closing_directions(1.) ||
        (friction.coefficient > 0. &&
         (law->traits().uses_stress || law->traits().needs_multiplier)))
      return;
    acts_through.emplace();
    Functionals         &functionals = acts_through->functionals;
    const ContactPoints &points      = evaluator.coefficients();
    for (const ContactPoint &point : points.points)
      {
        const auto add = [&](const auto &coefficient) {
          for (unsigned int k = point.begin; k < point.end; ++k)
            if (const double value = coefficient(k); value != 0.)
              functionals.add(points.index[k], value);
          functionals.end_functional();
          acts_through->order.push_back(point.initial_gap);
          return functionals.size() - 1;
        };
        const auto add_law = [&](const dealii::Tensor<1, 3> &direction) {
          return add([&](const unsigned int k) {
            return direction[0] * points.gap_coefficient[k] +
              direction[1] * points.stress_pressure_coefficient[k] +
              direction[2] * points.multiplier_coefficient[k];
          });
        };
        PointDirections own;
        own.closing          = *closing_directions(point.cell_diameter);
        own.test             = add_law(own.closing.test);
        own.trial            = own.closing.trial == own.closing.test
                     ? own.test
                     : add_law(own.closing.trial);
        own.first_tangential = functionals.size();
        if (friction.coefficient > 0.)
          {
            // Two directions across the normal, or one in the plane: the
            // longest projections of the axes.
            dealii::Tensor<2, 3> plane  = tangent_plane(point.obstacle_normal);
            unsigned int         n_axes = 0;
            for (unsigned int k = point.begin; k < point.end; ++k)
              n_axes = std::max(n_axes, points.component[k] + 1);
            for (unsigned int axis = 0; axis < n_axes; ++axis)
              for (unsigned int c = n_axes; c < 3; ++c)
                plane[axis][c] = plane[c][axis] = 0.;
            for (unsigned int t = 0; t + 1 < n_axes; ++t)
              {
                unsigned int longest = 0;
                for (unsigned int axis = 1; axis < n_axes; ++axis)
                  if (plane[axis].norm() > plane[longest].norm())
                    longest = axis;
                const dealii::Tensor<1, 3> tangential =
                  plane[longest] / plane[longest].norm();
                add([&](const unsigned int k) {
                  return tangential[points.component[k]] *
                    points.shape_value[k];
                });
                own.tangential.push_back(tangential);
                plane -= outer_product(tangential, tangential);
              }
          }
        directions.push_back(own);
      }
  }



  ContactStructure
  PointwiseContact::tangent_structure() const
  {
    ContactStructure structure;
    structure.rows                = evaluator.unknowns();
    structure.functionals         = acts_through;
    structure.has_multipliers     = law->traits().needs_multiplier;
    structure.is_nearly_symmetric = !structure.has_multipliers;
    const auto closing            = closing_directions(1.);
    structure.is_symmetric        = structure.is_nearly_symmetric && closing &&
      closing->test == closing->trial && friction.coefficient == 0. &&
      kinematics->has_constant_rows();
    return structure;
  }



  void
  PointwiseContact::tangent_change(std::vector<FunctionalRow> &change) const
  {
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint       &point = evaluator.contact_points()[p];
        const PointDirections    &own   = directions[p];
        const ContactPointTangent law_tangent =
          law->tangent(linearisation[p], old_state[p], point.cell_diameter);
        const double factor = weight * point.weight;
        const double closing =
          law_tangent[own.closing.row][own.closing.column] -
          open_tangent(
            point.cell_diameter)[own.closing.row][own.closing.column];
        if (closing != 0.)
          change[own.test].emplace_back(own.trial, factor * closing);

        const auto derivatives = friction_derivatives(p);
        if (!derivatives)
          continue;
        for (unsigned int t = 0; t < own.tangential.size(); ++t)
          {
            auto &row = change[own.first_tangential + t];
            for (unsigned int s = 0; s < own.tangential.size(); ++s)
              row.emplace_back(own.first_tangential + s,
                               factor / time_step *
                                 (own.tangential[t] *
                                  derivatives->with_slip_rate *
                                  own.tangential[s]));
            if (const double with_gap = -law_tangent[0][0] *
                  (own.tangential[t] * derivatives->with_pressure);
                with_gap != 0.)
              row.emplace_back(own.trial, factor * with_gap);
          }
      }
  }



  double
  PointwiseContact::round_off() const
  {
    double square = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint       &point = evaluator.contact_points()[p];
        const ContactPointTangent tangent =
          law->tangent(state[p], old_state[p], point.cell_diameter);
        // The gap is in the equation of a multiplier too.
        const double stiffness =
          std::max(std::abs(tangent[0][0]),
                   std::abs(tangent[2][0]) *
                     law->multiplier_scale(point.cell_diameter));
        const double force =
          point.weight * stiffness * kinematics->gap_round_off(p, state[p].gap);
        square += force * force;
        // Slip is a difference of displacements over a step.
        if (friction.coefficient > 0. && friction_branch[p].sticks &&
            friction_pressure(p) > 0.)
          {
            const double friction_force = point.weight *
              friction.tangential_compliance / time_step *
              kinematics->way_round_off(p);
            square += friction_force * friction_force;
          }
      }
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, evaluator.communicator));
  }



  std::vector<int>
  PointwiseContact::branches() const
  {
    std::vector<int> branches(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      branches[p] = law->branch(state[p],
                                old_state[p],
                                evaluator.contact_points()[p].cell_diameter);
    return branches;
  }



  std::optional<std::uint64_t>
  PointwiseContact::tangent_signature() const
  {
    // Without contact every law is linear.
    const std::vector<int> values = branches();
    const bool             turns  = !kinematics->has_constant_rows();
    if (!law->traits().piecewise_linear || friction.coefficient > 0. || turns)
      {
        bool active = std::any_of(values.begin(),
                                  values.end(),
                                  [](const int value) { return value != 0; });
        // A multiplier presses until the stage is solved, whatever the branch.
        if (friction.coefficient > 0. || turns)
          for (unsigned int p = 0; p < state.size(); ++p)
            active = active || friction_pressure(p) > 0. ||
              (turns && point_force[p].gap != 0.);
        if (dealii::Utilities::MPI::max(active ? 1 : 0,
                                        evaluator.communicator) == 1)
          return {};
      }
    return global_hash(values, evaluator.communicator);
  }



  std::uint64_t
  PointwiseContact::active_set_signature() const
  {
    std::vector<int> values = branches();
    for (unsigned int p = 0; p < friction_branch.size(); ++p)
      values.push_back(friction_branch[p].sticks);
    return global_hash(values, evaluator.communicator);
  }



  std::string
  PointwiseContact::active_set_description() const
  {
    std::string text = count_active(branches(), evaluator.communicator);
    if (friction.coefficient > 0.)
      {
        unsigned int n_sticking = 0;
        for (unsigned int p = 0; p < friction_branch.size(); ++p)
          n_sticking += friction_branch[p].sticks && friction_pressure(p) > 0.;
        text += ", " +
          std::to_string(dealii::Utilities::MPI::sum(n_sticking,
                                                     evaluator.communicator)) +
          " stick";
      }
    return text;
  }



  void
  PointwiseContact::force_at(const Vector &solution,
                             const double  time,
                             Vector       &result)
  {
    // With both states the same, a discrete derivative is the derivative.
    kinematics->begin_instant(time);
    kinematics->evaluate(solution, state);
    result = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPointForce<> point_force =
          law->force(state[p],
                     state[p],
                     evaluator.contact_points()[p].cell_diameter);
        if (point_force.gap != 0.)
          kinematics->update_geometry(p);
        evaluator.add(p, point_force, result);
      }
    result.compress(VectorOperation::add);
    clear_multipliers(result);
  }



  double
  PointwiseContact::potential(const Vector &solution, const double time)
  {
    kinematics->begin_instant(time);
    kinematics->evaluate(solution, state);
    double sum = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      sum += evaluator.contact_points()[p].weight *
        law->potential(state[p], evaluator.contact_points()[p].cell_diameter);
    return dealii::Utilities::MPI::sum(sum, evaluator.communicator);
  }



  void
  PointwiseContact::compute_row_scaling()
  {
    scaling = 0.;
    Vector boundary_mass(scaling);
    for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
      {
        const double stiffness =
          law->multiplier_scale(evaluator.contact_points()[p].cell_diameter);
        evaluator.add(p, {0., 0., stiffness}, scaling);
        evaluator.add(p, {0., 0., 1.}, boundary_mass);
      }
    scaling.compress(VectorOperation::add);
    boundary_mass.compress(VectorOperation::add);
    for (const auto i : scaling.locally_owned_elements())
      {
        const double mass = boundary_mass(i);
        scaling(i)        = mass > 0. ? scaling(i) / mass : 1.;
      }
    scaling.compress(VectorOperation::insert);
  }



  double
  PointwiseContact::normal_force(const unsigned int p,
                                 const Vector      &contact_force)
  {
    // In nodes the force of the step can be read off the vector; elsewhere the
    // pressure is that of the law at the end of the step.
    const ContactPoint &point = evaluator.contact_points()[p];
    if (!law->traits().nodal)
      return point.weight * law->pressure(state[p], point.cell_diameter);
    kinematics->update_geometry(p);
    return kinematics->nodal_normal_force(p, contact_force);
  }



  Vector
  PointwiseContact::pressure_field(const Vector &solution,
                                   const Vector &contact_force,
                                   const double  time)
  {
    kinematics->begin_instant(time);
    kinematics->evaluate(solution, state);
    std::vector<double> pressures(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      pressures[p] =
        normal_force(p, contact_force) / evaluator.contact_points()[p].weight;
    return evaluator.nodal_averages(pressures);
  }



  ContactSummaries
  PointwiseContact::summary(const Vector &solution,
                            const Vector &contact_force,
                            const double  time)
  {
    const ContactLawTraits traits = law->traits();
    kinematics->begin_instant(time);
    kinematics->evaluate(solution, state);
    ContactSummaries sums;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        const double        force = normal_force(p, contact_force);
        // Two-point laws are active over a step, the others at an instant.
        const bool is_active = traits.is_two_point && !traits.uses_stress
          ? force > 0.
          : law->branch(state[p], state[p], point.cell_diameter) != 0;
        sums[point.boundary_id].add(point, state[p].gap, force, is_active);
      }
    add_stress_pressure(solution, stress_evaluator, stress_state, sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
