// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/treatments/contact_sum.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace Ricochet
{
  using namespace dealii;

  ContactSum::ContactSum(
    std::vector<std::unique_ptr<ContactOperator>> all_contacts)
    : contacts(std::move(all_contacts))
    , force(contacts.front()->row_scaling())
    , friction(force)
    , scaling(force)
    , instant_forces(contacts.size(), force)
  {
    for (const bool takes_rows : {false, true})
      for (const auto &contact : contacts)
        if (contact->takes_rows() == takes_rows)
          in_order.push_back(contact.get());
    promise = contacts.front()->promise;
    for (const auto &contact : contacts)
      promise = promise.and_also(contact->promise);
    force   = 0.;
    scaling = 1.;
    for (const ContactOperator *contact : in_order)
      {
        has_friction = has_friction || contact->friction_force();
        scaling.scale(contact->row_scaling());
      }
    std::vector<ContactStructure> structures;
    for (const ContactOperator *contact : in_order)
      structures.push_back(contact->tangent_structure());
    if (!std::all_of(structures.begin(),
                     structures.end(),
                     [](const ContactStructure &structure) {
                       return structure.functionals.has_value();
                     }))
      return;
    const MPI_Comm communicator = force.get_mpi_communicator();
    if (!keeps_rows_apart(structures, communicator))
      {
        if (Utilities::MPI::n_mpi_processes(communicator) > 1)
          return;
        products.emplace(functionals);
      }
    first_functional.push_back(0);
    for (const ContactStructure &structure : structures)
      {
        functionals.add(structure.functionals->functionals);
        first_functional.push_back(functionals.size());
      }
  }



  bool
  ContactSum::keeps_rows_apart(const std::vector<ContactStructure> &structures,
                               const MPI_Comm communicator)
  {
    bool are_apart = true;
    for (unsigned int k = 0; k < structures.size(); ++k)
      {
        if (!structures[k].takes_rows)
          continue;
        const std::set<types::global_dof_index> rows(structures[k].rows.begin(),
                                                     structures[k].rows.end());
        for (unsigned int other = 0; other < structures.size(); ++other)
          if (other != k)
            for (const auto index :
                 structures[other].functionals->functionals.index)
              are_apart = are_apart && rows.count(index) == 0;
      }
    return Utilities::MPI::min(are_apart ? 1 : 0, communicator) == 1;
  }



  void
  ContactSum::begin_stage(const ContactStart &start, const double weight)
  {
    // Each knows by its own force what was pressed.
    for (unsigned int k = 0; k < contacts.size(); ++k)
      contacts[k]->begin_stage({start.solution,
                                (*start.shares)[k],
                                start.mean_velocity,
                                start.time_step,
                                start.end_time},
                               weight);
    at_instant = false;
  }



  void
  ContactSum::complete_residual(const Vector &solution, Vector &residual)
  {
    force = 0.;
    for (ContactOperator *contact : in_order)
      {
        contact->complete_residual(solution, residual);
        force += contact->contact_force();
      }
    if (!has_friction)
      return;
    friction = 0.;
    for (const ContactOperator *contact : in_order)
      if (const Vector *part = contact->friction_force())
        friction += *part;
  }



  void
  ContactSum::accept_iterate()
  {
    for (ContactOperator *contact : in_order)
      contact->accept_iterate();
  }



  void
  ContactSum::forget_iterates()
  {
    for (ContactOperator *contact : in_order)
      contact->forget_iterates();
  }



  bool
  ContactSum::next_pass()
  {
    // Those with fewer passes than others solve their last one again.
    bool another = false;
    for (ContactOperator *contact : in_order)
      another = contact->next_pass() || another;
    return another;
  }



  std::vector<const Vector *>
  ContactSum::shares() const
  {
    std::vector<const Vector *> list;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      list.push_back(at_instant ? &instant_forces[k]
                                : &contacts[k]->contact_force());
    return list;
  }



  double
  ContactSum::friction_dissipation() const
  {
    double sum = 0.;
    for (const ContactOperator *contact : in_order)
      sum += contact->friction_dissipation();
    return sum;
  }



  ContactSteps
  ContactSum::end_step(const Vector &begin,
                       const Vector &end,
                       const double  begin_time,
                       const double  end_time)
  {
    ContactSteps steps;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      for (const auto &[id, step] :
           contacts[k]->end_step(begin, end, begin_time, end_time))
        steps[id_of(k, id)] = step;
    return steps;
  }



  double
  ContactSum::linearisation_error() const
  {
    double sum = 0.;
    for (const ContactOperator *contact : in_order)
      sum = std::hypot(sum, contact->linearisation_error());
    return sum;
  }



  double
  ContactSum::round_off() const
  {
    double sum = 0.;
    for (const ContactOperator *contact : in_order)
      sum = std::hypot(sum, contact->round_off());
    return sum;
  }



  std::string
  ContactSum::active_set_description() const
  {
    std::string text;
    for (const auto &contact : contacts)
      text += (text.empty() ? "" : " and ") + contact->active_set_description();
    return text;
  }



  void
  ContactSum::complete_tangent(Matrix &tangent) const
  {
    for (const ContactOperator *contact : in_order)
      contact->complete_tangent(tangent);
  }



  void
  ContactSum::complete_constant_tangent(Matrix &tangent) const
  {
    for (const ContactOperator *contact : in_order)
      contact->complete_constant_tangent(tangent);
  }



  ContactStructure
  ContactSum::tangent_structure() const
  {
    ContactStructure sum;
    sum.is_symmetric = true;
    if (!first_functional.empty())
      sum.functionals.emplace();
    for (const ContactOperator *contact : in_order)
      {
        const ContactStructure own = contact->tangent_structure();
        sum.rows.insert(sum.rows.end(), own.rows.begin(), own.rows.end());
        sum.is_symmetric     = sum.is_symmetric && own.is_symmetric;
        sum.has_multipliers  = sum.has_multipliers || own.has_multipliers;
        sum.couplings_change = sum.couplings_change || own.couplings_change;
        sum.takes_rows       = sum.takes_rows || own.takes_rows;
        if (!sum.functionals)
          continue;
        sum.functionals->functionals.add(own.functionals->functionals);
        sum.functionals->order.insert(sum.functionals->order.end(),
                                      own.functionals->order.begin(),
                                      own.functionals->order.end());
      }
    // Each row once, where it comes first.
    std::vector<types::global_dof_index> rows;
    std::vector<types::global_dof_index> sorted = sum.rows;
    std::sort(sorted.begin(), sorted.end());
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    std::vector<bool> taken(sorted.size(), false);
    for (const auto row : sum.rows)
      {
        const auto place =
          std::lower_bound(sorted.begin(), sorted.end(), row) - sorted.begin();
        if (!taken[place])
          rows.push_back(row);
        taken[place] = true;
      }
    sum.rows = rows;
    return sum;
  }



  void
  ContactSum::gather_change(
    void (TangentContact::*ask)(std::vector<FunctionalRow> &) const,
    std::vector<FunctionalRow> &change) const
  {
    for (unsigned int k = 0; k < in_order.size(); ++k)
      {
        const unsigned int         first = first_functional[k];
        std::vector<FunctionalRow> own(first_functional[k + 1] - first);
        (in_order[k]->*ask)(own);
        for (unsigned int f = 0; f < own.size(); ++f)
          {
            for (auto &entry : own[f])
              entry.first += first;
            change[first + f] = std::move(own[f]);
          }
        if (!products || !in_order[k]->takes_rows())
          continue;
        std::vector<FunctionalRow> with_excess(own.size());
        in_order[k]->excess_change(with_excess);
        for (unsigned int f = 0; f < own.size(); ++f)
          for (const auto &[g, value] : with_excess[f])
            for (const auto &[other, product] : products->of(first + g))
              if (other < first)
                for (const auto &[h, entry] : change[other])
                  change[first + f].emplace_back(h, value * product * entry);
      }
  }



  void
  ContactSum::tangent_change(std::vector<FunctionalRow> &change) const
  {
    gather_change(&TangentContact::tangent_change, change);
  }



  void
  ContactSum::excess_change(std::vector<FunctionalRow> &change) const
  {
    gather_change(&TangentContact::excess_change, change);
  }



  void
  ContactSum::look_at_change(const std::vector<double> &change,
                             const std::vector<double> &excess)
  {
    // Those that take rows see the forces of others before them.
    std::vector<double> forces;
    for (unsigned int k = 0; k < in_order.size(); ++k)
      {
        const auto own = [&](const std::vector<double> &all) {
          return all.empty()
            ? all
            : std::vector<double>(all.begin() + first_functional[k],
                                  all.begin() + first_functional[k + 1]);
        };
        std::vector<double> own_excess = own(excess);
        if (products && in_order[k]->takes_rows())
          for (unsigned int f = 0; f < own_excess.size(); ++f)
            for (const auto &[other, product] :
                 products->of(first_functional[k] + f))
              if (other < first_functional[k])
                own_excess[f] += product * forces[other];
        in_order[k]->look_at_change(own(change), own_excess);
        if (!products)
          continue;
        std::vector<double> own_forces;
        in_order[k]->force_change(own_forces);
        forces.insert(forces.end(), own_forces.begin(), own_forces.end());
      }
  }



  void
  ContactSum::force_change(std::vector<double> &coefficients) const
  {
    coefficients.clear();
    std::vector<double> own;
    for (const ContactOperator *contact : in_order)
      {
        contact->force_change(own);
        coefficients.insert(coefficients.end(), own.begin(), own.end());
      }
  }



  const Couplings *
  ContactSum::couplings()
  {
    all_couplings.lists.clear();
    // Versions only grow; so does their sum whenever one changes.
    all_couplings.version = 0;
    bool any              = false;
    for (ContactOperator *contact : in_order)
      if (const Couplings *own = contact->couplings())
        {
          any = true;
          all_couplings.version += own->version;
          all_couplings.lists.insert(all_couplings.lists.end(),
                                     own->lists.begin(),
                                     own->lists.end());
        }
    return any ? &all_couplings : nullptr;
  }



  namespace
  {
    std::uint64_t
    hash_of_both(const std::uint64_t a, const std::uint64_t b)
    {
      return a * 0x9e3779b97f4a7c15ULL + b;
    }
  } // namespace



  std::optional<std::uint64_t>
  ContactSum::tangent_signature() const
  {
    std::uint64_t sum = 0;
    for (const ContactOperator *contact : in_order)
      {
        const auto own = contact->tangent_signature();
        if (!own)
          return {};
        sum = hash_of_both(sum, *own);
      }
    return sum;
  }



  std::uint64_t
  ContactSum::active_set_signature() const
  {
    std::uint64_t sum = 0;
    for (const ContactOperator *contact : in_order)
      sum = hash_of_both(sum, contact->active_set_signature());
    return sum;
  }



  void
  ContactSum::force_at(const Vector &solution,
                       const double  time,
                       Vector       &result)
  {
    result = 0.;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      {
        contacts[k]->force_at(solution, time, instant_forces[k]);
        result += instant_forces[k];
      }
    at_instant = true;
  }



  double
  ContactSum::potential(const Vector &solution, const double time)
  {
    double sum = 0.;
    for (ContactOperator *contact : in_order)
      sum += contact->potential(solution, time);
    return sum;
  }



  bool
  ContactSum::has_modified_energy() const
  {
    return std::all_of(contacts.begin(), contacts.end(), [](const auto &own) {
      return own->has_modified_energy();
    });
  }



  bool
  ContactSum::has_moving_obstacles() const
  {
    return std::any_of(contacts.begin(), contacts.end(), [](const auto &own) {
      return own->has_moving_obstacles();
    });
  }



  bool
  ContactSum::gaps_may_be_unknown() const
  {
    return std::any_of(contacts.begin(), contacts.end(), [](const auto &own) {
      return own->gaps_may_be_unknown();
    });
  }



  Vector
  ContactSum::pressure_field(const ContactInstant &instant)
  {
    Vector sum(force);
    sum = 0.;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      sum += contacts[k]->pressure_field(
        {instant.solution, share(instant, k), instant.time});
    return sum;
  }



  ContactSummaries
  ContactSum::summary(const ContactInstant &instant)
  {
    ContactSummaries all;
    for (unsigned int k = 0; k < contacts.size(); ++k)
      for (const auto &[id, summary] : contacts[k]->summary(
             {instant.solution, share(instant, k), instant.time}))
        all[id_of(k, id)] = summary;
    return all;
  }
} // namespace Ricochet
