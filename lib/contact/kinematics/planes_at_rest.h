// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_planes_at_rest_h
#define ricochet_contact_kinematics_planes_at_rest_h

#include <contact/kinematics/contact_kinematics.h>

namespace Ricochet
{
  /// Against planes that do not move the gap is an affine function of the unknowns,
  /// and all directions are constant.
  class PlanesAtRest : public ContactKinematics
  {
  public:
    using ContactKinematics::ContactKinematics;

    bool
    has_constant_rows() const override
    {
      return true;
    }

    bool
    has_moving_obstacles() const override
    {
      return false;
    }

    double
    predicted_gap(const unsigned int p) const override
    {
      return gap(p, old_displacement(p), Instant::begin) +
        .5 * time_step * (geometries[p].normal * displacement_of(rate[p]));
    }

    double
    gap_round_off(const unsigned int p, const double gap) const override
    {
      return Ricochet::gap_round_off(points()[p], gap);
    }

    double
    way_round_off(const unsigned int p) const override
    {
      return gap_round_off(p, displacement(p).norm());
    }

  private:
    double
    gap(const unsigned int          p,
        const dealii::Tensor<1, 3> &displacement,
        const Instant /*instant*/) const override
    {
      return points()[p].initial_gap + geometries[p].normal * displacement;
    }

    void
    compute_geometry(const unsigned int p) override
    {
      // Difference of displacements instead of positions, to avoid cancellation
      // far from the origin.
      PointGeometry &geometry = geometries[p];
      geometry.relative_way   = displacement_with_slip(p);
      geometry.gap_increment =
        geometry.normal * (displacement(p) - old_displacement(p));
    }
  };
} // namespace Ricochet

#endif
