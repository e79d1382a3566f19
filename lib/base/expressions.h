// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_base_expressions_h
#define ricochet_base_expressions_h

#include <deal.II/base/function_parser.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /// Functions that a user writes as text, such as "sin(2*pi*t)" (muParser). The
  /// constant pi is known.
  class Expressions
  {
  public:
    /**
     * @param variables their names, separated by commas: one or three.
     * @param texts one for each function.
     * @param what they are, for messages: "the level set".
     * @param of_time they are functions of the time t as well.
     * @throws InputError when one of them cannot be read.
     */
    Expressions(const std::string              &variables,
                const std::vector<std::string> &texts,
                const std::string              &what,
                const bool                      of_time = false);

    /// The function number @p f where the variables are @p x.
    double
    value(const unsigned int f, const dealii::Tensor<1, 3> &x) const
    {
      return parser->value(dealii::Point<3>(x), f);
    }

    /// The same at a time (s): the functions know it as t.
    double
    value(const unsigned int          f,
          const dealii::Tensor<1, 3> &x,
          const double                time) const
    {
      parser->set_time(time);
      return parser->value(dealii::Point<3>(x), f);
    }

    unsigned int
    size() const
    {
      return parser->n_components;
    }

  private:
    std::shared_ptr<dealii::FunctionParser<3>> parser;
  };

  /// A condition on named values that a user writes as text, such as
  /// "kinetic_energy < 1e-6 && time > 0.1" (muParser).
  class Condition
  {
  public:
    /// @param text empty for a condition that is never true.
    /// @param what it is, for messages: "Time/Until".
    Condition(const std::string &text, const std::string &what);

    bool
    exists() const
    {
      return !text.empty();
    }

    /// Whether it is true with these @p values, by name.
    /// @throws InputError for another name, or when the text cannot be read.
    bool
    is_true(const std::map<std::string, double> &values) const;

  private:
    const std::string text, what;
    /// Words of the text that are no functions or constants of muParser.
    std::vector<std::string> names;
  };

  /// The words of @p expression that are no functions, such as x and pi in "sin(pi*x)".
  std::vector<std::string>
  names_in(const std::string &expression);

  /// The value of @p expression (muParser), in which @p constants and pi are known.
  /// @param what it is, for messages.
  /// @throws InputError when it cannot be read, or has random numbers.
  double
  value_of(const std::string                   &expression,
           const std::map<std::string, double> &constants,
           const std::string                   &what);

  /// The parts of @p text between semicolons, without blanks around them.
  std::vector<std::string>
  split_expressions(const std::string &text);
} // namespace Ricochet

#endif
