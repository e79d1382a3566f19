// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_hyperelastic_bulk_h
#define ricochet_discretization_hyperelastic_bulk_h

#include <base/ghosted_vector.h>
#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <materials/material.h>

#include <deal.II/base/aligned_vector.h>

#include <array>
#include <memory>

namespace Ricochet
{
  /**
   * A hyperelastic body with large strains, and its viscosity.
   *
   * Collocation forces are those of the stored energy; the force of a step uses
   * Gonzalez' stress with the mean deformation gradient (papers A (3.7), B
   * (3.2)), and its tangent is the exact one, which is not symmetric.
   *
   * Shape gradients and the positions of all matrix entries are computed once.
   * Cells go through all loops in batches, a cell to each lane of Lanes. A rank
   * assembles its own rows, from all cells that touch them, so that assembly
   * needs no communication except for ghost values.
   */
  template <int dim>
  class HyperelasticBulk : public BulkOperator
  {
  public:
    /// @param materials of the parts of the body; cells of parts that are not hyperelastic are
    /// left out, see bulk_of_parts().
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

    double
    energy_round_off() const override
    {
      return energy_error;
    }

    bool
    is_linear() const override
    {
      return false;
    }

    std::string
    failure() const override;

    /// Check of quadrilaterals and hexahedra of degree 1: in a triangle or
    /// tetrahedron the gradient is constant.
    std::string
    inverted_corner(const Vector &solution) const override;

  private:
    using Gradient   = dealii::Tensor<2, dim, Lanes>;
    using Symmetric2 = dealii::SymmetricTensor<2, dim, Lanes>;
    using Symmetric4 = dealii::SymmetricTensor<4, dim, Lanes>;

    // A StressFunction gives the stress S and, if asked for, its derivative dS/dC in
    // points of a material, from C_old and the difference of C.

    void
    find_matrix_entries(const Matrix &matrix);

    /**
     * Three deformation gradients F_old + weight (F_new - F_old), as weights: that of the
     * test functions; the one at which the increment of C is taken, 2 sym(F^T (F_new -
     * F_old)); and the one with which that increment changes with F_new, 2 sym(F^T dF).
     */
    struct Increment
    {
      double test, strain, trial;

      /// A stress at F_new.
      static constexpr Increment
      none()
      {
        return {1., .5, 1.};
      }

      /// A stress over the step, with C_new - C_old.
      static constexpr Increment
      of_step()
      {
        return {.5, .5, 1.};
      }

      /// A stress at F_new by the rate of C there, F_new - F_old being that of F times a
      /// time.
      static constexpr Increment
      of_rate()
      {
        return {1., 1., 2.};
      }

      /// The same, with the derivative of C at F_new.
      static constexpr Increment
      strain_of_rate()
      {
        return {1., 1., 1.};
      }
    };

    /// The increment of C, and C_new less that.
    static void
    find_strains(const Increment &increment,
                 const Gradient  &old_f,
                 const Gradient  &difference_f,
                 Symmetric2      &old_c,
                 Symmetric2      &change);

    /// @p force = the virtual work of @p stress. Not a number when an element is
    /// inverted.
    template <typename StressFunction>
    void
    assemble_force(const Increment      &increment,
                   const StressFunction &stress,
                   const Vector         &old_solution,
                   const Vector         &new_solution,
                   Vector               &force) const;

    /// Numbers of points and nodes of a cell that are known when the loops are
    /// compiled: of all elements of degree 1. 0: of any cell.
    template <unsigned int n_points_of_cell, unsigned int n_nodes_of_cell>
    struct CellSize
    {};

    /// Call @p action with the CellSize of the body.
    template <typename Action>
    void
    with_cell_size(const Action &action) const;

    /// The loop of assemble_force().
    template <unsigned int n_points_of_cell,
              unsigned int n_nodes_of_cell,
              typename StressFunction>
    void
    add_forces(const CellSize<n_points_of_cell, n_nodes_of_cell> size,
               const Increment                                  &increment,
               const StressFunction                             &stress,
               double                                           *values) const;

    /// @p tangent += @p factor times the derivative of assemble_force().
    template <typename StressFunction>
    void
    add_matrix(const double          factor,
               const Increment      &increment,
               const StressFunction &stress,
               const Vector         &old_solution,
               const Vector         &new_solution,
               Matrix               &tangent) const;

    /// The loop of add_matrix().
    template <unsigned int n_points_of_cell,
              unsigned int n_nodes_of_cell,
              typename StressFunction>
    void
    add_matrices(const CellSize<n_points_of_cell, n_nodes_of_cell> size,
                 const double                                      factor,
                 const Increment                                  &increment,
                 const StressFunction                             &stress,
                 double *values) const;

    /// Sum over the owned cells of @p density, a function of the material, C_old
    /// and the difference of C, on all ranks and for each part.
    template <typename Density>
    std::vector<double>
    integrate(const Density &density,
              const Vector  &old_solution,
              const Vector  &new_solution) const;

    /// Fill the ghosted vectors.
    void
    import_ghosts(const Vector &old_solution, const Vector &new_solution) const;

    /// #cell_old and #cell_change of a batch of cells with @p n_nodes, from the ghosted
    /// vectors.
    void
    gather(const unsigned int batch, const unsigned int n_nodes) const;

    /// F_old and F_new - F_old in a point of the batch of the last gather(), with the
    /// shape @p gradients of its nodes there.
    void
    deformation(const dealii::Tensor<1, dim, Lanes> *gradients,
                const unsigned int                   n_nodes,
                Gradient                            &old_f,
                Gradient                            &difference) const;

    /// Replace flat or inverted elements, which are recorded, by the body at
    /// rest. @return 1 elsewhere.
    Lanes
    mend(const unsigned int batch, Gradient &old_f, Gradient &difference) const;

    /// StressFunctions.
    static auto
    collocation_stress();

    static auto
    step_stress(const double time_step);

    /// Viscous stress at a rate. @param with_c for the derivative with respect to C at
    /// that rate, instead of the stress and its derivative with respect to the rate.
    static auto
    rate_stress(const double rate_time, const bool with_c);

    const std::vector<Material<dim>> materials;
    const MPI_Comm                   communicator;
    double       scale = 0., round_off = 0., energy_error = 0.;
    unsigned int n_batches = 0;
    unsigned int n_points  = 0;
    unsigned int n_nodes   = 0;
    // By cell.
    std::vector<dealii::Point<dim>> cell_centers;
    // By batch: the part, and the cells; the last batch of a part may have some twice,
    // without weight.
    std::vector<unsigned int>                            batch_part;
    std::vector<std::array<unsigned int, Lanes::size()>> batch_cells;
    // Corners of the cells of each batch (m), where they are checked.
    bool                                                 has_corners = false;
    dealii::AlignedVector<dealii::Tensor<1, dim, Lanes>> corners;
    dealii::AlignedVector<dealii::Tensor<1, dim, Lanes>>
                                 shape_gradients; // batch, point, node
    dealii::AlignedVector<Lanes> jxw;             // batch, point
    // The same in cells of this rank, and zero in those of others.
    dealii::AlignedVector<Lanes> owned_jxw;
    // Local indices of the displacements of a cell, node by node, in vectors
    // with ghost values and, -1 for other ranks', in vectors without; lanes innermost.
    std::vector<int> ghosted_index, owned_index;
    // Where the entry of two displacements of a cell lies in the values of the
    // matrix; -1 in rows of other ranks.
    std::vector<int> matrix_entry;

    // Work space, so that nothing is allocated in a time step: displacements of a batch
    // relative to the first node, and their changes.
    mutable GhostedVector                ghosted_old, ghosted_new;
    mutable dealii::AlignedVector<Lanes> cell_old, cell_change;
    mutable dealii::AlignedVector<Lanes> cell_vector, cell_matrix;
    mutable dealii::AlignedVector<Lanes> test_strains, trial_strains;
    mutable dealii::AlignedVector<Lanes> stress_columns;

    // The worst element of the last loop: det F and cell.
    mutable double       smallest_determinant = 1.;
    mutable unsigned int worst_cell           = 0;
  };
} // namespace Ricochet

#endif
