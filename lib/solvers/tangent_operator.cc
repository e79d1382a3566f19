// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/tangent_operator.h>

#include <deal.II/base/mpi.h>
#include <deal.II/lac/dynamic_sparsity_pattern.h>

#include <algorithm>
#include <map>

namespace Ricochet
{
  using namespace dealii;

  TangentOperator::TangentOperator(const IndexSet    &owned,
                                   const IndexSet    &clamped,
                                   const Functionals &functionals,
                                   const MPI_Comm     communicator)
    : communicator(communicator)
    , owned(owned)
    , clamped(clamped)
    , my_functionals(functionals)
    , some_clamped(
        Utilities::MPI::max(clamped.is_empty() ? 0 : 1, communicator) == 1)
    , body_diagonal(owned, communicator)
    , product(owned, communicator)
  {
    if (some_clamped)
      free.reinit(owned, communicator);
    // Rows of all ranks, one rank after the other.
    const IndexSet owned_rows = Utilities::MPI::create_ascending_partitioning(
      communicator,
      functionals.size())[Utilities::MPI::this_mpi_process(communicator)];
    if (owned_rows.size() == 0)
      return;
    const auto for_each_entry = [&](const auto &action) {
      for (unsigned int f = 0; f < functionals.size(); ++f)
        for (std::size_t k = functionals.begin[f]; k < functionals.begin[f + 1];
             ++k)
          action(owned_rows.nth_index_in_set(f), k);
    };
    DynamicSparsityPattern pattern(owned_rows.size(), owned.size(), owned_rows);
    for_each_entry([&](const auto row, const std::size_t k) {
      pattern.add(row, functionals.index[k]);
    });
    functional_matrix.reinit(owned_rows, owned, pattern, communicator);
    for_each_entry([&](const auto row, const std::size_t k) {
      functional_matrix.add(row, functionals.index[k], functionals.value[k]);
    });
    functional_matrix.compress(VectorOperation::add);
    observed.reinit(owned_rows, communicator);
    acting.reinit(owned_rows, communicator);
  }



  void
  TangentOperator::set_terms(const MatrixSum &terms)
  {
    sum = terms;
    // One sweep for both, for example stiffness and mass.
    const auto find = [&](const bool isotropic) {
      return std::find_if(sum.begin(),
                          sum.end(),
                          [&](const MatrixTerm &term) {
                            return term.matrix->blocks() &&
                              term.matrix->blocks()->is_isotropic() ==
                              isotropic;
                          }) -
        sum.begin();
    };
    block_term     = find(false);
    isotropic_term = block_term < sum.size() ? find(true) : sum.size();
    body_diagonal  = 0.;
    for (const MatrixTerm &term : sum)
      {
        term.matrix->add_diagonal(term.weight, body_diagonal);
      }
  }



  void
  TangentOperator::set_change(std::vector<FunctionalRow> new_rows)
  {
    rows = std::move(new_rows);
    const bool has_mine =
      std::any_of(rows.begin(), rows.end(), [](const FunctionalRow &row) {
        return !row.empty();
      });
    some_change = Utilities::MPI::max(has_mine ? 1 : 0, communicator) == 1;
  }



  void
  TangentOperator::vmult(Vector &result, const Vector &vector) const
  {
    const Vector *argument = &vector;
    if (some_clamped)
      {
        free = vector;
        for (const auto i : clamped)
          free(i) = 0.;
        free.compress(VectorOperation::insert);
        argument = &free;
      }
    bool is_empty = true;
    if (isotropic_term < sum.size())
      {
        BodyMatrix::vmult_sum(sum[block_term],
                              sum[isotropic_term],
                              result,
                              *argument);
        is_empty = false;
      }
    for (unsigned int k = 0; k < sum.size(); ++k)
      {
        if (isotropic_term < sum.size() &&
            (k == block_term || k == isotropic_term))
          continue;
        Vector &target = is_empty ? result : product;
        sum[k].matrix->vmult(target, *argument);
        if (is_empty)
          result *= sum[k].weight;
        else
          result.add(sum[k].weight, product);
        is_empty = false;
      }
    if (some_change)
      {
        functional_matrix.vmult(observed, *argument);
        // Rows act on rows of the same point, so of the same rank.
        const double *value  = local_values(observed);
        double       *action = local_values(acting);
        for (unsigned int f = 0; f < rows.size(); ++f)
          {
            action[f] = 0.;
            for (const auto &[other, factor] : rows[f])
              action[f] += factor * value[other];
          }
        functional_matrix.Tvmult(product, acting);
        result += product;
      }
    if (some_clamped)
      {
        for (const auto i : clamped)
          result(i) = vector(i);
        result.compress(VectorOperation::insert);
      }
  }



  Vector
  TangentOperator::diagonal() const
  {
    Vector                                    diagonal = body_diagonal;
    std::map<types::global_dof_index, double> row_of_product;
    for (unsigned int f = 0; f < rows.size(); ++f)
      {
        // Row f of C H.
        row_of_product.clear();
        for (const auto &[other, factor] : rows[f])
          for (std::size_t k = my_functionals.begin[other];
               k < my_functionals.begin[other + 1];
               ++k)
            row_of_product[my_functionals.index[k]] +=
              factor * my_functionals.value[k];
        for (std::size_t k = my_functionals.begin[f];
             k < my_functionals.begin[f + 1];
             ++k)
          if (const auto entry = row_of_product.find(my_functionals.index[k]);
              entry != row_of_product.end())
            diagonal(entry->first) += my_functionals.value[k] * entry->second;
      }
    diagonal.compress(VectorOperation::add);
    for (const auto i : clamped)
      diagonal(i) = 1.;
    diagonal.compress(VectorOperation::insert);
    return diagonal;
  }
} // namespace Ricochet
