// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/expressions.h>
#include <base/parameter_file.h>
#include <base/unknown_name.h>

#include <deal.II/base/utilities.h>

#include <boost/algorithm/string/join.hpp>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iostream>
#include <regex>

namespace Ricochet
{
  namespace
  {
    /// muParser takes "1,2" for 2 and "x = 3" for an assignment, which nobody means here.
    bool
    has_odd_signs(const std::string &text)
    {
      int depth = 0;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const char c      = text[i],
                     next   = i + 1 < text.size() ? text[i + 1] : ' ',
                     before = i > 0 ? text[i - 1] : ' ';
          depth += c == '(' ? 1 : c == ')' ? -1 : 0;
          if (c == ',' && depth == 0)
            return true;
          if (c == '=' && next != '=' &&
              std::string("=<>!").find(before) == std::string::npos)
            return true;
        }
      return false;
    }



    /// Whether @p action, which asks a parser of deal.II, succeeds. deal.II prints what it does
    /// not understand; we say it in a sentence.
    bool
    is_understood(const std::function<void()> &action)
    {
      std::streambuf *const terminal   = std::cerr.rdbuf(nullptr);
      bool                  understood = true;
      try
        {
          action();
        }
      catch (const std::exception &)
        {
          understood = false;
        }
      std::cerr.rdbuf(terminal);
      std::cerr.clear();
      return understood;
    }



    /// Refuse a @p text that is too long: the time to read it grows with the square of its
    /// length. @param what it is, for the message. @throws InputError
    void
    check_length(const std::string &text, const std::string &what)
    {
      constexpr std::size_t max_length = 2000;
      if (text.size() > max_length)
        throw InputError(what + " has " + std::to_string(text.size()) +
                         " characters; there may be " +
                         std::to_string(max_length) + ".");
    }



    /// Whether random numbers are asked for: rand() or rand_seed().
    bool
    is_random(const std::string &text)
    {
      for (std::size_t i = text.find("rand"); i != std::string::npos;
           i             = text.find("rand", i + 1))
        if (i == 0 ||
            (!std::isalnum(static_cast<unsigned char>(text[i - 1])) &&
             text[i - 1] != '_'))
          return true;
      return false;
    }
  } // namespace



  Expressions::Expressions(const std::string              &variables,
                           const std::vector<std::string> &texts,
                           const std::string              &what,
                           const bool                      of_time)
  {
    for (const std::string &text : texts)
      check_length(text, "One of the expressions of " + what);
    for (const std::string &text : texts)
      if (is_random(text))
        throw InputError("One of the expressions of " + what +
                         " has random numbers, with which no run could be "
                         "repeated or resumed: " +
                         text);
    auto new_parser = std::make_shared<dealii::FunctionParser<3>>(texts.size());
    bool readable   = is_understood([&]() {
      const bool one = variables.find(',') == std::string::npos;
      new_parser->initialize((one ? variables + ",unused_1,unused_2"
                                    : variables) +
                               (of_time ? ",t" : ""),
                             texts,
                             {{"pi", dealii::numbers::PI}},
                             of_time);
      // The parser looks at an expression when it is first needed.
      for (unsigned int f = 0; f < texts.size(); ++f)
        new_parser->value(dealii::Point<3>(), f);
    });
    for (const std::string &text : texts)
      readable = readable && !has_odd_signs(text);
    if (!readable)
      {
        std::string list;
        for (const std::string &text : texts)
          list += "\n    " + text;
        throw InputError("One of the expressions of " + what +
                         " cannot be read; they are functions of " + variables +
                         (of_time ? " and the time t" : "") +
                         " as muParser knows them:" + list);
      }
    parser = new_parser;
  }



  Condition::Condition(const std::string &text, const std::string &what)
    : text(text)
    , what(what)
    , names(names_in(text))
  {
    if (!exists())
      return;
    std::map<std::string, double> values;
    for (const std::string &name : names)
      values[name] = 1.;
    is_true(values);
  }



  bool
  Condition::is_true(const std::map<std::string, double> &values) const
  {
    if (!exists())
      return false;
    std::map<std::string, double> constants;
    for (const std::string &name : names)
      if (const auto value = values.find(name); value != values.end())
        constants.insert(*value);
      else if (name != "pi")
        {
          std::vector<std::string> known;
          for (const auto &[one, number] : values)
            known.push_back(one);
          throw unknown_name(what + ": there is no '" + name + "' in it",
                             name,
                             known,
                             "\nIt may have the columns of energy.csv: " +
                               boost::algorithm::join(known, ", ") + ".");
        }
    return value_of(text,
                    constants,
                    what +
                      ", a condition on columns of energy.csv such as "
                      "'kinetic_energy < 1e-6 && time > 0.1',") != 0.;
  }



  std::vector<std::string>
  names_in(const std::string &expression)
  {
    const auto is_of_word = [](const char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
    };
    static const std::regex number(
      "([0-9]+\\.?[0-9]*|\\.[0-9]+)([eE][+-]?[0-9]+)?");
    std::vector<std::string> list;
    for (auto at = expression.begin(); at != expression.end();)
      {
        std::smatch match;
        if (std::regex_search(at,
                              expression.end(),
                              match,
                              number,
                              std::regex_constants::match_continuous))
          at += match.length();
        else if (!is_of_word(*at))
          ++at;
        else
          {
            const auto end = std::find_if_not(at, expression.end(), is_of_word);
            const auto next =
              std::find_if(end, expression.end(), [](const char c) {
                return c != ' ';
              });
            if (next == expression.end() || *next != '(')
              list.emplace_back(at, end);
            at = end;
          }
      }
    return list;
  }


  double
  value_of(const std::string                   &expression,
           const std::map<std::string, double> &constants,
           const std::string                   &what)
  {
    check_length(expression, what);
    if (is_random(expression))
      throw InputError(what +
                       " has random numbers, with which no run could be "
                       "repeated or resumed: " +
                       expression);
    std::map<std::string, double> all = constants;
    all["pi"]                         = dealii::numbers::PI;
    double     value                  = 0.;
    const bool readable = !has_odd_signs(expression) && is_understood([&]() {
      dealii::FunctionParser<1> parser(1);
      parser.initialize("unused", expression, all);
      value = parser.value(dealii::Point<1>());
    });
    if (!readable)
      throw InputError(what +
                       " cannot be read as muParser knows it: " + expression);
    return value;
  }



  std::vector<std::string>
  split_expressions(const std::string &text)
  {
    return dealii::Utilities::split_string_list(text, ';');
  }
} // namespace Ricochet
