// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_own_parameter_h
#define ricochet_base_own_parameter_h

#include <deal.II/base/parameter_handler.h>

#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace Ricochet
{
  class ParameterValues;

  /// Magnitudes of a problem by which values that have a unit are measured.
  struct Scales
  {
    /// Young's modulus of the softer body (Pa).
    double young_modulus;
    /// lambda + 2 mu of the softer body (Pa).
    double wave_modulus;
    /// kg/m^dim
    double density;
    /// Mean diameter of the cells at the surface (m).
    double cell_diameter;
    /// Mean of the cell's diameter and of twice the diameter of a cube as deep as the cell, where that is
    /// smaller (m): the cell_diameter, unless cells are more than twice as wide as deep.
    double cell_depth;
    /// Degree of the displacement.
    unsigned int degree;
  };

  /**
   * A number that a law, a material or a time scheme takes from the parameter
   * file. Its whole declaration stands with the law that owns it, in a function
   * `parameters()`. Laws that share a parameter share its declaration.
   *
   *     OwnParameter("Penalty epsilon0", .2)
   *       .means("Parameter epsilon_0", "1/Pa", " of the penalty method.")
   *       .at_least(1e-30)
   *       .by_scale([](const Scales &scales, const ParameterValues &) {
   *         return .1 / scales.wave_modulus;
   *       })
   *       .belongs_to("penalty")
   */
  struct OwnParameter
  {
    OwnParameter(std::string name, const double default_value)
      : name(std::move(name))
      , default_value(default_value)
    {}

    /// The documentation: @p what_ (@p unit_)@p more_. An empty unit is that of a number.
    OwnParameter &
    means(std::string what_, std::string unit_, std::string more_)
    {
      what = std::move(what_);
      unit = std::move(unit_);
      more = std::move(more_);
      return *this;
    }

    OwnParameter &
    at_least(const double value)
    {
      smallest = value;
      return *this;
    }

    OwnParameter &
    at_most(const double value)
    {
      largest = value;
      return *this;
    }

    /// Allow the values @p list, separated by |, and no others.
    OwnParameter &
    one_of(std::string list)
    {
      choices = std::move(list);
      return *this;
    }

    /// The value where a scene gives none; it may depend on other values.
    OwnParameter &
    by_scale(
      std::function<double(const Scales &, const ParameterValues &)> rule)
    {
      scale_rule = std::move(rule);
      return *this;
    }

    /// A condition besides the bounds; throws InputError where it fails.
    OwnParameter &
    must(std::function<void(const double)> condition_)
    {
      condition = std::move(condition_);
      return *this;
    }

    /// The owner in notes of parameters without effect: "penalty".
    OwnParameter &
    belongs_to(std::string name_of_owner)
    {
      owner = std::move(name_of_owner);
      return *this;
    }

    /// The description in --print-parameters.
    std::string
    documentation() const
    {
      return what + (unit.empty() ? "" : " (" + unit + ")") + more;
    }

    /// @throws InputError when a default is beyond the bounds of users' values.
    void
    check_bounds(const double value) const;

    std::string name;
    double      default_value;
    std::string what, unit, more, choices, owner;
    double      smallest = -std::numeric_limits<double>::max(),
           largest       = std::numeric_limits<double>::max();
    std::function<double(const Scales &, const ParameterValues &)> scale_rule;
    std::function<void(const double)>                              condition;
  };

  using OwnParameters = std::vector<OwnParameter>;

  /// Add to @p all those of @p more that it does not have.
  /// @throws InputError when two of one name say different things.
  void
  unite(OwnParameters &all, const OwnParameters &more);

  /// Whether one of @p parameters has this @p name.
  bool
  declares(const OwnParameters &parameters, const std::string &name);

  /// The values of all laws' parameters, by name.
  class ParameterValues
  {
  public:
    /// Values of no parameters.
    ParameterValues() = default;

    /// Their default values.
    ParameterValues(const OwnParameters &parameters);

    /// @throws dealii::ExcMessage when no law has declared @p name.
    double
    operator[](const std::string &name) const;

    double &
    operator[](const std::string &name);

    /// Declare @p parameters in the section that is open in @p handler; those that are
    /// new since the values were made have their defaults. A value of 0 of a parameter
    /// with a rule by scale stands for a missing one.
    void
    add_parameters(const OwnParameters      &parameters,
                   dealii::ParameterHandler &handler);

    /// Check the conditions of @p parameters. @throws InputError
    void
    check(const OwnParameters &parameters) const;

  private:
    std::vector<std::pair<std::string, double>> values;
  };
} // namespace Ricochet

#endif
