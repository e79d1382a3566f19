// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/memory.h>
#include <base/stopwatch.h>
#include <solvers/linear_solver.h>
#include <solvers/multigrid.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>
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



  /// A factored body, its name, and that of the contact last put to it.
  struct LinearSolver::Corrected
  {
    std::optional<BodyKey>                  body;
    std::optional<std::uint64_t>            contact;
    std::unique_ptr<CorrectedFactorisation> factorisation;
  };



  /// The tangent of the last solution and its preconditioner, with the names of
  /// what they were made of.
  struct LinearSolver::MultigridState
  {
    MultigridState(CoarseSpace coarse_space,
                   const bool  is_symmetric,
                   const bool  may_be_sum)
      : is_sum(may_be_sum && coarse_space.prolongation.m() > 0)
      , multigrid(std::move(coarse_space), is_symmetric)
    {}

    struct Name
    {
      std::optional<BodyKey>       body;
      std::optional<std::uint64_t> contact;

      bool
      operator==(const Name &other) const
      {
        return body && contact && body == other.body &&
          contact == other.contact;
      }
    };

    // The tangent is the sum of the body's constant terms, of open contact and
    // of what contact does through its functionals; otherwise one matrix.
    const bool is_sum;
    // Open contact, or all of it.
    Matrix                           matrix;
    std::optional<BodyKey>           body;
    std::unique_ptr<TangentOperator> tangent;
    // Smooths with this very tangent, even when it has changed since the setup: a
    // large body has no room for another one.
    Multigrid multigrid;
    Name      name, set_up_name;
    // For tangents without a name: whether there was a set-up for them in this
    // stage, and the iterations for a decade of the residual that it needed.
    bool   set_up_in_stage             = false;
    double first_iterations_per_decade = 0.;
  };



  namespace
  {
    /// Overwrite @p matrix with the whole @p tangent.
    void
    assemble(const Tangent &tangent, Matrix &matrix)
    {
      tangent.assemble_body(matrix);
      if (tangent.complete_contact)
        tangent.complete_contact(matrix);
    }



    /// Give @p contact_matrix the part of the pattern of @p matrix that couples
    /// the unknowns @p rows of all ranks.
    void
    reinit_contact_matrix(const Matrix                               &matrix,
                          const std::vector<types::global_dof_index> &rows,
                          Matrix &contact_matrix)
    {
      const IndexSet owned = matrix.locally_owned_range_indices();
      IndexSet       contact(owned.size());
      {
        std::vector<types::global_dof_index> sorted = rows;
        std::sort(sorted.begin(), sorted.end());
        contact.add_indices(sorted.begin(), sorted.end());
      }
      // Not by deal.II's iterators, which copy each row.
      const Epetra_CrsMatrix &epetra = matrix.trilinos_matrix();
      DynamicSparsityPattern  pattern(owned.size(), owned.size(), owned);
      for (const auto row : contact &owned)
        {
          int  n_entries = 0;
          int *indices   = nullptr;
          epetra.Graph().ExtractMyRowView(
            epetra.LRID(static_cast<TrilinosWrappers::types::int_type>(row)),
            n_entries,
            indices);
          for (int k = 0; k < n_entries; ++k)
            if (const types::global_dof_index column =
                  epetra.GCID64(indices[k]);
                contact.is_element(column))
              pattern.add(row, column);
        }
      contact_matrix.reinit(owned, pattern, matrix.get_mpi_communicator());
    }



    /**
     * The entry of @p kept that @p is_wanted, moved to the front; or a new one,
     * made by @p make, in the place of the one not used for longest if there
     * are @p n_kept. If it cannot be made, nothing is kept of it.
     */
    template <typename Entry, typename Predicate, typename Make>
    Entry &
    find_or_make(std::list<Entry>  &kept,
                 const unsigned int n_kept,
                 const Predicate   &is_wanted,
                 const Make        &make)
    {
      const auto known = std::find_if(kept.begin(), kept.end(), is_wanted);
      if (known != kept.end())
        kept.splice(kept.begin(), kept, known);
      else
        {
          while (kept.size() >= n_kept)
            kept.pop_back();
          kept.emplace_front(make());
        }
      return kept.front();
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
    : parameters(parameters)
    , contact(contact)
    , clamped(clamped)
    , linear_body(linear_body)
    , dim(dim)
    , n_unknowns(n_unknowns)
    , n_ranks(n_ranks)
    , type(parameters.type)
    , changing_direct(std::make_unique<Direct>())
  {
    if (parameters.factorisation == "CHOLMOD" && parameters.type == "direct")
      throw InputError(
        "CHOLMOD factors symmetric matrices only: with Linear "
        "solver/Type = direct choose KLU, MUMPS or automatic.");
    if (parameters.factorisation == "CHOLMOD" && n_ranks > 1)
      throw InputError(
        "The factorisation CHOLMOD works on one MPI rank only, "
        "not on " +
        std::to_string(n_ranks) + "; choose automatic, KLU or MUMPS.");
    if (type == "automatic")
      {
        // A nonlinear body gains by the symmetry only, and where a factorisation
        // costs more than the iterations that it saves.
        const bool gains = linear_body
          ? n_unknowns > 1000
          : n_unknowns > 5000 && chosen_factorisation(true) == "CHOLMOD";
        type = gains || parameters.factorisation == "CHOLMOD" ? "corrected"
                                                              : "direct";
        // Factorisations in three dimensions grow faster than bodies do, and
        // few ranks do not make up for it.
        if (parameters.factorisation == "automatic" && linear_body &&
            dim == 3 && !contact.has_multipliers &&
            n_unknowns > (n_ranks > 1 ? 10000 : 50000))
          type = "multigrid";
      }
    if (type != "multigrid")
      return;
    if (contact.has_multipliers)
      throw InputError(
        "Multigrid cannot solve for multipliers. With Linear solver/Type = "
        "multigrid choose a treatment without: Nitsche, Nitsche-hybrid, "
        "penalty, normal compliance or an active set.");
    if (parameters.factorisation != "automatic")
      throw InputError(
        "Multigrid factors nothing: with Linear solver/Type = multigrid leave "
        "Linear solver/Factorisation at automatic.");
    multigrid =
      std::make_unique<MultigridState>(coarse_space(),
                                       linear_body && contact.is_symmetric,
                                       linear_body &&
                                         contact.functionals.has_value());
    return_freed_memory();
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
      "of low rank; for nonlinear materials factor the body's tangent (with "
      "CHOLMOD its symmetric part), with GMRES for the rest. multigrid: from "
      "degree 2 to degree 1 and on by aggregation, not for treatments with multipliers. automatic: "
      "corrected above 1000 unknowns for linear bodies, above 5000 for "
      "nonlinear ones if CHOLMOD can be used; multigrid for linear bodies in 3D "
      "above 50000 unknowns, or 10000 on several ranks.",
      Patterns::Selection("automatic|direct|corrected|multigrid"));
    parameters.add_parameter(
      "Factorisation",
      factorisation,
      "CHOLMOD: Cholesky, for Type = corrected on one MPI rank. KLU: LU, fast "
      "for bars and plane meshes. MUMPS: LU, fast in 3D and parallel. automatic: "
      "CHOLMOD where it can be; otherwise KLU for bars and plane meshes below "
      "20000 unknowns.",
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
  LinearSolver::chosen_factorisation(const bool symmetric) const
  {
    if (symmetric && n_ranks == 1 &&
        (parameters.factorisation == "automatic" ||
         parameters.factorisation == "CHOLMOD"))
      return "CHOLMOD";
    if (parameters.factorisation == "KLU" ||
        parameters.factorisation == "MUMPS")
      return parameters.factorisation;
    return dim < 3 && n_unknowns < 20000 ? "KLU" : "MUMPS";
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
  LinearSolver::description() const
  {
    if (type == "multigrid")
      return "multigrid";
    const std::string name = chosen_factorisation(type == "corrected");
    if (type == "direct")
      return name + " for each state of contact";
    return name +
      (linear_body ? ", corrected for contact"
                   : ", kept for several iterations of GMRES");
  }



  void
  LinearSolver::solve(const Tangent &tangent,
                      const Vector  &right_hand_side,
                      Vector        &solution,
                      const bool     may_reuse,
                      const double   tolerance)
  {
    if (type == "direct")
      solve_direct(tangent, right_hand_side, solution, may_reuse);
    else if (type == "multigrid")
      solve_by_multigrid(tangent,
                         right_hand_side,
                         solution,
                         may_reuse,
                         tolerance);
    else if (tangent.body)
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
      assemble(tangent, entry.matrix);
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
      entry = find_or_make(
                kept_direct,
                parameters.n_kept,
                [&](const std::unique_ptr<Direct> &direct) {
                  return direct->body == tangent.body &&
                    direct->contact == *tangent.contact;
                },
                [&]() {
                  // LU refers to the matrix: it must not move.
                  auto direct     = std::make_unique<Direct>();
                  direct->body    = tangent.body;
                  direct->contact = *tangent.contact;
                  factorise(*direct, false);
                  return direct;
                })
                .get();
    else if (!may_reuse || !entry->factorisation)
      {
        factorise(*entry, !stage_begins);
        stage_begins = false;
      }

    const Stopwatch stopwatch(substituting);
    entry->factorisation->solve(right_hand_side, solution);
  }



  LinearSolver::Corrected
  LinearSolver::factorise_body(const Tangent &tangent)
  {
    // Should the body's matrix not be positive definite, LU will do.
    for (const bool symmetric : {true, false})
      {
        if (!symmetric &&
            chosen_factorisation(false) == chosen_factorisation(true))
          break;
        LowRankCorrection::Options options;
        options.is_symmetric = symmetric && contact.is_symmetric;
        Corrected entry{tangent.body,
                        {},
                        std::make_unique<CorrectedFactorisation>(
                          make_factorisation(symmetric),
                          contact.functionals
                            ? CorrectedFactorisation::Correction::functionals
                            : CorrectedFactorisation::Correction::rows,
                          contact,
                          options,
                          factorising)};
        entry.factorisation->set_body(tangent);
        ++factorisation_count;
        if (entry.factorisation->factorise())
          return entry;
      }
    throw NewtonFailure(
      "The matrix of the body cannot be factored: it is singular. Is "
      "the body held, or does it have inertia?");
  }



  void
  LinearSolver::solve_corrected(const Tangent &tangent,
                                const Vector  &right_hand_side,
                                Vector        &solution)
  {
    Corrected &entry = find_or_make(
      kept_corrected,
      parameters.n_kept,
      [&](const Corrected &corrected) {
        return corrected.body == tangent.body;
      },
      [&]() { return factorise_body(tangent); });
    // A state of contact with a name need not be put again.
    if (tangent.complete_contact &&
        !(tangent.contact && entry.contact == tangent.contact))
      {
        entry.contact.reset();
        entry.factorisation->set_contact(tangent);
        entry.contact = tangent.contact;
      }
    const Stopwatch stopwatch(substituting);
    entry.factorisation->solve(right_hand_side, solution);
  }



  bool
  LinearSolver::solve_iteratively(const Tangent &tangent,
                                  const Vector  &right_hand_side,
                                  Vector        &solution,
                                  const bool     may_reuse,
                                  const double   tolerance)
  {
    auto &factorisation = changing_corrected;
    if (!factorisation)
      {
        // Symmetric contact is factored together with the body.
        factorisation = std::make_unique<CorrectedFactorisation>(
          make_factorisation(true, true),
          contact.is_nearly_symmetric
            ? CorrectedFactorisation::Correction::none
            : CorrectedFactorisation::Correction::rows,
          contact,
          LowRankCorrection::Options{0, false},
          factorising);
        stage_begins = true;
      }
    // An older tangent only serves after it was set up once in this stage.
    const bool new_tangent = stage_begins || !may_reuse;
    if (new_tangent)
      factorisation->set_body(tangent);

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
        if (!factorise && stage_begins)
          continue;
        if (factorise)
          {
            ++factorisation_count;
            stage_begins = false;
            if (!factorisation->factorise())
              break;
          }
        if (new_tangent || factorise)
          factorisation->set_contact(tangent);
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



  void
  LinearSolver::update_multigrid_tangent(const Tangent  &tangent,
                                         const IndexSet &owned,
                                         const MPI_Comm  communicator)
  {
    MultigridState &state = *multigrid;
    if (!state.tangent)
      state.tangent =
        std::make_unique<TangentOperator>(owned,
                                          clamped,
                                          state.is_sum
                                            ? contact.functionals->functionals
                                            : Functionals(),
                                          communicator);
    if (!state.is_sum)
      {
        assemble(tangent, state.matrix);
        state.tangent->set_terms({{1., &state.matrix}});
        return;
      }

    const unsigned int n_functionals = contact.functionals->functionals.size();
    if (!(state.body == tangent.body))
      {
        state.body.reset();
        MatrixSum terms = tangent.body_terms;
        if (tangent.complete_contact)
          {
            if (state.matrix.m() == 0)
              reinit_contact_matrix(*terms[0].matrix,
                                    contact.rows,
                                    state.matrix);
            state.matrix = 0.;
            tangent.complete_open_contact(state.matrix);
            terms.push_back({1., &state.matrix});
          }
        state.tangent->set_terms(terms);
        state.tangent->set_change(std::vector<FunctionalRow>(n_functionals));
        const Stopwatch stopwatch(factorising);
        state.multigrid.set_body(*state.tangent, tangent.body_terms.size());
        state.body = tangent.body;
      }
    std::vector<FunctionalRow> change(n_functionals);
    if (tangent.complete_contact)
      tangent.contact_change(change);
    state.tangent->set_change(std::move(change));
  }



  void
  LinearSolver::solve_by_multigrid(const Tangent &tangent,
                                   const Vector  &right_hand_side,
                                   Vector        &solution,
                                   const bool     may_reuse,
                                   const double   tolerance)
  {
    MultigridState            &state = *multigrid;
    const MultigridState::Name name{tangent.body, tangent.contact};
    // The tangent, unless it is the same as before.
    if (!(state.name == name) &&
        !(may_reuse && !stage_begins && !state.name.contact))
      {
        state.name = {};
        update_multigrid_tangent(tangent,
                                 right_hand_side.locally_owned_elements(),
                                 right_hand_side.get_mpi_communicator());
        state.name = name;
      }
    const auto set_up = [&]() {
      const Stopwatch stopwatch(factorising);
      ++factorisation_count;
      if (!state.is_sum)
        state.multigrid.set_body(*state.tangent, 0);
      state.multigrid.setup();
      state.set_up_name = name;
    };
    const auto solve = [&]() {
      const Stopwatch stopwatch(substituting);
      return state.multigrid.solve(right_hand_side, solution, tolerance);
    };
    // A tangent with a name gets a preconditioner of its own. Others share one
    // within a stage, but never beyond: so results do not depend on what came
    // before the stage.
    if (stage_begins)
      state.set_up_in_stage = false;
    stage_begins          = false;
    const bool   has_name = name.body && name.contact;
    const bool   is_first = !has_name && !state.set_up_in_stage;
    const double decades  = -std::log10(tolerance);
    if (has_name ? !(state.set_up_name == name) : is_first)
      set_up();
    if (is_first)
      state.set_up_in_stage = true;
    int n_iterations = solve();
    if (is_first)
      state.first_iterations_per_decade = n_iterations / decades;
    else if (!has_name &&
             (n_iterations < 0 ||
              n_iterations >
                5 + 2. * decades * state.first_iterations_per_decade))
      {
        // The next solution of this stage will have a better one.
        set_up();
        if (n_iterations < 0)
          n_iterations = solve();
      }
    if (n_iterations < 0)
      throw NewtonFailure("Multigrid does not converge.");
  }
} // namespace Ricochet
