// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_mortar_triangles_h
#define ricochet_contact_kinematics_mortar_triangles_h

#include <contact/kinematics/mortar_shape.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/point_before_triangle.h>

#include <Sacado_Fad_SLFad.hpp>

namespace Ricochet
{
  template <int dim>
  class FacetSearch;

  /**
   * Contact of two surfaces in 3D in the weak sense (mortar): in each node j of the
   * slave the mean of the gap with the weight psi_j,
   *
   *     gap_j = 1/m_j int psi_j gap dA,   m_j = int psi_j dA   (undeformed areas);
   *
   * see MortarPair for 2D.
   *
   * Triangles of the master are projected on a triangle of the slave, along the normal
   * of the slave, and clip it (see ClippedTriangle). Each piece faces one triangle of
   * the master; gap and rows are linear there, times a linear psi_j, and three points
   * integrate them exactly: a uniform pressure passes whatever the meshes are. Faces
   * with four corners are four triangles around the mean of their nodes, which may be
   * warped.
   *
   * Pieces are cut at positions extrapolated to the middle of the step with the mean
   * velocity of the step before, and kept for the step: so points do not pass from one
   * triangle to another, rows are smooth, and the work of a pressure is exactly the
   * pressure times the change of the gap_j of these pieces. The next step has other
   * pieces. Between flat surfaces gap_j does not depend on the cuts; between curved
   * ones the gap at the end of a step is that at the beginning of the next one except
   * for the angles that points slide past and for parts that leave the end of the
   * master. A potential of that gap is therefore not the stored energy (two coarse
   * balls: energy 1.17 and 3.6 times the initial one), and treatments that recover it
   * are unsuitable.
   *
   * Literature: M. Puso, T. Laursen, A mortar segment-to-segment contact method for
   * large deformation solid mechanics, Comput. Methods Appl. Mech. Engrg. 193 (2004);
   * A. Popp, M. Gitterle, M. Gee, W. Wall, A dual mortar approach for 3D finite
   * deformation contact with consistent linearization, Int. J. Numer. Meth. Engng 83
   * (2010); here without condensation of the multipliers, and with rows that are
   * discrete gradients.
   */
  class MortarTriangles : public SurfacePair<3>
  {
  public:
    /// @throws InputError see SurfacePair; and for a surface against itself.
    MortarTriangles(const Body<3>     &body,
                    const ContactPair &pair,
                    const MortarShape  shape);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    /// Four shape functions on one triangle of a face, where they are linear, are
    /// linearly dependent: so are the constraints of nodes that face the master with
    /// that triangle only. The softness is small against the stiffness of the rows on
    /// the body, which is quadratic in them.
    double
    softness(const unsigned int p) const override
    {
      return softnesses[p];
    }

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int  p,
                const Coefficients &coefficients,
                const Caution       caution) const override;

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

  private:
    static constexpr unsigned int n_coordinates =
      PointBeforeTriangle<double>::n_coordinates;
    using Differentiable = Sacado::Fad::SLFad<double, n_coordinates>;
    using Corners        = PointBeforeTriangle<double>::Points<double>;

    /// A quadrature point, and the facet of the master opposite to it during
    /// the step.
    struct PiecePoint
    {
      /// Facets of both surfaces.
      unsigned int triangle = 0, opposite = 0;
      /// Weights of the corners of #triangle.
      std::array<double, 3> shares{};
      /// m^2
      double weight = 0.;

      bool                              up_to_date = false;
      PointBeforeTriangle<double>::Rows rows;

      /// Derivatives of gap, slip, D, T_1 and T_2 with respect to the coordinates at
      /// the end of the step, row by row. Several nodes need them.
      bool                differentiated = false;
      std::vector<double> derivatives;
    };

    /// A face of the slave that has a node of this rank: one triangle, or four of
    /// them around the mean of its nodes.
    struct Face
    {
      std::vector<unsigned int> triangles;
      /// Numbers of nodes.
      std::vector<unsigned int> nodes;
      /// psi_j = sum_k coefficients_jk N_k, row by row, where N_k is the shape function
      /// of a node; for the dual shape.
      std::vector<double>     dual_coefficients;
      std::vector<PiecePoint> points;
      /// Number of #points in use.
      unsigned int n_points = 0;
      /// The whole face is opposite to the master.
      bool is_covered = false;
    };

    /// A face of a point, and the index of the point among its nodes.
    struct Support
    {
      unsigned int face = 0, node = 0;
    };

    double
    reach_of_step(const Course &course) const override;

    /// The shape function of node @p k of a face in a point of one of its triangles.
    double
    shape_value(const Face                  &face,
                const unsigned int           k,
                const unsigned int           triangle,
                const std::array<double, 3> &shares) const;

    void
    make_dual_coefficients(Face &face) const;

    /// psi of node @p j of a face.
    double
    psi(const Face &face, const unsigned int j, const PiecePoint &point) const;

    /// Cut the triangles of @p face and put points on the pieces.
    void
    cut(Face                 &face,
        const Positions      &positions,
        const FacetSearch<3> &search) const;

    Corners
    corners(const PiecePoint &point, const Positions &positions) const;

    /// Mean of the gap of a point.
    double
    mean_gap(const unsigned int p, const Positions &positions) const;

    const PointBeforeTriangle<double>::Rows &
    rows_of(PiecePoint &point) const;

    /// PiecePoint::derivatives, in the order of the rows of gap (0), slip (1, 2) and
    /// the coordinates of D, T_1, T_2 (3, 3 + #n_coordinates, ...).
    const std::vector<double> &
    derivatives_of(PiecePoint &point) const;

    /// Index of a node's first unknown in @p rows; missing unknowns are appended.
    /// @p places has the indices of nodes of its surface that were found before.
    static unsigned int
    place_of(const ContactSurface<3>::Node &node,
             const unsigned int             number,
             std::vector<unsigned int>     &places,
             Rows                          &rows);

    /// Call @p add (index of an unknown, coordinate of the point or corner that moves
    /// with it, factor) for all unknowns of a point.
    template <typename Function>
    void
    for_each_unknown(const PiecePoint &point,
                     Rows             &rows,
                     const Function   &add) const;

    /// Reset the indices of the nodes of @p p.
    void
    forget_places(const unsigned int p) const;

    const MortarShape                 shape;
    mutable std::vector<Face>         faces;
    std::vector<std::vector<Support>> supports;
    /// Largest distance from the slave at which facets are cut, besides twice a
    /// triangle's size: the longest displacement increment in a step (m).
    double    way = 0.;
    Positions old_positions, new_positions;
    /// See softness().
    std::vector<double>               softnesses;
    mutable std::vector<Rows>         all_rows;
    mutable std::vector<bool>         up_to_date;
    mutable std::vector<unsigned int> slave_places, master_places;
    mutable std::vector<unsigned int> places, coordinates;
    mutable std::vector<double>       factors;
    mutable Derivatives               result;
  };
} // namespace Ricochet

#endif
