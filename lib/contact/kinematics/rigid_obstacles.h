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
    RigidObstacles(ContactPointEvaluator evaluator, const bool some_move);

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
    add_passing(const Vector &begin,
                const Vector &end,
                const double  begin_time,
                const double  end_time,
                ContactSteps &steps) override;

    double
    predicted_gap(const unsigned int p) const override;

    double
    gap_round_off(const unsigned int p, const double gap) const override;

    double
    way_round_off(const unsigned int p) const override
    {
      return gap_round_off(p, 0.);
    }

  private:
    void
    place_obstacles() override;

    double
    gap(const unsigned int          p,
        const dealii::Tensor<1, 3> &displacement,
        const Instant               instant) const override;

    void
    compute_geometry(const unsigned int p) override;

    const bool some_move;
    // Each obstacle once, and where it is during the step.
    std::vector<const RigidObstacle *> obstacles;
    std::vector<RigidObstacle::Step>   steps;
    /// For friction at an instant, their motion around it, over #length_around (s).
    std::vector<RigidObstacle::Step> around;
    double                           length_around = 0.;
    std::vector<unsigned int>        obstacle_of_point;
  };
} // namespace Ricochet

#endif
