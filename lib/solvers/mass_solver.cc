// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/mass_solver.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/solver_cg.h>

#include <string>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    const std::string singular =
      "Accelerations cannot be solved for: the mass matrix is singular. Does the body "
      "have inertia?";
  } // namespace



  MassSolver::MassSolver(const BodyMatrix &mass, const std::vector<Index> &own)
    : mass(mass)
    , own(own)
    , inverse_diagonal(mass.locally_owned_range_indices(),
                       mass.get_mpi_communicator())
  {
    mass.add_diagonal(1., inverse_diagonal);
    for (const auto i : own)
      inverse_diagonal(i) = 1.;
    bool has_mass = true;
    for (const auto i : inverse_diagonal.locally_owned_elements())
      {
        const double own_mass = inverse_diagonal(i);
        if (own_mass > 0.)
          inverse_diagonal(i) = 1. / own_mass;
        else
          has_mass = false;
      }
    inverse_diagonal.compress(VectorOperation::insert);
    if (Utilities::MPI::min(has_mass ? 1 : 0, mass.get_mpi_communicator()) == 0)
      throw NewtonFailure(singular);
  }



  void
  MassSolver::vmult(Vector &force, const Vector &acceleration) const
  {
    mass.vmult(force, acceleration);
    for (const auto i : own)
      force(i) = acceleration(i);
    force.compress(VectorOperation::insert);
  }



  void
  MassSolver::solve(const Vector &force, Vector &acceleration) const
  {
    DiagonalMatrix<Vector> preconditioner(inverse_diagonal);
    ReductionControl       control(500, 0., 1e-15);
    acceleration = 0.;
    try
      {
        SolverCG<Vector>(control).solve(*this,
                                        acceleration,
                                        force,
                                        preconditioner);
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw NewtonFailure(singular);
      }
  }
} // namespace Ricochet
