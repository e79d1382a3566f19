// SPDX-License-Identifier: LGPL-2.1-or-later

// The assembled forces of hyperelastic bodies, on quadrilaterals, triangles and
// tetrahedra, degree 1 and 2, on any number of ranks: tangents against finite
// differences, the work identity of a step, rigid motions, inverted elements.

#include "meshes.h"

#include <base/exceptions.h>
#include <discretization/bulk_of_parts.h>
#include <discretization/bulk_sum.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/hyperelastic_law_implementation.h>
#include <materials/laws/ciarlet_geymonat.h>

#include <deal.II/base/function.h>

#include <boost/test/unit_test.hpp>

#include <cmath>
#include <functional>

using namespace Ricochet;
using dealii::VectorOperation;

BOOST_AUTO_TEST_SUITE(hyperelastic_bulk)

namespace
{
  template <int dim>
  Material<dim>
  material(const PlaneState state, const Viscosity &viscosity = {})
  {
    return Material<dim>(
      std::make_shared<Hyperelastic<dim>>(
        std::make_shared<HyperelasticLawImplementation<CiarletGeymonat>>(
          CiarletGeymonat{.5, .005, .35}),
        state),
      viscosity);
  }

  /// The tangent that @p add adds against the difference of @p evaluate, the force at a state,
  /// in this @p direction about @p solution.
  template <int dim>
  void
  check_tangent(
    const Body<dim>                                               &body,
    const Vector                                                  &solution,
    const Vector                                                  &direction,
    const std::function<void(const Vector &state, Vector &force)> &evaluate,
    const std::function<void(Matrix &tangent)>                    &add)
  {
    const double eps = 1e-6;
    Vector plus(solution), minus(solution), product(solution), point(solution);
    Matrix tangent;
    tangent.reinit(body.sparsity_pattern());
    add(tangent);
    tangent.vmult(product, direction);
    point.add(eps, direction);
    evaluate(point, plus);
    point = solution;
    point.add(-eps, direction);
    evaluate(point, minus);
    plus -= minus;
    plus *= 1. / (2. * eps);
    plus -= product;
    BOOST_CHECK_SMALL(plus.linfty_norm(), 1e-7 * product.linfty_norm());
  }

  /// The viscous force at @p solution where the velocity is (solution - origin) / time:
  /// its tangent, its power, and none for a body that turns rigidly.
  template <int dim>
  void
  check_viscous_force(const Body<dim>             &body,
                      const HyperelasticBulk<dim> &bulk,
                      const Vector                &origin,
                      const Vector                &solution,
                      const Vector                &direction)
  {
    const double time = .3, eps = 1e-6;
    Vector       plus(solution), minus(solution), product(solution);
    Matrix       tangent;
    tangent.reinit(body.sparsity_pattern());
    bulk.add_viscous_tangent(2., origin, solution, time, tangent);
    tangent.vmult(product, direction);
    const auto evaluate = [&](const double distance, Vector &result) {
      Vector point(solution);
      point.add(distance, direction);
      bulk.viscous_force(origin, point, time, result);
    };
    evaluate(eps, plus);
    evaluate(-eps, minus);
    plus -= minus;
    plus *= 1. / eps;
    plus -= product;
    BOOST_CHECK_SMALL(plus.linfty_norm(), 1e-7 * product.linfty_norm());

    // Its power is the dissipation of a short step with the same velocity about the
    // same state, which is that of another formula, to second order.
    Vector velocity(solution), begin(solution), end(solution);
    velocity -= origin;
    velocity *= 1. / time;
    const double step = 1e-3;
    begin.add(-.5 * step, velocity);
    end.add(.5 * step, velocity);
    evaluate(0., plus);
    const double power       = plus * velocity,
                 dissipation = bulk.viscous_dissipation(begin, end, step);
    BOOST_CHECK_GT(power, 0.);
    BOOST_CHECK_CLOSE(power, dissipation / step, 1e-3);

    // A body at rest that begins to turn has a velocity, but no rate of strain.
    class Turning : public dealii::Function<dim>
    {
    public:
      Turning()
        : dealii::Function<dim>(dim)
      {}

      double
      value(const dealii::Point<dim> &x,
            const unsigned int        component) const override
      {
        return component == 0 ? .5 * x[1] : component == 1 ? -.5 * x[0] : 0.;
      }
    };
    body.interpolate(Turning(), begin);
    end = 0.;
    bulk.viscous_force(begin, end, time, plus);
    BOOST_CHECK_SMALL(plus.linfty_norm(), 1e-15);
  }

  template <int dim>
  void
  check(const bool simplices, const unsigned int degree)
  {
    const CubeAbovePlane<dim> cube(simplices);
    const Body<dim>           body(cube.triangulation,
                         degree,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
    const double              time_step = .1;
    for (const auto &viscosity : {Viscosity{},
                                  Viscosity{Viscosity::Law::curnier, .02},
                                  Viscosity{Viscosity::Law::pioletti, .02}})
      {
        const HyperelasticBulk<dim> bulk(
          body,
          material<dim>(dim == 2 ? PlaneState::plane_stress
                                 : PlaneState::plane_strain,
                        viscosity));
        Vector old_solution = body.make_vector(), solution(old_solution),
               direction(old_solution), force(old_solution);
        // Small enough that no element of degree 2 is inverted.
        randomise(old_solution, .02, 1);
        randomise(solution, .02, 2);
        randomise(direction, 1., 3);

        // Work over the step.
        bulk.step_force(old_solution, solution, time_step, force);
        Vector step(solution);
        step -= old_solution;
        const double dissipation =
          bulk.viscous_dissipation(old_solution, solution, time_step);
        BOOST_CHECK_SMALL(force * step -
                            (bulk.energy(solution) - bulk.energy(old_solution) +
                             dissipation),
                          1e-14);
        BOOST_CHECK_EQUAL(dissipation > 0., viscosity.is_active());

        check_tangent(
          body,
          solution,
          direction,
          [&](const Vector &x, Vector &f) {
            bulk.step_force(old_solution, x, time_step, f);
          },
          [&](Matrix &matrix) {
            bulk.add_step_tangent(old_solution, solution, time_step, matrix);
          });
        check_tangent(
          body,
          solution,
          direction,
          [&](const Vector &x, Vector &f) { bulk.force(x, f); },
          [&](Matrix &matrix) { bulk.add_tangent(1., solution, matrix); });

        // Viscous forces at an instant: none if the body is not viscous.
        BOOST_CHECK_EQUAL(bulk.is_viscous(), viscosity.is_active());
        if (viscosity.is_active())
          check_viscous_force(body, bulk, old_solution, solution, direction);

        // A rigid turn costs nothing and makes no force.
        class Turn : public dealii::Function<dim>
        {
        public:
          Turn()
            : dealii::Function<dim>(dim)
          {}

          double
          value(const dealii::Point<dim> &x,
                const unsigned int        component) const override
          {
            const double c = std::cos(1.1), s = std::sin(1.1);
            if (component == 0)
              return (c - 1.) * x[0] - s * x[1] + 3.;
            return component == 1 ? s * x[0] + (c - 1.) * x[1] : 0.;
          }
        };
        body.interpolate(Turn(), solution);
        BOOST_CHECK_SMALL(bulk.energy(solution), 1e-14);
        bulk.force(solution, force);
        BOOST_CHECK_SMALL(force.linfty_norm(), 1e-14);
        BOOST_CHECK(bulk.failure().empty());

        // A mirror image is not a state of the body, although its C is that of
        // rest.
        class Mirror : public dealii::Function<dim>
        {
        public:
          Mirror()
            : dealii::Function<dim>(dim)
          {}

          double
          value(const dealii::Point<dim> &x,
                const unsigned int        component) const override
          {
            return component == 0 ? -2. * x[0] : 0.;
          }
        };
        body.interpolate(Mirror(), solution);
        bulk.force(solution, force);
        BOOST_CHECK(!std::isfinite(force.l2_norm()));
        BOOST_CHECK(bulk.failure().find("det F = -1 in the cell") !=
                    std::string::npos);
      }
  }
} // namespace



namespace
{
  /// A cube of which one half is linear elastic, both viscous and connected: work of a step,
  /// tangents, and with a uniform strain half of the energy of each material.
  template <int dim>
  void
  check_mixed()
  {
    CubeAbovePlane<dim> cube(/* simplices = */ false);
    for (const auto &cell : cube.triangulation.active_cell_iterators())
      cell->set_material_id(cell->center()[0] < .5 ? 0 : 1);
    const Body<dim>     body(cube.triangulation,
                         1,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
    const Material<dim> linear(LinearElastic{.7, .4},
                               Viscosity{Viscosity::Law::linear, .03}),
      large = material<dim>(PlaneState::plane_strain,
                            Viscosity{Viscosity::Law::curnier, .02});
    const BulkSum               bulk(bulk_of_parts<dim>(body,
                                          {linear, large},
                                          MatrixStorage::entries),
                       body.make_vector());
    const LinearBulk<dim>       all_linear(body,
                                     std::vector<Material<dim>>(2, linear));
    const HyperelasticBulk<dim> all_large(body,
                                          std::vector<Material<dim>>(2, large));
    Vector begin = body.make_vector(), end(begin), direction(begin),
           force(begin), product(begin);
    randomise(begin, .02, 1);
    randomise(end, .02, 2);
    randomise(direction, 1., 3);
    const double time_step = .1;
    std::vector<std::function<double(const dealii::Point<dim> &)>> stretched;
    for (unsigned int c = 0; c < dim; ++c)
      stretched.emplace_back([c](const dealii::Point<dim> &x) {
        return .1 * x[(c + 1) % dim] - .02 * (c + 1) * x[c];
      });
    body.interpolate(dealii::FunctionFromFunctionObjects<dim>(stretched),
                     product);
    const double expected =
      .5 * (all_linear.energy(product) + all_large.energy(product));
    BOOST_CHECK_CLOSE(bulk.energy(product), expected, 1e-10);
    const auto of_parts = bulk.energies_of_parts(product);
    BOOST_CHECK_CLOSE(of_parts[0] + of_parts[1], expected, 1e-10);
    Vector step(end);
    step -= begin;
    bulk.step_force(begin, end, time_step, force);
    BOOST_CHECK_SMALL(force * step - bulk.energy(end) + bulk.energy(begin) -
                        bulk.viscous_dissipation(begin, end, time_step),
                      1e-14);
    check_tangent(
      body,
      end,
      direction,
      [&](const Vector &x, Vector &f) {
        bulk.step_force(begin, x, time_step, f);
      },
      [&](Matrix &matrix) {
        bulk.add_step_tangent(begin, end, time_step, matrix);
      });
    check_tangent(
      body,
      end,
      direction,
      [&](const Vector &x, Vector &f) { bulk.force(x, f); },
      [&](Matrix &matrix) { bulk.add_tangent(1., end, matrix); });
    check_tangent(
      body,
      end,
      direction,
      [&](const Vector &x, Vector &f) {
        bulk.viscous_force(begin, x, time_step, f);
      },
      [&](Matrix &matrix) {
        bulk.add_viscous_tangent(1., begin, end, time_step, matrix);
      });
  }
} // namespace

BOOST_AUTO_TEST_CASE(small_strains_beside_large_ones)
{
  check_mixed<2>();
  check_mixed<3>();
}

BOOST_AUTO_TEST_CASE(in_2d)
{
  check<2>(false, 1);
  check<2>(false, 2);
  check<2>(true, 1);
  check<2>(true, 2);
}

BOOST_AUTO_TEST_CASE(in_3d)
{
  check<3>(false, 1);
  check<3>(true, 1);
  check<3>(true, 2);
}

namespace
{
  /// A corner that moves inwards by some part of a cell, in each direction: det F there is
  /// 1 - dim * part, and in the nearest point of Gauss, at a = 0.789 of the cell, it is
  /// 1 - dim * part * a^(dim - 1).
  template <int dim>
  void
  check_corner(const double part, const bool is_inverted)
  {
    class Inwards : public dealii::Function<dim>
    {
    public:
      explicit Inwards(const double distance)
        : dealii::Function<dim>(dim)
        , distance(distance)
      {}

      double
      value(const dealii::Point<dim> &x, const unsigned int) const override
      {
        double smallest = 1.;
        for (unsigned int c = 0; c < dim; ++c)
          smallest = std::min(smallest, x[c]);
        return smallest > 1. - 1e-9 ? -distance : 0.;
      }

    private:
      const double distance;
    };

    const CubeAbovePlane<dim>   cube(false);
    const Body<dim>             body(cube.triangulation,
                         1,
                         {},
                         {1},
                         MultiplierSpace::none,
                         MPI_COMM_WORLD);
    const HyperelasticBulk<dim> bulk(body,
                                     material<dim>(PlaneState::plane_strain));
    Vector                      solution = body.make_vector(), force(solution);
    body.interpolate(Inwards(.5 * part), solution);
    bulk.force(solution, force);
    BOOST_CHECK(bulk.failure().empty());
    const std::string place = dim == 2 ? "(1, 1)" : "(1, 1, 1)";
    BOOST_CHECK_EQUAL(bulk.inverted_corner(solution),
                      is_inverted ? place + " of the undeformed body" : "");
  }
} // namespace

BOOST_AUTO_TEST_CASE(corners_that_are_turned_inside_out)
{
  for (const bool is_inverted : {false, true})
    {
      check_corner<2>(is_inverted ? .55 : .45, is_inverted);
      check_corner<3>(is_inverted ? .37 : .3, is_inverted);
    }
}

BOOST_AUTO_TEST_CASE(inverted_meshes_are_refused)
{
  for (const bool simplices : {true, false})
    {
      CubeAbovePlane<2> cube(simplices);
      // Move the middle vertex out of its cells.
      for (const auto &cell : cube.triangulation.active_cell_iterators())
        for (const unsigned int v : cell->vertex_indices())
          if (cell->vertex(v).distance(dealii::Point<2>(.5, .5)) < 1e-9)
            cell->vertex(v) = dealii::Point<2>(1.2, 1.2);
      BOOST_CHECK_EXCEPTION(
        Body<2>(cube.triangulation,
                1,
                {},
                {1},
                MultiplierSpace::none,
                MPI_COMM_WORLD),
        InputError,
        [](const InputError &error) {
          return std::string(error.what()).find("turned inside out") !=
            std::string::npos;
        });
    }
}

BOOST_AUTO_TEST_SUITE_END()
