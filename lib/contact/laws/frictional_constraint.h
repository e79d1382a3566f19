// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_frictional_constraint_h
#define ricochet_contact_laws_frictional_constraint_h

#include <contact/laws/contact_law.h>

#include <deal.II/base/symmetric_tensor.h>

namespace Ricochet
{
  /// State of a point with a constraint.
  enum class ContactStatus
  {
    open,
    /// Closed, without friction or slipping.
    slip,
    stick
  };

  /// Arguments of a FrictionalConstraint in a point. Forces are pressures (Pa), or forces
  /// (N) with a stiffness in N/m.
  template <int n_tangents>
  struct ConstraintState
  {
    /// Positive in compression.
    double pressure = 0.;
    /// Closing (m), which the constraint keeps at zero in a closed point.
    double closing = 0.;
    /// On the side of the internal forces: along the slip.
    dealii::Tensor<1, n_tangents> traction;
    /// Over the step (m).
    dealii::Tensor<1, n_tangents> slip;
  };

  /**
   * The contact condition of a point with Coulomb's friction as one equation for its
   * pressure and one for its traction (Hüeber, Stadler and Wohlmuth 2008; paper B,
   * section 5 and (5.7)),
   *
   *     0 = pressure - [pressure - r closing]_+,
   *     0 = traction - P(traction + r slip),
   *
   * where P projects on the disk with radius mu [pressure]_+, 0 of an open point, and the
   * stiffness r > 0 leaves the solution alone. choose() finds the piece on which a state is, and
   * equations() and derivatives() are those of this piece.
   */
  template <int n_tangents>
  class FrictionalConstraint
  {
  public:
    using Tangential = dealii::Tensor<1, n_tangents>;
    using State      = ConstraintState<n_tangents>;

    /// Whether @p state closes a point, see choose().
    static bool
    closes(const State &state, const double stiffness, const double margin)
    {
      return state.pressure - stiffness * state.closing > margin;
    }

    /// Choose the piece by @p state.
    ///
    /// @param stiffness r. @param coefficient mu; 0 without friction.
    /// @param margin of the trial pressure (Pa) that closes a point; below its negative
    /// one opens.
    /// @param new_sticks whether a point that closes and has no pressure yet sticks.
    void
    choose(const State &state,
           const double stiffness,
           const double coefficient,
           const double margin     = 0.,
           const bool   new_sticks = false)
    {
      r          = stiffness;
      mu         = coefficient;
      own_status = ContactStatus::open;
      if (!closes(state, r, margin))
        return;
      own_status = ContactStatus::slip;
      direction  = 0.;
      ratio      = 0.;
      if (!(mu > 0.))
        return;
      const Tangential trial = state.traction + r * state.slip;
      const double     size  = trial.norm();
      const double     limit = mu * state.pressure;
      if (state.pressure > 0. ? size < limit : new_sticks)
        own_status = ContactStatus::stick;
      else if (size > 0. && limit >= 0.)
        {
          // Also of a point that has just closed, whose friction has no size yet.
          direction = trial / size;
          ratio     = limit / size;
        }
    }

    /// Take another piece; where it slips, in the direction that was chosen last.
    void
    set_status(const ContactStatus status)
    {
      own_status = status;
    }

    ContactStatus
    status() const
    {
      return own_status;
    }

    struct Equations
    {
      double     normal = 0.;
      Tangential tangential;
    };

    /// The two right-hand sides at @p state, on the chosen piece.
    Equations
    equations(const State &state) const
    {
      Equations result{state.pressure, state.traction};
      if (own_status == ContactStatus::open)
        return result;
      result.normal = r * state.closing;
      if (own_status == ContactStatus::stick)
        result.tangential = -r * state.slip;
      else
        result.tangential -= mu * state.pressure * direction;
      return result;
    }

    struct Derivatives
    {
      double                        normal_with_pressure = 1.;
      double                        normal_with_closing  = 0.;
      Tangential                    tangential_with_pressure;
      dealii::Tensor<2, n_tangents> tangential_with_traction,
        tangential_with_slip;
    };

    /// Derivatives of equations() where the piece was chosen.
    Derivatives
    derivatives() const
    {
      const dealii::Tensor<2, n_tangents> one(
        dealii::unit_symmetric_tensor<n_tangents>());
      Derivatives result;
      result.tangential_with_traction = one;
      if (own_status == ContactStatus::open)
        return result;
      result.normal_with_pressure = 0.;
      result.normal_with_closing  = r;
      if (own_status == ContactStatus::stick)
        {
          result.tangential_with_traction = 0.;
          result.tangential_with_slip     = -r * one;
          return result;
        }
      // The direction of slip turns with traction + r slip.
      const dealii::Tensor<2, n_tangents> turning =
        ratio * (one - outer_product(direction, direction));
      result.tangential_with_pressure = -mu * direction;
      result.tangential_with_traction -= turning;
      result.tangential_with_slip = -r * turning;
      return result;
    }

  private:
    double        r = 1., mu = 0.;
    ContactStatus own_status = ContactStatus::open;
    // Direction of slip; and mu pressure over |traction + r slip|, at most 1.
    Tangential direction;
    double     ratio = 0.;
  };
} // namespace Ricochet

#endif
