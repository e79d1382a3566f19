// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_coulomb_friction_h
#define ricochet_contact_laws_coulomb_friction_h

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>

namespace Ricochet
{
  /**
   * Coulomb's friction, regularised by a tangential compliance (paper A,
   * (2.11)): with the slip rate v in the tangent plane,
   *
   *     traction = c_tau v              if c_tau |v| < mu pressure (stick),
   *     traction = mu pressure v/|v|    otherwise (slip).
   *
   * The traction stands on the side of the internal forces: its power,
   * traction . v, is what friction takes away and is never negative.
   */
  struct CoulombFriction
  {
    /// mu
    double coefficient = 0.;
    /// c_tau (Pa s/m)
    double tangential_compliance = 0.;

    template <typename Number>
    bool
    sticks(const Number &pressure, const Number &slip_speed) const
    {
      return tangential_compliance * slip_speed < coefficient * pressure;
    }

    /**
     * The law again, with stick and slip told apart by @p trial instead of the
     * slip rate: a trial = traction + r (v - traction/c_tau) of the last
     * iterate, with a small r. At a solution both are the same, for any r > 0;
     * on the way there a point that should stick is not thrown from one
     * direction of slip into the other (the primal-dual active set of Hüeber,
     * Stadler and Wohlmuth 2008, for the regularised law).
     */
    struct Branch
    {
      bool sticks = true;
      /// Direction of slip.
      dealii::Tensor<1, 3> direction;
      /// The direction is that of the slip rate and changes with it.
      bool follows_slip_rate = false;
    };

    Branch
    choose_branch(const double                pressure,
                  const dealii::Tensor<1, 3> &slip_rate,
                  const dealii::Tensor<1, 3> &trial) const
    {
      Branch       branch;
      const double size = trial.norm();
      branch.sticks     = size < coefficient * pressure || size == 0.;
      if (branch.sticks)
        return branch;
      branch.follows_slip_rate = slip_rate * trial > 0.;
      branch.direction =
        branch.follows_slip_rate ? slip_rate / slip_rate.norm() : trial / size;
      return branch;
    }

    /// The traction (Pa) on @p branch; the same as traction() at a solution.
    dealii::Tensor<1, 3>
    traction_on(const Branch               &branch,
                const double                pressure,
                const dealii::Tensor<1, 3> &slip_rate) const
    {
      return branch.sticks ? tangential_compliance * slip_rate
                           : coefficient * pressure * branch.direction;
    }

    /// The traction (Pa) at a @p pressure (Pa, not negative) and a slip rate
    /// (m/s).
    template <typename Number>
    dealii::Tensor<1, 3, Number>
    traction(const Number                       &pressure,
             const dealii::Tensor<1, 3, Number> &slip_rate) const
    {
      using std::sqrt;
      dealii::Tensor<1, 3, Number> result;
      Number                       square(0.);
      for (unsigned int c = 0; c < 3; ++c)
        square += slip_rate[c] * slip_rate[c];
      if (!(square > 0.))
        return result;
      const Number speed = sqrt(square);
      Number       factor(tangential_compliance);
      if (!sticks(pressure, speed))
        factor = coefficient * pressure / speed;
      for (unsigned int c = 0; c < 3; ++c)
        result[c] = factor * slip_rate[c];
      return result;
    }

    /// The derivatives of traction_on(): with respect to the slip rate (within
    /// the tangent plane, whose projection @p tangent_plane is) and to the
    /// pressure.
    void
    derivatives(const Branch               &branch,
                const double                pressure,
                const dealii::Tensor<1, 3> &slip_rate,
                const dealii::Tensor<2, 3> &tangent_plane,
                dealii::Tensor<2, 3>       &with_slip_rate,
                dealii::Tensor<1, 3>       &with_pressure) const
    {
      with_slip_rate = 0.;
      with_pressure  = 0.;
      if (branch.sticks)
        {
          with_slip_rate = tangential_compliance * tangent_plane;
          return;
        }
      with_pressure = coefficient * branch.direction;
      if (branch.follows_slip_rate)
        with_slip_rate = coefficient * pressure / slip_rate.norm() *
          (tangent_plane - outer_product(branch.direction, branch.direction));
    }
  };
} // namespace Ricochet

#endif
