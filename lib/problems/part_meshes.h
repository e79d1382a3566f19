// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_part_meshes_h
#define ricochet_problems_part_meshes_h

#include <problems/round_meshes.h>

#include <deal.II/grid/tria.h>

#include <array>
#include <vector>

/**
 * @file
 * Meshes of several bodies, the parts, in one triangulation. The material id
 * of a cell is the number of its part: 0, 1, ... No two parts have a common
 * vertex: where they touch, two vertices coincide. Vertices are numbered part
 * after part, in an order that is documented, so that a node can be named.
 */
namespace Ricochet
{
  /// A disk of triangles with 6 k nodes on ring k: see make_ringed_disks().
  struct RingedDisk
  {
    dealii::Point<2> centre = {};
    double           radius = 1.;

    /// Rings around the node in the centre; the last is the circle.
    unsigned int n_rings = 11;

    /// The direction in which the first node of each ring lies, in radians
    /// from the x axis.
    double angle = 0.;
  };

  /**
   * Disks that are known node for node. Part p is disk p, and so is the
   * boundary id p.
   *
   * Vertices: the centre, then ring after ring. Ring k of n has the radius
   * radius k/n, and its node j of 6 k lies at 2 pi j/(6 k) + angle. It is thus
   * the vertex 1 + 3 k (k-1) + j of its disk; a disk has 1 + 3 n (n+1). In each
   * of six sectors k triangles stand on ring k, and k-1 on ring k-1 point
   * outwards between them.
   *
   * @throws InputError for no disk, one without rings or radius.
   */
  void
  make_ringed_disks(const std::vector<RingedDisk> &disks,
                    dealii::Triangulation<2>      &triangulation);

  /**
   * Bodies that are meshed already, side by side. Part p is @p bodies[p]; its boundary
   * ids are unchanged, its vertices come after those of the parts before. Meshes
   * must not be refined.
   *
   * @param keep_material_ids where bodies know already which part their cells are.
   */
  template <int dim>
  void
  join_parts(const std::vector<const dealii::Triangulation<dim> *> &bodies,
             dealii::Triangulation<dim> &triangulation,
             const bool                  keep_material_ids = false);

  /// A stent below the wall of an artery, with lengths in mm: see
  /// make_stent_artery().
  struct StentArteryGeometry
  {
    /// @name Boundary ids
    /// @{
    /// y = 0, which faces the stent.
    static constexpr dealii::types::boundary_id artery_inner_wall = 0;
    /// y = artery_thickness.
    static constexpr dealii::types::boundary_id artery_outer_side = 1;
    /// x = 0 and x = artery_length.
    static constexpr dealii::types::boundary_id artery_ends = 2;
    /// The side that faces the artery.
    static constexpr dealii::types::boundary_id stent_upper_side = 3;
    /// The side in the lumen, where a balloon presses.
    static constexpr dealii::types::boundary_id stent_lower_side = 4;
    /// x = stent_begin and x = stent_begin + stent_length.
    static constexpr dealii::types::boundary_id stent_ends = 5;
    /// @}

    /// Size of the rectangle, from 0, that is the artery.
    double artery_length    = 20.;
    double artery_thickness = 1.;

    /// Nodes along x and y.
    unsigned int artery_nodes_along  = 81;
    unsigned int artery_nodes_across = 9;

    /// The least x of the stent, and its extent along x.
    double stent_begin  = 4.;
    double stent_length = 12.;

    /// Along y, everywhere.
    double stent_thickness = .2;

    /// Nodes along x and y.
    unsigned int stent_nodes_along  = 102;
    unsigned int stent_nodes_across = 4;

    /// Between the inner wall and the crests of the stent.
    double gap = .05;

    /// The amplitude of the wave: crests are twice as much above troughs.
    double strut_height = .15;

    /// Whole waves over the length of the stent. A stent begins and ends in a
    /// trough.
    unsigned int n_struts = 5;
  };

  /**
   * An artery (part 0) and, below it, a stent (part 1) whose upper side is
   * y = -gap - strut_height (1 + cos(2 pi n_struts s)) over s = 0 ... 1.
   *
   * Both are structured: node i along and j across, counted from the lower
   * left, is the vertex j n_along + i of its part, the artery's first.
   * Quadrilaterals are cut from lower left to upper right where i + j of their
   * lower left node is even, and along the other diagonal where it is odd.
   * Boundary ids are named in StentArteryGeometry.
   *
   * @throws InputError for lengths that are not positive, fewer than 2 nodes in
   * a direction, no strut, a stent that reaches beyond the ends of the artery.
   */
  void
  make_stent_artery(const StentArteryGeometry &geometry,
                    dealii::Triangulation<2>  &triangulation);

  /// A rectangle along the axes, then rotated, then shifted: see
  /// make_rectangles().
  struct Rectangle
  {
    /// The sides before the rotation, in the order of deal.II's faces.
    enum Side : unsigned int
    {
      left,
      right,
      lower,
      upper
    };

    dealii::Point<2> lower_left = {}, upper_right = {};

    /// Quadrilaterals along the lower and the left side.
    std::array<unsigned int, 2> n_cells = {{1, 1}};

    /// Counter-clockwise about the origin, in radians.
    double angle = 0.;

    /// After the rotation.
    dealii::Tensor<1, 2> shift = {};
  };

  /**
   * The boundary id of one side of one rectangle of make_rectangles():
   * 4 @p part + @p side, the latter a Rectangle::Side.
   *
   * @throws InputError for a fifth side.
   */
  dealii::types::boundary_id
  rectangle_side(const unsigned int part, const unsigned int side);

  /**
   * Part p is rectangle p, and its boundary ids are rectangle_side(p, ...).
   * Vertices of a part are numbered row after row from its lower left, and
   * quadrilaterals are cut into triangles along alternating diagonals, as in
   * make_stent_artery().
   *
   * @throws InputError for no rectangle, one without extent or cells.
   */
  void
  make_rectangles(const std::vector<Rectangle> &rectangles,
                  const CellShape               shape,
                  dealii::Triangulation<2>     &triangulation);
} // namespace Ricochet

#endif
