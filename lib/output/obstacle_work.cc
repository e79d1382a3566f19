// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/kinematics/contact_points.h>
#include <output/obstacle_work.h>

#include <set>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  ObstacleWork<dim>::ObstacleWork(
    const Body<dim>                        &body,
    const std::vector<Ricochet::Obstacles> &obstacles_of_contacts)
    : communicator(body.communicator)
  {
    for (unsigned int k = 0; k < obstacles_of_contacts.size(); ++k)
      {
        const Ricochet::Obstacles &all = obstacles_of_contacts[k];
        if (all.empty())
          continue;
        const ContactPoints points =
          make_contact_nodes(body, all, /* with multipliers */ false);
        std::set<types::global_dof_index> seen;
        for (const auto &[id, obstacle] : all)
          {
            Touched touched{obstacle, k, {}};
            for (const ContactPoint &point : points.points)
              if (point.boundary_id == id &&
                  seen.insert(points.index[point.begin]).second)
                {
                  Node node;
                  for (unsigned int i = point.begin; i < point.end; ++i)
                    node.index[points.component[i]] = points.index[i];
                  node.position = point.reference_position;
                  touched.nodes.push_back(node);
                }
            obstacles.push_back(touched);
          }
      }
  }



  template <int dim>
  double
  ObstacleWork<dim>::operator()(const Vector              &old_solution,
                                const Vector              &new_solution,
                                const std::vector<Vector> &contact_forces,
                                const double               begin,
                                const double               end) const
  {
    double work = 0.;
    for (const Touched &touched : obstacles)
      {
        // The force of the body on the obstacle, which has the sign of the
        // internal forces.
        const Vector &contact_force = contact_forces[touched.contact];
        Tensor<1, 3>  force, moment;
        for (const Node &node : touched.nodes)
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
        work -= touched.obstacle->motion().work(force, moment, begin, end);
      }
    return work;
  }


  template class ObstacleWork<2>;
  template class ObstacleWork<3>;
} // namespace Ricochet
