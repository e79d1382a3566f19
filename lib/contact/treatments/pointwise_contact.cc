// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/pointwise_contact.h>
#include <contact/treatments/power_law_linearisation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  using dealii::Tensor;
  using dealii::VectorOperation;

  void
  PointwiseContact::begin_stage(const ContactStart &start, const double weight_)
  {
    weight     = weight_;
    n_iterates = 0;
    friction.begin_stage(start.slip_time());
    point_force.assign(evaluator.contact_points().size(), {});
    kinematics->begin_step(start, old_state);
  }



  bool
  PointwiseContact::next_pass()
  {
    return friction.next_pass(
      [&](const unsigned int p) { return kinematics->way_round_off(p); },
      evaluator.communicator);
  }



  ContactSteps
  PointwiseContact::end_step(const Vector &begin,
                             const Vector &end,
                             const double  begin_time,
                             const double  end_time)
  {
    ContactSteps steps;
    kinematics->add_passing(begin, end, begin_time, end_time, steps);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        const double        h     = point.cell_diameter;
        // The increment of the gap is the difference of gaps, see ContactKinematics.
        const double work =
          point_force[p].gap * (state[p].gap - old_state[p].gap) +
          point_force[p].stress_pressure *
            (state[p].stress_pressure - old_state[p].stress_pressure);
        steps[point.boundary_id].add_point(
          point.weight *
            (law->potential(state[p], h) - law->potential(old_state[p], h) -
             work),
          dealii::Point<3>(point.reference_position));
      }
    return reduce_steps(steps, evaluator.communicator);
  }



  void
  PointwiseContact::accept_iterate()
  {
    ++n_iterates;
    if (!law->traits().piecewise_linear)
      accepted_linearisation = linearisation;
    friction.accept_iterate();
  }



  void
  PointwiseContact::choose_linearisation()
  {
    // Linearisation away from the gap helps far from the solution; if it does
    // not, the law is linearised at the gap again.
    linearisation = state;
    if (law->traits().piecewise_linear || n_iterates == 0 || n_iterates > 8)
      return;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const double h       = evaluator.contact_points()[p].cell_diameter;
        linearisation[p].gap = linearisation_gap(*law,
                                                 accepted_linearisation[p],
                                                 state[p],
                                                 old_state[p],
                                                 h,
                                                 augmentation / h);
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
    if (law->traits().piecewise_linear && !friction.exists())
      return 0.;
    double square = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        const double        error = point.weight *
          (point_force[p].gap -
           law->force(state[p], old_state[p], point.cell_diameter).gap);
        square += error * error;
        if (friction_acts(p))
          square +=
            point.weight * point.weight * friction.error(p).norm_square();
      }
    return std::sqrt(
      dealii::Utilities::MPI::sum(square, evaluator.communicator));
  }



  double
  PointwiseContact::friction_dissipation() const
  {
    if (!friction.exists())
      return 0.;
    double sum = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      if (friction_acts(p))
        sum += evaluator.contact_points()[p].weight * friction.dissipation(p);
    return dealii::Utilities::MPI::sum(sum, evaluator.communicator);
  }



  void
  PointwiseContact::clear_multipliers(Vector &vector) const
  {
    double *values = local_values(vector);
    for (unsigned int i = n_displacements_owned;
         i < vector.locally_owned_size();
         ++i)
      values[i] = 0.;
  }



  void
  PointwiseContact::add_residual(const Vector &solution, Vector &residual)
  {
    looks_at_change = false;
    kinematics->evaluate(solution, state);
    evaluate_laws();
    force = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      evaluator.add(p, along_direction(p, point_force[p]), force);
    force.compress(VectorOperation::add);
    if (friction.exists())
      {
        friction_part = 0.;
        for (unsigned int p = 0; p < state.size(); ++p)
          if (friction_acts(p))
            evaluator.add(p,
                          on_displacement(friction.traction(p)),
                          friction_part);
        friction_part.compress(VectorOperation::add);
        force += friction_part;
      }
    residual.add(weight, force);

    clear_multipliers(force);
  }



  PointVector
  PointwiseContact::along_direction(const unsigned int         p,
                                    const ContactPointForce<> &law_force) const
  {
    PointVector result;
    if (law_force.gap != 0.)
      {
        kinematics->update_geometry(p);
        const PointGeometry &geometry = kinematics->geometry(p);
        result = on_displacement(law_force.gap * geometry.direction_length *
                                 geometry.normal);
      }
    result[PointPlace::stress_pressure] = law_force.stress_pressure;
    result[PointPlace::multiplier]      = law_force.multiplier;
    return result;
  }



  void
  PointwiseContact::evaluate_laws()
  {
    choose_linearisation();
    point_force.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      point_force[p] = linearised_force(p);
    if (!friction.exists())
      return;
    friction.begin_evaluation(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        // Geometry is expensive in points without pressure, except where directions
        // are constant.
        const double pressure = positive_part(-point_force[p].gap);
        Tensor<1, 3> slip;
        if (pressure > 0. || kinematics->has_constant_rows())
          {
            kinematics->update_geometry(p);
            slip = kinematics->geometry(p).slip();
          }
        friction.evaluate(p,
                          pressure,
                          slip,
                          evaluator.contact_points()[p].cell_diameter);
      }
    friction.change_worst_only(evaluator.communicator);
  }



  void
  PointwiseContact::find_open_tangents()
  {
    for (const ContactPoint &point : evaluator.contact_points())
      {
        ContactPointTangent &open =
          open_tangents.emplace_back(open_tangent(*law, point.cell_diameter));
        if (!rows_have_directions)
          for (unsigned int c = 0; c < 3; ++c)
            open[0][c] = open[c][0] = 0.;
      }
  }



  void
  PointwiseContact::make_rows()
  {
    // Rows need a closing in each point of all ranks; a law with a length of its own may have none for
    // some h_T.
    const auto closing = closing_directions(*law, 1.);
    for (const ContactPoint &point : evaluator.contact_points())
      if (const auto own = closing_directions(*law, point.cell_diameter); own)
        closings.push_back(*own);
    const bool all_close =
      closing && closings.size() == evaluator.contact_points().size();
    if (Utilities::MPI::min(all_close ? 1U : 0U, evaluator.communicator) == 0)
      return;
    // Directions are fewer than unknowns; but not with friction in points of faces,
    // each of which has three. With rows along directions, the forces of a multiplier
    // stay in the matrix of the body, on one side of the diagonal only, so that its
    // symmetric part is a poor approximation.
    const ContactLawTraits traits              = law->traits();
    const bool             prefers_observables = friction.exists()
                  ? traits.needs_multiplier || !traits.nodal
                  : traits.needs_multiplier && closing->test != closing->trial;
    rows_have_directions =
      kinematics->has_constant_rows() && !prefers_observables;
    if (rows_have_directions)
      {
        rows.emplace(evaluator.coefficients());
        for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
          add_directions(p);
        return;
      }
    // Two cases: the force on the gap, whose direction may turn, is zero in open
    // points; or closing replaces the equation of the point's multiplier.
    const bool presses_if_closed = closing->row == 0 &&
      open_tangent(*law, 1.)[0].norm_square() == 0.,
               replaces_equation =
                 closing->row == 2 && closing->test.norm_square() == 1.;
    if (!presses_if_closed && !replaces_equation)
      return;
    rows.emplace(evaluator.coefficients());
    for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
      rows->add_observables(p);
  }



  void
  PointwiseContact::add_directions(const unsigned int p)
  {
    const ContactPoint &point   = evaluator.contact_points()[p];
    const Closing      &closing = closings[p];
    // Gap, stress pressure and multiplier as directions in the observables.
    const auto of_law = [&](const Tensor<1, 3> &law_direction) {
      PointVector direction =
        on_displacement(law_direction[0] * point.obstacle_normal);
      direction[PointPlace::stress_pressure] = law_direction[1];
      direction[PointPlace::multiplier]      = law_direction[2];
      return direction;
    };
    const auto of_axis = [&](const unsigned int axis) {
      Tensor<1, 3> direction;
      direction[axis] = 1.;
      return of_law(direction);
    };
    // The law depends on the product with trial alone, and its force is along test: one
    // entry of each is sufficient.
    const PointVector trial = of_axis(closing.column),
                      test  = of_axis(closing.row);
    if (closing.trial == closing.test)
      rows->add_direction(p, of_law(closing.test), trial, test);
    else
      {
        rows->add_direction(p, of_law(closing.test), PointVector(), test);
        rows->add_direction(p, of_law(closing.trial), trial, PointVector());
      }
    if (!friction.exists())
      return;
    unsigned int n_axes = 0;
    for (unsigned int k = point.begin; k < point.end; ++k)
      n_axes = std::max(n_axes, evaluator.coefficients().component[k] + 1);
    for (const Tensor<1, 3> &tangential :
         tangent_directions(point.obstacle_normal, n_axes))
      {
        const PointVector direction = on_displacement(tangential);
        rows->add_direction(p, direction, direction, direction);
      }
  }



  void
  PointwiseContact::evaluate_at_increment(
    const std::vector<double> &change,
    const std::vector<double> & /*excess*/)
  {
    if (!looks_at_change)
      observables_before = kinematics->observables();
    looks_at_change = true;
    observables.resize(observables_before.size());
    for (unsigned int p = 0; p < observables.size(); ++p)
      observables[p] = observables_before[p] + rows->in_point(p, change);
    kinematics->evaluate(observables, state);
    evaluate_laws();
  }



  bool
  PointwiseContact::acts(const unsigned int p) const
  {
    return point_force[p].gap != 0. ||
      law->branch(linearisation[p],
                  old_state[p],
                  evaluator.contact_points()[p].cell_diameter) != 0;
  }



  ContactPointForce<>
  PointwiseContact::closing_force(const unsigned int p) const
  {
    // Forces of open contact that depend on the state, not those that depend on the
    // beginning of the step alone, which all states have.
    const Tensor<1, 3> open =
      open_tangents[p] *
      Tensor<1, 3>(
        {state[p].gap, state[p].stress_pressure, state[p].multiplier});
    const double        gap  = point_force[p].gap - open[0];
    const Tensor<1, 3> &test = closings[p].test;
    if (closings[p].row == 0)
      return {gap, gap * test[1], gap * test[2]};
    // Another equation of the multiplier, whose force acts in open points, too.
    return {gap,
            point_force[p].stress_pressure - open[1],
            point_force[p].multiplier - open[2]};
  }



  void
  PointwiseContact::forces_on_rows(std::vector<double> &coefficients) const
  {
    coefficients.assign(rows->all().functionals.size(), 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        if (!acts(p))
          continue;
        PointVector closing = along_direction(p, closing_force(p));
        if (friction_acts(p))
          closing += on_displacement(friction.traction(p));
        rows->add(p,
                  weight * evaluator.contact_points()[p].weight * closing,
                  coefficients);
      }
  }



  PointwiseFriction::Derivatives
  PointwiseContact::friction_derivatives(const unsigned int p) const
  {
    const PointGeometry &geometry = kinematics->geometry(p);
    // Slip depends on the displacement, and on the tangent plane as it turns.
    PointwiseFriction::Derivatives derivatives = friction.derivatives(p);
    derivatives.with_slip                      = derivatives.with_slip *
      (tangent_plane(geometry.normal) * geometry.relative_way_derivative +
       geometry.projection_derivative(geometry.relative_way));
    return derivatives;
  }



  namespace
  {
    /// The derivatives @p tangent of forces on gap, stress pressure and multiplier as
    /// those of forces on the observables, where the force on the gap acts along @p
    /// direction and the gap has the gradient @p gap_gradient.
    PointMatrix
    on_observables(const ContactPointTangent &tangent,
                   const Tensor<1, 3>        &direction,
                   const Tensor<1, 3>        &gap_gradient)
    {
      PointMatrix result;
      for (unsigned int c = 0; c < 3; ++c)
        for (unsigned int d = 0; d < 3; ++d)
          result[c][d] = tangent[0][0] * direction[c] * gap_gradient[d];
      for (unsigned int s = 1; s < 3; ++s)
        {
          for (unsigned int c = 0; c < 3; ++c)
            {
              result[c][s + 2] = tangent[0][s] * direction[c];
              result[s + 2][c] = tangent[s][0] * gap_gradient[c];
            }
          for (unsigned int t = 1; t < 3; ++t)
            result[s + 2][t + 2] = tangent[s][t];
        }
      return result;
    }
  } // namespace



  PointMatrix
  PointwiseContact::point_tangent(const unsigned int         p,
                                  const ContactPointTangent &left_out) const
  {
    const ContactPointTangent law_tangent =
      law->tangent(linearisation[p],
                   old_state[p],
                   evaluator.contact_points()[p].cell_diameter);
    const bool presses = point_force[p].gap != 0.;
    if (presses || law_tangent[0].norm_square() > 0.)
      kinematics->update_geometry(p);
    const PointGeometry &geometry = kinematics->geometry(p);
    PointMatrix          result =
      on_observables(law_tangent - left_out,
                     geometry.direction_length * geometry.normal,
                     geometry.gap_gradient);
    if (!presses)
      return result;

    // The direction of the force turns, and friction depends on slip and
    // pressure.
    Tensor<2, 3> with_displacement =
      point_force[p].gap * geometry.direction_derivative;
    if (friction_acts(p))
      {
        const auto          derivatives = friction_derivatives(p);
        ContactPointTangent of_pressure;
        of_pressure[0] = -law_tangent[0];
        result += on_observables(of_pressure,
                                 derivatives.with_pressure,
                                 geometry.gap_gradient);
        with_displacement += derivatives.with_slip;
      }
    return result + on_displacement(with_displacement);
  }



  void
  PointwiseContact::add_tangent(Matrix &tangent) const
  {
    for (unsigned int p = 0; p < state.size(); ++p)
      evaluator.add(p, weight, point_tangent(p), tangent);
    tangent.compress(VectorOperation::add);
  }



  void
  PointwiseContact::add_open_tangent(Matrix &tangent) const
  {
    for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
      {
        // The constant part does not depend on the gap where directions turn.
        const Tensor<1, 3> &normal =
          evaluator.contact_points()[p].obstacle_normal;
        evaluator.add(p,
                      weight,
                      on_observables(open_tangents[p], normal, normal),
                      tangent);
      }
    tangent.compress(VectorOperation::add);
  }



  void
  PointwiseContact::set_structure()
  {
    own_structure.rows = evaluator.unknowns();
    if (rows)
      own_structure.functionals = rows->all();
    own_structure.has_multipliers = law->traits().needs_multiplier;
    const auto closing            = closing_directions(*law, 1.);
    own_structure.is_symmetric    = !own_structure.has_multipliers && closing &&
      closing->test == closing->trial && !friction.exists() &&
      kinematics->has_constant_rows();
    own_traits.has_friction          = friction.exists();
    own_traits.has_moving_obstacles  = kinematics->has_moving_obstacles();
    own_traits.knows_stress_pressure = stress_evaluator.has_points();
  }



  void
  PointwiseContact::differentiate_forces(
    std::vector<FunctionalRow> &with_values,
    std::vector<FunctionalRow> & /*with_residual*/) const
  {
    for (unsigned int p = 0; p < state.size(); ++p)
      if (acts(p))
        rows->add(p,
                  weight * evaluator.contact_points()[p].weight *
                    point_tangent(p, open_tangents[p]),
                  with_values);
    sum_columns(with_values);
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
        // The equation of a multiplier depends on the gap, too.
        const double stiffness =
          std::max(std::abs(tangent[0][0]),
                   std::abs(tangent[2][0]) *
                     law->multiplier_scale(point.cell_diameter));
        const double force =
          point.weight * stiffness * kinematics->gap_round_off(p, state[p].gap);
        square += force * force;
        // Slip is a difference of displacements over a step.
        if (friction_acts(p) && friction.sticks(p))
          {
            const double friction_force = point.weight *
              friction.round_off(p, kinematics->way_round_off(p));
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



  ActiveSet
  PointwiseContact::active_set() const
  {
    const std::vector<int> values      = branches();
    std::vector<int>       with_sticks = values;
    if (friction.exists())
      for (unsigned int p = 0; p < state.size(); ++p)
        with_sticks.push_back(friction.sticks(p));
    ActiveSet result{global_hash(with_sticks, evaluator.communicator), {}};

    // Every law is linear without contact.
    const bool turns = !kinematics->has_constant_rows();
    if (!law->traits().piecewise_linear || friction.exists() || turns)
      {
        bool active = std::any_of(values.begin(),
                                  values.end(),
                                  [](const int value) { return value != 0; });
        // A multiplier may exert a force until the stage is solved, whatever
        // the branch.
        if (friction.exists() || turns)
          for (unsigned int p = 0; p < state.size(); ++p)
            active =
              active || friction_acts(p) || (turns && point_force[p].gap != 0.);
        if (dealii::Utilities::MPI::max(active ? 1 : 0,
                                        evaluator.communicator) == 1)
          return result;
      }
    // Without friction that of the branches.
    result.tangent_key = friction.exists()
      ? global_hash(values, evaluator.communicator)
      : result.hash;
    return result;
  }



  std::string
  PointwiseContact::active_set_description() const
  {
    std::string text = count_active(branches(), evaluator.communicator);
    if (friction.exists())
      {
        unsigned int n_sticking = 0;
        for (unsigned int p = 0; p < state.size(); ++p)
          n_sticking += friction_acts(p) && friction.sticks(p);
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
    // A discrete derivative between equal states is the derivative.
    kinematics->begin_instant(time);
    kinematics->evaluate(solution, state);
    result = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPointForce<> point_force =
          law->force(state[p],
                     state[p],
                     evaluator.contact_points()[p].cell_diameter);
        evaluator.add(p, along_direction(p, point_force), result);
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
        PointVector on_multiplier;
        on_multiplier[PointPlace::multiplier] = stiffness;
        evaluator.add(p, on_multiplier, scaling);
        on_multiplier[PointPlace::multiplier] = 1.;
        evaluator.add(p, on_multiplier, boundary_mass);
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
    // The force of the step follows from the vector in nodes; elsewhere the
    // pressure is that of the law at the end of the step.
    const ContactPoint &point = evaluator.contact_points()[p];
    if (!law->traits().nodal)
      return point.weight * law->pressure(state[p], point.cell_diameter);
    kinematics->update_geometry(p);
    return kinematics->nodal_normal_force(p, contact_force);
  }



  Vector
  PointwiseContact::pressure_field(const ContactInstant &instant)
  {
    kinematics->begin_instant(instant.time);
    kinematics->evaluate(instant.solution, state);
    std::vector<double> pressures(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      pressures[p] = normal_force(p, instant.contact_force) /
        evaluator.contact_points()[p].weight;
    return evaluator.nodal_averages(pressures);
  }



  ContactSummaries
  PointwiseContact::summary(const ContactInstant &instant)
  {
    const ContactLawTraits traits = law->traits();
    kinematics->begin_instant(instant.time);
    kinematics->evaluate(instant.solution, state);
    ContactSummaries sums;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point = evaluator.contact_points()[p];
        const double        force = normal_force(p, instant.contact_force);
        // Two-point laws are active over a step, the others at an instant.
        const bool is_active = traits.is_two_point && !traits.uses_stress
          ? force > 0.
          : law->branch(state[p], state[p], point.cell_diameter) != 0;
        sums[point.boundary_id].add(point, state[p].gap, force, is_active);
        if (instant.report)
          instant.report({point.boundary_id,
                          kinematics->position(p),
                          state[p].gap,
                          force,
                          point.weight,
                          is_active});
      }
    add_stress_pressure(instant.solution,
                        stress_evaluator,
                        stress_observables,
                        sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
