// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/active_set_contact.h>
#include <contact/pointwise_contact.h>

#include <deal.II/base/mpi.h>

namespace Ricochet
{
  using dealii::VectorOperation;

  double
  ActiveSetContact::normal_component(const unsigned int p,
                                     const Vector      &vector) const
  {
    const ContactPoints &coefficients = evaluator.coefficients();
    const ContactPoint  &point        = coefficients.points[p];
    double               sum          = 0.;
    for (unsigned int k = point.begin; k < point.end; ++k)
      sum += coefficients.gap_coefficient[k] * vector(coefficients.index[k]);
    return sum;
  }



  double
  ActiveSetContact::constraint_scale(const unsigned int p) const
  {
    const ContactPoint &point = evaluator.contact_points()[p];
    return augmentation / point.cell_diameter * point.weight;
  }



  void
  ActiveSetContact::begin_stage(const Vector & /*old_solution*/,
                                const Vector &old_contact_force,
                                const double  weight_)
  {
    weight         = weight_;
    first_in_stage = true;
    for (unsigned int p = 0; p < reaction.size(); ++p)
      reaction[p] = -normal_component(p, old_contact_force);
  }



  void
  ActiveSetContact::complete_residual(const Vector &solution, Vector &residual)
  {
    evaluator.evaluate(solution, state);
    const ContactPoints &coefficients = evaluator.coefficients();

    // The multiplier of the last iterate: what the equation of motion leaves
    // over in the nodes that were active. In the first iteration it is the
    // reaction of the last step.
    std::vector<double> excess(reaction.size());
    for (unsigned int p = 0; p < reaction.size(); ++p)
      {
        excess[p] = normal_component(p, residual);
        if (!first_in_stage)
          reaction[p] = active[p] ? excess[p] / weight : 0.;
      }
    first_in_stage = false;

    force = 0.;
    for (unsigned int p = 0; p < reaction.size(); ++p)
      {
        const ContactPoint &point = coefficients.points[p];
        active[p] = reaction[p] - constraint_scale(p) * state[p].gap > 0.;
        if (!active[p])
          continue;
        for (unsigned int k = point.begin; k < point.end; ++k)
          {
            const double normal = coefficients.gap_coefficient[k];
            residual(coefficients.index[k]) +=
              normal * (constraint_scale(p) * state[p].gap - excess[p]);
            force(coefficients.index[k]) = -normal * reaction[p];
          }
      }
    residual.compress(VectorOperation::add);
    force.compress(VectorOperation::insert);
  }



  void
  ActiveSetContact::complete_tangent(Matrix &tangent) const
  {
    // In place, on the rows of the active nodes: T <- (I - n n^T) T + scale n
    // n^T. The rows of one node have the same columns in the same order,
    // because cells couple all components.
    const ContactPoints &coefficients = evaluator.coefficients();
    const auto          &epetra       = tangent.trilinos_matrix();
    std::vector<double>  normal_row;
    for (unsigned int p = 0; p < active.size(); ++p)
      {
        if (!active[p])
          continue;
        const ContactPoint   &point = coefficients.points[p];
        std::vector<double *> rows;
        int                   n_entries = 0;
        int                  *columns   = nullptr;
        for (unsigned int k = point.begin; k < point.end; ++k)
          {
            double   *row_values = nullptr;
            const int local_row  = epetra.LRID(
              static_cast<dealii::TrilinosWrappers::types::int_type>(
                coefficients.index[k]));
            const int error = epetra.ExtractMyRowView(local_row,
                                                      n_entries,
                                                      row_values,
                                                      columns);
            AssertThrow(error == 0, dealii::ExcTrilinosError(error));
            rows.push_back(row_values);
          }
        const double *normal = &coefficients.gap_coefficient[point.begin];
        normal_row.assign(n_entries, 0.);
        for (unsigned int a = 0; a < rows.size(); ++a)
          for (int j = 0; j < n_entries; ++j)
            normal_row[j] += normal[a] * rows[a][j];
        for (int j = 0; j < n_entries; ++j)
          {
            const auto column = epetra.GCID(columns[j]);
            for (unsigned int b = 0; b < rows.size(); ++b)
              if (column ==
                  static_cast<dealii::TrilinosWrappers::types::int_type>(
                    coefficients.index[point.begin + b]))
                normal_row[j] -= constraint_scale(p) * normal[b];
            for (unsigned int a = 0; a < rows.size(); ++a)
              rows[a][j] -= normal[a] * normal_row[j];
          }
      }
  }



  std::optional<std::uint64_t>
  ActiveSetContact::tangent_signature() const
  {
    return global_hash(active, evaluator.communicator);
  }



  std::string
  ActiveSetContact::active_set_description() const
  {
    return count_active(active, evaluator.communicator);
  }



  void
  ActiveSetContact::force_at(const Vector & /*solution*/, Vector &result)
  {
    result = 0.;
  }



  std::map<dealii::types::boundary_id, ContactSummary>
  ActiveSetContact::summary(const Vector &solution, const Vector &contact_force)
  {
    evaluator.evaluate(solution, state);
    std::map<dealii::types::boundary_id, ContactSummary> sums;
    for (unsigned int p = 0; p < state.size(); ++p)
      {
        const ContactPoint &point         = evaluator.contact_points()[p];
        ContactSummary     &sum           = sums[point.boundary_id];
        const double        node_reaction = -normal_component(p, contact_force);
        sum.area += point.weight;
        sum.mean_gap += point.weight * state[p].gap;
        sum.max_penetration = std::max(sum.max_penetration, -state[p].gap);
        sum.force += node_reaction;
        sum.active_points += node_reaction > 0.;
      }
    add_stress_pressure(solution, stress_evaluator, stress_state, sums);
    return reduce_summaries(sums, evaluator.communicator);
  }
} // namespace Ricochet
