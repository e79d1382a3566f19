// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_pointwise_friction_h
#define ricochet_contact_treatments_pointwise_friction_h

#include <contact/laws/regularised_friction.h>
#include <contact/treatments/active_set_signature.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <vector>

namespace Ricochet
{
  /**
   * Friction in the points of a pointwise treatment, with the mean slip rate of the step: the
   * state of stick and slip of each point during Newton's method.
   *
   * Points that stick creep by their tangential compliance, or do not slip: with exact stick a
   * stage is solved in passes, each with the tractions of the last one at rest and with a
   * compliance that only affects how many there are (augmented Lagrangian, Simo and Laursen,
   * Computers & Structures 42, 1992, 97-116). Each pass reduces the slip of sticking points by
   * about the ratio of the body's stiffness, with its inertia, to that of stick, which is raised
   * where that is not small. A body that slips as a whole has no stiffness along the surface, so
   * that sets of sticking points may recur: then one point at a time changes.
   */
  class PointwiseFriction
  {
  public:
    /// @param law of Coulomb or another one; none if it does not exist.
    /// @param augmentation r_0 (Pa); r_0 / h_T distinguishes stick from slip.
    PointwiseFriction(const RegularisedFriction &law, const double augmentation)
      : law(law)
      , augmentation(augmentation)
    {}

    /// Whether there is friction.
    bool
    exists() const
    {
      return law.exists();
    }

    void
    begin_stage(const double step_length)
    {
      time_step  = step_length;
      n_iterates = 0;
      n_passes   = 0;
      at_rest.clear();
      stick_stiffness = first_stiffness;
      forget_sets();
    }

    /// Make the state of the last evaluate() the next iterate.
    void
    accept_iterate()
    {
      ++n_iterates;
      accepted_branch = branch;
    }

    /// Begin the evaluation of a state with @p n_points, none of which is
    /// pressed.
    void
    begin_evaluation(const unsigned int n_points);

    /// Choose stick or slip in point @p p, which has the @p pressure (Pa), has
    /// slipped by @p slip (m) over the step, and belongs to a cell of diameter @p
    /// cell_diameter (m).
    void
    evaluate(const unsigned int          p,
             const double                pressure,
             const dealii::Tensor<1, 3> &slip,
             const double                cell_diameter);

    /// Let one point at a time change between stick and slip if sets recur; after evaluate() of
    /// all points. @return whether points may have another state now. Collective.
    bool
    change_worst_only(const MPI_Comm communicator);

    /**
     * Begin another pass with the tractions of the last one, unless sticking points do not
     * slip. Collective.
     *
     * @param way_round_off round-off in the displacement increment of each point (m).
     * @throws NewtonFailure if they still do after #most_passes.
     */
    bool
    next_pass(const std::function<double(const unsigned int)> &way_round_off,
              const MPI_Comm                                   communicator);

    /// The pressure that point @p p had in evaluate() (Pa).
    double
    pressure(const unsigned int p) const
    {
      return pressures[p];
    }

    bool
    sticks(const unsigned int p) const
    {
      return branch[p].sticks;
    }

    /// Traction (Pa); equal to the law's at a solution.
    dealii::Tensor<1, 3>
    traction(const unsigned int p) const
    {
      return law.traction_on(branch[p], pressures[p], slip_rate[p]);
    }

    /// Difference between traction() and the law's traction (Pa).
    dealii::Tensor<1, 3>
    error(const unsigned int p) const
    {
      return traction(p) -
        law.traction(branch[p].stick, pressures[p], slip_rate[p]);
    }

    /// Derivatives of traction() with respect to the slip over the step (Pa/m) and
    /// to the pressure.
    struct Derivatives
    {
      dealii::Tensor<2, 3> with_slip;
      dealii::Tensor<1, 3> with_pressure;
    };

    Derivatives
    derivatives(const unsigned int p) const;

    /// Energy dissipated in point @p p per area over the step (J/m^2).
    double
    dissipation(const unsigned int p) const
    {
      return time_step * (traction(p) * slip_rate[p]);
    }

    /// Traction (Pa) that round-off @p way_round_off (m) in the displacement
    /// increment of the sticking point @p p can cause.
    double
    round_off(const unsigned int p, const double way_round_off) const
    {
      return branch[p].stick.compliance / time_step * way_round_off;
    }

  private:
    void
    forget_sets()
    {
      sets.seen.clear();
      sets_recur  = false;
      set_iterate = 0;
    }

    /// Stiffness of exact stick as a multiple of r_0 / h_T: in the first passes, bounds, and the
    /// ratio of changes of tractions from which on it is raised.
    static constexpr double first_stiffness = 10., largest_stiffness = 1e10,
                            fastest_growth = 10., enough = 1e-2;
    /// Largest change of a traction, relative to the largest of them, in the last pass.
    static constexpr double       largest_change = 1e-10;
    static constexpr unsigned int most_passes    = 40;

    const RegularisedFriction law;
    const double              augmentation;
    double                    time_step  = 0.;
    unsigned int              n_iterates = 0, n_passes = 0;
    double                    stick_stiffness = first_stiffness;
    /// Change of the tractions in the last pass (Pa).
    double              last_change = 0.;
    std::vector<double> pressures;
    /// Tractions of the last pass (Pa); none in the first one, and without exact stick.
    std::vector<dealii::Tensor<1, 3>> at_rest;
    // Slip rates (m/s).
    std::vector<dealii::Tensor<1, 3>>        slip_rate;
    std::vector<RegularisedFriction::Branch> branch, accepted_branch;
    /// Sets of sticking points in this pass up to the iterate #set_iterate.
    FormerPatterns sets;
    bool           sets_recur  = false;
    unsigned int   set_iterate = 0;
  };
} // namespace Ricochet

#endif
