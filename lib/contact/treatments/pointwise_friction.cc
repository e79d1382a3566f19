// SPDX-License-Identifier: LGPL-2.1-or-later
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
    pressures[p]             = pressure;
    slip_rate[p]             = slip / time_step;
    const Tensor<1, 3> rate  = slip_rate[p];
    Tensor<1, 3>       trial = law.tangential_compliance * rate;
    if (n_iterates > 0 && accepted_branch.size() == pressures.size())
      {
        // The traction that the last iterate predicts.
        const Tensor<1, 3> predicted =
          law.traction_on(accepted_branch[p], pressure, rate);
        const double r = std::min(law.tangential_compliance,
                                  augmentation * time_step / cell_diameter);
        trial = predicted + r * (rate - predicted / law.tangential_compliance);
      }
    branch[p] = law.choose_branch(pressure, rate, trial);
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
