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
   * The check, in each row of the ledger, of what a run says of its energy: that the
   * balance of each step closes, and that contact treatments do to the total energy what
   * they promise (see EnergyPromise). Both are measured by the largest sum so far of the
   * absolute values of energies and works, with a floor: what the arithmetic alone may
   * leave, over #bound. So #bound is that of both, and round-off never opens a run.
   *
   * The rows are all that it looks at, so that a resumed run begins with those that
   * there are.
   */
  class EnergyCheck
  {
  public:
    static constexpr double bound = 1e-9;

    /// A contact as the ledger tells of it.
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
      /// Of the contact treatments; not a number where there is none.
      double potential     = 0.;
      double external_work = 0., imposed_work = 0., obstacle_work = 0.;
      double contact_work = 0., friction_work = 0.;
      double viscous_dissipation = 0., numerical_dissipation = 0.;
      /// What each contact has made, see ContactStep::made; empty where the time scheme
      /// does not tell.
      std::vector<double> contact_gains = {};
      /// What the balance of this step leaves over, and the round-off in it (J).
      double balance = 0., round_off = 0.;
    };

    /// What a row says besides.
    struct Values
    {
      /// J; not a number without a potential.
      double total = std::numeric_limits<double>::quiet_NaN();
      /// Over what they are measured by: what is left of the balance; how far the total
      /// is from what is promised or, if nothing is, its rise above its least value.
      double balance_residual = 0.,
             promise_residual = std::numeric_limits<double>::quiet_NaN();
      /// Whether this row is the first one that breaks the promise.
      bool breaks_promise = false;
    };

    /// @param promise that of all contacts together.
    /// @param obstacles_move and contact acts over steps: then the work of obstacles is
    /// what contact work, potential and gains leave over.
    EnergyCheck(const EnergyPromise        &promise,
                const std::vector<Contact> &contacts,
                const bool                  obstacles_move);

    /// Look at the next row.
    Values
    add(const Terms &terms);

    /// What the balance of the next row is measured by, with these terms: the largest sum
    /// of all rows, and the floor of the arithmetic (J).
    double
    scale_with(const Terms &terms) const;

    /// The contact that is farthest from its promise at the last row; null for none.
    const Contact *
    worst_contact() const;

    /// The last lines of a run: what became of balance and promise.
    std::vector<std::string>
    verdict() const;

    /// Whether balance or promise are open.
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
    // Of the total, and of each contact's gains (J).
    double              least_total = 0.;
    std::vector<double> least_gains, deviations;
    double              most_friction = 0., most_viscosity = 0.;
    // Of all steps together, and of the last one (J).
    double round_off = 0., last_round_off = 0.;
    // The largest residuals so far.
    double worst_balance = 0., worst_promise = 0.;
    bool   balance_closes = true, promise_is_broken = false;
    bool   has_total = false;
  };
} // namespace Ricochet

#endif
