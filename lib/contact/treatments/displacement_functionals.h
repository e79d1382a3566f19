// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_displacement_functionals_h
#define ricochet_contact_treatments_displacement_functionals_h

#include <contact/kinematics/contact_points.h>
#include <solvers/tangent.h>

#include <deal.II/base/tensor.h>

#include <vector>

namespace Ricochet
{
  /**
   * The functionals through which pointwise contact acts where its directions turn, as
   * obstacles are curved or move: the unknowns of the displacement, one by one, and in
   * each point its stress pressure and its multiplier, where the law has them. They stay
   * the same, whatever the directions.
   */
  class DisplacementFunctionals
  {
  public:
    /// What a point has of all functionals: three components of its displacement, then
    /// stress pressure and multiplier; or a force on each of them.
    static constexpr unsigned int stress_pressure = 3, multiplier = 4;
    using OfPoint = dealii::Tensor<1, 5>;
    /// Derivatives of forces (rows) with respect to what a point has.
    using TangentOfPoint = dealii::Tensor<2, 5>;

    explicit DisplacementFunctionals(const ContactPoints &points);

    const ContactStructure::ActsThrough &
    all() const
    {
      return acts_through;
    }

    /// What point @p p has of @p values of all functionals of this rank.
    OfPoint
    in_point(const unsigned int p, const std::vector<double> &values) const;

    /// Add the @p force in point @p p to the coefficients of the functionals.
    void
    add(const unsigned int   p,
        const OfPoint       &force,
        std::vector<double> &coefficients) const;

    /// Add its derivatives to the rows of the functionals, entries one behind the other,
    /// several ones for one column.
    void
    add(const unsigned int          p,
        const TangentOfPoint       &tangent,
        std::vector<FunctionalRow> &rows) const;

  private:
    /// A functional that a point has, times a factor, in this place of OfPoint.
    struct Term
    {
      unsigned int functional, place;
      double       factor;
    };

    std::vector<std::vector<Term>> terms;
    ContactStructure::ActsThrough  acts_through;
  };
} // namespace Ricochet

#endif
