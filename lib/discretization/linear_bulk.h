// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_linear_bulk_h
#define ricochet_discretization_linear_bulk_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/material.h>
#include <solvers/body_matrix.h>

namespace Ricochet
{
  /**
   * Linear elasticity with linear viscosity: stiffness and viscosity matrix are
   * assembled once. The stored energy is quadratic, so its discrete derivative
   * is the force at the midpoint.
   */
  template <int dim>
  class LinearBulk : public BulkOperator
  {
  public:
    /// @param materials of the parts of the body, linear elastic, with linear
    /// viscosity or none.
    LinearBulk(const Body<dim>                  &body,
               const std::vector<Material<dim>> &materials,
               const MatrixStorage storage = MatrixStorage::entries);

    /// @param viscosity none or linear.
    LinearBulk(const Body<dim>     &body,
               const LinearElastic &material,
               const Viscosity     &viscosity = {})
      : LinearBulk(body, std::vector<Material<dim>>(1, {material, viscosity}))
    {}

    void
    force(const Vector &solution, Vector &force) const override;

    void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  time_step,
               Vector       &force) const override;

    MatrixSum
    tangent_terms(const double factor) const override;

    MatrixSum
    step_tangent_terms(const double time_step) const override;

    double
    energy(const Vector &solution) const override;

    std::vector<double>
    energies_of_parts(const Vector &solution) const override;

    bool
    is_viscous() const override
    {
      return has_viscosity;
    }

    void
    viscous_force(const Vector &rate_origin,
                  const Vector &solution,
                  const double  rate_time,
                  Vector       &result) const override;

    MatrixSum
    viscous_tangent_terms(const double factor,
                          const double rate_time) const override;

    double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const override;

    double
    stiffness_scale() const override
    {
      return scale;
    }

    bool
    is_linear() const override
    {
      return true;
    }

  private:
    /// Take the mean translation of each part, which stores nothing, out of #work:
    /// far from where it started, the displacement of a body is much larger than
    /// its differences.
    void
    remove_translation() const;

    /// #product = viscosity matrix times the difference @p end - @p begin, which is left
    /// in #work.
    void
    apply_viscosity(const Vector &begin, const Vector &end) const;

    /// Displacements of this rank that follow each other: those of one part, of one
    /// component after the other.
    struct Run
    {
      unsigned int part, first_component, begin, end;
    };

    /// @param group dim times the part of each owned displacement, and its component;
    /// larger for multipliers.
    void
    make_runs(const std::vector<unsigned int> &group);

    const bool       has_viscosity;
    const MPI_Comm   communicator;
    unsigned int     n_parts = 1;
    std::vector<Run> runs;
    // Displacements of each part and component on all ranks.
    std::vector<double> group_sizes;
    BodyMatrix          stiffness;
    BodyMatrix          viscosity_matrix;
    double              scale = 0.;
    // Work space, so that nothing is allocated in a time step.
    mutable Vector work, product;
  };

  /// Consistent mass matrix (kg) of @p body with the constant @p densities of its
  /// parts (kg/m^dim), on Body::component_sparsity_pattern() or its blocks.
  template <int dim>
  BodyMatrix
  assemble_mass_matrix(const Body<dim>           &body,
                       const std::vector<double> &densities,
                       const MatrixStorage storage = MatrixStorage::entries);

  /// The same with one density.
  template <int dim>
  BodyMatrix
  assemble_mass_matrix(const Body<dim> &body, const double density)
  {
    return assemble_mass_matrix(body, std::vector<double>(1, density));
  }
} // namespace Ricochet

#endif
