// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_round_meshes_h
#define ricochet_problems_round_meshes_h

#include <deal.II/grid/tria.h>

namespace Ricochet
{
  /// The shape of the cells of a mesh in 2D.
  enum class CellShape
  {
    triangles,
    quadrilaterals
  };

  /**
   * A disk of triangles with exactly @p n_nodes vertices, @p n_boundary_nodes of
   * them on the circle, the first at its lowest point; all of the boundary has
   * the id 0. Vertices lie on rings of equal distance, about six more on each
   * ring than on the one within, so that triangles are nearly equilateral.
   *
   * @throws InputError for fewer than 8 boundary nodes or too few nodes inside.
   */
  void
  make_disk_of_triangles(const dealii::Point<2>   &center,
                         const double              radius,
                         const unsigned int        n_boundary_nodes,
                         const unsigned int        n_nodes,
                         dealii::Triangulation<2> &triangulation);

  /**
   * A disk of quadrilaterals, refined until @p n_boundary_nodes vertices lie on
   * the circle.
   *
   * @throws InputError when that is not 8 times a power of 2.
   */
  void
  make_disk_of_quadrilaterals(const dealii::Point<2>   &center,
                              const double              radius,
                              const unsigned int        n_boundary_nodes,
                              dealii::Triangulation<2> &triangulation);

  /**
   * A structured ring with @p n_around vertices on each of @p n_across circles,
   * one of them at its lowest point. The outer boundary has the id 0, the inner
   * one 1. Quadrilaterals are cut into triangles along alternating diagonals.
   *
   * @throws InputError for fewer than 8 vertices around, fewer than 2 across, or
   * an odd number around with triangles.
   */
  void
  make_ring(const dealii::Point<2>   &center,
            const double              inner_radius,
            const double              outer_radius,
            const unsigned int        n_around,
            const unsigned int        n_across,
            const CellShape           shape,
            dealii::Triangulation<2> &triangulation);
} // namespace Ricochet

#endif
