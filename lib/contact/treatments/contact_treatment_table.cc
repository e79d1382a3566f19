// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/kinematics/cut_faces.h>
#include <contact/laws/corner_compliance.h>
#include <contact/treatments/active_set_contact.h>
#include <contact/treatments/contact_treatment.h>
#include <contact/laws/augmentation.h>
#include <contact/laws/augmented_lagrangian.h>
#include <contact/laws/coulomb_friction.h>
#include <contact/laws/law_check.h>
#include <contact/laws/nitsche.h>
#include <contact/laws/nitsche_two_point.h>
#include <contact/laws/normal_compliance.h>
#include <contact/laws/penalty.h>
#include <contact/laws/regularised_friction.h>
#include <contact/laws/signorini_multiplier.h>
#include <contact/laws/slip_rate_friction.h>
#include <contact/treatments/contact_law_table.h>
#include <contact/treatments/cut_face_contact.h>
#include <contact/treatments/nitsche_bound.h>
#include <contact/treatments/pair_contact.h>
#include <contact/treatments/pointwise_contact.h>

#include <deal.II/base/utilities.h>

#include <deal.II/grid/grid_tools.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    using Treatment = ContactLawEntry;

    /// Nodal, no multipliers, no potential: a constraint.
    Treatment
    active_set(const std::string     &name,
               const ClosingCondition condition,
               const EnergyPromise   &promise)
    {
      Treatment treatment;
      treatment.name                  = name;
      treatment.parameters            = augmentation_parameters();
      treatment.traits.nodal          = true;
      treatment.traits.has_potential  = false;
      treatment.traits.takes_friction = true;
      treatment.traits.is_two_point = condition != ClosingCondition::signorini;
      treatment.promise             = promise;
      treatment.condition           = condition;
      return treatment;
    }

    /// Nitsche's method, with another law over the steps of the midpoint scheme.
    Treatment
    nitsche()
    {
      Treatment treatment         = contact_law_entry<Nitsche>();
      treatment.make_midpoint_law = [](const ParameterValues &values) {
        return std::make_unique<ContactLawImplementation<NitscheTwoPoint>>(
          NitscheTwoPoint::at_end_of_step(values));
      };
      return treatment;
    }

    // The table of all contact treatments: a new pointwise law is one file in
    // laws/ and one line here.
    NamedTable<Treatment> &
    table()
    {
      static NamedTable<Treatment> treatments(
        "a",
        "contact treatment",
        {nitsche(),
         contact_law_entry<NitscheTwoPoint>(),
         contact_law_entry<Penalty>(),
         contact_law_entry<ProximalAugmentedLagrangian>(),
         contact_law_entry<SignoriniMultiplier>(),
         active_set("Signorini active set",
                    ClosingCondition::signorini,
                    falls_by_complementarity()),
         contact_law_entry<StandardNormalCompliance>(),
         contact_law_entry<MidpointNormalCompliance>(),
         contact_law_entry<ImprovedNormalCompliance>(),
         contact_law_entry<HauretLeTallec>(),
         active_set("persistent contact",
                    ClosingCondition::persistent,
                    keeps_by_no_work()),
         active_set(
           "Ayyad-Barboteu two-step",
           ClosingCondition::two_step,
           {EnergyPromise::Kind::keeps,
            "in the second pass pressure times gap increment is zero in "
            "each point, and the first one leaves no trace"})});
      return treatments;
    }

    // The table of friction laws: a new one is one file in laws/ and one line here.
    NamedTable<FrictionLawEntry> &
    friction_table()
    {
      static NamedTable<FrictionLawEntry> laws = [] {
        FrictionLawEntry coulomb = friction_law_entry<CoulombFriction>();
        coulomb.is_coulomb       = true;
        return NamedTable<FrictionLawEntry>(
          "a",
          "friction law",
          {coulomb, friction_law_entry<SlipRateFriction>()});
      }();
      return laws;
    }

    const Treatment &
    find(const ContactParameters &parameters)
    {
      return table()[parameters.treatment];
    }
  } // namespace



  void
  register_contact_law(const ContactLawEntry &entry)
  {
    table().add(entry);
  }



  void
  register_friction_law(const FrictionLawEntry &entry)
  {
    friction_table().add(entry);
  }



  namespace
  {
    const FrictionLawEntry &
    find_friction(const ContactParameters &parameters)
    {
      return friction_table()[parameters.friction_law];
    }
  } // namespace



  bool
  has_friction(const ContactParameters &parameters)
  {
    return find_friction(parameters).absent(parameters.values).empty();
  }



  namespace
  {
    RegularisedFriction
    make_friction(const ContactParameters &parameters)
    {
      if (!has_friction(parameters))
        return {};
      return {find_friction(parameters).make(parameters.values),
              parameters.values[RegularisedFriction::compliance_name],
              find(parameters).make_law && parameters.stick == "exact"};
    }

    /// mu of exact friction; 0 for none.
    double
    exact_coefficient(const ContactParameters &parameters)
    {
      return has_friction(parameters)
        ? CoulombFriction::make(parameters.values).coefficient
        : 0.;
    }

    double
    augmentation(const ContactParameters &parameters)
    {
      return parameters.values[augmentation_parameters().front().name];
    }

    /// The reason why there is no potential; empty if there is one. A constraint stores
    /// nothing.
    std::string
    lacks_potential(const ContactParameters &parameters)
    {
      const Treatment &treatment = find(parameters);
      return treatment.lacks_potential
        ? treatment.lacks_potential(parameters.values)
        : "";
    }

    bool
    has_modified_energy(const ContactParameters &parameters)
    {
      return lacks_potential(parameters).empty();
    }

    /// "theta = 1" for a parameter "Nitsche theta" that is one of a list.
    std::string
    choice_in_words(const OwnParameter &parameter, const double value)
    {
      return parameter.name.substr(parameter.name.rfind(' ') + 1) + " = " +
        to_text(value);
    }
  } // namespace



  EnergyPromise
  energy_promise(const ContactParameters &parameters,
                 const SchemeTraits      &scheme,
                 const unsigned int       mortar_dim)
  {
    const ContactLawTraits traits = find(parameters).traits;
    if (scheme.needs_potential)
      return {EnergyPromise::Kind::none,
              "the time scheme " + scheme.name +
                " keeps the total energy to its tolerance only"};
    if (!scheme.contact_over_step)
      return {
        EnergyPromise::Kind::none,
        "the time scheme " + scheme.name +
          " takes contact forces at instants, and the mean of two of them is no "
          "change of a potential over its step"};
    if (!has_modified_energy(parameters))
      return {EnergyPromise::Kind::none, lacks_potential(parameters)};
    if (mortar_dim == 3 && traits.has_potential)
      return {
        EnergyPromise::Kind::none,
        "in 3D gaps of mortar are means over pieces that are cut anew in each "
        "step, so that the potential jumps in between"};
    return find(parameters).promise;
  }



  std::vector<std::pair<std::string, ContactParameters>>
  treatment_variants()
  {
    std::vector<std::pair<std::string, ContactParameters>> variants;
    for (const Treatment &treatment : table())
      {
        ContactParameters parameters;
        parameters.treatment = treatment.name;
        variants.emplace_back(treatment.name, parameters);
        for (const OwnParameter &parameter : treatment.parameters)
          for (const std::string &choice :
               Utilities::split_string_list(parameter.choices, '|'))
            {
              const double value = Utilities::string_to_double(choice);
              if (value == parameter.default_value)
                continue;
              parameters.values[parameter.name] = value;
              variants.emplace_back(treatment.name + ", " +
                                      choice_in_words(parameter, value),
                                    parameters);
            }
      }
    return variants;
  }



  std::string
  promises_as_table()
  {
    std::string text = "| treatment | promise | because |\n|---|---|---|\n";
    const auto  add  = [&](const std::string   &name,
                         const EnergyPromise &promise) {
      text +=
        "| " + name + " | " + promise.verb() + " | " + promise.reason + " |\n";
    };
    const SchemeTraits midpoint = scheme_traits("midpoint");
    for (const auto &[name, parameters] : treatment_variants())
      add(name, energy_promise(parameters, midpoint));
    ContactParameters parameters;
    parameters.treatment = "penalty";
    add("any law with a potential on 3D mortar",
        energy_promise(parameters, midpoint, 3));
    for (const SchemeTraits &scheme : all_scheme_traits())
      if (!scheme.contact_over_step)
        add("any with " + scheme.name, energy_promise(parameters, scheme));
    return text;
  }



  std::string
  contact_treatment_names()
  {
    return table().names();
  }



  MultiplierSpace
  multiplier_space(const ContactParameters &parameters)
  {
    return find(parameters).traits.needs_multiplier ? MultiplierSpace::linear
                                                    : MultiplierSpace::none;
  }



  bool
  is_constraint(const ContactParameters &parameters)
  {
    const Treatment &treatment = find(parameters);
    return !treatment.make_law || treatment.traits.needs_multiplier;
  }



  bool
  uses_stress(const ContactParameters &parameters)
  {
    return find(parameters).traits.uses_stress;
  }



  std::vector<std::string>
  schemes_allowed(const ContactParameters &parameters,
                  const bool               redistributed_mass)
  {
    const ContactLawTraits traits = find(parameters).traits;
    const bool is_function = !redistributed_mass && !traits.needs_multiplier &&
      traits.has_potential && has_modified_energy(parameters);
    std::vector<std::string> schemes;
    for (const SchemeTraits &scheme : all_scheme_traits())
      if ((scheme.contact_over_step || !traits.is_two_point) &&
          (scheme.has_inertia || !redistributed_mass) &&
          (is_function || !scheme.needs_potential))
        schemes.push_back(scheme.name);
    return schemes;
  }



  namespace
  {
    std::string
    names_of_treatments(const std::function<bool(const Treatment &)> &good)
    {
      std::vector<std::string> names;
      for (const Treatment &treatment : table())
        if (good(treatment))
          names.push_back(treatment.name);
      return boost::algorithm::join(names, ", ");
    }

    /// The names of all treatments whose traits satisfy the condition.
    std::string
    names_of(const std::function<bool(const ContactLawTraits &)> &good)
    {
      return names_of_treatments(
        [&](const Treatment &treatment) { return good(treatment.traits); });
    }

    /// The laws that give a differential equation with a potential, with the choices
    /// that this depends on: "A with theta = 1, B or C".
    std::string
    names_of_potential_laws()
    {
      std::vector<std::string> names;
      for (const Treatment &treatment : table())
        if (treatment.make_law && treatment.traits.has_potential &&
            !treatment.traits.is_two_point &&
            !treatment.traits.needs_multiplier)
          {
            std::string name = treatment.name;
            if (treatment.lacks_potential)
              for (const OwnParameter &parameter : treatment.parameters)
                if (!parameter.choices.empty())
                  name += " with " +
                    choice_in_words(parameter, parameter.default_value);
            names.push_back(name);
          }
      std::string text;
      for (unsigned int k = 0; k < names.size(); ++k)
        text += (k == 0 ? "" : k + 1 < names.size() ? ", " : " or ") + names[k];
      return text;
    }
  } // namespace



  std::string
  names_of_laws()
  {
    std::vector<std::string> names;
    for (const Treatment &treatment : table())
      if (treatment.make_law && !treatment.traits.needs_multiplier)
        names.push_back(treatment.name);
    return boost::algorithm::join(names, ", ");
  }



  void
  check_combination(const ContactParameters &parameters,
                    const SchemeTraits      &scheme,
                    const bool               redistributed_mass,
                    const bool               linear_material,
                    const VelocityForce      velocity_force,
                    const unsigned int       degree)
  {
    const ContactLawTraits traits = find(parameters).traits;
    parameters.values.check(ContactParameters::all_parameters());
    if (traits.needs_multiplier && traits.nodal && degree > 1)
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' has multipliers in the nodes and takes displacements of degree "
        "1.\nAllowed with degree " +
        std::to_string(degree) + ": " + names_of([](const auto &t) {
          return !t.needs_multiplier || !t.nodal;
        }) +
        ".");
    if (!linear_material && traits.uses_stress)
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' uses the stress of a linear elastic body on the contact boundary "
        "and cannot be combined with a hyperelastic one.\nAllowed with it: " +
        names_of([](const auto &t) { return !t.uses_stress; }) + ".");
    if (velocity_force == VelocityForce::viscosity && traits.uses_stress)
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' uses the elastic stress on the contact boundary and cannot be "
        "combined with a viscous body.\nAllowed with it: " +
        names_of([](const auto &t) { return !t.uses_stress; }) + ".");
    if (find(parameters).check)
      find(parameters).check(parameters.values);
    if (redistributed_mass && !scheme.has_inertia)
      throw InputError(
        "The redistributed mass cannot be combined with the time scheme '" +
        scheme.name + "', in which nothing has inertia.\nAllowed with it: " +
        names_of_schemes([](const SchemeTraits &s) { return s.has_inertia; }) +
        ".");
    if ((velocity_force != VelocityForce::none || has_friction(parameters)) &&
        redistributed_mass && !scheme.contact_over_step)
      throw InputError(
        (velocity_force == VelocityForce::viscosity   ? "Viscosity"
           : velocity_force == VelocityForce::damping ? "Damping"
                                                      : "Friction") +
        std::string(" and the redistributed mass cannot be combined with the "
                    "time scheme '") +
        scheme.name +
        "': nodes without inertia have no velocity at an instant, against "
        "which it could act.\nAllowed with them: " +
        names_of_schemes(
          [](const SchemeTraits &s) { return s.contact_over_step; }) +
        "; or the consistent mass.");
    if (has_friction(parameters))
      {
        if (!traits.takes_friction)
          throw InputError(
            "The contact treatment '" + parameters.treatment +
            "' cannot be combined with friction.\nAllowed with it: " +
            names_of([](const auto &t) { return t.takes_friction; }) + ".");
        if (!scheme.has_rates())
          throw InputError(
            "Friction cannot be combined with the time scheme '" + scheme.name +
            "', which takes contact as a function of the displacement.\nAllowed "
            "with it: " +
            names_of_schemes(
              [](const SchemeTraits &s) { return s.has_rates(); }) +
            ".");
        if (find(parameters).make_law)
          {
            if (parameters.stick != "exact")
              RegularisedFriction::check(parameters.values);
          }
        else if (!find_friction(parameters).is_coulomb)
          throw InputError(
            "The friction law '" + parameters.friction_law +
            "' cannot be combined with the contact treatment '" +
            parameters.treatment +
            "', whose active sets in nodes know Coulomb's law only.\nAllowed "
            "with it: " +
            names_of_treatments([](const Treatment &t) {
              return t.traits.takes_friction && t.make_law;
            }) +
            ".");
      }

    const std::vector<std::string> allowed =
      schemes_allowed(parameters, redistributed_mass);
    if (std::find(allowed.begin(), allowed.end(), scheme.name) != allowed.end())
      return;

    // A two-point law requires the midpoint scheme, whatever the values of its
    // parameters.
    std::string choices;
    if (!traits.is_two_point)
      for (const OwnParameter &parameter : find(parameters).parameters)
        if (!parameter.choices.empty())
          choices += " with " +
            choice_in_words(parameter, parameters.values[parameter.name]);
    std::string message = "The contact treatment '" + parameters.treatment +
      "'" + choices + " and the " +
      (redistributed_mass ? "redistributed" : "consistent") +
      " mass cannot be combined with the time scheme '" + scheme.name +
      "'.\nAllowed with them: " + boost::algorithm::join(allowed, ", ") + ".\n";
    if (scheme.needs_potential)
      message += scheme.name +
        " integrates ordinary differential equations with a "
        "potential: " +
        names_of_potential_laws() + ", with the consistent mass.";
    else
      message +=
        "A condition over the whole step needs the two ends of a "
        "midpoint step.";
    throw InputError(message);
  }



  void
  check_pair_combination(const ContactParameters &parameters,
                         const SchemeTraits      &scheme,
                         const PairProperties    &properties)
  {
    const auto &[is_self, dim, degree, linear_material, redistributed_mass] =
      properties;
    if (is_self && parameters.coupling != "points")
      throw InputError(
        "A surface that may touch itself goes with Contact/Coupling = points "
        "only.");
    if (is_self && dim == 3 && !scheme.contact_over_step)
      throw InputError(
        "In 3D contact of a surface against itself cannot be combined with the "
        "time scheme '" +
        scheme.name +
        "': its edges are sharp, and at an instant gaps have no slope there for "
        "Newton's method.\nAllowed with it: " +
        names_of_schemes(
          [](const SchemeTraits &s) { return s.contact_over_step; }) +
        ".");
    if (degree > 1 && parameters.coupling != "points")
      throw InputError(
        "Contact/Coupling = " + parameters.coupling +
        " takes displacements of degree 1.\nAllowed with degree " +
        std::to_string(degree) + ": points.");
    if (parameters.coupling == "cut faces")
      {
        if (!linear_material)
          throw InputError(
            "Contact/Coupling = cut faces is for linear elastic bodies, whose "
            "displacements are small.\nAllowed with others: points, mortar, "
            "dual mortar.");
        if (dim == 3)
          throw InputError(
            "Contact/Coupling = cut faces is available in 2D only.\nAllowed in 3D: "
            "points, mortar, dual mortar.");
        const auto integrates = [](const ContactLawTraits &traits) {
          return !traits.nodal;
        };
        if (!integrates(find(parameters).traits))
          throw InputError(
            "The contact treatment '" + parameters.treatment +
            "' acts in nodes and cannot be combined with Contact/Coupling = cut "
            "faces.\nAllowed with it: " +
            names_of(integrates) + ". For nodes take mortar.");
        if (parameters.stick == "exact" && has_friction(parameters))
          throw InputError(
            parameters.section +
            "/Stick = exact cannot be combined with Contact/Coupling = cut faces: "
            "there are more points than displacements that they hold, and which "
            "of them stick is not unique.\nAllowed with it: regularised; or "
            "points and mortar.");
        // The schemes are those for a rigid obstacle.
        return;
      }
    const auto good = [](const ContactLawTraits &traits) {
      return !traits.uses_stress && !traits.needs_multiplier;
    };
    if (!is_self && !good(find(parameters).traits) &&
        !find(parameters).traits.nodal)
      throw InputError(
        "Between bodies the contact treatment '" + parameters.treatment +
        "' cannot be combined with Contact/Coupling = " + parameters.coupling +
        ".\nAllowed with it: cut faces, for linear elastic bodies at small "
        "displacements.");
    if (!good(find(parameters).traits))
      throw InputError("The contact treatment '" + parameters.treatment +
                       "' is one for rigid obstacles, not for contact between "
                       "bodies.\nAllowed there: " +
                       names_of(good) + ".");
    if (is_self && redistributed_mass && is_constraint(parameters))
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' of a surface against itself cannot be combined with the redistributed "
        "mass: nodes without inertia would have conditions on both sides, and "
        "more of them than can be kept.\nAllowed with it: the consistent mass; "
        "or a law: " +
        names_of_laws() + ".");
    const auto is_nodal = [](const ContactLawTraits &traits) {
      return traits.nodal && !traits.uses_stress && !traits.needs_multiplier;
    };
    if (parameters.coupling != "points" && !is_nodal(find(parameters).traits))
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' acts in quadrature points and cannot be combined with Contact/Coupling "
        "= " +
        parameters.coupling +
        ", which is for treatments in nodes.\nAllowed with it: " +
        names_of(is_nodal) + ".");
    // The reason for 3D is in MortarTriangles.
    const auto is_good_in_space = [&](const ContactLawTraits &traits) {
      return is_nodal(traits) && !(traits.is_two_point && traits.has_potential);
    };
    if (dim == 3 && parameters.coupling != "points" &&
        !is_good_in_space(find(parameters).traits))
      throw InputError(
        "In 3D the contact treatment '" + parameters.treatment +
        "' cannot be combined with Contact/Coupling = " + parameters.coupling +
        ": gaps are means over pieces that are cut anew in each step, and the "
        "energy stored at the end of one would not be returned by the next one.\nAllowed "
        "with it: " +
        names_of(is_good_in_space) + ". For others take points.");
    if (parameters.coupling != "points" && !scheme.contact_over_step)
      throw InputError(
        "Contact/Coupling = " + parameters.coupling +
        " cannot be combined with the time scheme '" + scheme.name +
        "': the pieces over which its gaps are means are cut at the beginning of a "
        "step and stay, so that there is no gap that is a function of an instant "
        "alone.\nAllowed with it: " +
        names_of_schemes(
          [](const SchemeTraits &s) { return s.contact_over_step; }) +
        "; or points.");
  }



  MultiplierSpace
  pair_multiplier_space(const ContactParameters &parameters)
  {
    const Treatment &treatment = find(parameters);
    if (parameters.coupling == "cut faces")
      return multiplier_space(parameters);
    if (treatment.make_law)
      return MultiplierSpace::none;
    // A second multiplier is for friction, or for the other facet of a concave
    // corner.
    return has_friction(parameters) ||
        (treatment.condition == ClosingCondition::signorini &&
         parameters.coupling == "points")
      ? MultiplierSpace::nodal_vector
      : MultiplierSpace::nodal;
  }



  namespace
  {
    /// The law for the scheme.
    std::unique_ptr<ContactLaw>
    make_law(const ContactParameters &parameters, const SchemeTraits &scheme)
    {
      const Treatment &treatment = find(parameters);
      return (scheme.contact_over_step && treatment.make_midpoint_law
                ? treatment.make_midpoint_law
                : treatment.make_law)(parameters.values);
    }

    /// Check that the law, which may be a user's, is what it says. @throws InputError Collective.
    ///
    /// With the length of the smallest cell of all bodies, as the order is what matters.
    template <int dim>
    void
    check_law_of(const ContactParameters &parameters,
                 const SchemeTraits      &scheme,
                 const Body<dim>         &body)
    {
      const Treatment &treatment = find(parameters);
      if (!treatment.make_law)
        return;
      const double length = GridTools::minimal_cell_diameter(
        body.dof_handler().get_triangulation());
      check_law(*treatment.make_law(parameters.values),
                parameters.treatment,
                length);
      if (scheme.contact_over_step && treatment.make_midpoint_law)
        check_law(*treatment.make_midpoint_law(parameters.values),
                  parameters.treatment,
                  length);
    }
  } // namespace



  template <int dim>
  std::unique_ptr<PairContact<dim>>
  make_pair_contact(const ContactParameters        &parameters,
                    const SchemeTraits             &scheme,
                    const Body<dim>                &body,
                    const std::vector<ContactPair> &pairs)
  {
    const Treatment &treatment = find(parameters);
    check_law_of(parameters, scheme, body);
    auto contact = std::make_unique<PairContact<dim>>(
      body,
      pairs,
      PairMethod{
        parameters.coupling == "mortar"          ? PairCoupling::mortar
          : parameters.coupling == "dual mortar" ? PairCoupling::dual_mortar
                                                 : PairCoupling::points,
        treatment.make_law ? treatment.make_law(parameters.values) : nullptr,
        treatment.make_law ? nullptr
                           : make_corner_law(10. * augmentation(parameters),
                                             scheme.contact_over_step),
        treatment.condition,
        augmentation(parameters),
        make_friction(parameters),
        exact_coefficient(parameters),
        parameters.corners,
        scheme.contact_over_step});
    contact->promise =
      energy_promise(parameters,
                     scheme,
                     parameters.coupling == "points" ? 0 : dim);
    return contact;
  }



  std::vector<UnusedParameter>
  ContactParameters::unused_parameters() const
  {
    const OwnParameters          used = used_parameters();
    std::vector<UnusedParameter> unused;
    const std::string            absent = find_friction(*this).absent(values);
    const std::string of_treatment = section + "/Treatment is " + treatment;
    const std::string of_friction =
      section + "/Friction law is " + friction_law;
    for (const OwnParameter &parameter : all_parameters())
      {
        if (declares(used, parameter.name))
          continue;
        std::string belongs_to = parameter.owner + "; ";
        if (!declares(RegularisedFriction::parameters(), parameter.name))
          belongs_to += declares(friction_table().parameters(), parameter.name)
            ? of_friction
            : of_treatment;
        else if (absent.empty())
          belongs_to += find(*this).make_law ? section + "/Stick is " + stick
                                             : of_treatment;
        else
          belongs_to = "friction; " + section + "/" + absent;
        unused.push_back({section + "/" + parameter.name, belongs_to});
      }
    if (!find(*this).make_law || !absent.empty())
      unused.push_back({section + "/Stick",
                        absent.empty()
                          ? "treatments with a law; " + of_treatment
                          : "friction; " + section + "/" + absent});
    return unused;
  }



  OwnParameters
  ContactParameters::all_parameters()
  {
    OwnParameters all = table().parameters();
    unite(all, friction_table().parameters());
    unite(all, RegularisedFriction::parameters());
    return all;
  }



  OwnParameters
  ContactParameters::used_parameters() const
  {
    const Treatment &own  = find(*this);
    OwnParameters    used = own.parameters;
    // The coefficient is used even if it is zero, which excludes friction.
    unite(used, find_friction(*this).parameters);
    if (!own.traits.piecewise_linear || has_friction(*this))
      unite(used, augmentation_parameters());
    if (own.make_law && has_friction(*this) && stick != "exact")
      unite(used, RegularisedFriction::parameters());
    return used;
  }



  namespace
  {
    /// Refuse values for which a law is not stable. @throws InputError
    void
    check_stability(const ContactParameters &parameters,
                    const double             trace_constant)
    {
      const Treatment &treatment = find(parameters);
      if (!treatment.instability)
        return;
      const std::string reason =
        treatment.instability(parameters.values, trace_constant);
      if (!reason.empty())
        throw InputError(parameters.section + "/" + reason);
    }
  } // namespace



  template <int dim>
  std::unique_ptr<ContactOperator>
  make_cut_face_contact(const ContactParameters          &parameters,
                        const SchemeTraits               &scheme,
                        const Body<dim>                  &body,
                        const std::vector<LinearElastic> &materials,
                        const std::vector<ContactPair>   &pairs)
  {
    check_law_of(parameters, scheme, body);
    const CutFaces<dim> cut_faces(body, materials, pairs);
    if (find(parameters).traits.uses_stress)
      {
        // (w_1 p_1 + w_2 p_2)^2 is not larger than w_1 p_1^2 + w_2 p_2^2.
        std::set<types::boundary_id> ids;
        for (const ContactPair &pair : pairs)
          {
            ids.insert(pair.slave.begin(), pair.slave.end());
            ids.insert(pair.master.begin(), pair.master.end());
          }
        const std::vector<double> constants = nitsche_trace_constants<dim>(
          body,
          std::vector<LinearStress<dim>>(materials.begin(), materials.end()),
          ids);
        double largest = 0.;
        for (const auto &[a, b] : cut_faces.parts)
          {
            const unsigned int i = materials.size() == 1 ? 0 : a,
                               j = materials.size() == 1 ? 0 : b;
            largest              = std::max(
              {largest,
                            constants[i] *
                              CutFaces<dim>::stress_weight(materials[i], materials[j]),
                            constants[j] *
                              CutFaces<dim>::stress_weight(materials[j], materials[i])});
          }
        check_stability(parameters, largest);
      }
    auto contact =
      std::make_unique<CutFaceContact>(body,
                                       make_law(parameters, scheme),
                                       cut_faces.points,
                                       cut_faces.slave_area,
                                       make_friction(parameters),
                                       augmentation(parameters),
                                       has_modified_energy(parameters));
    contact->promise = energy_promise(parameters, scheme);
    return contact;
  }



  template <int dim>
  std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters                     &parameters,
               const SchemeTraits                          &scheme,
               const Body<dim>                             &body,
               const std::common_type_t<LinearStress<dim>> &stress,
               const Obstacles                             &obstacles)
  {
    const Treatment &treatment = find(parameters);
    check_law_of(parameters, scheme, body);
    if (treatment.traits.uses_stress)
      check_stability(parameters,
                      nitsche_trace_constant(body, stress, obstacles));
    ContactPoints stress_points;
    if (stress || !treatment.traits.nodal)
      stress_points = make_quadrature_contact_points(body, stress, obstacles);
    ContactPoints points = treatment.traits.nodal
      ? make_nodal_contact_points(body,
                                  obstacles,
                                  treatment.traits.needs_multiplier,
                                  !treatment.make_law)
      : stress_points;
    if (!stress)
      stress_points = ContactPoints();
    std::unique_ptr<ContactOperator> contact;
    if (!treatment.make_law)
      contact =
        std::make_unique<ActiveSetContact>(body,
                                           std::move(points),
                                           std::move(stress_points),
                                           treatment.condition,
                                           augmentation(parameters),
                                           exact_coefficient(parameters));
    else
      contact =
        std::make_unique<PointwiseContact>(body,
                                           make_law(parameters, scheme),
                                           std::move(points),
                                           std::move(stress_points),
                                           make_friction(parameters),
                                           augmentation(parameters),
                                           has_modified_energy(parameters));
    contact->promise = energy_promise(parameters, scheme);
    return contact;
  }



  std::vector<std::pair<std::string, double>>
  ContactParameters::used_values() const
  {
    std::vector<std::pair<std::string, double>> list;
    const OwnParameters                         used = used_parameters();
    for (const OwnParameter &parameter : all_parameters())
      if (parameter.scale_rule && declares(used, parameter.name))
        list.emplace_back(parameter.name, values[parameter.name]);
    return list;
  }



  void
  ContactParameters::leave_open()
  {
    for (const OwnParameter &parameter : all_parameters())
      if (parameter.scale_rule)
        values[parameter.name] = 0.;
  }



  void
  ContactParameters::set_missing(const Scales &scales)
  {
    for (const OwnParameter &parameter : all_parameters())
      if (parameter.scale_rule && values[parameter.name] == 0.)
        {
          values[parameter.name] = parameter.scale_rule(scales, values);
          // A wrong sign is the rule's mistake; values beyond the bounds by the user's moduli are
          // reported by the caller.
          if (values[parameter.name] < 0.)
            parameter.check_bounds(values[parameter.name]);
        }
  }



  void
  ContactParameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection(section);
    parameters.add_parameter("Treatment",
                             treatment,
                             "How the Signorini condition is treated.",
                             Patterns::Selection(contact_treatment_names()));
    parameters.add_parameter(
      "Friction law",
      friction_law,
      "The traction at which points slip. Treatments in nodes by active "
      "sets have Coulomb's only.",
      Patterns::Selection(friction_table().names()));
    parameters.add_parameter(
      "Stick",
      stick,
      "Points that stick, of treatments that have a law for the pressure: "
      "regularised, they creep with their traction over the tangential "
      "compliance (paper A, (2.11)); exact, they do not slip, and each stage is "
      "solved in five to ten passes (augmented Lagrangian). Friction of active "
      "sets in nodes is always exact.",
      Patterns::Selection("regularised|exact"));
    values.add_parameters(all_parameters(), parameters);
    parameters.leave_subsection();
  }


  void
  ContactParameters::add_pair_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection(section);
    parameters.add_parameter(
      "Coupling",
      coupling,
      "How surfaces whose nodes do not match are coupled. points: each node (or "
      "quadrature point, as the treatment has it) of the one with the facet of the "
      "other that it faces. mortar: the mean of the gap around each node, integrated "
      "exactly, so that a uniform pressure passes. dual mortar: the same with weights "
      "that are orthogonal to the shape functions of other nodes. Both are for "
      "treatments in nodes. cut faces: points on faces that are cut where the other "
      "ones end, for Nitsche, its hybrid, penalty and the proximal augmented "
      "Lagrangian between linear elastic bodies; small displacements, and faces that "
      "face each other at the start do so for ever.",
      Patterns::Selection("points|mortar|dual mortar|cut faces"));
    parameters.add_parameter(
      "Corners",
      corners,
      "Whether corners, edges and open ends of the second surface are points against the "
      "first one, too, between whose nodes they would enter it otherwise; cut faces and "
      "self-contact have none.");
    parameters.leave_subsection();
  }


  template std::unique_ptr<PairContact<1>>
  make_pair_contact(const ContactParameters &,
                    const SchemeTraits &,
                    const Body<1> &,
                    const std::vector<ContactPair> &);
  template std::unique_ptr<PairContact<2>>
  make_pair_contact(const ContactParameters &,
                    const SchemeTraits &,
                    const Body<2> &,
                    const std::vector<ContactPair> &);
  template std::unique_ptr<PairContact<3>>
  make_pair_contact(const ContactParameters &,
                    const SchemeTraits &,
                    const Body<3> &,
                    const std::vector<ContactPair> &);
  template std::unique_ptr<ContactOperator>
  make_cut_face_contact(const ContactParameters &,
                        const SchemeTraits &,
                        const Body<2> &,
                        const std::vector<LinearElastic> &,
                        const std::vector<ContactPair> &);
  template std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters &,
               const SchemeTraits &,
               const Body<1> &,
               const LinearStress<1> &,
               const Obstacles &);
  template std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters &,
               const SchemeTraits &,
               const Body<2> &,
               const LinearStress<2> &,
               const Obstacles &);
  template std::unique_ptr<ContactOperator>
  make_contact(const ContactParameters &,
               const SchemeTraits &,
               const Body<3> &,
               const LinearStress<3> &,
               const Obstacles &);
} // namespace Ricochet
