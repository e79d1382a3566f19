// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_contact_points_h
#define ricochet_contact_kinematics_contact_points_h

#include <contact/laws/contact_law.h>
#include <contact/obstacles/rigid_obstacle.h>
#include <discretization/body.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <type_traits>
#include <vector>

namespace Ricochet
{
  /**
   * One point of the contact boundary: its displacement, stress pressure and
   * multiplier are linear functions of the unknowns, given by their coefficients
   * in ContactPoints.
   */
  struct ContactPoint
  {
    /// Area associated with the point (m^(dim-1)): JxW of a quadrature point,
    /// lumped boundary mass of a node.
    double weight = 0.;
    /// Gap at zero displacement and time 0 (m).
    double initial_gap = 0.;
    /// h_T (m).
    double                     cell_diameter = 0.;
    dealii::types::boundary_id boundary_id   = 0;
    /// Unit normal of the obstacle, towards the body, at zero displacement and
    /// time 0; zeros beyond dim.
    dealii::Tensor<1, 3> obstacle_normal;
    /// m
    dealii::Tensor<1, 3> reference_position;
    /// Never null.
    std::shared_ptr<const RigidObstacle> obstacle;

    /// Coefficients [begin, end) in ContactPoints::index, shape_value, ...
    unsigned int begin = 0, end = 0;
  };

  /// Round-off (m) of a gap that is the difference of an initial gap and a
  /// displacement.
  inline double
  gap_round_off(const ContactPoint &point, const double gap)
  {
    return 2. * std::numeric_limits<double>::epsilon() *
      (std::abs(point.initial_gap) + std::abs(gap - point.initial_gap));
  }

  /**
   * All contact points of this rank, with their coefficients in flat arrays for
   * the inner loops. Made once.
   */
  struct ContactPoints
  {
    std::vector<ContactPoint> points;

    /// System index of each coefficient.
    std::vector<dealii::types::global_dof_index> index;
    std::vector<double>                          stress_pressure_coefficient;
    std::vector<double>                          multiplier_coefficient;
    /// The component of the point's displacement to which the unknown
    /// contributes, and its factor (0 for multipliers).
    std::vector<unsigned int> component;
    std::vector<double>       shape_value;

    /// Append an unknown of the displacement to the last point.
    void
    add_displacement(const dealii::types::global_dof_index unknown,
                     const unsigned int displacement_component,
                     const double       value,
                     const double       stress_pressure)
    {
      index.push_back(unknown);
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
      stress_pressure_coefficient.push_back(0.);
      multiplier_coefficient.push_back(value);
      component.push_back(0);
      shape_value.push_back(0.);
    }
  };

  /// Cauchy stress (Pa) as a linear function of the strain; empty for bodies
  /// whose stress is not one.
  template <int dim>
  using LinearStress = std::function<dealii::SymmetricTensor<2, dim>(
    const dealii::SymmetricTensor<2, dim> &)>;

  /**
   * The direction for the body's stress in laws: the pressure is direction . sigma
   * n, n being the @p outward_normal of the body. Against a plane at rest it is
   * the obstacle's normal @p obstacle_normal, elsewhere -n, so that the pressure
   * is a linear function of the unknowns with constant coefficients.
   */
  dealii::Tensor<1, 3>
  stress_direction(const RigidObstacle        &obstacle,
                   const dealii::Tensor<1, 3> &obstacle_normal,
                   const dealii::Tensor<1, 3> &outward_normal);

  /**
   * Quadrature points of all contact faces of owned cells.
   *
   * The stress pressure is that of @p stress on the face, see stress_direction();
   * zero without.
   */
  template <int dim>
  ContactPoints
  make_quadrature_contact_points(
    const Body<dim>                             &body,
    const std::common_type_t<LinearStress<dim>> &stress,
    const Obstacles                             &obstacles);

  /**
   * Owned nodes of the contact boundary, each with its lumped boundary mass,
   * which is zero in vertices of quadratic tetrahedra.
   *
   * @param with_multipliers each node has the multiplier of that node; nodes have
   * no stress pressure.
   */
  template <int dim>
  ContactPoints
  make_contact_nodes(const Body<dim> &body,
                     const Obstacles &obstacles,
                     const bool       with_multipliers);

  /**
   * As above, for treatments in nodes.
   *
   * @param with_multipliers as above: a body may have multipliers that are not for
   * its obstacles.
   * @param eliminates_rows the treatment replaces rows of the nodes.
   *
   * @throws InputError when a lumped boundary mass is not positive (vertices of
   * quadratic tetrahedra), for nodal multipliers with degree > 1, and when a node
   * of a constraint is held along the normal.
   */
  template <int dim>
  ContactPoints
  make_nodal_contact_points(const Body<dim> &body,
                            const Obstacles &obstacles,
                            const bool       with_multipliers,
                            const bool       eliminates_rows);
} // namespace Ricochet

#endif
