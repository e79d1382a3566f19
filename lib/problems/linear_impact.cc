// SPDX-License-Identifier: LGPL-2.1-or-later
#include <problems/linear_impact.h>
#include <time_integration/mass_redistribution.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <int dim>
    typename Body<dim>::BoundaryIds
    boundary_ids(const Obstacles<dim> &obstacles)
    {
      typename Body<dim>::BoundaryIds ids;
      for (const auto &obstacle : obstacles)
        ids.insert(obstacle.first);
      return ids;
    }

    template <int dim>
    Matrix
    inertia(const bool       redistributed,
            const Body<dim> &body,
            const Matrix    &consistent_mass)
    {
      if (redistributed)
        return redistribute_mass(body, consistent_mass);
      Matrix copy;
      copy.copy_from(consistent_mass);
      return copy;
    }
  } // namespace



  template <int dim>
  LinearImpact<dim>::LinearImpact(
    const ImpactParameters                &parameters,
    const Triangulation<dim>              &triangulation,
    const unsigned int                     degree,
    const LinearElastic                   &material,
    const double                           density,
    const typename Body<dim>::BoundaryIds &clamped,
    const Obstacles<dim>                  &obstacles,
    const SemiDiscreteSystem::Load        &load,
    const MPI_Comm                         communicator)
    : body(triangulation,
           degree,
           clamped,
           boundary_ids(obstacles),
           multiplier_space(parameters.contact),
           communicator)
    , bulk(body, material)
    , consistent_mass(assemble_mass_matrix(body, density))
    , mass(inertia(parameters.redistributed_mass(), body, consistent_mass))
    , contact(make_contact(parameters.contact,
                           parameters.scheme.name,
                           body,
                           material,
                           obstacles))
    , system(mass,
             consistent_mass,
             bulk,
             *contact,
             parameters.redistributed_mass()
               ? body.contact_indices()
               : IndexSet(body.contact_indices().size()),
             body.clamped_indices(),
             body.multiplier_indices(),
             load,
             parameters.newton,
             parameters.linear_solver)
    , scheme(make_time_scheme(parameters.scheme))
  {}


  template struct LinearImpact<1>;
  template struct LinearImpact<2>;
  template struct LinearImpact<3>;
} // namespace Ricochet
