// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_obstacle_work_h
#define ricochet_output_obstacle_work_h

#include <contact/obstacles/rigid_obstacle.h>
#include <discretization/body.h>

#include <array>
#include <vector>

namespace Ricochet
{
  /**
   * The work that moving obstacles do on a body, from the resultant of the contact
   * force, its moment and the motion of the obstacle: an independent value of a
   * term in the energy balance, equal up to terms of second order in the step.
   */
  template <int dim>
  class ObstacleWork
  {
  public:
    /// @param obstacles those of each contact; none for contact between bodies. A node
    /// between two parts of the boundary counts for the one with the smaller id.
    ObstacleWork(const Body<dim>              &body,
                 const std::vector<Obstacles> &obstacles);

    /**
     * @param old_solution displacement at the time @p begin (s).
     * @param new_solution displacement at the time @p end (s).
     * @param contact_forces the means of them over the step, on the side of the
     * internal forces, for each contact (N).
     * @return J
     */
    double
    operator()(const Vector              &old_solution,
               const Vector              &new_solution,
               const std::vector<Vector> &contact_forces,
               const double               begin,
               const double               end) const;

  private:
    struct Node
    {
      std::array<dealii::types::global_dof_index, dim> index;
      dealii::Tensor<1, 3>                             position;
    };

    const MPI_Comm communicator;
    /// An obstacle, and the nodes of this rank that can touch it.
    struct Touched
    {
      std::shared_ptr<const RigidObstacle> obstacle;
      unsigned int                         contact;
      std::vector<Node>                    nodes;
    };
    std::vector<Touched> obstacles;
  };
} // namespace Ricochet

#endif
