// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_gmsh_mesh_h
#define ricochet_problems_gmsh_mesh_h

#include <discretization/curved_geometry.h>

#include <deal.II/grid/tria.h>

#include <functional>
#include <map>
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

  /// The numbers of the physical groups of dimension @p dim by their names, from a file
  /// that check_gmsh_file() has passed.
  std::map<std::string, unsigned int>
  physical_groups(const std::string &file_name, const unsigned int dim);

  /**
   * Have Gmsh read @p file_name, mesh it if it is a geometry, and write the mesh as
   * @p msh_file (format 2.2). Without physical groups boundaries get the numbers that
   * Gmsh has given to their curves or surfaces.
   *
   * @param mesh_size length of an element (m); 0 for the sizes in the file.
   * @param seconds that Gmsh may take; 0 for any time.
   * @throws InputError naming the file.
   */
  void
  convert_to_gmsh_mesh(const std::string &file_name,
                       const std::string &msh_file,
                       const unsigned int dim,
                       const double       mesh_size,
                       const unsigned int seconds = 0);

  /**
   * Read a mesh, or mesh a geometry, as convert_to_gmsh_mesh() does for files
   * other than .msh: once for all ranks and phases of a run, as Gmsh makes meshes of one
   * geometry that differ where sets of addresses in OpenCASCADE have another order.
   * Collective on the ranks of OneRank::communicator().
   *
   * @param kept_file the mesh of the geometry from a run that is resumed; made anew if
   * that is not there.
   * @param boundary_names gets the boundary ids by the names of physical groups.
   * @param material_names gets the material ids in the same way.
   * @return see read_gmsh_mesh().
   * @throws InputError naming the file; also for an ending that is not known.
   */
  template <int dim>
  CellNodes<dim>
  read_any_mesh(
    const std::string                                 &file_name,
    const double                                       mesh_size,
    dealii::Triangulation<dim>                        &triangulation,
    std::map<std::string, dealii::types::boundary_id> &boundary_names,
    std::map<std::string, dealii::types::material_id> &material_names,
    const unsigned int                                 seconds   = 0,
    const std::string                                 &kept_file = "");

  /// Whether Gmsh has to mesh @p file_name.
  bool
  is_geometry(const std::string &file_name);

  /// The mesh that read_any_mesh() has made of a geometry, in Gmsh's format 2.2; for
  /// @p kept_file.
  std::string
  mesh_of_geometry(const std::string &file_name, const double mesh_size);
} // namespace Ricochet

#endif
