// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/mixed_bulk.h>

namespace Ricochet
{
  namespace
  {
    /// The @p materials, with one without any stress in place of those that are not linear, or
    /// that are.
    template <int dim>
    std::vector<Material<dim>>
    with_stress(const std::vector<Material<dim>> &materials, const bool linear)
    {
      std::vector<Material<dim>> result;
      for (const Material<dim> &material : materials)
        result.push_back(material.linear.has_value() == linear
                           ? material
                           : Material<dim>(LinearElastic{0., 0.}));
      return result;
    }
  } // namespace



  template <int dim>
  MixedBulk<dim>::MixedBulk(const Body<dim>                  &body,
                            const std::vector<Material<dim>> &materials,
                            const MatrixStorage               storage)
    : linear(body, with_stress(materials, true), storage)
    , hyperelastic(body, with_stress(materials, false))
    , part(body.make_vector())
  {}



  template <int dim>
  void
  MixedBulk<dim>::force(const Vector &solution, Vector &force) const
  {
    linear.force(solution, force);
    hyperelastic.force(solution, part);
    force += part;
  }



  template <int dim>
  void
  MixedBulk<dim>::add_tangent(const double  factor,
                              const Vector &solution,
                              Matrix       &tangent) const
  {
    linear.add_tangent(factor, solution, tangent);
    hyperelastic.add_tangent(factor, solution, tangent);
  }



  template <int dim>
  void
  MixedBulk<dim>::step_force(const Vector &old_solution,
                             const Vector &new_solution,
                             const double  time_step,
                             Vector       &force) const
  {
    linear.step_force(old_solution, new_solution, time_step, force);
    hyperelastic.step_force(old_solution, new_solution, time_step, part);
    force += part;
  }



  template <int dim>
  void
  MixedBulk<dim>::add_step_tangent(const Vector &old_solution,
                                   const Vector &new_solution,
                                   const double  time_step,
                                   Matrix       &tangent) const
  {
    linear.add_step_tangent(old_solution, new_solution, time_step, tangent);
    hyperelastic.add_step_tangent(old_solution,
                                  new_solution,
                                  time_step,
                                  tangent);
  }



  template <int dim>
  std::vector<double>
  MixedBulk<dim>::energies_of_parts(const Vector &solution) const
  {
    std::vector<double> energies = linear.energies_of_parts(solution);
    const auto          others   = hyperelastic.energies_of_parts(solution);
    for (unsigned int p = 0; p < energies.size(); ++p)
      energies[p] += others[p];
    return energies;
  }



  template <int dim>
  void
  MixedBulk<dim>::viscous_force(const Vector &rate_origin,
                                const Vector &solution,
                                const double  rate_time,
                                Vector       &result) const
  {
    result = 0.;
    for (const BulkOperator *one :
         {static_cast<const BulkOperator *>(&linear),
          static_cast<const BulkOperator *>(&hyperelastic)})
      if (one->is_viscous())
        {
          one->viscous_force(rate_origin, solution, rate_time, part);
          result += part;
        }
  }



  template <int dim>
  void
  MixedBulk<dim>::add_viscous_tangent(const double  factor,
                                      const Vector &rate_origin,
                                      const Vector &solution,
                                      const double  rate_time,
                                      Matrix       &tangent) const
  {
    for (const BulkOperator *one :
         {static_cast<const BulkOperator *>(&linear),
          static_cast<const BulkOperator *>(&hyperelastic)})
      if (one->is_viscous())
        one->add_viscous_tangent(factor,
                                 rate_origin,
                                 solution,
                                 rate_time,
                                 tangent);
  }


  template class MixedBulk<2>;
  template class MixedBulk<3>;
} // namespace Ricochet
