// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_gmsh_file_check_h
#define ricochet_problems_gmsh_file_check_h

#include <string>

namespace Ricochet
{
  /**
   * Check that @p file_name can be read without blocking, as pipes and devices
   * would, and is not far too large, as a misprint or a sparse file may be: a
   * mesh takes at least sixteen times the memory of its file.
   *
   * @throws InputError
   */
  void
  check_mesh_file(const std::string &file_name);

  /**
   * Check that @p file_name is a whole ASCII mesh of Gmsh (format 2.2 or 4.1)
   * that can be read as a mesh of dimension @p dim, which is 2 or 3: by deal.II when
   * its elements are of first order, by Gmsh when they are of second. deal.II's reader trusts its input: damaged files make it crash, hang, or
   * fail without a word on where. It should see only files that pass here.
   *
   * A file passes with
   * - the sections $MeshFormat, $PhysicalNames (optional), $Entities (optional,
   *   only in format 4.1), $Nodes and $Elements, each once, in this order,
   *   complete and with as many entries as their counts state; others may only
   *   follow these;
   * - one entry per line, as Gmsh writes it;
   * - nodes with unique numbers and finite coordinates;
   * - elements of first or second order that have nodes of the file, no node twice,
   *   and at most one physical group, whose number is not negative; those that
   *   share an edge or a face share the node on it;
   * - cells of one shape: triangles or quadrilaterals in 2D, tetrahedra or
   *   hexahedra in 3D, each once, with a volume that is not zero, and no face
   *   in more than two of them;
   * - elements of dimension @p dim - 1 that are faces of the boundary, those of
   *   one face in one physical group; in 3D no lines within the body.
   *
   * Nodes that no element has are allowed, and cells of negative orientation
   * too, which deal.II turns around. Time is that of sorting the elements, and
   * memory a small multiple of the file's size, whatever the file says.
   *
   * @return the order of the cells, 1 or 2.
   * @throws InputError with the file, the line and the reason.
   */
  unsigned int
  check_gmsh_file(const std::string &file_name, const unsigned int dim);
} // namespace Ricochet

#endif
