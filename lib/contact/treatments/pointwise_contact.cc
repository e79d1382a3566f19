// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/active_set_signature.h>
#include <contact/treatments/pointwise_contact.h>
#include <contact/treatments/power_law_linearisation.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  using dealii::VectorOperation;

  void
  PointwiseContact::begin_stage(const ContactStart &start, const double weight_)
  {
    weight     = weight_;
    n_iterates = 0;
    friction.begin_stage(start.time_step);
    point_force.assign(evaluator.contact_points().size(), {});
    kinematics->begin_step(start, old_state);
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
    // It helps to come near the solution; should it not, the law is linearised
    // at the gap again.
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
    double *values = vector.trilinos_vector()[0];
    for (unsigned int i = n_displacements_owned;
         i < vector.locally_owned_size();
         ++i)
      values[i] = 0.;
  }



  void
  PointwiseContact::complete_residual(const Vector &solution, Vector &residual)
  {
    looks_at_change = false;
    kinematics->evaluate(solution, state);
    find_slips();
    evaluate_laws();
    force = 0.;
    for (unsigned int p = 0; p < state.size(); ++p)
      evaluator.add(p, point_force[p], force);
    force.compress(VectorOperation::add);
    if (friction.exists())
      {
        friction_part = 0.;
        for (unsigned int p = 0; p < state.size(); ++p)
          if (friction_acts(p))
            evaluator.add(p, friction.traction(p), friction_part);
        friction_part.compress(VectorOperation::add);
        force += friction_part;
      }
    residual.add(weight, force);

    clear_multipliers(force);
  }



  void
  PointwiseContact::find_slips()
  {
    if (!friction.exists() || !kinematics->has_constant_rows())
      return;
    slips.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      slips[p] = kinematics->geometry(p).slip();
  }



  void
  PointwiseContact::evaluate_laws()
  {
    choose_linearisation();
    point_force.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        point_force[p] = linearised_force(p);
        if (point_force[p].gap != 0.)
          kinematics->update_geometry(p);
      }
    if (!friction.exists())
      return;
    friction.begin_evaluation(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const double pressure = positive_part(-point_force[p].gap);
        // Where nothing presses, geometry may be that of another state.
        friction.evaluate(p,
                          pressure,
                          kinematics->has_constant_rows() ? slips[p]
                            : pressure > 0. ? kinematics->geometry(p).slip()
                                            : dealii::Tensor<1, 3>(),
                          evaluator.contact_points()[p].cell_diameter);
      }
  }



  void
  PointwiseContact::look_at_change(const std::vector<double> &change,
                                   const std::vector<double> & /*excess*/)
  {
    if (displacement_functionals)
      {
        displace_points(change);
        evaluate_laws();
        return;
      }
    if (!looks_at_change)
      {
        state_before    = state;
        slips_before    = slips;
        looks_at_change = true;
      }
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        // Laws know of a change what its product with the direction of trial is,
        // but for what they do to open points.
        const ClosingFunctionals::Point &own = (*functionals)[p];
        state[p]                             = state_before[p];
        double *const components[]           = {&state[p].gap,
                                                &state[p].stress_pressure,
                                                &state[p].multiplier};
        *components[own.closing.column] += change[own.trial];
        if (own.tangential.empty())
          continue;
        slips[p] = slips_before[p];
        for (unsigned int t = 0; t < own.tangential.size(); ++t)
          slips[p] += change[own.first_tangential + t] * own.tangential[t];
      }
    evaluate_laws();
  }



  void
  PointwiseContact::displace_points(const std::vector<double> &change)
  {
    if (!looks_at_change)
      {
        state_before         = state;
        displacements_before = kinematics->displacements();
        looks_at_change      = true;
      }
    displaced.resize(state.size());
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const auto of_point = displacement_functionals->in_point(p, change);
        state[p]            = state_before[p];
        displaced[p]        = displacements_before[p];
        for (unsigned int c = 0; c < 3; ++c)
          displaced[p][c] += of_point[c];
        state[p].stress_pressure +=
          of_point[DisplacementFunctionals::stress_pressure];
        state[p].multiplier += of_point[DisplacementFunctionals::multiplier];
      }
    kinematics->displace(displaced, state);
    find_slips();
  }



  bool
  PointwiseContact::prefers_displacements() const
  {
    // Of directions there are fewer; but not with friction in points of faces, each of
    // which has three.
    const ContactLawTraits traits = law->traits();
    if (friction.exists())
      return traits.needs_multiplier || !traits.nodal;
    // Directions of closing leave the forces of a multiplier to the matrix of the body,
    // in which they stand on one side only, so that there are no half solutions, and
    // the symmetric part is far from it.
    const auto closing = closing_directions(*law, 1.);
    return traits.needs_multiplier && closing &&
      closing->test != closing->trial;
  }



  void
  PointwiseContact::make_displacement_functionals()
  {
    // Either the force on the gap, which turns, is that of closed points alone; or they
    // have but another equation of their multiplier.
    const auto closing = closing_directions(*law, 1.);
    if (!closing)
      return;
    const bool presses_if_closed = closing->row == 0 &&
      open_tangent(*law, 1.)[0].norm_square() == 0.,
               keeps_equation =
                 closing->row == 2 && closing->test.norm_square() == 1.;
    if (!presses_if_closed && !keeps_equation)
      return;
    displacement_functionals.emplace(evaluator.coefficients());
    for (const ContactPoint &point : evaluator.contact_points())
      closings.push_back(*closing_directions(*law, point.cell_diameter));
  }



  bool
  PointwiseContact::acts(const unsigned int p) const
  {
    return point_force[p].gap != 0. ||
      law->branch(linearisation[p],
                  old_state[p],
                  evaluator.contact_points()[p].cell_diameter) != 0;
  }



  ContactPointTangent
  PointwiseContact::constant_tangent(const unsigned int p) const
  {
    ContactPointTangent open =
      open_tangent(*law, evaluator.contact_points()[p].cell_diameter);
    for (unsigned int c = 0; c < 3; ++c)
      open[0][c] = open[c][0] = 0.;
    return open;
  }



  DisplacementFunctionals::OfPoint
  PointwiseContact::closing_force(const unsigned int p) const
  {
    DisplacementFunctionals::OfPoint result;
    if (point_force[p].gap != 0.)
      {
        const PointGeometry &geometry = kinematics->geometry(p);
        for (unsigned int c = 0; c < 3; ++c)
          result[c] =
            point_force[p].gap * geometry.direction_length * geometry.normal[c];
      }
    if (friction_acts(p))
      for (unsigned int c = 0; c < 3; ++c)
        result[c] += friction.traction(p)[c];
    result[DisplacementFunctionals::stress_pressure] =
      point_force[p].gap * closings[p].test[1];
    result[DisplacementFunctionals::multiplier] = closings[p].row == 0
      ? point_force[p].gap * closings[p].test[2]
      : point_force[p].multiplier -
        constant_tangent(p)[2][2] * state[p].multiplier;
    return result;
  }



  DisplacementFunctionals::TangentOfPoint
  PointwiseContact::closing_tangent(const unsigned int p) const
  {
    const double              h = evaluator.contact_points()[p].cell_diameter;
    const ContactPointTangent closing =
      law->tangent(linearisation[p], old_state[p], h) - constant_tangent(p);
    DisplacementFunctionals::TangentOfPoint result;
    for (unsigned int s = 1; s < 3; ++s)
      for (unsigned int t = 1; t < 3; ++t)
        result[s + 2][t + 2] = closing[s][t];
    const double pressure = -point_force[p].gap;
    if (pressure == 0. && closing[0].norm_square() == 0.)
      return result;

    kinematics->update_geometry(p);
    const PointGeometry &geometry = kinematics->geometry(p);
    // The force along its direction, which turns, and friction.
    dealii::Tensor<1, 3> with_pressure =
      -geometry.direction_length * geometry.normal;
    dealii::Tensor<2, 3> with_displacement =
      -pressure * geometry.direction_derivative;
    if (friction_acts(p))
      {
        const auto derivatives = friction_derivatives(p);
        with_pressure += derivatives.with_pressure;
        with_displacement += derivatives.with_slip;
      }
    with_displacement +=
      outer_product(-closing[0][0] * with_pressure, geometry.gap_gradient);
    for (unsigned int c = 0; c < 3; ++c)
      for (unsigned int d = 0; d < 3; ++d)
        result[c][d] = with_displacement[c][d];
    for (unsigned int s = 1; s < 3; ++s)
      for (unsigned int c = 0; c < 3; ++c)
        {
          result[c][s + 2] = -closing[0][s] * with_pressure[c];
          result[s + 2][c] = closing[s][0] * geometry.gap_gradient[c];
        }
    return result;
  }



  void
  PointwiseContact::force_change(std::vector<double> &coefficients) const
  {
    if (displacement_functionals)
      {
        coefficients.assign(displacement_functionals->all().functionals.size(),
                            0.);
        for (unsigned int p = 0; p < state.size(); ++p)
          if (acts(p))
            displacement_functionals->add(
              p,
              weight * evaluator.contact_points()[p].weight * closing_force(p),
              coefficients);
        return;
      }
    coefficients.assign(functionals->all().functionals.size(), 0.);
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint              &point  = evaluator.contact_points()[p];
        const ClosingFunctionals::Point &own    = (*functionals)[p];
        const double                     factor = weight * point.weight;
        if (law->branch(linearisation[p], old_state[p], point.cell_diameter) !=
            0)
          {
            const dealii::Tensor<1, 3> &open =
              own.open_tangent[own.closing.row];
            const double forces[]  = {point_force[p].gap,
                                      point_force[p].stress_pressure,
                                      point_force[p].multiplier};
            coefficients[own.test] = factor *
              (forces[own.closing.row] - open[0] * state[p].gap -
               open[1] * state[p].stress_pressure -
               open[2] * state[p].multiplier);
          }
        if (friction_acts(p))
          for (unsigned int t = 0; t < own.tangential.size(); ++t)
            coefficients[own.first_tangential + t] =
              factor * (friction.traction(p) * own.tangential[t]);
      }
  }



  PointwiseFriction::Derivatives
  PointwiseContact::friction_derivatives(const unsigned int p) const
  {
    const PointGeometry &geometry = kinematics->geometry(p);
    const auto           plane    = tangent_plane(geometry.normal);
    if (kinematics->has_constant_rows())
      return friction.derivatives(p, plane);
    // Slip follows the way, and the turning of the plane in which it is.
    PointwiseFriction::Derivatives derivatives =
      friction.derivatives(p,
                           dealii::Tensor<2, 3>(
                             dealii::unit_symmetric_tensor<3>()));
    derivatives.with_slip = derivatives.with_slip *
      (plane * geometry.relative_way_derivative +
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

        if (friction_acts(p))
          {
            const auto                  derivatives = friction_derivatives(p);
            const dealii::Tensor<1, 3> &slope       = derivatives.with_pressure;
            evaluator.add(p,
                          weight,
                          derivatives.with_slip,
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
  PointwiseContact::complete_constant_tangent(Matrix &tangent) const
  {
    for (unsigned int p = 0; p < evaluator.contact_points().size(); ++p)
      {
        const ContactPointTangent constant = displacement_functionals
          ? constant_tangent(p)
          : open_tangent(*law, evaluator.contact_points()[p].cell_diameter);
        if (!displacement_functionals && constant[0].norm_square() > 0.)
          kinematics->update_geometry(p);
        evaluator.add(p, weight, constant, tangent);
      }
    tangent.compress(VectorOperation::add);
  }



  ContactStructure
  PointwiseContact::tangent_structure() const
  {
    ContactStructure structure;
    structure.rows = evaluator.unknowns();
    if (functionals)
      structure.functionals = functionals->all();
    if (displacement_functionals)
      structure.functionals = displacement_functionals->all();
    structure.has_multipliers = law->traits().needs_multiplier;
    const auto closing        = closing_directions(*law, 1.);
    structure.is_symmetric    = !structure.has_multipliers && closing &&
      closing->test == closing->trial && !friction.exists() &&
      kinematics->has_constant_rows();
    return structure;
  }



  void
  PointwiseContact::tangent_change(std::vector<FunctionalRow> &change) const
  {
    if (displacement_functionals)
      {
        for (unsigned int p = 0; p < state.size(); ++p)
          if (acts(p))
            displacement_functionals->add(
              p,
              weight * evaluator.contact_points()[p].weight *
                closing_tangent(p),
              change);
        sum_columns(change);
        return;
      }
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint              &point = evaluator.contact_points()[p];
        const ClosingFunctionals::Point &own   = (*functionals)[p];
        const ContactPointTangent        law_tangent =
          law->tangent(linearisation[p], old_state[p], point.cell_diameter);
        const double factor = weight * point.weight;
        const double closing =
          law_tangent[own.closing.row][own.closing.column] -
          own.open_tangent[own.closing.row][own.closing.column];
        if (closing != 0.)
          change[own.test].emplace_back(own.trial, factor * closing);

        if (!friction_acts(p))
          continue;
        const auto derivatives = friction_derivatives(p);
        for (unsigned int t = 0; t < own.tangential.size(); ++t)
          {
            auto &row = change[own.first_tangential + t];
            for (unsigned int s = 0; s < own.tangential.size(); ++s)
              row.emplace_back(own.first_tangential + s,
                               factor *
                                 (own.tangential[t] * derivatives.with_slip *
                                  own.tangential[s]));
            if (const double with_gap = -law_tangent[0][0] *
                  (own.tangential[t] * derivatives.with_pressure);
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
        if (friction_acts(p) && friction.sticks(p))
          {
            const double friction_force =
              point.weight * friction.round_off(kinematics->way_round_off(p));
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
    if (!law->traits().piecewise_linear || friction.exists() || turns)
      {
        bool active = std::any_of(values.begin(),
                                  values.end(),
                                  [](const int value) { return value != 0; });
        // A multiplier presses until the stage is solved, whatever the branch.
        if (friction.exists() || turns)
          for (unsigned int p = 0; p < state.size(); ++p)
            active =
              active || friction_acts(p) || (turns && point_force[p].gap != 0.);
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
    if (friction.exists())
      for (unsigned int p = 0; p < state.size(); ++p)
        values.push_back(friction.sticks(p));
    return global_hash(values, evaluator.communicator);
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
      }
    add_stress_pressure(instant.solution, stress_evaluator, stress_state, sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
