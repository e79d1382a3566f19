// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_coulomb_friction_h
#define ricochet_contact_coulomb_friction_h

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

    /// Its derivatives: with respect to the slip rate (within the tangent
    /// plane, whose projection @p tangent_plane is) and to the pressure.
    void
    derivatives(const double                pressure,
                const dealii::Tensor<1, 3> &slip_rate,
                const dealii::Tensor<2, 3> &tangent_plane,
                dealii::Tensor<2, 3>       &with_slip_rate,
                dealii::Tensor<1, 3>       &with_pressure) const
    {
      const double speed = slip_rate.norm();
      if (sticks(pressure, speed))
        {
          with_slip_rate = tangential_compliance * tangent_plane;
          with_pressure  = 0.;
          return;
        }
      if (!(speed > 0.))
        {
          with_slip_rate = 0.;
          with_pressure  = 0.;
          return;
        }
      const dealii::Tensor<1, 3> direction = slip_rate / speed;
      with_slip_rate                       = coefficient * pressure / speed *
        (tangent_plane - outer_product(direction, direction));
      with_pressure = coefficient * direction;
    }
  };
} // namespace Ricochet

#endif
