// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_follower_pressure_h
#define ricochet_discretization_follower_pressure_h

#include <base/ghosted_vector.h>
#include <discretization/body.h>
#include <discretization/follower_load.h>

#include <functional>
#include <vector>

namespace Ricochet
{
  /// A pressure on a part of the boundary.
  template <int dim>
  struct BoundaryPressure
  {
    dealii::types::boundary_id boundary_id;
    /// Pa, at a time (s) and a point of the undeformed body (m); towards the
    /// body.
    std::function<double(const double time, const dealii::Point<dim> &place)>
      pressure;
  };

  /**
   * A pressure that follows the surface: the force -p n da of the deformed boundary, with
   * n da = cof(F) N dA. Over a step F is taken to vary linearly, and the mean
   * of cof(F) is exact, since cof(F) is a polynomial of degree dim - 1 in F,
   *
   *     mean = cof(F_m) in 2D, (cof(F_0) + 4 cof(F_m) + cof(F_1))/6 in 3D,
   *
   * F_m belonging to the middle; p is that of the middle of the step. So the work over a
   * step of a pressure that is the same everywhere on a closed surface is -p times the
   * change of the volume within it, to round-off, and it has neither a sum nor, at an
   * instant, a moment.
   */
  template <int dim>
  class FollowerPressure : public FollowerLoad
  {
  public:
    FollowerPressure(const Body<dim>                          &body,
                     const std::vector<BoundaryPressure<dim>> &pressures);

    void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  begin,
               const double  end,
               Vector       &force) const override;

    void
    subtract_step_tangent(const double  weight,
                          const Vector &old_solution,
                          const Vector &new_solution,
                          const double  begin,
                          const double  end,
                          Matrix       &tangent) const override;

  private:
    /// A shape function in a quadrature point.
    struct Node
    {
      std::array<dealii::types::global_dof_index, dim> unknowns;
      double                                           value;
      dealii::Tensor<1, dim>                           gradient;
    };

    struct QuadraturePoint
    {
      /// Index in the list of pressures.
      unsigned int       pressure;
      dealii::Point<dim> place;
      /// N dA (m^(dim-1)).
      dealii::Tensor<1, dim> area;
      std::vector<Node>      nodes;
    };

    /// F, with the solution in #ghosted.
    dealii::Tensor<2, dim>
    deformation_gradient(const QuadraturePoint &point,
                         const GhostedVector   &ghosted) const;

    const Body<dim>                         &body;
    const std::vector<BoundaryPressure<dim>> pressures;
    // Quadrature points of the cells of this rank.
    std::vector<QuadraturePoint> points;
    mutable GhostedVector        ghosted_old, ghosted_new;
  };
} // namespace Ricochet

#endif
