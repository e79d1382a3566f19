// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_contact_operator_h
#define ricochet_contact_contact_operator_h

#include <base/types.h>
#include <contact/contact_law.h>
#include <contact/contact_points.h>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>

namespace Ricochet
{
  /// What the ledger wants to know of one part of the contact boundary.
  struct ContactSummary
  {
    /// Area of the part (m^(dim-1)); 1 in 1D.
    double area = 0.;
    /// Total contact force, the integral of contact_pressure (N).
    double force = 0.;
    /// Mean gap (m).
    double mean_gap = 0.;
    /// Largest penetration (m), 0 without.
    double max_penetration = 0.;
    /// Mean of the pressure that the treatment itself stands for (Pa): [P_N]_-
    /// for Nitsche, the multiplier, the reaction over the boundary mass.
    double contact_pressure = 0.;
    /// Mean of the pressure of the body's own stress, -sigma_n(u_h) (Pa).
    double stress_pressure = 0.;
    /// Number of contact points that are active.
    unsigned int active_points = 0;
  };

  /**
   * A contact treatment as time schemes and Newton's method see it. It adds its
   * forces to (or, for active sets, takes rows out of) a residual that already
   * holds everything else.
   *
   * All vectors are system vectors without ghost values; all functions are
   * collective.
   */
  class ContactOperator
  {
  public:
    virtual ~ContactOperator() = default;

    /**
     * Begin the solution of one stage.
     *
     * @param old_solution unknowns at the beginning of the step.
     * @param old_contact_force contact force there, from which active sets
     * start.
     * @param weight factor of the new contact force in the residual.
     */
    virtual void
    begin_stage(const Vector &old_solution,
                const Vector &old_contact_force,
                const double  weight) = 0;

    /// Complete @p residual at @p solution.
    virtual void
    complete_residual(const Vector &solution, Vector &residual) = 0;

    /// Complete @p tangent at the solution of the last complete_residual().
    virtual void
    complete_tangent(Matrix &tangent) const = 0;

    /**
     * A number that is the same on all ranks and changes whenever the tangent
     * does, or nothing if the tangent changes with every state.
     */
    virtual std::optional<std::uint64_t>
    tangent_signature() const = 0;

    /// The number of active contact points at the last complete_residual(), and
    /// of all, for Newton's table.
    virtual std::string
    active_set_description() const = 0;

    /// The contact force (N, without the stage's weight and without the
    /// multipliers' own equations) at the solution of the last
    /// complete_residual().
    virtual const Vector &
    contact_force() const = 0;

    /// The contact force at @p solution outside of any stage: for the initial
    /// acceleration and for integrators of their own.
    virtual void
    force_at(const Vector &solution, Vector &force) = 0;

    /// Energy stored by the treatment at @p solution (J): the difference
    /// between modified and mechanical energy. 0 where there is none.
    virtual double
    potential(const Vector &solution) = 0;

    /// Per row, the factor that makes the residual a force: 1 for
    /// displacements, a stiffness for multipliers.
    virtual const Vector &
    row_scaling() const = 0;

    /// By boundary id, at a solved state.
    virtual std::map<dealii::types::boundary_id, ContactSummary>
    summary(const Vector &solution, const Vector &contact_force) = 0;
  };

  /**
   * Values of gap, stress pressure and multiplier in the contact points of this
   * rank: the one place where global unknowns meet contact points.
   */
  class ContactPointEvaluator
  {
  public:
    template <int dim>
    ContactPointEvaluator(const Body<dim> &body, ContactPoints points)
      : points(std::move(points))
      , ghosted(body.make_ghosted_vector())
      , communicator(body.communicator)
    {
      find_local_indices();
    }

    /// Evaluate all points at @p solution into @p states.
    void
    evaluate(const Vector &solution, std::vector<ContactPointState<>> &states);

    /// Add @p force of point @p p, weighted, to @p vector (to be compressed by
    /// the caller).
    void
    add(const unsigned int p, const ContactPointForce<> &force, Vector &vector);

    /// Add @p tangent of point @p p, times @p factor, to @p matrix.
    void
    add(const unsigned int         p,
        const double               factor,
        const ContactPointTangent &tangent,
        Matrix                    &matrix) const;

    const std::vector<ContactPoint> &
    contact_points() const
    {
      return points.points;
    }

    const ContactPoints &
    coefficients() const
    {
      return points;
    }

  private:
    void
    find_local_indices();

    const ContactPoints points;
    Vector              ghosted;
    std::vector<int>    local_index;
    // Work space of add().
    std::vector<double>         values;
    mutable std::vector<double> local_matrix;

  public:
    const MPI_Comm communicator;
  };
} // namespace Ricochet

#endif
