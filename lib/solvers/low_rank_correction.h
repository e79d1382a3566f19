// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_low_rank_correction_h
#define ricochet_solvers_low_rank_correction_h

#include <base/types.h>
#include <solvers/factorisation.h>
#include <solvers/functionals.h>

#include <deal.II/base/index_set.h>
#include <deal.II/lac/lapack_full_matrix.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * Solves with a factored matrix A after a change of low rank: with the columns
   * u_i of U ("directions") and v_j of V ("observables"), both sparse and the
   * same for ever, and a sparse matrix C of change,
   *
   *     (A + U C V^T)^{-1} = A^{-1} - A^{-1} U (1 + C V^T A^{-1} U)^{-1} C V^T
   *     A^{-1},
   *
   * the formula of Sherman, Morrison and Woodbury. Only directions with a row in
   * C count. The observables V^T A^{-1} u_i of their columns are solved for once
   * and kept: a new state of contact costs a small dense factorisation, a
   * solution two back-substitutions.
   *
   * All functions are collective. The small dense system lives on all ranks.
   */
  class LowRankCorrection
  {
  public:
    using Index = dealii::types::global_dof_index;
    /// A row of C: places of observables, see first_observable(), and values.
    using Row = FunctionalRow;

    struct Options
    {
      /**
       * Columns are solved for in groups of this size along the order of the
       * directions. Which group a column belongs to does not depend on what
       * happened before, so that a resumed run repeats its digits. 0: solve for
       * the columns needed and keep them whole, which saves the second
       * back-substitution but serves for a single state.
       */
      unsigned int group_size = 16;
      /// A is symmetric, and the observables are the directions but for rows
      /// that A decouples.
      bool is_symmetric = false;
    };

    /**
     * @param directions of this rank; they may have entries of other ranks.
     * @param order of the directions, by which they are expected to be needed.
     * @param observables of this rank; they may look at other ranks.
     */
    LowRankCorrection(const dealii::IndexSet    &owned,
                      const MPI_Comm             communicator,
                      Functionals                directions,
                      const std::vector<double> &order,
                      Functionals                observables,
                      const Options             &options);

    /// Place of this rank's first observable among those of all ranks.
    unsigned int
    first_observable() const
    {
      return my_first_observable;
    }

    /// The factored matrix is a new one: forget the columns.
    void
    forget_columns();

    /// The change C, one row for each direction of this rank.
    void
    set_change(const std::vector<Row> &my_rows, Factorisation &factorisation);

    void
    solve(const Vector  &right_hand_side,
          Vector        &solution,
          Factorisation &factorisation);

  private:
    /// Add the direction at this place, if it is this rank's (to be compressed
    /// by the caller).
    void
    add_direction(const unsigned int place,
                  const double       factor,
                  Vector            &vector) const;

    void
    solve_columns(const std::vector<unsigned int> &places,
                  Factorisation                   &factorisation);

    void
    solve_missing_columns(Factorisation &factorisation);

    /// Values of all observables of @p vector, on all ranks.
    void
    observe(const Vector &vector, std::vector<double> &values);

    /// Whether C is diagonal and positive, and A symmetric.
    bool
    is_positive() const;

    void
    factorise_small();

    const MPI_Comm    communicator;
    const Functionals directions, observables;
    const Options     options;
    unsigned int      n_observables = 0, my_first_observable = 0;
    // Place of each direction of this rank in their common order, and the
    // other way round (-1: another rank's).
    std::vector<unsigned int> place_of_direction;
    std::vector<int>          direction_at_place;
    std::vector<int>          local_index;
    // By place: observables of the column, empty if not solved for; the column
    // itself, if those are kept.
    std::vector<std::vector<double>> columns;
    std::vector<Vector>              whole_columns;

    // The rows of C of this rank as given last, and of all ranks by place of
    // the direction.
    std::vector<Row>                                  my_last_rows;
    bool                                              has_change = false;
    std::vector<unsigned int>                         changed;
    std::vector<Row>                                  rows;
    std::unique_ptr<dealii::LAPACKFullMatrix<double>> small;
    bool                                              small_is_positive = false;
    Vector                                            ghosted, work;
    std::vector<double>                               observed;
  };
} // namespace Ricochet

#endif
