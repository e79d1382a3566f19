// SPDX-License-Identifier: LGPL-2.1-or-later
#include <solvers/solver_report.h>

#include <algorithm>

namespace Ricochet
{
  SolverReport &
  SolverReport::operator+=(const SolverReport &other)
  {
    strategies |= other.strategies;
    newton_iterations += other.newton_iterations;
    outer_iterations += other.outer_iterations;
    inner_iterations += other.inner_iterations;
    n_tangents += other.n_tangents;
    return *this;
  }



  const std::vector<std::pair<unsigned int, std::string>> &
  SolverReport::names()
  {
    static const std::vector<std::pair<unsigned int, std::string>> list = {
      {direct, "direct"},
      {multigrid, "multigrid"},
      {condensed, "condensed"},
      {frozen_tangent, "frozen tangent"},
      {tangent_renewed, "tangent made anew within the step"},
      {condensed_restarted, "condensed iterations begun anew"},
      {condensed_failed, "whole system instead of the condensed one"},
      {iterative_failed, "factored instead of iterated"},
      {stage_repeated, "stage begun again from the last state"},
      {pseudo_transient, "pseudo-transient continuation"}};
    return list;
  }



  std::string
  SolverReport::short_text(const unsigned int strategies)
  {
    std::string text;
    for (const auto &[number, name] : names())
      if ((strategies & number) != 0 && !has_fallback(number))
        text += (text.empty() ? "" : "+") + name;
    if (text.empty())
      text = "-";
    return has_fallback(strategies) ? text + "!" : text;
  }



  std::string
  SolverReport::summary(const std::vector<unsigned int> &steps)
  {
    std::string text;
    for (const auto &[number, name] : names())
      {
        const auto n =
          std::count_if(steps.begin(),
                        steps.end(),
                        [number = number](const unsigned int strategies) {
                          return (strategies & number) != 0;
                        });
        if (n > 0)
          text += (text.empty() ? "" : ", ") + name + " " + std::to_string(n);
      }
    return text;
  }
} // namespace Ricochet
