// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <contact/obstacles/half_space.h>
#include <materials/material_parameters.h>
#include <problems/clearance.h>
#include <problems/combinations.h>

#include <algorithm>
#include <regex>

namespace Ricochet
{
  using namespace dealii;

  void
  check(const Combination &combination)
  {
    const SchemeTraits scheme = scheme_traits(combination.scheme);
    MaterialParameters material;
    material.plane_state = "plane strain";
    if (!combination.linear_material)
      material.law = "neo-Hookean";
    if (combination.viscous)
      {
        material.viscosity = combination.linear_material ? "linear" : "Curnier";
        material.viscosity_eta = 1.;
      }
    material.validate(combination.dim, combination.scheme);
    check_combination(combination.contact,
                      scheme,
                      combination.redistributed_mass,
                      combination.linear_material,
                      material.velocity_force(),
                      combination.degree);
    if (combination.opposite == Opposite::moving_obstacle)
      check_motions(scheme,
                    {{0,
                      std::make_shared<RigidObstacle>(
                        std::make_shared<HalfSpace>(Tensor<1, 3>(),
                                                    Tensor<1, 3>({0., 1., 0.})),
                        RigidMotion({"t", "0", "0"},
                                    "0",
                                    Tensor<1, 3>(),
                                    Tensor<1, 3>({0., 0., 1.})))}});
    if (combination.opposite == Opposite::body ||
        combination.opposite == Opposite::itself)
      check_pair_combination(combination.contact,
                             scheme,
                             {combination.opposite == Opposite::itself,
                              combination.dim,
                              combination.degree,
                              combination.linear_material,
                              combination.redistributed_mass});
  }



  namespace
  {
    void
    replace_all(std::string       &text,
                const std::string &part,
                const std::string &by)
    {
      for (std::size_t place = text.find(part); place != std::string::npos;
           place             = text.find(part, place + by.size()))
        text.replace(place, part.size(), by);
    }

    /// The first line of a refusal, and the last one where that says more than what is
    /// allowed, without the names of this combination.
    std::string
    reason_of(const std::string &message, const Combination &combination)
    {
      std::string reason = message.substr(0, message.find('\n'));
      if (std::count(message.begin(), message.end(), '\n') == 2)
        reason += " " + message.substr(message.rfind('\n') + 1);
      reason = std::regex_replace(reason,
                                  std::regex(" with theta = -?[01] and"),
                                  " and");
      replace_all(reason,
                  "'" + combination.contact.treatment + "'",
                  "TREATMENT");
      replace_all(reason, "'" + combination.scheme + "'", "SCHEME");
      replace_all(reason, "scheme " + combination.scheme, "scheme SCHEME");
      replace_all(reason,
                  "Coupling = " + combination.contact.coupling,
                  "Coupling = COUPLING");
      return reason;
    }
  } // namespace



  std::string
  combinations_as_csv()
  {
    const std::vector<std::pair<std::string, Opposite>> opposites = {
      {"obstacle", Opposite::obstacle},
      {"moving obstacle", Opposite::moving_obstacle},
      {"points", Opposite::body},
      {"mortar", Opposite::body},
      {"dual mortar", Opposite::body},
      {"cut faces", Opposite::body},
      {"itself", Opposite::itself}};
    std::string text =
      "treatment,contact,scheme,mass,friction,viscosity,material,dimension,"
      "degree,taken\n";
    std::vector<std::string> reasons;
    const auto               add = [&](const Combination &combination) {
      try
        {
          check(combination);
          text += "yes\n";
        }
      catch (const InputError &error)
        {
          const std::string reason = reason_of(error.what(), combination);
          auto known = std::find(reasons.begin(), reasons.end(), reason);
          if (known == reasons.end())
            known = reasons.insert(known, reason);
          text += std::to_string(known - reasons.begin() + 1) + "\n";
        }
    };
    for (const auto &[treatment, parameters] : treatment_variants())
      for (const auto &[contact, opposite] : opposites)
        for (const SchemeTraits &scheme : all_scheme_traits())
          for (const bool redistributed : {false, true})
            for (const std::string friction :
                 {"none", "Coulomb", "slip-rate dependent"})
              for (const bool viscous : {false, true})
                for (const bool linear : {true, false})
                  for (const unsigned int dim : {2, 3})
                    for (const unsigned int degree : {1, 2})
                      {
                        Combination combination{parameters,
                                                scheme.name,
                                                redistributed,
                                                viscous,
                                                linear,
                                                opposite,
                                                dim,
                                                degree};
                        if (opposite == Opposite::body)
                          combination.contact.coupling = contact;
                        if (friction == "Coulomb")
                          combination.contact.values["Friction coefficient"] =
                            .3;
                        if (friction == "slip-rate dependent")
                          {
                            combination.contact.friction_law = friction;
                            combination.contact.values["Static coefficient"] =
                              .4;
                            combination.contact.values["Dynamic coefficient"] =
                              .2;
                          }
                        text += "\"" + treatment + "\"," + contact + "," +
                          scheme.name + "," +
                          (redistributed ? "redistributed" : "consistent") +
                          "," + friction + "," + (viscous ? "yes" : "no") +
                          "," + (linear ? "linear elastic" : "hyperelastic") +
                          "," + std::to_string(dim) + "," +
                          std::to_string(degree) + ",";
                        add(combination);
                      }
    for (const std::string &reason : reasons)
      text += (&reason == &reasons.front() ? "\n" : "") + reason + "\n";
    return text;
  }
} // namespace Ricochet
