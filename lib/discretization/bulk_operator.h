// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_bulk_operator_h
#define ricochet_discretization_bulk_operator_h

#include <base/types.h>

namespace Ricochet
{
  /**
   * The internal forces of a body as a time scheme sees them: a two-point
   * operator of the old and the new displacement, that knows nothing of
   * contact nor of the scheme. A scheme asks either for the force at one point
   * (collocation) or for the discrete derivative of the stored energy between
   * two points, whose work is exactly the difference of stored energy.
   *
   * All vectors are system vectors without ghost values.
   */
  class BulkOperator
  {
  public:
    virtual ~BulkOperator() = default;

    /// @p force = derivative of the stored energy at @p solution (N).
    virtual void
    force(const Vector &solution, Vector &force) const = 0;

    /// @p force with force . (new - old) = energy(new) - energy(old).
    virtual void
    discrete_derivative(const Vector &old_solution,
                        const Vector &new_solution,
                        Vector       &force) const = 0;

    /// @p tangent += @p factor times the derivative of force().
    virtual void
    add_tangent(const double  factor,
                const Vector &solution,
                Matrix       &tangent) const = 0;

    /// Stored energy (J).
    virtual double
    energy(const Vector &solution) const = 0;

    /// Whether the tangent is the same for all states, so that factorisations
    /// can be kept.
    virtual bool
    is_linear() const = 0;
  };
} // namespace Ricochet

#endif
