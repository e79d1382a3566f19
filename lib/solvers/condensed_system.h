// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_solvers_condensed_system_h
#define ricochet_solvers_condensed_system_h

#include <base/types.h>
#include <solvers/functional_norm.h>
#include <solvers/functionals.h>
#include <solvers/tangent.h>

#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * The matrix K of a linear body as seen by the functionals f_i through which
   * contact acts: solutions x = x_0 - K^{-1} sum_i z_i f_i of
   *
   *     K x - b + sum_i z_i f_i = 0,   z_i = contact force of (f_j x)_j,
   *
   * are found by their coefficients z alone, with the compliance f_i K^{-1} f_j,
   * which is solved for once and kept.
   *
   * Functionals have places, the same on all ranks; vectors of all functionals are
   * by place. All functions are collective.
   */
  class CondensedSystem
  {
  public:
    virtual ~CondensedSystem() = default;

    /// K, with what contact adds besides Tangent::contact_change.
    virtual const Matrix &
    body_matrix() const = 0;

    /// The functionals that this rank knows.
    virtual const ContactStructure::ActsThrough &
    acts_through() const = 0;

    /// Number of functionals on all ranks.
    virtual unsigned int
    n_functionals() const = 0;

    /// Number of functionals that this rank has numbers for: its own, and those of other
    /// ranks behind them (see ContactStructure::ActsThrough).
    virtual unsigned int
    n_known() const = 0;

    /// Place of functional @p f, which may be one of another rank.
    virtual unsigned int
    place(const unsigned int f) const = 0;

    /// Begin with the solution of the body alone, K^{-1} @p right_hand_side.
    /// @throws NewtonFailure
    virtual void
    begin(const Vector &right_hand_side) = 0;

    /// The values of the functionals of the body's solution: those of the first
    /// places, as many as @p values has.
    virtual void
    observe(std::vector<double> &values) = 0;

    /// @p solution = that of the body less K^{-1} times the sum of this rank's
    /// functionals with their @p coefficients. @throws NewtonFailure
    virtual void
    finish(const std::vector<double> &coefficients, Vector &solution) = 0;

    /// Add the sum of this rank's functionals with their @p coefficients to @p
    /// vector.
    virtual void
    add_functionals(const std::vector<double> &coefficients,
                    Vector                    &vector) const = 0;

    /// l2 norm of that sum, of all ranks, each entry times that of @p scaling (null for
    /// 1). @param work of the layout of the unknowns; may be overwritten.
    double
    norm_of_functionals(const std::vector<double> &coefficients,
                        const Vector              *scaling,
                        Vector                    &work);

    /// @return @p vector along this rank's functionals: its products with them.
    virtual std::vector<double>
    along_functionals(const Vector &vector) = 0;

    /// Add @p factor times the compliance times @p coefficients to @p values, which
    /// may be those of the first places only.
    virtual void
    add_compliance(const double               factor,
                   const std::vector<double> &coefficients,
                   std::vector<double>       &values) = 0;

    /// With the derivatives @p change (see Tangent::contact_change) of the
    /// coefficients with respect to the values of the functionals, and @p excess_change
    /// (see Tangent::contact_excess_change) with respect to what the residual leaves
    /// over along them, solve
    ///
    ///     (1 + excess_change products + change compliance) z
    ///       = @p coefficients - change @p values
    ///
    /// with the products f_i . f_j; the coefficients become z.
    /// @throws NewtonFailure when the matrix is singular.
    virtual void
    solve_contact(const std::vector<FunctionalRow> &change,
                  const std::vector<FunctionalRow> &excess_change,
                  std::vector<double>              &coefficients,
                  const std::vector<double>        &values) = 0;

  private:
    // Known when it is first asked for.
    std::optional<FunctionalNorm> functional_norm;
  };
} // namespace Ricochet

#endif
