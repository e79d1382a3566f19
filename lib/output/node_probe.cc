// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/nearest_vertex.h>
#include <output/node_probe.h>

#include <deal.II/base/mpi.h>

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
    , indices(unknowns_of_nearest_vertex(body, point, n_parts, begin, end))
  {}



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
