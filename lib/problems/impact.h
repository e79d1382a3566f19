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
  /// What is to hit what.
  template <int dim>
  struct ImpactSetup
  {
    Material<dim> material;
    /// kg/m^dim
    double density = 1.;
    /// Polynomial degree of the displacement.
    unsigned int degree = 1;
    /// Boundary ids with zero displacement.
    typename Body<dim>::BoundaryIds clamped = {};
    /// The obstacle of each contact boundary.
    Obstacles obstacles = {};
    /// Acceleration of gravity (m/s^2).
    dealii::Tensor<1, dim> gravity = {};
    /// Other loads; empty for none.
    SemiDiscreteSystem::Load load = {};
  };

  /**
   * A body, its contact with obstacles and its equation of motion, put together
   * once the mesh is there: what every benchmark does in its setup.
   */
  template <int dim>
  struct Impact
  {
    /// @throws InputError when the mesh has no boundary for an obstacle, when a
    /// moving one does not go with the time scheme, and what redistribute_mass()
    /// and make_contact() throw.
    Impact(const ImpactParameters           &parameters,
           const dealii::Triangulation<dim> &triangulation,
           const ImpactSetup<dim>           &setup,
           const MPI_Comm                    communicator);

    const Body<dim>                     body;
    const std::unique_ptr<BulkOperator> bulk;
    const Matrix                        consistent_mass;
    /// Null with the consistent mass.
    const std::unique_ptr<const Matrix>    redistributed_mass;
    const Obstacles                        obstacles;
    const std::unique_ptr<ContactOperator> contact;
    /// The weight of the body (N).
    const Vector                      weight;
    SemiDiscreteSystem                system;
    const std::unique_ptr<TimeScheme> scheme;

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
