// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_surfaces_contact_surface_h
#define ricochet_contact_surfaces_contact_surface_h

#include <discretization/body.h>

#include <array>
#include <optional>
#include <vector>

namespace Ricochet
{
  /**
   * A part of the boundary that can touch another one: facets, their
   * neighbours, and the unknowns of their nodes. Every rank stores all of this,
   * in the same order for any number of ranks: surfaces are small compared with
   * bodies, and the partner of a point may be on any rank. Positions of nodes
   * are exchanged only near contact (see SurfacePair).
   *
   * In 2D facets are segments from node 0 to node 1 with the outside on
   * their left, in 1D single nodes. In 3D they are triangles, whose nodes are
   * seen anticlockwise from outside; a quadrilateral is four of them around the
   * mean of its nodes, which moves with them.
   *
   * With displacements of degree 2 the nodes between vertices are nodes of the surface,
   * and each face is the straight facets between all of its nodes: two segments, four
   * triangles, or, of a quadrilateral, eight around its middle node. Nodes of
   * curved cells lie on the boundary of the body, so that the surface is as
   * accurate as that of cells of half the size.
   */
  template <int dim>
  class ContactSurface
  {
  public:
    struct Node
    {
      /// m
      dealii::Point<dim> reference_position;
      /// System indices of the displacement.
      std::array<dealii::types::global_dof_index, dim> unknowns;
      /// System indices of the multipliers, the normal one first; invalid ones
      /// without.
      std::array<dealii::types::global_dof_index, dim> multipliers;
      /// The node has multipliers of more than one set: several contacts may hold it.
      bool has_several_sets = false;
      /// All of the node's displacement is prescribed.
      bool is_held = false;
      /// Not a node, but the mean of these; it has no unknowns of its own.
      std::vector<unsigned int> mean_of;
    };

    struct Facet
    {
      /// Numbers of nodes.
      std::array<unsigned int, dim> nodes;
      /// Outward unit normal before any displacement.
      dealii::Tensor<1, dim>     normal;
      dealii::types::boundary_id boundary_id = 0;
      /// Number of the body's part: the material id of its cell.
      dealii::types::material_id part = 0;
      /// The rank whose cell is behind it.
      unsigned int owner = 0;
      /// Length (m) or area (m^2); 1 in 1D.
      double measure = 1.;
      /// Diameter of the cell behind it (m).
      double cell_diameter = 0.;
      /// Volume over face of that cell, no more than the thickness of the body there (m).
      double cell_height = 0.;
      /// Neighbours in 2D: the previous and the next facet, at node 0 and node
      /// 1; none at an open end.
      std::optional<unsigned int> previous, next;
      /// Neighbours in 3D: the facets beyond its edges from node 0 to 1, 1 to 2
      /// and 2 to 0.
      std::array<std::optional<unsigned int>, 3> neighbours;
    };

    /// @param multiplier_set that of the multipliers of the nodes, see Body.
    /// @throws InputError when the boundaries have no facet, for a degree beyond
    /// 2, and where more than two facets meet. Collective.
    ContactSurface(const Body<dim>                            &body,
                   const std::set<dealii::types::boundary_id> &boundaries,
                   const unsigned int multiplier_set = 0);

    /// Means come after all nodes.
    std::vector<Node>  nodes;
    std::vector<Facet> facets;

    /// Call @p action (number of a node, its weight) for the nodes that node @p
    /// n moves with: itself, or those that it is the mean of.
    template <typename Action>
    void
    for_each_node_of(const unsigned int n, const Action &action) const
    {
      const std::vector<unsigned int> &mean_of = nodes[n].mean_of;
      if (mean_of.empty())
        action(n, 1.);
      for (const unsigned int of : mean_of)
        action(of, 1. / mean_of.size());
    }

    /// The boundaries of the surface in groups whose facets are connected with each other.
    std::vector<std::set<dealii::types::boundary_id>>
    connected_boundaries() const;

  private:
    void
    connect_facets();
  };
} // namespace Ricochet

#endif
