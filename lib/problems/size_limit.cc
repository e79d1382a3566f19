// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/one_rank.h>
#include <base/parameter_file.h>
#include <problems/size_limit.h>

#include <deal.II/base/mpi.h>

#include <unistd.h>

#include <array>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    constexpr double bytes_per_gb = 1e9;

    // Memory for each unknown: mesh, matrices and their solvers, as measured
    // with the most economical choices. In 3D that is multigrid.
    constexpr std::array<double, 4> bytes_per_unknown = {{0., 1e3, 2e3, 3.5e3}};
    // A row of the energy table has some thirty numbers.
    constexpr double bytes_per_step = 30 * sizeof(double);

    /// Memory of all machines that the ranks run on (bytes).
    double
    memory_of_machines()
    {
      MPI_Comm machine;
      MPI_Comm_split_type(OneRank::communicator(),
                          MPI_COMM_TYPE_SHARED,
                          0,
                          MPI_INFO_NULL,
                          &machine);
      const bool first = dealii::Utilities::MPI::this_mpi_process(machine) == 0;
      MPI_Comm_free(&machine);
      const double mine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) *
        static_cast<double>(sysconf(_SC_PAGE_SIZE));
      return dealii::Utilities::MPI::sum(first ? mine : 0.,
                                         OneRank::communicator());
    }
  } // namespace



  void
  SizeLimit::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Limits");
    parameters.add_parameter("Memory",
                             memory,
                             "Memory that the run may take on all ranks "
                             "together (GB); 0 for four fifths of what the "
                             "machines have.",
                             Patterns::Double(0.));
    parameters.leave_subsection();
  }



  void
  SizeLimit::check(const double       n_unknowns,
                   const unsigned int dim,
                   const double       n_steps,
                   const double       more) const
  {
    const double needed =
      n_unknowns * bytes_per_unknown.at(dim) + n_steps * bytes_per_step + more;
    const double allowed =
      memory > 0. ? memory * bytes_per_gb : .8 * memory_of_machines();
    // Unknowns are counted by 32 bits.
    constexpr double most_unknowns = 2147483647.;
    if (needed <= allowed && n_unknowns <= most_unknowns)
      return;
    throw InputError("This run has " + to_text(n_unknowns) + " unknowns and " +
                     to_text(n_steps) + " steps; it would take at least " +
                     to_text(needed / bytes_per_gb) + " GB of memory, and " +
                     to_text(allowed / bytes_per_gb) +
                     " GB are allowed (Limits/Memory).");
  }
} // namespace Ricochet
