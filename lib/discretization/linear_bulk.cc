// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/linear_bulk.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <functional>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The cell loop of all constant matrices. @p integrand gets the FEValues
    /// and a quadrature point and adds to the cell matrix.
    template <int dim>
    Matrix
    assemble(const Body<dim>                                 &body,
             const UpdateFlags                                flags,
             const std::function<void(const FEValues<dim> &,
                                      const unsigned int,
                                      FullMatrix<double> &)> &integrand)
    {
      Matrix matrix;
      matrix.reinit(body.sparsity_pattern());

      FEValues<dim>                        fe_values(body.mapping(),
                              body.dof_handler().get_fe(),
                              body.cell_quadrature(),
                              flags | update_JxW_values);
      const unsigned int                   n = fe_values.dofs_per_cell;
      FullMatrix<double>                   cell_matrix(n, n);
      std::vector<types::global_dof_index> indices(n);
      for (const auto &cell : body.dof_handler().active_cell_iterators())
        if (cell->is_locally_owned())
          {
            fe_values.reinit(cell);
            cell_matrix = 0.;
            for (const unsigned int q : fe_values.quadrature_point_indices())
              integrand(fe_values, q, cell_matrix);
            cell->get_dof_indices(indices);
            for (types::global_dof_index &index : indices)
              index = body.system_index(index);
            matrix.add(indices, cell_matrix);
          }
      matrix.compress(VectorOperation::add);
      return matrix;
    }
  } // namespace



  template <int dim>
  LinearBulk<dim>::LinearBulk(const Body<dim>     &body,
                              const LinearElastic &material)
    : midpoint(body.make_vector())
  {
    const FEValuesExtractors::Vector     displacement(0);
    std::vector<SymmetricTensor<2, dim>> strains(
      body.dof_handler().get_fe().n_dofs_per_cell());
    stiffness.reinit(body.sparsity_pattern());
    stiffness.copy_from(assemble<dim>(
      body,
      update_gradients,
      [&](const FEValues<dim> &fe_values,
          const unsigned int   q,
          FullMatrix<double>  &cell_matrix) {
        for (const unsigned int i : fe_values.dof_indices())
          strains[i] = fe_values[displacement].symmetric_gradient(i, q);
        for (const unsigned int j : fe_values.dof_indices())
          {
            const SymmetricTensor<2, dim> stress = material.stress(strains[j]);
            for (const unsigned int i : fe_values.dof_indices())
              cell_matrix(i, j) += stress * strains[i] * fe_values.JxW(q);
          }
      }));
  }



  template <int dim>
  void
  LinearBulk<dim>::force(const Vector &solution, Vector &force) const
  {
    stiffness.vmult(force, solution);
  }



  template <int dim>
  void
  LinearBulk<dim>::discrete_derivative(const Vector &old_solution,
                                       const Vector &new_solution,
                                       Vector       &force) const
  {
    midpoint = old_solution;
    midpoint.sadd(.5, .5, new_solution);
    stiffness.vmult(force, midpoint);
  }



  template <int dim>
  void
  LinearBulk<dim>::add_tangent(const double factor,
                               const Vector & /*solution*/,
                               Matrix &tangent) const
  {
    tangent.add(factor, stiffness);
  }



  template <int dim>
  double
  LinearBulk<dim>::energy(const Vector &solution) const
  {
    stiffness.vmult(midpoint, solution);
    return .5 * (midpoint * solution);
  }



  template <int dim>
  Matrix
  assemble_mass_matrix(const Body<dim> &body, const double density)
  {
    const FEValuesExtractors::Vector displacement(0);
    return assemble<dim>(body,
                         update_values,
                         [&](const FEValues<dim> &fe_values,
                             const unsigned int   q,
                             FullMatrix<double>  &cell_matrix) {
                           for (const unsigned int i : fe_values.dof_indices())
                             for (const unsigned int j :
                                  fe_values.dof_indices())
                               cell_matrix(i, j) += density *
                                 (fe_values[displacement].value(i, q) *
                                  fe_values[displacement].value(j, q)) *
                                 fe_values.JxW(q);
                         });
  }


  template class LinearBulk<1>;
  template class LinearBulk<2>;
  template class LinearBulk<3>;
  template Matrix
  assemble_mass_matrix(const Body<1> &, const double);
  template Matrix
  assemble_mass_matrix(const Body<2> &, const double);
  template Matrix
  assemble_mass_matrix(const Body<3> &, const double);
} // namespace Ricochet
