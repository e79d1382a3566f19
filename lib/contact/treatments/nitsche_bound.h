// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_contact_treatments_nitsche_bound_h
#define ricochet_contact_treatments_nitsche_bound_h

#include <contact/kinematics/contact_points.h>

namespace Ricochet
{
  /**
   * The constant C (Pa) of the discrete trace inequality
   *
   *     h_T (p, p)_F  <=  C (sigma(v), epsilon(v))_T
   *
   * for all displacements v of a cell T with contact faces F, p being the normal
   * pressure of its stress: the largest eigenvalue of that pair of forms over all
   * cells. Nitsche's method is stable when gamma_0 > (1 + theta)^2/4 C (Chouly,
   * Hild and Renard, Math. Comp. 84, 2015); on a bar C is the square of the degree
   * times the modulus. The bound is sufficient for stability; a slightly smaller
   * value may suffice, because cells do not deform alone.
   *
   * Collective. The constant is zero without contact boundary.
   */
  template <int dim>
  double
  nitsche_trace_constant(const Body<dim>                             &body,
                         const std::common_type_t<LinearStress<dim>> &stress,
                         const Obstacles &obstacles);

  /// As above, for each part of a body of several, with the stress of that part
  /// (by material id), on faces with the @p boundary_ids and along their normals.
  template <int dim>
  std::vector<double>
  nitsche_trace_constants(
    const Body<dim>                            &body,
    const std::vector<LinearStress<dim>>       &stresses,
    const std::set<dealii::types::boundary_id> &boundary_ids);
} // namespace Ricochet

#endif
