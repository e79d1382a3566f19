// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_curved_geometry_h
#define ricochet_discretization_curved_geometry_h

#include <deal.II/fe/mapping.h>
#include <deal.II/grid/tria.h>

#include <map>
#include <memory>
#include <vector>

namespace Ricochet
{
  /**
   * The nodes of cells of second order, which have curved edges: for each cell of a
   * mesh that was not refined, by its number there, the positions (m) of its
   * vertices, of a node on each of its lines, and, of quadrilaterals and hexahedra,
   * of one on each face and one within, in the order of deal.II.
   */
  template <int dim>
  using CellNodes = std::vector<std::vector<dealii::Point<dim>>>;

  /// Positions (m) of the nodes that are on the edges and faces between vertices, and
  /// within cells, by the sorted numbers of these vertices in a triangulation.
  template <int dim>
  using NodesBetween = std::map<std::vector<unsigned int>, dealii::Point<dim>>;

  /// The nodes of the cells of @p triangulation, all of which are in @p between.
  template <int dim>
  CellNodes<dim>
  collect_cell_nodes(const dealii::Triangulation<dim> &triangulation,
                     const NodesBetween<dim>          &between);

  /**
   * The geometry of a mesh with the nodes @p of_first_rank, which only the first rank
   * has to give: x = sum_a N_a(xi) x_a with the shape functions N_a of degree 2.
   * Displacements of degree 2 are isoparametric in it.
   *
   * @param triangulation the mesh, or parts of it on each rank.
   * Collective.
   */
  template <int dim>
  std::unique_ptr<dealii::Mapping<dim>>
  make_curved_geometry(const CellNodes<dim>             &of_first_rank,
                       const dealii::Triangulation<dim> &triangulation,
                       const MPI_Comm                    communicator);

  /// The geometry of degree 2 of quadrilaterals or hexahedra whose nodes are on the
  /// manifolds that @p triangulation has. @p triangulation must live longer.
  template <int dim>
  std::unique_ptr<dealii::Mapping<dim>>
  make_curved_geometry(const dealii::Triangulation<dim> &triangulation);
} // namespace Ricochet

#endif
