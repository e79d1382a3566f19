// SPDX-License-Identifier: LGPL-2.1-or-later
#ifndef ricochet_tests_unit_contact_tangent_h
#define ricochet_tests_unit_contact_tangent_h

#include "meshes.h"

#include <contact/contact_operator.h>
#include <discretization/body.h>
#include <time_integration/state.h>

#include <boost/test/unit_test.hpp>

#include <string>

namespace Ricochet
{
  /// The tangent of contact at @p solution, along @p direction, is the quotient of
  /// differences, in a stage of @p scheme that begins at @p state.
  /// @param least_product contact acts there.
  /// @param part_left_out relative size of what the tangent leaves out.
  template <int dim>
  void
  check_contact_tangent(ContactOperator   &contact,
                        const Body<dim>   &body,
                        const State       &state,
                        const std::string &scheme,
                        const double       time_step,
                        const Vector      &solution,
                        const Vector      &direction,
                        const double       least_product,
                        const double       part_left_out = 0.)
  {
    // At an instant slip is counted from elsewhere.
    const bool is_instant = scheme != "midpoint";
    Vector     origin(state.solution), noise(solution);
    randomise(noise, 1e-3, 3);
    origin += noise;
    contact.begin_stage({state.solution,
                         state.contact_force,
                         state.mean_velocity,
                         is_instant ? 0. : time_step,
                         state.time + time_step,
                         nullptr,
                         is_instant ? &origin : nullptr,
                         is_instant ? time_step : 0.},
                        1.);
    Matrix body_matrix, matrix;
    body_matrix.reinit(body.sparsity_pattern());
    Vector residual(solution), product(solution), difference(solution);
    residual = 0.;
    contact.add_residual(solution, residual);
    UnitedPattern united;
    united.update(body.sparsity_pattern(), *contact.couplings());
    united.embed(body_matrix, matrix);
    contact.add_tangent(matrix);
    matrix.vmult(product, direction);
    const double h  = 1e-6;
    const auto   at = [&](const double length) {
      Vector point(solution), result(solution);
      point.add(length, direction);
      result = 0.;
      contact.add_residual(point, result);
      return result;
    };
    difference = at(h);
    difference -= at(-h);
    difference *= .5 / h;
    BOOST_CHECK_GT(product.l2_norm(), least_product);
    difference -= product;
    BOOST_CHECK_SMALL(difference.l2_norm() / product.l2_norm(),
                      1e-7 + part_left_out);
  }
} // namespace Ricochet

#endif
