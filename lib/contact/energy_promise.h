// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_energy_promise_h
#define ricochet_contact_energy_promise_h

#include <deal.II/base/point.h>

#include <limits>
#include <map>
#include <string>

namespace Ricochet
{
  /**
   * The promise of a contact treatment: what happens in each step to
   *
   *     total = energy + contact potential - works from outside + dissipation,
   *
   * where dissipation is that of friction, viscosity and the time scheme. The balance
   * of energy cannot show it, as all energy from contact is contact work there.
   */
  struct EnergyPromise
  {
    enum class Kind
    {
      /// The total stays.
      keeps,
      /// The total stays or falls.
      never_gains,
      /// Nothing is promised.
      none
    };

    Kind kind = Kind::none;
    /// The identity from which it follows; if nothing is promised, the reason.
    std::string reason = "no contact";

    /// Kind as a verb: "keeps", "never gains", "promises nothing".
    std::string
    verb() const;

    /// The promise of a sum of two contacts: the weaker one.
    EnergyPromise
    and_also(const EnergyPromise &other) const;
  };

  // Promises that several treatments make, over the steps of the midpoint scheme.
  EnergyPromise
  keeps_by_quotient();
  EnergyPromise
  keeps_by_no_work();
  EnergyPromise
  falls_by_convexity();
  EnergyPromise
  falls_by_complementarity();

  /// The change of energy by one contact over a step.
  struct ContactStep
  {
    /// Change of the potential, and work of the pressures along the gap (J): 0 where the
    /// treatment keeps, at most 0 where it never gains.
    double made = 0.;
    /// The largest of the amounts of its points by absolute value (J), and where that
    /// point was in the undeformed body (m).
    double           made_at_point = 0.;
    dealii::Point<3> place;
    /// The part of the body with the point, if known.
    unsigned int part = static_cast<unsigned int>(-1);
    /// Points that were pressed over the step and face no facet at its end: their force
    /// has ended, and their stored energy is lost.
    unsigned int n_dropped = 0;
    /// Points that were not pressed over the step and are behind a facet at its end.
    unsigned int n_entered = 0;
    /// Points that have passed through a surface without contact, and one of them (m).
    unsigned int     n_passed = 0;
    dealii::Point<3> place_passed;

    /// Add the amount of one point.
    void
    add_point(const double            amount,
              const dealii::Point<3> &where,
              const unsigned int part_of_point = static_cast<unsigned int>(-1));

    /// Become the sum of two parts of a step, or of two parts of the boundary.
    void
    unite(const ContactStep &other);
  };

  /// Steps by boundary id, as ContactSummaries.
  using ContactSteps = std::map<unsigned int, ContactStep>;

  /// The steps of all ranks, from those of each. Collective.
  ContactSteps
  reduce_steps(const ContactSteps &mine, const MPI_Comm communicator);
} // namespace Ricochet

#endif
