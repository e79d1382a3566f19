// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/planes_at_rest.h>

namespace Ricochet
{
  void
  PlanesAtRest::begin_step(const ContactStart               &start,
                           std::vector<ContactPointState<>> &old_states)
  {
    time_step = start.time_step;
    evaluator.evaluate(start.solution, old_states);
    if (needs.way)
      evaluator.evaluate_displacement(start.solution, old_displacement);
    if (needs.prediction)
      {
        old_state = old_states;
        evaluator.evaluate_displacement(start.mean_velocity, mean_velocity);
      }
  }



  void
  PlanesAtRest::evaluate(const Vector                     &solution,
                         std::vector<ContactPointState<>> &states)
  {
    evaluator.evaluate(solution, states);
    if (!needs.way)
      return;
    evaluator.evaluate_displacement(solution, displacement);
    find_ways();
  }



  void
  PlanesAtRest::displace(const std::vector<dealii::Tensor<1, 3>> &displacements,
                         std::vector<ContactPointState<>>        &states)
  {
    displacement = displacements;
    for (unsigned int p = 0; p < states.size(); ++p)
      states[p].gap =
        points()[p].initial_gap + geometries[p].normal * displacement[p];
    find_ways();
  }



  void
  PlanesAtRest::find_ways()
  {
    // Outside of steps nobody asks for ways.
    if (old_displacement.size() != displacement.size())
      old_displacement = displacement;
    for (unsigned int p = 0; p < geometries.size(); ++p)
      {
        // From displacements, so that nothing cancels far from the origin.
        PointGeometry &geometry = geometries[p];
        geometry.relative_way   = displacement[p] - old_displacement[p];
        geometry.gap_increment  = geometry.normal * geometry.relative_way;
      }
  }
} // namespace Ricochet
