// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_ball_mesh_h
#define ricochet_problems_ball_mesh_h

#include <discretization/curved_geometry.h>

#include <deal.II/grid/tria.h>

#include <optional>
#include <string>

namespace Ricochet
{
  /// Boundary ids of balls: the lower half of the surface can touch something.
  namespace BallBoundary
  {
    constexpr dealii::types::boundary_id lower_half = 1;
    constexpr dealii::types::boundary_id upper_half = 2;
  } // namespace BallBoundary

  /**
   * Read a mesh of tetrahedra or hexahedra from a file of Gmsh. Its physical
   * surface 1 must be the lower half of the boundary.
   *
   * @return the nodes of its cells if they are of second order, otherwise nothing.
   * @throws InputError naming the file, when it cannot be read, is not a mesh in
   * three dimensions, or has no boundary 1.
   */
  CellNodes<3>
  read_ball(const std::string        &file_name,
            dealii::Triangulation<3> &triangulation);

  /// Local refinement: elements are smaller around a point, over some elements,
  /// and grow with the distance beyond.
  struct FinePlace
  {
    dealii::Point<3> place;
    /// m
    double mesh_size;
    /// Displacements of degree 1 need more of them for the same error.
    unsigned int degree;

    /// Number of elements within which they are of this size,
    double
    n_elements() const
    {
      return degree == 1 ? 12. : 6.;
    }

    /// and beyond larger by so much times the distance.
    double
    growth() const
    {
      return degree == 1 ? .15 : .3;
    }
  };

  /**
   * Tetrahedra of a ball by Gmsh's API, with elements of about @p mesh_size (m).
   *
   * @param curved gets the nodes of cells of second order, those of the surface being
   * on the sphere; null for cells with straight edges.
   * @throws InputError when Gmsh fails.
   */
  void
  make_ball_of_tetrahedra(const dealii::Point<3>         &center,
                          const double                    radius,
                          const double                    mesh_size,
                          dealii::Triangulation<3>       &triangulation,
                          CellNodes<3>                   *curved = nullptr,
                          const std::optional<FinePlace> &fine   = {});

  /// Hexahedra of a ball, refined until their edges on the surface are at most
  /// @p mesh_size (m). A distributed triangulation is refined in parts.
  void
  make_ball_of_hexahedra(const dealii::Point<3>   &center,
                         const double              radius,
                         const double              mesh_size,
                         dealii::Triangulation<3> &triangulation);
} // namespace Ricochet

#endif
