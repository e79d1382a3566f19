// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/field_extremes.h>

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe_values.h>

#include <boost/serialization/utility.hpp>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// A field of the displacements' kind.
    template <int dim>
    struct NodalField
    {
      const char *name, *unit;
      Vector      values;
    };
  } // namespace



  template <int dim>
  FieldExtremes<dim>::FieldExtremes(const Body<dim>                  &body,
                                    const std::vector<Material<dim>> &materials)
    : body(body)
    , materials(materials)
  {}



  template <int dim>
  void
  FieldExtremes<dim>::update(const State &state)
  {
    const std::vector<NodalField<dim>> fields = {
      {"displacement", "m", body.displacement_part(state.solution)},
      {"velocity", "m/s", body.displacement_part(state.velocity)},
      {"acceleration", "m/s^2", body.displacement_part(state.acceleration)}};
    std::vector<FieldExtreme> now;
    for (const NodalField<dim> &field : fields)
      now.push_back({field.name, field.unit});
    if (dim > 1)
      now.push_back({"von_mises", "Pa"});

    const FiniteElement<dim> &element = body.dof_handler().get_fe();
    const Quadrature<dim>     nodes(
      element.base_element(0).get_unit_support_points());
    FEValues<dim>                    values(body.mapping(),
                         element,
                         nodes,
                         update_values | update_gradients |
                           update_quadrature_points);
    const FEValuesExtractors::Vector vector(0);
    std::vector<Tensor<1, dim>>      of_cell(nodes.size());
    std::vector<Tensor<2, dim>>      gradients(nodes.size());
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (!cell->is_locally_owned())
          continue;
        values.reinit(cell);
        const auto enter =
          [&](const unsigned int k, const unsigned int q, const double value) {
            if (value <= now[k].value)
              return;
            const Point<dim> &place = values.quadrature_point(q);
            now[k].value            = value;
            now[k].time             = state.time;
            now[k].place.assign(place.begin_raw(), place.end_raw());
          };
        for (unsigned int k = 0; k < fields.size(); ++k)
          {
            values[vector].get_function_values(fields[k].values, of_cell);
            for (unsigned int q = 0; q < nodes.size(); ++q)
              enter(k, q, of_cell[q].norm());
          }
        if constexpr (dim > 1)
          {
            const Material<dim> &material =
              materials[materials.size() == 1 ? 0 : cell->material_id()];
            values[vector].get_function_gradients(fields[0].values, gradients);
            for (unsigned int q = 0; q < nodes.size(); ++q)
              enter(fields.size(), q, material.von_mises(gradients[q]));
          }
      }
    if (extremes.empty())
      for (const FieldExtreme &one : now)
        extremes.push_back({one.name, one.unit});
    for (unsigned int k = 0; k < now.size(); ++k)
      for (const auto &[value, place] :
           Utilities::MPI::all_gather(body.communicator,
                                      std::make_pair(now[k].value,
                                                     now[k].place)))
        if (value > extremes[k].value)
          {
            extremes[k].value = value;
            extremes[k].time  = state.time;
            extremes[k].place = place;
          }
  }


  template class FieldExtremes<1>;
  template class FieldExtremes<2>;
  template class FieldExtremes<3>;
} // namespace Ricochet
