// SPDX-License-Identifier: LGPL-2.1-or-later
#include <problems/cell_group.h>

#include <deal.II/grid/grid_tools.h>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  void
  keep_cells_of(const types::material_id id,
                Triangulation<dim>      &cells,
                CellNodes<dim>          &nodes)
  {
    std::vector<CellData<dim>> kept;
    SubCellData                boundary;
    CellNodes<dim>             kept_nodes;
    const auto                 add_face = [&boundary](const auto &face) {
      CellData<dim - 1> data(face->n_vertices());
      for (const unsigned int v : face->vertex_indices())
        data.vertices[v] = face->vertex_index(v);
      data.boundary_id = face->boundary_id();
      if constexpr (dim == 2)
        boundary.boundary_lines.push_back(data);
      else
        boundary.boundary_quads.push_back(data);
    };
    for (const auto &cell : cells.active_cell_iterators())
      if (cell->material_id() == id)
        {
          CellData<dim> data(cell->n_vertices());
          for (const unsigned int v : cell->vertex_indices())
            data.vertices[v] = cell->vertex_index(v);
          data.material_id = id;
          kept.push_back(data);
          if (!nodes.empty())
            kept_nodes.push_back(nodes[cell->active_cell_index()]);
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary() && face->boundary_id() != 0)
              add_face(face);
        }
    std::vector<Point<dim>> vertices = cells.get_vertices();
    GridTools::delete_unused_vertices(vertices, kept, boundary);
    cells.clear();
    cells.create_triangulation(vertices, kept, boundary);
    nodes = kept_nodes;
  }


  template void
  keep_cells_of(const types::material_id, Triangulation<2> &, CellNodes<2> &);
  template void
  keep_cells_of(const types::material_id, Triangulation<3> &, CellNodes<3> &);
} // namespace Ricochet
