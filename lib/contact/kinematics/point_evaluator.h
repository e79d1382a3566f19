// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_point_evaluator_h
#define ricochet_contact_kinematics_point_evaluator_h

#include <base/ghosted_vector.h>
#include <base/types.h>
#include <contact/kinematics/contact_points.h>
#include <contact/kinematics/point_vector.h>

#include <vector>

namespace Ricochet
{
  /**
   * The map between global unknowns and the contact points of this rank:
   * observables of the points from a vector of unknowns, and forces on the
   * unknowns from forces in the points.
   */
  class ContactPointEvaluator
  {
  public:
    template <int dim>
    ContactPointEvaluator(const Body<dim> &body, ContactPoints points)
      : points(std::move(points))
      , ghosted(body.make_ghosted_vector(this->points.index))
      , owned(body.owned_indices())
      , communicator(body.communicator)
    {
      find_local_indices();
      some_points = dealii::Utilities::MPI::sum(this->points.points.size(),
                                                body.communicator) > 0;
    }

    /// Evaluate the @p observables of all points at @p solution.
    void
    evaluate(const Vector &solution, std::vector<PointVector> &observables);

    /// Add @p force of point @p p, weighted, to @p vector (to be compressed by
    /// the caller).
    void
    add(const unsigned int p, const PointVector &force, Vector &vector);

    /// Add @p tangent of point @p p, weighted and times @p factor, to @p matrix (to be
    /// compressed by the caller).
    void
    add(const unsigned int p,
        const double       factor,
        const PointMatrix &tangent,
        Matrix            &matrix) const;

    /// Averages around each node of @p values in the points, at the index of the
    /// node's first displacement: weighted by the square of the node's shape
    /// function, which is never negative.
    Vector
    nodal_averages(const std::vector<double> &values) const;

    /// The displacement or force of @p vector at @p p, which must be a node of
    /// this rank.
    dealii::Tensor<1, 3>
    at_node(const unsigned int p, const Vector &vector) const;

    const std::vector<ContactPoint> &
    contact_points() const
    {
      return points.points;
    }

    /// The unknowns of all points on all ranks, by initial gap.
    std::vector<dealii::types::global_dof_index>
    unknowns() const;

    /// Whether there are points on any rank.
    bool
    has_points() const
    {
      return some_points;
    }

    const ContactPoints &
    coefficients() const
    {
      return points;
    }

  private:
    void
    find_local_indices();

    /// Add @p value(k) to the unknown of each coefficient k of @p point.
    template <typename Value>
    void
    add_to_unknowns(const ContactPoint &point,
                    const Value        &value,
                    Vector             &vector) const;

    ContactPoints points;
    GhostedVector ghosted;
    /// Unknowns of this rank.
    const dealii::IndexSet owned;
    std::vector<int>       local_index;
    bool                   some_points = false;
    // Whether any point has coefficients of these.
    bool has_stress_pressure = false, has_multipliers = false;
    // Index of each unknown among those of this rank; -1 for other ranks.
    std::vector<int> owned_index;
    // Work space of add().
    mutable std::vector<double> local_matrix;

  public:
    const MPI_Comm communicator;
  };
} // namespace Ricochet

#endif
