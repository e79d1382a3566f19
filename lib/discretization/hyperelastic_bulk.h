// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_hyperelastic_bulk_h
#define ricochet_discretization_hyperelastic_bulk_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/material.h>

#include <functional>

namespace Ricochet
{
  /**
   * A hyperelastic body with large strains, and its viscosity.
   *
   * Collocation forces are those of the stored energy; the force of a step uses
   * Gonzalez' stress with the mean deformation gradient (papers A (3.7), B
   * (3.2)), and its tangent is the exact one, which is not symmetric.
   *
   * Shape gradients and the places of all matrix entries are computed once. A
   * rank assembles its own rows, from all cells that touch them, so that
   * assembly needs no communication but for ghost values.
   */
  template <int dim>
  class HyperelasticBulk : public BulkOperator
  {
  public:
    /// @param materials of the parts of the body.
    HyperelasticBulk(const Body<dim>                  &body,
                     const std::vector<Material<dim>> &materials);

    HyperelasticBulk(const Body<dim> &body, const Material<dim> &material)
      : HyperelasticBulk(body, std::vector<Material<dim>>(1, material))
    {}

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
    energy(const Vector &solution) const override;

    std::vector<double>
    energies_of_parts(const Vector &solution) const override;

    double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const override;

    double
    stiffness_scale() const override
    {
      return scale;
    }

    double
    strain_round_off() const override
    {
      return round_off;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    std::string
    failure() const override;

  private:
    using Symmetric2 = dealii::SymmetricTensor<2, dim>;
    using Symmetric4 = dealii::SymmetricTensor<4, dim>;

    /// Stress S and, if asked for, its derivative dS/dC at a point of a material,
    /// from C_old and the difference of C.
    using StressFunction = std::function<void(const Material<dim> &material,
                                              const Symmetric2    &old_c,
                                              const Symmetric2    &difference,
                                              Symmetric2          &stress,
                                              Symmetric4          *tangent)>;

    void
    find_matrix_entries(const Matrix &matrix);

    /**
     * @p force = the virtual work of @p stress with the test gradient
     * (1 - @p new_weight) F_old + @p new_weight F_new. Not a number when an
     * element is turned inside out.
     */
    void
    assemble_force(const double          new_weight,
                   const StressFunction &stress,
                   const Vector         &old_solution,
                   const Vector         &new_solution,
                   Vector               &force) const;

    /// @p tangent += @p factor times the derivative of assemble_force().
    void
    add_matrix(const double          factor,
               const double          new_weight,
               const StressFunction &stress,
               const Vector         &old_solution,
               const Vector         &new_solution,
               Matrix               &tangent) const;

    /// Sum over the owned cells of @p density, a function of the material, C_old
    /// and the difference of C, on all ranks and for each part.
    std::vector<double>
    integrate(const std::function<double(const Material<dim> &,
                                         const Symmetric2 &,
                                         const Symmetric2 &)> &density,
              const Vector                                    &old_solution,
              const Vector &new_solution) const;

    /// F_old and F_new - F_old in point @p q of @p cell, from the ghosted
    /// vectors.
    void
    deformation(const unsigned int      cell,
                const unsigned int      q,
                dealii::Tensor<2, dim> &old_f,
                dealii::Tensor<2, dim> &difference) const;

    StressFunction
    collocation_stress() const;

    StressFunction
    step_stress(const double time_step) const;

    const std::vector<Material<dim>>    materials;
    const MPI_Comm                      communicator;
    double                              scale    = 0., round_off = 0.;
    unsigned int                        n_cells  = 0;
    unsigned int                        n_points = 0;
    unsigned int                        n_nodes  = 0;
    std::vector<char>                   cell_is_owned;
    std::vector<unsigned int>           cell_part;
    std::vector<dealii::Point<dim>>     cell_centers;
    std::vector<dealii::Tensor<1, dim>> shape_gradients; // cell, point, node
    std::vector<double>                 jxw;             // cell, point
    // Local indices of the displacements of a cell, node by node, in vectors
    // with ghost values and, -1 for other ranks', in vectors without.
    std::vector<int> ghosted_index, owned_index;
    // Where the entry of two displacements of a cell lies in the values of the
    // matrix; -1 in rows of other ranks.
    std::vector<int> matrix_entry;

    // Work space, so that nothing is allocated in a time step.
    mutable Vector              ghosted_old, ghosted_new;
    mutable std::vector<double> cell_vector, cell_matrix;
    mutable std::vector<double> test_strains, trial_strains;
    mutable std::vector<double> stress_columns;

    // The worst element of the last loop: det F and cell.
    mutable double       smallest_determinant = 1.;
    mutable unsigned int worst_cell           = 0;
  };
} // namespace Ricochet

#endif
