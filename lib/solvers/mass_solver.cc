// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/mass_solver.h>

#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/solver_cg.h>

namespace Ricochet
{
  using namespace dealii;

  MassSolver::MassSolver(const BodyMatrix &mass, const std::vector<Index> &own)
    : mass(mass)
    , own(own)
    , inverse_diagonal(mass.locally_owned_range_indices(),
                       mass.get_mpi_communicator())
  {
    mass.add_diagonal(1., inverse_diagonal);
    for (const auto i : own)
      inverse_diagonal(i) = 1.;
    for (const auto i : inverse_diagonal.locally_owned_elements())
      inverse_diagonal(i) = 1. / inverse_diagonal(i);
    inverse_diagonal.compress(VectorOperation::insert);
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
        throw NewtonFailure(
          "Accelerations cannot be solved for: the mass matrix "
          "is singular. Does the body have inertia?");
      }
  }
} // namespace Ricochet
