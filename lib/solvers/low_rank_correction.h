// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_low_rank_correction_h
#define ricochet_solvers_low_rank_correction_h

#include <base/ghosted_vector.h>
#include <base/types.h>
#include <solvers/factorisation.h>
#include <solvers/functional_products.h>
#include <solvers/positive_system.h>
#include <solvers/tangent.h>
#include <solvers/unsymmetric_system.h>

#include <deal.II/base/index_set.h>

#include <map>
#include <optional>
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
   * C count. A change U E U^T A, which takes rows of A out, may come besides, where the
   * observables are the directions; then 1 + E U^T U takes the place of 1.
   *
   * The observables V^T A^{-1} u_i of their columns are solved for once
   * and kept: a new state of contact costs a small dense factorisation, a
   * solution two back-substitutions.
   *
   * Newton's method on a problem that is linear but for what acts along the
   * directions needs no solutions in between: with x = x_0 - A^{-1} U z all it
   * asks for are the observables V^T x_0 - (V^T A^{-1} U) z and solutions with the
   * small matrix, see add_compliance() and solve_small().
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
      unsigned int group_size = 64;
      /// A is symmetric but for rows that it decouples; then the observables have
      /// to be the directions.
      bool is_symmetric = false;
      /// Coefficients are of one kind: see UnsymmetricSystem.
      bool may_be_single = false;
    };

    /**
     * @param directions of this rank, and those of other ranks in which it may
     * change the matrix; they may have entries of other ranks. With their order, by which
     * they are expected to be needed.
     * @param observables of this rank; they may look at other ranks. None: the
     * directions.
     */
    LowRankCorrection(const dealii::IndexSet              &owned,
                      const MPI_Comm                       communicator,
                      const ContactStructure::ActsThrough &directions,
                      std::optional<Functionals>           observables,
                      const Options                       &options);

    /// The place of direction @p d of this rank, or of another one (see
    /// ContactStructure::ActsThrough), among those of all ranks, in their order.
    unsigned int
    place(const unsigned int d) const
    {
      return place_of_direction[d];
    }

    /// Number of directions on all ranks.
    unsigned int
    n_places() const
    {
      return direction_at_place.size();
    }

    /// The factored matrix is a new one: forget the columns.
    void
    forget_columns();

    /// The change C, one row for each direction that this rank knows, which is what it
    /// has of the row.
    /// @param my_excess_rows those of E; empty for none on any rank. Directions with
    /// such a row have no products with those of other ranks.
    /// @param may_update use the dense factorisation of the last one, see
    /// PositiveSystem. Without it, the digits do not depend on what came before.
    void
    set_change(const std::vector<Row> &my_rows,
               Factorisation          &factorisation,
               const bool              may_update     = false,
               const std::vector<Row> &my_excess_rows = {});

    /// @return the number of solutions with the factorisation that it took.
    unsigned int
    solve(const Vector  &right_hand_side,
          Vector        &solution,
          Factorisation &factorisation);

    /// Values of all observables of @p vector, on all ranks.
    /// @param values gets the first ones, as many as it has.
    void
    observe(const Vector &vector, std::vector<double> &values);

    /// Whether columns are made of half solutions, which takes half of the work and
    /// only a part of the factor. They are known only where those of the
    /// observables are.
    bool
    uses_halves(const Factorisation &factorisation) const
    {
      return options.is_symmetric && options.group_size > 0 &&
        !own_observables && factorisation.has_halves();
    }

    /// Solve for the columns at the first @p n places, unless they are known.
    void
    solve_first_columns(const unsigned int n, Factorisation &factorisation);

    /// Values of the first observables of the solution of which the @p half is known,
    /// from their columns; as many as @p values has. @pre uses_halves(), and the columns
    /// are known; so below.
    void
    observe_half(const std::vector<double> &half,
                 std::vector<double>       &values,
                 const Factorisation       &factorisation) const;

    /// Subtract the half solution for the directions of this rank with their @p
    /// coefficients from @p half.
    void
    subtract_half(const std::vector<double> &coefficients,
                  std::vector<double>       &half,
                  const Factorisation       &factorisation) const;

    /// Add the sum of this rank's directions with their @p coefficients to @p
    /// vector.
    void
    add_directions(const std::vector<double> &coefficients,
                   Vector                    &vector) const;

    /// Add the observables of A^{-1} U @p coefficients, times @p factor, to
    /// @p values, which may be the first ones only; the coefficients are those of
    /// all directions, by place.
    void
    add_compliance(const double               factor,
                   const std::vector<double> &coefficients,
                   std::vector<double>       &values,
                   Factorisation             &factorisation);

    /**
     * Solve (1 + E U^T U + C V^T A^{-1} U) z = @p coefficients - C @p values with the change
     * of the last set_change(); coefficients of all directions by place, which
     * become z.
     */
    void
    solve_small(std::vector<double>       &coefficients,
                const std::vector<double> &values,
                Factorisation             &factorisation);

  private:
    /// Add the direction at this place, if it is this rank's (to be compressed
    /// by the caller).
    void
    add_direction(const unsigned int place,
                  const double       factor,
                  Vector            &vector) const;

    /// The same for this rank's direction @p d.
    void
    add_own_direction(const unsigned int d,
                      const double       factor,
                      Vector            &vector) const;

    void
    solve_columns(const std::vector<unsigned int> &places,
                  Factorisation                   &factorisation);

    /// Solve for those of the columns at @p places that are not known yet.
    void
    solve_missing_columns(const std::vector<unsigned int> &places,
                          Factorisation                   &factorisation);

    /// Those of all ranks at these places, with all of their entries.
    Functionals
    directions_at(const std::vector<unsigned int> &places) const;

    /// Solve for a group of columns by half solutions.
    void
    solve_half_columns(const unsigned int               group,
                       const std::vector<unsigned int> &places,
                       Factorisation                   &factorisation);

    /// A row of E U^T U from one of E.
    Row
    taken_by(const Row &excess_row);

    /// Whether C is diagonal and positive, and A symmetric; and E U^T U diagonal and
    /// not below -1.
    bool
    is_positive() const;

    void
    factorise_small(const bool may_update);

    /// Solve the small system.
    void
    solve_with_small(dealii::Vector<double> &vector);

    /// What #small is made of.
    UnsymmetricSystem::Terms
    small_terms() const
    {
      return {changed, taken_rows, rows, columns};
    }

    const MPI_Comm    communicator;
    const Functionals directions;
    // None: the directions.
    const std::optional<Functionals> own_observables;
    const Functionals               &observables;
    const Options                    options;
    unsigned int                     n_observables = 0;
    // Place of each observable of this rank among those of all ranks.
    std::vector<unsigned int> place_of_observable;
    // Place of each direction that this rank knows in their common order; and its own
    // the other way round (-1: another rank's).
    std::vector<unsigned int> place_of_direction;
    std::vector<int>          direction_at_place;
    std::vector<int>          local_index;
    // Place of each entry of the directions among the unknowns of this rank; -1:
    // another rank's.
    std::vector<int> owned_index;
    // By place: observables of the column, empty if not solved for; the column
    // itself, if those are kept.
    std::vector<std::vector<double>> columns;
    std::vector<Vector>              whole_columns;
    // By group.
    std::map<unsigned int, Factorisation::HalfColumns> half_columns;

    // The rows of C and E of this rank as given last, and those of C, E and E U^T U of
    // all ranks by place of the direction.
    std::vector<Row>          my_last_rows, my_last_excess_rows;
    bool                      has_change = false;
    std::vector<unsigned int> changed;
    std::vector<Row>          rows, excess_rows, taken_rows;
    FunctionalProducts        products;
    UnsymmetricSystem         small;
    PositiveSystem            positive_small;
    bool                      small_is_positive = false;
    GhostedVector             ghosted;
    Vector                    work;
    std::vector<double>       observed;
  };
} // namespace Ricochet

#endif
