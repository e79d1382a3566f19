// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/own_parameter.h>
#include <base/parameter_file.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  bool
  declares(const OwnParameters &parameters, const std::string &name)
  {
    return std::any_of(parameters.begin(),
                       parameters.end(),
                       [&](const OwnParameter &parameter) {
                         return parameter.name == name;
                       });
  }



  void
  OwnParameter::check_bounds(const double value) const
  {
    if (!(value >= smallest && value <= largest))
      throw InputError("The default of '" + name + "', a parameter of " +
                       (owner.empty() ? "a law" : owner) + ", is " +
                       to_text(value) + ", which is beyond its bounds, " +
                       to_text(smallest) + " and " + to_text(largest) + ".");
  }



  void
  unite(OwnParameters &all, const OwnParameters &more)
  {
    for (const OwnParameter &parameter : more)
      {
        const auto same =
          std::find_if(all.begin(), all.end(), [&](const OwnParameter &other) {
            return other.name == parameter.name;
          });
        if (same == all.end())
          all.push_back(parameter);
        else if (same->documentation() != parameter.documentation() ||
                 same->default_value != parameter.default_value ||
                 same->smallest != parameter.smallest ||
                 same->largest != parameter.largest)
          throw InputError("The parameter '" + parameter.name +
                           "' is declared twice, with different texts, "
                           "defaults or bounds: for " +
                           same->owner + " and for " + parameter.owner + ".");
      }
  }



  ParameterValues::ParameterValues(const OwnParameters &parameters)
  {
    for (const OwnParameter &parameter : parameters)
      values.emplace_back(parameter.name, parameter.default_value);
  }



  double
  ParameterValues::operator[](const std::string &name) const
  {
    for (const auto &value : values)
      if (value.first == name)
        return value.second;
    AssertThrow(false, ExcMessage("No law has the parameter '" + name + "'."));
    return 0.;
  }



  double &
  ParameterValues::operator[](const std::string &name)
  {
    for (auto &value : values)
      if (value.first == name)
        return value.second;
    AssertThrow(false, ExcMessage("No law has the parameter '" + name + "'."));
    return values.front().second;
  }



  void
  ParameterValues::check(const OwnParameters &parameters) const
  {
    for (const OwnParameter &parameter : parameters)
      if (parameter.condition)
        parameter.condition((*this)[parameter.name]);
  }



  void
  ParameterValues::add_parameters(const OwnParameters &parameters,
                                  ParameterHandler    &handler)
  {
    // References to the values are kept by the handler: all are there first.
    for (const OwnParameter &parameter : parameters)
      if (std::none_of(values.begin(), values.end(), [&](const auto &value) {
            return value.first == parameter.name;
          }))
        values.emplace_back(parameter.name, parameter.default_value);

    for (const OwnParameter &parameter : parameters)
      {
        double    &value      = (*this)[parameter.name];
        const bool is_missing = parameter.scale_rule && value == 0.;
        const auto add        = [&](const Patterns::PatternBase &pattern) {
          handler.add_parameter(parameter.name,
                                value,
                                parameter.documentation(),
                                pattern);
        };
        const double given = value;
        if (!is_missing && parameter.choices.empty())
          parameter.check_bounds(given);
        if (!parameter.choices.empty())
          add(Patterns::Selection(parameter.choices));
        else
          add(Patterns::Double(is_missing ? std::min(0., parameter.smallest)
                                          : parameter.smallest,
                               parameter.largest));
        // The default text has six digits; as many as the value needs.
        for (int n_digits = 7; value != given && n_digits < 18; ++n_digits)
          {
            std::ostringstream text;
            text.precision(n_digits);
            text << given;
            handler.set(parameter.name, text.str());
          }
      }
  }
} // namespace Ricochet
