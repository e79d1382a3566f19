// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_impact_h
#define ricochet_problems_impact_h

#include <discretization/body.h>
#include <discretization/boundary_springs.h>
#include <discretization/bulk_operator.h>
#include <discretization/follower_pressure.h>
#include <discretization/resultant_load.h>
#include <materials/material.h>
#include <output/checkpoint.h>
#include <problems/impact_parameters.h>

#include <memory>

namespace Ricochet
{
  /// A vector that depends on the time (s) and on the position in the
  /// undeformed body (m).
  template <int dim>
  using VectorField =
    std::function<dealii::Tensor<1, dim>(const double              time,
                                         const dealii::Point<dim> &place)>;

  /// One of several bodies in one mesh: the cells whose material id is its number.
  template <int dim>
  struct Part
  {
    std::string   name;
    Material<dim> material;
    /// kg/m^dim
    double density = 1.;
    /// Initial velocity of the point #centre (m/s).
    dealii::Tensor<1, dim> velocity = {};
    /// Initial angular velocity (rad/s); in 2D the third component is the only
    /// one.
    dealii::Tensor<1, 3> spin = {};
    /// The point about which it spins (m).
    dealii::Point<dim> centre = {};
    /// Force per mass (m/s^2) beside that of gravity; empty for none.
    VectorField<dim> acceleration = {};
  };

  /// A displacement that is prescribed on a part of the boundary.
  template <int dim>
  struct ImposedDisplacement
  {
    /// Prescribed components.
    std::array<bool, dim> components{};
    /// Displacement (m), whose other components do not matter; zero if empty.
    VectorField<dim> value;
  };

  /// One of several contacts, each with a treatment of its own.
  struct Contact
  {
    std::string       name;
    ContactParameters parameters;
    /// The obstacle of each boundary that takes part; or
    Obstacles obstacles = {};
    /// surfaces that may touch each other or themselves.
    std::vector<ContactPair> pairs = {};
    /// For contact with obstacles, the part whose stress Nitsche's method uses.
    unsigned int part = 0;

    bool
    is_between_bodies() const
    {
      return !pairs.empty();
    }

    /// The set of its multipliers, see Body.
    unsigned int
    multiplier_set() const
    {
      return is_between_bodies() ? pairs.front().multiplier_set : 0;
    }
  };

  /// Set-up of an impact: bodies, contacts, conditions and loads.
  template <int dim>
  struct ImpactSetup
  {
    /// Material of all bodies that are not in #parts.
    Material<dim> material;
    /// kg/m^dim
    double density = 1.;
    /// Polynomial degree of the displacement.
    unsigned int degree = 1;
    /// Boundary ids with zero displacement.
    typename Body<dim>::BoundaryIds clamped = {};
    /// The obstacle of each contact boundary, with the treatment of the parameters.
    Obstacles obstacles = {};
    /// Acceleration of gravity (m/s^2).
    dealii::Tensor<1, dim> gravity = {};
    /// Other loads; empty for none.
    SemiDiscreteSystem::Load load = {};

    /// Several bodies, with as many material ids; empty for one.
    std::vector<Part<dim>> parts = {};
    /// Surfaces that may touch each other or themselves, with that treatment.
    std::vector<ContactPair> pairs = {};
    /// Contacts with treatments of their own.
    std::vector<Contact> contacts = {};
    /// Prescribed displacements, by boundary id.
    std::map<dealii::types::boundary_id, ImposedDisplacement<dim>> imposed = {};
    /// Tractions on the undeformed boundary (Pa), by boundary id.
    std::map<dealii::types::boundary_id, VectorField<dim>> tractions = {};
    /// Forces and moments on parts of the boundary, and forces on vertices.
    std::vector<ResultantLoad<dim>> resultants = {};
    /// Vertices with ids of their own, for conditions.
    typename Body<dim>::Vertices vertices = {};
    /// Pressures that follow the surface.
    std::vector<BoundaryPressure<dim>> pressures = {};
    /// The bodies start with displacements, see Impact::state_from().
    bool starts_displaced = false;
    /// Springs and dashpots on parts of the boundary.
    std::vector<BoundarySprings<dim>> springs = {};
    /// The geometry of curved cells (see curved_geometry.h), with degree 2; null for
    /// cells with straight edges.
    std::shared_ptr<const dealii::Mapping<dim>> geometry = {};
  };

  /**
   * A body, its contact with obstacles and its equation of motion, set up on a
   * given mesh as in every benchmark.
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

    /// All contacts, in the order of ContactSum.
    std::vector<Contact>                contacts;
    const Body<dim>                     body;
    const std::unique_ptr<BulkOperator> bulk;
    const BodyMatrix                    consistent_mass;
    /// Null with the consistent mass.
    const std::unique_ptr<const BodyMatrix> redistributed_mass;
    /// Sentence about bodies that overlap, for a run that begins without
    /// displacements; empty if all is well.
    const std::string overlap_problem;
    /// The obstacles of all of them; of several contacts by ContactSum::id_of().
    const Obstacles                        obstacles;
    const std::vector<Part<dim>>           parts;
    const std::unique_ptr<ContactOperator> contact;
    /// The weight of the body (N).
    const Vector weight;
    /// Data of the prescribed unknowns: component, position and value, none for
    /// zero.
    struct Prescription
    {
      dealii::types::global_dof_index unknown;
      unsigned int                    component;
      dealii::Point<dim>              place;
      VectorField<dim>                value;
    };
    const std::vector<Prescription> prescriptions;
    /// Null without.
    const std::unique_ptr<FollowerLoad> follower;
    SemiDiscreteSystem                  system;
    const std::unique_ptr<TimeScheme>   scheme;
    /// SchemeTraits::has_inertia
    const bool has_inertia;

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
    /// others, or an obstacle is inconsistent at the initial position of the
    /// body, and without inertia when there is a velocity.
    State
    state_in_flight(const dealii::Tensor<1, dim> &velocity);

    /// The same with a @p velocity (m/s) that is not that of a flight.
    State
    state_in_motion(const dealii::Function<dim> &velocity);

    /// The same with each part in flight with its own velocity and spin.
    State
    state_of_parts();

    /// The motion of another run, to which the velocities of the parts are added.
    /// Displacements that conditions prescribe as zero keep their values of that run.
    /// @throws InputError when others begin elsewhere, and what state_in_flight() throws.
    State
    state_from(const CheckpointMotion &motion);

  private:
    /// Velocities of all parts, with their spins (m/s).
    Vector
    velocities_of_parts() const;

    /// Contacts that were not there in the run from which this one starts begin without
    /// penetration. @throws InputError Collective.
    void
    check_new_contacts(const State                    &state,
                       const std::vector<std::string> &contacts_before) const;

    /// Displacements with which the run starts (m); of size 0 for none.
    Vector start_displacement;

    State
    state_with(const Vector              &displacement,
               const Vector              &velocity,
               const std::vector<Vector> &contact_forces = {});
  };

  /// The half space below x_dim = 0, as the obstacle of the boundary @p
  /// boundary_id.
  template <int dim>
  Obstacles
  foundation_below(const dealii::types::boundary_id boundary_id);
} // namespace Ricochet

#endif
