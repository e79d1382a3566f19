// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_laws_regularised_friction_h
#define ricochet_contact_laws_regularised_friction_h

#include <base/exceptions.h>
#include <base/own_parameter.h>
#include <base/parameter_file.h>
#include <contact/laws/friction_law.h>

#include <deal.II/base/symmetric_tensor.h>

#include <cmath>
#include <memory>
#include <utility>

namespace Ricochet
{
  /**
   * Friction regularised by a tangential compliance (paper A, (2.11)): with the slip
   * rate v in the tangent plane and the limit of a FrictionLaw, of Coulomb's mu pressure,
   *
   *     traction = c_tau v          if c_tau |v| < limit (stick),
   *     traction = limit v/|v|      otherwise (slip).
   *
   * The traction has the sign of the internal forces: its power, traction . v,
   * is the dissipation of friction and never negative.
   *
   * With another traction of the sticking point than c_tau v, see Stick, it is the law of the
   * augmented Lagrangian, whose solution is Coulomb's law without regularisation.
   */
  class RegularisedFriction
  {
  public:
    static constexpr const char *compliance_name = "Tangential compliance";

    static OwnParameters
    parameters()
    {
      return {
        OwnParameter(compliance_name, 1e3)
          .means("Parameter c_tau",
                 "Pa s/m",
                 " of regularised friction: while a point sticks, its traction "
                 "is c_tau times the slip rate (paper A, (2.11)). Used with "
                 "friction by the treatments that regularise it.")
          .by_scale([](const Scales &scales, const ParameterValues &) {
            return std::sqrt(scales.young_modulus * scales.density);
          })
          .belongs_to("regularised friction")};
    }

    /// @throws InputError for a compliance that is not positive.
    static void
    check(const ParameterValues &values)
    {
      if (!(values[compliance_name] > 0.))
        throw InputError("The tangential compliance must be positive; it is " +
                         to_text(values[compliance_name]) + ".");
    }

    /// No friction.
    RegularisedFriction() = default;

    /// @param law null for none. @param tangential_compliance c_tau (Pa s/m)
    /// @param has_exact_stick points that stick do not creep, see PointwiseFriction.
    RegularisedFriction(std::shared_ptr<const FrictionLaw> law,
                        const double tangential_compliance,
                        const bool   has_exact_stick = false)
      : tangential_compliance(tangential_compliance)
      , has_exact_stick(has_exact_stick)
      , law(std::move(law))
    {}

    bool
    exists() const
    {
      return law != nullptr;
    }

    /// The traction of a sticking point as a function of its slip rate. That of a slipping
    /// one has its direction.
    struct Stick
    {
      /// Pa s/m
      double compliance = 0.;
      /// At rest (Pa); zero for regularised friction.
      dealii::Tensor<1, 3> at_rest;

      dealii::Tensor<1, 3>
      operator()(const dealii::Tensor<1, 3> &slip_rate) const
      {
        return at_rest + compliance * slip_rate;
      }
    };

    /// That of regularised friction.
    Stick
    creep() const
    {
      return {tangential_compliance, {}};
    }

    /**
     * The law with stick and slip distinguished by @p trial instead of the slip
     * rate: a trial = traction + r (v - v_s) of the last iterate, where v_s is the rate at which
     * a sticking point would have this traction, with a small r. At a solution both are the same,
     * for any r > 0; during the iterations a sticking point does not alternate between opposite
     * directions of slip (the primal-dual active set of Hüeber, Stadler and
     * Wohlmuth 2008, for the regularised law).
     */
    struct Branch
    {
      bool  sticks = true;
      Stick stick;
      /// Direction of slip.
      dealii::Tensor<1, 3> direction;
      /// The direction is that of #stick and changes with the slip rate.
      bool follows_stick = false;
    };

    Branch
    choose_branch(const Stick                &stick,
                  const double                pressure,
                  const dealii::Tensor<1, 3> &slip_rate,
                  const dealii::Tensor<1, 3> &trial) const
    {
      Branch branch;
      branch.stick      = stick;
      const double size = trial.norm();
      branch.sticks     = size == 0. || size < limit(pressure, slip_rate).value;
      if (branch.sticks)
        return branch;
      const dealii::Tensor<1, 3> sticking = stick(slip_rate);
      branch.follows_stick                = sticking * trial > 0.;
      branch.direction =
        branch.follows_stick ? sticking / sticking.norm() : trial / size;
      return branch;
    }

    /// The traction (Pa) on @p branch; the same as traction() at a solution.
    dealii::Tensor<1, 3>
    traction_on(const Branch               &branch,
                const double                pressure,
                const dealii::Tensor<1, 3> &slip_rate) const
    {
      return branch.sticks
        ? branch.stick(slip_rate)
        : limit(pressure, slip_rate).value * branch.direction;
    }

    /// The traction (Pa) at a @p pressure (Pa, not negative) and a slip rate
    /// (m/s).
    dealii::Tensor<1, 3>
    traction(const Stick                &stick,
             const double                pressure,
             const dealii::Tensor<1, 3> &slip_rate) const
    {
      const dealii::Tensor<1, 3> sticking = stick(slip_rate);
      const double               size     = sticking.norm();
      const double               largest  = limit(pressure, slip_rate).value;
      return size < largest || !(size > 0.) ? sticking
                                            : largest / size * sticking;
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
          with_slip_rate = branch.stick.compliance * tangent_plane;
          return;
        }
      const FrictionLimit own = limit(pressure, slip_rate);
      with_pressure           = own.with_pressure * branch.direction;
      if (branch.follows_stick)
        with_slip_rate = own.value * branch.stick.compliance /
          branch.stick(slip_rate).norm() *
          (tangent_plane - outer_product(branch.direction, branch.direction));
      if (own.with_slip_speed != 0. && slip_rate.norm() > 0.)
        with_slip_rate += own.with_slip_speed *
          outer_product(branch.direction, slip_rate / slip_rate.norm());
    }

    /// c_tau (Pa s/m)
    const double tangential_compliance = 0.;
    const bool   has_exact_stick       = false;

  private:
    FrictionLimit
    limit(const double pressure, const dealii::Tensor<1, 3> &slip_rate) const
    {
      const double        slip_speed = slip_rate.norm();
      const FrictionLimit own        = law->limit(pressure, slip_speed);
      // An iterate that is not finite is no mistake of the law.
      if (own.value < 0.)
        throw NewtonFailure("The friction law has the limit " +
                            to_text(own.value) + " at the pressure " +
                            to_text(pressure) + " and the slip speed " +
                            to_text(slip_speed) + "; it must not be negative.");
      return own;
    }

    const std::shared_ptr<const FrictionLaw> law;
  };
} // namespace Ricochet

#endif
