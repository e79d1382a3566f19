// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/ciarlet_geymonat.h>
#include <materials/laws/neo_hookean.h>
#include <materials/laws/saint_venant_kirchhoff.h>
#include <materials/material_parameters.h>

#include <functional>
#include <map>
#include <vector>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    template <typename Law>
    std::shared_ptr<const HyperelasticLaw>
    hyperelastic(const Law &law)
    {
      return std::make_shared<HyperelasticLawImplementation<Law>>(law);
    }

    const std::string linear_elastic = "linear elastic";

    // The table of hyperelastic laws: a new one is one file in laws/ and one
    // entry here.
    using Maker = std::function<std::shared_ptr<const HyperelasticLaw>(
      const MaterialParameters &)>;
    const std::vector<std::pair<std::string, Maker>> &
    table()
    {
      const auto lame = [](const MaterialParameters &p) {
        return LinearElastic::from_young(p.young_modulus, p.poisson_ratio);
      };
      static const std::vector<std::pair<std::string, Maker>> laws = {
        {"Ciarlet-Geymonat",
         [](const auto &p) {
           return hyperelastic(CiarletGeymonat{p.c1, p.c2, p.d});
         }},
        {"Saint Venant-Kirchhoff",
         [lame](const auto &p) {
           return hyperelastic(
             SaintVenantKirchhoff{lame(p).lambda, lame(p).mu});
         }},
        {"neo-Hookean", [lame](const auto &p) {
           return hyperelastic(NeoHookean{lame(p).lambda, lame(p).mu});
         }}};
      return laws;
    }

    const std::map<std::string, Viscosity::Law> viscosities = {
      {"none", Viscosity::Law::none},
      {"linear", Viscosity::Law::linear},
      {"Curnier", Viscosity::Law::curnier},
      {"Pioletti", Viscosity::Law::pioletti}};
  } // namespace



  void
  MaterialParameters::add_parameters(ParameterHandler &parameters)
  {
    std::string laws = linear_elastic;
    for (const auto &entry : table())
      laws += "|" + entry.first;

    parameters.enter_subsection(section);
    parameters.add_parameter(
      "Law",
      law,
      "Elastic law. linear elastic: small strains and rotations. "
      "Ciarlet-Geymonat (papers A and B call it Ogden's), Saint "
      "Venant-Kirchhoff and neo-Hookean: large ones.",
      Patterns::Selection(laws));
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
    parameters.add_parameter(
      "Young modulus",
      young_modulus,
      "Young's modulus (Pa). Not used by Ciarlet-Geymonat.",
      Patterns::Double(1e-30));
    parameters.add_parameter(
      "Poisson ratio",
      poisson_ratio,
      "Poisson's ratio, above -1 and below 1/2. Not used by "
      "Ciarlet-Geymonat.",
      Patterns::Double(-1., .5));
    parameters.add_parameter("c1",
                             c1,
                             "Factor of I1 - 3 (Pa). Used by Ciarlet-Geymonat.",
                             Patterns::Double(1e-30));
    parameters.add_parameter("c2",
                             c2,
                             "Factor of I2 - 3 (Pa). Used by Ciarlet-Geymonat.",
                             Patterns::Double(0.));
    parameters.add_parameter("d",
                             d,
                             "Factor of I3 - 1 (Pa). Used by Ciarlet-Geymonat.",
                             Patterns::Double(1e-30));
    parameters.add_parameter(
      "Viscosity",
      viscosity,
      "Viscous power density: linear, eta/2 tr(strain rate^2) (paper B, "
      "(6.1)), for linear elastic bodies; Curnier, eta/2 tr(C_dot^2), and "
      "Pioletti, eta/4 tr(C_dot^2) (tr C - 3) (B, (2.14)), for hyperelastic "
      "ones.",
      Patterns::Selection("none|linear|Curnier|Pioletti"));
    parameters.add_parameter("Viscosity eta",
                             viscosity_eta,
                             "Parameter eta of the viscosity (Pa s); 0 for an "
                             "elastic body.",
                             Patterns::Double(0.));
    parameters.leave_subsection();
  }



  std::vector<UnusedParameter>
  MaterialParameters::unused_parameters() const
  {
    std::vector<UnusedParameter> unused;
    const auto need = [&](const std::string &owner, const auto &...names) {
      for (const char *name : {names...})
        unused.push_back(
          {section + "/" + name, owner + "; " + section + "/Law is " + law});
    };
    if (law == "Ciarlet-Geymonat")
      need("the other laws", "Young modulus", "Poisson ratio");
    else
      need("the law Ciarlet-Geymonat", "c1", "c2", "d");
    return unused;
  }



  void
  MaterialParameters::validate(const unsigned int dim,
                               const std::string &scheme) const
  {
    if (dim == 3 && plane_state == "plane stress")
      throw InputError("Plane stress has no meaning for a body in 3D: set " +
                       section + "/Plane state to plane strain.");
    if (!(poisson_ratio > -1. && poisson_ratio < .5))
      throw InputError(
        "The Poisson ratio must lie between -1 and 1/2, both "
        "excluded; it is " +
        to_text(poisson_ratio) + ".");
    if (law == "neo-Hookean" && plane_state == "plane stress" &&
        poisson_ratio < 0.)
      throw InputError(
        "A neo-Hookean body in plane stress needs a Poisson ratio "
        "that is not negative; it is " +
        to_text(poisson_ratio) + ".");
    if (viscosity == "none" && viscosity_eta > 0.)
      throw InputError(section + "/Viscosity eta is " + to_text(viscosity_eta) +
                       " and " + section +
                       "/Viscosity is none: name a viscosity "
                       "(linear, Curnier, Pioletti) or set eta to 0.");
    if (viscosity == "none")
      return;
    const bool small_strains = law == linear_elastic;
    if (small_strains != (viscosity == "linear"))
      throw InputError(
        "The viscosity '" + viscosity + "' does not go with the law '" + law +
        "'. Allowed with it: " +
        (small_strains ? "none, linear."
                       : "none, Curnier, Pioletti (the linear one is not "
                         "invariant under rotations)."));
    if (scheme != "midpoint")
      throw InputError(
        "Viscosity cannot be combined with the time scheme '" + scheme +
        "'.\nAllowed with it: midpoint. There the rate of a step and the mean "
        "deformation make a dissipation that is never negative.");
  }



  LinearElastic
  MaterialParameters::at_small_strains() const
  {
    if (law == "Ciarlet-Geymonat")
      return {4. * (c2 + d), 2. * (c1 + c2)};
    return LinearElastic::from_young(young_modulus, poisson_ratio);
  }



  template <int dim>
  Material<dim>
  MaterialParameters::make() const
  {
    const PlaneState state = dim == 3 || plane_state == "plane strain"
      ? PlaneState::plane_strain
      : PlaneState::plane_stress;
    const Viscosity  viscous{viscosities.at(viscosity), viscosity_eta};
    if (law == linear_elastic)
      return Material<dim>(
        LinearElastic::from_young(young_modulus, poisson_ratio).in_plane(state),
        viscous,
        state);
    for (const auto &[name, make_law] : table())
      if (name == law)
        return Material<dim>(
          std::make_shared<Hyperelastic<dim>>(make_law(*this), state),
          viscous);
    AssertThrow(false, ExcMessage("unknown law " + law));
    return Material<dim>(LinearElastic());
  }


  template Material<2>
  MaterialParameters::make() const;
  template Material<3>
  MaterialParameters::make() const;
} // namespace Ricochet
