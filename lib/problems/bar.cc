// SPDX-License-Identifier: LGPL-2.1-or-later
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <output/node_probe.h>
#include <problems/bar.h>

#include <deal.II/grid/grid_generator.h>
#include <deal.II/numerics/vector_tools.h>

#include <cmath>

namespace Ricochet
{
  using namespace dealii;

  void
  BarParameters::add_parameters(ParameterHandler &parameters)
  {
    impact.add_parameters(parameters);
    parameters.enter_subsection("Mesh");
    parameters.add_parameter("Mesh size",
                             mesh_size,
                             "Length h of an element (m); it must divide the "
                             "length 1 of the bar.",
                             Patterns::Double(1e-6, 1.));
    parameters.add_parameter("Degree",
                             degree,
                             "Polynomial degree of the displacement.",
                             Patterns::Integer(1, 6));
    parameters.leave_subsection();
  }



  void
  BarParameters::validate() const
  {
    impact.validate();
    // The exact solution is stored for each unit of time, with four numbers.
    impact.check_size(degree / mesh_size,
                      1,
                      impact.time.final_time * 4. * sizeof(double));

    const double n_elements = 1. / mesh_size;
    if (std::abs(n_elements - std::round(n_elements)) > 1e-9 * n_elements)
      {
        const int below = static_cast<int>(n_elements);
        throw InputError("The mesh size " + to_text(mesh_size) +
                         " does not divide the bar of length 1. The nearest "
                         "that do are 1/" +
                         std::to_string(below) + " and 1/" +
                         std::to_string(below + 1) + ".");
      }
  }



  void
  make_bar_grid(const double                        mesh_size,
                parallel::shared::Triangulation<1> &triangulation)
  {
    GridGenerator::subdivided_hyper_cube(triangulation,
                                         static_cast<unsigned int>(
                                           std::round(1. / mesh_size)));
    for (const auto &cell : triangulation.active_cell_iterators())
      for (const auto &face : cell->face_iterators())
        if (face->at_boundary())
          face->set_boundary_id(face->center()[0] < .5 ? BarEnds::left
                                                       : BarEnds::right);
  }



  void
  add_bar_end_columns(const types::boundary_id end,
                      const Body<1>           &body,
                      BarCharacteristics      &exact,
                      TimeLoop                &loop)
  {
    const std::string name = end == BarEnds::left ? "left" : "right";
    const Point<1>    x(end == BarEnds::left ? 0. : 1.);
    const auto        probe = std::make_shared<NodeProbe<1>>(body, x);

    loop.add_column("displacement_" + name, "m", [probe](const State &state) {
      return probe->value(state.solution);
    });
    loop.add_column("velocity_" + name, "m/s", [probe](const State &state) {
      return probe->value(state.velocity);
    });
    loop.add_column("exact_displacement_" + name,
                    "m",
                    [&exact, x](const State &state) {
                      exact.set_time(state.time);
                      return exact.value(x);
                    });
    loop.add_column("exact_velocity_" + name,
                    "m/s",
                    [&exact, x](const State &state) {
                      exact.set_time(state.time);
                      return exact.velocity(x[0]);
                    });
    loop.add_column("exact_pressure_" + name,
                    "Pa",
                    [&exact, end](const State &state) {
                      exact.set_time(state.time);
                      return exact.end_pressure(end);
                    });
  }



  void
  add_bar_error_column(const Body<1>      &body,
                       BarCharacteristics &exact,
                       TimeLoop           &loop)
  {
    // Kinks of the exact solution start in the ends of the bar, of unit length
    // and unit wave speed, at integer times. They lie on nodes when the time is a
    // multiple of the mesh size; a finer rule takes care of other times.
    const QGauss<1>    rule(body.dof_handler().get_fe().degree + 1);
    const QIterated<1> finer_rule(rule, 4);
    loop.add_column(
      "h1_error",
      "1",
      [&body, &exact, rule, finer_rule](const State &state) {
        exact.set_time(state.time);
        const auto &triangulation = body.dof_handler().get_triangulation();
        dealii::Vector<double> cell_errors(triangulation.n_active_cells());
        const double cells = state.time * triangulation.n_global_active_cells();
        const bool kinks_on_nodes = std::abs(cells - std::round(cells)) < 1e-6;
        VectorTools::integrate_difference(
          body.mapping(),
          body.dof_handler(),
          body.displacement_part(state.solution),
          exact,
          cell_errors,
          kinks_on_nodes ? static_cast<const Quadrature<1> &>(rule)
                         : finer_rule,
          VectorTools::H1_norm);
        return VectorTools::compute_global_error(triangulation,
                                                 cell_errors,
                                                 VectorTools::H1_norm);
      });
  }



  double
  bar_error_norm(const double time_step, const TimeLoop &loop)
  {
    const EnergyLedger &ledger = loop.energy_ledger();
    const unsigned int  column = ledger.column_number("h1_error");
    double              sum    = 0.;
    for (unsigned int n = 1; n < ledger.rows().size(); ++n)
      sum += ledger.rows()[n][column] * ledger.rows()[n][column];
    return std::sqrt(time_step * sum);
  }
} // namespace Ricochet
