// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_contact_subspace_h
#define ricochet_solvers_contact_subspace_h

#include <solvers/tangent_operator.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * The unknowns that contact acts on, where it is so stiff that multigrid takes many
   * iterations: smoothers damp what is stiff in single unknowns, and functionals couple
   * those of a cell. The tangent between these unknowns is factored, on all ranks, for
   * contact is small against bodies; a solution there before and after a cycle leaves
   * multigrid what it is good at.
   *
   * Literature: algebraic multigrid with filtering, arXiv:2505.18576 (2025).
   */
  class ContactSubspace
  {
  public:
    ContactSubspace();

    ~ContactSubspace();

    /**
     * Take contact as it is in @p tangent now. Where it is not stiff, or where the tangent
     * between its unknowns cannot be factored, the subspace has no unknowns. Collective,
     * like all functions.
     * Of a tangent that is not symmetric it is the symmetric part.
     */
    void
    update(const TangentOperator &tangent);

    bool
    is_empty() const
    {
      return unknowns.empty();
    }

    /// An unknown of this rank: its number here, and its place in the subspace.
    struct Own
    {
      unsigned int number, place;
    };

    const std::vector<Own> &
    own_unknowns() const
    {
      return own;
    }

    /// Solve in the subspace. @param values on this rank's places (N), zero elsewhere;
    /// become the solution in all places (m).
    void
    solve(std::vector<double> &values) const;

    /// Number of places.
    unsigned int
    size() const
    {
      return unknowns.size();
    }

  private:
    using Index = dealii::types::global_dof_index;

    /// CHOLMOD's.
    struct Factor;

    /// Of a matrix between places.
    struct Entry
    {
      int    row, column;
      double value;
    };

    /// Whether contact makes most of the diagonal somewhere.
    static bool
    is_stiff(const TangentOperator &tangent);

    /// The unknowns of this rank's functionals that act or are acted on.
    static std::vector<Index>
    unknowns_of_contact(const TangentOperator &tangent);

    /// What this rank has of the tangent.
    std::vector<Entry>
    own_entries(const TangentOperator &tangent) const;

    int
    place_of(const Index unknown) const;

    // Sorted; not those that are clamped.
    std::vector<Index>      unknowns;
    std::vector<Own>        own;
    std::unique_ptr<Factor> factor;
    MPI_Comm                communicator = MPI_COMM_NULL;
  };
} // namespace Ricochet

#endif
