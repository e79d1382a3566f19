// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_planes_at_rest_h
#define ricochet_contact_kinematics_planes_at_rest_h

#include <contact/kinematics/contact_kinematics.h>

namespace Ricochet
{
  /// Before planes that do not move the gap is an affine function of the unknowns,
  /// and all directions are those of the start.
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

    void
    begin_step(const ContactStart               &start,
               std::vector<ContactPointState<>> &old_states) override;

    void
    begin_instant(const double /*time*/) override
    {}

    void
    evaluate(const Vector                     &solution,
             std::vector<ContactPointState<>> &states) override;

    void
    displace(const std::vector<dealii::Tensor<1, 3>> &displacements,
             std::vector<ContactPointState<>>        &states) override;

    double
    predicted_gap(const unsigned int p) const override
    {
      return old_state[p].gap +
        .5 * time_step * (geometries[p].normal * mean_velocity[p]);
    }

    /// Nothing changes.
    void
    update_geometry(const unsigned int /*p*/) override
    {}

    double
    gap_round_off(const unsigned int p, const double gap) const override
    {
      return Ricochet::gap_round_off(points()[p], gap);
    }

    double
    way_round_off(const unsigned int p) const override
    {
      return gap_round_off(p, displacement[p].norm());
    }

  private:
    /// Bring the ways of all points to #displacement.
    void
    find_ways();

    double                           time_step = 0.;
    std::vector<ContactPointState<>> old_state;
  };
} // namespace Ricochet

#endif
