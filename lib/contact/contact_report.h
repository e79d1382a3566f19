// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_contact_report_h
#define ricochet_contact_contact_report_h

#include <base/types.h>
#include <contact/kinematics/point_evaluator.h>

#include <functional>
#include <limits>
#include <map>
#include <vector>

namespace Ricochet
{
  /// Summary of one part of the contact boundary for the ledger.
  struct ContactSummary
  {
    /// Area of the part (m^(dim-1)); 1 in 1D.
    double area = 0.;
    /// Total contact force, the integral of contact_pressure (N).
    double force = 0.;
    /// Mean gap (m).
    double mean_gap = 0.;
    /// Smallest gap (m), that of a boundary without points being infinite.
    double smallest_gap = std::numeric_limits<double>::infinity();
    /// Largest penetration (m), 0 without.
    double max_penetration = 0.;
    /// Mean of the pressure of the treatment itself (Pa): [P_N]_- for Nitsche,
    /// the multiplier, the reaction over the boundary mass.
    double contact_pressure = 0.;
    /// Mean of the pressure of the body's own stress, -sigma_n(u_h) (Pa).
    double stress_pressure = 0.;
    /// Number of contact points that are active.
    unsigned int active_points = 0;

    /// Add a point to the sums: means are weighted sums until
    /// reduce_summaries() divides them.
    void
    add(const ContactPoint &point,
        const double        gap,
        const double        point_force,
        const bool          is_active);

    /// Become the summary of both this part of the boundary and another one.
    void
    unite(const ContactSummary &other);
  };

  /// A contact point of this rank at an instant, for output.
  struct ContactPointValues
  {
    dealii::types::boundary_id boundary_id = 0;
    /// With the displacement (m).
    dealii::Tensor<1, 3> position;
    /// m
    double gap = 0.;
    /// Normal force, positive in compression (N).
    double force = 0.;
    /// Part of the contact boundary that the point stands for (m^(dim-1)); 1 in 1D.
    double area      = 0.;
    bool   is_active = false;
  };

  /// A solved state, as far as reports on contact depend on it.
  struct ContactInstant
  {
    /// Unknowns.
    const Vector &solution;
    /// Contact force (N); for two-point treatments, the mean over the last
    /// step.
    const Vector &contact_force;
    /// s
    double time = 0.;
    /// The parts of contact_force that belong to several contacts; null where
    /// there is only one.
    const std::vector<Vector> *shares = nullptr;
    /// Called by ContactReport::summary() for each point of this rank that has a gap: the sums
    /// of what it gets are those of the summary. May be left out.
    std::function<void(const ContactPointValues &)> report = {};
  };

  /// Summaries by boundary id.
  using ContactSummaries = std::map<dealii::types::boundary_id, ContactSummary>;

  /// Reports on contact at a solved state, outside of any step: a step that was
  /// begun ends. All functions are collective.
  class ContactReport
  {
  public:
    virtual ~ContactReport() = default;

    /// The contact force (N) at @p solution and @p time: for the initial
    /// acceleration and for integrators of their own.
    virtual void
    force_at(const Vector &solution, const double time, Vector &force) = 0;

    /// Energy stored by the treatment (J): the difference between modified and
    /// mechanical energy. 0 where there is none.
    virtual double
    potential(const Vector &solution, const double time) = 0;

    /// Contact pressure (Pa), as a field for visualisation: the average around
    /// each node of the contact boundary, at the index of the node's first
    /// displacement; zero elsewhere. It depends on the arguments alone: in nodes
    /// it follows from the force, elsewhere it is the law's pressure at the
    /// solution.
    virtual Vector
    pressure_field(const ContactInstant &instant) = 0;

    virtual ContactSummaries
    summary(const ContactInstant &instant) = 0;
  };

  /// Complete the entries of @p my_sums that are means or totals over all
  /// ranks, from weighted sums on each rank.
  ContactSummaries
  reduce_summaries(const ContactSummaries &my_sums,
                   const MPI_Comm          communicator);

  /// Add the weighted stress pressures of @p evaluator to @p sums.
  void
  add_stress_pressure(const Vector             &solution,
                      ContactPointEvaluator    &evaluator,
                      std::vector<PointVector> &work,
                      ContactSummaries         &sums);
} // namespace Ricochet

#endif
