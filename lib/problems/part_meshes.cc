// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <problems/part_meshes.h>

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>

namespace Ricochet
{
  using namespace dealii;

  namespace
  {
    /// Vertices, cells and boundary of all parts, before they become a mesh.
    /// Merging triangulations would join vertices of parts that touch.
    class PartsBuilder
    {
    public:
      /// The number that the next vertex will have.
      unsigned int
      n_vertices() const
      {
        return vertices.size();
      }

      void
      add_vertex(const Point<2> &vertex)
      {
        vertices.push_back(vertex);
      }

      /// @p cell_vertices in the order of deal.II: counter-clockwise for a
      /// triangle, in a Z for a quadrilateral.
      void
      add_cell(const std::vector<unsigned int> &cell_vertices,
               const unsigned int               part)
      {
        CellData<2> cell(cell_vertices.size());
        cell.vertices    = cell_vertices;
        cell.material_id = part;
        cells.push_back(cell);
      }

      void
      add_boundary_edge(const unsigned int       a,
                        const unsigned int       b,
                        const types::boundary_id id)
      {
        boundary_ids[std::minmax(a, b)] = id;
      }

      void
      create(Triangulation<2> &triangulation) const
      {
        triangulation.create_triangulation(vertices, cells, SubCellData());
        // Vertices keep their numbers. Positions would not do: parts may touch.
        for (const auto &cell : triangulation.active_cell_iterators())
          for (const auto &face : cell->face_iterators())
            if (face->at_boundary())
              {
                const unsigned int a = face->vertex_index(0);
                const unsigned int b = face->vertex_index(1);
                face->set_boundary_id(boundary_ids.at(std::minmax(a, b)));
              }
      }

    private:
      std::vector<Point<2>>    vertices;
      std::vector<CellData<2>> cells;

      /// By the two vertices of an edge, the lesser number first.
      std::map<std::pair<unsigned int, unsigned int>, types::boundary_id>
        boundary_ids;
    };

    void
    add_ringed_disk(const RingedDisk  &disk,
                    const unsigned int part,
                    PartsBuilder      &builder)
    {
      builder.add_vertex(disk.centre);
      unsigned int inner_begin = builder.n_vertices() - 1;
      for (unsigned int k = 1; k <= disk.n_rings; ++k)
        {
          const unsigned int outer_begin = builder.n_vertices();
          // The quotient first: it is 1 on the circle.
          const double radius =
            disk.radius * (static_cast<double>(k) / disk.n_rings);
          for (unsigned int j = 0; j < 6 * k; ++j)
            {
              const double angle = 2. * numbers::PI * j / (6. * k) + disk.angle;
              builder.add_vertex(
                disk.centre +
                radius * Tensor<1, 2>({std::cos(angle), std::sin(angle)}));
            }

          for (unsigned int sector = 0; sector < 6; ++sector)
            {
              const auto outer = [&](const unsigned int j) {
                return outer_begin + (sector * k + j) % (6 * k);
              };
              const auto inner = [&](const unsigned int j) {
                // The ring within the first is the centre.
                return k == 1
                  ? inner_begin
                  : inner_begin + (sector * (k - 1) + j) % (6 * (k - 1));
              };
              for (unsigned int j = 0; j < k; ++j)
                builder.add_cell({outer(j), outer(j + 1), inner(j)}, part);
              for (unsigned int j = 0; j + 1 < k; ++j)
                builder.add_cell({inner(j), outer(j + 1), inner(j + 1)}, part);
              if (k == disk.n_rings)
                for (unsigned int j = 0; j < k; ++j)
                  builder.add_boundary_edge(outer(j), outer(j + 1), part);
            }
          inner_begin = outer_begin;
        }
    }

    /// A part whose node (i, j) of @p n_along times @p n_across lies at
    /// @p position (i/(n_along-1), j/(n_across-1)). @p side_ids in the order of
    /// Rectangle::Side.
    void
    add_structured_part(
      const unsigned int                                         n_along,
      const unsigned int                                         n_across,
      const std::function<Point<2>(const double, const double)> &position,
      const CellShape                                            shape,
      const std::array<types::boundary_id, 4>                   &side_ids,
      const unsigned int                                         part,
      PartsBuilder                                              &builder)
    {
      const unsigned int begin = builder.n_vertices();
      const auto node = [&](const unsigned int i, const unsigned int j) {
        return begin + j * n_along + i;
      };

      for (unsigned int j = 0; j < n_across; ++j)
        for (unsigned int i = 0; i < n_along; ++i)
          builder.add_vertex(position(static_cast<double>(i) / (n_along - 1),
                                      static_cast<double>(j) / (n_across - 1)));

      for (unsigned int j = 0; j + 1 < n_across; ++j)
        for (unsigned int i = 0; i + 1 < n_along; ++i)
          {
            // Counter-clockwise from the lower left.
            const unsigned int a = node(i, j), b = node(i + 1, j),
                               c = node(i + 1, j + 1), d = node(i, j + 1);
            if (shape == CellShape::quadrilaterals)
              builder.add_cell({a, b, d, c}, part);
            else if ((i + j) % 2 == 0)
              {
                builder.add_cell({a, b, c}, part);
                builder.add_cell({a, c, d}, part);
              }
            else
              {
                builder.add_cell({a, b, d}, part);
                builder.add_cell({b, c, d}, part);
              }
          }

      for (unsigned int j = 0; j + 1 < n_across; ++j)
        {
          builder.add_boundary_edge(node(0, j),
                                    node(0, j + 1),
                                    side_ids[Rectangle::left]);
          builder.add_boundary_edge(node(n_along - 1, j),
                                    node(n_along - 1, j + 1),
                                    side_ids[Rectangle::right]);
        }
      for (unsigned int i = 0; i + 1 < n_along; ++i)
        {
          builder.add_boundary_edge(node(i, 0),
                                    node(i + 1, 0),
                                    side_ids[Rectangle::lower]);
          builder.add_boundary_edge(node(i, n_across - 1),
                                    node(i + 1, n_across - 1),
                                    side_ids[Rectangle::upper]);
        }
    }

    /// Not a number is not positive either.
    bool
    is_length(const double number)
    {
      return std::isfinite(number) && number > 0.;
    }

    bool
    is_finite(const Tensor<1, 2> &vector)
    {
      return std::isfinite(vector[0]) && std::isfinite(vector[1]);
    }

    /// @throws InputError
    void
    check(const StentArteryGeometry &geometry)
    {
      const std::vector<std::pair<std::string, double>> lengths = {
        {"length of the artery", geometry.artery_length},
        {"thickness of the artery", geometry.artery_thickness},
        {"length of the stent", geometry.stent_length},
        {"thickness of the stent", geometry.stent_thickness},
        {"gap between the stent and the artery", geometry.gap},
        {"height of the struts", geometry.strut_height}};
      for (const auto &[name, length] : lengths)
        if (!is_length(length))
          throw InputError("The " + name + " must be positive; it is " +
                           to_text(length) + ".");

      const std::vector<std::pair<std::string, unsigned int>> n_nodes = {
        {"along the artery", geometry.artery_nodes_along},
        {"across the artery", geometry.artery_nodes_across},
        {"along the stent", geometry.stent_nodes_along},
        {"across the stent", geometry.stent_nodes_across}};
      for (const auto &[direction, n] : n_nodes)
        if (n < 2)
          throw InputError("There must be at least 2 nodes " + direction +
                           "; " + std::to_string(n) + " were asked for.");

      if (geometry.n_struts == 0)
        throw InputError("A stent needs at least one strut.");

      // Round-off in the sum of two decimal fractions.
      const double round_off = 1e-12 * geometry.artery_length;
      const double stent_end = geometry.stent_begin + geometry.stent_length;
      if (!(geometry.stent_begin >= 0. &&
            stent_end <= geometry.artery_length + round_off))
        throw InputError(
          "The stent must not reach beyond the artery, from 0 "
          "to " +
          to_text(geometry.artery_length) + " mm; it lies from " +
          to_text(geometry.stent_begin) + " to " + to_text(stent_end) + " mm.");
    }
  } // namespace



  void
  make_ringed_disks(const std::vector<RingedDisk> &disks,
                    Triangulation<2>              &triangulation)
  {
    if (disks.empty())
      throw InputError("A mesh of disks needs at least one disk.");
    PartsBuilder builder;
    for (unsigned int part = 0; part < disks.size(); ++part)
      {
        const RingedDisk &disk = disks[part];
        if (!is_length(disk.radius))
          throw InputError(
            "The radius of a disk must be positive; that of "
            "disk " +
            std::to_string(part) + " is " + to_text(disk.radius) + ".");
        if (disk.n_rings == 0)
          throw InputError("A disk needs at least one ring; disk " +
                           std::to_string(part) + " has none.");
        if (!is_finite(disk.centre) || !std::isfinite(disk.angle))
          throw InputError("The centre or the angle of disk " +
                           std::to_string(part) + " is not finite.");
        add_ringed_disk(disk, part, builder);
      }
    builder.create(triangulation);
  }



  void
  make_stent_artery(const StentArteryGeometry &geometry,
                    Triangulation<2>          &triangulation)
  {
    using Geometry = StentArteryGeometry;
    check(geometry);
    PartsBuilder builder;
    add_structured_part(
      geometry.artery_nodes_along,
      geometry.artery_nodes_across,
      [&](const double s, const double t) {
        return Point<2>(geometry.artery_length * s,
                        geometry.artery_thickness * t);
      },
      CellShape::triangles,
      {{Geometry::artery_ends,
        Geometry::artery_ends,
        Geometry::artery_inner_wall,
        Geometry::artery_outer_side}},
      0,
      builder);
    add_structured_part(
      geometry.stent_nodes_along,
      geometry.stent_nodes_across,
      [&](const double s, const double t) {
        const double upper_side = -geometry.gap -
          geometry.strut_height *
            (1. + std::cos(2. * numbers::PI * geometry.n_struts * s));
        return Point<2>(geometry.stent_begin + geometry.stent_length * s,
                        upper_side - geometry.stent_thickness * (1. - t));
      },
      CellShape::triangles,
      {{Geometry::stent_ends,
        Geometry::stent_ends,
        Geometry::stent_lower_side,
        Geometry::stent_upper_side}},
      1,
      builder);
    builder.create(triangulation);
  }



  types::boundary_id
  rectangle_side(const unsigned int part, const unsigned int side)
  {
    if (side > Rectangle::upper)
      throw InputError("The sides of a rectangle are 0 to 3; " +
                       std::to_string(side) + " was asked for.");
    return 4 * part + side;
  }



  void
  make_rectangles(const std::vector<Rectangle> &rectangles,
                  const CellShape               shape,
                  Triangulation<2>             &triangulation)
  {
    if (rectangles.empty())
      throw InputError("A mesh of rectangles needs at least one rectangle.");
    PartsBuilder builder;
    for (unsigned int part = 0; part < rectangles.size(); ++part)
      {
        const Rectangle &rectangle = rectangles[part];
        for (unsigned int c = 0; c < 2; ++c)
          {
            if (!is_length(rectangle.upper_right[c] - rectangle.lower_left[c]))
              throw InputError(
                "The lower left corner of a rectangle must be to the left of "
                "and below its upper right one; in rectangle " +
                std::to_string(part) + " they lie at " +
                to_text(rectangle.lower_left[c]) + " and " +
                to_text(rectangle.upper_right[c]) + " along " +
                (c == 0 ? "x" : "y") + ".");
            if (rectangle.n_cells[c] == 0)
              throw InputError(
                "A rectangle needs at least one cell in each "
                "direction; rectangle " +
                std::to_string(part) + " has none along " +
                (c == 0 ? "x" : "y") + ".");
          }
        if (!is_finite(rectangle.shift) || !std::isfinite(rectangle.angle))
          throw InputError("The shift or the angle of rectangle " +
                           std::to_string(part) + " is not finite.");

        const double cosine = std::cos(rectangle.angle);
        const double sine   = std::sin(rectangle.angle);
        add_structured_part(
          rectangle.n_cells[0] + 1,
          rectangle.n_cells[1] + 1,
          [&](const double s, const double t) {
            // With this formula both ends are exact to the last digit, so that
            // sides that should touch do.
            const double x =
              (1. - s) * rectangle.lower_left[0] + s * rectangle.upper_right[0];
            const double y =
              (1. - t) * rectangle.lower_left[1] + t * rectangle.upper_right[1];
            return Point<2>(cosine * x - sine * y, sine * x + cosine * y) +
              rectangle.shift;
          },
          shape,
          {{rectangle_side(part, Rectangle::left),
            rectangle_side(part, Rectangle::right),
            rectangle_side(part, Rectangle::lower),
            rectangle_side(part, Rectangle::upper)}},
          part,
          builder);
      }
    builder.create(triangulation);
  }



  template <int dim>
  void
  join_parts(const std::vector<const Triangulation<dim> *> &bodies,
             Triangulation<dim>                            &triangulation,
             const bool                                     keep_material_ids)
  {
    std::vector<Point<dim>>    points;
    std::vector<CellData<dim>> cells;
    SubCellData                boundary;
    for (unsigned int p = 0; p < bodies.size(); ++p)
      {
        const unsigned int first = points.size();
        const auto        &own   = bodies[p]->get_vertices();
        points.insert(points.end(), own.begin(), own.end());
        for (const auto &cell : bodies[p]->active_cell_iterators())
          {
            CellData<dim> data(cell->n_vertices());
            data.material_id = keep_material_ids ? cell->material_id() : p;
            for (const unsigned int v : cell->vertex_indices())
              data.vertices[v] = first + cell->vertex_index(v);
            cells.push_back(data);
            for (const auto &face : cell->face_iterators())
              if (face->at_boundary() && face->boundary_id() != 0)
                {
                  CellData<dim - 1> face_data(face->n_vertices());
                  face_data.boundary_id = face->boundary_id();
                  for (const unsigned int v : face->vertex_indices())
                    face_data.vertices[v] = first + face->vertex_index(v);
                  if constexpr (dim == 2)
                    boundary.boundary_lines.push_back(face_data);
                  else
                    boundary.boundary_quads.push_back(face_data);
                }
          }
      }
    triangulation.create_triangulation(points, cells, boundary);
  }


  template void
  join_parts(const std::vector<const Triangulation<2> *> &,
             Triangulation<2> &,
             const bool);
  template void
  join_parts(const std::vector<const Triangulation<3> *> &,
             Triangulation<3> &,
             const bool);
} // namespace Ricochet
