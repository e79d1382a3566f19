// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/contact_rows.h>

#include <algorithm>

namespace Ricochet
{
  std::vector<dealii::Tensor<1, 3>>
  tangent_directions(const dealii::Tensor<1, 3> &normal,
                     const unsigned int          n_axes)
  {
    // The longest projections of the axes.
    dealii::Tensor<2, 3> plane = tangent_plane(normal);
    for (unsigned int axis = 0; axis < n_axes; ++axis)
      for (unsigned int c = n_axes; c < 3; ++c)
        plane[axis][c] = plane[c][axis] = 0.;
    std::vector<dealii::Tensor<1, 3>> directions;
    for (unsigned int t = 0; t + 1 < n_axes; ++t)
      {
        unsigned int longest = 0;
        for (unsigned int axis = 1; axis < n_axes; ++axis)
          if (plane[axis].norm() > plane[longest].norm())
            longest = axis;
        directions.push_back(plane[longest] / plane[longest].norm());
        plane -= outer_product(directions.back(), directions.back());
      }
    return directions;
  }



  ContactRows::ContactRows(const ContactPoints &points)
    : points(points)
    , trial_terms(points.points.size())
    , test_terms(points.points.size())
  {}



  template <typename Value>
  bool
  ContactRows::add_row(const ContactPoint &point, const Value &value)
  {
    bool is_empty = true;
    for (unsigned int k = point.begin; k < point.end; ++k)
      if (const double coefficient = value(k); coefficient != 0.)
        {
          rows.functionals.add(points.index[k], coefficient);
          is_empty = false;
        }
    if (is_empty)
      return false;
    rows.functionals.end_functional();
    rows.order.push_back(point.initial_gap);
    return true;
  }



  void
  ContactRows::add_direction(const unsigned int p,
                             const PointVector &direction,
                             const PointVector &trial,
                             const PointVector &test)
  {
    const unsigned int row = rows.functionals.size();
    if (!add_row(points.points[p], [&](const unsigned int k) {
          return direction[points.component[k]] * points.shape_value[k] +
            direction[PointPlace::stress_pressure] *
            points.stress_pressure_coefficient[k] +
            direction[PointPlace::multiplier] *
            points.multiplier_coefficient[k];
        }))
      return;
    for (unsigned int c = 0; c < PointVector::dimension; ++c)
      {
        if (trial[c] != 0.)
          trial_terms[p].push_back({row, c, trial[c]});
        if (test[c] != 0.)
          test_terms[p].push_back({row, c, test[c]});
      }
  }



  void
  ContactRows::add_observables(const unsigned int p)
  {
    const ContactPoint &point = points.points[p];
    for (unsigned int k = point.begin; k < point.end; ++k)
      if (points.shape_value[k] != 0.)
        {
          const auto [known, is_new] =
            row_of_unknown.emplace(points.index[k], rows.functionals.size());
          if (is_new)
            {
              rows.functionals.add(known->first, 1.);
              rows.functionals.end_functional();
              rows.order.push_back(point.initial_gap);
            }
          double &order = rows.order[known->second];
          order         = std::min(order, point.initial_gap);
          trial_terms[p].push_back(
            {known->second, points.component[k], points.shape_value[k]});
        }
    const auto add = [&](const unsigned int         place,
                         const std::vector<double> &coefficients) {
      if (add_row(point, [&](const unsigned int k) { return coefficients[k]; }))
        trial_terms[p].push_back({rows.functionals.size() - 1, place, 1.});
    };
    add(PointPlace::stress_pressure, points.stress_pressure_coefficient);
    add(PointPlace::multiplier, points.multiplier_coefficient);
    test_terms[p] = trial_terms[p];
  }



  PointVector
  ContactRows::in_point(const unsigned int         p,
                        const std::vector<double> &values) const
  {
    PointVector result;
    for (const Term &term : trial_terms[p])
      result[term.place] += term.factor * values[term.row];
    return result;
  }



  void
  ContactRows::add(const unsigned int   p,
                   const PointVector   &force,
                   std::vector<double> &coefficients) const
  {
    for (const Term &term : test_terms[p])
      coefficients[term.row] += term.factor * force[term.place];
  }



  void
  ContactRows::add(const unsigned int          p,
                   const PointMatrix          &tangent,
                   std::vector<FunctionalRow> &entries) const
  {
    for (const Term &test : test_terms[p])
      for (const Term &trial : trial_terms[p])
        if (const double entry = tangent[test.place][trial.place]; entry != 0.)
          entries[test.row].emplace_back(trial.row,
                                         test.factor * trial.factor * entry);
  }
} // namespace Ricochet
