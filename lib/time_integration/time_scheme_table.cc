// SPDX-License-Identifier: LGPL-2.1-or-later
#include <time_integration/arkode.h>
#include <time_integration/hht.h>
#include <time_integration/midpoint.h>
#include <time_integration/scheme_traits.h>
#include <time_integration/time_scheme.h>
#include <time_integration/tr_bdf2.h>

#include <functional>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    struct Entry
    {
      SchemeTraits traits;
      std::function<std::unique_ptr<TimeScheme>(const TimeScheme::Parameters &)>
        make;
    };

    // The table of all time schemes: a new scheme is one file and one line.
    const std::vector<Entry> &
    table()
    {
      constexpr bool                  over_step = true, potential = true;
      static const std::vector<Entry> schemes = {
        {{"Crank-Nicolson"},
         [](const auto &) { return std::make_unique<HHT>(0.); }},
        {{"HHT"},
         [](const auto &p) { return std::make_unique<HHT>(p.hht_alpha); }},
        {{"TR-BDF2"},
         [](const auto &p) {
           return std::make_unique<TRBDF2>(p.trbdf2_gamma);
         }},
        {{"midpoint", over_step},
         [](const auto &) { return std::make_unique<Midpoint>(); }},
        {{"ARKODE", !over_step, potential}, [](const auto &p) {
           return std::make_unique<ARKode>(p.arkode_relative_tolerance,
                                           p.arkode_absolute_tolerance);
         }}};
      return schemes;
    }

    const Entry &
    find(const std::string &name)
    {
      for (const Entry &entry : table())
        if (entry.traits.name == name)
          return entry;
      AssertThrow(false, ExcMessage("unknown time scheme " + name));
      return table().front();
    }
  } // namespace



  const std::vector<SchemeTraits> &
  all_scheme_traits()
  {
    static const std::vector<SchemeTraits> all = [] {
      std::vector<SchemeTraits> list;
      for (const Entry &entry : table())
        list.push_back(entry.traits);
      return list;
    }();
    return all;
  }



  const SchemeTraits &
  scheme_traits(const std::string &name)
  {
    return find(name).traits;
  }



  StepReport &
  StepReport::operator+=(const StepReport &other)
  {
    external_work += other.external_work;
    imposed_work += other.imposed_work;
    own_sums.resize(std::max(own_sums.size(), other.own_sums.size()), 0.);
    for (unsigned int k = 0; k < other.own_sums.size(); ++k)
      own_sums[k] += other.own_sums[k];
    works_of_bodies.resize(std::max(works_of_bodies.size(),
                                    other.works_of_bodies.size()),
                           0.);
    for (unsigned int k = 0; k < other.works_of_bodies.size(); ++k)
      works_of_bodies[k] += other.works_of_bodies[k];
    round_off += other.round_off;
    contact_steps.resize(
      std::max(contact_steps.size(), other.contact_steps.size()));
    for (unsigned int k = 0; k < other.contact_steps.size(); ++k)
      contact_steps[k].unite(other.contact_steps[k]);
    contact_work += other.contact_work;
    friction_work += other.friction_work;
    viscous_dissipation += other.viscous_dissipation;
    numerical_dissipation += other.numerical_dissipation;
    obstacle_work += other.obstacle_work;
    solver += other.solver;
    other_linear_solves += other.other_linear_solves;
    return *this;
  }



  std::string
  time_scheme_names()
  {
    std::string names;
    for (const Entry &entry : table())
      names += (names.empty() ? "" : "|") + entry.traits.name;
    return names;
  }



  std::unique_ptr<TimeScheme>
  make_time_scheme(const TimeScheme::Parameters &parameters)
  {
    return find(parameters.name).make(parameters);
  }



  void
  TimeScheme::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Time");
    parameters.add_parameter(
      "Scheme",
      name,
      "Time scheme: Crank-Nicolson (HHT with alpha = 0); HHT (paper C, (24)); "
      "TR-BDF2 (C, (33)); midpoint (A (3.2), B (3.1); with the Nitsche-hybrid "
      "treatment this is the hybrid scheme, C (38)); ARKODE (adaptive "
      "Runge-Kutta of SUNDIALS, for treatments with a potential, as a check).",
      Patterns::Selection(time_scheme_names()));
    parameters.add_parameter(
      "HHT alpha",
      hht_alpha,
      "Parameter alpha of HHT, of either sign (paper C: alpha tilde); beta = "
      "(1 + |alpha|)^2/4, gamma = 1/2 + |alpha|. Used by HHT.",
      Patterns::Double(-1. / 3., 1. / 3.));
    parameters.add_parameter(
      "TR-BDF2 gamma",
      trbdf2_gamma,
      "Fraction of the step that the trapezoidal rule takes (paper C: gamma "
      "tilde); at 2 - sqrt(2) both stages have the same matrix. Used by "
      "TR-BDF2.",
      Patterns::Double(.01, .99));
    // With all digits: the default text has six, and the two stages of TR-BDF2
    // share a matrix only if gamma is 2 - sqrt(2) to round-off.
    parameters.set("TR-BDF2 gamma", "0.5857864376269049");

    parameters.add_parameter("ARKODE relative tolerance",
                             arkode_relative_tolerance,
                             "Relative error allowed per step. Used by ARKODE.",
                             Patterns::Double(1e-14, 1e-2));
    parameters.add_parameter("ARKODE absolute tolerance",
                             arkode_absolute_tolerance,
                             "Absolute error allowed per step, in m and m/s. "
                             "Used by ARKODE.",
                             Patterns::Double(1e-16, 1.));
    parameters.leave_subsection();
  }
} // namespace Ricochet
