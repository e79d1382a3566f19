// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_linear_bulk_h
#define ricochet_discretization_linear_bulk_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/linear_elastic.h>

namespace Ricochet
{
  /**
   * Linear elasticity: the stiffness matrix is assembled once.
   * Its stored energy is quadratic, so the discrete derivative is the force at
   * the midpoint.
   */
  template <int dim>
  class LinearBulk : public BulkOperator
  {
  public:
    LinearBulk(const Body<dim> &body, const LinearElastic &material);

    void
    force(const Vector &solution, Vector &force) const override;

    void
    discrete_derivative(const Vector &old_solution,
                        const Vector &new_solution,
                        Vector       &force) const override;

    void
    add_tangent(const double  factor,
                const Vector &solution,
                Matrix       &tangent) const override;

    double
    energy(const Vector &solution) const override;

    bool
    is_linear() const override
    {
      return true;
    }

  private:
    Matrix stiffness;
    // Work space, so that nothing is allocated in a time step.
    mutable Vector midpoint;
  };

  /// Consistent mass matrix (kg) of @p body with the constant @p density
  /// (kg/m^dim).
  template <int dim>
  Matrix
  assemble_mass_matrix(const Body<dim> &body, const double density);
} // namespace Ricochet

#endif
