// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/factorisation.h>
#include <solvers/matrix_entries.h>

#include <Amesos.h>
#include <Epetra_LinearProblem.h>

namespace Ricochet
{
  using namespace dealii;

  struct Factorisation::Amesos
  {
    Epetra_LinearProblem               problem;
    std::unique_ptr<Amesos_BaseSolver> solver;
  };



  Factorisation::Factorisation(const std::string &package)
    : package(package)
  {}



  Factorisation::~Factorisation() = default;



  bool
  Factorisation::factorise(const Matrix &matrix, const bool keep_pivots)
  {
    int error = 0;
    // The packages keep pointers to the values.
    Assert(!amesos || values == MatrixEntries(matrix).value,
           ExcMessage("Another matrix needs a factorisation of its own."));
    if (!amesos)
      {
        values = MatrixEntries(matrix).value;
        amesos = std::make_unique<Amesos>();
        amesos->problem.SetOperator(
          const_cast<Epetra_CrsMatrix *>(&matrix.trilinos_matrix()));
        const std::string name =
          package == "KLU" ? "Amesos_Klu" : "Amesos_Mumps";
        amesos->solver.reset(::Amesos().Create(name, amesos->problem));
        AssertThrow(amesos->solver,
                    ExcMessage("Trilinos was built without " + name));
        error = amesos->solver->SymbolicFactorization();
      }
    else if (package == "MUMPS" && !keep_pivots)
      // MUMPS already uses the values when it orders the unknowns.
      error = amesos->solver->SymbolicFactorization();
    // KLU checks its pivots and chooses others when they have become poor.
    Teuchos::ParameterList list;
    list.set("Refactorize", keep_pivots);
    amesos->solver->SetParameters(list);
    if (error == 0)
      error = amesos->solver->NumericFactorization();
    if (error != 0)
      amesos.reset();
    return error == 0;
  }



  void
  Factorisation::solve(const Vector &right_hand_side, Vector &solution)
  {
    amesos->problem.SetLHS(&solution.trilinos_vector());
    amesos->problem.SetRHS(
      const_cast<Epetra_MultiVector *>(static_cast<const Epetra_MultiVector *>(
        &right_hand_side.trilinos_vector())));
    if (amesos->solver->Solve() != 0)
      throw NewtonFailure("The linear system cannot be solved.");
  }
} // namespace Ricochet
