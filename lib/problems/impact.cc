// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/obstacles/half_space.h>
#include <base/exceptions.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <problems/clearance.h>
#include <problems/impact.h>
#include <time_integration/mass_redistribution.h>


namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    typename Body<dim>::BoundaryIds
    boundary_ids(const Obstacles &obstacles)
    {
      typename Body<dim>::BoundaryIds ids;
      for (const auto &obstacle : obstacles)
        ids.insert(obstacle.first);
      return ids;
    }

    /// The mesh has each of the @p boundaries. @return the mesh.
    template <int dim>
    const Triangulation<dim> &
    with_boundaries(const Triangulation<dim>              &triangulation,
                    const typename Body<dim>::BoundaryIds &boundaries,
                    const MPI_Comm                         communicator)
    {
      for (const auto id : boundaries)
        {
          bool found = false;
          for (const auto &cell : triangulation.active_cell_iterators())
            if (cell->is_locally_owned())
              for (const auto &face : cell->face_iterators())
                found =
                  found || (face->at_boundary() && face->boundary_id() == id);
          if (Utilities::MPI::max(found ? 1 : 0, communicator) == 0)
            throw InputError("The mesh has no boundary with the id " +
                             std::to_string(id) +
                             ", which should touch an obstacle or be held.");
        }
      return triangulation;
    }

    /// A field that is @p value everywhere, zero in multipliers.
    template <int dim>
    Vector
    uniform_field(const Body<dim> &body, const Tensor<1, dim> &value)
    {
      Vector vector;
      body.interpolate(Functions::ConstantFunction<dim>(
                         std::vector<double>(value.begin_raw(),
                                             value.end_raw())),
                       vector);
      return vector;
    }

    template <int dim>
    Vector
    weight_of(const Body<dim>      &body,
              const Matrix         &mass,
              const Tensor<1, dim> &gravity)
    {
      Vector weight = body.make_vector();
      if (gravity != Tensor<1, dim>())
        mass.vmult(weight, uniform_field(body, gravity));
      return weight;
    }

    template <int dim>
    std::unique_ptr<BulkOperator>
    make_bulk(const Body<dim> &body, const Material<dim> &material)
    {
      if constexpr (dim > 1)
        if (!material.linear)
          return std::make_unique<HyperelasticBulk<dim>>(body, material);
      return std::make_unique<LinearBulk<dim>>(body,
                                               *material.linear,
                                               material.viscosity);
    }
  } // namespace



  template <int dim>
  Impact<dim>::Impact(const ImpactParameters   &parameters,
                      const Triangulation<dim> &triangulation,
                      const ImpactSetup<dim>   &setup,
                      const MPI_Comm            communicator)
    : body(with_boundaries(with_boundaries(triangulation,
                                           boundary_ids<dim>(setup.obstacles),
                                           communicator),
                           setup.clamped,
                           communicator),
           setup.degree,
           setup.clamped,
           boundary_ids<dim>(setup.obstacles),
           multiplier_space(parameters.contact),
           communicator)
    , bulk(make_bulk(body, setup.material))
    , consistent_mass(assemble_mass_matrix(body, setup.density))
    , redistributed_mass(
        parameters.redistributed_mass()
          ? std::make_unique<Matrix>(redistribute_mass(body, consistent_mass))
          : nullptr)
    , obstacles(setup.obstacles)
    , contact(make_contact(parameters.contact,
                           scheme_traits(parameters.scheme.name),
                           body,
                           setup.material.linear
                             ? LinearStress<dim>(*setup.material.linear)
                             : LinearStress<dim>(),
                           obstacles))
    , weight(weight_of(body, consistent_mass, setup.gravity))
    , system(redistributed_mass ? *redistributed_mass : consistent_mass,
             consistent_mass,
             *bulk,
             *contact,
             {parameters.redistributed_mass()
                ? body.contact_indices()
                : IndexSet(body.contact_indices().size()),
              body.clamped_indices(),
              body.multiplier_indices(),
              dim,
              &body.sparsity_pattern(),
              [this]() { return body.canonical_positions(); },
              [this]() { return body.coarse_space(); }},
             setup.gravity == Tensor<1, dim>()
               ? setup.load
               : [this, load = setup.load](const double time, Vector &result) {
                   if (load)
                     load(time, result);
                   result += weight;
                 },
             parameters.newton,
             parameters.linear_solver)
    , scheme(make_time_scheme(parameters.scheme))
  {
    check_motions(scheme_traits(parameters.scheme.name), obstacles);
  }


  template <int dim>
  Vector
  Impact<dim>::uniform(const Tensor<1, dim> &value) const
  {
    return uniform_field(body, value);
  }



  template <int dim>
  State
  Impact<dim>::state_in_flight(const Tensor<1, dim> &velocity)
  {
    return state_in_motion(Functions::ConstantFunction<dim>(
      std::vector<double>(velocity.begin_raw(), velocity.end_raw())));
  }



  template <int dim>
  State
  Impact<dim>::state_in_motion(const Function<dim> &velocity)
  {
    check_clearance(body, obstacles);
    Vector start;
    body.interpolate(velocity, start);
    return system.initial_state(uniform(Tensor<1, dim>()),
                                start,
                                /* time */ 0.);
  }



  template <int dim>
  Obstacles
  foundation_below(const types::boundary_id boundary_id)
  {
    Tensor<1, dim> up;
    up[dim - 1] = 1.;
    return {{boundary_id, half_space_at_rest<dim>(Point<dim>(), up)}};
  }


  template struct Impact<1>;
  template struct Impact<2>;
  template struct Impact<3>;
  template Obstacles
  foundation_below<2>(const types::boundary_id);
  template Obstacles
  foundation_below<3>(const types::boundary_id);
} // namespace Ricochet
