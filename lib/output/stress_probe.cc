// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/stress_probe.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  StressProbe<dim>::StressProbe(const Body<dim>                  &body,
                                const std::vector<Material<dim>> &materials,
                                const unsigned int                begin,
                                const unsigned int                end,
                                const Point<dim>                 *point)
    : body(body)
    , materials(materials)
    , found(true)
  {
    Quadrature<dim> rule = body.cell_quadrature();
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        const unsigned int part =
          cell->is_artificial() ? end : body.part(cell, materials.size());
        if (!cell->is_locally_owned() || part < begin || part >= end)
          continue;
        if (!point)
          cells.push_back(cell);
        else if (cells.empty() && cell->bounding_box().point_inside(*point))
          try
            {
              const Point<dim> unit =
                body.mapping().transform_real_to_unit_cell(cell, *point);
              if (cell->reference_cell().contains_point(unit, 1e-8))
                {
                  cells.push_back(cell);
                  rule = Quadrature<dim>(unit);
                }
            }
          catch (const typename Mapping<dim>::ExcTransformationFailed &)
            {}
      }
    if (point)
      {
        // A point between ranks belongs to the lowest one.
        const unsigned int rank =
          Utilities::MPI::this_mpi_process(body.communicator);
        const unsigned int nobody = std::numeric_limits<unsigned int>::max();
        const unsigned int owner =
          Utilities::MPI::min(cells.empty() ? nobody : rank, body.communicator);
        found = owner != nobody;
        if (owner != rank)
          cells.clear();
      }
    values =
      std::make_unique<FEValues<dim>>(body.mapping(),
                                      body.dof_handler().get_fe(),
                                      rule,
                                      update_gradients | update_JxW_values);
  }



  template <int dim>
  SymmetricTensor<2, dim>
  StressProbe<dim>::stress(const Vector &solution) const
  {
    const Vector displacement = body.displacement_part(solution);
    const FEValuesExtractors::Vector extractor(0);
    std::vector<Tensor<2, dim>>      gradients(values->n_quadrature_points);
    SymmetricTensor<2, dim>          sum;
    double                           volume = 0.;
    for (const auto &cell : cells)
      {
        values->reinit(cell);
        (*values)[extractor].get_function_gradients(displacement, gradients);
        const Material<dim> &material =
          materials[body.part(cell, materials.size())];
        for (const unsigned int q : values->quadrature_point_indices())
          {
            sum += values->JxW(q) * material.cauchy_stress(gradients[q]);
            volume += values->JxW(q);
          }
      }
    return Utilities::MPI::sum(sum, body.communicator) /
      Utilities::MPI::sum(volume, body.communicator);
  }


  template class StressProbe<2>;
  template class StressProbe<3>;
} // namespace Ricochet
