// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/boundary_load.h>

#include <deal.II/fe/fe_values.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A quadrature point: its position, and the forces (N) of a traction of 1
    /// Pa on the unknowns of each component.
    template <int dim>
    struct LoadPoint
    {
      struct Entry
      {
        types::global_dof_index unknown;
        unsigned int            component;
        double                  area;
      };

      Point<dim>         place;
      std::vector<Entry> entries;
    };
  } // namespace



  template <int dim>
  std::function<void(const double, Vector &)>
  boundary_load(
    const Body<dim>         &body,
    const types::boundary_id id,
    const std::function<Tensor<1, dim>(const double, const Point<dim> &)>
      &traction)
  {
    const FiniteElement<dim>            &element = body.dof_handler().get_fe();
    FEFaceValues<dim>                    face_values(body.mapping(),
                                  element,
                                  body.face_quadrature(),
                                  update_values | update_JxW_values |
                                    update_quadrature_points);
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    std::vector<LoadPoint<dim>>          points;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == id)
            {
              face_values.reinit(cell, f);
              cell->get_dof_indices(indices);
              for (const unsigned int q :
                   face_values.quadrature_point_indices())
                {
                  LoadPoint<dim> point;
                  point.place = face_values.quadrature_point(q);
                  for (const unsigned int i : face_values.dof_indices())
                    if (face_values.shape_value(i, q) != 0.)
                      point.entries.push_back(
                        {body.system_index(indices[i]),
                         element.system_to_component_index(i).first,
                         face_values.shape_value(i, q) * face_values.JxW(q)});
                  points.push_back(point);
                }
            }
    return [points, traction](const double time, Vector &load) {
      for (const LoadPoint<dim> &point : points)
        {
          const Tensor<1, dim> value = traction(time, point.place);
          for (const auto &entry : point.entries)
            load(entry.unknown) += entry.area * value[entry.component];
        }
      load.compress(VectorOperation::add);
    };
  }


  template std::function<void(const double, Vector &)>
  boundary_load(
    const Body<1> &,
    const types::boundary_id,
    const std::function<Tensor<1, 1>(const double, const Point<1> &)> &);
  template std::function<void(const double, Vector &)>
  boundary_load(
    const Body<2> &,
    const types::boundary_id,
    const std::function<Tensor<1, 2>(const double, const Point<2> &)> &);
  template std::function<void(const double, Vector &)>
  boundary_load(
    const Body<3> &,
    const types::boundary_id,
    const std::function<Tensor<1, 3>(const double, const Point<3> &)> &);
} // namespace Ricochet
