// SPDX-License-Identifier: LGPL-2.1-or-later

// # Spectral radii of the time schemes
//
// How much does a time scheme damp a vibration that it cannot resolve? For an
// oscillator m u'' + k u = 0 a step maps the state (u, dt u', dt^2 u'') linearly
// to the next one; the largest modulus of the eigenvalues of this
// amplification matrix, as a function of (omega dt)^2 = k/m dt^2, is the answer
// (paper C, sections 3.2.1 and 3.3, figures 3 and 4).
//
// The matrices are not typed in from the paper: each of their columns is one
// step of the very integrator that the benchmarks use, from a unit state. The
// oscillator is a bar of one linear element that is held at its right end and
// far from any obstacle: m = 1/3 and k = 1 in its left end.
//
// The program also integrates the oscillator over a fixed time with smaller and
// smaller steps, and writes the errors, from which the order of each scheme
// follows: 2 for Crank-Nicolson, HHT with alpha > 0 and TR-BDF2. For alpha < 0
// with gamma = 1/2 + |alpha| it is 1, whatever paper C, (28), says.
//
// Run it as
//
//     spectral_radius
//     spectral_radius --set "Spectrum/Points=50"
//
// The limits for large (omega dt)^2 are (1 - |alpha|)/(1 + |alpha|) for HHT, 1
// for Crank-Nicolson and 0 for TR-BDF2.

#include <contact/obstacles/half_space.h>
#include <base/exceptions.h>
#include <base/parameter_file.h>
#include <base/program.h>
#include <problems/bar.h>

#include <deal.II/grid/grid_generator.h>

#include <Eigen/Eigenvalues>

#include <cmath>
#include <sstream>

using namespace dealii;
using namespace Ricochet;

class SpectralRadius
{
public:
  void
  add_parameters(ParameterHandler &prm);

  /// @throws InputError
  void
  validate() const;

  void
  run(RunFolder &folder);

private:
  /// A scheme and its name in the tables.
  struct Entry
  {
    std::string            name;
    TimeScheme::Parameters scheme;
  };

  std::vector<Entry>
  schemes() const;

  std::unique_ptr<Impact<1>>
  make_oscillator(const Triangulation<1>       &triangulation,
                  const TimeScheme::Parameters &scheme,
                  const MPI_Comm                communicator) const;

  double
  spectral_radius(Impact<1> &oscillator, const double time_step) const;

  double
  error(Impact<1>         &oscillator,
        const double       final_time,
        const unsigned int n_steps) const;

  double              smallest = 1e-3, largest = 1e7;
  unsigned int        n_points     = 201;
  std::vector<double> alphas       = {.02, -.02, .05, -.05, .1, -.1};
  double              trbdf2_gamma = TimeScheme::Parameters().trbdf2_gamma;

  // The one unknown that moves: the left end. The other one is held.
  static constexpr types::global_dof_index left = 0;
  static constexpr double                  mass = 1. / 3., stiffness = 1.;
};



void
SpectralRadius::add_parameters(ParameterHandler &prm)
{
  prm.enter_subsection("Spectrum");
  prm.add_parameter("Smallest omega tilde",
                    smallest,
                    "Smallest value of (omega dt)^2.",
                    Patterns::Double(1e-12));
  prm.add_parameter("Largest omega tilde",
                    largest,
                    "Largest value of (omega dt)^2.",
                    Patterns::Double(1e-12, 1e12));
  prm.add_parameter("Points",
                    n_points,
                    "Number of values, equally spaced in the logarithm.",
                    Patterns::Integer(2, 100000));
  prm.add_parameter("HHT alphas",
                    alphas,
                    "Values of alpha for HHT.",
                    Patterns::List(Patterns::Double(-1. / 3., 1. / 3.)));
  prm.add_parameter("TR-BDF2 gamma",
                    trbdf2_gamma,
                    "Parameter gamma of TR-BDF2.",
                    Patterns::Double(.01, .99));
  prm.set("TR-BDF2 gamma", "0.5857864376269049");
  prm.leave_subsection();
}



void
SpectralRadius::validate() const
{
  if (!(smallest < largest))
    throw InputError("Smallest omega tilde, " + to_text(smallest) +
                     ", must be less than largest omega tilde, " +
                     to_text(largest) + ".");
}



std::vector<SpectralRadius::Entry>
SpectralRadius::schemes() const
{
  TimeScheme::Parameters scheme;
  scheme.trbdf2_gamma        = trbdf2_gamma;
  std::vector<Entry> entries = {{"Crank-Nicolson", scheme}};
  scheme.name                = "HHT";
  for (const double alpha : alphas)
    {
      scheme.hht_alpha = alpha;
      entries.push_back({"HHT " + to_text(alpha), scheme});
    }
  scheme.name = "TR-BDF2";
  entries.push_back({"TR-BDF2", scheme});
  return entries;
}



std::unique_ptr<Impact<1>>
SpectralRadius::make_oscillator(const Triangulation<1>       &triangulation,
                                const TimeScheme::Parameters &scheme,
                                const MPI_Comm communicator) const
{
  ImpactParameters parameters;
  // Away from the obstacle, the penalty method adds nothing at all; each step
  // length needs one factorisation, which is not needed again.
  parameters.contact.treatment    = "penalty";
  parameters.linear_solver.n_kept = 1;
  parameters.scheme               = scheme;
  ImpactSetup<1> setup{LinearElastic{0., .5}};
  setup.clamped   = {BarEnds::right};
  setup.obstacles = {
    {BarEnds::left, half_space_at_rest<1>(Point<1>(-1e6), Tensor<1, 1>({1.}))}};
  return std::make_unique<Impact<1>>(parameters,
                                     triangulation,
                                     setup,
                                     communicator);
}



// One step from each of the three unit states gives the three columns of the
// amplification matrix.
double
SpectralRadius::spectral_radius(Impact<1>   &oscillator,
                                const double time_step) const
{
  const double           scale[3] = {1., time_step, time_step * time_step};
  Eigen::Matrix3d        amplification;
  const Ricochet::Vector zero = oscillator.body.make_vector();
  for (unsigned int column = 0; column < 3; ++column)
    {
      State state = oscillator.system.initial_state(zero, zero, 0.), new_state;
      Ricochet::Vector *parts[3] = {&state.solution,
                                    &state.velocity,
                                    &state.acceleration};
      (*parts[column])(left)     = 1. / scale[column];
      parts[column]->compress(VectorOperation::insert);

      oscillator.scheme->step(oscillator.system, state, time_step, new_state);
      amplification(0, column) = new_state.solution(left) * scale[0];
      amplification(1, column) = new_state.velocity(left) * scale[1];
      amplification(2, column) = new_state.acceleration(left) * scale[2];
    }
  return amplification.eigenvalues().cwiseAbs().maxCoeff();
}



// Free vibration from u = 1 at rest: u = cos(omega t).
double
SpectralRadius::error(Impact<1>         &oscillator,
                      const double       final_time,
                      const unsigned int n_steps) const
{
  Ricochet::Vector displacement = oscillator.body.make_vector();
  Ricochet::Vector velocity     = displacement;
  displacement(left)            = 1.;
  displacement.compress(VectorOperation::insert);
  State state = oscillator.system.initial_state(displacement, velocity, 0.);
  State new_state;
  for (unsigned int n = 0; n < n_steps; ++n)
    {
      oscillator.scheme->step(oscillator.system,
                              state,
                              final_time / n_steps,
                              new_state);
      std::swap(state, new_state);
    }
  return std::abs(state.solution(left) -
                  std::cos(std::sqrt(stiffness / mass) * final_time));
}



void
SpectralRadius::run(RunFolder &folder)
{
  // A system with one unknown has no use for more than one rank: each rank
  // computes the same, and rank 0 writes.
  Triangulation<1> triangulation;
  GridGenerator::hyper_cube(triangulation, 0., 1., /* colorize */ true);

  const std::vector<Entry>                entries = schemes();
  std::vector<std::unique_ptr<Impact<1>>> oscillators;
  for (const Entry &entry : entries)
    oscillators.push_back(
      make_oscillator(triangulation, entry.scheme, MPI_COMM_SELF));

  const auto write = [&](const std::string                      &name,
                         const std::string                      &first_column,
                         const std::vector<std::vector<double>> &rows) {
    std::ostringstream out;
    out.precision(15);
    out << first_column;
    for (const Entry &entry : entries)
      out << "," << entry.name << " [1]";
    out << "\n";
    for (const auto &row : rows)
      for (unsigned int i = 0; i < row.size(); ++i)
        out << row[i] << (i + 1 < row.size() ? "," : "\n");
    on_first_rank(folder.communicator,
                  [&]() { write_atomically(folder.file(name), out.str()); });
  };
  folder.begin();

  std::vector<std::vector<double>> rows;
  for (unsigned int p = 0; p < n_points; ++p)
    {
      const double omega_tilde =
        smallest * std::pow(largest / smallest, p / (n_points - 1.));
      rows.push_back({omega_tilde});
      for (const auto &oscillator : oscillators)
        rows.back().push_back(
          spectral_radius(*oscillator,
                          std::sqrt(omega_tilde * mass / stiffness)));
    }
  write("spectral_radii.csv", "omega_tilde [1]", rows);
  folder.log("spectral radius at (omega dt)^2 = " +
             std::to_string(rows.back()[0]));
  for (unsigned int i = 0; i < entries.size(); ++i)
    {
      const bool   hht   = entries[i].scheme.name == "HHT";
      const double alpha = std::abs(entries[i].scheme.hht_alpha);
      char         line[120];
      std::snprintf(line,
                    sizeof(line),
                    "%16s %14.8f   limit %14.8f",
                    entries[i].name.c_str(),
                    rows.back()[i + 1],
                    hht ? (1. - alpha) / (1. + alpha)
                      : entries[i].name == "TR-BDF2" ? 0.
                                                     : 1.);
      folder.log(line);
    }

  const double final_time = 2.;
  rows.clear();
  folder.log("error of an oscillator at t = 2 against the time step");
  for (unsigned int n_steps = 40; n_steps <= 1280; n_steps *= 2)
    {
      rows.push_back({final_time / n_steps});
      for (const auto &oscillator : oscillators)
        rows.back().push_back(error(*oscillator, final_time, n_steps));
    }
  write("oscillator_order.csv", "time_step [s]", rows);
  for (unsigned int i = 0; i < entries.size(); ++i)
    {
      char line[120];
      std::snprintf(line,
                    sizeof(line),
                    "%16s order %6.3f",
                    entries[i].name.c_str(),
                    std::log2(rows[rows.size() - 2][i + 1] /
                              rows.back()[i + 1]));
      folder.log(line);
    }
}



int
main(int argc, char **argv)
{
  SpectralRadius program;
  return run_program(
    argc,
    argv,
    {"spectral_radius",
     "Spectral radii and orders of the time schemes (paper C, figures 3 and "
     "4).",
     [&](ParameterHandler &prm) { program.add_parameters(prm); },
     [&]() { program.validate(); },
     [&](RunFolder &folder) { program.run(folder); }});
}
