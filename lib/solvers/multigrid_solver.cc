// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/memory.h>
#include <base/stopwatch.h>
#include <solvers/multigrid_solver.h>

#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Give @p contact_matrix the part of the pattern of @p matrix that couples
    /// the unknowns @p rows of all ranks.
    void
    reinit_contact_matrix(const BodyMatrix                           &matrix,
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
      contact.compress();
      DynamicSparsityPattern pattern(owned.size(), owned.size(), owned);
      matrix.for_each_row(
        [&](const unsigned int                          r,
            const std::vector<types::global_dof_index> &columns,
            const std::vector<double> &) {
          const types::global_dof_index row = owned.nth_index_in_set(r);
          if (contact.is_element(row))
            for (const types::global_dof_index column : columns)
              if (contact.is_element(column))
                pattern.add(row, column);
        });
      contact_matrix.reinit(owned, pattern, matrix.get_mpi_communicator());
    }
  } // namespace



  MultigridSolver::MultigridSolver(const ContactStructure &contact,
                                   const bool              linear_body,
                                   const IndexSet         &clamped,
                                   CoarseSpace             coarse_space)
    : contact(contact)
    , clamped(clamped)
    , is_sum(linear_body && contact.functionals.has_value() &&
             !contact.eliminates_rows && coarse_space.prolongation.m() > 0)
    , multigrid(std::move(coarse_space), linear_body && contact.is_symmetric)
  {
    return_freed_memory();
  }



  void
  MultigridSolver::update_tangent(const Tangent  &tangent,
                                  const IndexSet &owned,
                                  const MPI_Comm  communicator)
  {
    if (!current)
      current =
        std::make_unique<TangentOperator>(owned,
                                          clamped,
                                          is_sum
                                            ? contact.functionals->functionals
                                            : Functionals(),
                                          communicator);
    if (!is_sum)
      {
        assemble(tangent, *matrix.entries());
        current->set_terms({{1., &matrix}});
        return;
      }

    const unsigned int n_functionals = contact.functionals->functionals.size();
    if (!(body == tangent.body))
      {
        body.reset();
        MatrixSum terms = tangent.body_terms;
        if (tangent.add_contact)
          {
            if (matrix.entries()->m() == 0)
              reinit_contact_matrix(*terms[0].matrix,
                                    contact.rows,
                                    *matrix.entries());
            *matrix.entries() = 0.;
            tangent.add_open_contact(*matrix.entries());
            terms.push_back({1., &matrix});
          }
        current->set_terms(terms);
        current->set_change(std::vector<FunctionalRow>(n_functionals));
        const Stopwatch stopwatch(spent.factorising);
        multigrid.set_body(*current, tangent.body_terms.size());
        body = tangent.body;
      }
    std::vector<FunctionalRow> change(n_functionals),
      with_residual(n_functionals);
    if (tangent.add_contact)
      tangent.differentiate_contact(change, with_residual);
    current->set_change(std::move(change));
  }



  bool
  MultigridSolver::solve(const Tangent &tangent,
                         const Vector  &right_hand_side,
                         Vector        &solution,
                         const bool     may_reuse,
                         const double   tolerance)
  {
    const Name new_name{tangent.body, tangent.contact};
    // The tangent, unless it is the same as before.
    if (!(name == new_name) && !(may_reuse && !stage_begins && !name.contact))
      {
        name = {};
        update_tangent(tangent,
                       right_hand_side.locally_owned_elements(),
                       right_hand_side.get_mpi_communicator());
        name                = new_name;
        smoother_is_current = false;
      }
    const auto set_up = [&]() {
      const Stopwatch stopwatch(spent.factorising);
      ++spent.n_factorisations;
      if (!is_sum)
        multigrid.set_body(*current, 0);
      multigrid.setup();
      set_up_name         = new_name;
      smoother_is_current = true;
    };
    const auto iterate = [&]() {
      const Stopwatch stopwatch(spent.substituting);
      return multigrid.solve(right_hand_side, solution, tolerance);
    };
    // Tangents share a preconditioner within a stage, except for the smoother of a sum,
    // which is always its own; never for longer, so that results do not depend on the
    // history. A tangent with a cache key may find its own preconditioner.
    const bool is_first = stage_begins || !set_up_in_stage ||
      (is_sum ? !(set_up_name.body == new_name.body)
              : new_name.body && new_name.contact);
    stage_begins = false;
    if (is_first && !(set_up_name == new_name))
      set_up();
    else if (is_sum && !smoother_is_current)
      {
        const Stopwatch stopwatch(spent.factorising);
        multigrid.update_smoother();
        smoother_is_current = true;
      }
    set_up_in_stage  = true;
    int n_iterations = iterate();
    if (is_first)
      budget.begin(n_iterations, tolerance);
    else if (budget.is_exceeded(n_iterations, tolerance))
      {
        // The next solution of this stage has a new preconditioner.
        set_up();
        if (n_iterations < 0)
          n_iterations = iterate();
      }
    return n_iterations >= 0;
  }
} // namespace Ricochet
