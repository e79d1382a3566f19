// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <problems/round_meshes.h>

#include <deal.II/base/numbers.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// The point at the fraction @p turn of a circle, counted from its lowest
    /// point.
    Point<2>
    on_circle(const Point<2> &center, const double radius, const double turn)
    {
      const double angle = 2. * numbers::PI * turn;
      return center +
        radius * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
    }

    CellData<2>
    cell_of(const std::vector<unsigned int> &vertices)
    {
      CellData<2> cell(vertices.size());
      cell.vertices = vertices;
      return cell;
    }

    /// The number of nodes on each of the inner rings, the innermost first,
    /// such that their sum is @p n_inside. Ring k has about 6 k.
    std::vector<unsigned int>
    ring_counts(const unsigned int n_inside)
    {
      // 6 (1 + ... + m) = 3 m (m + 1) is next to n_inside.
      const unsigned int m =
        std::max<int>(1,
                      static_cast<int>(
                        std::round(std::sqrt(.25 + n_inside / 3.) - .5)));
      std::vector<unsigned int> counts;
      unsigned int              so_far = 0;
      for (unsigned int k = 1; k <= m; ++k)
        {
          const double share = static_cast<double>(k * (k + 1)) / (m * (m + 1));
          const unsigned int total =
            static_cast<unsigned int>(std::round(share * n_inside));
          counts.push_back(total - so_far);
          so_far = total;
        }
      return counts;
    }
  } // namespace



  void
  make_disk_of_triangles(const Point<2>    &center,
                         const double       radius,
                         const unsigned int n_boundary_nodes,
                         const unsigned int n_nodes,
                         Triangulation<2>  &triangulation)
  {
    if (n_boundary_nodes < 8)
      throw InputError("A disk needs at least 8 boundary nodes; " +
                       std::to_string(n_boundary_nodes) + " were asked for.");
    // One node in the centre and five on the first ring are the least inside.
    if (n_nodes < n_boundary_nodes + 6)
      throw InputError("A disk with " + std::to_string(n_boundary_nodes) +
                       " boundary nodes needs at least " +
                       std::to_string(n_boundary_nodes + 6) + " nodes; " +
                       std::to_string(n_nodes) + " were asked for.");

    std::vector<unsigned int> counts =
      ring_counts(n_nodes - n_boundary_nodes - 1);
    counts.push_back(n_boundary_nodes);

    // Between two boundary nodes the boundary is a chord; the ring within must
    // not reach it.
    if (1. - 1. / counts.size() >= std::cos(numbers::PI / n_boundary_nodes))
      throw InputError("A disk with " + std::to_string(n_boundary_nodes) +
                       " boundary nodes has no room for " +
                       std::to_string(n_nodes) +
                       " nodes: ask for more boundary nodes or fewer nodes.");

    std::vector<Point<2>>    vertices = {center};
    std::vector<CellData<2>> cells;
    unsigned int             inner_begin = 0, n_inner = 1;
    for (unsigned int ring = 0; ring < counts.size(); ++ring)
      {
        const unsigned int outer_begin = vertices.size();
        const unsigned int n_outer     = counts[ring];
        for (unsigned int i = 0; i < n_outer; ++i)
          vertices.push_back(on_circle(center,
                                       radius * (ring + 1) / counts.size(),
                                       static_cast<double>(i) / n_outer));

        // Walk around both rings at once; each triangle goes one node further
        // on the ring that is behind. The innermost "ring" is a point.
        const unsigned int n_inner_edges = n_inner == 1 ? 0 : n_inner;
        unsigned int       i = 0, j = 0;
        while (i < n_inner_edges || j < n_outer)
          {
            const unsigned int inner        = inner_begin + i % n_inner;
            const unsigned int outer        = outer_begin + j % n_outer;
            const bool         step_outside = j < n_outer &&
              (i == n_inner_edges ||
               (j + .5) * n_inner_edges <= (i + .5) * n_outer);
            if (step_outside)
              {
                ++j;
                cells.push_back(
                  cell_of({inner, outer, outer_begin + j % n_outer}));
              }
            else
              {
                ++i;
                cells.push_back(
                  cell_of({inner, outer, inner_begin + i % n_inner}));
              }
          }
        inner_begin = outer_begin;
        n_inner     = n_outer;
      }
    triangulation.create_triangulation(vertices, cells, SubCellData());
  }



  void
  make_disk_of_quadrilaterals(const Point<2>    &center,
                              const double       radius,
                              const unsigned int n_boundary_nodes,
                              Triangulation<2>  &triangulation)
  {
    unsigned int n = 8, n_refinements = 0;
    while (n < n_boundary_nodes)
      {
        n *= 2;
        ++n_refinements;
      }
    if (n != n_boundary_nodes)
      throw InputError(
        "A disk of quadrilaterals has 8, 16, 32, ... boundary "
        "nodes; " +
        std::to_string(n_boundary_nodes) + " were asked for.");
    GridGenerator::hyper_ball_balanced(triangulation, center, radius);
    triangulation.refine_global(n_refinements);
  }



  void
  make_ring(const Point<2>    &center,
            const double       inner_radius,
            const double       outer_radius,
            const unsigned int n_around,
            const unsigned int n_across,
            const CellShape    shape,
            Triangulation<2>  &triangulation)
  {
    if (n_around < 8 || n_across < 2)
      throw InputError("A ring needs at least 8 nodes around and 2 across; " +
                       std::to_string(n_around) + " and " +
                       std::to_string(n_across) + " were asked for.");
    if (shape == CellShape::triangles && n_around % 2 != 0)
      throw InputError(
        "A ring of triangles needs an even number of nodes "
        "around; " +
        std::to_string(n_around) + " were asked for.");

    std::vector<Point<2>>    vertices;
    std::vector<CellData<2>> cells;
    for (unsigned int j = 0; j < n_across; ++j)
      for (unsigned int i = 0; i < n_around; ++i)
        vertices.push_back(
          on_circle(center,
                    inner_radius +
                      (outer_radius - inner_radius) * j / (n_across - 1),
                    static_cast<double>(i) / n_around));
    for (unsigned int j = 0; j + 1 < n_across; ++j)
      for (unsigned int i = 0; i < n_around; ++i)
        {
          const unsigned int next = (i + 1) % n_around;
          const unsigned int a = j * n_around + i, b = (j + 1) * n_around + i,
                             c = (j + 1) * n_around + next,
                             d = j * n_around + next;
          if (shape == CellShape::quadrilaterals)
            // deal.II counts the vertices of a cell in a Z.
            cells.push_back(cell_of({a, b, d, c}));
          else if ((i + j) % 2 == 0)
            {
              cells.push_back(cell_of({a, b, c}));
              cells.push_back(cell_of({a, c, d}));
            }
          else
            {
              cells.push_back(cell_of({a, b, d}));
              cells.push_back(cell_of({b, c, d}));
            }
        }
    triangulation.create_triangulation(vertices, cells, SubCellData());

    const double middle = .5 * (inner_radius + outer_radius);
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->vertex(0).distance(center) > middle ? 0
                                                                          : 1);
  }
} // namespace Ricochet
