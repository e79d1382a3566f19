// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_torus_mesh_h
#define ricochet_problems_torus_mesh_h

#include <deal.II/grid/tria.h>

namespace Ricochet
{
  /// A ring of tube with a wall, lengths in m.
  struct HollowTorus
  {
    dealii::Point<3> centre = {};
    /// The ring lies across it; of any length.
    dealii::Tensor<1, 3> axis = dealii::Tensor<1, 3>({0., 0., 1.});
    /// From the centre to the middle of the tube.
    double ring_radius = 1.;
    /// Outer radius of the tube.
    double tube_radius = .4;
    double wall        = .1;

    unsigned int n_around_ring = 24, n_around_tube = 12, n_across_wall = 1;
  };

  /// Boundary ids of a hollow torus.
  namespace TorusBoundary
  {
    constexpr dealii::types::boundary_id outside = 0;
    constexpr dealii::types::boundary_id inside  = 1;
  } // namespace TorusBoundary

  /**
   * Hexahedra with straight edges. Vertices: from the inside out, on each surface
   * around the ring, there around the tube; (a, r, t) is the vertex
   * (a n_around_ring + r) n_around_tube + t.
   *
   * @throws InputError for a wall that is no less than the tube's radius, a tube that
   * closes the hole of the ring, lengths that are not positive, an axis without length,
   * fewer than 4 cells around, none across.
   */
  void
  make_hollow_torus(const HollowTorus        &torus,
                    dealii::Triangulation<3> &triangulation);
} // namespace Ricochet

#endif
