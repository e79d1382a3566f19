// SPDX-License-Identifier: LGPL-2.1-or-later

// Bodies at rest on a plane, against solutions in closed form: a block under
// uniform pressure (patch test), and Hertz's sphere.

#include "on_all_ranks.h"
#include "equilibrium.h"
#include "meshes.h"

#include <contact/obstacles/half_space.h>
#include <problems/gmsh_mesh.h>
#include <problems/impact.h>
#include <problems/part_meshes.h>

#include <deal.II/dofs/dof_tools.h>
#include <deal.II/grid/grid_tools.h>

#include <boost/test/unit_test.hpp>
#include <gmsh.h>

#include <cmath>

using namespace Ricochet;

namespace
{
  /// A field whose last component is @p value, and the others zero.
  template <int dim>
  Vector
  vertical(const Body<dim>                                          &body,
           const std::function<double(const dealii::Point<dim> &x)> &value)
  {
    std::vector<std::function<double(const dealii::Point<dim> &)>> components(
      dim,
      [](const dealii::Point<dim> &) { return 0.; });
    components.back() = value;
    Vector vector;
    body.interpolate(dealii::FunctionFromFunctionObjects<dim>(components),
                     vector);
    return vector;
  }

  /// A unit cube without lateral contraction, held at its top, on a plane that
  /// has moved up by 1/20: strain, stress and contact pressure are uniform.
  template <int dim>
  void
  check_patch(const std::string &treatment,
              const double       theta,
              const std::string &scheme,
              const unsigned int degree,
              const bool         simplices)
  {
    const double              rise = .05, mu = 3.;
    const CubeAbovePlane<dim> cube(simplices);
    ImpactParameters          parameters;
    parameters.contact.treatment                = treatment;
    parameters.contact.values["Nitsche theta"]  = theta;
    parameters.contact.values["Nitsche gamma0"] = 100. * mu;
    parameters.contact.values["Augmentation"]   = 100. * mu;
    parameters.scheme.name                      = scheme;
    Impact<dim> impact(parameters,
                       cube.triangulation,
                       ImpactSetup<dim>{Material<dim>(LinearElastic{0., mu}),
                                        1.,
                                        degree,
                                        {2},
                                        cube.plane(-rise)},
                       MPI_COMM_WORLD);
    const auto [solution, force] = equilibrium(impact);

    // u = (1 - x_dim) rise e_dim, contact pressure 2 mu rise.
    Vector exact = vertical<dim>(impact.body, [&](const dealii::Point<dim> &x) {
      return (1. - x[dim - 1]) * rise;
    });
    const double pressure = 2. * mu * rise;
    for (const auto i : impact.body.multiplier_indices())
      exact(i) = pressure;
    exact.compress(dealii::VectorOperation::insert);
    Vector difference(solution);
    difference -= exact;
    const std::string name = treatment + ", theta " + std::to_string(theta) +
      ", degree " + std::to_string(degree) + ", " + std::to_string(dim) + "D";
    BOOST_CHECK_MESSAGE(difference.linfty_norm() < 1e-10,
                        name << ": error " << difference.linfty_norm());
    const auto summary = impact.contact->summary({solution, force, 0.});
    BOOST_CHECK_CLOSE(summary.at(1).force, pressure, 1e-8);
    // And the pressure is uniform, not only in the mean.
    const Vector field = impact.contact->pressure_field({solution, force, 0.});
    double       worst = 0.;
    unsigned int n     = 0;
    for (const auto i : field.locally_owned_elements())
      if (const double value = field(i); value != 0.)
        {
          worst = std::max(worst, std::abs(value - pressure));
          ++n;
        }
    BOOST_CHECK_LT(worst, 1e-10 * mu);
    // At all nodes of the contact boundary.
    BOOST_CHECK_EQUAL(dim * n, impact.body.contact_indices().n_elements());
  }

  struct HertzErrors
  {
    double force, radius, peak;
  };

  /**
   * The lower half of a ball of radius 1, held at its flat top, on a plane that
   * has moved up by 0.0025; elements of length contact radius / @p
   * elements_per_radius around the pole.
   */
  HertzErrors
  hertz(const double elements_per_radius)
  {
    const double  approach = .0025, contact_radius = std::sqrt(approach);
    const double  finest = contact_radius / elements_per_radius;
    LinearElastic material{1., 1.};

    dealii::Triangulation<3> mesh;
    mesh_by_gmsh(
      [&]() {
        const double pi = dealii::numbers::PI;
        gmsh::model::occ::addSphere(0., 0., 1., 1., -1, -pi / 2., 0.);
        // The length of an element grows with the distance from the contact.
        const int         field    = gmsh::model::mesh::field::add("MathEval");
        const std::string distance = "Sqrt(x*x+y*y+z*z)";
        gmsh::model::mesh::field::setString(
          field,
          "F",
          std::to_string(finest) + "+0.35*Max(0,(" + distance + "-" +
            std::to_string(1.2 * contact_radius) + "))");
        gmsh::model::mesh::field::setAsBackgroundMesh(field);
        gmsh::option::setNumber("Mesh.MeshSizeMax", .3);
        gmsh::option::setNumber("Mesh.MeshSizeExtendFromBoundary", 0);
      },
      mesh);
    for (const auto &cell : mesh.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->center()[2] > 1. - 1e-6  ? 2
                                  : face->center().norm() < .3 ? 1
                                                               : 0);

    ImpactParameters parameters                 = on_all_ranks();
    parameters.contact.treatment                = "Nitsche";
    parameters.contact.values["Nitsche gamma0"] = 100. * material.mu;
    parameters.scheme.name                      = "Crank-Nicolson";
    dealii::Point<3> plane(0., 0., approach);
    Impact<3>        impact(
      parameters,
      mesh,
      ImpactSetup<3>{
               Material<3>(material),
               1.,
               2,
               {2},
               {{1,
                 half_space_at_rest<3>(plane, dealii::Tensor<1, 3>({0., 0., 1.}))}}},
      MPI_COMM_WORLD);
    const auto [solution, force] = equilibrium(impact);

    // Force; radius from the second moment, which for Hertz's pressure is
    // 2/5 a^2 F; largest pressure.
    const Vector square =
      vertical<3>(impact.body, [](const dealii::Point<3> &x) {
        return x[0] * x[0] + x[1] * x[1];
      });
    const double total =
      impact.contact->summary({solution, force, 0.}).at(1).force;
    const double radius = std::sqrt(2.5 * std::abs(square * force) / total);
    // The pressure is discontinuous and its largest value wherever it happens to
    // be; so the mean over the nodes near the pole, where Hertz's is 0.984 of
    // the peak.
    const Vector field = impact.contact->pressure_field({solution, force, 0.});
    std::map<dealii::types::global_dof_index, dealii::Point<3>> positions;
    dealii::DoFTools::map_dofs_to_support_points(impact.body.mapping(),
                                                 impact.body.dof_handler(),
                                                 positions);
    double       sum = 0.;
    unsigned int n   = 0;
    for (const auto &[i, x] : positions)
      if (field(i) > 0. && x.norm() < .25 * contact_radius)
        {
          sum += field(i);
          ++n;
        }
    const double peak = sum / n / .984;

    // Hertz for that approach (K. L. Johnson, Contact Mechanics, 1985, section
    // 4.2), with E / (1 - nu^2) for a rigid plane.
    const double lambda = material.lambda, mu = material.mu;
    const double modulus     = 4. * mu * (lambda + mu) / (lambda + 2. * mu);
    const double exact_force = 4. / 3. * modulus * std::pow(approach, 1.5);
    const double exact_peak =
      2. * modulus / dealii::numbers::PI * contact_radius;
    BOOST_TEST_MESSAGE(
      "Hertz, " << elements_per_radius << " elements per radius, "
                << impact.body.owned_indices().size() << " unknowns: force "
                << total / exact_force << ", radius " << radius / contact_radius
                << ", peak " << peak / exact_peak);
    return {total / exact_force - 1.,
            radius / contact_radius - 1.,
            peak / exact_peak - 1.};
  }

  /// Errors relative to Hertz's solution for the computed force.
  struct CylinderErrors
  {
    double radius, peak;
    /// Mean error of the pressure in the nodes, relative to its mean.
    double pressure;
    /// Mean difference of the pressure in a node from that between its neighbours,
    /// less that of Hertz's pressure, relative to the mean.
    double oscillation;
  };

  /**
   * Two cylinders of radius 1 in plane strain, held at their far sides, of which the
   * upper one is moved down. Meshes are @p n_cells wide, graded towards the contact,
   * that of the lower body, the slave, is coarser by a third.
   */
  CylinderErrors
  hertz_of_cylinders(const std::string &coupling, const unsigned int n_cells)
  {
    constexpr double                           approach = 2.5e-3;
    const LinearElastic                        material{1., 1.};
    dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
    const unsigned int                         n_coarse = 2 * n_cells / 3 + 1;
    using dealii::Point;
    make_rectangles(
      {{Point<2>(-1., 1.), Point<2>(1., 2.), {{n_cells, n_cells / 2}}, 0., {}},
       {Point<2>(-1., -2.),
        Point<2>(1., -1.),
        {{n_coarse, n_coarse / 2}},
        0.,
        {}}},
      CellShape::quadrilaterals,
      mesh);
    // Cells grow with the distance from the contact, where there are 12 to 24 on the
    // radius of contact; the surfaces are circles near it.
    dealii::GridTools::transform(
      [](const Point<2> &x) {
        const auto graded = [](const double t) {
          return .05 * t + .95 * t * t * t;
        };
        const double side    = x[1] > 0. ? 1. : -1.;
        const double height  = graded(std::abs(x[1]) - 1.);
        const double along   = graded(x[0]);
        const double surface = 1. - std::sqrt(1. - .75 * along * along);
        return Point<2>(along, side * (surface / .75 * (1. - height) + height));
      },
      mesh);

    ImpactParameters parameters               = on_all_ranks();
    parameters.contact.treatment              = "Signorini active set";
    parameters.contact.coupling               = coupling;
    parameters.contact.values["Augmentation"] = 1.;
    // At rest there is no large force as a scale.
    parameters.newton.tolerance = 1e-11;
    parameters.scheme.name      = "midpoint";
    ImpactSetup<2> setup{Material<2>(material)};
    setup.parts.push_back({"upper", Material<2>(material), 1.});
    setup.parts.push_back({"lower", Material<2>(material), 1.});
    const auto slave = rectangle_side(1, Rectangle::upper);
    setup.pairs      = {
           {"cylinders", {slave}, {rectangle_side(0, Rectangle::lower)}}};
    setup.clamped = {rectangle_side(1, Rectangle::lower)};
    setup.imposed[rectangle_side(0, Rectangle::upper)] =
      {{{true, true}}, [](const double time, const dealii::Point<2> &) {
         return dealii::Tensor<1, 2>({0., -approach * time});
       }};
    Impact<2> impact(parameters, mesh, setup, MPI_COMM_WORLD);
    const auto [solution, force] = equilibrium(impact, /* end time */ 1.);

    // The upper body is pushed up, the lower one down, by the same force.
    const auto of_lower = [](const std::function<double(const double)> &value) {
      return
        [value](const Point<2> &x) { return x[1] < 0. ? value(x[0]) : 0.; };
    };
    const double total =
      impact.contact->summary({solution, force, 0.}).at(slave).force;
    const double square =
      vertical<2>(impact.body, of_lower([](const double x) { return x * x; })) *
      force;
    const double radius = 2. * std::sqrt(std::abs(square) / total);

    // K. L. Johnson, Contact Mechanics, 1985, section 4.2 (c).
    const double lambda = material.lambda, mu = material.mu;
    const double modulus = 2. * mu * (lambda + mu) / (lambda + 2. * mu);
    const double exact_radius =
      std::sqrt(4. * total * .5 / (dealii::numbers::PI * modulus));
    const double exact_peak = 2. * total / (dealii::numbers::PI * exact_radius);
    // The pressure of single nodes goes up and down; the mean over the middle third,
    // weighted with the length that each node stands for.
    const Vector field = impact.contact->pressure_field({solution, force, 0.});
    std::map<dealii::types::global_dof_index, Point<2>> positions;
    dealii::DoFTools::map_dofs_to_support_points(impact.body.mapping(),
                                                 impact.body.dof_handler(),
                                                 positions);
    const auto hertz = [&](const double x) {
      return exact_peak *
        std::sqrt(std::max(0., 1. - x * x / (exact_radius * exact_radius)));
    };
    // The field has the pressure in place of the first displacement.
    std::map<double, double> pressure_at;
    for (const auto &[i, x] : positions)
      if (x[1] < 0. && std::abs(x[0]) < 1.5 * exact_radius &&
          std::abs(x[1]) < .01)
        pressure_at[x[0]] =
          std::max(pressure_at[x[0]],
                   static_cast<double>(field(impact.body.system_index(i))));
    const std::vector<std::pair<double, double>> pressures(pressure_at.begin(),
                                                           pressure_at.end());
    double integral = 0., exact_integral = 0., error = 0., oscillation = 0.;
    for (unsigned int k = 1; k + 1 < pressures.size(); ++k)
      {
        const auto &[x, value]        = pressures[k];
        const auto &[left, of_left]   = pressures[k - 1];
        const auto &[right, of_right] = pressures[k + 1];
        const double length           = .5 * (right - left);
        error += length * std::abs(value - hertz(x));
        if (std::abs(x) > .5 * exact_radius)
          continue;
        integral += length * value;
        exact_integral += length * hertz(x);
        const double part = (x - left) / (right - left);
        oscillation += length *
          std::abs(value - hertz(x) - (1. - part) * (of_left - hertz(left)) -
                   part * (of_right - hertz(right)));
      }
    const double peak = integral / exact_integral;
    BOOST_TEST_MESSAGE("Hertz of two cylinders, "
                       << coupling << ", " << n_cells << " cells wide: radius "
                       << radius / exact_radius << " of " << exact_radius
                       << ", peak " << peak << ", pressure off by "
                       << error / total << ", oscillation "
                       << oscillation / integral);
    return {std::abs(radius / exact_radius - 1.),
            std::abs(peak - 1.),
            error / total,
            oscillation / integral};
  }
} // namespace


BOOST_AUTO_TEST_SUITE(patch_test)

BOOST_AUTO_TEST_CASE(uniform_pressure_is_reproduced)
{
  for (const bool simplices : {true, false})
    {
      for (const unsigned int degree : {1u, 2u})
        {
          for (const double theta : {1., 0., -1.})
            {
              check_patch<2>("Nitsche", theta, "HHT", degree, simplices);
              check_patch<3>("Nitsche", theta, "HHT", degree, simplices);
            }
          check_patch<3>("proximal augmented Lagrangian",
                         1.,
                         "HHT",
                         degree,
                         simplices);
        }
      check_patch<2>("Signorini multipliers", 1., "HHT", 1, simplices);
      check_patch<3>("Signorini multipliers", 1., "HHT", 1, simplices);
      check_patch<3>("Signorini active set", 1., "HHT", 1, simplices);
    }
}

namespace
{
  /// Two blocks on each other, one ten times as stiff, pressed together between
  /// rollers: strains, stresses and the pressure between them are uniform.
  /// @return by how much the pressure is wrong anywhere.
  double
  worst_error_between_blocks(const std::string &treatment,
                             const double       theta,
                             const std::string &coupling,
                             const unsigned int n_lower,
                             const unsigned int n_upper,
                             const bool         lower_is_slave,
                             const CellShape    shape)
  {
    constexpr double    press = .01;
    const LinearElastic soft{1., 1.}, stiff{10., 10.};
    // Motions are for the midpoint scheme. Treatments that do not need it have another
    // law there; for them the blocks overlap from the start.
    const bool   is_still = coupling == "cut faces";
    const double overlap  = is_still ? press : 0.;
    dealii::parallel::shared::Triangulation<2> mesh(MPI_COMM_WORLD);
    using dealii::Point;
    make_rectangles(
      {{Point<2>(0., -1.), Point<2>(1., 0.), {{n_lower, 3}}, 0., {}},
       {Point<2>(0., -overlap), Point<2>(1., 1.), {{n_upper, 3}}, 0., {}}},
      shape,
      mesh);
    ImpactParameters parameters                         = on_all_ranks();
    parameters.contact.treatment                        = treatment;
    parameters.contact.coupling                         = coupling;
    parameters.contact.values["Augmentation"]           = 10.;
    parameters.contact.values["Compliance coefficient"] = 1e3;
    parameters.contact.values["Nitsche gamma0"]         = 60.;
    parameters.contact.values["Nitsche theta"]          = theta;
    parameters.contact.values["Penalty epsilon0"]       = 1e-2;
    parameters.newton.tolerance                         = 1e-12;
    parameters.scheme.name = is_still ? "HHT" : "midpoint";
    ImpactSetup<2> setup{Material<2>(soft)};
    setup.parts.push_back({"lower", Material<2>(soft), 1.});
    setup.parts.push_back({"upper", Material<2>(stiff), 1.});
    const auto side_of_lower = rectangle_side(0, Rectangle::upper);
    const auto side_of_upper = rectangle_side(1, Rectangle::lower);
    setup.pairs              = {{"blocks",
                                 {lower_is_slave ? side_of_lower : side_of_upper},
                                 {lower_is_slave ? side_of_upper : side_of_lower}}};
    const VectorField<2> at_rest;
    for (const unsigned int part : {0U, 1U})
      for (const auto side : {Rectangle::left, Rectangle::right})
        setup.imposed[rectangle_side(part, side)] = {{{true, false}}, at_rest};
    setup.imposed[rectangle_side(0, Rectangle::lower)] = {{{false, true}},
                                                          at_rest};
    setup.imposed[rectangle_side(1, Rectangle::upper)] = {{{false, true}},
                                                          at_rest};
    if (!is_still)
      setup.imposed[rectangle_side(1, Rectangle::upper)].value =
        [](const double time, const dealii::Point<2> &) {
          return dealii::Tensor<1, 2>({0., -press * time});
        };
    Impact<2> impact(parameters, mesh, setup, MPI_COMM_WORLD);
    const auto [solution, force] = equilibrium(impact, /* end time */ 1.);

    // One after the other: the layers, and the spring of normal compliance, whose
    // pressure is c times the penetration.
    double diameter = std::numeric_limits<double>::infinity();
    for (const auto &cell : mesh.active_cell_iterators())
      diameter = std::min(diameter, cell->diameter());
    const double compliance = treatment == "standard normal compliance" ? 1e-3
      : treatment == "penalty" ? 1e-2 * diameter
                               : 0.;
    const double stiffness  = 1. /
      (1. / (soft.lambda + 2. * soft.mu) +
       (1. + overlap) / (stiff.lambda + 2. * stiff.mu) + compliance);
    const double pressure = press * stiffness;
    const Vector field = impact.contact->pressure_field({solution, force, 1.});
    double       worst = 0., n = 0.;
    for (const auto i : field.locally_owned_elements())
      if (const double value = field(i); value != 0.)
        {
          worst = std::max(worst, std::abs(value / pressure - 1.));
          ++n;
        }
    worst = dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD);
    // Cut faces have output on both sides.
    BOOST_CHECK_EQUAL(dealii::Utilities::MPI::sum(n, MPI_COMM_WORLD),
                      coupling == "cut faces"
                        ? n_lower + n_upper + 2
                        : (lower_is_slave ? n_lower : n_upper) + 1);
    return worst;
  }
} // namespace

// Mortar methods pass it on any meshes. The others converge only in the mean.
BOOST_AUTO_TEST_CASE(blocks_that_do_not_match)
{
  for (const std::string treatment :
       {"Signorini active set", "standard normal compliance"})
    for (const auto &[n_lower, n_upper] :
         std::vector<std::pair<unsigned int, unsigned int>>{{4, 4},
                                                            {8, 5},
                                                            {5, 13},
                                                            {1, 7}})
      for (const bool lower_is_slave : {true, false})
        for (const CellShape shape :
             {CellShape::triangles, CellShape::quadrilaterals})
          {
            const auto error = [&](const std::string &coupling) {
              return worst_error_between_blocks(treatment,
                                                1.,
                                                coupling,
                                                n_lower,
                                                n_upper,
                                                lower_is_slave,
                                                shape);
            };
            const double of_points = error("points"),
                         of_mortar = error("mortar"),
                         of_dual   = error("dual mortar");
            BOOST_TEST_MESSAGE(
              treatment << ", " << n_lower << " / " << n_upper << " cells, "
                        << (lower_is_slave ? "lower" : "upper") << " is slave, "
                        << (shape == CellShape::triangles ? "triangles"
                                                          : "quadrilaterals")
                        << ": points " << of_points << ", mortar " << of_mortar
                        << ", dual " << of_dual);
            BOOST_CHECK_LT(of_mortar, 1e-10);
            BOOST_CHECK_LT(of_dual, 1e-10);
          }
}

// The same for treatments that integrate over faces.
BOOST_AUTO_TEST_CASE(blocks_with_cut_faces)
{
  const std::vector<std::pair<std::string, double>> treatments = {
    {"Nitsche", 1.},
    {"Nitsche", 0.},
    {"Nitsche", -1.},
    {"penalty", 1.},
    {"proximal augmented Lagrangian", 1.}};
  for (const auto &[treatment, theta] : treatments)
    for (const auto &[n_lower, n_upper] :
         std::vector<std::pair<unsigned int, unsigned int>>{{4, 4},
                                                            {5, 13},
                                                            {1, 7}})
      for (const bool lower_is_slave : {true, false})
        for (const CellShape shape :
             {CellShape::triangles, CellShape::quadrilaterals})
          {
            const double error = worst_error_between_blocks(treatment,
                                                            theta,
                                                            "cut faces",
                                                            n_lower,
                                                            n_upper,
                                                            lower_is_slave,
                                                            shape);
            BOOST_TEST_MESSAGE(treatment << ", theta " << theta << ", "
                                         << n_lower << " / " << n_upper
                                         << " cells: " << error);
            BOOST_CHECK_LT(error, 1e-10);
          }
}

BOOST_AUTO_TEST_SUITE_END()


// Half a minute, in release builds only.
BOOST_AUTO_TEST_SUITE(hertz_contact)

BOOST_AUTO_TEST_CASE(two_cylinders)
{
  std::map<std::string, CylinderErrors> fine;
  for (const std::string coupling : {"points", "mortar", "dual mortar"})
    {
      const CylinderErrors coarse = hertz_of_cylinders(coupling, 48);
      fine[coupling]              = hertz_of_cylinders(coupling, 96);
      BOOST_TEST_MESSAGE(
        coupling << ": order of the pressure "
                 << std::log2(coarse.pressure / fine[coupling].pressure));
      BOOST_CHECK_LT(fine[coupling].radius, .03);
      BOOST_CHECK_LT(fine[coupling].peak, .03);
      BOOST_CHECK_LT(fine[coupling].pressure, coarse.pressure);
    }
  for (const std::string coupling : {"mortar", "dual mortar"})
    {
      BOOST_CHECK_LT(fine[coupling].pressure, .5 * fine["points"].pressure);
      BOOST_CHECK_LT(fine[coupling].oscillation, fine[coupling].pressure);
    }
}

BOOST_AUTO_TEST_CASE(hertz_is_approached)
{
  const HertzErrors coarse = hertz(1.5), fine = hertz(4.);
  // Far from the contact the half sphere is not the half space of the theory: of
  // the order of contact radius / radius, here 2 %.
  for (const auto &error : {fine.force, fine.radius, fine.peak})
    BOOST_CHECK_LT(std::abs(error), .05);
  BOOST_CHECK_LT(std::abs(fine.peak), std::abs(coarse.peak));
  BOOST_CHECK_LT(std::abs(fine.radius), std::abs(coarse.radius));
}

BOOST_AUTO_TEST_SUITE_END()
