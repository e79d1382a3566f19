// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/planes_at_rest.h>
#include <contact/kinematics/rigid_obstacles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  ContactKinematics::ContactKinematics(ContactPointEvaluator evaluator_)
    : evaluator(std::move(evaluator_))
    , current(points().size())
    , old(points().size())
    , up_to_date(points().size(), false)
  {
    for (const ContactPoint &point : points())
      {
        PointGeometry geometry;
        geometry.normal = geometry.gap_gradient = point.obstacle_normal;
        geometry.relative_way_derivative =
          dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>());
        geometries.push_back(geometry);
      }
  }



  void
  ContactKinematics::begin_step(const ContactStart               &start,
                                std::vector<ContactPointState<>> &old_states)
  {
    time_step = start.time_step;
    end_time  = start.end_time;
    rate_time = start.rate_origin ? start.rate_time : 0.;
    place_obstacles();
    evaluator.evaluate(start.solution, old);
    if (start.rate_origin)
      evaluator.evaluate(*start.rate_origin, rate_origin);
    find_states(old, Instant::begin, old_states);
  }



  void
  ContactKinematics::begin_instant(const double time)
  {
    time_step = 0.;
    end_time  = time;
    rate_time = 0.;
    place_obstacles();
  }



  void
  ContactKinematics::predict(const Vector &mean_velocity)
  {
    evaluator.evaluate(mean_velocity, rate);
  }



  void
  ContactKinematics::evaluate(const Vector                     &solution,
                              std::vector<ContactPointState<>> &states)
  {
    evaluator.evaluate(solution, current);
    find_states(current, Instant::end, states);
    up_to_date.assign(states.size(), false);
  }



  void
  ContactKinematics::evaluate(const std::vector<PointVector>   &values,
                              std::vector<ContactPointState<>> &states)
  {
    current = values;
    find_states(current, Instant::end, states);
    up_to_date.assign(states.size(), false);
  }



  void
  ContactKinematics::find_states(const std::vector<PointVector>   &observables,
                                 const Instant                     instant,
                                 std::vector<ContactPointState<>> &states) const
  {
    states.resize(observables.size());
    for (unsigned int p = 0; p < states.size(); ++p)
      states[p] = {gap(p, displacement_of(observables[p]), instant),
                   observables[p][PointPlace::stress_pressure],
                   observables[p][PointPlace::multiplier]};
  }



  template <int dim>
  std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<dim> &body, ContactPoints points)
  {
    const bool planes = std::all_of(points.points.begin(),
                                    points.points.end(),
                                    [](const ContactPoint &point) {
                                      return point.obstacle->is_plane_at_rest();
                                    });
    const bool moves =
      std::any_of(points.points.begin(),
                  points.points.end(),
                  [](const ContactPoint &point) {
                    return !point.obstacle->motion().is_at_rest();
                  });
    using dealii::Utilities::MPI::max;
    ContactPointEvaluator evaluator(body, std::move(points));
    if (max(planes ? 0 : 1, body.communicator) == 0)
      return std::make_unique<PlanesAtRest>(std::move(evaluator));
    return std::make_unique<RigidObstacles>(std::move(evaluator),
                                            max(moves ? 1 : 0,
                                                body.communicator) == 1);
  }


  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<1> &, ContactPoints);
  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<2> &, ContactPoints);
  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<3> &, ContactPoints);
} // namespace Ricochet
