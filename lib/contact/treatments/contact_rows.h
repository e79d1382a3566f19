// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_rows_h
#define ricochet_contact_treatments_contact_rows_h

#include <contact/kinematics/contact_points.h>
#include <contact/kinematics/point_vector.h>
#include <solvers/tangent.h>

#include <vector>

namespace Ricochet
{
  /// Unit vectors normal to @p normal in a space of @p n_axes dimensions: two, one, or
  /// none.
  std::vector<dealii::Tensor<1, 3>>
  tangent_directions(const dealii::Tensor<1, 3> &normal,
                     const unsigned int          n_axes);

  /**
   * The rows of the contact Jacobian H through which pointwise contact acts, and their
   * relation to the observables of a point (PointVector): a value of H u changes these
   * along some directions, and a force on them has a coefficient for each row.
   *
   * The rows are constant in a run. Where the directions of contact are constant, too,
   * a point has one row for each direction (add_direction()); otherwise each unknown of
   * its displacement is one (add_observables()).
   */
  class ContactRows
  {
  public:
    explicit ContactRows(const ContactPoints &points);

    /// Append a row: the observables of point @p p, times @p direction.
    /// @param trial change of the observables with the value of the row.
    /// @param test coefficient of the row in a force on the observables.
    void
    add_direction(const unsigned int p,
                  const PointVector &direction,
                  const PointVector &trial,
                  const PointVector &test);

    /// Append rows for each unknown of the displacement of point @p p, shared by all
    /// points that depend on it, and for its stress pressure and its multiplier, if
    /// there are any.
    void
    add_observables(const unsigned int p);

    const ContactStructure::ActsThrough &
    all() const
    {
      return rows;
    }

    /// Change of the observables of point @p p with the @p values of all rows of this
    /// rank.
    PointVector
    in_point(const unsigned int p, const std::vector<double> &values) const;

    /// Add the @p force on the observables of point @p p to the coefficients of the rows.
    void
    add(const unsigned int   p,
        const PointVector   &force,
        std::vector<double> &coefficients) const;

    /// Add the derivatives of such a force, as entries of a matrix between rows; the
    /// same entry may occur several times.
    void
    add(const unsigned int          p,
        const PointMatrix          &tangent,
        std::vector<FunctionalRow> &entries) const;

  private:
    /// Relation of a row and an observable, by this factor.
    struct Term
    {
      unsigned int row, place;
      double       factor;
    };

    /// Append a row with the coefficient @p value(k) for each coefficient k of a point.
    /// @return whether any of them is not zero.
    template <typename Value>
    bool
    add_row(const ContactPoint &point, const Value &value);

    const ContactPoints &points;
    // Terms for each point: its observables in terms of rows, and rows in terms of
    // forces.
    std::vector<std::vector<Term>> trial_terms, test_terms;
    // Row of each unknown of the displacement, if it has one.
    std::map<dealii::types::global_dof_index, unsigned int> row_of_unknown;
    ContactStructure::ActsThrough                           rows;
  };
} // namespace Ricochet

#endif
