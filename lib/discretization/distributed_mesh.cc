// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/files.h>
#include <discretization/distributed_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/distributed/fully_distributed_tria.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria_description.h>
#include <deal.II/lac/sparsity_tools.h>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  std::unique_ptr<Triangulation<dim>>
  distribute_mesh(const std::function<void(Triangulation<dim> &)> &make_mesh,
                  const MPI_Comm                                   communicator)
  {
    const unsigned int n_ranks = Utilities::MPI::n_mpi_processes(communicator);

    // Made here, and not by deal.II when it asks for it, so that all ranks learn
    // of an error.
    Triangulation<dim> whole;
    on_first_rank(communicator, [&]() { make_mesh(whole); });

    const auto description = TriangulationDescription::Utilities::
      create_description_from_triangulation_in_groups<dim, dim>(
        [&](Triangulation<dim> &mesh) { mesh.copy_triangulation(whole); },
        [&](Triangulation<dim> &mesh, const MPI_Comm, const unsigned int) {
          GridTools::partition_triangulation(n_ranks,
                                             mesh,
                                             SparsityTools::Partitioner::metis);
        },
        communicator,
        n_ranks);
    auto mesh =
      std::make_unique<parallel::fullydistributed::Triangulation<dim>>(
        communicator);
    mesh->create_triangulation(description);
    return mesh;
  }


  template std::unique_ptr<Triangulation<2>>
  distribute_mesh(const std::function<void(Triangulation<2> &)> &,
                  const MPI_Comm);
  template std::unique_ptr<Triangulation<3>>
  distribute_mesh(const std::function<void(Triangulation<3> &)> &,
                  const MPI_Comm);
} // namespace Ricochet
