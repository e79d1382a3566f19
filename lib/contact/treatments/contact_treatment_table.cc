// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <contact/kinematics/cut_faces.h>
#include <contact/treatments/active_set_contact.h>
#include <contact/treatments/contact_treatment.h>
#include <contact/laws/augmented_lagrangian.h>
#include <contact/laws/nitsche.h>
#include <contact/laws/nitsche_two_point.h>
#include <contact/laws/normal_compliance.h>
#include <contact/laws/penalty.h>
#include <contact/laws/signorini_multiplier.h>
#include <contact/treatments/cut_face_contact.h>
#include <contact/treatments/nitsche_bound.h>
#include <contact/treatments/pair_contact.h>
#include <contact/treatments/pointwise_contact.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    struct Treatment
    {
      std::string      name;
      ContactLawTraits traits;
      /// Makes the pointwise law; empty for active sets, which have none.
      std::function<std::unique_ptr<ContactLaw>(const ContactParameters &)>
        make_law;
      /// The law within a midpoint step, if it is another one.
      std::function<std::unique_ptr<ContactLaw>(const ContactParameters &)>
        make_midpoint_law = {};
      /// What an active set imposes.
      ClosingCondition condition = ClosingCondition::signorini;
      /// The promise over the steps of the midpoint scheme.
      EnergyPromise promise = {};
    };

    using Promise = EnergyPromise::Kind;

    const EnergyPromise keeps_by_quotient = {
      Promise::keeps,
      "the pressure is the quotient of potential and gap increment, so that its work is "
      "the change of the potential"};
    const EnergyPromise keeps_by_no_work = {
      Promise::keeps,
      "pressure times gap increment is zero in each point, so that contact does no work"};
    const EnergyPromise falls_by_convexity = {
      Promise::never_gains,
      "the force is the slope, at the end of the step, of a potential that is convex in "
      "the gap: the potential grows by no more than the work"};
    const EnergyPromise falls_by_complementarity = {
      Promise::never_gains,
      "where there is pressure the gap is zero at the end of the step, and was not "
      "negative at its beginning, so that its increment is not positive"};

    template <typename Law>
    std::unique_ptr<ContactLaw>
    pointwise(const Law &law)
    {
      return std::make_unique<ContactLawImplementation<Law>>(law);
    }

    /// Nodal, no multipliers, no potential: a constraint.
    constexpr ContactLawTraits
    active_set_traits(const bool is_two_point)
    {
      ContactLawTraits traits;
      traits.nodal          = true;
      traits.has_potential  = false;
      traits.takes_friction = true;
      traits.is_two_point   = is_two_point;
      return traits;
    }

    CompliancePotential
    compliance(const ContactParameters &p)
    {
      return {p.compliance_coefficient, p.compliance_exponent};
    }

    // The table of all contact treatments: a new pointwise law is one file in
    // laws/ and one line here.
    const std::vector<Treatment> &
    table()
    {
      using P                                        = ContactParameters;
      static const std::vector<Treatment> treatments = {
        {"Nitsche",
         Nitsche::traits(),
         [](const P &p) {
           return pointwise(Nitsche{p.nitsche_gamma_0, p.nitsche_theta});
         },
         [](const P &p) {
           return pointwise(
             NitscheTwoPoint{p.nitsche_gamma_0,
                             p.nitsche_theta,
                             NitscheTwoPoint::Evaluation::end_of_step});
         },
         {},
         {Promise::never_gains,
          "the part of the potential that is convex is taken at the end of the step, the "
          "quadratic rest in its middle"}},
        {"Nitsche-hybrid",
         NitscheTwoPoint::traits(),
         [](const P &p) {
           return pointwise(
             NitscheTwoPoint{p.nitsche_gamma_0,
                             p.nitsche_theta,
                             NitscheTwoPoint::Evaluation::hybrid});
         },
         {},
         {},
         {Promise::never_gains,
          "each of its two means grows by no more than its work where it is taken (Chouly et "
          "al. 2015, part 2; paper C, A.3, says that it is stable)"}},
        {"penalty",
         Penalty::traits(),
         [](const P &p) { return pointwise(Penalty{p.penalty_epsilon_0}); },
         {},
         {},
         falls_by_convexity},
        {"proximal augmented Lagrangian",
         ProximalAugmentedLagrangian::traits(),
         [](const P &p) {
           return pointwise(ProximalAugmentedLagrangian{p.augmentation});
         },
         {},
         {},
         {Promise::never_gains,
          "the potential, at its largest over the multipliers, is convex in the gaps, and "
          "the force is its slope at the end of the step"}},
        {"Signorini multipliers",
         SignoriniMultiplier::traits(),
         [](const P &p) {
           return pointwise(SignoriniMultiplier{p.augmentation});
         },
         {},
         {},
         falls_by_complementarity},
        {"Signorini active set",
         active_set_traits(false),
         {},
         {},
         ClosingCondition::signorini,
         falls_by_complementarity},
        {"standard normal compliance",
         StandardNormalCompliance::traits(),
         [](const P &p) {
           return pointwise(StandardNormalCompliance{compliance(p)});
         },
         {},
         {},
         falls_by_convexity},
        {"standard normal compliance at midpoint",
         MidpointNormalCompliance::traits(),
         [](const P &p) {
           return pointwise(MidpointNormalCompliance{{compliance(p)}});
         },
         {},
         {},
         {Promise::none,
          "the pressure of the mean gap is neither a quotient nor a slope of the "
          "potential, and its work can be any"}},
        {"improved normal compliance",
         ImprovedNormalCompliance::traits(),
         [](const P &p) {
           return pointwise(ImprovedNormalCompliance{{compliance(p)}});
         },
         {},
         {},
         keeps_by_quotient},
        {"Hauret-Le Tallec",
         HauretLeTallec::traits(),
         [](const P &p) {
           return pointwise(HauretLeTallec{
             {CompliancePotential{p.compliance_coefficient, 2.}}});
         },
         {},
         {},
         keeps_by_quotient},
        {"persistent contact",
         active_set_traits(true),
         {},
         {},
         ClosingCondition::persistent,
         keeps_by_no_work},
        {"Ayyad-Barboteu two-step",
         active_set_traits(true),
         {},
         {},
         ClosingCondition::two_step,
         {Promise::keeps,
          "in the second pass pressure times gap increment is zero in each point, and the "
          "first one leaves no trace"}}};
      return treatments;
    }

    const Treatment &
    find(const ContactParameters &parameters)
    {
      for (const Treatment &treatment : table())
        if (treatment.name == parameters.treatment)
          return treatment;
      AssertThrow(false,
                  ExcMessage("unknown contact treatment " +
                             parameters.treatment));
      return table().front();
    }
  } // namespace



  namespace
  {
    /// Nitsche's method has a potential in its symmetric variant only. A
    /// constraint stores nothing.
    bool
    has_modified_energy(const ContactParameters &parameters)
    {
      return !find(parameters).traits.uses_stress ||
        parameters.nitsche_theta == 1.;
    }
  } // namespace



  EnergyPromise
  energy_promise(const ContactParameters &parameters,
                 const SchemeTraits      &scheme,
                 const unsigned int       mortar_dim)
  {
    const ContactLawTraits traits = find(parameters).traits;
    if (scheme.needs_potential)
      return {Promise::none,
              "the time scheme " + scheme.name +
                " keeps the total energy to its tolerance only"};
    if (!scheme.contact_over_step)
      return {
        Promise::none,
        "the time scheme " + scheme.name +
          " takes contact forces at instants, and the mean of two of them is no "
          "change of a potential over its step"};
    if (!has_modified_energy(parameters))
      return {Promise::none,
              "with theta = " + to_text(parameters.nitsche_theta) +
                " Nitsche's method has no potential"};
    if (mortar_dim == 3 && traits.has_potential)
      return {
        Promise::none,
        "in 3D gaps of mortar are means over pieces that are cut anew in each "
        "step, so that the potential jumps in between"};
    return find(parameters).promise;
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
    for (const Treatment &treatment : table())
      {
        ContactParameters parameters;
        parameters.treatment = treatment.name;
        add(treatment.name, energy_promise(parameters, midpoint));
        if (!treatment.traits.uses_stress)
          continue;
        parameters.nitsche_theta = -1.;
        add(treatment.name + ", theta = -1",
            energy_promise(parameters, midpoint));
        parameters.nitsche_theta = 0.;
        add(treatment.name + ", theta = 0",
            energy_promise(parameters, midpoint));
      }
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
    std::string names;
    for (const Treatment &treatment : table())
      names += (names.empty() ? "" : "|") + treatment.name;
    return names;
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
          (is_function || !scheme.needs_potential))
        schemes.push_back(scheme.name);
    return schemes;
  }



  namespace
  {
    std::string
    join(const std::vector<std::string> &words)
    {
      std::string text;
      for (const std::string &word : words)
        text += (text.empty() ? "" : ", ") + word;
      return text;
    }

    /// The names of all treatments whose traits are good.
    std::string
    names_of(const std::function<bool(const ContactLawTraits &)> &good)
    {
      std::vector<std::string> names;
      for (const Treatment &treatment : table())
        if (good(treatment.traits))
          names.push_back(treatment.name);
      return join(names);
    }
  } // namespace



  std::string
  names_of_laws()
  {
    std::vector<std::string> names;
    for (const Treatment &treatment : table())
      if (treatment.make_law && !treatment.traits.needs_multiplier)
        names.push_back(treatment.name);
    return join(names);
  }



  void
  check_combination(const ContactParameters &parameters,
                    const SchemeTraits      &scheme,
                    const bool               redistributed_mass,
                    const bool               linear_material,
                    const bool               viscous)
  {
    const ContactLawTraits traits = find(parameters).traits;
    if (parameters.compliance_exponent < 2.)
      throw InputError(
        "The exponent alpha of normal compliance must be at least 2 (the "
        "regularisation of paper A, (2.7)); it is " +
        to_text(parameters.compliance_exponent) + ".");
    if (parameters.friction_coefficient < 0.)
      throw InputError("The friction coefficient must not be negative; it is " +
                       to_text(parameters.friction_coefficient) + ".");
    if (!linear_material && traits.uses_stress)
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' uses the stress of a linear elastic body on the contact boundary "
        "and cannot be combined with a hyperelastic one.\nAllowed with it: " +
        names_of([](const auto &t) { return !t.uses_stress; }) + ".");
    if (viscous && traits.uses_stress)
      throw InputError(
        "The contact treatment '" + parameters.treatment +
        "' uses the elastic stress on the contact boundary and cannot be "
        "combined with a viscous body.\nAllowed with it: " +
        names_of([](const auto &t) { return !t.uses_stress; }) + ".");
    if (parameters.treatment == "Hauret-Le Tallec" &&
        parameters.compliance_exponent != 2.)
      throw InputError(
        "Hauret-Le Tallec is a penalisation with the exponent 2; Contact/"
        "Compliance exponent is " +
        to_text(parameters.compliance_exponent) +
        ". For others take improved normal compliance.");
    if (parameters.friction_coefficient > 0.)
      {
        if (!traits.takes_friction)
          throw InputError(
            "The contact treatment '" + parameters.treatment +
            "' cannot be combined with friction.\nAllowed with it: " +
            names_of([](const auto &t) { return t.takes_friction; }) + ".");
        if (!scheme.contact_over_step)
          throw InputError(
            "Friction cannot be combined with the time scheme '" + scheme.name +
            "'.\nAllowed with it: midpoint. There friction acts against the "
            "mean slip rate of the step, so that its work is never negative.");
        if (find(parameters).make_law &&
            !(parameters.tangential_compliance > 0.))
          throw InputError(
            "The tangential compliance must be positive; it is " +
            to_text(parameters.tangential_compliance) + ".");
      }

    const std::vector<std::string> allowed =
      schemes_allowed(parameters, redistributed_mass);
    if (std::find(allowed.begin(), allowed.end(), scheme.name) != allowed.end())
      return;

    std::string message = "The contact treatment '" + parameters.treatment +
      (parameters.treatment == "Nitsche"
         ? "' with theta = " + to_text(parameters.nitsche_theta)
         : "'") +
      " and the " + (redistributed_mass ? "redistributed" : "consistent") +
      " mass cannot be combined with the time scheme '" + scheme.name +
      "'.\nAllowed with them: " + join(allowed) + ".\n";
    if (scheme.needs_potential)
      message += scheme.name +
        " integrates ordinary differential equations with a "
        "potential: Nitsche with theta = 1, penalty or standard normal "
        "compliance, with the consistent mass.";
    else
      message +=
        "A condition over the whole step needs the two ends of a "
        "midpoint step.";
    throw InputError(message);
  }



  void
  check_pair_combination(const ContactParameters &parameters,
                         const SchemeTraits      &scheme,
                         const bool               is_self,
                         const unsigned int       dim)
  {
    if (parameters.coupling == "cut faces")
      {
        if (dim == 3)
          throw InputError(
            "Contact/Coupling = cut faces is there in the plane only.\nAllowed in "
            "space: points, mortar, dual mortar.");
        const auto integrates = [](const ContactLawTraits &traits) {
          return !traits.nodal;
        };
        if (!integrates(find(parameters).traits))
          throw InputError(
            "The contact treatment '" + parameters.treatment +
            "' acts in nodes and cannot be combined with Contact/Coupling = cut "
            "faces.\nAllowed with it: " +
            names_of(integrates) + ". For nodes take mortar.");
        // The schemes are those that go with a rigid obstacle.
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
    // See MortarTriangles.
    const auto is_good_in_space = [&](const ContactLawTraits &traits) {
      return is_nodal(traits) && !(traits.is_two_point && traits.has_potential);
    };
    if (dim == 3 && parameters.coupling != "points" &&
        !is_good_in_space(find(parameters).traits))
      throw InputError(
        "In space the contact treatment '" + parameters.treatment +
        "' cannot be combined with Contact/Coupling = " + parameters.coupling +
        ": gaps are means over pieces that are cut anew in each step, and what was "
        "stored at the end of one would not be what the next one gives back.\nAllowed "
        "with it: " +
        names_of(is_good_in_space) + ". For others take points.");
    if (!scheme.contact_over_step)
      throw InputError(
        "Contact between bodies cannot be combined with the time "
        "scheme '" +
        scheme.name +
        "'.\nAllowed with it: midpoint, over whose steps the work "
        "of a contact force is exactly pressure times the change "
        "of the gap.");
  }



  MultiplierSpace
  pair_multiplier_space(const ContactParameters &parameters)
  {
    const Treatment &treatment = find(parameters);
    if (parameters.coupling == "cut faces")
      return multiplier_space(parameters);
    if (treatment.make_law)
      return MultiplierSpace::none;
    // A second multiplier is for friction, or for the other facet of a valley.
    return parameters.friction_coefficient > 0. ||
        (treatment.condition == ClosingCondition::signorini &&
         parameters.coupling == "points")
      ? MultiplierSpace::nodal_vector
      : MultiplierSpace::nodal;
  }



  template <int dim>
  std::unique_ptr<PairContact<dim>>
  make_pair_contact(const ContactParameters        &parameters,
                    const SchemeTraits             &scheme,
                    const Body<dim>                &body,
                    const std::vector<ContactPair> &pairs)
  {
    const Treatment &treatment = find(parameters);
    auto             contact   = std::make_unique<PairContact<dim>>(
      body,
      pairs,
      PairMethod{parameters.coupling == "mortar" ? PairCoupling::mortar
                                 : parameters.coupling == "dual mortar"
                                 ? PairCoupling::dual_mortar
                                 : PairCoupling::points,
                 treatment.make_law ? treatment.make_law(parameters) : nullptr,
                 treatment.condition,
                 parameters.augmentation,
                 {parameters.friction_coefficient,
                                parameters.tangential_compliance}});
    contact->promise =
      energy_promise(parameters,
                     scheme,
                     parameters.coupling == "points" ? 0 : dim);
    return contact;
  }



  std::vector<UnusedParameter>
  ContactParameters::unused_parameters() const
  {
    const Treatment             &own = find(*this);
    std::vector<UnusedParameter> unused;
    const auto                   need =
      [&](const bool used, const std::string &name, const std::string &owner) {
        if (!used)
          unused.push_back(
            {section + "/" + name,
             owner + "; " + section + "/Treatment is " + treatment});
      };
    const bool compliant        = own.make_law && !own.traits.piecewise_linear;
    const bool exponent_is_free = treatment != "Hauret-Le Tallec";
    const bool friction         = friction_coefficient > 0.;
    need(own.traits.uses_stress, "Nitsche gamma0", "Nitsche's method");
    need(own.traits.uses_stress, "Nitsche theta", "Nitsche's method");
    need(treatment == "penalty", "Penalty epsilon0", "penalty");
    need(compliant, "Compliance coefficient", "normal compliance");
    need(compliant && exponent_is_free,
         "Compliance exponent",
         "standard and improved normal compliance");
    need(!own.make_law || own.traits.needs_multiplier || compliant || friction,
         "Augmentation",
         "multipliers, active sets, normal compliance and friction");
    if (!friction)
      unused.push_back({section + "/Tangential compliance",
                        "friction; " + section + "/Friction coefficient is 0"});
    else
      need(bool(own.make_law), "Tangential compliance", "regularised friction");
    return unused;
  }



  namespace
  {
    /// Refuse a parameter with which Nitsche's method is not stable: energy could
    /// grow without bound.
    void
    check_nitsche_bound(const ContactParameters &parameters,
                        const double             trace_constant)
    {
      const double theta = parameters.nitsche_theta;
      const double bound = .25 * (1. + theta) * (1. + theta) * trace_constant;
      // Equal is not enough, and both come with round-off.
      if (parameters.nitsche_gamma_0 > (1. + 1e-9) * bound)
        return;
      throw InputError(
        parameters.section +
        "/Nitsche gamma0 = " + to_text(parameters.nitsche_gamma_0) +
        " is too small for theta = " + to_text(theta) +
        ", this material and this mesh: the method is not stable. It must be "
        "larger than " +
        to_text(bound) + ".");
    }
  } // namespace



  namespace
  {
    /// The law as the scheme needs it.
    std::unique_ptr<ContactLaw>
    make_law(const ContactParameters &parameters, const SchemeTraits &scheme)
    {
      const Treatment &treatment = find(parameters);
      return (scheme.contact_over_step && treatment.make_midpoint_law
                ? treatment.make_midpoint_law
                : treatment.make_law)(parameters);
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
        check_nitsche_bound(parameters, largest);
      }
    auto contact = std::make_unique<CutFaceContact>(
      body,
      make_law(parameters, scheme),
      cut_faces.points,
      cut_faces.slave_area,
      CoulombFriction{parameters.friction_coefficient,
                      parameters.tangential_compliance},
      parameters.augmentation,
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
    if (treatment.traits.uses_stress)
      check_nitsche_bound(parameters,
                          nitsche_trace_constant(body, stress, obstacles));
    ContactPoints stress_points;
    if (stress || !treatment.traits.nodal)
      stress_points = make_quadrature_contact_points(body, stress, obstacles);
    ContactPoints points = treatment.traits.nodal
      ? make_nodal_contact_points(body,
                                  obstacles,
                                  treatment.traits.needs_multiplier)
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
                                           parameters.augmentation,
                                           parameters.friction_coefficient);
    else
      contact = std::make_unique<PointwiseContact>(
        body,
        make_law(parameters, scheme),
        std::move(points),
        std::move(stress_points),
        CoulombFriction{parameters.friction_coefficient,
                        parameters.tangential_compliance},
        parameters.augmentation,
        has_modified_energy(parameters));
    contact->promise = energy_promise(parameters, scheme);
    return contact;
  }



  std::vector<std::pair<std::string, double>>
  ContactParameters::used_values() const
  {
    std::vector<std::pair<std::string, double>> values = {
      {"Nitsche gamma0", nitsche_gamma_0},
      {"Penalty epsilon0", penalty_epsilon_0},
      {"Augmentation", augmentation},
      {"Compliance coefficient", compliance_coefficient},
      {"Tangential compliance", tangential_compliance}};
    for (const UnusedParameter &unused : unused_parameters())
      values.erase(std::remove_if(values.begin(),
                                  values.end(),
                                  [&](const auto &value) {
                                    return unused.name ==
                                      section + "/" + value.first;
                                  }),
                   values.end());
    return values;
  }



  void
  ContactParameters::leave_open()
  {
    nitsche_gamma_0 = penalty_epsilon_0 = augmentation =
      compliance_coefficient = tangential_compliance = 0.;
  }



  void
  ContactParameters::set_missing(const Scales &scales)
  {
    const auto set = [](double &value, const double other) {
      if (value == 0.)
        value = other;
    };
    const double h = scales.cell_diameter;
    set(nitsche_gamma_0,
        20. * scales.degree * scales.degree * scales.wave_modulus);
    set(penalty_epsilon_0, .1 / scales.wave_modulus);
    set(augmentation, scales.young_modulus);
    set(compliance_coefficient,
        10. * scales.wave_modulus / std::pow(h, compliance_exponent - 1.));
    set(tangential_compliance,
        std::sqrt(scales.young_modulus * scales.density));
  }



  void
  ContactParameters::add_parameters(ParameterHandler &parameters)
  {
    // Zero is for what is still to be found.
    const auto at_least = [](const double &value) {
      return Patterns::Double(value == 0. ? 0. : 1e-30);
    };
    parameters.enter_subsection(section);
    parameters.add_parameter("Treatment",
                             treatment,
                             "How the Signorini condition is treated.",
                             Patterns::Selection(contact_treatment_names()));
    parameters.add_parameter(
      "Nitsche gamma0",
      nitsche_gamma_0,
      "Parameter gamma_0 (Pa) of Nitsche's method; gamma = gamma_0/h_T (paper "
      "C, (7)). Used by Nitsche and Nitsche-hybrid.",
      at_least(nitsche_gamma_0));
    parameters.add_parameter(
      "Nitsche theta",
      nitsche_theta,
      "Variant of Nitsche's method: 1 symmetric, -1 skew-symmetric, 0 "
      "non-symmetric. Used by Nitsche and Nitsche-hybrid.",
      Patterns::Selection("1|-1|0"));
    parameters.add_parameter(
      "Penalty epsilon0",
      penalty_epsilon_0,
      "Parameter epsilon_0 (1/Pa) of the penalty method; epsilon = epsilon_0 "
      "h_T (paper C, (14)). Used by penalty.",
      at_least(penalty_epsilon_0));
    parameters.add_parameter(
      "Augmentation",
      augmentation,
      "Parameter gamma_a (Pa) of the proximal augmented Lagrangian (paper C, "
      "(18)). For the other treatments it steers Newton's method, best with "
      "about Young's modulus, and leaves the solution alone.",
      at_least(augmentation));
    parameters.add_parameter(
      "Compliance coefficient",
      compliance_coefficient,
      "Parameter c_nu (Pa/m^(alpha-1)) of normal compliance: pressure c_nu "
      "alpha/2 penetration^(alpha-1) (paper A, (2.10)). Used by standard and "
      "improved normal compliance and, with alpha = 2, Hauret-Le Tallec.",
      at_least(compliance_coefficient));
    parameters.add_parameter(
      "Compliance exponent",
      compliance_exponent,
      "Exponent alpha of normal compliance, at least 2. Used by standard and "
      "improved normal compliance.",
      Patterns::Double());
    parameters.add_parameter(
      "Friction coefficient",
      friction_coefficient,
      "Coulomb's coefficient mu of friction; 0 for none. Stick and slip are "
      "exact with Signorini active set, persistent contact and "
      "Ayyad-Barboteu two-step, regularised with the others.",
      Patterns::Double());
    parameters.add_parameter(
      "Tangential compliance",
      tangential_compliance,
      "Parameter c_tau (Pa s/m) of regularised friction: while a point "
      "sticks, its traction is c_tau times the slip rate (paper A, (2.11)). "
      "Used with friction by the treatments that regularise it.",
      Patterns::Double());
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
      "other before it. mortar: the mean of the gap around each node, integrated "
      "exactly, so that a uniform pressure passes. dual mortar: the same with weights "
      "that are orthogonal to the shape functions of other nodes. Both are for "
      "treatments in nodes. cut faces: points on faces that are cut where the other "
      "ones end, for Nitsche, its hybrid, penalty and the proximal augmented "
      "Lagrangian between linear elastic bodies; small displacements, what is before "
      "what stays as it is at the start.",
      Patterns::Selection("points|mortar|dual mortar|cut faces"));
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
