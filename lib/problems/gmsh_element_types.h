// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_gmsh_element_types_h
#define ricochet_problems_gmsh_element_types_h

#include <vector>

namespace Ricochet
{
  /// A type of element of Gmsh, of first or second order. Its vertices are its
  /// first nodes; those of second order have a node more on each of their
  /// edges, and may have more on their faces and within.
  struct GmshElementType
  {
    /// Gmsh's number for it.
    int          number;
    const char  *name;
    unsigned int dim;
    unsigned int order;
    unsigned int n_vertices;
    unsigned int n_nodes;
    /// Its faces by its nodes, in two dimensions its edges.
    std::vector<std::vector<unsigned int>> faces;
    /// The vertices of the edges and faces on which the nodes after the vertices are,
    /// in the order of these. The node within comes last, and is not in this list.
    std::vector<std::vector<unsigned int>> places;
  };

  /// The type with Gmsh's @p number, or null if it is none of those that can be read.
  const GmshElementType *
  find_gmsh_element_type(const int number);
} // namespace Ricochet

#endif
