// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_output_energy_check_h
#define ricochet_output_energy_check_h

#include <contact/energy_promise.h>

#include <limits>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The check of each row of the energy table: that the balance of each step
   * closes, and that the total energy is as contact treatments promise (see
   * EnergyPromise). Both are relative to the largest sum so far of the absolute
   * values of energies and works, with a floor: the round-off of the arithmetic
   * over #bound. So #bound is the bound of both, and round-off never violates
   * it.
   *
   * The check depends on the rows alone, so that a resumed run begins with the
   * stored ones.
   */
  class EnergyCheck
  {
  public:
    static constexpr double bound = 1e-9;

    /// A contact as the ledger records it.
    struct Contact
    {
      std::string   name;
      EnergyPromise promise;
    };

    /// A row: energies, and works since the start (J).
    struct Terms
    {
      double time    = 0.;
      double kinetic = 0., stored = 0.;
      /// Potential of the contact treatments; not a number where there is none.
      double potential     = 0.;
      double external_work = 0., imposed_work = 0., obstacle_work = 0.;
      double contact_work = 0., friction_work = 0.;
      double viscous_dissipation = 0., numerical_dissipation = 0.;
      /// Energy gained by each contact, see ContactStep::made; empty where the
      /// time scheme does not compute it.
      std::vector<double> contact_gains = {};
      /// The residual of the balance of this step, and the round-off in it (J).
      double balance = 0., round_off = 0.;
    };

    /// Results of the check of a row.
    struct Values
    {
      /// J; not a number without a potential.
      double total = std::numeric_limits<double>::quiet_NaN();
      /// Relative values: the residual of the balance; the distance of the
      /// total from what is promised or, without a promise, its rise above its
      /// least value.
      double balance_residual = 0.,
             promise_residual = std::numeric_limits<double>::quiet_NaN();
      /// Whether this row is the first one that breaks the promise.
      bool breaks_promise = false;
    };

    /// @param promise that of all contacts together.
    /// @param obstacles_move and contact acts over steps: then the work of
    /// obstacles follows from contact work, potential and gains.
    EnergyCheck(const EnergyPromise        &promise,
                const std::vector<Contact> &contacts,
                const bool                  obstacles_move);

    /// Check the next row.
    Values
    add(const Terms &terms);

    /// The scale of the balance of the next row with these terms: the largest
    /// sum of all rows, and the floor of the arithmetic (J).
    double
    scale_with(const Terms &terms) const;

    /// The contact that is farthest from its promise at the last row; null for none.
    const Contact *
    worst_contact() const;

    /// The result of all rows.
    struct Result
    {
      /// The largest relative residual of the balance, and whether it is within #bound.
      double balance        = 0.;
      bool   balance_closes = true;
      /// The promise in words, or why there is none; the largest relative deviation from it,
      /// or rise; and whether it is broken.
      std::string promise;
      double      deviation   = 0.;
      bool        is_promised = false, is_broken = false;
    };

    Result
    result() const;

    /// The last lines of a run: the result for balance and promise.
    std::vector<std::string>
    verdict() const;

    /// Whether balance or promise are violated.
    bool
    is_open() const
    {
      return !balance_closes || promise_is_broken;
    }

  private:
    /// How far (J) @p amount, which began with 0, is from the promise; keeps track of
    /// its least value.
    static double
    deviation(const EnergyPromise::Kind kind,
              const double              amount,
              double                   &least);

    const EnergyPromise        promise;
    const std::vector<Contact> contacts;
    const bool                 obstacles_move;
    bool                       has_begun = false;
    double scale = 0., first_total = 0., first_potential = 0.;
    // Least values of the total and of each contact's gains (J).
    double              least_total = 0.;
    std::vector<double> least_gains, deviations;
    double              most_friction = 0., most_viscosity = 0.;
    // Largest energy (J) that friction or viscosity have given back: zero in schemes whose
    // forces are those of a step.
    double given_back = 0.;
    // Round-off of all steps together, and of the last one (J).
    double round_off = 0., last_round_off = 0.;
    // The largest residuals so far.
    double worst_balance = 0., worst_promise = 0.;
    bool   balance_closes = true, promise_is_broken = false;
    bool   has_total = false;
  };
} // namespace Ricochet

#endif
