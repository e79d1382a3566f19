// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_contact_subspace_h
#define ricochet_solvers_contact_subspace_h

#include <solvers/tangent_operator.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * The contact dofs where contact is so stiff that multigrid takes many iterations:
   * smoothers damp stiffness in single unknowns, and rows of the contact Jacobian
   * couple the unknowns of a cell. The tangent between these unknowns is factored, on
   * all ranks, as contact is small against bodies; a solution there before and after a
   * cycle removes the error components that multigrid reduces slowly.
   *
   * Literature: algebraic multigrid with filtering, arXiv:2505.18576 (2025).
   */
  class ContactSubspace
  {
  public:
    ContactSubspace();

    ~ContactSubspace();

    /**
     * Set up for contact as it is in @p tangent now. Where contact is not stiff, or
     * where the tangent between its unknowns cannot be factored, the subspace has no
     * unknowns. Of a tangent that is not symmetric the symmetric part is taken.
     * Collective, like all functions.
     */
    void
    update(const TangentOperator &tangent);

    bool
    is_empty() const
    {
      return unknowns.empty();
    }

    /// An unknown of this rank: its local number, and its index in the
    /// subspace.
    struct Own
    {
      unsigned int number, place;
    };

    const std::vector<Own> &
    own_unknowns() const
    {
      return own;
    }

    /// Solve in the subspace. @param values forces at this rank's indices (N), zero
    /// elsewhere; become the solution at all indices (m).
    void
    solve(std::vector<double> &values) const;

    /// Number of unknowns of the subspace.
    unsigned int
    size() const
    {
      return unknowns.size();
    }

  private:
    using Index = dealii::types::global_dof_index;

    /// CHOLMOD's factor.
    struct Factor;

    /// An entry of a matrix between indices of the subspace.
    struct Entry
    {
      int    row, column;
      double value;
    };

    /// Whether contact dominates the diagonal somewhere.
    static bool
    is_stiff(const TangentOperator &tangent);

    /// The unknowns of this rank's rows of the contact Jacobian that enter the
    /// tangent.
    static std::vector<Index>
    unknowns_of_contact(const TangentOperator &tangent);

    /// This rank's entries of the tangent.
    std::vector<Entry>
    own_entries(const TangentOperator &tangent) const;

    int
    place_of(const Index unknown) const;

    // Indices of the unknowns, sorted; without clamped ones.
    std::vector<Index>      unknowns;
    std::vector<Own>        own;
    std::unique_ptr<Factor> factor;
    MPI_Comm                communicator = MPI_COMM_NULL;
  };
} // namespace Ricochet

#endif
