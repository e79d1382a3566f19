// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_gmsh_mesh_h
#define ricochet_problems_gmsh_mesh_h

#include <deal.II/grid/tria.h>

#include <functional>

namespace Ricochet
{
  /**
   * A mesh of tetrahedra by Gmsh's API.
   *
   * @param describe makes the geometry with Gmsh's OpenCASCADE kernel and sets
   * Gmsh's options. All boundaries get the id 0.
   * @throws InputError when Gmsh fails.
   */
  void
  mesh_by_gmsh(const std::function<void()> &describe,
               dealii::Triangulation<3>    &triangulation);
} // namespace Ricochet

#endif
