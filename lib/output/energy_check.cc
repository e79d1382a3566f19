// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/parameter_file.h>
#include <output/energy_check.h>

#include <algorithm>
#include <cmath>

namespace Ricochet
{
  EnergyCheck::EnergyCheck(const EnergyPromise        &promise,
                           const std::vector<Contact> &contacts,
                           const bool                  obstacles_move)
    : promise(promise)
    , contacts(contacts)
    , obstacles_move(obstacles_move)
    , least_gains(contacts.size(), 0.)
    , deviations(contacts.size(), 0.)
  {}



  namespace
  {
    /// The sum of the absolute values of energies and works (J).
    double
    size_of(const EnergyCheck::Terms &terms)
    {
      double sum = 0.;
      for (const double term : {terms.kinetic,
                                terms.stored,
                                terms.potential,
                                terms.external_work,
                                terms.imposed_work,
                                terms.obstacle_work,
                                terms.contact_work,
                                terms.friction_work,
                                terms.viscous_dissipation,
                                terms.numerical_dissipation})
        if (!std::isnan(term))
          sum += std::abs(term);
      return sum;
    }
  } // namespace



  double
  EnergyCheck::scale_with(const Terms &terms) const
  {
    // The residual of a step is carried into the next one by schemes with
    // accelerations.
    return std::max(scale, size_of(terms)) +
      (terms.round_off + last_round_off) / bound;
  }



  double
  EnergyCheck::deviation(const EnergyPromise::Kind kind,
                         const double              amount,
                         double                   &least)
  {
    least = std::min(least, amount);
    // The least value is at most the first one, which is 0.
    return kind == EnergyPromise::Kind::keeps
      ? std::max(amount - least, -amount)
      : amount - least;
  }



  EnergyCheck::Values
  EnergyCheck::add(const Terms &terms)
  {
    using Kind          = EnergyPromise::Kind;
    const auto relative = [](const double amount, const double measure) {
      return measure > 0. ? amount / measure : amount;
    };
    Values values;
    values.balance_residual = relative(terms.balance, scale_with(terms));
    if (std::abs(values.balance_residual) > std::abs(worst_balance))
      worst_balance = values.balance_residual;
    if (!(std::abs(values.balance_residual) <= bound))
      balance_closes = false;
    scale          = std::max(scale, size_of(terms));
    last_round_off = terms.round_off;
    round_off += terms.round_off;

    if (!has_begun)
      first_potential = terms.potential;
    // The work of moving obstacles is minus the contact work, less what the
    // treatment has stored and gained.
    double made = 0.;
    for (const double gain : terms.contact_gains)
      made += gain;
    const double contact = obstacles_move
      ? first_potential + terms.contact_work + made
      : terms.potential - terms.obstacle_work;
    values.total         = terms.kinetic + terms.stored + contact -
      terms.external_work - terms.imposed_work + terms.friction_work +
      terms.viscous_dissipation + terms.numerical_dissipation;
    if (!has_begun)
      first_total = values.total;
    has_begun = true;

    bool   is_promised = false;
    double largest     = 0.;
    for (unsigned int k = 0; k < terms.contact_gains.size(); ++k)
      {
        deviations[k] = deviation(contacts[k].promise.kind,
                                  terms.contact_gains[k],
                                  least_gains[k]);
        if (contacts[k].promise.kind == Kind::none)
          continue;
        is_promised = true;
        largest     = std::max(largest, deviations[k]);
      }
    // Friction and viscosity only dissipate.
    most_friction     = std::max(most_friction, terms.friction_work);
    most_viscosity    = std::max(most_viscosity, terms.viscous_dissipation);
    const double back = std::max(most_friction - terms.friction_work,
                                 most_viscosity - terms.viscous_dissipation);
    given_back        = std::max(given_back, back);
    if (std::isnan(values.total))
      return values;
    has_total = true;
    const double of_total =
      deviation(promise.kind, values.total - first_total, least_total);
    if (promise.kind != Kind::none)
      {
        is_promised = true;
        largest     = std::max(largest, of_total);
      }
    // Contact with bodies at rest: the gain is the increase of the potential
    // less the work of the contact forces, from the points and from the
    // equations alike.
    if (is_promised && !obstacles_move && !terms.contact_gains.empty())
      largest = std::max(largest,
                         std::abs(made -
                                  (terms.potential - first_potential -
                                   terms.contact_work)));
    if (is_promised)
      largest = std::max(largest, back);
    else
      largest = of_total;
    // Without a promise there is no bound that round-off might exceed.
    values.promise_residual =
      relative(largest, is_promised ? scale + round_off / bound : scale);
    worst_promise         = std::max(worst_promise, values.promise_residual);
    const bool is_broken  = is_promised && !(values.promise_residual <= bound);
    values.breaks_promise = is_broken && !promise_is_broken;
    promise_is_broken     = promise_is_broken || is_broken;
    return values;
  }



  const EnergyCheck::Contact *
  EnergyCheck::worst_contact() const
  {
    const Contact *worst   = nullptr;
    double         largest = 0.;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      if (deviations[k] > largest)
        {
          largest = deviations[k];
          worst   = &contacts[k];
        }
    return worst;
  }



  EnergyCheck::Result
  EnergyCheck::result() const
  {
    const bool is_promised = promise.kind != EnergyPromise::Kind::none;
    return {std::abs(worst_balance),
            balance_closes,
            is_promised ? promise.verb() : "nothing, as " + promise.reason,
            worst_promise,
            is_promised,
            promise_is_broken};
  }



  std::vector<std::string>
  EnergyCheck::verdict() const
  {
    std::string balance =
      "largest balance residual: " + to_text(std::abs(worst_balance));
    balance +=
      balance_closes ? " (closed)" : " - THE ENERGY BALANCE DOES NOT CLOSE";
    // Forces of friction and viscosity at instants may do work in between.
    std::string back;
    if (promise.kind == EnergyPromise::Kind::none &&
        given_back > bound * scale + round_off)
      back = "; friction and viscosity gave back at most " +
        to_text(given_back / scale);
    if (!has_total)
      return {balance,
              "total energy: nothing is promised, as " + promise.reason + back};
    std::string total = "total energy: ";
    if (promise.kind == EnergyPromise::Kind::none)
      total += "nothing is promised, as " + promise.reason + "; ";
    else
      total += promise.verb() + "; ";
    total += (promise.kind == EnergyPromise::Kind::keeps ? "largest change "
                                                         : "largest rise ") +
      to_text(worst_promise) + back;
    if (promise_is_broken)
      total += " - THE PROMISE IS BROKEN";
    else if (promise.kind != EnergyPromise::Kind::none)
      total += " (kept)";
    return {balance, total};
  }
} // namespace Ricochet
