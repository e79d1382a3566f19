// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_rigid_obstacles_h
#define ricochet_contact_kinematics_rigid_obstacles_h

#include <contact/kinematics/contact_kinematics.h>

namespace Ricochet
{
  /**
   * Rigid obstacles of any shape and motion. Directions are discrete gradients of
   * the gap over the step, see RigidObstacle, and change with each iterate.
   */
  class RigidObstacles : public ContactKinematics
  {
  public:
    RigidObstacles(ContactPointEvaluator evaluator,
                   const Needs          &needs,
                   const bool            some_move);

    bool
    has_constant_rows() const override
    {
      return false;
    }

    bool
    has_moving_obstacles() const override
    {
      return some_move;
    }

    void
    begin_step(const ContactStart               &start,
               std::vector<ContactPointState<>> &old_states) override;

    void
    begin_instant(const double time) override;

    void
    evaluate(const Vector                     &solution,
             std::vector<ContactPointState<>> &states) override;

    void
    displace(const std::vector<dealii::Tensor<1, 3>> &displacements,
             std::vector<ContactPointState<>>        &states) override;

    void
    add_passing(const Vector &begin,
                const Vector &end,
                const double  begin_time,
                const double  end_time,
                ContactSteps &steps) override;

    double
    predicted_gap(const unsigned int p) const override;

    /// The rows of most points are never needed: they are far away.
    void
    update_geometry(const unsigned int p) override;

    double
    gap_round_off(const unsigned int p, const double gap) const override;

    double
    way_round_off(const unsigned int p) const override
    {
      return gap_round_off(p, 0.);
    }

  private:
    double
    gap(const unsigned int          p,
        const Placement            &placement,
        const dealii::Tensor<1, 3> &point_displacement) const;

    const bool some_move;
    double     time_step = 0., end_time = 0.;
    // Forces are those of an instant.
    bool instant = true;
    // Each obstacle once, and where it is during the step.
    std::vector<const RigidObstacle *> obstacles;
    std::vector<RigidObstacle::Step>   steps;
    std::vector<unsigned int>          obstacle_of_point;
    std::vector<bool>                  up_to_date;
  };
} // namespace Ricochet

#endif
