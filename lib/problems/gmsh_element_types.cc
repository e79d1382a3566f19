// SPDX-License-Identifier: LGPL-2.1-or-later
#include <problems/gmsh_element_types.h>

namespace Ricochet
{
  namespace
  {
    using Lists = std::vector<std::vector<unsigned int>>;

    const Lists edges_of_triangle{{0, 1}, {1, 2}, {2, 0}};
    const Lists edges_of_quadrilateral{{0, 1}, {1, 2}, {2, 3}, {3, 0}};
    const Lists faces_of_tetrahedron{{0, 1, 2},
                                     {0, 1, 3},
                                     {0, 2, 3},
                                     {1, 2, 3}};
    const Lists edges_of_tetrahedron{{0, 1},
                                     {1, 2},
                                     {2, 0},
                                     {3, 0},
                                     {2, 3},
                                     {1, 3}};
    const Lists faces_of_hexahedron{{0, 3, 2, 1},
                                    {0, 1, 5, 4},
                                    {0, 4, 7, 3},
                                    {1, 2, 6, 5},
                                    {2, 3, 7, 6},
                                    {4, 5, 6, 7}};
    const Lists edges_of_hexahedron{{0, 1},
                                    {0, 3},
                                    {0, 4},
                                    {1, 2},
                                    {1, 5},
                                    {2, 3},
                                    {2, 6},
                                    {3, 7},
                                    {4, 5},
                                    {4, 7},
                                    {5, 6},
                                    {6, 7}};

    Lists
    both(Lists first, const Lists &second)
    {
      first.insert(first.end(), second.begin(), second.end());
      return first;
    }
  } // namespace



  const GmshElementType *
  find_gmsh_element_type(const int number)
  {
    static const std::vector<GmshElementType> types{
      {15, "point", 0, 1, 1, 1, {}, {}},
      {1, "line", 1, 1, 2, 2, {}, {}},
      {2, "triangle", 2, 1, 3, 3, edges_of_triangle, {}},
      {3, "quadrilateral", 2, 1, 4, 4, edges_of_quadrilateral, {}},
      {4, "tetrahedron", 3, 1, 4, 4, faces_of_tetrahedron, {}},
      {5, "hexahedron", 3, 1, 8, 8, faces_of_hexahedron, {}},
      {8, "line of second order", 1, 2, 2, 3, {}, {{0, 1}}},
      {9,
       "triangle of second order",
       2,
       2,
       3,
       6,
       edges_of_triangle,
       edges_of_triangle},
      {10,
       "quadrilateral of second order",
       2,
       2,
       4,
       9,
       edges_of_quadrilateral,
       edges_of_quadrilateral},
      {11,
       "tetrahedron of second order",
       3,
       2,
       4,
       10,
       faces_of_tetrahedron,
       edges_of_tetrahedron},
      {12,
       "hexahedron of second order",
       3,
       2,
       8,
       27,
       faces_of_hexahedron,
       both(edges_of_hexahedron, faces_of_hexahedron)}};
    for (const GmshElementType &type : types)
      if (type.number == number)
        return &type;
    return nullptr;
  }
} // namespace Ricochet
