// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <discretization/boundary_springs.h>
#include <discretization/linear_bulk.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The boundary's mass matrix, weighted with the @p density of each of the
    /// @p springs (Pa/m, or Pa s/m).
    template <int dim>
    Matrix
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
      return matrix;
    }
  } // namespace



  template <int dim>
  SpringsAndDashpots<dim>::SpringsAndDashpots(
    const Body<dim>                         &body,
    const std::vector<BoundarySprings<dim>> &springs,
    const std::vector<double>               &damping_of_parts)
    : part_of_unknown(body.parts_of_unknowns(damping_of_parts.size()))
    , n_parts(damping_of_parts.size())
    , communicator(body.communicator)
    , stiffness(assemble(body, springs, &BoundarySprings<dim>::stiffness))
    , work(body.make_vector())
    , product(body.make_vector())
  {
    Matrix dashpots = assemble(body, springs, &BoundarySprings<dim>::damping);
    assemble_mass_matrix(body, damping_of_parts).add_to(1., dashpots);
    damping     = BodyMatrix(std::move(dashpots));
    has_damping = damping.linfty_norm() > 0.;
    scale       = stiffness.linfty_norm();
  }



  template <int dim>
  void
  SpringsAndDashpots<dim>::force(const Vector &solution, Vector &force) const
  {
    stiffness.vmult(force, solution);
  }



  template <int dim>
  void
  SpringsAndDashpots<dim>::step_force(const Vector &old_solution,
                                      const Vector &new_solution,
                                      const double  time_step,
                                      Vector       &force) const
  {
    work = old_solution;
    work.sadd(.5, .5, new_solution);
    stiffness.vmult(force, work);
    if (!has_damping)
      return;
    apply_damping(old_solution, new_solution);
    force.add(1. / time_step, product);
  }



  template <int dim>
  void
  SpringsAndDashpots<dim>::apply_damping(const Vector &begin,
                                         const Vector &end) const
  {
    work = end;
    work -= begin;
    damping.vmult(product, work);
  }



  template <int dim>
  void
  SpringsAndDashpots<dim>::viscous_force(const Vector &rate_origin,
                                         const Vector &solution,
                                         const double  rate_time,
                                         Vector       &result) const
  {
    apply_damping(rate_origin, solution);
    result.equ(1. / rate_time, product);
  }



  template <int dim>
  MatrixSum
  SpringsAndDashpots<dim>::viscous_tangent_terms(const double factor,
                                                 const double rate_time) const
  {
    return {{factor / rate_time, &damping}};
  }



  template <int dim>
  MatrixSum
  SpringsAndDashpots<dim>::tangent_terms(const double factor) const
  {
    return {{factor, &stiffness}};
  }



  template <int dim>
  MatrixSum
  SpringsAndDashpots<dim>::step_tangent_terms(const double time_step) const
  {
    MatrixSum terms{{.5, &stiffness}};
    if (has_damping)
      terms.push_back({1. / time_step, &damping});
    return terms;
  }



  template <int dim>
  double
  SpringsAndDashpots<dim>::energy(const Vector &solution) const
  {
    stiffness.vmult(product, solution);
    return .5 * (product * solution);
  }



  template <int dim>
  std::vector<double>
  SpringsAndDashpots<dim>::energies_of_parts(const Vector &solution) const
  {
    std::vector<double> energies(n_parts, 0.);
    stiffness.vmult(product, solution);
    for (unsigned int i = 0; i < part_of_unknown.size(); ++i)
      if (part_of_unknown[i] < n_parts)
        energies[part_of_unknown[i]] +=
          .5 * local_values(product)[i] * local_values(solution)[i];
    Utilities::MPI::sum(energies, communicator, energies);
    return energies;
  }



  template <int dim>
  double
  SpringsAndDashpots<dim>::viscous_dissipation(const Vector &old_solution,
                                               const Vector &new_solution,
                                               const double  time_step) const
  {
    if (!has_damping)
      return 0.;
    apply_damping(old_solution, new_solution);
    return (product * work) / time_step;
  }


  template class SpringsAndDashpots<1>;
  template class SpringsAndDashpots<2>;
  template class SpringsAndDashpots<3>;
} // namespace Ricochet
