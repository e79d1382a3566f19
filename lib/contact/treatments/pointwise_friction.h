// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_pointwise_friction_h
#define ricochet_contact_treatments_pointwise_friction_h

#include <contact/laws/regularised_friction.h>

#include <vector>

namespace Ricochet
{
  /**
   * Friction with a tangential compliance in the points of a pointwise treatment,
   * with the mean slip rate of the step: the state of stick and slip of each point
   * during Newton's method.
   */
  class PointwiseFriction
  {
  public:
    /// @param law of Coulomb or another one; none if it does not exist.
    /// @param augmentation r_0 (Pa); r_0 / h_T distinguishes stick from slip.
    PointwiseFriction(const RegularisedFriction &law, const double augmentation)
      : law(law)
      , augmentation(augmentation)
    {}

    /// Whether there is friction.
    bool
    exists() const
    {
      return law.exists();
    }

    void
    begin_stage(const double step_length)
    {
      time_step  = step_length;
      n_iterates = 0;
    }

    /// Make the state of the last evaluate() the next iterate.
    void
    accept_iterate()
    {
      ++n_iterates;
      accepted_branch = branch;
    }

    /// Begin the evaluation of a state with @p n_points, none of which is
    /// pressed.
    void
    begin_evaluation(const unsigned int n_points);

    /// Choose stick or slip in point @p p, which has the @p pressure (Pa), has
    /// slipped by @p slip (m) over the step, and belongs to a cell of diameter @p
    /// cell_diameter (m).
    void
    evaluate(const unsigned int          p,
             const double                pressure,
             const dealii::Tensor<1, 3> &slip,
             const double                cell_diameter);

    /// The pressure that point @p p had in evaluate() (Pa).
    double
    pressure(const unsigned int p) const
    {
      return pressures[p];
    }

    bool
    sticks(const unsigned int p) const
    {
      return branch[p].sticks;
    }

    /// Traction (Pa); equal to the law's at a solution.
    dealii::Tensor<1, 3>
    traction(const unsigned int p) const
    {
      return law.traction_on(branch[p], pressures[p], slip_rate[p]);
    }

    /// Difference between traction() and the law's traction (Pa).
    dealii::Tensor<1, 3>
    error(const unsigned int p) const
    {
      return traction(p) - law.traction(pressures[p], slip_rate[p]);
    }

    /// Derivatives of traction() with respect to the slip over the step (Pa/m) and
    /// to the pressure.
    struct Derivatives
    {
      dealii::Tensor<2, 3> with_slip;
      dealii::Tensor<1, 3> with_pressure;
    };

    Derivatives
    derivatives(const unsigned int p) const;

    /// Energy dissipated in point @p p per area over the step (J/m^2).
    double
    dissipation(const unsigned int p) const
    {
      return time_step * (traction(p) * slip_rate[p]);
    }

    /// Traction (Pa) that round-off @p way_round_off (m) in the displacement
    /// increment of a sticking point can cause.
    double
    round_off(const double way_round_off) const
    {
      return law.tangential_compliance / time_step * way_round_off;
    }

  private:
    const RegularisedFriction law;
    const double              augmentation;
    double                    time_step  = 0.;
    unsigned int              n_iterates = 0;
    std::vector<double>       pressures;
    // Slip rates (m/s).
    std::vector<dealii::Tensor<1, 3>>        slip_rate;
    std::vector<RegularisedFriction::Branch> branch, accepted_branch;
  };
} // namespace Ricochet

#endif
