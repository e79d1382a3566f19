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
   * another one (master), both of which move: in each point gap, its increment and
   * slip over a step, and the directions of the forces, as rows on the unknowns of
   * both. This class knows the surfaces, where they are, and which facet is before
   * which point; how points are coupled to facets is for derived classes.
   *
   * For whatever they take as rows D and T: D . change is the increment of the gap
   * and T . change the slip, so that the work of a pressure p and a traction t is p
   * times the one and t times the other; the sum of forces and that of moments are
   * zero.
   *
   * Each rank takes care of the points of its own nodes. It knows where the facets of its
   * own cells are, and where those patches of the master are that come near its points:
   * only their positions travel.
   */
  template <int dim>
  class SurfacePair
  {
  public:
    using Index    = dealii::types::global_dof_index;
    using Position = std::array<double, dim>;

    /// Number of directions along a surface; one, which nothing moves along, on the
    /// line.
    static constexpr unsigned int n_tangents = dim == 3 ? 2 : 1;
    /// Slip (m) or traction (Pa).
    using Tangential = dealii::Tensor<1, n_tangents>;

    /// A point of the slave surface that this rank takes care of.
    struct Point
    {
      /// Numbers of nodes of the slave surface, and the weights with which the
      /// point is in their middle.
      std::vector<std::pair<unsigned int, double>> nodes;
      /// Facets of the slave surface whose outward normals it has.
      std::vector<unsigned int> facets;
      /// m^(dim-1)
      double weight = 0.;
      /// h_T (m)
      double                     cell_diameter = 0.;
      dealii::types::boundary_id boundary_id   = 0;
      /// Multipliers of the node; invalid ones in quadrature points.
      std::array<Index, dim> multipliers;
    };

    /// Rows of a point over a step, at the state of the last evaluate().
    struct Rows
    {
      /// The unknowns on which they are: first those of the node that the point is,
      /// or of the first of its nodes.
      std::vector<Index> unknowns;
      /// D and T, 1.
      std::vector<double>                         normal;
      std::array<std::vector<double>, n_tangents> tangential;
      /// D . change (m)
      double gap_increment = 0.;
      /// T . change (m)
      Tangential slip;
      /// Outward unit normal of the master.
      Position direction{};
    };

    /// Derivatives with respect to the unknowns of the rows at the end of the step.
    struct Derivatives
    {
      /// Of gap and slip, 1.
      std::vector<double>                         gap;
      std::array<std::vector<double>, n_tangents> slip;
      /// Of traction T - pressure D (Pa/m), row by row.
      std::vector<double> forces;
    };

    /// @throws InputError see ContactSurface; and when the surfaces do not face
    /// each other anywhere.
    SurfacePair(const Body<dim> &body, const ContactPair &pair);

    virtual ~SurfacePair() = default;

    /// Begin a step: find out what is before which facets. With a step of no
    /// length it is an instant.
    virtual void
    begin_step(const ContactStart &start) = 0;

    /// The end of the step.
    virtual void
    evaluate(const Vector &solution) = 0;

    /// Whether it is one surface, against itself.
    bool
    touches_itself() const
    {
      return is_self;
    }

    /// Nobody will ask for slip, for rows of it or for its derivatives, as there is no
    /// friction: they need not be computed, and may be zero.
    void
    leave_out_slip()
    {
      needs_slip = false;
    }

    /// The displacements of all nodes of both surfaces, and the multipliers of this
    /// rank's points: all that contact acts on. With each a distance (m) that tells
    /// in which order contact is expected to spread: how much farther it is from the
    /// middle of the other surface than the nearest of its own surface. Not sorted;
    /// none comes twice.
    std::vector<std::pair<Index, double>>
    unknowns() const;


    const std::vector<Point> &
    points() const
    {
      return own_points;
    }

    /// The points that cross a facet of the master from its front to its back on the
    /// straight paths from @p begin to @p end (m): by themselves that is no contact lost.
    /// None where nothing moves as far as the bodies are thick. Collective.
    std::vector<unsigned int>
    crossing_points(const Vector &begin, const Vector &end);

    /// Where the point @p p is in the undeformed body (m); zeros beyond dim.
    dealii::Point<3>
    reference_place(const unsigned int p) const;

    /// The part of the body that the point @p p is on.
    unsigned int
    part_of(const unsigned int p) const
    {
      return slave.facets[own_points[p].facets.front()].part;
    }

    /// Whether this rank knows where facet @p f of the master is: its own, and those of
    /// patches that have come near its points.
    bool
    is_known(const unsigned int f) const
    {
      return known[patches.patch_of(f)];
    }

    const ContactSurface<dim> &
    master_surface() const
    {
      return master;
    }

    /// Whether the point @p p is before a facet, no deeper behind it than its
    /// length, during the step. What follows may only be asked for if it is.
    bool
    is_before_facet(const unsigned int p) const
    {
      return gaps[p].is_before_facet;
    }

    /// m
    double
    old_gap(const unsigned int p) const
    {
      return gaps[p].old_gap;
    }

    /// m
    double
    new_gap(const unsigned int p) const
    {
      return gaps[p].new_gap;
    }

    /// The gap in the middle of the step, if the mean velocity of the step before
    /// goes on (m).
    double
    predicted_gap(const unsigned int p) const
    {
      return gaps[p].predicted_gap;
    }

    /// The multipliers of a node at the last begin_step() or evaluate() (Pa).
    const Position &
    multipliers(const unsigned int p) const
    {
      return gaps[p].multipliers;
    }

    /// Whether point @p p is the same node as another point, before the other facet
    /// of a valley. Its weight is that of the node, which must not count twice.
    virtual bool
    is_other_side(const unsigned int /*p*/) const
    {
      return false;
    }

    /// The point that is the same node as @p p, before the other facet of a valley.
    virtual std::optional<unsigned int>
    other_side(const unsigned int /*p*/) const
    {
      return {};
    }

    /// How soft the constraint of the point has to be, as a part of h / r_0 (see
    /// PairContact): not at all, but where other constraints may say the same or
    /// nearly so. Then it is as much as tells how they share the force.
    virtual double
    softness(const unsigned int /*p*/) const
    {
      return 0.;
    }

    /// Whether rows() and derivatives() of different points may be asked for on several
    /// threads at once.
    virtual bool
    points_share_nothing() const
    {
      return false;
    }

    virtual const Rows &
    rows(const unsigned int p) const = 0;

    /**
     * In work space that the next call (on this thread) overwrites.
     *
     * @param caution keep points from going to and fro between facets,
     * see FacetChain.
     */
    virtual const Derivatives &
    derivatives(const unsigned int p,
                const double       pressure,
                const Tangential  &traction,
                const Caution      caution) const = 0;

    /// The unknowns of the rows and those that may join them in the course of a
    /// step, for sparsity patterns, sorted.
    virtual std::vector<Index>
    unknowns_nearby(const unsigned int p) const = 0;

    /// What tells, for a point, whether it has passed vertices and to where: 0 if it
    /// has not.
    virtual int
    passage(const unsigned int /*p*/) const
    {
      return 0;
    }

    /// Let the point and its other side, should there be one, be before the facets of
    /// a valley. Or let it end before the facet where it began: until the next begin_step()
    /// it passes no vertex. Only for a point so near to one that the gaps of both
    /// facets differ by less than @p tolerance times the facet's length; others are
    /// left alone.
    virtual void
    stay_at_vertex(const unsigned int /*p*/, const double /*tolerance*/)
    {}

    /// Round-off in gaps and increments of point @p p (m).
    virtual double
    round_off(const unsigned int p) const = 0;

  protected:
    /// Positions of the nodes of both surfaces (m); not numbers for those that this rank
    /// does not know.
    struct Positions
    {
      std::vector<Position> slave, master;

      /// To the last digit, and the same ones are known.
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

    /// Where nodes are at the beginning of a step, and where the mean velocity of the
    /// step before takes them in half of it and in all of it. In an instant all are the
    /// same.
    struct Course
    {
      Positions begin, middle, end;
      /// See reach_of_step() (m).
      double reach = 0.;
    };

    /// How often a point may go on to one of the facets around the one it is before.
    static constexpr unsigned int farthest_walk = 4;

    /// softness() of a point that is a node on another one.
    static constexpr double softness_of_doubles = 1e-9;

    /// What is known of a point over a step.
    struct Gaps
    {
      bool     is_before_facet = false;
      double   old_gap = 0., new_gap = 0., predicted_gap = 0.;
      Position multipliers{};
    };

    /// One point for each node of the slave that this rank owns.
    void
    make_nodal_points(const Body<dim> &body);

    bool
    is_mine(const Body<dim> &body, const unsigned int slave_node) const
    {
      return body.owned_indices().is_element(
        slave.nodes[slave_node].unknowns[0]);
    }

    /// Begin a step: read the multipliers of all points, find out which facets are near
    /// and where they are. Collective.
    void
    begin_course(const ContactStart &start, Course &course);

    /// How far from the points of this rank the facets of the master may be that they
    /// look at in a step (m). In the plane that is all of the surface, a curve.
    /// Collective.
    virtual double
    reach_of_step(const Course & /*course*/) const
    {
      return std::numeric_limits<double>::infinity();
    }

    /// The positions at @p solution, a vector of displacements, and the multipliers.
    /// Collective.
    void
    read(const Vector &solution, Positions &positions);

    /// By how much a node of the slave and one of the master can have come nearer to
    /// each other: the longest ways of both (m). Collective.
    double
    longest_way(const Positions &from, const Positions &to) const;

    /// Whether a point that is before a facet at the distance @p gap may get before another
    /// one in a step in which surfaces come nearer by not more than @p way (m).
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

    /// Whether the gap of @p point is not constant: that of held nodes in front of a
    /// surface that is held as a whole is, and no pressure could change it.
    bool
    may_touch(const Point &point) const;

    const bool is_self;
    /// See leave_out_slip().
    bool                needs_slip = true;
    ContactSurface<dim> slave, master;
    std::vector<Point>  own_points;
    std::vector<Gaps>   gaps;
    const MPI_Comm      communicator;
    /// Facets of the master that are near the points of this rank in this step, in
    /// ascending order. Others need not be known.
    std::vector<unsigned int> near_facets;

  private:
    /// Let this rank know where the facets of the master's patches #known are, and its
    /// own. Collective.
    void
    make_exchange();

    /// Find the #near_facets. @return whether ranks have to know more patches than they
    /// did before. Collective.
    bool
    find_near(Course &course);

    /// Positions of what #ghosted says.
    void
    get_positions(Positions       &positions,
                  const Positions *start = nullptr,
                  const double     time  = 1.) const;

    /// Whether the point @p p crosses the facet @p f, of which it is no part.
    bool
    crosses(const unsigned int p,
            const unsigned int f,
            const Positions   &begin,
            const Positions   &end) const;

    const dealii::IndexSet owned;
    FacetPatches<dim>      patches;
    /// Whether a node of the master is not held.
    bool master_moves = false;
    /// No facet of the master is smaller, and no cell behind one is thinner (m).
    double smallest_thickness = 0.;
    /// Facets of the slave with a node or cell of this rank, in groups.
    std::vector<std::vector<unsigned int>> own_groups;
    /// For each patch those that points may walk to from it.
    std::vector<std::vector<unsigned int>> patches_around;
    /// For each patch of the master, whether this rank knows where it is.
    std::vector<bool>                 known;
    GhostedVector                     ghosted;
    std::vector<std::array<int, dim>> slave_index, master_index;
    /// Of each own point, once it is asked for.
    std::vector<std::array<int, dim>> multiplier_index;
  };
} // namespace Ricochet

#endif
