// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/boundary_load.h>

#include <deal.II/fe/fe_values.h>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  Vector
  boundary_load(const Body<dim>         &body,
                const types::boundary_id id,
                const unsigned int       component)
  {
    const FiniteElement<dim>            &element = body.dof_handler().get_fe();
    FEFaceValues<dim>                    face_values(body.mapping(),
                                  element,
                                  body.face_quadrature(),
                                  update_values | update_JxW_values);
    std::vector<types::global_dof_index> indices(element.n_dofs_per_cell());
    Vector                               load = body.make_vector();
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        for (const unsigned int f : cell->face_indices())
          if (cell->face(f)->at_boundary() &&
              cell->face(f)->boundary_id() == id)
            {
              face_values.reinit(cell, f);
              cell->get_dof_indices(indices);
              for (const unsigned int i : face_values.dof_indices())
                if (element.system_to_component_index(i).first == component)
                  for (const unsigned int q :
                       face_values.quadrature_point_indices())
                    load(body.system_index(indices[i])) +=
                      face_values.shape_value(i, q) * face_values.JxW(q);
            }
    load.compress(VectorOperation::add);
    return load;
  }


  template Vector
  boundary_load(const Body<1> &, const types::boundary_id, const unsigned int);
  template Vector
  boundary_load(const Body<2> &, const types::boundary_id, const unsigned int);
  template Vector
  boundary_load(const Body<3> &, const types::boundary_id, const unsigned int);
} // namespace Ricochet
