// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_body_h
#define ricochet_discretization_body_h

#include <base/types.h>
#include <solvers/coarse_space.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <map>
#include <memory>
#include <set>

namespace Ricochet
{
  /// Whether the contact treatment brings unknowns of its own on the contact
  /// boundary.
  enum class MultiplierSpace
  {
    none,
    /// Continuous, piecewise linear: W^h of paper C, (4).
    linear
  };

  /**
   * The finite element view of one body: mesh, displacement space, multiplier
   * space on the contact boundary, and the numbering of all unknowns.
   *
   * The unknowns of the system are the displacements of all ranks and the
   * multipliers, numbered so that each rank owns one contiguous range: first
   * its displacements, then its multipliers. Without multipliers this is the
   * numbering of the DoFHandler itself.
   *
   * Triangles and tetrahedra get Lagrange elements on simplices,
   * quadrilaterals and hexahedra (and intervals) tensor product ones.
   */
  template <int dim>
  class Body
  {
  public:
    using BoundaryIds = std::set<dealii::types::boundary_id>;

    /**
     * @param triangulation any of deal.II's, all cells of the same kind.
     * @param degree polynomial degree of the displacement.
     * @param clamped boundary ids with zero displacement.
     * @param contact boundary ids that can touch the obstacle.
     */
    Body(const dealii::Triangulation<dim> &triangulation,
         const unsigned int                degree,
         const BoundaryIds                &clamped,
         const BoundaryIds                &contact,
         const MultiplierSpace             multipliers,
         const MPI_Comm                    communicator);

    /// System index of displacement DoF @p i of the DoFHandler.
    dealii::types::global_dof_index
    system_index(const dealii::types::global_dof_index i) const;

    /// System index of multiplier @p i of multiplier_dof_handler(), or
    /// numbers::invalid_dof_index where it is not on the contact boundary.
    dealii::types::global_dof_index
    multiplier_system_index(const dealii::types::global_dof_index i) const;

    /// Nodal interpolation of @p function (dim components) into the
    /// displacement part of @p vector.
    void
    interpolate(const dealii::Function<dim> &function, Vector &vector) const;

    /// The displacement part of a system vector, with ghost values, in the
    /// numbering of dof_handler(): for output and error norms.
    Vector
    displacement_part(const Vector &vector) const;

    /// An empty system vector on the owned unknowns.
    Vector
    make_vector() const;

    /// A system vector that also holds ghost values.
    Vector
    make_ghosted_vector() const;

    /**
     * For each owned unknown, in the order of their indices, its place in an
     * order of all unknowns that does not depend on the number of ranks: by the
     * first cell that has it, and its number there. For files. Collective.
     */
    std::vector<dealii::types::global_dof_index>
    canonical_positions() const;

    /// The displacements of degree 1 of a body without multipliers. Collective.
    CoarseSpace
    coarse_space() const;

    /// The sparsity pattern of all tangents.
    const dealii::TrilinosWrappers::SparsityPattern &
    sparsity_pattern() const
    {
      return pattern;
    }

    /// The part of it that couples equal components only, and multipliers with
    /// themselves only: that of mass matrices.
    const dealii::TrilinosWrappers::SparsityPattern &
    component_sparsity_pattern() const
    {
      return component_pattern;
    }

    const dealii::DoFHandler<dim> &
    dof_handler() const
    {
      return displacement_dofs;
    }

    const dealii::DoFHandler<dim> &
    multiplier_dof_handler() const
    {
      return multiplier_dofs;
    }

    /// The cell of multiplier_dof_handler() behind @p cell of dof_handler().
    typename dealii::DoFHandler<dim>::active_cell_iterator
    multiplier_cell(
      const typename dealii::DoFHandler<dim>::active_cell_iterator &cell) const
    {
      return {&displacement_dofs.get_triangulation(),
              cell->level(),
              cell->index(),
              &multiplier_dofs};
    }

    bool
    has_multipliers() const
    {
      return multipliers != MultiplierSpace::none;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return *geometry;
    }

    const dealii::Quadrature<dim> &
    cell_quadrature() const
    {
      return *cell_rule;
    }

    const dealii::Quadrature<dim - 1> &
    face_quadrature() const
    {
      return *face_rule;
    }

    const BoundaryIds &
    contact_boundary_ids() const
    {
      return contact_ids;
    }

    /// Owned system indices whose displacement is prescribed to be zero.
    const dealii::IndexSet &
    clamped_indices() const
    {
      return clamped;
    }

    /// Owned system indices of all displacements of nodes on the contact
    /// boundary: the ones that mass redistribution frees of inertia.
    const dealii::IndexSet &
    contact_indices() const
    {
      return contact_displacements;
    }

    /// Owned system indices of the multipliers.
    const dealii::IndexSet &
    multiplier_indices() const
    {
      return owned_multipliers;
    }

    const dealii::IndexSet &
    owned_indices() const
    {
      return owned;
    }

    const MPI_Comm communicator;

  private:
    void
    number_multipliers();

    void
    make_sparsity_patterns();

    std::unique_ptr<dealii::FESystem<dim>>       displacement_element;
    std::unique_ptr<dealii::FiniteElement<dim>>  multiplier_element;
    std::unique_ptr<dealii::Mapping<dim>>        geometry;
    std::unique_ptr<dealii::Quadrature<dim>>     cell_rule;
    std::unique_ptr<dealii::Quadrature<dim - 1>> face_rule;
    dealii::DoFHandler<dim>                      displacement_dofs;
    dealii::DoFHandler<dim>                      multiplier_dofs;
    const MultiplierSpace                        multipliers;
    const BoundaryIds                            clamped_ids, contact_ids;

    // First displacement DoF of each rank, and by how much the multipliers of
    // lower ranks shift it.
    std::vector<dealii::types::global_dof_index> rank_begin;
    std::vector<dealii::types::global_dof_index> rank_shift;
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
      multiplier_index;

    dealii::IndexSet owned, relevant, clamped, contact_displacements,
      owned_multipliers;
    dealii::TrilinosWrappers::SparsityPattern pattern, component_pattern;
  };
} // namespace Ricochet

#endif
