// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_discretization_resultant_load_h
#define ricochet_discretization_resultant_load_h

#include <discretization/body.h>

#include <functional>
#include <set>

namespace Ricochet
{
  /// A force and a moment on a part of the boundary, each a function of the time (s); those
  /// that are empty are zero.
  template <int dim>
  struct ResultantLoad
  {
    std::set<dealii::types::boundary_id> ids;
    /// N, in 2D N per metre of thickness.
    std::function<dealii::Tensor<1, dim>(const double time)> force;
    /// About the middle of the surface (N m); in 2D the third component is the only one.
    std::function<dealii::Tensor<1, 3>(const double time)> moment;
  };

  /**
   * Functor that adds the forces (N) of @p load at a time (s) to a vector. On a surface of
   * area A with the middle c and J = integral of r.r 1 - r r^T, r = X - c, they are
   * those of the traction
   *
   *     F/A + (J^-1 M) x r,
   *
   * on the undeformed body, whose sum is F and whose moment about c is M there; it keeps its
   * direction. On a vertex (Body::Vertex) there is a force only. Collective.
   *
   * @throws InputError for a moment on a surface that has no extent across its axis.
   */
  template <int dim>
  std::function<void(const double time, Vector &forces)>
  resultant_load(const Body<dim> &body, const ResultantLoad<dim> &load);
} // namespace Ricochet

#endif
