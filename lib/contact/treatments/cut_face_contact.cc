// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/cut_face_contact.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <limits>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  void
  CutFaceContact::find_couplings(const ContactPoints &points)
  {
    constant_couplings.version = 1;
    for (const ContactPoint &point : points.points)
      {
        std::vector<types::global_dof_index> list(points.index.begin() +
                                                    point.begin,
                                                  points.index.begin() +
                                                    point.end);
        std::sort(list.begin(), list.end());
        // Points of one cut are consecutive.
        if (constant_couplings.lists.empty() ||
            constant_couplings.lists.back() != list)
          constant_couplings.lists.push_back(list);
      }
  }



  void
  CutFaceContact::find_free_multipliers(const ContactPoints &points,
                                        const IndexSet      &owned_multipliers,
                                        const MPI_Comm       communicator)
  {
    std::vector<types::global_dof_index> mine;
    for (unsigned int k = 0; k < points.index.size(); ++k)
      if (points.multiplier_coefficient[k] != 0.)
        mine.push_back(points.index[k]);
    std::set<types::global_dof_index> known;
    for (const auto &list : Utilities::MPI::all_gather(communicator, mine))
      known.insert(list.begin(), list.end());
    for (const auto index : owned_multipliers)
      if (known.count(index) == 0)
        {
          free_multipliers.push_back(index);
          constant_couplings.lists.push_back({index});
        }
  }



  void
  CutFaceContact::add_residual(const Vector &solution, Vector &residual)
  {
    PointwiseContact::add_residual(solution, residual);
    for (const auto index : free_multipliers)
      residual(index) -= stage_weight() * solution(index);
    residual.compress(VectorOperation::add);
  }



  void
  CutFaceContact::add_free_multipliers(Matrix &tangent) const
  {
    for (const auto index : free_multipliers)
      tangent.add(index, index, -stage_weight());
    tangent.compress(VectorOperation::add);
  }



  void
  CutFaceContact::add_tangent(Matrix &tangent) const
  {
    PointwiseContact::add_tangent(tangent);
    add_free_multipliers(tangent);
  }



  ContactSummaries
  CutFaceContact::summary(const ContactInstant &instant)
  {
    ContactSummaries summaries = PointwiseContact::summary(instant);
    for (const auto &[id, area] : slave_area)
      {
        const auto [entry, is_new] = summaries.emplace(id, ContactSummary());
        ContactSummary &own        = entry->second;
        if (is_new)
          own.mean_gap = own.smallest_gap =
            std::numeric_limits<double>::quiet_NaN();
        own.contact_pressure *= own.area / area;
        own.stress_pressure *= own.area / area;
        own.area = area;
      }
    return summaries;
  }

} // namespace Ricochet
