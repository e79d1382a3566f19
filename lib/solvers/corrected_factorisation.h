// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_corrected_factorisation_h
#define ricochet_solvers_corrected_factorisation_h

#include <base/types.h>
#include <solvers/factorisation.h>

#include <deal.II/lac/lapack_full_matrix.h>

#include <functional>
#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * A tangent as one factored matrix, that of the body with all contact points
   * open, plus a correction in the few rows where contact is closed.
   *
   * With B the matrix of the body, N the rows of (tangent - B) that are not
   * zero, and P their places, the solution of tangent x = f is
   *
   *     x = B^{-1} (f - P y),   (I + N B^{-1} P) y = N B^{-1} f
   *
   * (Sherman, Morrison and Woodbury): two back-substitutions and a small dense
   * system. The columns of B^{-1} P are solved for when a row changes for the
   * first time and kept, restricted to the unknowns that rows of contact couple
   * to; so neither opening nor closing nor a nonlinear contact law costs a
   * factorisation. Where B is only nearly the matrix that was factored (the
   * symmetric part of another), the same formulas give a preconditioner.
   */
  class CorrectedFactorisation
  {
  public:
    using Index = Factorisation::Index;

    /**
     * @param factorisation of the body's matrix.
     * @param contact_rows all rows that contact may change, the same list on all
     * ranks, in the order in which contact is expected to spread.
     * @param group_size columns that will serve for many states of contact are
     * solved for in groups of this size along contact_rows. Which group a column
     * belongs to does not depend on what happened before, so that a resumed run
     * repeats its digits. 0: solve for the columns needed, all at once, and keep
     * them whole, which saves the second back-substitution.
     * @param factorising gets the time that it takes to factor and to solve for
     * columns added (s).
     */
    CorrectedFactorisation(std::unique_ptr<Factorisation> factorisation,
                           const std::vector<Index>      &contact_rows,
                           const unsigned int             group_size,
                           double                        &factorising);

    ~CorrectedFactorisation();

    /**
     * A new matrix of the body.
     *
     * @param assemble_body called with an empty matrix, or an old one to be
     * overwritten.
     * @param complete_open adds what contact adds when all points are open.
     * It is not factored yet: until factorise() is called, an older
     * factorisation serves as that of a nearby matrix.
     */
    void
    set_body(const std::function<void(Matrix &)> &assemble_body,
             const std::function<void(Matrix &)> &complete_open);

    /// Factor the matrix of the body. @return whether it could be done.
    bool
    factorise();

    /// A new state of contact. @param complete adds contact to the matrix of the
    /// body.
    void
    set_contact(const std::function<void(Matrix &)> &complete);

    void
    solve(const Vector &right_hand_side, Vector &solution);

    /// The tangent of the last set_contact().
    const Matrix &
    matrix() const
    {
      return tangent;
    }

    /// Number of columns that were solved for since the last set_body().
    unsigned int
    n_columns() const;

  private:
    struct OwnedRow
    {
      /// Place in #contact_rows.
      unsigned int place;
      int          local;
      int          n_entries;
      /// Values in the three matrices.
      double *body = nullptr, *open = nullptr, *tangent = nullptr;
      /// Place in the region of each entry.
      std::vector<unsigned int> region;
    };

    void
    find_region();

    /// Solve for the columns at these @p places of contact_rows.
    void
    solve_columns(const std::vector<unsigned int> &places);

    void
    solve_changed_columns();

    /// Values of @p vector in the region, on all ranks.
    void
    extract_region(const Vector &vector, double *values) const;

    // Body alone, with open contact (this one is factored), with contact. Before
    // the factorisation, which refers to it to its end.
    Matrix                               body, open, tangent;
    const std::unique_ptr<Factorisation> factorisation;
    const std::vector<Index>             contact_rows;
    const unsigned int                   group_size;
    double                              &factorising;
    std::vector<OwnedRow>                rows;
    // The unknowns that contact rows couple to: number, and local index of the
    // owned ones with their place.
    unsigned int                              region_size = 0;
    std::vector<std::pair<int, unsigned int>> owned_region;
    // Solved columns by place in contact_rows; empty if not solved for. Whole
    // ones are only kept when they serve for one state.
    std::vector<Vector>                                       whole_columns;
    std::vector<std::vector<double>>                          columns;
    std::vector<unsigned int>                                 changed;
    std::unique_ptr<dealii::LAPACKFullMatrix<double>>         small;
    std::vector<std::vector<std::pair<unsigned int, double>>> changes;
    std::vector<unsigned int>                                 owned_changed;
    Vector                                                    work;
    mutable std::vector<double>                               region_values;
  };
} // namespace Ricochet

#endif
