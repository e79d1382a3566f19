// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
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
    // The smallest gap of all points that depend on an unknown.
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
  ContactPointEvaluator::evaluate(const Vector             &solution,
                                  std::vector<PointVector> &observables)
  {
    ghosted.import(solution);
    const double *value = ghosted.values();
    observables.resize(points.points.size());
    for (unsigned int p = 0; p < observables.size(); ++p)
      {
        const ContactPoint &point = points.points[p];
        PointVector         sum;
        // The speed is limited by memory: coefficients that are all zero are
        // not read.
        for (unsigned int k = point.begin; k < point.end; ++k)
          sum[points.component[k]] +=
            points.shape_value[k] * value[local_index[k]];
        if (has_stress_pressure)
          for (unsigned int k = point.begin; k < point.end; ++k)
            sum[PointPlace::stress_pressure] +=
              points.stress_pressure_coefficient[k] * value[local_index[k]];
        if (has_multipliers)
          for (unsigned int k = point.begin; k < point.end; ++k)
            sum[PointPlace::multiplier] +=
              points.multiplier_coefficient[k] * value[local_index[k]];
        observables[p] = sum;
      }
  }



  template <typename Value>
  void
  ContactPointEvaluator::add_to_unknowns(const ContactPoint &point,
                                         const Value        &value,
                                         Vector             &vector) const
  {
    double *const values = local_values(vector);
    for (unsigned int k = point.begin; k < point.end; ++k)
      // Most of them are on this rank, and need no search.
      if (owned_index[k] >= 0)
        values[owned_index[k]] += value(k);
      else if (const double sent = value(k); sent != 0.)
        vector.add(1, &points.index[k], &sent);
  }



  void
  ContactPointEvaluator::add(const unsigned int p,
                             const PointVector &force,
                             Vector            &vector)
  {
    if (force.norm_square() == 0.)
      return;
    const ContactPoint &point    = points.points[p];
    const PointVector   weighted = point.weight * force;
    const auto          add      = [&](const auto &value) {
      add_to_unknowns(point, value, vector);
    };
    const auto on_displacement = [&](const unsigned int k) {
      return weighted[points.component[k]] * points.shape_value[k];
    };
    if (has_multipliers)
      add([&](const unsigned int k) {
        return on_displacement(k) +
          weighted[PointPlace::stress_pressure] *
          points.stress_pressure_coefficient[k] +
          weighted[PointPlace::multiplier] * points.multiplier_coefficient[k];
      });
    else if (has_stress_pressure)
      add([&](const unsigned int k) {
        return on_displacement(k) +
          weighted[PointPlace::stress_pressure] *
          points.stress_pressure_coefficient[k];
      });
    else
      add(on_displacement);
  }



  void
  ContactPointEvaluator::add(const unsigned int p,
                             const double       factor,
                             const PointMatrix &tangent,
                             Matrix            &matrix) const
  {
    if (tangent.norm_square() == 0.)
      return;
    const ContactPoint &point = points.points[p];
    for (unsigned int i = point.begin; i < point.end; ++i)
      {
        const PointVector row = factor * point.weight *
          (points.shape_value[i] * tangent[points.component[i]] +
           points.stress_pressure_coefficient[i] *
             tangent[PointPlace::stress_pressure] +
           points.multiplier_coefficient[i] * tangent[PointPlace::multiplier]);
        for (unsigned int j = point.begin; j < point.end; ++j)
          local_matrix[j - point.begin] =
            row[points.component[j]] * points.shape_value[j] +
            row[PointPlace::stress_pressure] *
              points.stress_pressure_coefficient[j] +
            row[PointPlace::multiplier] * points.multiplier_coefficient[j];
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
