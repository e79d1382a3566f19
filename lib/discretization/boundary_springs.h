// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_boundary_springs_h
#define ricochet_discretization_boundary_springs_h

#include <discretization/body.h>
#include <discretization/bulk_operator.h>
#include <solvers/body_matrix.h>

#include <memory>
#include <vector>

namespace Ricochet
{
  /// Springs and dashpots between a part of the boundary and its undeformed
  /// position: a traction -k u - c u_t in some directions.
  template <int dim>
  struct BoundarySprings
  {
    dealii::types::boundary_id boundary_id;
    std::array<bool, dim>      components;
    /// k (Pa/m)
    double stiffness = 0.;
    /// c (Pa s/m)
    double damping = 0.;
  };

  /**
   * Springs and dashpots on the boundary of a body, and damping in proportion to its mass, which
   * is dashpots between all of its points and where they were. Both are linear, so that the
   * balance of a step is exact: with the matrices K and C of springs and dashpots, u_m the mean
   * and d the difference of both ends,
   *
   *     K u_m . d = 1/2 u_1 . K u_1 - 1/2 u_0 . K u_0,     C d/dt . d >= 0.
   */
  template <int dim>
  class SpringsAndDashpots : public BulkOperator
  {
  public:
    /// @param damping of each part of the @p body (see Body::part()) in proportion to its
    /// mass: Viscosity::mass_damping times the density (kg/(m^dim s)).
    SpringsAndDashpots(const Body<dim>                         &body,
                       const std::vector<BoundarySprings<dim>> &springs,
                       const std::vector<double>               &damping);

    void
    force(const Vector &solution, Vector &force) const override;

    void
    step_force(const Vector &old_solution,
               const Vector &new_solution,
               const double  time_step,
               Vector       &force) const override;

    MatrixSum
    tangent_terms(const double factor) const override;

    MatrixSum
    step_tangent_terms(const double time_step) const override;

    double
    energy(const Vector &solution) const override;

    std::vector<double>
    energies_of_parts(const Vector &solution) const override;

    bool
    is_viscous() const override
    {
      return has_damping;
    }

    void
    viscous_force(const Vector &rate_origin,
                  const Vector &solution,
                  const double  rate_time,
                  Vector       &result) const override;

    MatrixSum
    viscous_tangent_terms(const double factor,
                          const double rate_time) const override;

    double
    viscous_dissipation(const Vector &old_solution,
                        const Vector &new_solution,
                        const double  time_step) const override;

    double
    stiffness_scale() const override
    {
      return scale;
    }

    bool
    is_linear() const override
    {
      return true;
    }

  private:
    /// #product = damping times the difference @p end - @p begin, which is left in #work.
    void
    apply_damping(const Vector &begin, const Vector &end) const;

    const std::vector<unsigned int> part_of_unknown;
    const unsigned int              n_parts;
    const MPI_Comm                  communicator;
    BodyMatrix                      stiffness, damping;
    bool                            has_damping;
    double                          scale = 0.;
    mutable Vector                  work, product;
  };
} // namespace Ricochet

#endif
