// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/contact_operator.h>

#include <algorithm>

namespace Ricochet
{
  void
  ContactPointEvaluator::find_local_indices()
  {
    unsigned int longest = 0;
    local_index.reserve(points.index.size());
    for (const auto index : points.index)
      local_index.push_back(ghosted.trilinos_vector().Map().LID(
        static_cast<dealii::TrilinosWrappers::types::int_type>(index)));
    for (const ContactPoint &point : points.points)
      longest = std::max(longest, point.end - point.begin);
    values.resize(longest);
    local_matrix.resize(longest);
  }



  void
  ContactPointEvaluator::evaluate(const Vector                     &solution,
                                  std::vector<ContactPointState<>> &states)
  {
    ghosted             = solution;
    const double *value = ghosted.trilinos_vector()[0];
    states.resize(points.points.size());
    for (unsigned int p = 0; p < states.size(); ++p)
      {
        const ContactPoint &point = points.points[p];
        ContactPointState<> state;
        state.gap = point.initial_gap;
        for (unsigned int k = point.begin; k < point.end; ++k)
          {
            const double unknown = value[local_index[k]];
            state.gap += points.gap_coefficient[k] * unknown;
            state.stress_pressure +=
              points.stress_pressure_coefficient[k] * unknown;
            state.multiplier += points.multiplier_coefficient[k] * unknown;
          }
        states[p] = state;
      }
  }



  void
  ContactPointEvaluator::evaluate_displacement(
    const Vector                      &solution,
    std::vector<dealii::Tensor<1, 3>> &displacements)
  {
    ghosted             = solution;
    const double *value = ghosted.trilinos_vector()[0];
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
  ContactPointEvaluator::add(const unsigned int         p,
                             const ContactPointForce<> &force,
                             Vector                    &vector)
  {
    const ContactPoint &point = points.points[p];
    for (unsigned int k = point.begin; k < point.end; ++k)
      values[k - point.begin] = point.weight *
        (force.gap * points.gap_coefficient[k] +
         force.stress_pressure * points.stress_pressure_coefficient[k] +
         force.multiplier * points.multiplier_coefficient[k]);
    vector.add(point.end - point.begin,
               points.index.data() + point.begin,
               values.data());
  }



  void
  ContactPointEvaluator::add(const unsigned int         p,
                             const double               factor,
                             const ContactPointTangent &tangent,
                             Matrix                    &matrix) const
  {
    const ContactPoint &point = points.points[p];
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
          local_matrix[j - point.begin] =
            row_times_tangent[0] * points.gap_coefficient[j] +
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
    for (unsigned int k = point.begin; k < point.end; ++k)
      values[k - point.begin] =
        point.weight * traction[points.component[k]] * points.shape_value[k];
    vector.add(point.end - point.begin,
               points.index.data() + point.begin,
               values.data());
  }



  void
  ContactPointEvaluator::add(
    const unsigned int                         p,
    const double                               factor,
    const dealii::Tensor<2, 3>                &with_displacement,
    const std::array<dealii::Tensor<1, 3>, 3> &with_state,
    Matrix                                    &matrix) const
  {
    const ContactPoint &point = points.points[p];
    for (unsigned int i = point.begin; i < point.end; ++i)
      {
        const unsigned int row  = points.component[i];
        const double       test = factor * point.weight * points.shape_value[i];
        for (unsigned int j = point.begin; j < point.end; ++j)
          local_matrix[j - point.begin] = test *
            (with_displacement[row][points.component[j]] *
               points.shape_value[j] +
             with_state[0][row] * points.gap_coefficient[j] +
             with_state[1][row] * points.stress_pressure_coefficient[j] +
             with_state[2][row] * points.multiplier_coefficient[j]);
        matrix.add(points.index[i],
                   point.end - point.begin,
                   points.index.data() + point.begin,
                   local_matrix.data(),
                   true);
      }
  }



  double
  ContactPointEvaluator::normal_component(const unsigned int p,
                                          const Vector      &vector) const
  {
    double sum = 0.;
    for (unsigned int k = points.points[p].begin; k < points.points[p].end; ++k)
      if (points.shape_value[k] != 0.)
        sum += points.gap_coefficient[k] * vector(points.index[k]);
    return sum;
  }
} // namespace Ricochet
