// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_contact_points_h
#define ricochet_contact_contact_points_h

#include <contact/contact_law.h>
#include <discretization/body.h>
#include <materials/linear_elastic.h>

#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * The rigid obstacle that a part of the boundary can touch: its signed
   * distance (m), positive outside, by boundary id. Kinematics are linearised
   * about the reference position, which is exact for planes:
   * gap(u) = distance(x) + grad distance(x) . u. Others are refused.
   */
  template <int dim>
  using Obstacles = std::map<dealii::types::boundary_id,
                             std::shared_ptr<const dealii::Function<dim>>>;

  /**
   * One point of the contact boundary: gap, stress pressure and multiplier are
   * affine functions of the unknowns, given here by their coefficients.
   */
  struct ContactPoint
  {
    /// Area that the point stands for (m^(dim-1)): JxW of a quadrature point,
    /// lumped boundary mass of a node.
    double weight = 0.;
    /// Gap at zero displacement (m).
    double initial_gap = 0.;
    /// h_T (m).
    double                     cell_diameter = 0.;
    dealii::types::boundary_id boundary_id   = 0;
    /// Unit normal of the obstacle, towards the body; zeros beyond dim.
    dealii::Tensor<1, 3> obstacle_normal;

    /// Coefficients [begin, end) in ContactPoints::index, gap_coefficient, ...
    unsigned int begin = 0, end = 0;
  };

  /// The projection on the plane with the unit normal @p normal.
  inline dealii::Tensor<2, 3>
  tangent_plane(const dealii::Tensor<1, 3> &normal)
  {
    return dealii::Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()) -
      outer_product(normal, normal);
  }

  /// Round-off (m) of a gap that is the difference of an initial gap and a
  /// displacement.
  inline double
  gap_round_off(const ContactPoint &point, const double gap)
  {
    return 2. * std::numeric_limits<double>::epsilon() *
      (std::abs(point.initial_gap) + std::abs(gap - point.initial_gap));
  }

  /**
   * All contact points of this rank, with their coefficients in flat
   * arrays that the hot loops run through. Made once: linear kinematics.
   */
  struct ContactPoints
  {
    std::vector<ContactPoint> points;

    /// System index of each coefficient.
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          gap_coefficient;
    std::vector<double>                          stress_pressure_coefficient;
    std::vector<double>                          multiplier_coefficient;
    /// Which component of the displacement of the point the unknown belongs to
    /// and with which factor (0 for multipliers).
    std::vector<unsigned int> component;
    std::vector<double>       shape_value;

    /// Append an unknown of the displacement to the last point.
    void
    add_displacement(const dealii::types::global_dof_index unknown,
                     const dealii::Tensor<1, 3>           &obstacle_normal,
                     const unsigned int displacement_component,
                     const double       value,
                     const double       stress_pressure)
    {
      index.push_back(unknown);
      gap_coefficient.push_back(obstacle_normal[displacement_component] *
                                value);
      stress_pressure_coefficient.push_back(stress_pressure);
      multiplier_coefficient.push_back(0.);
      component.push_back(displacement_component);
      shape_value.push_back(value);
    }

    /// Append a multiplier.
    void
    add_multiplier(const dealii::types::global_dof_index unknown,
                   const double                          value)
    {
      index.push_back(unknown);
      gap_coefficient.push_back(0.);
      stress_pressure_coefficient.push_back(0.);
      multiplier_coefficient.push_back(value);
      component.push_back(0);
      shape_value.push_back(0.);
    }
  };

  /**
   * Quadrature points of all contact faces of owned cells.
   *
   * The stress pressure is that of @p material on the face, along the normal
   * of the obstacle: p = normal . sigma(u) n, with n the outward normal of the
   * body. Without a linear material it is zero.
   *
   * @throws InputError when an obstacle is not a plane.
   */
  template <int dim>
  ContactPoints
  make_quadrature_contact_points(const Body<dim>                    &body,
                                 const std::optional<LinearElastic> &material,
                                 const Obstacles<dim>               &obstacles);

  /**
   * Owned nodes of the contact boundary, each with its lumped boundary mass,
   * which is zero in vertices of quadratic tetrahedra; without multipliers.
   *
   * @throws InputError when an obstacle is not a plane.
   */
  template <int dim>
  ContactPoints
  make_contact_nodes(const Body<dim> &body, const Obstacles<dim> &obstacles);

  /**
   * The same for treatments that live in nodes. The multiplier of a node is the one of that node; nodes know no stress
   * pressure.
   *
   * @throws InputError when a lumped boundary mass is not positive (vertices of
   * quadratic tetrahedra), for nodal multipliers with degree > 1, when a node is
   * clamped, and when an obstacle is not a plane.
   */
  template <int dim>
  ContactPoints
  make_nodal_contact_points(const Body<dim>      &body,
                            const Obstacles<dim> &obstacles);
} // namespace Ricochet

#endif
