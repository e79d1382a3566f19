// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <solvers/corrected_solver.h>
#include <solvers/coupled_multigrid.h>
#include <solvers/direct_solver.h>
#include <solvers/krylov_solver.h>
#include <solvers/linear_solver.h>
#include <solvers/multigrid_solver.h>

namespace Ricochet
{
  using namespace dealii;

  LinearSolver::LinearSolver(const Parameters                   &parameters,
                             const ContactStructure             &contact,
                             const bool                          linear_body,
                             const IndexSet                     &clamped,
                             const std::function<CoarseSpace()> &coarse_space,
                             const unsigned int                  dim,
                             const std::size_t                   n_unknowns,
                             const unsigned int                  n_ranks)
    : linear_body(linear_body)
    , may_condense(parameters.condense)
    , factorisations{parameters.factorisation, dim, n_unknowns, n_ranks}
    , type(parameters.type)
  {
    if (parameters.factorisation == "CHOLMOD" && parameters.type == "direct")
      throw InputError(
        "CHOLMOD factors symmetric matrices only: with Linear "
        "solver/Type = direct choose KLU, MUMPS or automatic.");
    if (contact.couplings_change && !(linear_body && contact.functionals))
      {
        const std::string which = !linear_body ? "bodies that are not linear"
          : n_ranks > 1
          ? "bodies on cut faces, or on several MPI ranks where another contact "
            "prescribes displacements of the same nodes,"
          : "bodies on cut faces";
        if (type == "corrected")
          throw InputError(
            "Contact between bodies couples unknowns that the bodies do not "
            "couple: for " +
            which +
            " choose Linear solver/Type = direct, multigrid or automatic "
            "instead of corrected.");
        if (parameters.factorisation == "CHOLMOD")
          throw InputError(
            "CHOLMOD factors symmetric matrices only: with contact between " +
            which + " choose KLU, MUMPS or automatic.");
        // Factorisations of small bodies are faster, but not by much.
        if (type == "automatic")
          type = dim == 3 && parameters.factorisation == "automatic" &&
              n_unknowns > 5000
            ? "multigrid"
            : "direct";
      }
    if (type == "automatic")
      {
        // A nonlinear body gains where it is condensed to contact; otherwise by the
        // symmetry only, and where a factorisation costs more than the iterations that
        // it saves. Linear bodies before each other need a new one whenever contact
        // changes.
        const bool is_condensed = may_condense && contact.functionals;
        const bool gains        = linear_body
                 ? n_unknowns > 1000 || contact.couplings_change
                 : n_unknowns > (is_condensed ? 1000 : 5000) &&
            factorisations.name(true) == "CHOLMOD";
        type = gains || parameters.factorisation == "CHOLMOD" ? "corrected"
                                                              : "direct";
        if (linear_body &&
            (!contact.has_multipliers || contact.couplings_change) &&
            chooses_multigrid(parameters, dim, n_unknowns, n_ranks))
          type = "multigrid";
      }
    if (type == "multigrid" && contact.has_multipliers &&
        !contact.couplings_change)
      throw InputError(
        "Multigrid cannot solve for multipliers. With Linear solver/Type = "
        "multigrid choose a treatment without: Nitsche, Nitsche-hybrid, "
        "penalty, normal compliance or an active set.");
    if (type == "multigrid" && parameters.factorisation != "automatic")
      throw InputError(
        "Multigrid factors nothing: with Linear solver/Type = multigrid leave "
        "Linear solver/Factorisation at automatic.");

    // Bodies that are not linear, before each other, condensed to contact; what takes
    // over solves with all of it. In space it gains little, since factorisations take
    // more of the time, and multigrid is faster by itself.
    condenses_only = parameters.type == "automatic" && type == "direct" &&
      contact.couplings_change && contact.functionals && !linear_body &&
      may_condense && dim == 2 && n_unknowns > 1000 &&
      factorisations.name(true) == "CHOLMOD";
    if (condenses_only)
      ways.push_back(std::make_unique<KrylovSolver>(factorisations, contact));

    // Memory of a factorisation in 3D grows faster than the body does.
    constexpr std::size_t largest_factorised = 200000;
    const bool            may_fall_back =
      parameters.type == "automatic" && n_unknowns < largest_factorised;
    if (type == "multigrid" && contact.couplings_change)
      ways.push_back(std::make_unique<CoupledMultigrid>(coarse_space()));
    else if (type == "multigrid")
      ways.push_back(std::make_unique<MultigridSolver>(contact,
                                                       linear_body,
                                                       clamped,
                                                       coarse_space()));
    if (type == "multigrid" && may_fall_back)
      ways.push_back(
        std::make_unique<DirectSolver>(factorisations, parameters.n_kept));
    if (type != "multigrid")
      {
        // Where GMRES gives up, a factorisation with pivots will do.
        if (type == "corrected" && linear_body)
          ways.push_back(std::make_unique<CorrectedSolver>(factorisations,
                                                           parameters.n_kept,
                                                           contact));
        else if (type == "corrected")
          ways.push_back(
            std::make_unique<KrylovSolver>(factorisations, contact));
        ways.push_back(
          std::make_unique<DirectSolver>(factorisations, parameters.n_kept));
      }
  }



  bool
  LinearSolver::chooses_multigrid(const Parameters  &parameters,
                                  const unsigned int dim,
                                  const std::size_t  n_unknowns,
                                  const unsigned int n_ranks)
  {
    // Factorisations in three dimensions grow faster than bodies do, and few ranks do
    // not make up for it.
    return parameters.type == "multigrid" ||
      (parameters.type == "automatic" &&
       parameters.factorisation == "automatic" && dim == 3 &&
       n_unknowns > (n_ranks > 1 ? 30000 : 50000));
  }



  void
  LinearSolver::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Linear solver");
    parameters.add_parameter(
      "Type",
      type,
      "direct: factor the tangent for each state of contact and keep the last "
      "few. corrected: factor the body only and treat contact as a correction "
      "of low rank; for nonlinear materials factor the body's tangent (with "
      "CHOLMOD its symmetric part), with GMRES for the rest. multigrid: from "
      "degree 2 to degree 1 and on by aggregation, not for treatments with multipliers "
      "of one body; between bodies by aggregation, with or without. automatic: "
      "corrected above 1000 unknowns for linear bodies (before each other always), "
      "as well for nonlinear ones that are condensed to contact, otherwise above 5000, if "
      "CHOLMOD can be used; multigrid for linear bodies in 3D "
      "above 50000 unknowns, or 30000 on several ranks, and for others before each "
      "other in 3D above 5000 unknowns; otherwise direct.",
      Patterns::Selection("automatic|direct|corrected|multigrid"));
    parameters.add_parameter(
      "Factorisation",
      factorisation,
      "CHOLMOD: Cholesky, for Type = corrected; of several MPI ranks one does it for "
      "all. KLU: LU, fast for bars and plane meshes. MUMPS: LU, fast in 3D and parallel. "
      "automatic: CHOLMOD where it can be, on several ranks below 100000 unknowns, in 3D "
      "30000; otherwise KLU for bars and plane meshes below 20000 unknowns.",
      Patterns::Selection("automatic|CHOLMOD|KLU|MUMPS"));
    parameters.add_parameter(
      "Kept factorisations",
      n_kept,
      "How many factorisations to keep. One is used again when the same "
      "contact points are active (Type = direct) with the same time step. More "
      "cost memory.",
      Patterns::Integer(1, 1000));
    parameters.add_parameter(
      "Condense to contact",
      condense,
      "With Type = corrected before obstacles, "
      "and for bodies before each other (those that are not "
      "linear in the plane, with Type = automatic, above 1000 unknowns), where all "
      "contacts are of these kinds: Newton's method looks at these alone. A linear "
      "body is solved for twice in each stage of a time step, instead of twice in each "
      "iteration; for one that is not linear, the tangent at the last state, or with the "
      "midpoint scheme that of a few steps before, serves in all "
      "iterations of a step, which are more and much cheaper, and Newton's method takes "
      "over where they are too slow. "
      "Results are the same to the tolerance of Newton's method.");
    parameters.leave_subsection();
  }



  std::string
  LinearSolver::description() const
  {
    if (type == "multigrid")
      return n_taken_over == 0 ? "multigrid"
                               : "multigrid; where it did not converge, " +
          factorisations.name(false) + " in " + std::to_string(n_taken_over) +
          " solutions";
    const std::string name = factorisations.name(type == "corrected");
    if (condenses_only)
      return factorisations.name(true) +
        ", kept for some steps and condensed to contact; where that fails, " +
        name;
    if (type == "direct")
      return name + " for each state of contact";
    return name +
      (linear_body ? ", corrected for contact"
                   : ", kept for several iterations of GMRES");
  }



  unsigned int
  LinearSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double   tolerance)
  {
    // After a way that failed, the next one begins anew. Multigrid that did not converge
    // is not tried again in its stage.
    bool         reuse      = may_reuse;
    unsigned int strategies = 0;
    for (unsigned int w = 0; w < ways.size(); ++w)
      if (ways[w]->takes(tangent) && !(multigrid_failed && w == 0))
        {
          if (ways[w]
                ->solve(tangent, right_hand_side, solution, reuse, tolerance))
            {
              multigrid_failed = type == "multigrid" && w > 0;
              n_taken_over += multigrid_failed;
              return strategies | ways[w]->strategy();
            }
          reuse      = false;
          strategies = SolverReport::iterative_failed;
        }
    throw NewtonFailure(
      "Multigrid does not converge. A thin body takes Linear solver/Type = direct "
      "or, against obstacles only, corrected.\n");
  }



  bool
  LinearSolver::condenses() const
  {
    return may_condense && way_to_condense().condenses();
  }



  CondensedSystem &
  LinearSolver::condensed(const Tangent &tangent)
  {
    return way_to_condense().condensed(tangent);
  }



  void
  LinearSolver::forget_condensed()
  {
    way_to_condense().forget_condensed();
  }



  TangentSolver &
  LinearSolver::way_to_condense() const
  {
    return *ways.front();
  }



  void
  LinearSolver::begin_stage()
  {
    multigrid_failed = false;
    for (const auto &way : ways)
      way->begin_stage();
  }



  unsigned int
  LinearSolver::n_factorisations() const
  {
    unsigned int sum = 0;
    for (const auto &way : ways)
      sum += way->costs().n_factorisations;
    return sum;
  }



  double
  LinearSolver::factorisation_seconds() const
  {
    double sum = 0.;
    for (const auto &way : ways)
      sum += way->costs().factorising;
    return sum;
  }



  unsigned int
  LinearSolver::n_back_substitutions() const
  {
    unsigned int sum = 0;
    for (const auto &way : ways)
      sum += way->costs().n_substitutions;
    return sum;
  }



  double
  LinearSolver::back_substitution_seconds() const
  {
    double sum = 0.;
    for (const auto &way : ways)
      sum += way->costs().substituting;
    return sum;
  }
} // namespace Ricochet
