// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_points_before_triangles_h
#define ricochet_contact_kinematics_points_before_triangles_h

#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/point_before_triangle.h>

#include <Sacado_Fad_SLFad.hpp>

namespace Ricochet
{
  template <int dim>
  class FacetSearch;

  /**
   * Each point of the slave, a node or a quadrature point, is held by the one triangle
   * of the master before which it will be in the middle of the step, if the mean
   * velocity of the step before goes on: the closest one there that faces it. It stays
   * before the plane of this triangle during the step, wherever it goes along it.
   *
   * Increments are exact within the step (see PointBeforeTriangle), and so are energy
   * and momenta of conditions on the increment. A point that slides over an edge has
   * another gap before the next triangle than before the last one, by the angle
   * between them times the way behind the edge.
   */
  class PointsBeforeTriangles : public SurfacePair<3>
  {
  public:
    enum class PointsIn
    {
      nodes,
      quadrature_points
    };

    /// @throws InputError see SurfacePair; and for a surface against itself.
    PointsBeforeTriangles(const Body<3>     &body,
                          const ContactPair &pair,
                          const PointsIn     points_in);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int p,
                const double       pressure,
                const Tangential  &traction,
                const Caution      caution) const override;

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

  private:
    using Differentiable = Sacado::Fad::SLFad<double, 12>;
    template <typename Number>
    using Corners = std::array<std::array<Number, 3>, 4>;

    /// What the row of an unknown is made of: coordinates of the point and the
    /// triangle's corners that move with it, and by how much.
    struct Share
    {
      unsigned int place, coordinate;
      double       factor;
    };

    struct Step
    {
      unsigned int       facet      = 0;
      bool               up_to_date = false;
      Rows               rows;
      std::vector<Share> shares;
    };

    void
    make_quadrature_points(const Body<3> &body);

    /// Positions of the point @p p and of the corners of facet @p f.
    Corners<double>
    corners(const unsigned int p,
            const unsigned int f,
            const Positions   &positions) const;

    /// Whether the point, the first of @p x, is beyond an open edge of the surface, or
    /// beside the facet @p f.
    bool
    is_off(const Corners<double> &x, const unsigned int f) const;

    /// The facet before which the point is, of those that @p search knows, if there
    /// is one.
    std::optional<unsigned int>
    find_facet(const unsigned int    p,
               const FacetSearch<3> &search,
               const Positions      &positions) const;

    /// Let the point be before facet @p f in this step.
    void
    set_facet(const unsigned int p, const unsigned int f);

    void
    update(const unsigned int p) const;

    Positions                                 old_positions, new_positions;
    mutable std::vector<Step>                 steps;
    mutable PointBeforeTriangle<double>::Rows triangle_rows;
    mutable PointBeforeTriangle<Differentiable>::Rows differentiable_rows;
    mutable Derivatives                               result;
  };
} // namespace Ricochet

#endif
