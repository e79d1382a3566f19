// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/vector_operations.h>
#include <solvers/single_precision.h>
#include <solvers/single_tangent.h>

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  void
  SingleTangent::set_body(const TangentOperator &tangent,
                          const unsigned int     dim)
  {
    body.reset();
    // Blocks have an entry for all couplings of the body.
    pattern.reset();
    std::vector<MatrixEntries> matrices;
    for (const MatrixTerm &term : tangent.terms())
      if (term.matrix->blocks())
        pattern = term.matrix->blocks()->pattern();
      else
        matrices.emplace_back(*term.matrix->entries());
    if (!pattern)
      pattern = std::make_shared<BlockPattern>(matrices,
                                               tangent.functionals().index,
                                               dim,
                                               tangent.communicator);
    body = std::make_unique<BlockMatrix<float>>(pattern);

    // The scale is that of the body's own stiffness, which does not depend on
    // contact.
    double largest = 0.;
    for (const MatrixTerm &term : tangent.terms())
      largest =
        std::max(largest, std::abs(term.weight) * term.matrix->linfty_norm());
    scaling = 1. / size_for_single_precision(largest);
    for (const MatrixTerm &term : tangent.terms())
      if (term.matrix->blocks())
        body->add(scaling * term.weight, *term.matrix->blocks());
      else
        body->add(scaling * term.weight,
                  MatrixEntries(*term.matrix->entries()));

    VectorType flags;
    initialize_dof_vector(flags);
    for (const auto i : tangent.clamped_unknowns())
      flags(i) = 1.F;
    flags.update_ghost_values();
    body->clear(flags, static_cast<float>(scaling));
  }



  void
  SingleTangent::set_contact(const TangentOperator &tangent)
  {
    initialize_dof_vector(diagonal);
    const Vector  exact  = tangent.diagonal();
    const double *values = local_values(exact);
    for (unsigned int i = 0; i < diagonal.locally_owned_size(); ++i)
      diagonal.local_element(i) = static_cast<float>(scaling * values[i]);

    const Functionals &functionals = tangent.functionals();
    const auto        &rows        = tangent.change();
    functional_begin               = {0};
    unknown.clear();
    coefficient.clear();
    actions.clear();
    std::vector<unsigned int> number(functionals.size(),
                                     numbers::invalid_unsigned_int);
    const auto                take = [&](const unsigned int f) {
      if (number[f] == numbers::invalid_unsigned_int)
        {
          number[f] = functional_begin.size() - 1;
          for (std::size_t k = functionals.begin[f];
               k < functionals.begin[f + 1];
               ++k)
            {
              unknown.push_back(
                pattern->partitioner->global_to_local(functionals.index[k]));
              coefficient.push_back(static_cast<float>(functionals.value[k]));
            }
          functional_begin.push_back(unknown.size());
        }
      return number[f];
    };
    for (unsigned int f = 0; f < rows.size(); ++f)
      for (const auto &[other, factor] : rows[f])
        {
          const unsigned int on = take(f), of = take(other);
          actions.push_back({on, of, static_cast<float>(scaling * factor)});
        }
    observed.resize(functional_begin.size() - 1);
    acting.resize(observed.size());
    some_change =
      Utilities::MPI::max(actions.empty() ? 0 : 1, tangent.communicator) == 1;
  }



  void
  SingleTangent::vmult(VectorType &result, const VectorType &vector) const
  {
    // The products with body and contact need the ghosts.
    vector.update_ghost_values();
    const float *from = vector.begin();
    float       *to   = result.begin();
    body->vmult(from, to);
    if (!some_change)
      {
        vector.zero_out_ghost_values();
        return;
      }
    for (unsigned int f = 0; f < observed.size(); ++f)
      {
        float sum = 0.F;
        for (std::size_t k = functional_begin[f]; k < functional_begin[f + 1];
             ++k)
          sum += coefficient[k] * from[unknown[k]];
        observed[f] = sum;
      }
    vector.zero_out_ghost_values();
    std::fill(acting.begin(), acting.end(), 0.F);
    for (const Action &action : actions)
      acting[action.on] += action.factor * observed[action.of];
    for (unsigned int f = 0; f < acting.size(); ++f)
      if (acting[f] != 0.F)
        for (std::size_t k = functional_begin[f]; k < functional_begin[f + 1];
             ++k)
          to[unknown[k]] += coefficient[k] * acting[f];
    // Contributions to unknowns of other ranks.
    result.compress(VectorOperation::add);
  }
} // namespace Ricochet
