// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_obstacle_surfaces_h
#define ricochet_output_obstacle_surfaces_h

#include <contact/obstacles/rigid_obstacle.h>

#include <deal.II/base/bounding_box.h>
#include <deal.II/base/data_out_base.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Rigid obstacles as surfaces (in the plane, curves) for pictures: where the gap is
   * zero, found by marching cubes on a grid around the bodies, which is coarse and says
   * nothing of contact. The data are the normal towards the bodies and the number of
   * the obstacle.
   */
  template <int dim>
  class ObstacleSurfaces
  {
  public:
    /// One that several boundaries touch counts once.
    explicit ObstacleSurfaces(const Obstacles &obstacles);

    /// Whether there is anything to show; there is nothing in 1D.
    bool
    empty() const
    {
      return obstacles.empty() || dim == 1;
    }

    /// @param bodies what the bodies are within (m). @param flags with the time (s).
    /// @return what has to be in a VTU file.
    std::string
    vtu(const dealii::BoundingBox<dim>      &bodies,
        const dealii::DataOutBase::VtkFlags &flags) const;

  private:
    std::vector<std::shared_ptr<const RigidObstacle>> obstacles;
  };
} // namespace Ricochet

#endif
