// SPDX-License-Identifier: LGPL-2.1-or-later
#include <output/node_probe.h>

#include <deal.II/base/mpi.h>

#include <limits>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  NodeProbe<dim>::NodeProbe(const Body<dim>   &body,
                            const Point<dim>  &point,
                            const unsigned int n_parts,
                            const unsigned int begin,
                            const unsigned int end)
    : communicator(body.communicator)
  {
    double nearest = std::numeric_limits<double>::max();
    std::vector<types::global_dof_index> candidate(dim);
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        if (cell->is_artificial() || body.part(cell, n_parts) < begin ||
            body.part(cell, n_parts) >= end)
          continue;
        for (const unsigned int v : cell->vertex_indices())
          {
            const double distance = cell->vertex(v).distance(point);
            if (distance >= nearest)
              continue;
            nearest = distance;
            for (unsigned int c = 0; c < dim; ++c)
              candidate[c] = body.system_index(
                cell->vertex_dof_index(v, c, cell->active_fe_index()));
          }
      }
    // The node belongs to the lowest rank that sees the nearest vertex and owns
    // its unknowns.
    const double global_nearest = Utilities::MPI::min(nearest, communicator);
    const bool   mine           = nearest == global_nearest &&
      body.owned_indices().is_element(candidate[0]);
    const unsigned int rank = Utilities::MPI::this_mpi_process(communicator);
    const unsigned int owner =
      Utilities::MPI::min(mine ? rank
                               : std::numeric_limits<unsigned int>::max(),
                          communicator);
    AssertThrow(owner != std::numeric_limits<unsigned int>::max(),
                ExcMessage("No rank owns the node of a probe."));
    if (owner == rank)
      indices = candidate;
  }



  template <int dim>
  double
  NodeProbe<dim>::value(const Vector      &vector,
                        const unsigned int component) const
  {
    return Utilities::MPI::sum(
      indices.empty() ? 0. : static_cast<double>(vector(indices[component])),
      communicator);
  }


  template class NodeProbe<1>;
  template class NodeProbe<2>;
  template class NodeProbe<3>;
} // namespace Ricochet
