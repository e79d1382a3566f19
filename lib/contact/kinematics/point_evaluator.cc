// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/point_evaluator.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <map>

namespace Ricochet
{
  void
  ContactPointEvaluator::find_local_indices()
  {
    unsigned int longest = 0;
    local_index.reserve(points.index.size());
    for (const auto index : points.index)
      {
        owned_index.push_back(
          owned.is_element(index)
            ? static_cast<int>(owned.index_within_set(index))
            : -1);
        local_index.push_back(ghosted.local_index(index));
        AssertThrow(local_index.back() >= 0,
                    dealii::ExcMessage("A contact point needs the unknown " +
                                       std::to_string(index) +
                                       ", which this rank does not know."));
      }
    for (const ContactPoint &point : points.points)
      longest = std::max(longest, point.end - point.begin);
    local_matrix.resize(longest);
    const auto has_some = [](const std::vector<double> &coefficients) {
      return std::any_of(coefficients.begin(),
                         coefficients.end(),
                         [](const double value) { return value != 0.; });
    };
    has_stress_pressure = has_some(points.stress_pressure_coefficient);
    has_multipliers     = has_some(points.multiplier_coefficient);
  }



  std::vector<dealii::types::global_dof_index>
  ContactPointEvaluator::unknowns() const
  {
    // The smallest gap of all points that know an unknown.
    using Index = dealii::types::global_dof_index;
    std::vector<std::pair<Index, double>> mine;
    for (const ContactPoint &point : points.points)
      for (unsigned int k = point.begin; k < point.end; ++k)
        mine.emplace_back(points.index[k], point.initial_gap);
    std::map<Index, double> gap;
    for (const auto &list :
         dealii::Utilities::MPI::all_gather(communicator, mine))
      for (const auto &[index, initial_gap] : list)
        {
          const auto known = gap.emplace(index, initial_gap).first;
          known->second    = std::min(known->second, initial_gap);
        }
    std::vector<std::pair<double, Index>> sorted;
    for (const auto &[index, initial_gap] : gap)
      sorted.emplace_back(initial_gap, index);
    std::sort(sorted.begin(), sorted.end());
    std::vector<Index> unknowns;
    for (const auto &entry : sorted)
      unknowns.push_back(entry.second);
    return unknowns;
  }



  void
  ContactPointEvaluator::evaluate(const Vector                     &solution,
                                  std::vector<ContactPointState<>> &states)
  {
    ghosted.import(solution);
    const double *value = ghosted.values();
    states.resize(points.points.size());
    for (unsigned int p = 0; p < states.size(); ++p)
      {
        const ContactPoint &point = points.points[p];
        ContactPointState<> state;
        state.gap = point.initial_gap;
        // Memory limits this: what is zero everywhere is not read.
        if (has_stress_pressure)
          for (unsigned int k = point.begin; k < point.end; ++k)
            {
              const double unknown = value[local_index[k]];
              state.gap += points.gap_coefficient[k] * unknown;
              state.stress_pressure +=
                points.stress_pressure_coefficient[k] * unknown;
            }
        else
          for (unsigned int k = point.begin; k < point.end; ++k)
            state.gap += points.gap_coefficient[k] * value[local_index[k]];
        if (has_multipliers)
          for (unsigned int k = point.begin; k < point.end; ++k)
            state.multiplier +=
              points.multiplier_coefficient[k] * value[local_index[k]];
        states[p] = state;
      }
  }



  void
  ContactPointEvaluator::evaluate_displacement(
    const Vector                      &solution,
    std::vector<dealii::Tensor<1, 3>> &displacements)
  {
    ghosted.import(solution);
    const double *value = ghosted.values();
    displacements.resize(points.points.size());
    for (unsigned int p = 0; p < displacements.size(); ++p)
      {
        displacements[p] = 0.;
        for (unsigned int k = points.points[p].begin; k < points.points[p].end;
             ++k)
          displacements[p][points.component[k]] +=
            points.shape_value[k] * value[local_index[k]];
      }
  }



  void
  ContactPointEvaluator::set_rows(const unsigned int          p,
                                  const dealii::Tensor<1, 3> &direction,
                                  const dealii::Tensor<1, 3> &gradient)
  {
    if (gap_gradient.empty())
      gap_gradient = points.gap_coefficient;
    for (unsigned int k = points.points[p].begin; k < points.points[p].end; ++k)
      {
        const unsigned int c      = points.component[k];
        points.gap_coefficient[k] = direction[c] * points.shape_value[k];
        gap_gradient[k]           = gradient[c] * points.shape_value[k];
      }
  }



  template <typename Value>
  void
  ContactPointEvaluator::add_to_unknowns(const ContactPoint &point,
                                         const Value        &value,
                                         Vector             &vector) const
  {
    double *const values = vector.trilinos_vector()[0];
    for (unsigned int k = point.begin; k < point.end; ++k)
      // Most of them are here, and need not be looked for.
      if (owned_index[k] >= 0)
        values[owned_index[k]] += value(k);
      else if (const double sent = value(k); sent != 0.)
        vector.add(1, &points.index[k], &sent);
  }



  void
  ContactPointEvaluator::add(const unsigned int         p,
                             const ContactPointForce<> &force,
                             Vector                    &vector)
  {
    const ContactPoint &point = points.points[p];
    if (force.gap == 0. && force.stress_pressure == 0. &&
        force.multiplier == 0.)
      return;
    if (has_multipliers)
      add_to_unknowns(
        point,
        [&](const unsigned int k) {
          return point.weight *
            (force.gap * points.gap_coefficient[k] +
             force.stress_pressure * points.stress_pressure_coefficient[k] +
             force.multiplier * points.multiplier_coefficient[k]);
        },
        vector);
    else
      add_to_unknowns(
        point,
        [&](const unsigned int k) {
          return point.weight *
            (force.gap * points.gap_coefficient[k] +
             force.stress_pressure * points.stress_pressure_coefficient[k]);
        },
        vector);
  }



  void
  ContactPointEvaluator::add(const unsigned int         p,
                             const double               factor,
                             const ContactPointTangent &tangent,
                             Matrix                    &matrix) const
  {
    const ContactPoint        &point    = points.points[p];
    const std::vector<double> &with_gap = gap_derivatives();
    for (unsigned int i = point.begin; i < point.end; ++i)
      {
        const double row[3] = {points.gap_coefficient[i],
                               points.stress_pressure_coefficient[i],
                               points.multiplier_coefficient[i]};
        double       row_times_tangent[3];
        for (unsigned int c = 0; c < 3; ++c)
          row_times_tangent[c] = factor * point.weight *
            (row[0] * tangent[0][c] + row[1] * tangent[1][c] +
             row[2] * tangent[2][c]);
        for (unsigned int j = point.begin; j < point.end; ++j)
          local_matrix[j - point.begin] = row_times_tangent[0] * with_gap[j] +
            row_times_tangent[1] * points.stress_pressure_coefficient[j] +
            row_times_tangent[2] * points.multiplier_coefficient[j];
        matrix.add(points.index[i],
                   point.end - point.begin,
                   points.index.data() + point.begin,
                   local_matrix.data(),
                   true);
      }
  }



  void
  ContactPointEvaluator::add(const unsigned int          p,
                             const dealii::Tensor<1, 3> &traction,
                             Vector                     &vector)
  {
    const ContactPoint &point = points.points[p];
    add_to_unknowns(
      point,
      [&](const unsigned int k) {
        return point.weight * traction[points.component[k]] *
          points.shape_value[k];
      },
      vector);
  }



  void
  ContactPointEvaluator::add(
    const unsigned int                         p,
    const double                               factor,
    const dealii::Tensor<2, 3>                &with_displacement,
    const std::array<dealii::Tensor<1, 3>, 3> &with_state,
    Matrix                                    &matrix) const
  {
    const ContactPoint        &point    = points.points[p];
    const std::vector<double> &with_gap = gap_derivatives();
    for (unsigned int i = point.begin; i < point.end; ++i)
      {
        const unsigned int row  = points.component[i];
        const double       test = factor * point.weight * points.shape_value[i];
        for (unsigned int j = point.begin; j < point.end; ++j)
          local_matrix[j - point.begin] = test *
            (with_displacement[row][points.component[j]] *
               points.shape_value[j] +
             with_state[0][row] * with_gap[j] +
             with_state[1][row] * points.stress_pressure_coefficient[j] +
             with_state[2][row] * points.multiplier_coefficient[j]);
        matrix.add(points.index[i],
                   point.end - point.begin,
                   points.index.data() + point.begin,
                   local_matrix.data(),
                   true);
      }
  }



  Vector
  ContactPointEvaluator::nodal_averages(const std::vector<double> &values) const
  {
    Vector sums(owned, communicator);
    Vector weights(sums);
    for (unsigned int p = 0; p < points.points.size(); ++p)
      for (unsigned int k = points.points[p].begin; k < points.points[p].end;
           ++k)
        if (points.component[k] == 0 && points.shape_value[k] != 0.)
          {
            const double weight = points.points[p].weight *
              points.shape_value[k] * points.shape_value[k];
            sums(points.index[k]) += weight * values[p];
            weights(points.index[k]) += weight;
          }
    sums.compress(dealii::VectorOperation::add);
    weights.compress(dealii::VectorOperation::add);
    for (const auto i : sums.locally_owned_elements())
      {
        const double weight = weights(i), sum = sums(i);
        sums(i) = weight > 0. ? sum / weight : 0.;
      }
    sums.compress(dealii::VectorOperation::insert);
    return sums;
  }



  dealii::Tensor<1, 3>
  ContactPointEvaluator::at_node(const unsigned int p,
                                 const Vector      &vector) const
  {
    dealii::Tensor<1, 3> value;
    for (unsigned int k = points.points[p].begin; k < points.points[p].end; ++k)
      if (points.shape_value[k] != 0.)
        value[points.component[k]] = vector(points.index[k]);
    return value;
  }
} // namespace Ricochet
