// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_single_tangent_h
#define ricochet_solvers_single_tangent_h

#include <solvers/block_matrix.h>
#include <solvers/tangent_operator.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * A tangent in single precision, for preconditioners: its terms as one symmetric
   * matrix of blocks between nodes, and contact by the rows of its Jacobian. It is
   * divided by a power of two so that its entries are about one or below, whatever
   * the units.
   */
  class SingleTangent : public dealii::Subscriptor
  {
  public:
    using VectorType = dealii::LinearAlgebra::distributed::Vector<float>;

    /// Set the terms of @p tangent, and the clamped unknowns. Collective, like all
    /// functions. @param dim unknowns of a node.
    void
    set_body(const TangentOperator &tangent, const unsigned int dim);

    /// Set contact, and the diagonal, as they are in @p tangent now.
    void
    set_contact(const TangentOperator &tangent);

    /// @p result = this @p vector.
    void
    vmult(VectorType &result, const VectorType &vector) const;

    /// Initialise @p vector for vmult().
    void
    initialize_dof_vector(VectorType &vector) const
    {
      vector.reinit(pattern->partitioner);
    }

    /// Factor of the stored tangent.
    double
    factor() const
    {
      return scaling;
    }

    dealii::types::global_dof_index
    m() const
    {
      return diagonal.size();
    }

    /// An entry on the diagonal, in the form for deal.II's smoothers.
    float
    el(const dealii::types::global_dof_index                  i,
       [[maybe_unused]] const dealii::types::global_dof_index j) const
    {
      Assert(i == j, dealii::ExcNotImplemented());
      return diagonal(i);
    }

    /// Bytes of the matrix on this rank.
    std::size_t
    memory_consumption() const
    {
      return body->memory_consumption();
    }

  private:
    std::shared_ptr<const BlockPattern> pattern;
    std::unique_ptr<BlockMatrix<float>> body;
    double                              scaling = 1.;
    VectorType                          diagonal;
    bool                                some_change = false;
    // The rows of the contact Jacobian that enter the tangent, with local numbers
    // of unknowns, and the entries of C.
    std::vector<std::size_t>  functional_begin;
    std::vector<unsigned int> unknown;
    std::vector<float>        coefficient;
    struct Action
    {
      unsigned int on, of;
      float        factor;
    };
    std::vector<Action> actions;
    // Work space.
    mutable std::vector<float> observed, acting;
  };
} // namespace Ricochet

#endif
