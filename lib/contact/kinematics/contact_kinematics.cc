// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/planes_at_rest.h>
#include <contact/kinematics/rigid_obstacles.h>

#include <deal.II/base/mpi.h>

#include <algorithm>

namespace Ricochet
{
  ContactKinematics::ContactKinematics(ContactPointEvaluator evaluator_,
                                       const Needs          &needs)
    : evaluator(std::move(evaluator_))
    , needs(needs)
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



  template <int dim>
  std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<dim>                &body,
                  ContactPoints                   points,
                  const ContactKinematics::Needs &needs)
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
      return std::make_unique<PlanesAtRest>(std::move(evaluator), needs);
    return std::make_unique<RigidObstacles>(std::move(evaluator),
                                            needs,
                                            max(moves ? 1 : 0,
                                                body.communicator) == 1);
  }


  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<1> &,
                  ContactPoints,
                  const ContactKinematics::Needs &);
  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<2> &,
                  ContactPoints,
                  const ContactKinematics::Needs &);
  template std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<3> &,
                  ContactPoints,
                  const ContactKinematics::Needs &);
} // namespace Ricochet
