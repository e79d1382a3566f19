// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/units.h>

#include <deal.II/base/utilities.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace Ricochet
{
  Units::Units(const std::string &text)
  {
    const std::vector<std::string> parts =
      dealii::Utilities::split_string_list(text, ',');
    bool good = parts.size() == 3;
    for (const std::string &part : parts)
      {
        good = good && !part.empty() && part.size() < 20;
        // Two that are the same would be a slip of the pen.
        good = good && std::count(parts.begin(), parts.end(), part) == 1;
        for (const char c : part)
          good = good && std::isalpha(static_cast<unsigned char>(c));
      }
    if (!good)
      throw InputError(
        "Units are those of length, mass and time, separated by "
        "commas, such as 'mm, t, s'; not '" +
        text.substr(0, 100) + "'.");
    length = parts[0];
    mass   = parts[1];
    time   = parts[2];
  }



  namespace
  {
    /// Exponents of length, mass and time.
    struct Dimension
    {
      int length, mass, time;
    };

    const std::map<std::string, Dimension> &
    dimensions()
    {
      static const std::map<std::string, Dimension> table = {
        {"m", {1, 0, 0}},
        {"m^2", {2, 0, 0}},
        {"kg", {0, 1, 0}},
        {"s", {0, 0, 1}},
        {"1/s", {0, 0, -1}},
        {"m/s", {1, 0, -1}},
        {"m/s^2", {1, 0, -2}},
        {"rad/s", {0, 0, -1}},
        {"N", {1, 1, -2}},
        {"N s", {1, 1, -1}},
        {"J", {2, 1, -2}},
        {"Pa", {-1, 1, -2}},
        {"kg m/s", {1, 1, -1}},
        {"kg m^2/s", {2, 1, -1}},
        {"kg/m^3", {-3, 1, 0}}};
      return table;
    }

    /// The factor to the SI; not a number for a unit that is not known.
    double
    factor_of(const std::string &unit)
    {
      static const std::map<std::string, double> factors = {{"m", 1.},
                                                            {"km", 1e3},
                                                            {"cm", 1e-2},
                                                            {"mm", 1e-3},
                                                            {"um", 1e-6},
                                                            {"kg", 1.},
                                                            {"t", 1e3},
                                                            {"g", 1e-3},
                                                            {"mg", 1e-6},
                                                            {"s", 1.},
                                                            {"ms", 1e-3},
                                                            {"us", 1e-6}};
      const auto                                 found   = factors.find(unit);
      return found == factors.end() ? std::numeric_limits<double>::quiet_NaN()
                                    : found->second;
    }

    /// Systems whose units of force, pressure and energy have names.
    const std::map<std::vector<std::string>, std::map<std::string, std::string>>
      &
      named()
    {
      using Names = std::map<std::string, std::string>;
      static const std::map<std::vector<std::string>, Names> table = {
        {{"mm", "t", "s"}, {{"N", "N"}, {"Pa", "MPa"}, {"J", "mJ"}}},
        {{"mm", "kg", "ms"}, {{"N", "kN"}, {"Pa", "GPa"}, {"J", "J"}}},
        {{"mm", "g", "ms"}, {{"N", "N"}, {"Pa", "MPa"}, {"J", "mJ"}}},
        {{"cm", "g", "s"}, {{"N", "dyn"}, {"Pa", "Ba"}, {"J", "erg"}}}};
      return table;
    }

    std::string
    power(const std::string &unit, const int exponent)
    {
      return exponent == 1 ? unit : unit + "^" + std::to_string(exponent);
    }
  } // namespace



  std::string
  Units::name(const std::string &si_unit) const
  {
    if (are_si())
      return si_unit;
    const auto system = named().find({length, mass, time});
    if (system != named().end())
      {
        const auto name = system->second.find(si_unit);
        if (name != system->second.end())
          return name->second;
      }
    const auto dimension = dimensions().find(si_unit);
    if (dimension == dimensions().end())
      return si_unit;
    const Dimension &d = dimension->second;
    std::string      above, below;
    unsigned int     n_below = 0;
    for (const auto &[unit, exponent] :
         {std::pair<std::string, int>{mass, d.mass},
          {length, d.length},
          {time, d.time}})
      {
        if (exponent > 0)
          above += (above.empty() ? "" : " ") + power(unit, exponent);
        if (exponent < 0)
          {
            below += (below.empty() ? "" : " ") + power(unit, -exponent);
            ++n_below;
          }
      }
    if (below.empty())
      return above;
    return (above.empty() ? "1" : above) + "/" +
      (n_below > 1 ? "(" + below + ")" : below);
  }



  bool
  Units::are_si() const
  {
    return length == "m" && mass == "kg" && time == "s";
  }



  double
  Units::in_si(const double value, const std::string &si_unit) const
  {
    const Dimension &d = dimensions().at(si_unit);
    return value * std::pow(factor_of(length), d.length) *
      std::pow(factor_of(mass), d.mass) * std::pow(factor_of(time), d.time);
  }



  std::string
  Units::text(const double value, const std::string &si_unit) const
  {
    return to_text(value) + " " + name(si_unit);
  }
} // namespace Ricochet
