// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/contact_report.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Ricochet
{
  void
  ContactSummary::add(const ContactPoint &point,
                      const double        gap,
                      const double        point_force,
                      const bool          is_active)
  {
    area += point.weight;
    mean_gap += point.weight * gap;
    smallest_gap    = std::min(smallest_gap, gap);
    max_penetration = std::max(max_penetration, -gap);
    force += point_force;
    active_points += is_active;
  }



  void
  ContactSummary::unite(const ContactSummary &other)
  {
    const double whole = area + other.area;
    const auto   mean  = [&](double &own, const double its) {
      // A mean that is unknown for one part is that of the other.
      if (std::isnan(own) || area == 0.)
        own = its;
      else if (!std::isnan(its) && whole > 0.)
        own = (area * own + other.area * its) / whole;
    };
    mean(mean_gap, other.mean_gap);
    mean(contact_pressure, other.contact_pressure);
    mean(stress_pressure, other.stress_pressure);
    area = whole;
    force += other.force;
    smallest_gap    = std::min(smallest_gap, other.smallest_gap);
    max_penetration = std::max(max_penetration, other.max_penetration);
    active_points += other.active_points;
  }



  void
  add_stress_pressure(const Vector             &solution,
                      ContactPointEvaluator    &evaluator,
                      std::vector<PointVector> &work,
                      ContactSummaries         &sums)
  {
    evaluator.evaluate(solution, work);
    for (unsigned int p = 0; p < work.size(); ++p)
      sums[evaluator.contact_points()[p].boundary_id].stress_pressure +=
        evaluator.contact_points()[p].weight *
        work[p][PointPlace::stress_pressure];
  }



  ContactSummaries
  reduce_summaries(const ContactSummaries &my_sums, const MPI_Comm communicator)
  {
    using namespace dealii::Utilities::MPI;

    // Ranks hold different boundaries: agree on the list of ids first.
    std::vector<dealii::types::boundary_id> my_ids;
    for (const auto &entry : my_sums)
      my_ids.push_back(entry.first);
    std::set<dealii::types::boundary_id> ids;
    for (const auto &list : all_gather(communicator, my_ids))
      ids.insert(list.begin(), list.end());

    ContactSummaries summaries;
    for (const auto id : ids)
      {
        const auto           mine = my_sums.find(id);
        const ContactSummary sum =
          mine == my_sums.end() ? ContactSummary() : mine->second;
        ContactSummary &total = summaries[id];
        total.area  = dealii::Utilities::MPI::sum(sum.area, communicator);
        total.force = dealii::Utilities::MPI::sum(sum.force, communicator);
        total.mean_gap =
          dealii::Utilities::MPI::sum(sum.mean_gap, communicator) / total.area;
        total.smallest_gap     = min(sum.smallest_gap, communicator);
        total.max_penetration  = max(sum.max_penetration, communicator);
        total.contact_pressure = total.force / total.area;
        total.stress_pressure =
          dealii::Utilities::MPI::sum(sum.stress_pressure, communicator) /
          total.area;
        total.active_points =
          dealii::Utilities::MPI::sum(sum.active_points, communicator);
      }
    return summaries;
  }
} // namespace Ricochet
