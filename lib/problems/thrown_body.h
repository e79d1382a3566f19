// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_problems_thrown_body_h
#define ricochet_problems_thrown_body_h

#include <materials/material_parameters.h>
#include <output/momenta.h>
#include <problems/impact.h>
#include <problems/round_meshes.h>

namespace Ricochet
{
  /**
   * Common parts of the benchmarks of papers A and B: a free body in 2D that is
   * thrown at a rigid foundation, the half plane below the axis x_2 = 0.
   */
  struct ThrownBodyParameters
  {
    ImpactParameters   impact;
    MaterialParameters material;

    /// "triangles" or "quadrilaterals".
    std::string cell_shape = "triangles";
    /// Polynomial degree of the displacement.
    unsigned int degree = 1;
    /// Distance of the lowest point from the foundation at the start (m).
    double initial_gap = 0.;
    /// m/s
    dealii::Tensor<1, 2> initial_velocity;

    void
    add_parameters(dealii::ParameterHandler &parameters);

    /// @throws InputError
    void
    validate() const;

    /// The parameters that have no effect with the others as they are.
    std::vector<UnusedParameter>
    unused_parameters() const;

    CellShape
    shape() const
    {
      return cell_shape == "triangles" ? CellShape::triangles
                                       : CellShape::quadrilaterals;
    }
  };

  /**
   * Add to the ledger of @p loop linear momentum, angular momentum about the
   * origin and the displacement of the mass centre. @p momenta must live as long
   * as the loop.
   */
  void
  add_momentum_columns(const Momenta<2> &momenta,
                       const Body<2>    &body,
                       TimeLoop         &loop);

  /**
   * Throw the undeformed body of @p triangulation at the foundation, from the set-up
   * to the last step.
   *
   * @param outer_boundary the boundary id that can touch the foundation.
   * @param self_contact the boundaries that together are the surface that may
   * touch itself, with their names; none for a body that passes through itself.
   */
  void
  throw_body(
    const ThrownBodyParameters                              &parameters,
    const dealii::Triangulation<2>                          &triangulation,
    const dealii::types::boundary_id                         outer_boundary,
    RunFolder                                               &folder,
    const std::map<dealii::types::boundary_id, std::string> &self_contact = {});
} // namespace Ricochet

#endif
