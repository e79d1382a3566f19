// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_time_integration_mass_redistribution_h
#define ricochet_time_integration_mass_redistribution_h

#include <discretization/body.h>

#include <array>
#include <vector>

namespace Ricochet
{
  /**
   * Free the nodes of the contact boundary of inertia (Khenous, Laborde and
   * Renard 2008; paper C, section 2.4): the matrix that is nearest to @p mass in
   * the Frobenius norm among those with the same sparsity, zero rows and columns
   * on the contact boundary, and the same total mass, first and second moments of
   * each body. A body is a set of connected cells: a mesh may contain several.
   *
   * With a_k, b_k the polynomials 1, x_i of the constraints, the result is
   * M_ij + sum_k l_k sym(a_k b_k^T)_ij on the entries off the contact boundary;
   * the l_k solve a dense system of size 1 + dim + dim (dim + 1)/2.
   *
   * Where that matrix is not positive definite off the contact boundary (seen with
   * 3 or 4 elements across a body, and on the sphere of paper C with degree 2,
   * half of whose surface is the contact boundary), each entry is multiplied by 1
   * + sum_k l_k sym(a_k b_k^T)_ij instead, like a modified density. By Schur's
   * product theorem it is positive whenever that polynomial is, as a matrix in (1,
   * x).
   *
   * @throws InputError when the mesh is too coarse: the moments are not
   * independent on the nodes that are left, or neither result is positive
   * definite on them.
   */
  template <int dim>
  Matrix
  redistribute_mass(const Body<dim> &body, const Matrix &mass);

  /// Number of moments that redistribute_mass() keeps.
  template <int dim>
  constexpr unsigned int n_mass_moments = 1 + dim + dim *(dim + 1) / 2;

  /// Total mass (kg), first moments (kg m) and second moments (kg m^2: xx, xy,
  /// ..., in lexicographic order) of the scalar matrix of @p mass, for each
  /// body.
  template <int dim>
  std::vector<std::array<double, n_mass_moments<dim>>>
  mass_moments(const Body<dim> &body, const Matrix &mass);
} // namespace Ricochet

#endif
