// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_distributed_mesh_h
#define ricochet_discretization_distributed_mesh_h

#include <deal.II/grid/tria.h>

#include <functional>
#include <memory>

namespace Ricochet
{
  /**
   * A mesh in parts, one for each rank: the first rank makes the
   * whole mesh, cuts it so that few unknowns are shared, and hands out the parts.
   *
   * @param make_mesh fills an empty triangulation; only called on the first
   * rank. An InputError that it throws is thrown on all.
   */
  template <int dim>
  std::unique_ptr<dealii::Triangulation<dim>>
  distribute_mesh(
    const std::function<void(dealii::Triangulation<dim> &)> &make_mesh,
    const MPI_Comm                                           communicator);
} // namespace Ricochet

#endif
