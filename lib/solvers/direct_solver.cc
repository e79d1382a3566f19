// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/direct_solver.h>

namespace Ricochet
{
  using namespace dealii;

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
  DirectSolver::solve(const std::optional<Key>            &key,
                      const std::function<void(Matrix &)> &assemble,
                      const Vector                        &right_hand_side,
                      Vector                              &solution)
  {
    auto entry = kept.begin();
    if (key)
      while (entry != kept.end() && !(entry->key == key))
        ++entry;
    else
      entry = kept.end();

    if (entry == kept.end())
      {
        while (kept.size() >= parameters.n_kept)
          kept.pop_back();
        kept.emplace_front();
        entry      = kept.begin();
        entry->key = key;
        assemble(entry->matrix);
        entry->solver = std::make_unique<TrilinosWrappers::SolverDirect>(
          entry->control,
          TrilinosWrappers::SolverDirect::AdditionalData(
            false,
            chosen_type(entry->matrix.m()) == "KLU" ? "Amesos_Klu"
                                                    : "Amesos_Mumps"));
        ++factorisation_count;
        try
          {
            entry->solver->initialize(entry->matrix);
          }
        catch (const ExceptionBase &)
          {
            kept.pop_front();
            throw NewtonFailure(
              "The tangent matrix cannot be factored: it is "
              "singular. Is the body held, or does it have "
              "inertia?");
          }
      }
    else
      kept.splice(kept.begin(), kept, entry);

    entry->solver->solve(solution, right_hand_side);
    if (!key)
      kept.erase(entry);
  }
} // namespace Ricochet
