// SPDX-License-Identifier: LGPL-2.1-or-later

// The start of every program with deal.II: load deal.II and the libraries
// behind it, and start MPI. See start_up.py.

#include <deal.II/base/mpi.h>

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
}
