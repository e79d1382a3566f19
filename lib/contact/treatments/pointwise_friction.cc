// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/treatments/pointwise_friction.h>

#include <algorithm>

namespace Ricochet
{
  using dealii::Tensor;

  void
  PointwiseFriction::begin_evaluation(const unsigned int n_points)
  {
    pressures.assign(n_points, 0.);
    slip_rate.assign(n_points, Tensor<1, 3>());
    branch.assign(n_points, {});
  }



  void
  PointwiseFriction::evaluate(const unsigned int  p,
                              const double        pressure,
                              const Tensor<1, 3> &slip,
                              const double        cell_diameter)
  {
    pressures[p]                         = pressure;
    slip_rate[p]                         = slip / time_step;
    const Tensor<1, 3>         rate      = slip_rate[p];
    const double               stiffness = augmentation / cell_diameter;
    RegularisedFriction::Stick stick     = law.creep();
    if (law.has_exact_stick)
      {
        stick.compliance = stick_stiffness * stiffness * time_step;
        if (!at_rest.empty())
          stick.at_rest = at_rest[p];
      }
    Tensor<1, 3> trial = stick(rate);
    if (n_iterates > 0 && accepted_branch.size() == pressures.size())
      {
        // The traction that the last iterate predicts.
        const Tensor<1, 3> predicted =
          law.traction_on(accepted_branch[p], pressure, rate);
        const double r = std::min(stick.compliance, stiffness * time_step);
        trial          = predicted +
          r * (rate - (predicted - stick.at_rest) / stick.compliance);
        // A point whose slip has reversed sticks in between; creep is a branch of its own there.
        const RegularisedFriction::Branch &accepted = accepted_branch[p];
        if (law.has_exact_stick && !accepted.sticks &&
            accepted.direction * trial < 0.)
          trial = 0.;
      }
    branch[p] = law.choose_branch(stick, pressure, rate, trial);
  }



  bool
  PointwiseFriction::change_worst_only(const MPI_Comm communicator)
  {
    if (!law.has_exact_stick || accepted_branch.size() != branch.size())
      return false;
    if (set_iterate != n_iterates)
      {
        set_iterate = n_iterates;
        std::vector<int> sticks;
        for (const RegularisedFriction::Branch &one : accepted_branch)
          sticks.push_back(one.sticks);
        if (sets.returns(global_hash(sticks, communicator)))
          sets_recur = true;
      }
    if (!sets_recur)
      return false;
    // How far the traction would be from that of the law without the change (Pa).
    std::vector<double> errors(branch.size(), 0.);
    double              largest = 0.;
    for (unsigned int p = 0; p < branch.size(); ++p)
      if (pressures[p] > 0. && branch[p].sticks != accepted_branch[p].sticks)
        {
          RegularisedFriction::Branch former = accepted_branch[p];
          former.stick                       = branch[p].stick;
          const Tensor<1, 3> error =
            law.traction_on(former, pressures[p], slip_rate[p]) -
            law.traction(former.stick, pressures[p], slip_rate[p]);
          errors[p] = error.norm();
          largest   = std::max(largest, errors[p]);
        }
    largest = dealii::Utilities::MPI::max(largest, communicator);
    for (unsigned int p = 0; p < branch.size(); ++p)
      if (errors[p] > 0. && errors[p] < largest)
        {
          const RegularisedFriction::Stick stick = branch[p].stick;
          branch[p]                              = accepted_branch[p];
          branch[p].stick                        = stick;
          // Its direction stays, too.
          branch[p].follows_stick = false;
        }
    return true;
  }



  bool
  PointwiseFriction::next_pass(
    const std::function<double(const unsigned int)> &way_round_off,
    const MPI_Comm                                   communicator)
  {
    if (!law.has_exact_stick)
      return false;
    at_rest.resize(pressures.size());
    // Tractions, and how much of their changes is no round-off.
    double largest = 0., change = 0.;
    for (unsigned int p = 0; p < pressures.size(); ++p)
      {
        const Tensor<1, 3> now =
          pressures[p] > 0. ? traction(p) : Tensor<1, 3>();
        largest = std::max(largest, now.norm());
        if (pressures[p] > 0.)
          change = std::max(change,
                            (now - at_rest[p]).norm() -
                              10. * round_off(p, way_round_off(p)));
        at_rest[p] = now;
      }
    largest = dealii::Utilities::MPI::max(largest, communicator);
    change  = dealii::Utilities::MPI::max(change, communicator);
    if (!(change > largest_change * largest))
      return false;
    // With the stiffness S of the body and its inertia, changes fall by S / (S + r).
    const double ratio = n_passes > 0 ? change / last_change : 0.;
    if (ratio >= 1.)
      stick_stiffness *= fastest_growth;
    else if (ratio > enough)
      stick_stiffness *=
        std::min(fastest_growth, ratio / (1. - ratio) / enough);
    stick_stiffness = std::min(stick_stiffness, largest_stiffness);
    last_change     = change;
    forget_sets();
    if (++n_passes == most_passes)
      throw NewtonFailure(
        "The tractions of friction with exact stick still "
        "change after " +
        std::to_string(most_passes) + " passes.");
    return true;
  }



  PointwiseFriction::Derivatives
  PointwiseFriction::derivatives(const unsigned int p) const
  {
    Derivatives derivatives;
    law.derivatives(branch[p],
                    pressures[p],
                    slip_rate[p],
                    Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()),
                    derivatives.with_slip,
                    derivatives.with_pressure);
    derivatives.with_slip /= time_step;
    return derivatives;
  }
} // namespace Ricochet
