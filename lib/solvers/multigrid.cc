// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/multigrid.h>

#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

namespace Ricochet
{
  using namespace dealii;

  Multigrid::Multigrid(const std::vector<Vector> &rigid_body_modes,
                       const bool                 is_symmetric)
    : is_symmetric(is_symmetric)
    , n_modes(rigid_body_modes.size())
  {
    for (const Vector &mode : rigid_body_modes)
      {
        const double *values = mode.trilinos_vector()[0];
        modes.insert(modes.end(), values, values + mode.locally_owned_size());
      }
  }



  void
  Multigrid::setup(const Matrix &matrix)
  {
    Teuchos::ParameterList list;
    ML_Epetra::SetDefaults("SA", list);
    list.set("ML output", 0);
    // The unknowns of a node stand together: dim translations, and in all
    // dim (dim + 1) / 2 modes.
    list.set("PDE equations", n_modes == 6 ? 3 : n_modes == 3 ? 2 : 1);
    list.set("null space: type", "pre-computed");
    list.set("null space: dimension", static_cast<int>(n_modes));
    list.set("null space: vectors", modes.data());
    // Aggregates that are not smoothed converge as well here, are set up in a
    // quarter of the time and need a fraction of the memory.
    list.set("aggregation: type", "Uncoupled");
    list.set("aggregation: damping factor", 0.);
    list.set("smoother: type", "Chebyshev");
    list.set("smoother: sweeps", 2);
    list.set("coarse: type", "Amesos-KLU");
    list.set("coarse: max size", 1000);
    preconditioner = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    preconditioner->initialize(matrix, list);
  }



  int
  Multigrid::solve(const Matrix &matrix,
                   const Vector &right_hand_side,
                   Vector       &solution,
                   const double  tolerance) const
  {
    solution = 0.;
    SolverControl control(300, tolerance * right_hand_side.l2_norm());
    try
      {
        if (is_symmetric)
          SolverCG<Vector>(control).solve(matrix,
                                          solution,
                                          right_hand_side,
                                          *preconditioner);
        else
          {
            const SolverGMRES<Vector>::AdditionalData data(50, true);
            SolverGMRES<Vector>(control, data)
              .solve(matrix, solution, right_hand_side, *preconditioner);
          }
      }
    catch (const SolverControl::NoConvergence &)
      {
        return -1;
      }
    return control.last_step();
  }
} // namespace Ricochet
