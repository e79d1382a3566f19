// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/contact_points.h>
#include <output/obstacle_work.h>

#include <set>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  ObstacleWork<dim>::ObstacleWork(const Body<dim>           &body,
                                  const Ricochet::Obstacles &all_obstacles)
    : communicator(body.communicator)
  {
    const ContactPoints points =
      make_contact_nodes(body, all_obstacles, /* with multipliers */ false);
    std::set<types::global_dof_index> seen;
    for (const auto &[id, obstacle] : all_obstacles)
      {
        obstacles.push_back(obstacle);
        nodes.emplace_back();
        for (const ContactPoint &point : points.points)
          if (point.boundary_id == id &&
              seen.insert(points.index[point.begin]).second)
            {
              Node node;
              for (unsigned int k = point.begin; k < point.end; ++k)
                node.index[points.component[k]] = points.index[k];
              node.position = point.reference_position;
              nodes.back().push_back(node);
            }
      }
  }



  template <int dim>
  double
  ObstacleWork<dim>::operator()(const Vector &old_solution,
                                const Vector &new_solution,
                                const Vector &contact_force,
                                const double  begin,
                                const double  end) const
  {
    double work = 0.;
    for (unsigned int i = 0; i < obstacles.size(); ++i)
      {
        // What the body does to the obstacle, which stands on the side of the
        // internal forces.
        Tensor<1, 3> force, moment;
        for (const Node &node : nodes[i])
          {
            Tensor<1, 3> node_force, position = node.position;
            for (unsigned int c = 0; c < dim; ++c)
              {
                node_force[c] = contact_force(node.index[c]);
                position[c] += .5 *
                  (old_solution(node.index[c]) + new_solution(node.index[c]));
              }
            force += node_force;
            moment += cross_product_3d(position, node_force);
          }
        force  = Utilities::MPI::sum(force, communicator);
        moment = Utilities::MPI::sum(moment, communicator);
        work -= obstacles[i]->motion().work(force, moment, begin, end);
      }
    return work;
  }


  template class ObstacleWork<2>;
  template class ObstacleWork<3>;
} // namespace Ricochet
