// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/stopwatch.h>
#include <solvers/linear_solver.h>

#include <deal.II/lac/solver_control.h>
#include <deal.II/lac/solver_gmres.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  /// A factored tangent and its name.
  struct LinearSolver::Direct
  {
    std::optional<BodyKey>         body;
    std::uint64_t                  contact = 0;
    Matrix                         matrix;
    std::unique_ptr<Factorisation> factorisation;
  };



  /// A factored body and its name.
  struct LinearSolver::Corrected
  {
    std::optional<BodyKey>                  body;
    std::unique_ptr<CorrectedFactorisation> factorisation;
  };



  LinearSolver::LinearSolver(const Parameters &parameters, Structure structure)
    : parameters(parameters)
    , structure(std::move(structure))
    , changing_direct(std::make_unique<Direct>())
    , changing_corrected(std::make_unique<Corrected>())
  {
    if (parameters.factorisation == "CHOLMOD" && parameters.type == "direct")
      throw InputError(
        "CHOLMOD factors symmetric matrices only: with Linear "
        "solver/Type = direct choose KLU, MUMPS or automatic.");
    if (parameters.factorisation == "CHOLMOD" && this->structure.n_ranks > 1)
      throw InputError(
        "The factorisation CHOLMOD works on one MPI rank only, "
        "not on " +
        std::to_string(this->structure.n_ranks) +
        "; choose automatic, KLU or MUMPS.");
  }



  LinearSolver::~LinearSolver() = default;



  void
  LinearSolver::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Linear solver");
    parameters.add_parameter(
      "Type",
      type,
      "direct: factor the tangent for each state of contact and keep the last "
      "few. corrected: factor the body only and treat contact as a correction "
      "in a few rows; for nonlinear materials factor the body's tangent (with "
      "CHOLMOD its symmetric part), with GMRES for the rest. automatic: "
      "corrected above 1000 unknowns for linear bodies, above 5000 for "
      "nonlinear ones if CHOLMOD can be used.",
      Patterns::Selection("automatic|direct|corrected"));
    parameters.add_parameter(
      "Factorisation",
      factorisation,
      "CHOLMOD: Cholesky, for Type = corrected on one MPI rank. KLU: LU, fast "
      "for bars and plane meshes. MUMPS: LU, fast in 3D and parallel. automatic: "
      "CHOLMOD where it can be; otherwise KLU below 20000 unknowns.",
      Patterns::Selection("automatic|CHOLMOD|KLU|MUMPS"));
    parameters.add_parameter(
      "Kept factorisations",
      n_kept,
      "How many factorisations to keep. One is used again when the same "
      "contact points are active (Type = direct) with the same time step. More "
      "cost memory.",
      Patterns::Integer(1, 1000));
    parameters.leave_subsection();
  }



  std::string
  LinearSolver::chosen_type(const bool linear_body) const
  {
    if (parameters.type != "automatic")
      return parameters.type;
    // A nonlinear body gains by the symmetry only, and where a factorisation
    // costs more than the iterations that it saves.
    const bool gains = linear_body
      ? structure.n_unknowns > 1000
      : structure.n_unknowns > 5000 && chosen_factorisation(true) == "CHOLMOD";
    return gains ? "corrected" : "direct";
  }



  std::string
  LinearSolver::chosen_factorisation(const bool symmetric) const
  {
    if (symmetric && structure.n_ranks == 1 &&
        (parameters.factorisation == "automatic" ||
         parameters.factorisation == "CHOLMOD"))
      return "CHOLMOD";
    if (parameters.factorisation == "KLU" ||
        parameters.factorisation == "MUMPS")
      return parameters.factorisation;
    return structure.n_unknowns < 20000 ? "KLU" : "MUMPS";
  }



  std::unique_ptr<Factorisation>
  LinearSolver::make_factorisation(const bool symmetric,
                                   const bool approximate) const
  {
    const std::string name = chosen_factorisation(symmetric);
    return name == "CHOLMOD" ? make_cholesky_factorisation(approximate)
                             : make_lu_factorisation(name);
  }



  std::string
  LinearSolver::description(const bool linear_body) const
  {
    const std::string type = chosen_type(linear_body);
    return chosen_factorisation(type == "corrected") + ", " + type;
  }



  void
  LinearSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double   tolerance)
  {
    const bool linear_body = tangent.body.has_value();
    if (chosen_type(linear_body) == "direct")
      solve_direct(tangent, right_hand_side, solution, may_reuse);
    else if (linear_body)
      solve_corrected(tangent, right_hand_side, solution);
    // Where GMRES gives up, a factorisation with pivots will do.
    else if (!solve_iteratively(tangent,
                                right_hand_side,
                                solution,
                                may_reuse,
                                tolerance))
      solve_direct(tangent, right_hand_side, solution, false);
  }



  void
  LinearSolver::solve_direct(const Tangent &tangent,
                             const Vector  &right_hand_side,
                             Vector        &solution,
                             const bool     may_reuse)
  {
    const auto factorise = [&](Direct &entry, const bool keep_pivots) {
      tangent.assemble_body(entry.matrix);
      if (tangent.complete_contact)
        tangent.complete_contact(entry.matrix);
      if (!entry.factorisation)
        entry.factorisation = make_factorisation(false);
      const Stopwatch stopwatch(factorising);
      ++factorisation_count;
      if (!entry.factorisation->factorise(entry.matrix, keep_pivots))
        {
          entry.factorisation.reset();
          throw NewtonFailure(
            "The tangent matrix cannot be factored: it is singular. Is the "
            "body held, or does it have inertia?");
        }
    };

    Direct *entry = changing_direct.get();
    if (tangent.body && tangent.contact)
      {
        auto known = kept_direct.begin();
        while (
          known != kept_direct.end() &&
          !(known->body == tangent.body && known->contact == *tangent.contact))
          ++known;
        if (known == kept_direct.end())
          {
            while (kept_direct.size() >= parameters.n_kept)
              kept_direct.pop_back();
            kept_direct.emplace_front();
            factorise(kept_direct.front(), false);
            // Only now: a matrix that cannot be factored is never found again.
            kept_direct.front().body    = tangent.body;
            kept_direct.front().contact = *tangent.contact;
          }
        else
          kept_direct.splice(kept_direct.begin(), kept_direct, known);
        entry = &kept_direct.front();
      }
    else if (!may_reuse || !entry->factorisation)
      {
        factorise(*entry, !new_pivots);
        new_pivots = false;
      }

    const Stopwatch stopwatch(substituting);
    entry->factorisation->solve(right_hand_side, solution);
  }



  void
  LinearSolver::solve_corrected(const Tangent &tangent,
                                const Vector  &right_hand_side,
                                Vector        &solution)
  {
    auto known = kept_corrected.begin();
    while (known != kept_corrected.end() && !(known->body == tangent.body))
      ++known;
    if (known == kept_corrected.end())
      {
        while (kept_corrected.size() >= parameters.n_kept)
          kept_corrected.pop_back();
        kept_corrected.emplace_front();
        Corrected &entry = kept_corrected.front();
        // Should the body's matrix not be positive definite, LU will do.
        for (const bool symmetric : {true, false})
          {
            ++factorisation_count;
            entry.factorisation =
              std::make_unique<CorrectedFactorisation>(make_factorisation(
                                                         symmetric),
                                                       structure.contact_rows,
                                                       8,
                                                       factorising);
            entry.factorisation->set_body(tangent.assemble_body,
                                          tangent.complete_open_contact);
            if (entry.factorisation->factorise())
              {
                entry.body = tangent.body;
                break;
              }
          }
        if (!entry.body)
          {
            kept_corrected.pop_front();
            throw NewtonFailure(
              "The matrix of the body cannot be factored: it is singular. Is "
              "the body held, or does it have inertia?");
          }
      }
    else
      kept_corrected.splice(kept_corrected.begin(), kept_corrected, known);

    CorrectedFactorisation &factorisation =
      *kept_corrected.front().factorisation;
    if (tangent.complete_contact)
      factorisation.set_contact(tangent.complete_contact);
    const Stopwatch stopwatch(substituting);
    factorisation.solve(right_hand_side, solution);
  }



  bool
  LinearSolver::solve_iteratively(const Tangent &tangent,
                                  const Vector  &right_hand_side,
                                  Vector        &solution,
                                  const bool     may_reuse,
                                  const double   tolerance)
  {
    auto &factorisation = changing_corrected->factorisation;
    if (!factorisation)
      {
        factorisation =
          std::make_unique<CorrectedFactorisation>(make_factorisation(true,
                                                                      true),
                                                   structure.contact_rows,
                                                   0,
                                                   factorising);
        new_pivots = true;
      }
    // An older tangent only serves after it was set up once in this stage.
    const bool new_tangent = new_pivots || !may_reuse;
    if (new_tangent)
      {
        // Symmetric contact is factored together with the body.
        if (structure.symmetric_contact)
          factorisation->set_body(
            [&](Matrix &matrix) {
              tangent.assemble_body(matrix);
              tangent.complete_contact(matrix);
            },
            [](Matrix &) {});
        else
          factorisation->set_body(tangent.assemble_body,
                                  tangent.complete_open_contact);
      }

    struct Preconditioner
    {
      CorrectedFactorisation &factorisation;

      void
      vmult(Vector &result, const Vector &vector) const
      {
        factorisation.solve(vector, result);
      }
    };
    solution = 0.;
    // Within a stage tangents resemble each other, but for the first ones: the
    // last factorisation serves while GMRES does not need many more iterations
    // than with a new one (some two for each decade).
    for (const bool factorise : {false, true})
      {
        if (!factorise && new_pivots)
          continue;
        if (factorise)
          {
            ++factorisation_count;
            new_pivots = false;
            if (!factorisation->factorise())
              break;
          }
        if (!structure.symmetric_contact && (new_tangent || factorise))
          factorisation->set_contact(tangent.complete_contact);
        const Stopwatch    stopwatch(substituting);
        const unsigned int max_iterations =
          factorise ? 60 : 2 + std::lround(-2.5 * std::log10(tolerance));
        SolverControl                       control(max_iterations,
                              tolerance * right_hand_side.l2_norm());
        SolverGMRES<Vector>::AdditionalData data(max_iterations + 2, true);
        SolverGMRES<Vector>                 gmres(control, data);
        try
          {
            gmres.solve(factorisation->matrix(),
                        solution,
                        right_hand_side,
                        Preconditioner{*factorisation});
            return true;
          }
        catch (const SolverControl::NoConvergence &)
          {}
      }
    factorisation.reset();
    return false;
  }
} // namespace Ricochet
