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
  /// One of several bodies in one mesh: the cells whose material id is its number.
  template <int dim>
  struct Part
  {
    std::string   name;
    Material<dim> material;
    /// kg/m^dim
    double density = 1.;
    /// At the start (m/s).
    dealii::Tensor<1, dim> velocity = {};
  };

  /// A displacement that is prescribed on a part of the boundary.
  template <int dim>
  struct ImposedDisplacement
  {
    /// Which components.
    std::array<bool, dim> components{};
    /// Displacement (m) at a time (s), whose other components do not matter; zero if
    /// empty.
    std::function<dealii::Tensor<1, dim>(const double time)> value;
  };

  /// What is to hit what.
  template <int dim>
  struct ImpactSetup
  {
    /// Of all bodies that are not named in #parts.
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

    /// Several bodies, with as many material ids; empty for one.
    std::vector<Part<dim>> parts = {};
    /// Surfaces that may touch each other or themselves.
    std::vector<ContactPair> pairs = {};
    /// Prescribed displacements, by boundary id.
    std::map<dealii::types::boundary_id, ImposedDisplacement<dim>> imposed = {};
    /// Tractions on the undeformed boundary (Pa) at a time (s), by boundary id.
    std::map<dealii::types::boundary_id,
             std::function<dealii::Tensor<1, dim>(const double time)>>
      tractions = {};
    /// The geometry of curved cells (see curved_geometry.h), with degree 2; null for
    /// cells with straight edges.
    std::shared_ptr<const dealii::Mapping<dim>> geometry = {};
  };

  /**
   * A body, its contact with obstacles and its equation of motion, put together
   * once the mesh is there: what every benchmark does in its setup.
   */
  template <int dim>
  struct Impact
  {
    /// @throws InputError when the mesh has no boundary for an obstacle, a contact
    /// or a condition, when a moving obstacle or an imposed displacement does not go
    /// with the time scheme, when some parts are linear elastic and others are not,
    /// and what redistribute_mass() and make_contact() throw.
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
    const std::vector<ContactPair>         pairs;
    const std::vector<Part<dim>>           parts;
    const std::unique_ptr<ContactOperator> contact;
    /// The weight of the body (N).
    const Vector weight;
    /// What the prescribed unknowns are prescribed by: component and value, none
    /// for zero.
    struct Prescription
    {
      dealii::types::global_dof_index                     unknown;
      unsigned int                                        component;
      std::function<dealii::Tensor<1, dim>(const double)> value;
    };
    const std::vector<Prescription>   prescriptions;
    SemiDiscreteSystem                system;
    const std::unique_ptr<TimeScheme> scheme;

    /// Set the prescribed displacements in @p vector to those at @p time (s).
    void
    impose(const double time, Vector &vector) const;

    /// Set the prescribed velocities to those at @p time, by differences over @p
    /// step (s).
    void
    impose_rate(const double time, const double step, Vector &vector) const;

    /// A field that is @p value everywhere, zero in multipliers.
    Vector
    uniform(const dealii::Tensor<1, dim> &value) const;

    /// The undeformed body in flight at time 0.
    ///
    /// @throws InputError when it overlaps with an obstacle, or parts of it with
    /// others, or an obstacle is not what it says it is where the body begins.
    State
    state_in_flight(const dealii::Tensor<1, dim> &velocity);

    /// The same with a @p velocity (m/s) that is not that of a flight.
    State
    state_in_motion(const dealii::Function<dim> &velocity);

    /// The same with each part in flight with its own velocity.
    State
    state_of_parts();

  private:
    State
    state_with(const Vector &velocity);
  };

  /// The half space below x_dim = 0, as the obstacle of the boundary @p
  /// boundary_id.
  template <int dim>
  Obstacles
  foundation_below(const dealii::types::boundary_id boundary_id);
} // namespace Ricochet

#endif
