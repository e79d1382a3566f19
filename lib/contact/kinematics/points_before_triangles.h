// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_points_before_triangles_h
#define ricochet_contact_kinematics_points_before_triangles_h

#include <base/threads.h>
#include <contact/kinematics/surface_pair.h>
#include <contact/surfaces/own_facets.h>
#include <contact/surfaces/point_passing_triangles.h>
#include <contact/surfaces/rounded_patch.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  template <int dim>
  class FacetSearch;
  template <int dim>
  class FacetsAround;

  /**
   * Each point of the slave, a node or a quadrature point, is in contact with the one
   * triangle of the master that it faces: the closest one.
   *
   * The triangle depends on the positions alone, without history. A point may pass from
   * one to another during a step (see PointPassingTriangles), so that the gap at the
   * end of a step is that at the beginning of the next one. Where both differ
   * nevertheless, at vertices of some kinds, the point keeps the triangle where it
   * began until the end of the step.
   *
   * That is for a surface against itself. Between two surfaces edges are rounded, see
   * RoundedGap, so that the gap is a differentiable function of the positions: a point near
   * edges is in contact with a patch of triangles.
   *
   * For a surface against itself, each point can touch other triangles of that
   * surface, see OwnFacets. A point never passes to one of those around it.
   */
  class PointsBeforeTriangles : public SurfacePair<3>
  {
  public:
    enum class PointsIn
    {
      nodes,
      quadrature_points,
      /// See SurfacePair::make_corner_points().
      corners
    };

    /// @throws InputError see SurfacePair.
    /// @param has_coverage points reach over open edges as far as their coverage does, and
    /// not only up to half of their own facet.
    PointsBeforeTriangles(const Body<3>     &body,
                          const ContactPair &pair,
                          const PointsIn     points_in,
                          const bool         has_coverage);

    void
    begin_step(const ContactStart &start) override;

    void
    evaluate(const Vector &solution) override;

    bool
    points_share_nothing() const override
    {
      return true;
    }

    const Rows &
    rows(const unsigned int p) const override;

    const Derivatives &
    derivatives(const unsigned int  p,
                const Coefficients &coefficients,
                const Caution       caution) const override;

    void
    stay_at_vertex(const unsigned int p, const double tolerance) override;

    int
    passage(const unsigned int p) const override;

    double
    overhang(const unsigned int p) const override;

    double
    softness(const unsigned int p) const override
    {
      return steps[p].is_double ? softness_of_doubles : 0.;
    }

    std::vector<Index>
    unknowns_nearby(const unsigned int p) const override;

    double
    round_off(const unsigned int p) const override;

  private:
    using Passing = PointPassingTriangles<double>;
    template <typename Number>
    using Corners = std::array<std::array<Number, 3>, 4>;

    /// An entry of a row: coordinates of the point and the triangles' corners
    /// that move with the unknown, and their factors.
    struct Share
    {
      unsigned int place, coordinate;
      double       factor;
    };

    struct Step
    {
      /// Edges are rounded for the point, if it has a patch, and it has one now; then #new_facet
      /// is #old_facet, and #patch and #rounded_gap are those for both ends of the step.
      bool               may_be_rounded = false, is_rounded = false;
      RoundedPatch       patch;
      RoundedGap<double> rounded_gap;
      /// Facets that the point faces at the beginning and the end of the step.
      unsigned int old_facet = 0, new_facet = 0;
      bool         may_pass = false;
      /// The point is a node on another one, whose constraint is the same or
      /// nearly so.
      bool is_double = false;
      /// Outward normal of the slave at the beginning of the step.
      Position           normal{};
      bool               up_to_date = false;
      Rows               rows;
      std::vector<Share> shares;
    };

    double
    reach_of_step(const Course &course) const override;

    /// The point @p p and the nodes of the master.
    RoundedPatches::Instant
    instant(const unsigned int p, const Positions &positions) const
    {
      return {position_of(own_points[p], positions.slave), positions.master};
    }

    /// Find Step::patch and Step::rounded_gap from the beginning of the step to @p end for a point
    /// that faces facet @p f. @return whether it has them.
    bool
    find_rounded_gap(const unsigned int           p,
                     const unsigned int           f,
                     const Positions             &end,
                     const RoundedPatches::NearAt near_at);

    /// Whether the point is in contact with more than one facet, or beyond an open edge.
    static bool
    is_at_edge(const Step &step)
    {
      return step.is_rounded &&
        (step.patch.facets.size() > 1 || !step.patch.open_edges.empty());
    }

    /// The gap at the end of the step, if edges are still rounded for the point.
    bool
    evaluate_rounded(const unsigned int p);

    /// Rows on the coordinates of the point and of the nodes of its patch, one point after
    /// the other.
    void
    rounded_rows(const unsigned int   p,
                 std::vector<double> &normal,
                 std::vector<double> &coverage) const;

    /// The derivatives of a point with rounded edges.
    void
    differentiate_rounded(const unsigned int  p,
                          const Coefficients &coefficients,
                          const Caution       caution,
                          Derivatives        &result) const;

    void
    make_quadrature_points(const Body<3> &body);

    /// Positions of the point @p p and of the corners of facet @p f.
    Corners<double>
    corners(const unsigned int p,
            const unsigned int f,
            const Positions   &positions) const;

    /// Positions of the point @p p and of the corners of two facets.
    Passing::Points<double>
    corners(const unsigned int p,
            const unsigned int old_facet,
            const unsigned int new_facet,
            const Positions   &positions) const;

    /// The edge that two facets share.
    std::optional<SharedEdge>
    shared_edge(const unsigned int old_facet,
                const unsigned int new_facet) const;

    /// The facets around facet @p f that the point @p p may face. The next call
    /// overwrites them.
    const std::vector<unsigned int> &
    allowed_around(const unsigned int p, const unsigned int f) const;

    /// The facet closest to point @p p, found by walking over the surface from facet @p
    /// f.
    /// @param y position of the point, for the positions in @p facets.
    unsigned int
    walk(const unsigned int p,
         const unsigned int f,
         const Position    &normal,
         const Position    &y,
         FacetsAround<3>   &facets) const;

    /// The facet that the point faces at the end of the step, with positions @p now.
    /// @param facets at these positions.
    unsigned int
    last_facet(const unsigned int p,
               const Positions   &now,
               FacetsAround<3>   &facets) const;

    /// Whether the point @p p, the first of @p x, is too far beyond an open edge of the
    /// surface, or beside the facet @p f by more than @p tolerance times its longest edge.
    bool
    is_off(const unsigned int     p,
           const Corners<double> &x,
           const unsigned int     f,
           const double           tolerance = .5) const;

    /// The facet that the point faces, among those of @p search, if there is one
    /// not farther off than @p largest_distance (m).
    /// @param likely the probable result, which makes the search faster.
    std::optional<unsigned int>
    find_facet(const unsigned int                p,
               const FacetSearch<3>             &search,
               const Positions                  &positions,
               const double                      largest_distance,
               const std::optional<unsigned int> likely) const;

    /// As above, for a surface against itself.
    std::optional<unsigned int>
    find_own_facet(const unsigned int                p,
                   const FacetSearch<3>             &search,
                   const Positions                  &positions,
                   const double                      largest_distance,
                   const std::optional<unsigned int> likely) const;

    /// The facet that the point faced last, if known.
    std::optional<unsigned int>
    likely_facet(const unsigned int p) const;

    /// Whether @p p is the one to leave out of two nodes of one surface that meet
    /// each other exactly: two constraints would be the same.
    bool
    meets_node(const unsigned int p) const;

    /// Find the facets that points face at #old_positions, up to the distance
    /// #smallest_reach: points from farther off are found at extrapolated positions.
    /// They are kept if the last step or report has found them at these positions.
    void
    find_facets_now();

    /// For a point that is not pressed, a facet that it is in front of and will
    /// face @p later, if there is one.
    /// @param facets at the positions of now.
    void
    find_facet_later(const unsigned int    p,
                     const FacetSearch<3> &search,
                     const Positions      &later,
                     FacetsAround<3>      &facets);

    /// Let the point @p p begin with the gap and the coverage of Step::rounded_gap.
    void
    begin_rounded(const unsigned int p);

    /// Let the point @p p begin at facet @p f, with sharp edges.
    void
    begin_before(const unsigned int p,
                 const unsigned int f,
                 const double       gap,
                 const bool         may_pass);

    /// Sum the derivatives of rows on @p n_points points over the Step::shares.
    template <unsigned int n_points, typename Evaluate>
    void
    differentiate(const unsigned int  p,
                  const Coefficients &coefficients,
                  const Evaluate     &evaluate,
                  Derivatives        &result) const;

    /// Call @p action(begin, end) for ranges of points, on several threads.
    template <typename Action>
    void
    for_each_range(const Action &action) const
    {
      Threads::for_each_range(own_points.size(), 64, action);
    }

    void
    update(const unsigned int p) const;

    const bool           has_coverage;
    const RoundedPatches rounded_patches;
    /// Search distances of facets: a tenth of the surface, but no less than two
    /// facets and the approach in a step; on the point's own surface only the latter
    /// (m).
    double reach = 0., smallest_reach = 0.;
    /// The facets around each one: those that share a node with it, and itself.
    std::vector<std::vector<unsigned int>> around;
    /// For self-contact: the facets that points can touch, and the facets around
    /// each one, which its points cannot touch.
    std::unique_ptr<OwnFacets>             own_facets;
    std::vector<std::vector<unsigned int>> own_around;
    Positions                              old_positions, new_positions;
    /// The facet of each point, and the positions for which they were found.
    std::vector<std::optional<unsigned int>> facets_now;
    Positions                                found_at;
    mutable std::vector<Step>                steps;
  };
} // namespace Ricochet

#endif
