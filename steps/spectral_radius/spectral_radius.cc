// SPDX-License-Identifier: LGPL-2.1-or-later

// # Spectral radii of the time schemes
//
// How much does a time scheme damp a vibration that it cannot resolve? At an
// impact many of them begin at once: those of the elements next to the
// obstacle, whose periods are shorter than the time step. A scheme that never
// damps them shows them in the pressure throughout; one that damps too much
// dissipates energy that it should keep. The question has an answer without any
// contact (paper C, sections 3.2.1 and 3.3, figures 3 and 4).
//
// ## The problem
//
// A linear body without load, $M \ddot U + K U = 0$, falls apart into its
// vibrations. Each of them is an oscillator of its own (C (25)),
//
// $$ m \ddot u + k u = 0, \qquad \omega^2 = k/m , $$
//
// and a linear time scheme treats each as if it were alone. So it is enough to
// study the scheme for one oscillator, as a function of $\omega \Delta t$.
//
// ## One step of this program
//
// A step maps the state $Y = (u, \Delta t\, \dot u, \Delta t^2 \ddot u)$
// linearly to the next one (C (29)):
//
// $$ Y_{n+1} = A(\omega \Delta t) \, Y_n . $$
//
// $A$ is the **amplification matrix**, and its **spectral radius** $\rho$, the
// largest modulus of its eigenvalues (C (30)), is the factor by which a
// vibration shrinks in a step after many of them. $\rho \le 1$ for all
// $\omega \Delta t$ means that the scheme is stable with any step. For small
// $\omega \Delta t$ it should be one: what is resolved is kept. For large
// $\omega \Delta t$ it should be less.
//
// The matrices are not typed in from the paper (C (37)): each column is one
// step of the same integrator that the benchmarks use, from a unit state. With
// HHT (C (24), `lib/time_integration/generalised_alpha.cc`) that is
//
// $$ u_1 = u_0 + \Delta t\, \dot u_0
//    + \Delta t^2 \big( (\tfrac12 - \beta) \ddot u_0 + \beta \ddot u_1 \big),
//    \qquad
//    \dot u_1 = \dot u_0 + \Delta t \big( (1 - \gamma) \ddot u_0
//    + \gamma \ddot u_1 \big), $$
//
// $$ m \ddot u_1 + (1 - \alpha)\, k u_1 + \alpha\, k u_0 = 0, \qquad
//    \beta = \tfrac14 (1 + |\alpha|)^2, \quad \gamma = \tfrac12 + |\alpha| . $$
//
// Crank-Nicolson is $\alpha = 0$; TR-BDF2 (C (33)) has its equations in the
// introduction of the program bar_ss, BDF2 in `lib/time_integration/backward_difference.h`. In
// the limit of large $\omega \Delta t$ the spectral radii are
//
// $$ \rho_\infty = \frac{1 - |\alpha|}{1 + |\alpha|} \;\text{(HHT)}, \qquad
//    1 \;\text{(Crank-Nicolson)}, \qquad 0 \;\text{(TR-BDF2, BDF2)}. $$
//
// The generalised-alpha method (Chung and Hulbert 1993) is made for a limit that
// is given; its formulas stand in `lib/time_integration/generalised_alpha.h`.
//
// (The paper's $(1 - |\alpha|^2)/(1 + |\alpha|)^2$ after C (32) is the same
// number.)
//
// The program also integrates the oscillator over a fixed time with smaller and
// smaller steps, from which the **order** of each scheme follows: the exponent
// of $\Delta t$ in the error. It is 2 for Crank-Nicolson, HHT with $\alpha > 0$,
// generalised-alpha, TR-BDF2 and BDF2. For $\alpha < 0$ it is 1, whatever C (28) says: second order
// takes $\gamma = \tfrac12 + \alpha$ with the sign of $\alpha$, and what is
// used is $\gamma = \tfrac12 + |\alpha|$.
//
// ## Run it
//
//     spectral_radius
//     spectral_radius --set "Spectrum/Points=50"
//
// The first prints the spectral radii for $(\omega \Delta t)^2 = 10^7$ beside
// their limits, and the orders.

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
  spectral_radius(Impact<1>   &oscillator,
                  const double time_step,
                  const bool   of_two_steps) const;

  double
  error(Impact<1>         &oscillator,
        const double       final_time,
        const unsigned int n_steps) const;

  double              smallest = 1e-3, largest = 1e7;
  unsigned int        n_points = 201;
  std::vector<double> alphas   = {.02, -.02, .05, -.05, .1, -.1};
  std::vector<double> radii    = {.9, .5, 0.};
  double trbdf2_gamma = TimeScheme::Parameters().values["TR-BDF2 gamma"];

  // The one unknown that moves: the left end of a bar of one linear element, of
  // which the other end is held. The mass of its hat function is
  // $m = \int_0^1 (1 - x)^2 dx = 1/3$, the stiffness $k = 1$.
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
  prm.add_parameter("Spectral radii",
                    radii,
                    "Values of the limit for the generalised-alpha method.",
                    Patterns::List(Patterns::Double(0., 1.)));
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
  scheme.values["TR-BDF2 gamma"] = trbdf2_gamma;
  std::vector<Entry> entries     = {{"Crank-Nicolson", scheme}};
  scheme.name                    = "HHT";
  for (const double alpha : alphas)
    {
      scheme.values["HHT alpha"] = alpha;
      entries.push_back({"HHT " + to_text(alpha), scheme});
    }
  scheme.name = "generalised-alpha";
  for (const double radius : radii)
    {
      scheme.values["Spectral radius"] = radius;
      entries.push_back({"generalised-alpha " + to_text(radius), scheme});
    }
  for (const std::string name : {"TR-BDF2", "BDF2"})
    {
      scheme.name = name;
      entries.push_back({name, scheme});
    }
  return entries;
}



// ## The oscillator
//
// The oscillator is a bar like the others, with an obstacle that it never
// reaches.
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



// ## The amplification matrix
//
// One step from each of the three unit states, $u = 1$, $\Delta t\, \dot u = 1$
// and $\Delta t^2 \ddot u = 1$, gives the three columns of $A$. The states need
// not belong to a motion; the scheme does not depend on that. The state of BDF2 also
// has displacement and velocity of the step before: there $A$ has five columns.
double
SpectralRadius::spectral_radius(Impact<1>   &oscillator,
                                const double time_step,
                                const bool   of_two_steps) const
{
  std::vector<Ricochet::Vector State::*> parts = {&State::solution,
                                                  &State::velocity,
                                                  &State::acceleration};
  std::vector<double> scale = {1., time_step, time_step * time_step};
  if (of_two_steps)
    {
      parts.insert(parts.end(),
                   {&State::solution_before, &State::velocity_before});
      scale.insert(scale.end(), {1., time_step});
    }
  const unsigned int     n = parts.size();
  Eigen::MatrixXd        amplification(n, n);
  const Ricochet::Vector zero = oscillator.body.make_vector();
  for (unsigned int column = 0; column < n; ++column)
    {
      State state = oscillator.system.initial_state(zero, zero, 0.), new_state;
      if (of_two_steps)
        {
          state.solution_before = state.velocity_before = zero;
          state.step_before                             = time_step;
        }
      (state.*parts[column])(left) = 1. / scale[column];
      (state.*parts[column]).compress(VectorOperation::insert);

      oscillator.scheme->step(oscillator.system, state, time_step, new_state);
      for (unsigned int row = 0; row < n; ++row)
        amplification(row, column) = (new_state.*parts[row])(left)*scale[row];
    }
  return amplification.eigenvalues().cwiseAbs().maxCoeff();
}



// ## The order
//
// Free vibration from $u = 1$ at rest is $u = \cos(\omega t)$. The error is the
// difference from it at the final time.
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
      for (unsigned int i = 0; i < entries.size(); ++i)
        rows.back().push_back(
          spectral_radius(*oscillators[i],
                          std::sqrt(omega_tilde * mass / stiffness),
                          entries[i].scheme.name == "BDF2"));
    }
  write("spectral_radii.csv", "omega_tilde [1]", rows);
  folder.log("spectral radius at (omega dt)^2 = " +
             std::to_string(rows.back()[0]));
  for (unsigned int i = 0; i < entries.size(); ++i)
    {
      const auto &[name, values] = entries[i].scheme;
      const double alpha         = std::abs(values["HHT alpha"]);
      const double limit         = name == "HHT" ? (1. - alpha) / (1. + alpha)
                : name == "generalised-alpha"    ? values["Spectral radius"]
                : name != "Crank-Nicolson"       ? 0.
                                                 : 1.;
      char         line[120];
      std::snprintf(line,
                    sizeof(line),
                    "%21s %14.8f   limit %14.8f",
                    entries[i].name.c_str(),
                    rows.back()[i + 1],
                    limit);
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
                    "%21s order %6.3f",
                    entries[i].name.c_str(),
                    std::log2(rows[rows.size() - 2][i + 1] /
                              rows.back()[i + 1]));
      folder.log(line);
    }
}



int
main(int argc, char **argv)
{
  return run_program<SpectralRadius>(
    argc,
    argv,
    "spectral_radius",
    "Spectral radii and orders of the time schemes (paper C, figures 3 and "
    "4).");
}
