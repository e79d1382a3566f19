// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/refinement.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/predicate.hpp>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <set>

namespace Ricochet
{
  namespace
  {
    /// A value after a parameter's cells were halved @p factor - 1 times, @p factor = 2^n.
    using Rule = std::function<double(const double value, const double factor)>;

    const Rule length = [](const double value, const double factor) {
      return value / factor;
    };
    const Rule cells = [](const double value, const double factor) {
      return value * factor;
    };
    const Rule nodes_of_a_line = [](const double value, const double factor) {
      return (value - 1.) * factor + 1.;
    };
    const Rule nodes_of_a_plane = [](const double value, const double factor) {
      return value * factor * factor;
    };
    const Rule refinements = [](const double value, const double factor) {
      return value + std::log2(factor);
    };

    /// How a mesh depends on the parameters whose names begin or end with a text.
    struct MeshParameter
    {
      std::string begin, end;
      Rule        rule;
    };

    const std::vector<MeshParameter> mesh_parameters = {
      {"Refinements", "", refinements},
      {"Mesh size", "", length},
      {"Cells", "", cells},
      {"Nodes around", "", cells},
      {"Boundary nodes", "", cells},
      {"", "odes across", nodes_of_a_line},
      {"", "nodes along", nodes_of_a_line},
      {"Nodes", "", nodes_of_a_plane}};

    /// The rule for a parameter; null if the mesh does not depend on it.
    const Rule *
    rule_of(const ParameterValue &parameter)
    {
      const bool is_number = boost::starts_with(parameter.pattern, "[Double") ||
        boost::starts_with(parameter.pattern, "[Integer");
      for (const MeshParameter &one : mesh_parameters)
        if (is_number && boost::starts_with(parameter.path.back(), one.begin) &&
            boost::ends_with(parameter.path.back(), one.end))
          return &one.rule;
      return nullptr;
    }

    std::string
    section_of(const ParameterValue &parameter)
    {
      return parameter.path.front();
    }
  } // namespace



  std::vector<ParameterText::Assignment>
  refined_parameters(const std::vector<ParameterValue>  &parameters,
                     const std::vector<UnusedParameter> &unused,
                     const Refinement                   &refinement)
  {
    std::vector<ParameterText::Assignment> settings;
    const auto set = [&](const std::vector<std::string> &path,
                         const std::string              &value) {
      settings.push_back({path, value, "--certify", "."});
    };
    const auto value_of = [&](const std::string &name) -> const std::string * {
      for (const ParameterValue &parameter : parameters)
        if (parameter.name == name)
          return &parameter.value;
      return nullptr;
    };
    const auto power = [](const unsigned int n) {
      return std::ldexp(1., static_cast<int>(n));
    };

    const std::string *const scheme = value_of("Time/Scheme");
    const std::string *const step   = value_of("Time/Time step");
    if (!value_of("Time/Until") || !step)
      throw InputError(
        "--certify needs a program with the library's time loop.");
    if (scheme && *scheme == "ARKODE")
      throw InputError(
        "--certify cannot be combined with Time/Scheme = ARKODE, whose steps follow from its "
        "tolerances.");
    set({"Time", "Time step"},
        exact_text(std::strtod(step->c_str(), nullptr) /
                   power(refinement.n_of_steps)));

    // Where all cells of a body can be halved, its other parameters stay.
    std::set<std::string> with_refinements;
    for (const ParameterValue &parameter : parameters)
      if (parameter.path.back() == "Refinements")
        with_refinements.insert(section_of(parameter));
    bool has_mesh = false;
    for (const ParameterValue &parameter : parameters)
      {
        const Rule *const rule      = rule_of(parameter);
        const bool        is_unused = std::any_of(unused.begin(),
                                           unused.end(),
                                           [&](const UnusedParameter &one) {
                                             return one.name == parameter.name;
                                           });
        if (!rule || is_unused ||
            (with_refinements.count(section_of(parameter)) > 0 &&
             parameter.path.back() != "Refinements"))
          continue;
        has_mesh = true;
        set(parameter.path,
            exact_text((*rule)(std::strtod(parameter.value.c_str(), nullptr),
                               power(refinement.n_of_cells))));
      }
    if (!has_mesh)
      throw InputError(
        "--certify halves the cells, and here no parameter gives the mesh.");
    if (refinement.n_of_cells + refinement.n_of_steps > 0)
      for (const auto &[name, value] :
           {std::pair<std::string, std::string>{"Fields every", "0"},
            {"Fields at", ""},
            {"Fields when", ""},
            {"Contact every", "0"},
            {"Checkpoint every", "0"}})
        if (value_of("Output/" + name))
          set({"Output", name}, value);
    return settings;
  }
} // namespace Ricochet
