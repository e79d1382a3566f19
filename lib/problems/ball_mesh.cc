// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <problems/ball_mesh.h>
#include <problems/gmsh_mesh.h>

#include <deal.II/base/mpi.h>
#include <deal.II/grid/grid_generator.h>

#include <gmsh.h>

#include <algorithm>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    void
    mark_halves(const double center_height, Triangulation<3> &triangulation)
    {
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary())
            face->set_boundary_id(face->center()[2] < center_height
                                    ? BallBoundary::lower_half
                                    : BallBoundary::upper_half);
    }

    void
    refine_around(const FinePlace &fine, const double mesh_size)
    {
      namespace field = gmsh::model::mesh::field;
      const int tag   = field::add("Ball");
      field::setNumber(tag, "XCenter", fine.place[0]);
      field::setNumber(tag, "YCenter", fine.place[1]);
      field::setNumber(tag, "ZCenter", fine.place[2]);
      field::setNumber(tag, "Radius", fine.n_elements() * fine.mesh_size);
      field::setNumber(tag,
                       "Thickness",
                       (mesh_size - fine.mesh_size) / fine.growth());
      field::setNumber(tag, "VIn", fine.mesh_size);
      field::setNumber(tag, "VOut", mesh_size);
      field::setAsBackgroundMesh(tag);
      gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
    }
  } // namespace



  CellNodes<3>
  read_ball(const std::string &file_name, Triangulation<3> &triangulation)
  {
    CellNodes<3> nodes = read_gmsh_mesh(file_name, triangulation);
    const auto   ids   = triangulation.get_boundary_ids();
    if (std::find(ids.begin(), ids.end(), BallBoundary::lower_half) ==
        ids.end())
      throw InputError("The mesh '" + file_name +
                       "' has no physical surface 1, which must be the part of "
                       "the boundary that can touch the foundation.");
    return nodes;
  }



  void
  make_ball_of_tetrahedra(const Point<3>                 &center,
                          const double                    radius,
                          const double                    mesh_size,
                          Triangulation<3>               &triangulation,
                          CellNodes<3>                   *curved,
                          const std::optional<FinePlace> &fine)
  {
    mesh_by_gmsh(
      [&]() {
        gmsh::option::setNumber("Mesh.MeshSizeMin",
                                fine ? fine->mesh_size : mesh_size);
        gmsh::option::setNumber("Mesh.MeshSizeMax", mesh_size);
        gmsh::model::occ::addSphere(center[0], center[1], center[2], radius);
        if (fine)
          refine_around(*fine, mesh_size);
      },
      triangulation,
      curved);
    mark_halves(center[2], triangulation);
  }



  void
  make_ball_of_hexahedra(const Point<3>   &center,
                         const double      radius,
                         const double      mesh_size,
                         Triangulation<3> &triangulation)
  {
    GridGenerator::hyper_ball_balanced(triangulation, center, radius);
    const auto longest_edge = [&]() {
      double length = 0.;
      for (const auto &cell : triangulation.active_cell_iterators())
        for (const auto &face : cell->face_iterators())
          if (face->at_boundary() && !cell->is_artificial())
            for (const unsigned int line : face->line_indices())
              length = std::max(length,
                                face->line(line)->vertex(0).distance(
                                  face->line(line)->vertex(1)));
      return Utilities::MPI::max(length, triangulation.get_communicator());
    };
    while (longest_edge() > mesh_size)
      triangulation.refine_global();
    mark_halves(center[2], triangulation);
  }
} // namespace Ricochet
