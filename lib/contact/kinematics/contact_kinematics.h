// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_contact_kinematics_h
#define ricochet_contact_kinematics_contact_kinematics_h

#include <contact/energy_promise.h>
#include <contact/kinematics/point_evaluator.h>
#include <contact/laws/contact_law.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /// The beginning of a step or stage: the history that contact needs.
  struct ContactStart
  {
    /// Unknowns at the beginning of the step.
    const Vector &solution;
    /// Contact force there (N), from which active sets start.
    const Vector &contact_force;
    /// Mean velocity of the step before (m/s), for predictors of the gap.
    const Vector &mean_velocity;
    /// Length of the step (s), over which slip is counted; 0 for schemes whose
    /// contact force is that of an instant.
    double time_step = 0.;
    /// The end of the step, or the instant (s).
    double end_time = 0.;
    /// The parts of contact_force that belong to several contacts; null where
    /// there is only one.
    const std::vector<Vector> *shares = nullptr;
    /// For the friction of an instant: its velocity is (displacement - rate_origin) /
    /// rate_time, so that slip is counted from there (m). Null for that of a step.
    const Vector *rate_origin = nullptr;
    /// s
    double rate_time = 0.;

    /// The time in which slip adds up (s).
    double
    slip_time() const
    {
      return rate_origin ? rate_time : time_step;
    }
  };

  /// Geometry in a point over a step, as laws and conditions may use it.
  /// Derivatives are with respect to the point at the end of the step.
  struct PointGeometry
  {
    /// Unit vector along the contact force, towards the body.
    dealii::Tensor<1, 3> normal;
    /// Derivative of the direction D = |D| normal of the force (1/m), needed by
    /// Newton's method beside the stiffness of the law.
    dealii::Tensor<2, 3> direction_derivative;
    /// |D|: 1, except for terms of second order in the step.
    double direction_length = 1.;
    /// Gradient of the gap.
    dealii::Tensor<1, 3> gap_gradient;
    /// Change of the gap (m).
    double gap_increment = 0.;
    /// Displacement increment of the point less that of the obstacle there (m), since
    /// the beginning of the step or ContactStart::rate_origin; slip is its part across the
    /// normal.
    dealii::Tensor<1, 3> relative_way;
    /// Derivative of #relative_way (1).
    dealii::Tensor<2, 3> relative_way_derivative;

    /// Derivative of #normal (1/m).
    dealii::Tensor<2, 3>
    normal_derivative() const
    {
      return tangent_plane(normal) * direction_derivative / direction_length;
    }

    /// m
    dealii::Tensor<1, 3>
    slip() const
    {
      return tangent_plane(normal) * relative_way;
    }

    /// Derivative of the part of a vector v across the normal, times that vector:
    /// (I - n n^T)' v.
    dealii::Tensor<2, 3>
    projection_derivative(const dealii::Tensor<1, 3> &v) const
    {
      const dealii::Tensor<2, 3> turning = normal_derivative();
      return -(normal * v) * turning - outer_product(normal, v * turning);
    }
  };

  /**
   * The geometry of contact: how gap, slip and the direction of the force follow
   * from the unknowns, for laws and conditions that are independent of how they
   * are computed.
   *
   * The force of a point is its pressure times a direction D, and its work over a
   * step the pressure times D . (displacement increment). So the conjugate gap
   * increment is D . (displacement increment relative to the obstacle). All
   * kinematics satisfy that to round-off, and their increment is the difference
   * of the gaps.
   */
  class ContactKinematics
  {
  public:
    explicit ContactKinematics(ContactPointEvaluator evaluator);

    virtual ~ContactKinematics() = default;

    /// Whether directions are constant: then the contribution of contact to a
    /// tangent depends on the laws' branches alone.
    virtual bool
    has_constant_rows() const = 0;

    /// Whether an obstacle moves, which does work on the body.
    virtual bool
    has_moving_obstacles() const = 0;

    /// Begin a step, over which its forces act, and evaluate its beginning. With a
    /// step of no length, @p start is an instant, and forces act along the normals
    /// there.
    void
    begin_step(const ContactStart               &start,
               std::vector<ContactPointState<>> &old_states);

    /// Extrapolate with the @p mean_velocity (m/s) of the step before, see
    /// predicted_gap(); after begin_step().
    void
    predict(const Vector &mean_velocity);

    /// Begin an instant, outside of any step.
    void
    begin_instant(const double time);

    /// Gap, stress pressure and multiplier of all points at @p solution, the end
    /// of the step; geometry() follows.
    void
    evaluate(const Vector &solution, std::vector<ContactPointState<>> &states);

    /// As above, with @p values of the observables of all points.
    void
    evaluate(const std::vector<PointVector>   &values,
             std::vector<ContactPointState<>> &states);

    /// The observables of all points in the last evaluate().
    const std::vector<PointVector> &
    observables() const
    {
      return current;
    }

    /// Count in @p steps the points that pass through an obstacle from @p begin to
    /// @p end (m), at @p begin_time and @p end_time (s), and are in front of it at
    /// both. Planes are left out, as no path leads through them.
    virtual void
    add_passing(const Vector & /*begin*/,
                const Vector & /*end*/,
                const double /*begin_time*/,
                const double /*end_time*/,
                ContactSteps & /*steps*/)
    {}

    /// The gap in the middle of the step by extrapolation with the mean
    /// velocity of the step before (B (3.7)); after predict().
    virtual double
    predicted_gap(const unsigned int p) const = 0;

    /// Bring geometry() of the point @p p to the state of the last evaluate(). The
    /// geometry of most points is never needed, as they are far away.
    void
    update_geometry(const unsigned int p)
    {
      if (up_to_date[p])
        return;
      up_to_date[p] = true;
      compute_geometry(p);
    }

    /// Valid after update_geometry().
    const PointGeometry &
    geometry(const unsigned int p) const
    {
      return geometries[p];
    }

    /// Round-off (m) in the @p gap of point @p p.
    virtual double
    gap_round_off(const unsigned int p, const double gap) const = 0;

    /// Round-off (m) in the displacement increment of point @p p.
    virtual double
    way_round_off(const unsigned int p) const = 0;

    const std::vector<ContactPoint> &
    points() const
    {
      return evaluator.contact_points();
    }

    /// The position of point @p p in the last evaluate() (m).
    dealii::Tensor<1, 3>
    position(const unsigned int p) const
    {
      return points()[p].reference_position + displacement(p);
    }

    /// The normal force of @p force at the node @p p, positive in compression
    /// (N); after update_geometry().
    double
    nodal_normal_force(const unsigned int p, const Vector &force) const
    {
      return -(geometries[p].normal * evaluator.at_node(p, force));
    }

    ContactPointEvaluator evaluator;

  protected:
    enum class Instant
    {
      begin,
      end
    };

    /// Place the obstacles as at the beginning and the end of the step.
    virtual void
    place_obstacles()
    {}

    /// The gap of point @p p, displaced by @p displacement (m), at one end of the step.
    virtual double
    gap(const unsigned int          p,
        const dealii::Tensor<1, 3> &displacement,
        const Instant               instant) const = 0;

    /// Bring #geometries of point @p p to #current.
    virtual void
    compute_geometry(const unsigned int p) = 0;

    /// Displacement of a point at the end of the step, and at its beginning (m).
    dealii::Tensor<1, 3>
    displacement(const unsigned int p) const
    {
      return displacement_of(current[p]);
    }
    dealii::Tensor<1, 3>
    old_displacement(const unsigned int p) const
    {
      return displacement_of(old[p]);
    }

    /// The displacement of a point since where slip is counted from (m).
    dealii::Tensor<1, 3>
    displacement_with_slip(const unsigned int p) const
    {
      return displacement(p) -
        displacement_of(rate_time > 0. ? rate_origin[p] : old[p]);
    }

    // Length and end of the step (s); the length is zero in an instant.
    double time_step = 0., end_time = 0.;
    /// See ContactStart; 0 without a rate origin (s).
    double                     rate_time = 0.;
    std::vector<PointGeometry> geometries;
    // Observables at the end and the beginning of the step, and predicted rates.
    std::vector<PointVector> current, old, rate;

  private:
    /// The states of points with these @p observables.
    void
    find_states(const std::vector<PointVector>   &observables,
                const Instant                     instant,
                std::vector<ContactPointState<>> &states) const;

    std::vector<bool> up_to_date;
    // See ContactStart.
    std::vector<PointVector> rate_origin;
  };

  /// The kinematics for the obstacles of the @p points: planes at rest, or any
  /// rigid obstacles.
  template <int dim>
  std::unique_ptr<ContactKinematics>
  make_kinematics(const Body<dim> &body, ContactPoints points);
} // namespace Ricochet

#endif
