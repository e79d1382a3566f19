// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/pointwise_friction.h>

#include <algorithm>

namespace Ricochet
{
  using dealii::Tensor;

  void
  PointwiseFriction::evaluate(const std::vector<ContactPointForce<>> &forces,
                              const ContactKinematics &kinematics)
  {
    const unsigned int n_points = forces.size();
    pressures.resize(n_points);
    slip_rate.assign(n_points, Tensor<1, 3>());
    branch.resize(n_points);
    for (unsigned int p = 0; p < n_points; ++p)
      {
        pressures[p] = positive_part(-forces[p].gap);
        // Where nothing presses, geometry may be that of another state.
        if (kinematics.has_constant_rows() || pressures[p] > 0.)
          slip_rate[p] = kinematics.geometry(p).slip() / time_step;
        const Tensor<1, 3> rate  = slip_rate[p];
        Tensor<1, 3>       trial = law.tangential_compliance * rate;
        if (n_iterates > 0 && accepted_branch.size() == n_points)
          {
            // The traction that the last iterate predicts.
            const Tensor<1, 3> predicted =
              law.traction_on(accepted_branch[p], pressures[p], rate);
            const double r = std::min(law.tangential_compliance,
                                      augmentation * time_step /
                                        kinematics.points()[p].cell_diameter);
            trial =
              predicted + r * (rate - predicted / law.tangential_compliance);
          }
        branch[p] = law.choose_branch(pressures[p], rate, trial);
      }
  }



  PointwiseFriction::Derivatives
  PointwiseFriction::derivatives(const unsigned int       p,
                                 const ContactKinematics &kinematics) const
  {
    Derivatives          derivatives;
    const PointGeometry &geometry = kinematics.geometry(p);
    const bool           constant = kinematics.has_constant_rows();
    law.derivatives(branch[p],
                    pressures[p],
                    slip_rate[p],
                    constant ? tangent_plane(geometry.normal)
                             : Tensor<2, 3>(dealii::unit_symmetric_tensor<3>()),
                    derivatives.with_slip_rate,
                    derivatives.with_pressure);
    // Slip follows the way, and the turning of the plane in which it is.
    if (!constant)
      derivatives.with_slip_rate = derivatives.with_slip_rate *
        (tangent_plane(geometry.normal) * geometry.relative_way_derivative +
         geometry.projection_derivative(geometry.relative_way));
    derivatives.with_slip_rate /= time_step;
    return derivatives;
  }
} // namespace Ricochet
