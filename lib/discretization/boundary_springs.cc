// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <discretization/boundary_springs.h>
#include <discretization/linear_bulk.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The boundary's mass matrix, weighted with the @p density of each of the
    /// @p springs (Pa/m, or Pa s/m).
    template <int dim>
    BodyMatrix
    assemble(const Body<dim>                         &body,
             const std::vector<BoundarySprings<dim>> &springs,
             double BoundarySprings<dim>::*density)
    {
      Matrix                    matrix;
      const FiniteElement<dim> &element = body.dof_handler().get_fe();
      FEFaceValues<dim>         values(body.mapping(),
                               element,
                               body.face_quadrature(),
                               update_values | update_JxW_values);
      const unsigned int        n = element.n_dofs_per_cell();
      FullMatrix<double>        cell_matrix(n, n);
      std::vector<types::global_dof_index> indices(n);
      matrix.reinit(body.sparsity_pattern());
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          for (const unsigned int f : cell->face_indices())
            for (const BoundarySprings<dim> &spring : springs)
              if (cell->face(f)->at_boundary() &&
                  cell->face(f)->boundary_id() == spring.boundary_id)
                {
                  values.reinit(cell, f);
                  cell_matrix = 0.;
                  for (unsigned int i = 0; i < n; ++i)
                    for (unsigned int j = 0; j < n; ++j)
                      {
                        const unsigned int c =
                          element.system_to_component_index(i).first;
                        if (c != element.system_to_component_index(j).first ||
                            !spring.components[c])
                          continue;
                        for (const unsigned int q :
                             values.quadrature_point_indices())
                          cell_matrix(i, j) += spring.*density *
                            values.shape_value(i, q) *
                            values.shape_value(j, q) * values.JxW(q);
                      }
                  cell->get_dof_indices(indices);
                  for (types::global_dof_index &index : indices)
                    index = body.system_index(index);
                  matrix.add(indices, cell_matrix, /* elide zeros */ true);
                }
      matrix.compress(VectorOperation::add);
      return BodyMatrix(std::move(matrix));
    }
  } // namespace



  template <int dim>
  BulkOnSprings<dim>::BulkOnSprings(
    const Body<dim>                         &body,
    std::unique_ptr<BulkOperator>            body_bulk,
    const std::vector<BoundarySprings<dim>> &springs,
    const std::vector<double>               &damping_of_parts)
    : bulk(std::move(body_bulk))
    , part_of_unknown(body.parts_of_unknowns(damping_of_parts.size()))
    , communicator(body.communicator)
    , work(body.make_vector())
    , product(body.make_vector())
  {
    stiffness = assemble(body, springs, &BoundarySprings<dim>::stiffness);
    if (std::any_of(springs.begin(), springs.end(), [](const auto &spring) {
          return spring.damping > 0.;
        }))
      damping.push_back(
        assemble(body, springs, &BoundarySprings<dim>::damping));
    if (std::any_of(damping_of_parts.begin(),
                    damping_of_parts.end(),
                    [](const double of_part) { return of_part > 0.; }))
      damping.push_back(assemble_mass_matrix(body, damping_of_parts));
    scale = stiffness.linfty_norm();
  }



  template <int dim>
  void
  BulkOnSprings<dim>::force(const Vector &solution, Vector &force) const
  {
    bulk->force(solution, force);
    stiffness.vmult(product, solution);
    force += product;
  }



  template <int dim>
  void
  BulkOnSprings<dim>::add_tangent(const double  factor,
                                  const Vector &solution,
                                  Matrix       &tangent) const
  {
    bulk->add_tangent(factor, solution, tangent);
    stiffness.add_to(factor, tangent);
  }



  template <int dim>
  void
  BulkOnSprings<dim>::step_force(const Vector &old_solution,
                                 const Vector &new_solution,
                                 const double  time_step,
                                 Vector       &force) const
  {
    bulk->step_force(old_solution, new_solution, time_step, force);
    work = old_solution;
    work.sadd(.5, .5, new_solution);
    stiffness.vmult(product, work);
    force += product;
    add_damping(1. / time_step, old_solution, new_solution, &force);
  }



  template <int dim>
  double
  BulkOnSprings<dim>::add_damping(const double  factor,
                                  const Vector &begin,
                                  const Vector &end,
                                  Vector       *force) const
  {
    if (damping.empty())
      return 0.;
    work = end;
    work -= begin;
    double sum = 0.;
    for (const BodyMatrix &matrix : damping)
      {
        matrix.vmult(product, work);
        sum += product * work;
        if (force)
          force->add(factor, product);
      }
    return sum;
  }



  template <int dim>
  void
  BulkOnSprings<dim>::add_step_tangent(const Vector &old_solution,
                                       const Vector &new_solution,
                                       const double  time_step,
                                       Matrix       &tangent) const
  {
    bulk->add_step_tangent(old_solution, new_solution, time_step, tangent);
    stiffness.add_to(.5, tangent);
    for (const BodyMatrix &matrix : damping)
      matrix.add_to(1. / time_step, tangent);
  }



  template <int dim>
  void
  BulkOnSprings<dim>::viscous_force(const Vector &rate_origin,
                                    const Vector &solution,
                                    const double  rate_time,
                                    Vector       &result) const
  {
    if (bulk->is_viscous())
      bulk->viscous_force(rate_origin, solution, rate_time, result);
    else
      result = 0.;
    add_damping(1. / rate_time, rate_origin, solution, &result);
  }



  template <int dim>
  void
  BulkOnSprings<dim>::add_viscous_tangent(const double  factor,
                                          const Vector &rate_origin,
                                          const Vector &solution,
                                          const double  rate_time,
                                          Matrix       &tangent) const
  {
    if (bulk->is_viscous())
      bulk->add_viscous_tangent(factor,
                                rate_origin,
                                solution,
                                rate_time,
                                tangent);
    for (const BodyMatrix &matrix : damping)
      matrix.add_to(factor / rate_time, tangent);
  }



  template <int dim>
  MatrixSum
  BulkOnSprings<dim>::viscous_tangent_terms(const double factor,
                                            const double rate_time) const
  {
    MatrixSum terms;
    if (bulk->is_viscous())
      terms = bulk->viscous_tangent_terms(factor, rate_time);
    for (const BodyMatrix &matrix : damping)
      terms.push_back({factor / rate_time, &matrix});
    return terms;
  }



  template <int dim>
  MatrixSum
  BulkOnSprings<dim>::tangent_terms(const double factor) const
  {
    MatrixSum terms = bulk->tangent_terms(factor);
    if (!terms.empty())
      terms.push_back({factor, &stiffness});
    return terms;
  }



  template <int dim>
  MatrixSum
  BulkOnSprings<dim>::step_tangent_terms(const double time_step) const
  {
    MatrixSum terms = bulk->step_tangent_terms(time_step);
    if (terms.empty())
      return terms;
    terms.push_back({.5, &stiffness});
    for (const BodyMatrix &matrix : damping)
      terms.push_back({1. / time_step, &matrix});
    return terms;
  }



  template <int dim>
  double
  BulkOnSprings<dim>::energy(const Vector &solution) const
  {
    stiffness.vmult(product, solution);
    return bulk->energy(solution) + .5 * (product * solution);
  }



  template <int dim>
  std::vector<double>
  BulkOnSprings<dim>::energies_of_parts(const Vector &solution) const
  {
    std::vector<double> energies = bulk->energies_of_parts(solution);
    std::vector<double> own(energies.size(), 0.);
    stiffness.vmult(product, solution);
    for (unsigned int i = 0; i < part_of_unknown.size(); ++i)
      if (part_of_unknown[i] < own.size())
        own[part_of_unknown[i]] +=
          .5 * local_values(product)[i] * local_values(solution)[i];
    for (unsigned int p = 0; p < own.size(); ++p)
      energies[p] += Utilities::MPI::sum(own[p], communicator);
    return energies;
  }



  template <int dim>
  double
  BulkOnSprings<dim>::viscous_dissipation(const Vector &old_solution,
                                          const Vector &new_solution,
                                          const double  time_step) const
  {
    return bulk->viscous_dissipation(old_solution, new_solution, time_step) +
      add_damping(0., old_solution, new_solution, nullptr) / time_step;
  }


  template class BulkOnSprings<1>;
  template class BulkOnSprings<2>;
  template class BulkOnSprings<3>;
} // namespace Ricochet
