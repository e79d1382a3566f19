// SPDX-License-Identifier: LGPL-2.1-or-later

// Unit tests of the library: laws, identities, tangents. Run one suite with
// --run_test=SUITE; ctest runs them all, and the parallel ones also on 2 ranks.

#define BOOST_TEST_NO_MAIN
#define BOOST_TEST_ALTERNATIVE_INIT_API
#include <boost/test/included/unit_test.hpp>

#include <deal.II/base/mpi.h>

int
main(int argc, char **argv)
{
  int                                      mpi_argc = 1;
  dealii::Utilities::MPI::MPI_InitFinalize mpi(mpi_argc, argv, 1);
  return boost::unit_test::unit_test_main([]() { return true; }, argc, argv);
}
