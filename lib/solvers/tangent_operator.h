// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_tangent_operator_h
#define ricochet_solvers_tangent_operator_h

#include <base/types.h>
#include <solvers/body_matrix.h>
#include <solvers/functionals.h>

#include <deal.II/base/index_set.h>
#include <deal.II/base/subscriptor.h>

#include <vector>

namespace Ricochet
{
  /**
   * A tangent as a sum, not one matrix: of matrices, and of contact by the rows
   * of its Jacobian,
   *
   *     T = sum_k w_k A_k + H^T C H,
   *
   * with the contact Jacobian H; in the rows and columns of clamped unknowns T
   * is the identity. A large body leaves no memory for another matrix, and the
   * cost of a new state of contact is that of its active points.
   */
  class TangentOperator : public dealii::Subscriptor
  {
  public:
    /**
     * @param owned unknowns of this rank.
     * @param clamped clamped ones of these.
     * @param functionals rows of the contact Jacobian of this rank, which may have entries
     * of other ranks.
     */
    TangentOperator(const dealii::IndexSet &owned,
                    const dealii::IndexSet &clamped,
                    const Functionals      &functionals,
                    const MPI_Comm          communicator);

    /// Set the matrices A_k, which must keep their addresses and values: the
    /// diagonal of their sum is kept. Collective.
    void
    set_terms(const MatrixSum &terms);

    const MatrixSum &
    terms() const
    {
      return sum;
    }

    /// Set the rows of C, one for each of this rank's functionals().
    /// Collective.
    void
    set_change(std::vector<FunctionalRow> new_rows);

    const std::vector<FunctionalRow> &
    change() const
    {
      return rows;
    }

    /// The rows of the contact Jacobian of this rank.
    const Functionals &
    functionals() const
    {
      return my_functionals;
    }

    /// The clamped unknowns of this rank.
    const dealii::IndexSet &
    clamped_unknowns() const
    {
      return clamped;
    }

    const dealii::IndexSet &
    owned_unknowns() const
    {
      return owned;
    }

    /// @p result = T @p vector.
    void
    vmult(Vector &result, const Vector &vector) const;

    /// The diagonal of T.
    Vector
    diagonal() const;

    /// Number of rows.
    dealii::types::global_dof_index
    m() const
    {
      return owned.size();
    }

    /// Communicator of all ranks that own unknowns.
    const MPI_Comm communicator;

  private:
    const dealii::IndexSet owned;
    const dealii::IndexSet clamped;
    const Functionals      my_functionals;
    bool                   some_clamped = false;
    MatrixSum              sum;
    // Two of the terms that are multiplied in one sweep; the second one is the
    // number of terms if there is no such pair.
    std::size_t                block_term = 0, isotropic_term = 0;
    std::vector<FunctionalRow> rows;
    bool                       some_change = false;
    // H, with the rows of all ranks.
    Matrix functional_matrix;
    Vector body_diagonal;
    // Work space.
    mutable Vector free, product, observed, acting;
  };
} // namespace Ricochet

#endif
