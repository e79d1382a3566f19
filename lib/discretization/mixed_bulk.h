// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_mixed_bulk_h
#define ricochet_discretization_mixed_bulk_h

#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>

#include <string>
#include <vector>

namespace Ricochet
{
  /**
   * Parts with small strains beside parts with large ones, connected or not: a rubber ring on a
   * steel plate. The sum of a LinearBulk without stiffness in the hyperelastic parts and a
   * HyperelasticBulk without the cells of the linear ones; what each keeps over a step the sum
   * keeps, too.
   */
  template <int dim>
  class MixedBulk : public BulkOperator
  {
  public:
    /// @param materials of the parts of the body.
    MixedBulk(const Body<dim>                  &body,
              const std::vector<Material<dim>> &materials,
              const MatrixStorage               storage);

    void
    force(const Vector &solution, Vector &force) const override;

    void
    add_tangent(const double  factor,
                const Vector &solution,
                Matrix       &tangent) const override;

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

    double
    energy(const Vector &solution) const override
    {
      return linear.energy(solution) + hyperelastic.energy(solution);
    }

    std::vector<double>
    energies_of_parts(const Vector &solution) const override;

    bool
    is_viscous() const override
    {
      return linear.is_viscous() || hyperelastic.is_viscous();
    }

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

    double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const override
    {
      return linear.viscous_dissipation(old_solution, new_solution, time_step) +
        hyperelastic.viscous_dissipation(old_solution, new_solution, time_step);
    }

    double
    stiffness_scale() const override
    {
      return linear.stiffness_scale() + hyperelastic.stiffness_scale();
    }

    double
    strain_round_off() const override
    {
      return hyperelastic.strain_round_off();
    }

    double
    energy_round_off() const override
    {
      return hyperelastic.energy_round_off();
    }

    bool
    is_linear() const override
    {
      return false;
    }

    std::string
    inverted_corner(const Vector &solution) const override
    {
      return hyperelastic.inverted_corner(solution);
    }

    std::string
    failure() const override
    {
      return hyperelastic.failure();
    }

  private:
    const LinearBulk<dim>       linear;
    const HyperelasticBulk<dim> hyperelastic;
    mutable Vector              part;
  };
} // namespace Ricochet

#endif
