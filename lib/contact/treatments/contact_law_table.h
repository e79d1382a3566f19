// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_contact_law_table_h
#define ricochet_contact_treatments_contact_law_table_h

#include <base/named_table.h>
#include <contact/energy_promise.h>
#include <contact/laws/contact_law.h>
#include <contact/laws/friction_law.h>
#include <contact/treatments/closing_condition.h>

#include <deal.II/base/template_constraints.h>

#include <functional>
#include <memory>
#include <string>

namespace Ricochet
{
  /**
   * A contact treatment in the table from which parameter files choose. A pointwise
   * law is a struct with
   *
   *     static constexpr const char *name;
   *     static OwnParameters parameters();
   *     static Law make(const ParameterValues &);
   *     static EnergyPromise promise();        over the steps of the midpoint scheme
   *     static constexpr ContactLawTraits traits();
   *     force(), potential()                   see ContactLaw
   *
   * and, optionally, tangent(), branch() and pressure(), which otherwise follow from
   * its force; and
   *
   *     static void check(const ParameterValues &)        throws InputError
   *     std::string lacks_potential() const               why, with its values; or empty
   *     std::string instability(double trace_constant) const    see nitsche_bound.h; or empty
   */
  struct ContactLawEntry
  {
    std::string      name;
    OwnParameters    parameters;
    ContactLawTraits traits;
    /// The promise over the steps of the midpoint scheme.
    EnergyPromise promise = {};
    /// Makes the pointwise law; empty for active sets, which have none.
    std::function<std::unique_ptr<ContactLaw>(const ParameterValues &)>
      make_law = {};
    /// The law within a midpoint step, if it is another one.
    std::function<std::unique_ptr<ContactLaw>(const ParameterValues &)>
      make_midpoint_law = {};
    /// The condition that an active set imposes.
    ClosingCondition condition = ClosingCondition::signorini;
    /// Throws InputError for values that do not go together.
    std::function<void(const ParameterValues &)> check = {};
    /// The reason why there is no potential with these values; empty if there is one.
    std::function<std::string(const ParameterValues &)> lacks_potential = {};
    /// The reason why the law is not stable on a mesh with a trace constant (Pa); empty
    /// if it is.
    std::function<std::string(const ParameterValues &, const double)>
      instability = {};
  };

  /// A friction law in the table from which parameter files choose; see
  /// FrictionLaw.
  struct FrictionLawEntry
  {
    std::string   name;
    OwnParameters parameters;
    std::function<std::shared_ptr<const FrictionLaw>(const ParameterValues &)>
      make;
    /// The reason why there is no friction with these values; empty if there is some.
    std::function<std::string(const ParameterValues &)> absent;
    /// Stick and slip can be exact, in treatments with active sets.
    bool is_coulomb = false;
  };

  /// Add a contact law to the table of treatments. Programs do this before they declare
  /// parameters.
  /// @throws dealii::ExcMessage when its name is taken.
  void
  register_contact_law(const ContactLawEntry &entry);

  /// As above, for a friction law. With more than one, contacts have a
  /// parameter `Friction law`.
  void
  register_friction_law(const FrictionLawEntry &entry);



  namespace internal
  {
    // Optional members of a law.
    template <typename Law>
    using contact_check_of =
      decltype(Law::check(std::declval<ParameterValues>()));
    template <typename Law>
    using potential_condition_of =
      decltype(std::declval<const Law &>().lacks_potential());
    template <typename Law>
    using stability_bound_of =
      decltype(std::declval<const Law &>().instability(1.));
    template <typename Law>
    using absence_of = decltype(Law::absent(std::declval<ParameterValues>()));
  } // namespace internal

  /// The entry of the pointwise law @p Law.
  template <typename Law>
  ContactLawEntry
  contact_law_entry()
  {
    using dealii::internal::is_supported_operation;
    ContactLawEntry entry;
    entry.name       = Law::name;
    entry.parameters = Law::parameters();
    entry.traits     = Law::traits();
    entry.promise    = Law::promise();
    entry.make_law   = [](const ParameterValues &values) {
      return std::make_unique<ContactLawImplementation<Law>>(Law::make(values));
    };
    if constexpr (is_supported_operation<internal::contact_check_of, Law>)
      entry.check = Law::check;
    if constexpr (is_supported_operation<internal::potential_condition_of, Law>)
      entry.lacks_potential = [](const ParameterValues &values) {
        return Law::make(values).lacks_potential();
      };
    if constexpr (is_supported_operation<internal::stability_bound_of, Law>)
      entry.instability = [](const ParameterValues &values,
                             const double           trace_constant) {
        return Law::make(values).instability(trace_constant);
      };
    return entry;
  }

  /// Add the pointwise law @p Law to the table.
  template <typename Law>
  void
  register_contact_law()
  {
    register_contact_law(contact_law_entry<Law>());
  }

  /// The entry of the friction law @p Law.
  template <typename Law>
  FrictionLawEntry
  friction_law_entry()
  {
    FrictionLawEntry entry;
    entry.name       = Law::name;
    entry.parameters = Law::parameters();
    entry.make       = [](const ParameterValues &values) {
      return std::make_shared<FrictionLawImplementation<Law>>(
        Law::make(values));
    };
    entry.absent = [](const ParameterValues &values) -> std::string {
      if constexpr (dealii::internal::
                      is_supported_operation<internal::absence_of, Law>)
        return Law::absent(values);
      else
        return "";
    };
    return entry;
  }

  /// Add the friction law @p Law to the table.
  template <typename Law>
  void
  register_friction_law()
  {
    register_friction_law(friction_law_entry<Law>());
  }
} // namespace Ricochet

#endif
