// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <materials/law_check.h>
#include <materials/material_parameters.h>
#include <materials/material_table.h>
#include <time_integration/scheme_traits.h>

#include <map>
#include <vector>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// "Elastic law. ...: small strains and rotations. A, B and C: large ones."
    std::string
    documentation_of_laws()
    {
      const auto &table = material_table();
      std::string text  = "Elastic law. " + table.begin()->name +
        ": small strains and rotations. ";
      for (unsigned int k = 1; k < table.size(); ++k)
        {
          const MaterialEntry &entry = table.begin()[k];
          text += k == 1 ? "" : k + 1 < table.size() ? ", " : " and ";
          text += entry.name;
          if (!entry.remark.empty())
            text += " (" + entry.remark + ")";
        }
      return text + ": large ones.";
    }

    const std::map<std::string, Viscosity::Law> viscosities = {
      {"none", Viscosity::Law::none},
      {"linear", Viscosity::Law::linear},
      {"Kelvin-Voigt", Viscosity::Law::kelvin_voigt},
      {"Curnier", Viscosity::Law::curnier},
      {"Pioletti", Viscosity::Law::pioletti}};
  } // namespace



  void
  MaterialParameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection(section);
    parameters.add_parameter("Law",
                             law,
                             documentation_of_laws(),
                             Patterns::Selection(material_table().names()));
    parameters.add_parameter("Plane state",
                             plane_state,
                             "What a body in 2D stands for: a thin sheet "
                             "(plane stress) or a section of a long body "
                             "(plane strain). In 3D only plane strain is "
                             "accepted, and means nothing.",
                             Patterns::Selection("plane stress|plane strain"));
    parameters.add_parameter("Density",
                             density,
                             "Referential density (kg/m^3).",
                             Patterns::Double(1e-30));
    values.add_parameters(all_parameters(), parameters);
    parameters.add_parameter(
      "Viscosity",
      viscosity,
      "Viscous power density: linear, eta/2 tr(strain rate^2) (paper B, "
      "(6.1)), and Kelvin-Voigt, eta/(2 mu) times half of the elastic energy "
      "of the strain rate, for linear elastic bodies; Curnier, eta/2 "
      "tr(C_dot^2), and Pioletti, eta/4 tr(C_dot^2) (tr C - 3) (B, (2.14)), "
      "for hyperelastic ones.",
      Patterns::Selection("none|linear|Kelvin-Voigt|Curnier|Pioletti"));
    parameters.add_parameter("Viscosity eta",
                             viscosity_eta,
                             "Parameter eta of the viscosity (Pa s); 0 for an "
                             "elastic body.",
                             Patterns::Double(0.));
    parameters.add_parameter(
      "Mass damping",
      mass_damping,
      "Damping in proportion to the mass, alpha of Rayleigh's (1/s): the force "
      "per mass is alpha times the velocity, against it. It takes momentum, "
      "as a viscous fluid around the body would.",
      Patterns::Double(0.));
    parameters.leave_subsection();
  }



  std::vector<UnusedParameter>
  MaterialParameters::unused_parameters() const
  {
    const OwnParameters         &used = material_table()[law].parameters;
    std::vector<UnusedParameter> unused;
    for (const OwnParameter &parameter : all_parameters())
      if (!declares(used, parameter.name))
        unused.push_back({section + "/" + parameter.name,
                          parameter.owner + "; " + section + "/Law is " + law});
    return unused;
  }



  OwnParameters
  MaterialParameters::all_parameters()
  {
    return material_table().parameters();
  }



  std::vector<std::string>
  MaterialParameters::names()
  {
    std::vector<std::string> list = {"Law", "Plane state", "Density"};
    for (const OwnParameter &parameter : all_parameters())
      list.push_back(parameter.name);
    list.insert(list.end(), {"Viscosity", "Viscosity eta", "Mass damping"});
    return list;
  }



  PlaneState
  MaterialParameters::state(const unsigned int dim) const
  {
    return dim == 3 || plane_state == "plane strain" ? PlaneState::plane_strain
                                                     : PlaneState::plane_stress;
  }



  void
  MaterialParameters::validate(const unsigned int dim,
                               const std::string &scheme) const
  {
    if (dim == 3 && plane_state == "plane stress")
      throw InputError("Plane stress has no meaning for a body in 3D: set " +
                       section + "/Plane state to plane strain.");
    values.check(all_parameters());
    if (const auto &check = material_table()[law].check)
      check(values, state(dim));
    if (const auto &make_law = material_table()[law].make)
      check_law(*make_law(values), law);
    if (viscosity == "none" && viscosity_eta > 0.)
      throw InputError(section + "/Viscosity eta is " + to_text(viscosity_eta) +
                       " and " + section +
                       "/Viscosity is none: name a viscosity "
                       "(linear, Kelvin-Voigt, Curnier, Pioletti) or set eta "
                       "to 0.");
    if (viscosity == "none" && mass_damping == 0.)
      return;
    const bool small_strains = is_linear();
    if (viscosity != "none" &&
        small_strains != (viscosity == "linear" || viscosity == "Kelvin-Voigt"))
      throw InputError(
        "The viscosity '" + viscosity + "' does not go with the law '" + law +
        "'. Allowed with it: " +
        (small_strains ? "none, linear, Kelvin-Voigt."
                       : "none, Curnier, Pioletti (the linear ones are not "
                         "invariant under rotations)."));
    if (!scheme_traits(scheme).has_rates())
      throw InputError(
        std::string(viscosity == "none" ? "Damping" : "Viscosity") +
        " cannot be combined with the time scheme '" + scheme +
        "', whose forces are functions of the "
        "displacement.\nAllowed with it: " +
        names_of_schemes([](const SchemeTraits &s) { return s.has_rates(); }) +
        ".");
  }



  LinearElastic
  MaterialParameters::at_small_strains() const
  {
    return material_table()[law].at_small_strains(values);
  }



  Scales
  MaterialParameters::scales(const double       cell_diameter,
                             const unsigned int degree,
                             const double       cell_depth) const
  {
    const LinearElastic elastic      = at_small_strains();
    const double        wave_modulus = elastic.lambda + 2. * elastic.mu;
    return {elastic.mu * (3. * elastic.lambda + 2. * elastic.mu) /
              (elastic.lambda + elastic.mu),
            wave_modulus,
            density,
            cell_diameter,
            cell_depth > 0. ? cell_depth : cell_diameter,
            degree};
  }



  template <int dim>
  Material<dim>
  MaterialParameters::make() const
  {
    const MaterialEntry &entry = material_table()[law];
    const Viscosity      viscous{viscosities.at(viscosity),
                            viscosity_eta,
                            mass_damping};
    if (!entry.make)
      return Material<dim>(entry.at_small_strains(values).in_plane(state(dim)),
                           viscous,
                           state(dim));
    return Material<dim>(std::make_shared<Hyperelastic<dim>>(entry.make(values),
                                                             state(dim)),
                         viscous);
  }


  template Material<2>
  MaterialParameters::make() const;
  template Material<3>
  MaterialParameters::make() const;
} // namespace Ricochet
