// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/rigid_obstacles.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace Ricochet
{
  using dealii::Tensor;

  RigidObstacles::RigidObstacles(ContactPointEvaluator evaluator_,
                                 const bool            some_move)
    : ContactKinematics(std::move(evaluator_))
    , some_move(some_move)
  {
    for (const ContactPoint &point : points())
      {
        const RigidObstacle *obstacle = point.obstacle.get();
        const auto           found =
          std::find(obstacles.begin(), obstacles.end(), obstacle);
        obstacle_of_point.push_back(found - obstacles.begin());
        if (found == obstacles.end())
          obstacles.push_back(obstacle);
      }
    steps.resize(obstacles.size());
  }



  void
  RigidObstacles::place_obstacles()
  {
    for (unsigned int i = 0; i < obstacles.size(); ++i)
      steps[i] = obstacles[i]->step(end_time - time_step, end_time);
    if (rate_time == 0. || !some_move)
      return;
    // Velocities of obstacles are differences, as motions are expressions: over so short a
    // time that their error of second order is far below that of the scheme, and long
    // enough for round-off.
    constexpr double part_of_step = 1e-3;
    length_around                 = part_of_step * rate_time;
    around.resize(obstacles.size());
    for (unsigned int i = 0; i < obstacles.size(); ++i)
      around[i] = obstacles[i]->step(end_time - .5 * length_around,
                                     end_time + .5 * length_around);
  }



  double
  RigidObstacles::gap(const unsigned int  p,
                      const Tensor<1, 3> &displacement,
                      const Instant       instant) const
  {
    const unsigned int         i    = obstacle_of_point[p];
    const RigidObstacle::Step &step = steps[i];
    return obstacles[i]->shape().gap(
      (instant == Instant::begin ? step.begin : step.end)
        .pull_back(points()[p].reference_position + displacement));
  }



  void
  RigidObstacles::compute_geometry(const unsigned int p)
  {
    const unsigned int  i = obstacle_of_point[p];
    const Tensor<1, 3>  x = points()[p].reference_position + displacement(p);
    PointGeometry      &geometry = geometries[p];
    RigidObstacle::Rows rows;
    if (time_step == 0.)
      {
        // Both ends of the step are the same point of the obstacle, which moves
        // with it.
        rows = obstacles[i]->rows(steps[i], x, x, Tensor<1, 3>());
        rows.direction_derivative *= 2.;
        rows.relative_way            = displacement_with_slip(p);
        rows.relative_way_derivative = dealii::unit_symmetric_tensor<3>();
        if (rate_time > 0. && some_move)
          {
            // Both ends of the material's displacement move with the point.
            const double longer = rate_time / length_around;
            rows.relative_way -=
              longer * obstacles[i]->material_displacement(around[i], x, x);
            rows.relative_way_derivative -= 2. * longer *
              obstacles[i]->material_displacement_derivative(around[i]);
          }
      }
    else
      rows =
        obstacles[i]->rows(steps[i],
                           points()[p].reference_position + old_displacement(p),
                           x,
                           displacement(p) - old_displacement(p));
    geometry.direction_length     = rows.direction.norm();
    geometry.normal               = rows.direction / geometry.direction_length;
    geometry.direction_derivative = rows.direction_derivative;
    geometry.gap_gradient         = rows.gap_gradient;
    geometry.gap_increment        = rows.gap_increment;
    geometry.relative_way         = rows.relative_way;
    geometry.relative_way_derivative = rows.relative_way_derivative;
  }



  namespace
  {
    /// Whether the straight path from @p begin to @p end leads through the shape, in at
    /// one side and out at another one; a chord along a surface on which it slides does
    /// not count.
    bool
    leads_through(const ObstacleShape &shape,
                  const Tensor<1, 3>  &begin,
                  const Tensor<1, 3>  &end)
    {
      const Tensor<1, 3> path   = end - begin;
      const double       length = path.norm();
      // Gaps are distances: a path in and out is at least as long as the sum of
      // both.
      const double begin_gap = shape.gap(begin), end_gap = shape.gap(end);
      if (!(begin_gap >= 0. && end_gap >= 0. && length > begin_gap + end_gap))
        return false;
      const double shortest = length / 256.;
      double       along = 0., entry = 0., depth = 0.;
      bool         is_in = false;
      while (along < length)
        {
          const double gap = shape.gap(begin + (along / length) * path);
          if (gap < 0. && !is_in)
            entry = along;
          if (is_in && gap >= 0. && depth > .25 * (along - entry))
            return true;
          if (gap >= 0.)
            depth = 0.;
          is_in = gap < 0.;
          depth = std::max(depth, -gap);
          along += std::max(std::abs(gap), shortest);
        }
      return is_in && depth > .25 * (length - entry);
    }
  } // namespace



  void
  RigidObstacles::add_passing(const Vector &begin,
                              const Vector &end,
                              const double  begin_time,
                              const double  end_time,
                              ContactSteps &passing)
  {
    std::vector<Placement> begin_placements, end_placements;
    for (const RigidObstacle *obstacle : obstacles)
      {
        const RigidObstacle::Step step = obstacle->step(begin_time, end_time);
        begin_placements.push_back(step.begin);
        end_placements.push_back(step.end);
      }
    std::vector<PointVector> from, to;
    evaluator.evaluate(begin, from);
    evaluator.evaluate(end, to);
    for (unsigned int p = 0; p < points().size(); ++p)
      {
        const ContactPoint &point = points()[p];
        const unsigned int  i     = obstacle_of_point[p];
        if (obstacles[i]->shape().is_plane())
          continue;
        // Positions in the obstacle's frame.
        const Tensor<1, 3> old_x = begin_placements[i].pull_back(
                             point.reference_position +
                             displacement_of(from[p])),
                           new_x = end_placements[i].pull_back(
                             point.reference_position + displacement_of(to[p]));
        // A point that moves less than this part of its cell does not pass.
        if ((new_x - old_x).norm() < .05 * point.cell_diameter ||
            !leads_through(obstacles[i]->shape(), old_x, new_x))
          continue;
        ContactStep &step = passing[point.boundary_id];
        step.place_passed = dealii::Point<3>(point.reference_position);
        ++step.n_passed;
      }
  }



  double
  RigidObstacles::predicted_gap(const unsigned int p) const
  {
    const RigidObstacle &obstacle = *obstacles[obstacle_of_point[p]];
    return obstacle.gap(points()[p].reference_position + old_displacement(p) +
                          .5 * time_step * displacement_of(rate[p]),
                        end_time - .5 * time_step);
  }



  double
  RigidObstacles::gap_round_off(const unsigned int p, const double gap) const
  {
    // Round-off of a difference of two distances from the centre of the
    // obstacle.
    const unsigned int i = obstacle_of_point[p];
    const double       distance =
      (points()[p].reference_position + displacement(p) -
       steps[i].end.push_forward(obstacles[i]->shape().centre()))
        .norm();
    return 4. * std::numeric_limits<double>::epsilon() *
      (points()[p].reference_position.norm() + displacement(p).norm() +
       distance + std::abs(gap));
  }
} // namespace Ricochet
