// SPDX-License-Identifier: LGPL-2.1-or-later
#include <contact/obstacles/level_set.h>
#include <output/obstacle_surfaces.h>

#include <deal.II/base/function_lib.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/grid/grid_generator.h>
#include <deal.II/grid/grid_tools.h>
#include <deal.II/grid/tria.h>
#include <deal.II/lac/vector.h>
#include <deal.II/numerics/vector_tools.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace Ricochet
{
  using namespace dealii;

  template <int dim>
  ObstacleSurfaces<dim>::ObstacleSurfaces(const Obstacles &all)
  {
    for (const auto &entry : all)
      if (std::find(obstacles.begin(), obstacles.end(), entry.second) ==
          obstacles.end())
        obstacles.push_back(entry.second);
  }



  namespace
  {
    /// A piece of a surface: a line, a triangle or a quadrilateral.
    template <int dim>
    struct Piece
    {
      std::vector<Point<dim>> corners;
    };

    /// The box in which to look for @p obstacle: around the bodies, and as far as to the
    /// obstacle if it is near.
    template <int dim>
    BoundingBox<dim>
    surroundings(const BoundingBox<dim> &bodies,
                 const RigidObstacle    &obstacle,
                 const double            time)
    {
      const auto [lower, upper]    = bodies.get_boundary_points();
      const double            size = lower.distance(upper);
      std::vector<Point<dim>> points;
      for (unsigned int corner = 0; corner < (1U << dim); ++corner)
        {
          const Point<dim> place = bodies.vertex(corner);
          points.push_back(place);
          const double gap = obstacle.gap(in_space<dim>(place), time);
          if (!(std::abs(gap) < 3. * size))
            continue;
          const Tensor<1, 3> normal =
            obstacle.normal(in_space<dim>(place), time);
          Point<dim> nearest = place;
          for (unsigned int c = 0; c < dim; ++c)
            nearest[c] -= gap * normal[c];
          points.push_back(nearest);
        }
      BoundingBox<dim> box(points);
      // In 2D a line is cheap, wherever the body moves.
      box.extend(dim == 2 && obstacle.shape().is_plane() ? 5. * size : size);
      return box;
    }

    /// Whether certainly no point of the surface is in @p box. Level sets give
    /// no certainty; the gaps of all other shapes are distances.
    template <int dim>
    bool
    is_out_of_sight(const BoundingBox<dim> &box,
                    const RigidObstacle    &obstacle,
                    const double            time)
    {
      const auto [lower, upper] = box.get_boundary_points();
      return dynamic_cast<const LevelSet *>(&obstacle.shape()) == nullptr &&
        std::abs(obstacle.gap(in_space<dim>(box.center()), time)) >
        .5 * lower.distance(upper) * (1. + 1e-8);
    }

    template <int dim>
    std::vector<Piece<dim>>
    pieces(const BoundingBox<dim> &box,
           const RigidObstacle    &obstacle,
           const double            time,
           const unsigned int      n_obstacles)
    {
      if (is_out_of_sight(box, obstacle, time))
        return {};
      const auto [lower, upper] = box.get_boundary_points();
      double longest            = 0.;
      for (unsigned int c = 0; c < dim; ++c)
        longest = std::max(longest, box.side_length(c));
      // A plane is found exactly; in 3D its pieces are small enough to be cut.
      const bool   is_plane = obstacle.shape().is_plane();
      const double most =
        dim == 2 ? (is_plane ? 4 : 160) : (is_plane ? 24 : 40);
      // A picture of many obstacles should not take longer than one of a few.
      const double n_cells =
        std::ceil(most / std::pow(std::max(1., n_obstacles / 4.), 1. / dim));
      std::vector<unsigned int> divisions;
      for (unsigned int c = 0; c < dim; ++c)
        divisions.push_back(
          std::max(1., std::ceil(n_cells * box.side_length(c) / longest)));
      Triangulation<dim> grid;
      GridGenerator::subdivided_hyper_rectangle(grid, divisions, lower, upper);
      const FE_Q<dim> element(1);
      DoFHandler<dim> dofs(grid);
      dofs.distribute_dofs(element);
      dealii::Vector<double> gaps(dofs.n_dofs());
      VectorTools::interpolate(
        dofs,
        ScalarFunctionFromFunctionObject<dim>([&](const Point<dim> &place) {
          return obstacle.gap(in_space<dim>(place), time);
        }),
        gaps);
      const MappingQ1<dim>           mapping;
      std::vector<Point<dim>>        vertices;
      std::vector<CellData<dim - 1>> cells;
      GridTools::MarchingCubeAlgorithm<dim, dealii::Vector<double>>(mapping,
                                                                    element)
        .process(dofs, gaps, 0., vertices, cells);
      std::vector<Piece<dim>> result;
      for (const auto &cell : cells)
        {
          result.emplace_back();
          for (const unsigned int v : cell.vertices)
            result.back().corners.push_back(vertices[v]);
        }
      return result;
    }

    ReferenceCell
    kind_of(const unsigned int n_corners)
    {
      return n_corners == 2 ? ReferenceCells::Line
        : n_corners == 3    ? ReferenceCells::Triangle
                            : ReferenceCells::Quadrilateral;
    }
  } // namespace



  template <int dim>
  std::string
  ObstacleSurfaces<dim>::vtu(const BoundingBox<dim>      &bodies,
                             const DataOutBase::VtkFlags &flags) const
  {
    using Patch = DataOutBase::Patch<dim - 1, dim>;
    std::vector<Patch> patches;
    for (unsigned int k = 0; k < obstacles.size(); ++k)
      {
        const RigidObstacle &obstacle = *obstacles[k];
        for (const Piece<dim> &piece :
             pieces(surroundings(bodies, obstacle, flags.time),
                    obstacle,
                    flags.time,
                    obstacles.size()))
          {
            const unsigned int n = piece.corners.size();
            Patch              patch;
            patch.reference_cell = kind_of(n);
            patch.n_subdivisions = 1;
            patch.patch_index    = patches.size();
            patch.data.reinit(dim + 1, n);
            for (unsigned int v = 0; v < n; ++v)
              {
                patch.vertices[v] = piece.corners[v];
                const Tensor<1, 3> normal =
                  obstacle.normal(in_space<dim>(piece.corners[v]), flags.time);
                for (unsigned int c = 0; c < dim; ++c)
                  patch.data(c, v) = normal[c];
                patch.data(dim, v) = k;
              }
            patches.push_back(patch);
          }
      }
    std::vector<std::string> names(dim, "normal");
    names.emplace_back("obstacle");
    std::ostringstream text;
    DataOutBase::write_vtu_header(text, flags);
    // Without any surface in view the file is empty, and has to be written
    // separately.
    if (patches.empty())
      text << "<Piece NumberOfPoints=\"0\" NumberOfCells=\"0\">\n"
              "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
              "format=\"ascii\"/></Points>\n<Cells>\n"
              "<DataArray type=\"Int32\" Name=\"connectivity\" "
              "format=\"ascii\"/>\n<DataArray type=\"Int32\" Name=\"offsets\" "
              "format=\"ascii\"/>\n<DataArray type=\"UInt8\" Name=\"types\" "
              "format=\"ascii\"/>\n</Cells>\n</Piece>\n";
    else
      DataOutBase::write_vtu_main(
        patches,
        names,
        {std::make_tuple(
          0,
          dim - 1,
          std::string("normal"),
          DataComponentInterpretation::component_is_part_of_vector)},
        flags,
        text);
    DataOutBase::write_vtu_footer(text);
    return text.str();
  }


  // There is nothing to show in 1D.
  template <>
  std::string
  ObstacleSurfaces<1>::vtu(const BoundingBox<1> &,
                           const DataOutBase::VtkFlags &) const
  {
    return "";
  }


  template class ObstacleSurfaces<1>;
  template class ObstacleSurfaces<2>;
  template class ObstacleSurfaces<3>;
} // namespace Ricochet
