// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_gmsh_mesh_h
#define ricochet_problems_gmsh_mesh_h

#include <discretization/curved_geometry.h>

#include <deal.II/grid/tria.h>

#include <functional>
#include <string>

namespace Ricochet
{
  /**
   * A mesh of tetrahedra by Gmsh's API.
   *
   * @param describe makes the geometry with Gmsh's OpenCASCADE kernel and sets
   * Gmsh's options. All boundaries get the id 0.
   * @param curved gets the nodes of cells of second order, which lie on the geometry;
   * null for straight ones.
   * @throws InputError when Gmsh fails.
   */
  void
  mesh_by_gmsh(const std::function<void()> &describe,
               dealii::Triangulation<3>    &triangulation,
               CellNodes<3>                *curved = nullptr);

  /**
   * Read a mesh of Gmsh (format 2.2 or 4.1, ASCII) after check_gmsh_file(): material
   * and boundary ids are the numbers of physical groups.
   *
   * @return the nodes of its cells if they are of second order, otherwise nothing.
   * @throws InputError naming the file, when it cannot be read, or is not a mesh in
   * @p dim dimensions.
   */
  template <int dim>
  CellNodes<dim>
  read_gmsh_mesh(const std::string          &file_name,
                 dealii::Triangulation<dim> &triangulation);
} // namespace Ricochet

#endif
