// SPDX-License-Identifier: LGPL-2.1-or-later
#include <time_integration/arkode.h>
#include <time_integration/bdf2.h>
#include <time_integration/hht.h>
#include <time_integration/midpoint.h>
#include <time_integration/newmark.h>
#include <time_integration/scheme_traits.h>
#include <time_integration/static_equilibrium.h>
#include <time_integration/time_scheme_table.h>
#include <time_integration/tr_bdf2.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    // The table of all time schemes: a new scheme is one file and one line.
    NamedTable<TimeSchemeEntry> &
    table()
    {
      static NamedTable<TimeSchemeEntry> schemes(
        "a",
        "time scheme",
        {time_scheme_entry<CrankNicolson>(),
         time_scheme_entry<HHT>(),
         time_scheme_entry<GeneralisedAlpha>(),
         time_scheme_entry<Newmark>(),
         time_scheme_entry<TRBDF2>(),
         time_scheme_entry<BDF2>(),
         time_scheme_entry<Midpoint>(),
         time_scheme_entry<ARKode>(),
         time_scheme_entry<StaticEquilibrium>()});
      return schemes;
    }
  } // namespace



  std::vector<SchemeTraits>
  all_scheme_traits()
  {
    std::vector<SchemeTraits> list;
    for (const TimeSchemeEntry &entry : table())
      list.push_back(entry.traits);
    return list;
  }



  std::string
  names_of_schemes(const std::function<bool(const SchemeTraits &)> &good)
  {
    std::string names;
    for (const SchemeTraits &scheme : all_scheme_traits())
      if (good(scheme))
        names += (names.empty() ? "" : ", ") + scheme.name;
    return names;
  }



  void
  register_time_scheme(const TimeSchemeEntry &entry)
  {
    table().add(entry);
  }



  SchemeTraits
  scheme_traits(const std::string &name)
  {
    return table()[name].traits;
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
    return table().names();
  }



  std::unique_ptr<TimeScheme>
  make_time_scheme(const TimeScheme::Parameters &parameters)
  {
    return table()[parameters.name].make(parameters.values);
  }



  OwnParameters
  TimeScheme::Parameters::all_parameters()
  {
    return table().parameters();
  }



  std::vector<UnusedParameter>
  TimeScheme::Parameters::unused_parameters() const
  {
    const OwnParameters         &used = table()[name].parameters;
    std::vector<UnusedParameter> unused;
    for (const OwnParameter &parameter : all_parameters())
      if (!declares(used, parameter.name))
        unused.push_back({"Time/" + parameter.name,
                          parameter.owner + "; Time/Scheme is " + name});
    return unused;
  }



  void
  TimeScheme::Parameters::add_parameters(ParameterHandler &parameters)
  {
    parameters.enter_subsection("Time");
    std::string text = "Time scheme: ";
    for (const TimeSchemeEntry &entry : table())
      text += (&entry == &*table().begin() ? "" : "; ") + entry.traits.name +
        (entry.about.empty() ? "" : " (" + entry.about + ")");
    parameters.add_parameter("Scheme",
                             name,
                             text + ".",
                             Patterns::Selection(time_scheme_names()));
    values.add_parameters(all_parameters(), parameters);
    parameters.leave_subsection();
  }
} // namespace Ricochet
