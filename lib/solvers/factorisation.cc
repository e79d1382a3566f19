// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/factorisation.h>

#include <Amesos.h>
#include <Epetra_CrsMatrix.h>
#include <Epetra_LinearProblem.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Where the entries of a matrix lie, to which the packages keep pointers.
    const double *
    entries_of(const Epetra_CrsMatrix &matrix)
    {
      int    *row_start = nullptr, *columns = nullptr;
      double *values = nullptr;
      matrix.ExtractCrsDataPointers(row_start, columns, values);
      return values;
    }
  } // namespace



  Factorisation::Factorisation(const std::string &package)
    : package(package)
  {}



  Factorisation::~Factorisation() = default;



  bool
  Factorisation::factorise(const Matrix &matrix, const bool keep_pivots)
  {
    const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
    int                     error  = 0;
    Assert(!solver || entries == entries_of(epetra),
           ExcMessage("Another matrix needs a factorisation of its own."));
    if (!solver)
      {
        entries = entries_of(epetra);
        problem = std::make_unique<Epetra_LinearProblem>();
        problem->SetOperator(const_cast<Epetra_CrsMatrix *>(&epetra));
        const std::string name =
          package == "KLU" ? "Amesos_Klu" : "Amesos_Mumps";
        solver.reset(Amesos().Create(name, *problem));
        AssertThrow(solver, ExcMessage("Trilinos was built without " + name));
        error = solver->SymbolicFactorization();
      }
    else if (package == "MUMPS" && !keep_pivots)
      // MUMPS looks at the values already when it orders the unknowns.
      error = solver->SymbolicFactorization();
    // KLU looks at its pivots and chooses others when they are no longer good.
    Teuchos::ParameterList list;
    list.set("Refactorize", keep_pivots);
    solver->SetParameters(list);
    if (error == 0)
      error = solver->NumericFactorization();
    if (error != 0)
      solver.reset();
    return error == 0;
  }



  void
  Factorisation::solve(const Vector &right_hand_side, Vector &solution)
  {
    problem->SetLHS(&solution.trilinos_vector());
    problem->SetRHS(
      const_cast<Epetra_MultiVector *>(static_cast<const Epetra_MultiVector *>(
        &right_hand_side.trilinos_vector())));
    if (solver->Solve() != 0)
      throw NewtonFailure("The linear system cannot be solved.");
  }
} // namespace Ricochet
