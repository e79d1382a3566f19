// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/direct_solver.h>

#include <Amesos.h>
#include <Epetra_LinearProblem.h>

namespace Ricochet
{
  using namespace dealii;

  DirectSolver::Factorisation::Factorisation()  = default;
  DirectSolver::Factorisation::~Factorisation() = default;

  DirectSolver::DirectSolver(const Parameters &parameters)
    : parameters(parameters)
  {}

  DirectSolver::~DirectSolver() = default;



  void
  DirectSolver::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Linear solver");
    parameters.add_parameter(
      "Type",
      type,
      "The sparse direct solver. KLU is fast for bars and small plane meshes; "
      "in 3D it needs many times longer than MUMPS. 'automatic' takes KLU "
      "below 20000 unknowns.",
      Patterns::Selection("automatic|KLU|MUMPS"));
    parameters.add_parameter(
      "Kept factorisations",
      n_kept,
      "How many factorisations to keep. One is used again when the same "
      "contact points are active with the same time step. More cost memory.",
      Patterns::Integer(1, 1000));
    parameters.leave_subsection();
  }



  std::string
  DirectSolver::chosen_type(const std::size_t n_unknowns) const
  {
    if (parameters.type != "automatic")
      return parameters.type;
    return n_unknowns < 20000 ? "KLU" : "MUMPS";
  }



  void
  DirectSolver::factorise(Factorisation &entry, const bool keep_pivots)
  {
    const Stopwatch stopwatch(factorising);
    ++factorisation_count;
    int error = 0;
    if (!entry.solver)
      {
        entry.problem = std::make_unique<Epetra_LinearProblem>();
        entry.problem->SetOperator(
          const_cast<Epetra_CrsMatrix *>(&entry.matrix.trilinos_matrix()));
        const std::string name = chosen_type(entry.matrix.m()) == "KLU"
          ? "Amesos_Klu"
          : "Amesos_Mumps";
        entry.solver.reset(Amesos().Create(name, *entry.problem));
        AssertThrow(entry.solver,
                    ExcMessage("Trilinos was built without " + name));
      }
    // MUMPS looks at the values already when it orders the unknowns.
    if (!keep_pivots)
      error = entry.solver->SymbolicFactorization();
    // KLU looks at its pivots and chooses others when they are no longer good.
    Teuchos::ParameterList list;
    list.set("Refactorize", keep_pivots);
    entry.solver->SetParameters(list);
    if (error == 0)
      error = entry.solver->NumericFactorization();
    if (error != 0)
      {
        entry.solver.reset();
        throw NewtonFailure(
          "The tangent matrix cannot be factored: it is singular. Is the body "
          "held, or does it have inertia?");
      }
  }



  void
  DirectSolver::solve(const std::optional<Key>            &key,
                      const std::function<void(Matrix &)> &assemble,
                      const Vector                        &right_hand_side,
                      Vector                              &solution,
                      const bool                           may_reuse)
  {
    Factorisation *entry = &changing;
    if (key)
      {
        auto known = kept.begin();
        while (known != kept.end() && !(known->key == key))
          ++known;
        if (known == kept.end())
          {
            while (kept.size() >= parameters.n_kept)
              kept.pop_back();
            kept.emplace_front();
            assemble(kept.front().matrix);
            factorise(kept.front(), false);
            // Only now: a matrix that cannot be factored is never found again.
            kept.front().key = key;
          }
        else
          kept.splice(kept.begin(), kept, known);
        entry = &kept.front();
      }
    else if (!may_reuse || !changing.solver)
      {
        assemble(changing.matrix);
        factorise(changing, !new_pivots);
        new_pivots = false;
      }

    const Stopwatch stopwatch(substituting);
    entry->problem->SetLHS(&solution.trilinos_vector());
    entry->problem->SetRHS(
      const_cast<Epetra_MultiVector *>(static_cast<const Epetra_MultiVector *>(
        &right_hand_side.trilinos_vector())));
    if (entry->solver->Solve() != 0)
      throw NewtonFailure("The linear system cannot be solved.");
  }
} // namespace Ricochet
