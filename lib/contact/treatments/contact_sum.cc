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
    : ContactOperator(all_contacts.front()->row_scaling())
    , contacts(std::move(all_contacts))
    , instant_forces(contacts.size(), force)
  {
    for (const bool eliminates_rows : {false, true})
      for (const auto &contact : contacts)
        if (contact->structure().eliminates_rows == eliminates_rows)
          in_order.push_back(contact.get());
    promise = contacts.front()->promise;
    for (const auto &contact : contacts)
      promise = promise.and_also(contact->promise);
    for (const ContactOperator *contact : in_order)
      scaling.scale(contact->row_scaling());
    set_structure();
  }



  void
  ContactSum::set_structure()
  {
    bool                          have_functionals = true;
    std::vector<ContactStructure> structures;
    own_structure.is_symmetric     = true;
    own_traits.has_modified_energy = true;
    for (const ContactOperator *contact : in_order)
      {
        const ContactStructure &own =
          structures.emplace_back(contact->structure());
        own_structure.rows.insert(own_structure.rows.end(),
                                  own.rows.begin(),
                                  own.rows.end());
        own_structure.is_symmetric &= own.is_symmetric;
        own_structure.has_multipliers |= own.has_multipliers;
        own_structure.couplings_change |= own.couplings_change;
        own_structure.eliminates_rows |= own.eliminates_rows;
        have_functionals = have_functionals && own.functionals;

        own_traits.has_friction |= contact->traits().has_friction;
        own_traits.has_modified_energy &= contact->traits().has_modified_energy;
        own_traits.has_moving_obstacles |=
          contact->traits().has_moving_obstacles;
        own_traits.gaps_may_be_unknown |= contact->traits().gaps_may_be_unknown;
      }
    // Each row once, at its first occurrence.
    std::set<types::global_dof_index>    known;
    std::vector<types::global_dof_index> rows;
    for (const auto row : own_structure.rows)
      if (known.insert(row).second)
        rows.push_back(row);
    own_structure.rows = rows;

    const MPI_Comm communicator = force.get_mpi_communicator();
    bool           some_share   = false;
    for (unsigned int k = 0; k < in_order.size(); ++k)
      for (unsigned int before = 0; before < k; ++before)
        some_share = in_order[k]->share_nodes(*in_order[before]) || some_share;
    some_share = Utilities::MPI::max(some_share ? 1 : 0, communicator) == 1;
    if (!have_functionals || some_share)
      return;
    const bool are_apart = keeps_rows_apart(structures, communicator);
    if (!are_apart && Utilities::MPI::n_mpi_processes(communicator) > 1)
      return;
    ContactStructure::ActsThrough &all = own_structure.functionals.emplace();
    first_functional.push_back(0);
    for (const ContactStructure &structure : structures)
      {
        all.functionals.add(structure.functionals->functionals);
        all.order.insert(all.order.end(),
                         structure.functionals->order.begin(),
                         structure.functionals->order.end());
        first_functional.push_back(all.functionals.size());
      }
    if (!are_apart)
      products.emplace(all.functionals);
  }



  bool
  ContactSum::keeps_rows_apart(const std::vector<ContactStructure> &structures,
                               const MPI_Comm communicator)
  {
    bool are_apart = true;
    for (unsigned int k = 0; k < structures.size(); ++k)
      {
        if (!structures[k].eliminates_rows)
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
    // Each contact finds by its own force which points were pressed.
    for (unsigned int k = 0; k < contacts.size(); ++k)
      contacts[k]->begin_stage({start.solution,
                                (*start.shares)[k],
                                start.mean_velocity,
                                start.time_step,
                                start.end_time,
                                nullptr,
                                start.rate_origin,
                                start.rate_time},
                               weight);
    at_instant = false;
  }



  void
  ContactSum::add_residual(const Vector &solution, Vector &residual)
  {
    force = 0.;
    for (ContactOperator *contact : in_order)
      {
        contact->add_residual(solution, residual);
        force += contact->contact_force();
      }
    if (!own_traits.has_friction)
      return;
    friction_part = 0.;
    for (const ContactOperator *contact : in_order)
      if (const Vector *part = contact->friction_force())
        friction_part += *part;
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
    // Contacts with fewer passes than others solve their last one again.
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
  ContactSum::add_tangent(Matrix &tangent) const
  {
    for (const ContactOperator *contact : in_order)
      contact->add_tangent(tangent);
  }



  void
  ContactSum::add_open_tangent(Matrix &tangent) const
  {
    for (const ContactOperator *contact : in_order)
      contact->add_open_tangent(tangent);
  }



  void
  ContactSum::differentiate_forces(
    std::vector<FunctionalRow> &with_values,
    std::vector<FunctionalRow> &with_residual) const
  {
    for (unsigned int k = 0; k < in_order.size(); ++k)
      {
        const unsigned int         first = first_functional[k];
        const unsigned int         n     = first_functional[k + 1] - first;
        std::vector<FunctionalRow> own_values(n), own_residual(n);
        in_order[k]->differentiate_forces(own_values, own_residual);
        const auto add = [&](const unsigned int          f,
                             const FunctionalRow        &own,
                             std::vector<FunctionalRow> &all) {
          for (const auto &[g, value] : own)
            all[first + f].emplace_back(first + g, value);
        };
        for (unsigned int f = 0; f < n; ++f)
          {
            add(f, own_values[f], with_values);
            add(f, own_residual[f], with_residual);
            if (!products)
              continue;
            // Forces of other contacts in rows that this one eliminates.
            for (const auto &[g, value] : own_residual[f])
              for (const auto &[other, product] : products->of(first + g))
                if (other < first)
                  for (std::vector<FunctionalRow> *all :
                       {&with_values, &with_residual})
                    for (const auto &[h, entry] : (*all)[other])
                      (*all)[first + f].emplace_back(h,
                                                     value * product * entry);
          }
      }
  }



  void
  ContactSum::evaluate_at_increment(const std::vector<double> &change,
                                    const std::vector<double> &excess)
  {
    // Contacts that eliminate rows need the forces of the others before them.
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
        if (products && in_order[k]->structure().eliminates_rows)
          for (unsigned int f = 0; f < own_excess.size(); ++f)
            for (const auto &[other, product] :
                 products->of(first_functional[k] + f))
              if (other < first_functional[k])
                own_excess[f] += product * forces[other];
        in_order[k]->evaluate_at_increment(own(change), own_excess);
        if (!products)
          continue;
        std::vector<double> own_forces;
        in_order[k]->forces_on_rows(own_forces);
        forces.insert(forces.end(), own_forces.begin(), own_forces.end());
      }
  }



  void
  ContactSum::forces_on_rows(std::vector<double> &coefficients) const
  {
    coefficients.clear();
    std::vector<double> own;
    for (const ContactOperator *contact : in_order)
      {
        contact->forces_on_rows(own);
        coefficients.insert(coefficients.end(), own.begin(), own.end());
      }
  }



  const Couplings *
  ContactSum::couplings()
  {
    all_couplings.lists.clear();
    // Versions only increase, and so does their sum whenever one changes.
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



  ActiveSet
  ContactSum::active_set() const
  {
    ActiveSet sum{0, 0};
    for (const ContactOperator *contact : in_order)
      {
        const ActiveSet own = contact->active_set();
        sum.hash            = hash_of_both(sum.hash, own.hash);
        if (!own.tangent_key)
          sum.tangent_key.reset();
        else if (sum.tangent_key)
          sum.tangent_key = hash_of_both(*sum.tangent_key, *own.tangent_key);
      }
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
      {
        ContactInstant own{instant.solution, share(instant, k), instant.time};
        if (instant.report)
          own.report = [&, k](ContactPointValues values) {
            values.boundary_id = id_of(k, values.boundary_id);
            instant.report(values);
          };
        for (const auto &[id, summary] : contacts[k]->summary(own))
          all[id_of(k, id)] = summary;
      }
    return all;
  }
} // namespace Ricochet
