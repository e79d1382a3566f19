// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_body_h
#define ricochet_discretization_body_h

#include <base/types.h>
#include <solvers/block_matrix.h>
#include <solvers/coarse_space.h>
#include <solvers/constraints.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_system.h>
#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/trilinos_sparsity_pattern.h>

#include <array>
#include <map>
#include <memory>
#include <set>
#include <vector>

namespace Ricochet
{
  /// Whether the contact treatment brings unknowns of its own on the contact
  /// boundary.
  enum class MultiplierSpace
  {
    none,
    /// Continuous, piecewise linear: W^h of paper C, (4).
    linear,
    /// Multipliers of the degree of the displacements: one in each node.
    nodal,
    /// As many multipliers in each node as there are directions: one for the
    /// pressure, the others for the tangential traction.
    nodal_vector
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
    /// Which components of the displacement are prescribed, by boundary id.
    using HeldComponents =
      std::map<dealii::types::boundary_id, std::array<bool, dim>>;

    /// One vertex that has an id as a part of the boundary does, for conditions: the nearest
    /// one to a place, of some parts.
    struct Vertex
    {
      /// m
      dealii::Point<dim> place;
      /// Parts from the first to before the last one, of so many.
      unsigned int begin = 0, end = 1, n_parts = 1;
    };
    using Vertices = std::map<dealii::types::boundary_id, Vertex>;

    /**
     * @param triangulation any of deal.II's, all cells of the same kind.
     * @param degree polynomial degree of the displacement.
     * @param clamped boundary ids with zero displacement.
     * @param contact boundary ids that can touch something.
     * @param held boundary ids of which some components of the displacement are
     * prescribed.
     * @param curved the geometry of its cells (see curved_geometry.h), for a
     * displacement of degree 2; null for cells with straight edges.
     * @param multiplier_sets the boundary ids with multipliers: a node that several
     * contacts hold has those of several sets. One set with all ids of @p contact if empty.
     * @param vertices with ids of their own, which the mesh does not have.
     */
    Body(const dealii::Triangulation<dim> &triangulation,
         const unsigned int                degree,
         const BoundaryIds                &clamped,
         const BoundaryIds                &contact,
         const MultiplierSpace             multipliers,
         const MPI_Comm                    communicator,
         const HeldComponents             &held            = {},
         const dealii::Mapping<dim>       *curved          = nullptr,
         const std::vector<BoundaryIds>   &multiplier_sets = {},
         const Vertices                   &vertices        = {});

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

    /// A system vector that also holds ghost values, and those of the unknowns @p more.
    Vector
    make_ghosted_vector(
      const std::vector<dealii::types::global_dof_index> &more = {}) const;

    /**
     * For each owned unknown, in the order of their indices, its position in an
     * order of all unknowns that does not depend on the number of ranks: by the
     * first cell that has it, and its number there. For files. Collective.
     */
    std::vector<dealii::types::global_dof_index>
    canonical_positions() const;

    /// Checksum of the mesh for checkpoints: of nodes of the geometry, numbers of parts
    /// and boundaries; the same on any number of ranks. Collective.
    std::uint64_t
    mesh_checksum() const;

    /// The displacements of degree 1 of a body without multipliers. Collective.
    /// @param of_own_degree those of the body's own degree instead, with or without
    /// multipliers: no prolongation, rigid body modes only.
    CoarseSpace
    coarse_space(const bool of_own_degree = false) const;

    /// The sparsity pattern of all tangents. This and the other patterns are made when
    /// they are first asked for, by all ranks.
    const dealii::TrilinosWrappers::SparsityPattern &
    sparsity_pattern() const;

    /// The part of it that couples equal components only, and multipliers with
    /// themselves only: that of mass matrices.
    const dealii::TrilinosWrappers::SparsityPattern &
    component_sparsity_pattern() const;

    /// The same by blocks between nodes. @pre no multipliers on several ranks.
    const std::shared_ptr<const BlockPattern> &
    block_pattern() const;

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

    /// The number, of @p n_parts, of the part that @p cell belongs to, which is
    /// its material id. Parts of a body are not connected, or have different
    /// materials. With one part ids do not matter.
    unsigned int
    part(const typename dealii::DoFHandler<dim>::active_cell_iterator &cell,
         const unsigned int n_parts) const
    {
      return n_parts > 1 ? cell->material_id() : 0;
    }

    /// The part of each owned displacement, in the order of owned_indices(); where
    /// two parts meet, the first. @throws InputError when a cell belongs to none of
    /// @p n_parts, or a part has no cell.
    std::vector<unsigned int>
    parts_of_unknowns(const unsigned int n_parts) const;

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

    unsigned int
    n_multiplier_sets() const
    {
      return multiplier_ids.size();
    }

    /// The number of multipliers that a node has in each set.
    unsigned int
    n_multipliers_per_node() const
    {
      return multipliers == MultiplierSpace::nodal_vector ? dim : 1;
    }

    /// The component of multiplier_dof_handler() of multiplier @p c of a node in @p set.
    unsigned int
    multiplier_component(const unsigned int set, const unsigned int c) const
    {
      return set * n_multipliers_per_node() + c;
    }

    const dealii::Mapping<dim> &
    mapping() const
    {
      return *geometry;
    }

    /// Whether edges of cells are curved.
    bool
    is_curved() const
    {
      return curved_geometry;
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

    /// Whether @p id is that of a vertex.
    bool
    is_vertex(const dealii::types::boundary_id id) const
    {
      return unknowns_of_vertices.count(id) > 0;
    }

    /// Owned system indices of the displacements in direction @p component of nodes
    /// on the boundary @p id, or of the vertex with that id. Collective.
    dealii::IndexSet
    boundary_displacements(const dealii::types::boundary_id id,
                           const unsigned int               component) const;

    /// Prescribed displacements, by their system indices.
    const Constraints &
    constraints() const
    {
      return prescribed;
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
    /// System indices of the owned ones of these displacements of the
    /// DoFHandler.
    dealii::IndexSet
    owned_system_indices(const dealii::IndexSet &displacement_set) const;

    void
    number_multipliers();

    void
    make_sparsity_pattern(
      const bool                                 by_component,
      dealii::TrilinosWrappers::SparsityPattern &result) const;

    std::unique_ptr<dealii::FESystem<dim>>       displacement_element;
    std::unique_ptr<dealii::FESystem<dim>>       multiplier_element;
    std::unique_ptr<dealii::Mapping<dim>>        geometry;
    std::unique_ptr<dealii::Quadrature<dim>>     cell_rule;
    std::unique_ptr<dealii::Quadrature<dim - 1>> face_rule;
    dealii::DoFHandler<dim>                      displacement_dofs;
    dealii::DoFHandler<dim>                      multiplier_dofs;
    const MultiplierSpace                        multipliers;
    const BoundaryIds                            clamped_ids, contact_ids;
    const std::vector<BoundaryIds>               multiplier_ids;
    const bool                                   curved_geometry;

    // First displacement DoF of each rank, and by how much the multipliers of
    // lower ranks shift it.
    std::vector<dealii::types::global_dof_index> rank_begin;
    std::vector<dealii::types::global_dof_index> rank_shift;
    std::map<dealii::types::global_dof_index, dealii::types::global_dof_index>
      multiplier_index;

    /// Owned unknowns of the vertices that have ids.
    std::map<dealii::types::boundary_id,
             std::vector<dealii::types::global_dof_index>>
      unknowns_of_vertices;

    dealii::IndexSet owned, relevant, contact_displacements, owned_multipliers;
    Constraints      prescribed;
    mutable dealii::TrilinosWrappers::SparsityPattern pattern,
      component_pattern;
    mutable std::shared_ptr<const BlockPattern> blocks;
  };
} // namespace Ricochet

#endif
