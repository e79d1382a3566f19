// SPDX-License-Identifier: LGPL-2.1-or-later
#include <discretization/bulk_sum.h>

#include <algorithm>

namespace Ricochet
{
  template <typename Value>
  double
  BulkSum::sum(const Value &value) const
  {
    double result = 0.;
    for (const auto &term : terms)
      result += value(*term);
    return result;
  }



  template <typename TermsOf>
  MatrixSum
  BulkSum::matrices(const TermsOf &terms_of) const
  {
    MatrixSum result;
    if (is_linear())
      for (const auto &term : terms)
        for (const MatrixTerm &matrix : terms_of(*term))
          result.push_back(matrix);
    return result;
  }



  template <typename Text>
  std::string
  BulkSum::first_text(const Text &text) const
  {
    for (const auto &term : terms)
      if (const std::string own = text(*term); !own.empty())
        return own;
    return {};
  }



  void
  BulkSum::force(const Vector &solution, Vector &force) const
  {
    force = 0.;
    for (const auto &term : terms)
      {
        term->force(solution, of_term);
        force += of_term;
      }
  }



  void
  BulkSum::add_tangent(const double  factor,
                       const Vector &solution,
                       Matrix       &tangent) const
  {
    for (const auto &term : terms)
      term->add_tangent(factor, solution, tangent);
  }



  bool
  BulkSum::is_viscous() const
  {
    return std::any_of(terms.begin(), terms.end(), [](const auto &term) {
      return term->is_viscous();
    });
  }



  void
  BulkSum::viscous_force(const Vector &rate_origin,
                         const Vector &solution,
                         const double  rate_time,
                         Vector       &result) const
  {
    result = 0.;
    for (const auto &term : terms)
      if (term->is_viscous())
        {
          term->viscous_force(rate_origin, solution, rate_time, of_term);
          result += of_term;
        }
  }



  void
  BulkSum::add_viscous_tangent(const double  factor,
                               const Vector &rate_origin,
                               const Vector &solution,
                               const double  rate_time,
                               Matrix       &tangent) const
  {
    for (const auto &term : terms)
      if (term->is_viscous())
        term->add_viscous_tangent(factor,
                                  rate_origin,
                                  solution,
                                  rate_time,
                                  tangent);
  }



  MatrixSum
  BulkSum::viscous_tangent_terms(const double factor,
                                 const double rate_time) const
  {
    return matrices([&](const BulkOperator &term) {
      return term.is_viscous() ? term.viscous_tangent_terms(factor, rate_time)
                               : MatrixSum();
    });
  }



  void
  BulkSum::step_force(const Vector &old_solution,
                      const Vector &new_solution,
                      const double  time_step,
                      Vector       &force) const
  {
    force = 0.;
    for (const auto &term : terms)
      {
        term->step_force(old_solution, new_solution, time_step, of_term);
        force += of_term;
      }
  }



  void
  BulkSum::add_step_tangent(const Vector &old_solution,
                            const Vector &new_solution,
                            const double  time_step,
                            Matrix       &tangent) const
  {
    for (const auto &term : terms)
      term->add_step_tangent(old_solution, new_solution, time_step, tangent);
  }



  MatrixSum
  BulkSum::tangent_terms(const double factor) const
  {
    return matrices(
      [&](const BulkOperator &term) { return term.tangent_terms(factor); });
  }



  MatrixSum
  BulkSum::step_tangent_terms(const double time_step) const
  {
    return matrices([&](const BulkOperator &term) {
      return term.step_tangent_terms(time_step);
    });
  }



  double
  BulkSum::energy(const Vector &solution) const
  {
    return sum([&](const auto &term) { return term.energy(solution); });
  }



  std::vector<double>
  BulkSum::energies_of_parts(const Vector &solution) const
  {
    std::vector<double> energies;
    for (const auto &term : terms)
      {
        const std::vector<double> own = term->energies_of_parts(solution);
        energies.resize(own.size(), 0.);
        for (unsigned int p = 0; p < own.size(); ++p)
          energies[p] += own[p];
      }
    return energies;
  }



  double
  BulkSum::viscous_dissipation(const Vector &old_solution,
                               const Vector &new_solution,
                               const double  time_step) const
  {
    return sum([&](const auto &term) {
      return term.viscous_dissipation(old_solution, new_solution, time_step);
    });
  }



  double
  BulkSum::stiffness_scale() const
  {
    return sum([](const auto &term) { return term.stiffness_scale(); });
  }



  double
  BulkSum::strain_round_off() const
  {
    return sum([](const auto &term) { return term.strain_round_off(); });
  }



  double
  BulkSum::energy_round_off() const
  {
    return sum([](const auto &term) { return term.energy_round_off(); });
  }



  bool
  BulkSum::is_linear() const
  {
    return std::all_of(terms.begin(), terms.end(), [](const auto &term) {
      return term->is_linear();
    });
  }



  std::string
  BulkSum::inverted_corner(const Vector &solution) const
  {
    return first_text(
      [&](const auto &term) { return term.inverted_corner(solution); });
  }



  std::string
  BulkSum::failure() const
  {
    return first_text([](const auto &term) { return term.failure(); });
  }
} // namespace Ricochet
