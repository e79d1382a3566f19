// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/displacement_functionals.h>

#include <algorithm>
#include <map>

namespace Ricochet
{
  DisplacementFunctionals::DisplacementFunctionals(
    const ContactPoints &contact_points)
  {
    Functionals         &functionals = acts_through.functionals;
    std::vector<double> &order       = acts_through.order;
    std::map<dealii::types::global_dof_index, unsigned int> of_unknown;
    for (const ContactPoint &point : contact_points.points)
      {
        std::vector<Term> &own = terms.emplace_back();
        for (unsigned int k = point.begin; k < point.end; ++k)
          if (contact_points.shape_value[k] != 0.)
            {
              const auto [known, is_new] =
                of_unknown.emplace(contact_points.index[k], functionals.size());
              if (is_new)
                {
                  functionals.add(known->first, 1.);
                  functionals.end_functional();
                  order.push_back(point.initial_gap);
                }
              order[known->second] =
                std::min(order[known->second], point.initial_gap);
              own.push_back({known->second,
                             contact_points.component[k],
                             contact_points.shape_value[k]});
            }
        const auto add = [&](const unsigned int         place,
                             const std::vector<double> &coefficients) {
          bool is_empty = true;
          for (unsigned int k = point.begin; k < point.end; ++k)
            if (coefficients[k] != 0.)
              {
                functionals.add(contact_points.index[k], coefficients[k]);
                is_empty = false;
              }
          if (is_empty)
            return;
          own.push_back({functionals.size(), place, 1.});
          functionals.end_functional();
          order.push_back(point.initial_gap);
        };
        add(stress_pressure, contact_points.stress_pressure_coefficient);
        add(multiplier, contact_points.multiplier_coefficient);
      }
  }



  DisplacementFunctionals::OfPoint
  DisplacementFunctionals::in_point(const unsigned int         p,
                                    const std::vector<double> &values) const
  {
    OfPoint result;
    for (const Term &term : terms[p])
      result[term.place] += term.factor * values[term.functional];
    return result;
  }



  void
  DisplacementFunctionals::add(const unsigned int   p,
                               const OfPoint       &force,
                               std::vector<double> &coefficients) const
  {
    for (const Term &term : terms[p])
      coefficients[term.functional] += term.factor * force[term.place];
  }



  void
  DisplacementFunctionals::add(const unsigned int          p,
                               const TangentOfPoint       &tangent,
                               std::vector<FunctionalRow> &rows) const
  {
    for (const Term &row : terms[p])
      for (const Term &column : terms[p])
        if (const double entry = tangent[row.place][column.place]; entry != 0.)
          rows[row.functional].emplace_back(column.functional,
                                            row.factor * column.factor * entry);
  }
} // namespace Ricochet
