// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_obstacles_obstacle_parameters_h
#define ricochet_contact_obstacles_obstacle_parameters_h

#include <base/parameter_file.h>
#include <contact/obstacles/rigid_obstacle.h>

#include <deal.II/base/parameter_handler.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /// A rigid obstacle as described in the subsection Obstacle.
  template <int dim>
  struct ObstacleParameters
  {
    ObstacleParameters();

    /// Section of the parameter file; several obstacles have sections of their
    /// own.
    std::string section = "Obstacle";
    std::string shape   = "half space";
    /// m
    dealii::Tensor<1, dim> centre;
    dealii::Tensor<1, dim> direction;
    /// m
    double radius      = 1.;
    double tube_radius = .1;
    bool   hollow      = false;
    /// Expressions of x, y, z.
    std::string function = dim == 2 ? "y" : "z";
    std::string gradient = dim == 2 ? "0; 1" : "0; 0; 1";
    /// m
    double length = 1.;
    /// Expressions of t (m, rad).
    std::string            translation = dim == 2 ? "0; 0" : "0; 0; 0";
    std::string            rotation    = "0";
    dealii::Tensor<1, dim> rotation_centre;
    /// In 3D only; in 2D obstacles turn about the normal of the plane.
    dealii::Tensor<1, 3> rotation_axis;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// The parameters that the shape does not use.
    std::vector<UnusedParameter>
    unused_parameters() const;

    /**
     * The obstacle.
     * @param final_time until when its motion has to be finite (s).
     * @throws InputError for lengths that are not positive, directions of no
     * length, expressions that cannot be read and a motion that is not finite.
     */
    std::shared_ptr<const RigidObstacle>
    make(const double final_time) const;
  };
} // namespace Ricochet

#endif
