// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_bulk_sum_h
#define ricochet_discretization_bulk_sum_h

#include <discretization/bulk_operator.h>

#include <memory>
#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * The sum of several operators on the same unknowns: parts with small strains beside parts
   * with large ones, a body on springs. What each of them keeps over a step the sum keeps, too.
   */
  class BulkSum : public BulkOperator
  {
  public:
    /// @param terms at least one. @param work_space a vector of the unknowns.
    BulkSum(std::vector<std::unique_ptr<BulkOperator>> terms,
            const Vector                              &work_space)
      : terms(std::move(terms))
      , of_term(work_space)
    {}

    void
    force(const Vector &solution, Vector &force) const override;

    void
    add_tangent(const double  factor,
                const Vector &solution,
                Matrix       &tangent) const override;

    bool
    is_viscous() const override;

    void
    viscous_force(const Vector &rate_origin,
                  const Vector &solution,
                  const double  rate_time,
                  Vector       &result) const override;

    void
    add_viscous_tangent(const double  factor,
                        const Vector &rate_origin,
                        const Vector &solution,
                        const double  rate_time,
                        Matrix       &tangent) const override;

    MatrixSum
    viscous_tangent_terms(const double factor,
                          const double rate_time) const override;

    void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  time_step,
               Vector       &force) const override;

    void
    add_step_tangent(const Vector &old_solution,
                     const Vector &new_solution,
                     const double  time_step,
                     Matrix       &tangent) const override;

    MatrixSum
    tangent_terms(const double factor) const override;

    MatrixSum
    step_tangent_terms(const double time_step) const override;

    double
    energy(const Vector &solution) const override;

    std::vector<double>
    energies_of_parts(const Vector &solution) const override;

    double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const override;

    double
    stiffness_scale() const override;

    double
    strain_round_off() const override;

    double
    energy_round_off() const override;

    bool
    is_linear() const override;

    std::string
    inverted_corner(const Vector &solution) const override;

    std::string
    failure() const override;

  private:
    /// The sum of @p value over all terms.
    template <typename Value>
    double
    sum(const Value &value) const;

    /// The matrices that @p terms_of gives for all terms; none if the sum is not linear.
    template <typename TermsOf>
    MatrixSum
    matrices(const TermsOf &terms_of) const;

    /// The first of the terms' @p text that is not empty.
    template <typename Text>
    std::string
    first_text(const Text &text) const;

    const std::vector<std::unique_ptr<BulkOperator>> terms;
    mutable Vector                                   of_term;
  };
} // namespace Ricochet

#endif
