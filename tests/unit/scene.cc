// SPDX-License-Identifier: LGPL-2.1-or-later
// Parts of a user's scene: names, units, springs, probes.
#include <base/exceptions.h>
#include <base/units.h>
#include <discretization/boundary_springs.h>
#include <discretization/bulk_sum.h>
#include <discretization/follower_pressure.h>
#include <discretization/hyperelastic_bulk.h>
#include <discretization/linear_bulk.h>
#include <materials/material_parameters.h>
#include <output/momenta.h>
#include <output/stress_probe.h>
#include <problems/part_meshes.h>
#include <scene/named_sections.h>
#include <scene/surface_names.h>

#include <deal.II/base/function.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/grid/grid_generator.h>

#include <boost/test/unit_test.hpp>

#include <cmath>

BOOST_AUTO_TEST_SUITE(scene)

namespace
{
  using namespace Ricochet;

  void
  check_refused(const std::function<void()> &action, const std::string &text)
  {
    BOOST_CHECK_EXCEPTION(action(), InputError, [&](const InputError &error) {
      const bool found =
        std::string(error.what()).find(text) != std::string::npos;
      if (!found)
        BOOST_TEST_MESSAGE(error.what());
      return found;
    });
  }
} // namespace



BOOST_AUTO_TEST_CASE(units)
{
  const Units si;
  for (const std::string name : {"m", "J", "kg m/s", "1", "Pa"})
    BOOST_CHECK_EQUAL(si.name(name), name);
  // Checked by hand: 1 t mm/s^2 = 1000 kg * 1e-3 m/s^2 = 1 N.
  const Units mm("mm, t, s");
  for (const auto &[name, own] :
       std::map<std::string, std::string>{{"N", "N"},
                                          {"Pa", "MPa"},
                                          {"J", "mJ"},
                                          {"m/s", "mm/s"},
                                          {"kg m^2/s", "t mm^2/s"},
                                          {"1", "1"}})
    BOOST_CHECK_EQUAL(mm.name(name), own);
  const Units old("furlong, stone, fortnight");
  BOOST_CHECK_EQUAL(old.name("J"), "stone furlong^2/fortnight^2");
  BOOST_CHECK_EQUAL(old.name("Pa"), "stone/(furlong fortnight^2)");
  BOOST_CHECK_EQUAL(old.name("1/s"), "1/fortnight");
  for (const std::string bad : {"", "mm", "mm, t", "mm, t, s, K", "mm, t, s2"})
    check_refused([&]() { Units{bad}; }, "Units are those of");
}



BOOST_AUTO_TEST_CASE(sections_with_names)
{
  ParameterText text;
  // A file goes on with a section of another one.
  text.sections = {{{"Body ball"}, "base.prm, line 1"},
                   {{"Time"}, "base.prm, line 5"},
                   {{"Contact ball on floor"}, "scene.prm, line 2"},
                   {{"Body ball"}, "scene.prm, line 7"}};
  const auto found =
    find_named_sections(text, {"Body", "Contact"}, {"Time", "Output"});
  BOOST_REQUIRE_EQUAL(found.size(), 2);
  BOOST_CHECK_EQUAL(found[0].name, "ball");
  BOOST_CHECK_EQUAL(found[1].full_name(), "Contact ball on floor");
  BOOST_CHECK_EQUAL(found[1].column_name(), "ball_on_floor");
  for (const auto &[name, message] : std::map<std::string, std::string>{
         {"Boddy ball", "Is 'Body ball' meant?"},
         {"Tiem", "Is 'Time' meant?"},
         {"Body", "should be 'Body NAME'"},
         {"Body a/b", "should be 'Body NAME'"},
         {"Contact ball_on floor", "would be the same"},
         {"Contact ball on floor", "exists already, in scene.prm, line 2"}})
    {
      ParameterText wrong = text;
      wrong.sections.push_back({{name}, "scene.prm, line 9"});
      check_refused(
        [&, name = name]() {
          find_named_sections(wrong, {"Body", "Contact"}, {"Time", "Output"});
        },
        message);
    }
}



BOOST_AUTO_TEST_CASE(names_of_surfaces)
{
  SurfaceNames names;
  names.add_body("ball", {0, 7}, {{"sole", 7}, {"within", 3}});
  const auto id = names.add_body("long beam", {0, 1}, {});
  BOOST_CHECK_EQUAL(id.at(1), 3);
  const auto all = names.find("ball; long beam: 1", "here");
  BOOST_REQUIRE_EQUAL(all.size(), 2);
  BOOST_CHECK((all[0].ids == std::set<dealii::types::boundary_id>{0, 1}));
  BOOST_CHECK((all[1].ids == std::set<dealii::types::boundary_id>{3}));
  BOOST_CHECK((names.find("ball: sole", "here")[0].ids ==
               std::set<dealii::types::boundary_id>{1}));
  BOOST_CHECK_EQUAL(names.name_of(1), "7 (sole)");
  check_refused([&]() { names.find("bell", "here"); }, "Is 'ball' meant?");
  check_refused([&]() { names.find("ball: soul", "here"); },
                "Is 'sole' meant?");
  check_refused([&]() { names.find("ball: within", "here"); }, "no boundary");
  check_refused([&]() { names.find("", "here"); }, "no body");
}



// The work of springs and dashpots over a step is their stored and dissipated
// energy, and the tangent that of the force.
BOOST_AUTO_TEST_CASE(springs)
{
  dealii::Triangulation<2> mesh;
  make_rectangles({{dealii::Point<2>(), dealii::Point<2>(2., 1.), {{4, 2}}}},
                  CellShape::quadrilaterals,
                  mesh);
  const auto         right = rectangle_side(0, Rectangle::right);
  const Body<2>      body(mesh,
                     1,
                     {},
                     {right},
                     MultiplierSpace::none,
                     MPI_COMM_WORLD);
  MaterialParameters material;
  material.law                             = "Saint Venant-Kirchhoff";
  material.plane_state                     = "plane strain";
  material.values["Young modulus"]         = 100.;
  const std::vector<Material<2>> materials = {material.make<2>()};
  const double                   k = 30., c = 2., drag = .7, step = .1;
  const HyperelasticBulk<2>      alone(body, materials);
  std::vector<std::unique_ptr<BulkOperator>> terms;
  terms.push_back(std::make_unique<HyperelasticBulk<2>>(body, materials));
  terms.push_back(std::make_unique<SpringsAndDashpots<2>>(
    body,
    std::vector<BoundarySprings<2>>{{right, {{false, true}}, k, 0.},
                                    {right, {{true, false}}, 0., c}},
    std::vector<double>{drag}));
  const BulkSum bulk(std::move(terms), body.make_vector());

  Vector begin, end;
  body.interpolate(dealii::FunctionFromFunctionObjects<2>(
                     {[](const dealii::Point<2> &x) { return .01 * x[1]; },
                      [](const dealii::Point<2> &) { return .2; }}),
                   begin);
  body.interpolate(dealii::FunctionFromFunctionObjects<2>(
                     {[](const dealii::Point<2> &) { return .05; },
                      [](const dealii::Point<2> &x) {
                        return .1 + .02 * x[0];
                      }}),
                   end);
  // By hand: the side is at x = 2, of length 1.
  BOOST_CHECK_CLOSE(bulk.energy(begin) - alone.energy(begin),
                    .5 * k * .2 * .2,
                    1e-9);
  BOOST_CHECK_CLOSE(bulk.energies_of_parts(end)[0] -
                      alone.energies_of_parts(end)[0],
                    .5 * k * .14 * .14,
                    1e-8);
  // The integral of (.05 - .01 y)^2 over 0 < y < 1, and that of (.02 x - .1)^2 over
  // 0 < x < 2.
  const double first = .0025 - .0005 + .0001 / 3., second = 7.84e-4 / .06;
  BOOST_CHECK_CLOSE(bulk.viscous_dissipation(begin, end, step),
                    (c * first + drag * (2. * first + second)) / step,
                    1e-9);
  Vector force = body.make_vector(), way(end);
  way -= begin;
  bulk.step_force(begin, end, step, force);
  BOOST_CHECK_CLOSE(force * way,
                    bulk.energy(end) - bulk.energy(begin) +
                      bulk.viscous_dissipation(begin, end, step),
                    1e-9);
  for (const bool of_step : {true, false})
    {
      Matrix tangent;
      tangent.reinit(body.sparsity_pattern());
      if (of_step)
        bulk.add_step_tangent(begin, end, step, tangent);
      else
        bulk.add_tangent(1., end, tangent);
      Vector product = body.make_vector(), moved(end),
             other   = body.make_vector();
      tangent.vmult(product, way);
      const double h = 1e-6;
      moved.add(h, way);
      if (of_step)
        {
          bulk.step_force(begin, moved, step, other);
          moved.add(-2. * h, way);
          bulk.step_force(begin, moved, step, force);
        }
      else
        {
          bulk.force(moved, other);
          moved.add(-2. * h, way);
          bulk.force(moved, force);
        }
      other -= force;
      other.add(-2. * h, product);
      BOOST_CHECK_LT(other.l2_norm(),
                     1e-7 * 2. * h * product.l2_norm() + 1e-13);
    }
}



// A pressure all around: its work over a step is the pressure times the change of the
// volume within, its force has no sum, and the tangent is that of the force.
template <int dim>
void
check_pressure(const dealii::Triangulation<dim> &mesh)
{
  using dealii::Point;
  const double    p = 7.;
  const Body<dim> body(mesh, 1, {}, {}, MultiplierSpace::none, MPI_COMM_WORLD);
  std::vector<BoundaryPressure<dim>> pressures;
  for (const auto id : mesh.get_boundary_ids())
    pressures.push_back(
      {id, [p](const double, const Point<dim> &) { return p; }});
  const FollowerPressure<dim> load(body, pressures);

  // Two deformations, far from each other.
  Vector                                                 begin, end;
  std::vector<std::function<double(const Point<dim> &)>> first, second;
  for (unsigned int c = 0; c < dim; ++c)
    {
      first.emplace_back([c](const Point<dim> &x) {
        return .2 * std::sin(2. * x[(c + 1) % dim] + c);
      });
      second.emplace_back([c](const Point<dim> &x) {
        return .3 * x[c] * x[c] - .2 * std::cos(3. * x[(c + 1) % dim]) + .1 * c;
      });
    }
  body.interpolate(dealii::FunctionFromFunctionObjects<dim>(first), begin);
  body.interpolate(dealii::FunctionFromFunctionObjects<dim>(second), end);
  const auto volume = [&](const Vector &solution) {
    dealii::FEValues<dim>               values(body.mapping(),
                                 body.dof_handler().get_fe(),
                                 dealii::QGauss<dim>(4),
                                 dealii::update_gradients |
                                   dealii::update_JxW_values);
    std::vector<dealii::Tensor<2, dim>> gradients(values.n_quadrature_points);
    double                              sum = 0.;
    for (const auto &cell : body.dof_handler().active_cell_iterators())
      {
        values.reinit(cell);
        values[dealii::FEValuesExtractors::Vector(0)]
          .get_function_gradients(solution, gradients);
        for (unsigned int q = 0; q < gradients.size(); ++q)
          sum += values.JxW(q) *
            determinant(dealii::Tensor<2, dim>(
                          dealii::unit_symmetric_tensor<dim>()) +
                        gradients[q]);
      }
    return sum;
  };
  Vector force = body.make_vector(), way(end);
  way -= begin;
  load.step_force(begin, end, 0., 1., force);
  const double change = volume(end) - volume(begin);
  BOOST_CHECK_GT(std::abs(change), .01);
  BOOST_CHECK_CLOSE(force * way, -p * change, 1e-9);
  for (unsigned int c = 0; c < dim; ++c)
    {
      Vector              translation;
      std::vector<double> along(dim, 0.);
      along[c] = 1.;
      body.interpolate(dealii::Functions::ConstantFunction<dim>(along),
                       translation);
      BOOST_CHECK_SMALL(force * translation, 1e-12 * p);
    }

  Matrix tangent;
  tangent.reinit(body.sparsity_pattern());
  load.subtract_step_tangent(1., begin, end, 0., 1., tangent);
  Vector product = body.make_vector(), moved(end), other = body.make_vector();
  tangent.vmult(product, way);
  const double h = 1e-5;
  moved.add(h, way);
  load.step_force(begin, moved, 0., 1., other);
  moved.add(-2. * h, way);
  load.step_force(begin, moved, 0., 1., force);
  other -= force;
  other.add(2. * h, product);
  BOOST_CHECK_LT(other.l2_norm(), 1e-8 * 2. * h * product.l2_norm());
}

BOOST_AUTO_TEST_CASE(pressure_that_follows)
{
  dealii::Triangulation<2> plane;
  make_rectangles({{dealii::Point<2>(), dealii::Point<2>(1., 1.), {{3, 2}}}},
                  CellShape::quadrilaterals,
                  plane);
  check_pressure(plane);
  dealii::Triangulation<3> cube;
  dealii::GridGenerator::subdivided_hyper_cube(cube, 2);
  check_pressure(cube);
}



BOOST_AUTO_TEST_CASE(stress_in_points_and_means)
{
  dealii::Triangulation<2> mesh;
  make_rectangles(
    {{dealii::Point<2>(), dealii::Point<2>(1., 1.), {{3, 3}}},
     {dealii::Point<2>(2., 0.), dealii::Point<2>(3., 1.), {{2, 2}}}},
    CellShape::quadrilaterals,
    mesh);
  const Body<2> body(mesh, 1, {}, {}, MultiplierSpace::none, MPI_COMM_WORLD);
  const std::vector<Material<2>> materials =
    {Material<2>(LinearElastic{0., 50.}), Material<2>(LinearElastic{0., 100.})};
  Vector solution;
  // The strain in direction x is x in both.
  body.interpolate(dealii::FunctionFromFunctionObjects<2>(
                     {[](const dealii::Point<2> &x) { return .03 * x[0]; },
                      [](const dealii::Point<2> &) { return 0.; }}),
                   solution);
  const StressProbe<2> left(body, materials, 0, 1, nullptr),
    both(body, materials, 0, 2, nullptr);
  BOOST_CHECK_CLOSE(left.stress(solution)[0][0], 3., 1e-9);
  BOOST_CHECK_CLOSE(both.stress(solution)[0][0], 4.5, 1e-9);
  const dealii::Point<2> inside(2.3, .7), between(1.5, .5);
  const StressProbe<2>   right(body, materials, 1, 2, &inside),
    nowhere(body, materials, 0, 2, &between),
    other_part(body, materials, 0, 1, &inside);
  BOOST_CHECK(right.is_in_body());
  BOOST_CHECK_CLOSE(right.stress(solution)[0][0], 6., 1e-9);
  BOOST_CHECK(!nowhere.is_in_body());
  BOOST_CHECK(!other_part.is_in_body());
}

BOOST_AUTO_TEST_SUITE_END()
