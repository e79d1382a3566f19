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
   * Rigid obstacles as surfaces (in 2D, curves) for pictures: the zero level of
   * the gap, found by marching cubes on a grid around the bodies, which is
   * coarse and independent of contact. The data are the normal towards the
   * bodies and the number of the obstacle.
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

    /// @param bodies bounding boxes of the bodies (m). @param flags with the
    /// time (s). @return the contents of a VTU file.
    std::string
    vtu(const dealii::BoundingBox<dim>      &bodies,
        const dealii::DataOutBase::VtkFlags &flags) const;

  private:
    std::vector<std::shared_ptr<const RigidObstacle>> obstacles;
  };
} // namespace Ricochet

#endif
