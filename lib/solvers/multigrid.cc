// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/vector_operations.h>
#include <solvers/aggregation_parameters.h>
#include <solvers/flexible_gmres.h>
#include <solvers/multigrid.h>
#include <solvers/single_precision.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/solver_cg.h>
#include <deal.II/lac/solver_control.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  /**
   * Products with the prolongation P: terms of a tangent between coarse unknowns.
   * Row by row, without another large matrix; and written out, as the matrix
   * products of deal.II 9.4 write beyond their memory on several ranks.
   */
  class Multigrid::CoarseProducts
  {
  public:
    explicit CoarseProducts(const CoarseSpace &space)
      : space(space)
      , place(space.pattern.n_cols(), -1)
    {}

    /// @p coarse += P^T @p matrix P.
    void
    add(const BodyMatrix &matrix, Matrix &coarse)
    {
      const IndexSet owned = matrix.locally_owned_range_indices();
      matrix.for_each_row(
        [&](const unsigned int                          r,
            const std::vector<types::global_dof_index> &entry_columns,
            const std::vector<double>                  &entry_values) {
          for (unsigned int e = 0; e < entry_columns.size(); ++e)
            add_to_row(space.relevant.index_within_set(entry_columns[e]),
                       entry_values[e]);
          const unsigned int row =
            space.relevant.index_within_set(owned.nth_index_in_set(r));
          const Functionals &parents = space.parents;
          for (std::size_t k = parents.begin[row]; k < parents.begin[row + 1];
               ++k)
            flush_row(parents.index[k], parents.value[k], coarse);
          clear_row();
        });
      coarse.compress(VectorOperation::add);
    }

    /// @p coarse += P^T H^T C H P for the rows H of @p tangent.
    void
    add_contact(const TangentOperator &tangent, Matrix &coarse)
    {
      const Functionals &functionals = tangent.functionals();
      const auto         add = [&](const unsigned int f, const double c) {
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          add_to_row(space.relevant.index_within_set(functionals.index[k]),
                     c * functionals.value[k]);
      };
      for (unsigned int f = 0; f < tangent.change().size(); ++f)
        if (!tangent.change()[f].empty())
          {
            add(f, 1.);
            const auto test_columns = columns;
            const auto test_values  = values;
            clear_row();
            for (const auto &[other, factor] : tangent.change()[f])
              add(other, factor);
            for (unsigned int k = 0; k < test_columns.size(); ++k)
              flush_row(test_columns[k], test_values[k], coarse);
            clear_row();
          }
      coarse.compress(VectorOperation::add);
    }

  private:
    /// Add @p value, in the column of a relevant unknown, times P.
    void
    add_to_row(const unsigned int relevant, const double value)
    {
      for (std::size_t k = space.parents.begin[relevant];
           k < space.parents.begin[relevant + 1];
           ++k)
        {
          int &target = place[space.parents.index[k]];
          if (target < 0)
            {
              target = columns.size();
              columns.push_back(space.parents.index[k]);
              values.push_back(0.);
            }
          values[target] += value * space.parents.value[k];
        }
    }

    void
    flush_row(const types::global_dof_index row,
              const double                  factor,
              Matrix                       &coarse)
    {
      scaled.resize(values.size());
      for (unsigned int k = 0; k < values.size(); ++k)
        scaled[k] = factor * values[k];
      coarse.add(row, columns.size(), columns.data(), scaled.data(), true);
    }

    void
    clear_row()
    {
      for (const auto column : columns)
        place[column] = -1;
      columns.clear();
      values.clear();
    }

    const CoarseSpace &space;
    // Data of one row: index of each coarse unknown in it, its columns and
    // values.
    std::vector<int>                     place;
    std::vector<types::global_dof_index> columns;
    std::vector<double>                  values, scaled;
  };



  Multigrid::Multigrid(CoarseSpace coarse_space, const bool is_symmetric)
    : space(std::move(coarse_space))
    , is_symmetric(is_symmetric)
    , has_smoother(space.prolongation.m() > 0)
    , modes(values_of_modes(space))
  {
    if (has_smoother)
      {
        coarse_residual.reinit(space.rigid_body_modes[0]);
        coarse_correction.reinit(space.rigid_body_modes[0]);
      }
  }



  void
  Multigrid::set_body(const TangentOperator &new_tangent,
                      const unsigned int     n_constant)
  {
    tangent = &new_tangent;
    if (!has_smoother)
      return;
    single.set_body(*tangent, space.dim());
    CoarseProducts products(space);
    coarse_body.reinit(space.pattern);
    for (unsigned int k = 0; k < tangent->terms().size(); ++k)
      {
        const MatrixTerm &term = tangent->terms()[k];
        Matrix            changing;
        Matrix           &coarse_term =
          k < n_constant ? constant_terms[term.matrix] : changing;
        if (coarse_term.m() == 0)
          {
            coarse_term.reinit(space.pattern);
            products.add(*term.matrix, coarse_term);
          }
        coarse_body.add(term.weight, coarse_term);
      }
    for (const auto i : space.clamped)
      coarse_body.set(i, i, 1.);
    coarse_body.compress(VectorOperation::insert);
  }



  void
  Multigrid::initialize_smoother()
  {
    Smoother::AdditionalData data;
    data.degree          = 2;
    data.smoothing_range = 8.;
    data.preconditioner =
      std::make_shared<DiagonalMatrix<SingleTangent::VectorType>>();
    SingleVector &inverse = data.preconditioner->get_vector();
    single.initialize_dof_vector(inverse);
    bool is_positive = true;
    for (const auto i : inverse.locally_owned_elements())
      {
        const float value = single.el(i, i);
        is_positive       = is_positive && value > 0.F && std::isfinite(value);
        inverse(i)        = 1.F / value;
      }
    if (Utilities::MPI::min(is_positive ? 1 : 0, tangent->communicator) == 0)
      throw NewtonFailure(
        "The diagonal of the tangent matrix is not positive: multigrid cannot "
        "smooth with it.");
    for (SingleVector *vector : {&single_right_hand_side,
                                 &single_result,
                                 &single_residual,
                                 &whole_right_hand_side,
                                 &single_start})
      single.initialize_dof_vector(*vector);
    fine.reinit(inverse.locally_owned_elements(), tangent->communicator);
    try
      {
        // Estimated by some iterations of conjugate gradients from the same
        // start each time, so that it does not depend on the history.
        smoother.initialize(single, data);
        const double largest = smoother.estimate_eigenvalues(single_residual)
                                 .max_eigenvalue_estimate;
        if (!(largest > 0.) || !std::isfinite(largest))
          throw NewtonFailure(
            "The tangent matrix is not positive: multigrid "
            "cannot smooth with it.");
      }
    catch (const SolverControl::NoConvergence &)
      {
        throw NewtonFailure("The tangent matrix is not finite.");
      }
  }



  void
  Multigrid::setup()
  {
    if (has_smoother)
      {
        coarse.copy_from(coarse_body);
        CoarseProducts(space).add_contact(*tangent, coarse);
        update_smoother();
      }

    auto list = aggregation_parameters(space, modes);
    seed_aggregation(Utilities::MPI::this_mpi_process(tangent->communicator));
    aggregation = std::make_unique<TrilinosWrappers::PreconditionAMG>();
    aggregation->initialize(has_smoother
                              ? coarse
                              : *tangent->terms()[0].matrix->entries(),
                            list);
  }



  void
  Multigrid::update_smoother()
  {
    if (!has_smoother)
      return;
    single.set_contact(*tangent);
    initialize_smoother();
    subspace.update(*tangent);
  }



  void
  Multigrid::cycle() const
  {
    const unsigned int n    = single_residual.locally_owned_size();
    double *const      work = local_values(fine);
    smoother.vmult(single_result, single_right_hand_side);
    single.vmult(single_residual, single_result);
    for (unsigned int i = 0; i < n; ++i)
      work[i] = single_right_hand_side.local_element(i) -
        single_residual.local_element(i);
    space.prolongation.Tvmult(coarse_residual, fine);
    aggregation->vmult(coarse_correction, coarse_residual);
    space.prolongation.vmult(fine, coarse_correction);
    // The coarse levels use the unscaled tangent.
    for (unsigned int i = 0; i < n; ++i)
      single_result.local_element(i) +=
        static_cast<float>(work[i] / single.factor());
    smoother.step(single_result, single_right_hand_side);
  }



  void
  Multigrid::solve_in_subspace(const SingleVector &right_hand_side,
                               const bool          starts) const
  {
    subspace_values.assign(subspace.size(), 0.);
    if (!starts)
      single.vmult(single_residual, single_result);
    for (const auto &[number, place] : subspace.own_unknowns())
      subspace_values[place] = right_hand_side.local_element(number) -
        (starts ? 0. : single_residual.local_element(number));
    subspace.solve(subspace_values);
    if (starts)
      single_result = 0.F;
    for (const auto &[number, place] : subspace.own_unknowns())
      single_result.local_element(number) +=
        static_cast<float>(subspace_values[place] / single.factor());
  }



  void
  Multigrid::vmult(Vector &result, const Vector &vector) const
  {
    if (!has_smoother)
      {
        aggregation->vmult(result, vector);
        return;
      }
    const double norm = vector.linfty_norm();
    if (!(norm > 0.) || !std::isfinite(norm))
      {
        result = vector;
        return;
      }
    const double        size = size_for_single_precision(norm);
    const unsigned int  n    = single_residual.locally_owned_size();
    const double *const from = local_values(vector);
    double *const       to   = local_values(result);
    for (unsigned int i = 0; i < n; ++i)
      single_right_hand_side.local_element(i) =
        static_cast<float>(from[i] / size);

    if (subspace.is_empty())
      cycle();
    else
      {
        // The cycle acts on the residual of the subspace, which is solved again
        // afterwards, so that the preconditioner is symmetric.
        whole_right_hand_side = single_right_hand_side;
        solve_in_subspace(whole_right_hand_side, true);
        single_start = single_result;
        single.vmult(single_residual, single_start);
        single_right_hand_side -= single_residual;
        cycle();
        single_result += single_start;
        solve_in_subspace(whole_right_hand_side, false);
      }
    for (unsigned int i = 0; i < n; ++i)
      to[i] = single_result.local_element(i) * size * single.factor();
  }



  int
  Multigrid::solve(const Vector &right_hand_side,
                   Vector       &solution,
                   const double  tolerance) const
  {
    solution = 0.;
    SolverControl control(300, tolerance * right_hand_side.l2_norm());
    try
      {
        if (is_symmetric)
          SolverCG<Vector>(control).solve(*tangent,
                                          solution,
                                          right_hand_side,
                                          *this);
        else
          SolverFGMRES<Vector>(control, flexible_gmres_settings())
            .solve(*tangent, solution, right_hand_side, *this);
      }
    catch (const SolverControl::NoConvergence &)
      {
        return -1;
      }
    return control.last_step();
  }
} // namespace Ricochet
