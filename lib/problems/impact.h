// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_impact_h
#define ricochet_problems_impact_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/material.h>
#include <problems/impact_parameters.h>

#include <memory>

namespace Ricochet
{
  /**
   * A body, its contact with an obstacle and its equation of motion, put
   * together once the mesh is there: what every benchmark does in its setup.
   */
  template <int dim>
  struct Impact
  {
    /**
     * @param density kg/m^dim
     * @param clamped boundary ids with zero displacement.
     * @param obstacles the obstacle of each contact boundary.
     * @param load external load, empty for none.
     * @throws InputError when the mesh has no boundary for an obstacle, and what
     * redistribute_mass() and make_contact() throw.
     */
    Impact(const ImpactParameters                &parameters,
           const dealii::Triangulation<dim>      &triangulation,
           const unsigned int                     degree,
           const Material<dim>                   &material,
           const double                           density,
           const typename Body<dim>::BoundaryIds &clamped,
           const Obstacles                       &obstacles,
           const SemiDiscreteSystem::Load        &load,
           const MPI_Comm                         communicator);

    const Body<dim>                     body;
    const std::unique_ptr<BulkOperator> bulk;
    const Matrix                        consistent_mass;
    /// Null with the consistent mass.
    const std::unique_ptr<const Matrix>    redistributed_mass;
    const Obstacles                        obstacles;
    const std::unique_ptr<ContactOperator> contact;
    SemiDiscreteSystem                     system;
    const std::unique_ptr<TimeScheme>      scheme;

    /// A field that is @p value everywhere, zero in multipliers.
    Vector
    uniform(const dealii::Tensor<1, dim> &value) const;

    /// The undeformed body in flight at time 0.
    ///
    /// @throws InputError when it overlaps with an obstacle, or an obstacle is not
    /// what it says it is where the body begins.
    State
    state_in_flight(const dealii::Tensor<1, dim> &velocity);

    /// The same with a @p velocity (m/s) that is not that of a flight.
    State
    state_in_motion(const dealii::Function<dim> &velocity);
  };

  /// The half space below x_dim = 0, as the obstacle of the boundary @p
  /// boundary_id.
  template <int dim>
  Obstacles
  foundation_below(const dealii::types::boundary_id boundary_id);
} // namespace Ricochet

#endif
