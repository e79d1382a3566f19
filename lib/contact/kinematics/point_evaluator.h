// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_kinematics_point_evaluator_h
#define ricochet_contact_kinematics_point_evaluator_h

#include <base/ghosted_vector.h>
#include <base/types.h>
#include <contact/laws/contact_law.h>
#include <contact/kinematics/contact_points.h>

#include <array>
#include <utility>
#include <vector>

namespace Ricochet
{
  /**
   * The one place where global unknowns meet the contact points of this rank: what
   * a vector of unknowns is worth in the points, and what a force in a point is
   * worth in the unknowns.
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

    /// Evaluate all points at @p solution into @p states, with the gaps of planes
    /// at rest.
    void
    evaluate(const Vector &solution, std::vector<ContactPointState<>> &states);

    /// The displacement of all points at @p solution (m).
    void
    evaluate_displacement(const Vector                      &solution,
                          std::vector<dealii::Tensor<1, 3>> &displacements);

    /// Let the force of point @p p act along @p direction, and its gap have the
    /// gradient @p gap_gradient: where neither is the same for ever.
    void
    set_rows(const unsigned int          p,
             const dealii::Tensor<1, 3> &direction,
             const dealii::Tensor<1, 3> &gap_gradient);

    /// Add @p force of point @p p, weighted, to @p vector (to be compressed by
    /// the caller).
    void
    add(const unsigned int p, const ContactPointForce<> &force, Vector &vector);

    /// The same for a @p traction on the displacement.
    void
    add(const unsigned int          p,
        const dealii::Tensor<1, 3> &traction,
        Vector                     &vector);

    /// Add @p tangent of point @p p, times @p factor, to @p matrix.
    void
    add(const unsigned int         p,
        const double               factor,
        const ContactPointTangent &tangent,
        Matrix                    &matrix) const;

    /// The same for a traction with the derivatives @p with_displacement, and
    /// @p with_state with respect to gap, stress pressure and multiplier.
    void
    add(const unsigned int                         p,
        const double                               factor,
        const dealii::Tensor<2, 3>                &with_displacement,
        const std::array<dealii::Tensor<1, 3>, 3> &with_state,
        Matrix                                    &matrix) const;

    /// Averages around each node of @p values in the points, in the place of the
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

    /// Derivatives of the gap with respect to the unknowns.
    const std::vector<double> &
    gap_derivatives() const
    {
      return gap_gradient.empty() ? points.gap_coefficient : gap_gradient;
    }

    ContactPoints points;
    // Of the gap; empty where that is the direction of the force.
    std::vector<double> gap_gradient;
    GhostedVector       ghosted;
    /// Unknowns of this rank.
    const dealii::IndexSet owned;
    std::vector<int>       local_index;
    bool                   some_points = false;
    // Whether any point has coefficients of these.
    bool has_stress_pressure = false, has_multipliers = false;
    // Place of each unknown among those of this rank; -1: another rank's.
    std::vector<int> owned_index;
    // Work space of add().
    mutable std::vector<double> local_matrix;

  public:
    const MPI_Comm communicator;
  };
} // namespace Ricochet

#endif
