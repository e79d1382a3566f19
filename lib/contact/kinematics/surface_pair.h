// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_surface_pair_h
#define ricochet_contact_kinematics_surface_pair_h

#include <base/ghosted_vector.h>
#include <contact/kinematics/contact_kinematics.h>
#include <contact/surfaces/contact_pair.h>
#include <contact/surfaces/caution.h>
#include <contact/surfaces/contact_surface.h>
#include <contact/surfaces/facet_patches.h>

#include <cstring>
#include <limits>

namespace Ricochet
{
  /**
   * The geometry of contact of the points of one surface (slave) with the facets of
   * another one (master), both of which move. In each point these are gap, its
   * increment and slip over a step, and the directions of the forces, as rows on
   * the unknowns of both. This class has the surfaces, their positions, and the
   * facet that each point faces; derived classes couple points to facets.
   *
   * For any rows D and T of these classes, D . change is the increment of the gap
   * and T . change the slip, so that the work of a pressure p and a traction t is p
   * times the one and t times the other; the sum of forces and that of moments are
   * zero.
   *
   * A point stands for a part of the slave, which may lie over an open end or edge of the
   * master. For laws the coverage W is the part of it that has the master in front of it: 1 in
   * front of the surface, and falling smoothly to 0 at Point::largest_overhang beyond
   * its end. The potential of a law phi(g) is W phi(g): without this factor, energy
   * would be made where a point comes to face the surface, or does not any more, at a gap
   * below zero. With the row C of the coverage the exact change of the potential is mean(W)
   * (change of phi) + mean(phi) C . change; the second term is a force along the surface.
   *
   * Each rank owns the points of its own nodes. It has the positions of the facets of
   * its own cells, and of those patches of the master that come near its points; only
   * these are exchanged.
   */
  template <int dim>
  class SurfacePair
  {
  public:
    /// softness() of a point that is a node on another one.
    static constexpr double softness_of_doubles = 1e-9;
    /// That of the tractions of a node that sticks and is held by another contact, too.
    static constexpr double softness_of_stuck = 1e-7;

    using Index    = dealii::types::global_dof_index;
    using Position = std::array<double, dim>;

    /// Number of directions along a surface; one, without motion, in 1D.
    static constexpr unsigned int n_tangents = dim == 3 ? 2 : 1;
    /// Slip (m) or traction (Pa).
    using Tangential = dealii::Tensor<1, n_tangents>;

    /// A point of the slave surface that this rank owns.
    struct Point
    {
      /// Numbers of nodes of the slave surface, and their weights in the
      /// position of the point.
      std::vector<std::pair<unsigned int, double>> nodes;
      /// Facets of the slave surface whose outward normals the point has.
      std::vector<unsigned int> facets;
      /// m^(dim-1)
      double weight = 0.;
      /// h_T (m)
      double cell_diameter = 0.;
      /// Half of a facet of the slave: beyond an open end or edge by this, nothing of what
      /// the point stands for has the master in front of it (m).
      double                     largest_overhang = 0.;
      dealii::types::boundary_id boundary_id      = 0;
      /// Multipliers of the node; invalid ones in quadrature points.
      std::array<Index, dim> multipliers;
      /// Other contacts may hold the node, too.
      bool is_shared = false;
    };

    /// Rows of a point over a step, at the state of the last evaluate().
    struct Rows
    {
      /// The unknowns of the rows: first those of the node that the point is, or of
      /// the first of its nodes.
      std::vector<Index> unknowns;
      /// D and T, 1.
      std::vector<double>                         normal;
      std::array<std::vector<double>, n_tangents> tangential;
      /// D . change (m)
      double gap_increment = 0.;
      /// T . change (m)
      Tangential slip;
      /// C (1/m); empty where the coverage is 1 throughout the step.
      std::vector<double> coverage;
      /// Outward unit normal of the master.
      Position direction{};
    };

    /// Derivatives with respect to the unknowns of the rows at the end of the step.
    struct Derivatives
    {
      /// Derivatives of gap and slip, 1.
      std::vector<double>                         gap;
      std::array<std::vector<double>, n_tangents> slip;
      /// Derivatives of the coverage (1/m); empty where Rows::coverage is.
      std::vector<double> coverage;
      /// Derivatives of traction T - pressure D + energy C (Pa/m), row by row.
      std::vector<double> forces;
    };

    /// Coefficients of the rows in the force of a point: traction T - pressure D + energy C.
    struct Coefficients
    {
      /// Pa
      double     pressure = 0.;
      Tangential traction;
      /// J/m^(dim-1)
      double energy = 0.;
    };

    /// @throws InputError see ContactSurface; or when the surfaces do not face
    /// each other anywhere.
    SurfacePair(const Body<dim> &body, const ContactPair &pair);

    virtual ~SurfacePair() = default;

    /// Begin a step: find the facet that each point faces. A step of no length
    /// is an instant.
    virtual void
    begin_step(const ContactStart &start) = 0;

    /// Evaluate rows and gaps for the end of the step.
    virtual void
    evaluate(const Vector &solution) = 0;

    /// From now on begin_step() keeps the facets that points face, wherever they
    /// go, or, with false, finds those that they face.
    void
    keep_facets(const bool keep)
    {
      keeps_facets = keep;
    }

    /// Make increment() known until the next begin_step() or evaluate(). Collective.
    /// @param increments a vector of displacement increments (m).
    void
    set_increments(const Vector &increments)
    {
      ghosted.import(increments);
    }

    /// The increment (m) of an unknown of rows().
    double
    increment(const Index unknown) const
    {
      return ghosted.values()[ghosted.local_index(unknown)];
    }

    /// Whether the pair is one surface, against itself.
    bool
    touches_itself() const
    {
      return is_self;
    }

    /// Leave out slip, its rows and its derivatives, which are not needed without
    /// friction and may be zero then.
    void
    leave_out_slip()
    {
      needs_slip = false;
    }

    /// Let all points have this boundary id in reports.
    void
    report_as(const dealii::types::boundary_id id)
    {
      for (Point &point : own_points)
        point.boundary_id = id;
    }

    /// The displacements of all nodes of both surfaces, and the multipliers of this
    /// rank's points: all that contact acts on. The distance (m) with each one gives
    /// the order in which contact is expected to spread: how much farther it is from
    /// the middle of the other surface than the nearest of its own surface. Not
    /// sorted; each once.
    std::vector<std::pair<Index, double>>
    unknowns() const;


    const std::vector<Point> &
    points() const
    {
      return own_points;
    }

    /// The points that cross a facet of the master from its front to its back on the
    /// straight paths from @p begin to @p end (m), which need not be a loss of contact.
    /// None if no displacement increment exceeds the thickness of the bodies.
    /// Collective.
    std::vector<unsigned int>
    crossing_points(const Vector &begin, const Vector &end);

    /// Position of the point @p p in the undeformed body (m); zeros beyond dim.
    dealii::Point<3>
    reference_place(const unsigned int p) const;

    /// The part of the body with the point @p p.
    unsigned int
    part_of(const unsigned int p) const
    {
      return slave.facets[own_points[p].facets.front()].part;
    }

    /// Whether this rank has the position of facet @p f of the master: of its own ones,
    /// and of those of patches that have come near its points.
    bool
    is_known(const unsigned int f) const
    {
      return known[patches.patch_of(f)];
    }

    /// System index of the first displacement of the node that the point @p p is, or of the
    /// first of its nodes.
    Index
    first_unknown(const unsigned int p) const
    {
      return slave.nodes[own_points[p].nodes[0].first].unknowns[0];
    }

    const ContactSurface<dim> &
    master_surface() const
    {
      return master;
    }

    /// Whether the point @p p faces a facet during the step, no deeper behind
    /// it than the facet's length. Only then may the following be called.
    bool
    is_before_facet(const unsigned int p) const
    {
      return gaps[p].is_before_facet;
    }

    /// Count gaps with ContactPair::interference at @p time (s) until the next call.
    void
    set_interference(const double time)
    {
      if (interference)
        gap_offset = overlap - interference(time);
    }

    /// Position of point @p p, at an instant: after begin_step() with a step of no length (m).
    dealii::Tensor<1, 3>
    position(const unsigned int p) const
    {
      dealii::Tensor<1, 3> result;
      for (unsigned int c = 0; c < dim; ++c)
        result[c] = gaps[p].position[c];
      return result;
    }

    /// Gap at the beginning of the step, plus ContactPair::overlap, less its interference
    /// (m).
    double
    old_gap(const unsigned int p) const
    {
      return gaps[p].old_gap + gap_offset;
    }

    /// The same without the interference: negative behind a facet (m).
    double
    old_gap_without_interference(const unsigned int p) const
    {
      return gaps[p].old_gap + overlap;
    }

    /// Gap at the state of the last evaluate() (m).
    double
    new_gap(const unsigned int p) const
    {
      return gaps[p].new_gap + gap_offset;
    }

    /// The coverage, see above; 1 for classes without.
    double
    old_coverage(const unsigned int p) const
    {
      return gaps[p].old_coverage;
    }

    double
    new_coverage(const unsigned int p) const
    {
      return gaps[p].new_coverage;
    }

    /// The gap in the middle of the step, extrapolated with the mean velocity of
    /// the step before (m).
    double
    predicted_gap(const unsigned int p) const
    {
      return gaps[p].predicted_gap + gap_offset;
    }

    /// The multipliers of a node at the last begin_step() or evaluate() (Pa).
    const Position &
    multipliers(const unsigned int p) const
    {
      return gaps[p].multipliers;
    }

    /// Whether point @p p is the same node as another point, for the other facet of
    /// a concave corner. Its weight is that of the node, which must not count
    /// twice.
    virtual bool
    is_other_side(const unsigned int /*p*/) const
    {
      return false;
    }

    /// The point that is the same node as @p p, for the other facet of a concave
    /// corner.
    virtual std::optional<unsigned int>
    other_side(const unsigned int /*p*/) const
    {
      return {};
    }

    /// How far the point @p p is beside the facet that it faces, at the beginning of the step
    /// (m): that decides which of two contacts holds a node at a seam between their
    /// masters.
    virtual double
    overhang(const unsigned int /*p*/) const
    {
      return 0.;
    }

    /// Compliance of the constraint of the point, as a part of h / r_0 (see
    /// PairContact): zero, except where other constraints may be the same or
    /// nearly so. There it makes their contributions to the force unique.
    virtual double
    softness(const unsigned int /*p*/) const
    {
      return 0.;
    }

    /// Whether rows() and derivatives() of different points may be called on several
    /// threads at once.
    virtual bool
    points_share_nothing() const
    {
      return false;
    }

    virtual const Rows &
    rows(const unsigned int p) const = 0;

    /**
     * The result is in work space that the next call (on this thread)
     * overwrites.
     *
     * @param caution keep points from oscillating between facets, see
     * FacetChain.
     */
    virtual const Derivatives &
    derivatives(const unsigned int  p,
                const Coefficients &coefficients,
                const Caution       caution) const = 0;

    /// The unknowns of the rows and those that may join them during a step, for
    /// sparsity patterns, sorted.
    virtual std::vector<Index>
    unknowns_nearby(const unsigned int p) const = 0;

    /// A number that identifies, for a point, which vertices it has passed: 0 if
    /// none.
    virtual int
    passage(const unsigned int /*p*/) const
    {
      return 0;
    }

    /// Assign the point and its other side, if there is one, to the facets of a concave
    /// corner. Otherwise let it end at the facet where it began: until the next
    /// begin_step() it passes no vertex. Only for a point so near to a vertex that the
    /// gaps of both facets differ by less than @p tolerance times the facet's length;
    /// others are unaffected.
    virtual void
    stay_at_vertex(const unsigned int /*p*/, const double /*tolerance*/)
    {}

    /// Round-off in gaps and increments of point @p p (m).
    virtual double
    round_off(const unsigned int p) const = 0;

  protected:
    /// Positions of the nodes of both surfaces (m); NaN for those unknown on this rank.
    struct Positions
    {
      std::vector<Position> slave, master;

      /// Whether both are the same to the last digit, and known for the same
      /// nodes.
      bool
      is_same(const Positions &other) const
      {
        const auto are_same = [](const std::vector<Position> &a,
                                 const std::vector<Position> &b) {
          return a.size() == b.size() &&
            std::memcmp(a.data(), b.data(), a.size() * sizeof(Position)) == 0;
        };
        return are_same(slave, other.slave) && are_same(master, other.master);
      }
    };

    /// Positions of nodes at the beginning of a step, and extrapolated with the mean
    /// velocity of the step before to its middle and its end. In an instant all are the
    /// same.
    struct Course
    {
      Positions begin, middle, end;
      /// See reach_of_step() (m).
      double reach = 0.;
    };

    /// Largest number of facets over which a point may pass, each time to one of the
    /// facets around the last one.
    static constexpr unsigned int farthest_walk = 4;

    /// Data of a point over a step.
    struct Gaps
    {
      bool     is_before_facet = false;
      double   old_gap = 0., new_gap = 0., predicted_gap = 0.;
      double   old_coverage = 1., new_coverage = 1.;
      Position multipliers{};
      /// At an instant, outside of any step.
      Position position{};
    };

    /// Half of the longest edge of facet @p f of the slave; 0 in 1D (m).
    double
    half_length(const unsigned int f) const;

    /// The overhang beyond open ends and edges up to which facets are found for a point (m):
    /// with a coverage also from where it is 0, so that a point is followed on its path in from
    /// far off.
    static double
    found_overhang(const Point &point, const bool has_coverage)
    {
      return (has_coverage ? 4. : 1.) * point.largest_overhang;
    }

    /// One point for each node of the slave that this rank owns.
    void
    make_nodal_points(const Body<dim> &body, const bool has_coverage = false);

    /// Points without multipliers for nodes on features of the slave, and in 3D for three points
    /// between the nodes of each of its edges that are features, but not on planes of symmetry.
    void
    make_corner_points(const Body<dim> &body);

    bool
    is_mine(const Body<dim> &body, const unsigned int slave_node) const
    {
      return body.owned_indices().is_element(
        slave.nodes[slave_node].unknowns[0]);
    }

    /// Begin a step: read the multipliers of all points, find the facets that are near
    /// and their positions. Collective.
    void
    begin_course(const ContactStart &start, Course &course);

    /// Largest distance from the points of this rank for facets of the master in a
    /// step (m). In 2D it is unbounded, since the surface is a curve. Collective.
    virtual double
    reach_of_step(const Course & /*course*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// The positions at @p solution, a vector of displacements, and the multipliers.
    /// Collective.
    void
    read(const Vector &solution, Positions &positions);

    /// Bound for the approach of a node of the slave and one of the master: the sum
    /// of the longest displacement increments of both (m). Collective.
    double
    longest_way(const Positions &from, const Positions &to) const;

    /// Whether a point at the distance @p gap from a facet may come to face another one
    /// in a step in which surfaces approach each other by not more than @p way (m).
    static bool
    may_change_facet(const double gap, const double way)
    {
      return gap > 0. && gap < 2. * way;
    }

    /// Outward, of any length.
    Position
    normal_of(const Point &point, const std::vector<Position> &slave_x) const;

    Position
    position_of(const Point &point, const std::vector<Position> &slave_x) const;

    /// Whether the gap of @p point is not constant: that of fixed nodes against a
    /// surface that is fixed as a whole is, and no pressure could change it.
    bool
    may_touch(const Point &point) const;

    const bool is_self;
    /// ContactPair::overlap (m), and ContactPair::interference.
    const double                              overlap;
    const std::function<double(const double)> interference;
    /// Sum of both at the time of the last set_interference() (m).
    double gap_offset;
    /// See leave_out_slip().
    bool needs_slip = true;
    /// See keep_facets().
    bool                keeps_facets = false;
    ContactSurface<dim> slave, master;
    std::vector<Point>  own_points;
    std::vector<Gaps>   gaps;
    const MPI_Comm      communicator;
    /// Facets of the master that are near the points of this rank in this step, in
    /// ascending order. Others need not be known.
    std::vector<unsigned int> near_facets;

  private:
    /// Points of all nodes of the slave, of any rank; without nodes for means.
    std::vector<Point>
    points_of_nodes() const;

    /// Set up the exchange of the positions of the facets of the master's patches
    /// #known, and of this rank's own. Collective.
    void
    make_exchange();

    /// Find the #near_facets. @return whether ranks need more patches than before.
    /// Collective.
    bool
    find_near(Course &course);

    /// Positions of both surfaces from #ghosted.
    void
    get_positions(Positions       &positions,
                  const Positions *start = nullptr,
                  const double     time  = 1.) const;

    /// Whether the point @p p crosses the facet @p f, to which it does not
    /// belong.
    bool
    crosses(const unsigned int p,
            const unsigned int f,
            const Positions   &begin,
            const Positions   &end) const;

    const dealii::IndexSet owned;
    FacetPatches<dim>      patches;
    /// Whether a node of the master can move.
    bool master_moves = false;
    /// Lower bound of the facets of the master and of the thickness of the cells
    /// behind them (m).
    double smallest_thickness = 0.;
    /// Facets of the slave with a node or cell of this rank, in groups.
    std::vector<std::vector<unsigned int>> own_groups;
    /// For each patch, those to which points may pass from it.
    std::vector<std::vector<unsigned int>> patches_around;
    /// For each patch of the master, whether this rank has its positions.
    std::vector<bool>                 known;
    GhostedVector                     ghosted;
    std::vector<std::array<int, dim>> slave_index, master_index;
    /// Indices of the multipliers of each own point, found when first needed.
    std::vector<std::array<int, dim>> multiplier_index;
  };
} // namespace Ricochet

#endif
