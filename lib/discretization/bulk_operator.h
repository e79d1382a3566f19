// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_bulk_operator_h
#define ricochet_discretization_bulk_operator_h

#include <base/types.h>

#include <deal.II/base/exceptions.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The internal forces of a body as a time scheme sees them: a two-point
   * operator of the old and the new displacement, independent of contact and of
   * the scheme. A scheme asks either for the force at one point (collocation),
   * elastic and viscous, or for that of a step: the discrete derivative of the
   * stored energy between two points, whose work is exactly the difference of
   * stored energy, plus the viscous force at the rate of the step.
   *
   * All vectors are system vectors without ghost values; all functions are
   * collective. The force at an inadmissible state (an element is inverted) is
   * not a number; failure() then says why.
   */
  class BulkOperator
  {
  public:
    virtual ~BulkOperator() = default;

    /// @p force = derivative of the stored energy at @p solution (N).
    virtual void
    force(const Vector &solution, Vector &force) const = 0;

    /// @p tangent += @p factor times the derivative of force(). For a linear body its
    /// tangent_terms().
    virtual void
    add_tangent(const double  factor,
                const Vector &solution,
                Matrix       &tangent) const;

    /// Whether there are viscous forces.
    virtual bool
    is_viscous() const
    {
      return false;
    }

    /// @p result = the viscous force (N) at @p solution, where the velocity is
    /// (solution - rate_origin) / rate_time.
    /// @pre is_viscous()
    virtual void
    viscous_force(const Vector & /*rate_origin*/,
                  const Vector & /*solution*/,
                  const double /*rate_time*/,
                  Vector & /*result*/) const
    {
      AssertThrow(false, dealii::ExcMessage("This body is not viscous."));
    }

    /// @p tangent += @p factor times the derivative of viscous_force() with respect to
    /// the solution, by which the velocity changes, too. For a linear body its
    /// viscous_tangent_terms().
    /// @pre is_viscous()
    virtual void
    add_viscous_tangent(const double  factor,
                        const Vector &rate_origin,
                        const Vector &solution,
                        const double  rate_time,
                        Matrix       &tangent) const;

    /// The terms of add_viscous_tangent() for a linear body.
    virtual MatrixSum
    viscous_tangent_terms(const double /*factor*/,
                          const double /*rate_time*/) const
    {
      return {};
    }

    /// @p force (N) with force . (new - old) = energy(new) - energy(old) +
    /// viscous_dissipation(old, new, time_step).
    virtual void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  time_step,
               Vector       &force) const = 0;

    /// @p tangent += the derivative of step_force() with respect to the new
    /// solution. For a linear body its step_tangent_terms().
    virtual void
    add_step_tangent(const Vector &old_solution,
                     const Vector &new_solution,
                     const double  time_step,
                     Matrix       &tangent) const;

    /// The terms of add_tangent() for a linear body; the matrices live as long
    /// as this object. Empty if the body is not linear.
    virtual MatrixSum
    tangent_terms(const double /*factor*/) const
    {
      return {};
    }

    /// The same for add_step_tangent().
    virtual MatrixSum
    step_tangent_terms(const double /*time_step*/) const
    {
      return {};
    }

    /// Stored energy (J).
    virtual double
    energy(const Vector &solution) const = 0;

    /// The same for each part of the body, see Body::part().
    virtual std::vector<double>
    energies_of_parts(const Vector &solution) const = 0;

    /// Viscous dissipation (J) in a step; never negative.
    virtual double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const = 0;

    /// The largest sum of absolute values in a row of the tangent at rest (N/m):
    /// times a rounding error of the displacement it is one of the force.
    virtual double
    stiffness_scale() const = 0;

    /// Force (N) that rounding can cause where strains are differences from a body
    /// at rest: l2 norm over all unknowns.
    virtual double
    strain_round_off() const
    {
      return 0.;
    }

    /// Round-off (J) in a stored energy that is a small difference of large terms, as that
    /// of small strains from invariants near to those of a body at rest.
    virtual double
    energy_round_off() const
    {
      return 0.;
    }

    /// Whether the tangents are the same for all states, so that factorisations
    /// can be reused.
    virtual bool
    is_linear() const = 0;

    /// Position of a corner at which a cell is inverted, although det F is
    /// positive in its quadrature points, where stresses are evaluated; empty
    /// if there is none, or if it is not checked.
    virtual std::string
    inverted_corner(const Vector & /*solution*/) const
    {
      return {};
    }

    /// Why the last force was not a number; empty if it was one.
    virtual std::string
    failure() const
    {
      return {};
    }
  };
} // namespace Ricochet

#endif
