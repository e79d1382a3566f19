// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/follower_pressure.h>

#include <deal.II/fe/fe_values.h>
#include <deal.II/lac/full_matrix.h>

#include <map>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// det(F) F^{-T}, as a polynomial.
    Tensor<2, 2>
    cofactors(const Tensor<2, 2> &f)
    {
      return Tensor<2, 2>({{f[1][1], -f[1][0]}, {-f[0][1], f[0][0]}});
    }

    Tensor<2, 3>
    cofactors(const Tensor<2, 3> &f)
    {
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 3; ++i)
        result[i] = cross_product_3d(f[(i + 1) % 3], f[(i + 2) % 3]);
      return result;
    }

    /// The mean of the cofactors along the segment from @p f0 to @p f1.
    Tensor<2, 2>
    mean_cofactors(const Tensor<2, 2> &f0, const Tensor<2, 2> &f1)
    {
      return cofactors(.5 * (f0 + f1));
    }

    Tensor<2, 3>
    mean_cofactors(const Tensor<2, 3> &f0, const Tensor<2, 3> &f1)
    {
      return (cofactors(f0) + 4. * cofactors(.5 * (f0 + f1)) + cofactors(f1)) /
        6.;
    }

    /// Derivative of the mean with respect to @p f1 in the direction @p g.
    Tensor<2, 2>
    mean_cofactors_derivative(const Tensor<2, 2> &,
                              const Tensor<2, 2> &,
                              const Tensor<2, 2> &g)
    {
      return .5 * cofactors(g);
    }

    Tensor<2, 3>
    mean_cofactors_derivative(const Tensor<2, 3> &f0,
                              const Tensor<2, 3> &f1,
                              const Tensor<2, 3> &g)
    {
      // Cofactors are a quadratic form; this is its bilinear one, twice.
      const auto both = [](const Tensor<2, 3> &a, const Tensor<2, 3> &b) {
        return cofactors(a + b) - cofactors(a) - cofactors(b);
      };
      return (2. * both(.5 * (f0 + f1), g) + both(f1, g)) / 6.;
    }
  } // namespace



  template <int dim>
  FollowerPressure<dim>::FollowerPressure(
    const Body<dim>                          &body,
    const std::vector<BoundaryPressure<dim>> &pressures)
    : body(body)
    , pressures(pressures)
    , ghosted_old(body.make_ghosted_vector())
    , ghosted_new(body.make_ghosted_vector())
  {
    const FiniteElement<dim>            &element = body.dof_handler().get_fe();
    FEFaceValues<dim>                    values(body.mapping(),
                             element,
                             body.face_quadrature(),
                             update_values | update_gradients |
                               update_normal_vectors | update_JxW_values |
                               update_quadrature_points);
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    const unsigned int n_nodes = element.n_dofs_per_cell() / dim;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          for (unsigned int k = 0; k < pressures.size(); ++k)
            if (cell->face(f)->at_boundary() &&
                cell->face(f)->boundary_id() == pressures[k].boundary_id)
              {
                values.reinit(cell, f);
                cell->get_dof_indices(indices);
                for (const unsigned int q : values.quadrature_point_indices())
                  {
                    QuadraturePoint point{k,
                                          values.quadrature_point(q),
                                          values.JxW(q) *
                                            values.normal_vector(q),
                                          {}};
                    for (unsigned int n = 0; n < n_nodes; ++n)
                      {
                        Node node;
                        for (unsigned int c = 0; c < dim; ++c)
                          node.unknowns[c] = body.system_index(
                            indices[element.component_to_system_index(c, n)]);
                        const unsigned int i =
                          element.component_to_system_index(0, n);
                        node.value    = values.shape_value(i, q);
                        node.gradient = values.shape_grad(i, q);
                        point.nodes.push_back(node);
                      }
                    points.push_back(point);
                  }
              }
  }



  template <int dim>
  Tensor<2, dim>
  FollowerPressure<dim>::deformation_gradient(
    const QuadraturePoint &point,
    const GhostedVector   &ghosted) const
  {
    Tensor<2, dim> result = unit_symmetric_tensor<dim>();
    for (const Node &node : point.nodes)
      for (unsigned int c = 0; c < dim; ++c)
        result[c] += ghosted(node.unknowns[c]) * node.gradient;
    return result;
  }



  template <int dim>
  void
  FollowerPressure<dim>::step_force(const Vector &old_solution,
                                    const Vector &new_solution,
                                    const double  begin,
                                    const double  end,
                                    Vector       &force) const
  {
    ghosted_old.import(old_solution);
    ghosted_new.import(new_solution);
    force = 0.;
    for (const QuadraturePoint &point : points)
      {
        const Tensor<1, dim> traction =
          -pressures[point.pressure].pressure(.5 * (begin + end), point.place) *
          (mean_cofactors(deformation_gradient(point, ghosted_old),
                          deformation_gradient(point, ghosted_new)) *
           point.area);
        for (const Node &node : point.nodes)
          if (node.value != 0.)
            for (unsigned int c = 0; c < dim; ++c)
              force(node.unknowns[c]) += node.value * traction[c];
      }
    force.compress(VectorOperation::add);
  }



  template <int dim>
  void
  FollowerPressure<dim>::subtract_step_tangent(const double  weight,
                                               const Vector &old_solution,
                                               const Vector &new_solution,
                                               const double  begin,
                                               const double  end,
                                               Matrix       &tangent) const
  {
    ghosted_old.import(old_solution);
    ghosted_new.import(new_solution);
    for (const QuadraturePoint &point : points)
      {
        const double pressure = weight *
          pressures[point.pressure].pressure(.5 * (begin + end), point.place);
        const Tensor<2, dim> f0 = deformation_gradient(point, ghosted_old),
                             f1 = deformation_gradient(point, ghosted_new);
        for (const Node &column : point.nodes)
          for (unsigned int d = 0; d < dim; ++d)
            {
              Tensor<2, dim> direction;
              direction[d]                = column.gradient;
              const Tensor<1, dim> change = pressure *
                (mean_cofactors_derivative(f0, f1, direction) * point.area);
              for (const Node &row : point.nodes)
                if (row.value != 0.)
                  for (unsigned int c = 0; c < dim; ++c)
                    tangent.add(row.unknowns[c],
                                column.unknowns[d],
                                row.value * change[c]);
            }
      }
    tangent.compress(VectorOperation::add);
  }


  template class FollowerPressure<2>;
  template class FollowerPressure<3>;
} // namespace Ricochet
