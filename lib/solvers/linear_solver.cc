// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/kept.h>
#include <base/one_rank.h>
#include <solvers/coupled_multigrid.h>
#include <solvers/direct_solver.h>
#include <solvers/linear_solver.h>
#include <solvers/multigrid_solver.h>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The package that factors whole tangents: the @p wanted one, or the fastest.
    std::string
    lu_package(const std::string &wanted,
               const unsigned int dim,
               const std::size_t  n_unknowns)
    {
      if (wanted != "automatic")
        return wanted;
      return dim < 3 && n_unknowns < 20000 ? "KLU" : "MUMPS";
    }

    /// Whether stages are condensed by default.
    bool
    condensing_pays(const ContactStructure &contact,
                    const bool              linear_body,
                    const unsigned int      dim,
                    const std::size_t       n_unknowns)
    {
      // The tangent of a linear body changes with contact only; between bodies the
      // whole tangent would be factored in each iteration.
      if (linear_body)
        return n_unknowns > 1000 || contact.couplings_change;
      // Factorisations dominate for nonlinear bodies in 3D, where multigrid of the
      // whole tangent is faster.
      return n_unknowns > 1000 && (dim < 3 || !contact.couplings_change);
    }

    /// Whether the reference is multigrid by default.
    bool
    multigrid_pays(const LinearSolver::Parameters &parameters,
                   const ContactStructure         &contact,
                   const bool                      linear_body,
                   const unsigned int              dim,
                   const std::size_t               n_unknowns,
                   const unsigned int              n_ranks)
    {
      if (contact.couplings_change && !(linear_body && contact.functionals))
        // Factorisations are slightly faster for small bodies.
        return dim == 3 && parameters.factorisation == "automatic" &&
          n_unknowns > 5000;
      return linear_body &&
        (!contact.has_multipliers || contact.couplings_change) &&
        LinearSolver::chooses_multigrid(parameters, dim, n_unknowns, n_ranks);
    }
  } // namespace



  LinearSolver::LinearSolver(const Parameters                   &parameters,
                             const ContactStructure             &contact,
                             const bool                          linear_body,
                             const IndexSet                     &clamped,
                             const std::function<CoarseSpace()> &coarse_space,
                             const unsigned int                  dim,
                             const std::size_t                   n_unknowns,
                             const unsigned int                  n_ranks)
    : linear_body(linear_body)
    , contact(contact)
    , package(lu_package(parameters.factorisation, dim, n_unknowns))
    , n_kept(parameters.n_kept)
  {
    const bool is_automatic = parameters.type == "automatic";
    has_multigrid           = parameters.type == "multigrid" ||
      (is_automatic &&
       multigrid_pays(parameters,
                      contact,
                      linear_body,
                      dim,
                      n_unknowns,
                      n_ranks));
    is_condensed = parameters.type == "condensed" ||
      (is_automatic && !has_multigrid && contact.functionals &&
       condensing_pays(contact, linear_body, dim, n_unknowns));

    if (parameters.type == "condensed" && !contact.functionals)
      throw InputError(
        "Contact on cut faces cannot be condensed: choose Linear solver/Type = "
        "direct, multigrid or automatic instead of condensed.");
    if (is_condensed && n_ranks > 1)
      {
        // All ranks are taken where the cost of factorisations grows faster than the
        // number of ranks.
        const std::size_t n_for_one_rank = dim < 3 ? 100000 : 30000;
        if (!parameters.distribute &&
            (!is_automatic || n_unknowns < n_for_one_rank))
          throw OneRankSuffices(n_unknowns);
        if (!is_automatic)
          throw InputError(
            "The contact Schur complement is solved on one MPI rank: with Linear "
            "solver/Distribute = true choose Type = direct, multigrid or "
            "automatic instead of condensed.");
        is_condensed = false;
      }
    if (has_multigrid && contact.has_multipliers && !contact.couplings_change)
      throw InputError(
        "Multigrid cannot solve for multipliers. With Linear solver/Type = "
        "multigrid choose a treatment without: Nitsche, Nitsche-hybrid, "
        "penalty, normal compliance or an active set.");
    if (has_multigrid && parameters.factorisation != "automatic")
      throw InputError(
        "Multigrid factors nothing: with Linear solver/Type = multigrid leave "
        "Linear solver/Factorisation at automatic.");

    // Memory of a factorisation in 3D grows faster than the number of unknowns.
    constexpr std::size_t largest_factorised = 200000;
    if (has_multigrid && contact.couplings_change)
      solvers.push_back(std::make_unique<CoupledMultigrid>(coarse_space()));
    else if (has_multigrid)
      solvers.push_back(std::make_unique<MultigridSolver>(contact,
                                                          linear_body,
                                                          clamped,
                                                          coarse_space()));
    if (!has_multigrid || (is_automatic && n_unknowns < largest_factorised))
      solvers.push_back(
        std::make_unique<DirectSolver>(package, parameters.n_kept));
  }



  bool
  LinearSolver::chooses_multigrid(const Parameters  &parameters,
                                  const unsigned int dim,
                                  const std::size_t  n_unknowns,
                                  const unsigned int n_ranks)
  {
    // The cost of factorisations in 3D grows faster than the number of unknowns,
    // which few ranks do not compensate.
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
      "direct: factor the tangent for each active set and keep the last few factors. "
      "condensed: factor the body only, by CHOLMOD on one rank, and solve the contact Schur "
      "complement; a linear body takes two solves in each stage of a time step, another one "
      "a frozen tangent of an earlier step, and the whole tangent is factored where that "
      "does not converge. multigrid: from degree 2 to degree 1 and on by aggregation; for "
      "treatments with multipliers only between bodies. automatic: condensed above 1000 "
      "unknowns (linear bodies against each other always, nonlinear ones in 2D); multigrid "
      "for linear bodies in 3D above 50000 unknowns, or 30000 on several ranks, and for "
      "nonlinear bodies against each other in 3D above 5000 unknowns; otherwise direct. "
      "Results agree to the tolerance of Newton's method.",
      Patterns::Selection("automatic|direct|condensed|multigrid"));
    parameters.add_parameter(
      "Factorisation",
      factorisation,
      "Package that factors the tangent. KLU: LU, fast for bars and plane meshes. MUMPS: LU, fast in 3D "
      "and parallel. automatic: KLU for bars and plane meshes below 20000 unknowns.",
      Patterns::Selection("automatic|KLU|MUMPS"));
    parameters.add_parameter(
      "Kept factorisations",
      n_kept,
      "How many factorisations to keep. One is used again when the same "
      "contact points are active (Type = direct) with the same time step. More "
      "cost memory.",
      Patterns::Integer(1, 1000));
    parameters.add_parameter(
      "Distribute",
      distribute,
      "Use all MPI ranks, also where the run would be condensed, which one rank does "
      "with its threads while the others wait: below 100000 unknowns, in 3D 30000, one "
      "rank is faster than several.");
    parameters.leave_subsection();
  }



  std::string
  LinearSolver::description() const
  {
    if (is_condensed)
      return std::string("CHOLMOD, condensed to contact") +
        (linear_body ? "" : " with a frozen tangent") + "; where that fails, " +
        package;
    if (!has_multigrid)
      return package + " for each state of contact";
    return n_taken_over == 0 ? "multigrid"
                             : "multigrid; where it did not converge, " +
        package + " in " + std::to_string(n_taken_over) + " solutions";
  }



  unsigned int
  LinearSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double   tolerance)
  {
    // The next solver after one that failed begins anew. Multigrid that did not
    // converge is not tried again in its stage.
    bool         reuse      = may_reuse;
    unsigned int strategies = 0;
    for (unsigned int s = multigrid_failed ? 1 : 0; s < solvers.size(); ++s)
      {
        if (solvers[s]
              ->solve(tangent, right_hand_side, solution, reuse, tolerance))
          {
            multigrid_failed = has_multigrid && s > 0;
            n_taken_over += multigrid_failed;
            return strategies | solvers[s]->strategy();
          }
        reuse      = false;
        strategies = SolverReport::iterative_failed;
      }
    throw NewtonFailure(
      "Multigrid does not converge. A thin body takes Linear solver/Type = direct "
      "or, against obstacles only, condensed.\n");
  }



  std::unique_ptr<ContactSchurComplement>
  LinearSolver::make_schur_complement(const Tangent &tangent)
  {
    auto complement = std::make_unique<ContactSchurComplement>(
      *contact.functionals,
      linear_body ? SparseCholesky::Kind::exact
                  : SparseCholesky::Kind::frozen_tangent,
      condensed_costs);
    complement->factorise(tangent);
    return complement;
  }



  ContactSchurComplement &
  LinearSolver::condensed(const Tangent &tangent)
  {
    if (linear_body)
      return *find_or_make(
                condensed_bodies,
                n_kept,
                [&](const Condensed &entry) {
                  return entry.body == tangent.body;
                },
                [&]() {
                  return Condensed{tangent.body,
                                   make_schur_complement(tangent)};
                })
                .complement;
    if (!frozen)
      frozen = make_schur_complement(tangent);
    else if (!has_frozen)
      frozen->factorise(tangent);
    has_frozen = true;
    return *frozen;
  }



  void
  LinearSolver::begin_stage()
  {
    multigrid_failed = false;
    for (const auto &solver : solvers)
      solver->begin_stage();
  }



  template <typename Cost>
  Cost
  LinearSolver::sum_of(const Cost TangentSolver::Costs::*cost) const
  {
    Cost sum = condensed_costs.*cost;
    for (const auto &solver : solvers)
      sum += solver->costs().*cost;
    return sum;
  }



  unsigned int
  LinearSolver::n_factorisations() const
  {
    return sum_of(&TangentSolver::Costs::n_factorisations);
  }



  double
  LinearSolver::factorisation_seconds() const
  {
    return sum_of(&TangentSolver::Costs::factorising);
  }



  unsigned int
  LinearSolver::n_back_substitutions() const
  {
    return sum_of(&TangentSolver::Costs::n_substitutions);
  }



  double
  LinearSolver::back_substitution_seconds() const
  {
    return sum_of(&TangentSolver::Costs::substituting);
  }
} // namespace Ricochet
