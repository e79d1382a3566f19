// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/own_parameter.h>

#include <deal.II/base/exceptions.h>
#include <deal.II/base/patterns.h>

#include <algorithm>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  OwnParameter
  OwnParameter::means(std::string what,
                      std::string unit,
                      std::string more) const
  {
    OwnParameter result = *this;
    result.what         = std::move(what);
    result.unit         = std::move(unit);
    result.more         = std::move(more);
    return result;
  }



  OwnParameter
  OwnParameter::at_least(const double value) const
  {
    OwnParameter result = *this;
    result.smallest     = value;
    return result;
  }



  OwnParameter
  OwnParameter::at_most(const double value) const
  {
    OwnParameter result = *this;
    result.largest      = value;
    return result;
  }



  OwnParameter
  OwnParameter::one_of(std::string list) const
  {
    OwnParameter result = *this;
    result.choices      = std::move(list);
    return result;
  }



  OwnParameter
  OwnParameter::by_scale(
    std::function<double(const Scales &, const ParameterValues &)> rule) const
  {
    OwnParameter result = *this;
    result.scale_rule   = std::move(rule);
    return result;
  }



  OwnParameter
  OwnParameter::must(std::function<void(const double)> condition) const
  {
    OwnParameter result = *this;
    result.condition    = std::move(condition);
    return result;
  }



  OwnParameter
  OwnParameter::belongs_to(std::string name_of_owner) const
  {
    OwnParameter result = *this;
    result.owner        = std::move(name_of_owner);
    return result;
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
        else
          AssertThrow(same->documentation() == parameter.documentation() &&
                        same->default_value == parameter.default_value,
                      ExcMessage("Two laws declare the parameter '" +
                                 parameter.name +
                                 "' and say different things of it."));
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
