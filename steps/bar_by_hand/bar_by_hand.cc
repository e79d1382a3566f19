// SPDX-License-Identifier: LGPL-2.1-or-later

// # A bar by hand
//
// The benchmark 1D-SD of the program bar_sd (paper C, section 4.1) without the library: an
// elastic bar, held at its right end, hits an obstacle with its left end. Mass and stiffness,
// three treatments of contact, Newton's method, two time schemes and the balance of energy, to
// be read from top to bottom. The problem is explained in bar_sd, whose numbers this program
// reproduces to round-off (`tests/integration/test_by_hand.py`).
//
// The bar has unit length, modulus and density. With piecewise linear functions on $n$ elements
// of length $h$ the displacements $U = (U_0, \dots, U_n)$ of the nodes obey
// $M \ddot U + K U + F_c(U) = 0$ and $U_n = 0$ (C (22)). Contact acts through two linear
// functions of $U$: the gap $g = U_0$, positive when the bar is apart from the obstacle, and the
// pressure $p(U) = -u_x(0) = (U_0 - U_1)/h$ of the stress in the first element. The contact
// pressure $p_c$ obeys Signorini's condition (A (2.1)): $g \ge 0$, $p_c \ge 0$, $p_c\, g = 0$.
//
// ## Run it
//
//     bar_by_hand parameter_files/bar_by_hand/default.prm
//     bar_by_hand --set "Time/Scheme=midpoint" --set "Contact/Treatment=Signorini active set"
//
// The modified energy of the first run is 0.12375 J, 0.12366 J during the first contact, and
// 0.12548 J after it: Crank-Nicolson keeps it except where contact begins or ends.

#include <base/exceptions.h>
#include <base/program.h>
#include <output/energy_ledger.h>

#include <deal.II/lac/full_matrix.h>
#include <deal.II/lac/vector.h>

using namespace dealii;
using namespace Ricochet;

struct BarByHand
{
  // ## Parameters, with the names that they have in bar_sd
  double      h = .05, final_time = 12., dt = .05; // m, s, s
  std::string scheme = "Crank-Nicolson", treatment = "Nitsche";
  double      gamma_0 = 5., epsilon_0 = .2; // Pa, 1/Pa

  void
  add_parameters(ParameterHandler &prm)
  {
    const auto add = [&](std::string name, auto &x, auto text, auto pattern) {
      prm.enter_subsection(name.substr(0, name.find('/')));
      prm.add_parameter(name.substr(name.find('/') + 1), x, text, pattern);
      prm.leave_subsection();
    };
    const Patterns::Double    positive(1e-30), size(2e-3, .5);
    const Patterns::Selection schemes("Crank-Nicolson|midpoint"),
      treatments("Nitsche|penalty|Signorini active set");
    add("Mesh/Mesh size", h, "Length h of an element (m).", size);
    add("Time/Final time", final_time, "End of the run (s).", positive);
    add("Time/Time step", dt, "Length of a step (s).", positive);
    add("Time/Scheme", scheme, "Time scheme.", schemes);
    add("Contact/Treatment", treatment, "Treatment of contact.", treatments);
    add("Contact/Nitsche gamma0", gamma_0, "gamma h of C (7) (Pa).", positive);
    add("Contact/Penalty epsilon0", epsilon_0, "epsilon/h (1/Pa).", positive);
  }

  void
  validate() const
  {
    if (std::abs(1. / h - std::round(1. / h)) > 1e-9 / h)
      throw InputError("The mesh size does not divide the bar of length 1.");
    if (final_time > 1e8 * dt || dt > (1. + 1e-9) * final_time)
      throw InputError("The run must have between one and 1e8 time steps.");
    if (treatment == "Nitsche" && gamma_0 <= 1.)
      throw InputError("Nitsche gamma0 must exceed the modulus of 1 Pa.");
  }

  std::vector<UnusedParameter>
  unused_parameters() const
  {
    std::vector<UnusedParameter> unused;
    if (treatment != "Nitsche")
      unused.push_back({"Contact/Nitsche gamma0", "Nitsche"});
    if (treatment != "penalty")
      unused.push_back({"Contact/Penalty epsilon0", "penalty"});
    return unused;
  }

  // ## Mass and stiffness
  //
  // In an element $\int N_i N_j = h/6\, (2\; 1;\, 1\; 2)$ and
  // $\int N_i' N_j' = 1/h\, (1\; {-1};\, {-1}\; 1)$. The last node is held: its row and column
  // have a diagonal entry only, and with $U_n = 0$ its residual is zero.
  FullMatrix<double>     mass, stiffness, tangent;
  dealii::Vector<double> U, U_old, U_w, U_hat;   // m
  dealii::Vector<double> V, A, A_old;            // m/s, m/s^2
  dealii::Vector<double> residual, F_c, F_c_old; // N

  void
  make_matrices()
  {
    const unsigned int n = std::round(1. / h);
    mass = stiffness = tangent = FullMatrix<double>(n + 1, n + 1);
    U = V = A = residual = F_c = dealii::Vector<double>(n + 1);
    for (unsigned int cell = 0; cell < n; ++cell)
      for (const unsigned int i : {cell, cell + 1})
        for (const unsigned int j : {cell, cell + 1})
          if (i == j || std::max(i, j) < n)
            {
              mass(i, j) += h / (i == j ? 3. : 6.);
              stiffness(i, j) += (i == j ? 1. : -1.) / h;
            }
  }

  // ## Contact
  //
  // A treatment adds its force to the residual and the derivative of that to the tangent, and
  // notes force, pressure and potential for the energy table.
  double pressure = 0., potential = 0.; // Pa, J
  bool   active = false;

  // **Nitsche's method** (C (6) to (9), symmetric): $q = p(U) - \gamma g$, $\gamma = \gamma_0/h$,
  //
  // $$ F_c[v] = -[q]_+\, v(0) + \big( [q]_+ - p(U_w) \big)\, p(v) / \gamma . $$
  //
  // The linear part is taken where $K$ is, at $U_w$ (see below), the other one, whose potential
  // is convex, at the end of the step: the modified energy never grows over a midpoint step.
  void
  add_nitsche(const double w)
  {
    const double p_U = (U(0) - U(1)) / h, p_w = (U_w(0) - U_w(1)) / h;
    const double gamma = gamma_0 / h, q = p_U - gamma * U(0);
    active           = q > 0.;
    pressure         = active ? q : 0.;
    potential        = (pressure * pressure - p_U * p_U) / (2. * gamma);
    const double g[] = {1., 0.}, p[] = {1. / h, -1. / h};
    const double dq[] = {active * (p[0] - gamma), active * p[1]}; // slope
    for (const unsigned int i : {0, 1})
      F_c(i) = -pressure * g[i] + (pressure - p_w) / gamma * p[i];
    for (const unsigned int i : {0, 1})
      for (const unsigned int j : {0, 1})
        tangent(i, j) += -dq[j] * g[i] + (dq[j] - w * p[j]) / gamma * p[i];
    residual += F_c;
  }

  // **Penalty** (C (14) to (17)): a spring, $p_c = [-g]_+/\epsilon$, $\epsilon = \epsilon_0 h$.
  void
  add_penalty()
  {
    const double epsilon = epsilon_0 * h;
    active               = U(0) < 0.;
    pressure             = active ? -U(0) / epsilon : 0.;
    potential            = .5 * epsilon * pressure * pressure;
    F_c(0)               = -pressure;
    tangent(0, 0) += active / epsilon;
    residual += F_c;
  }

  // **Primal-dual active set** (B, section 5): for any $r > 0$ Signorini's condition is
  // $p_c = [\,p_c - r g\,]_+$. The end is active when $p_c - r g > 0$: then $g
  // = 0$ replaces its row, and $p_c$ is the residual of this row without
  // contact.
  void
  add_active_set()
  {
    const double r = 1. / h, reaction = active ? residual(0) : 0.;
    active   = reaction - r * U(0) > 0.;
    pressure = active ? reaction : 0.;
    F_c(0)   = -pressure;
    if (!active)
      return;
    residual(0)   = r * U(0);
    tangent(0, 0) = r;
    tangent(0, 1) = 0.;
  }

  void
  add_contact(const double w)
  {
    if (treatment == "Nitsche")
      add_nitsche(w);
    else if (treatment == "penalty")
      add_penalty();
    else
      add_active_set();
  }

  // ## Newton's method
  //
  // A step of either scheme is one nonlinear system, $m\, M (U - \hat U) + K U_w + F_c = 0$ with
  // $U_w = w\, U + (1 - w)\, U_{old}$. All but the state of contact is linear: the solution is
  // found when this state is that of the tangent. One point has two, and none is tried twice.
  void
  solve(const double m, const double w)
  {
    for (unsigned int n_solves = 0; n_solves < 5; ++n_solves)
      {
        U_w.equ(w, U);
        U_w.add(1. - w, U_old);
        A.equ(m, U);
        A.add(-m, U_hat);
        mass.vmult(residual, A);
        stiffness.vmult_add(residual, U_w);
        tangent.equ(m, mass, w, stiffness);
        const bool was_active = active;
        add_contact(w);
        if (n_solves > 0 && active == was_active)
          return;
        tangent.gauss_jordan(); // now the inverse
        auto change(U);
        tangent.vmult(change, residual);
        U -= change;
      }
    throw ComputationError("Newton's method has not converged.");
  }

  // ## Time
  //
  // With a weight $a$ of the new acceleration both schemes are $M A + K U_w + F_c = 0$ with
  //
  // $$ U = U_{old} + \tfrac{\Delta t}{2} (V_{old} + V), \qquad
  //    V = V_{old} + \Delta t \big( (1 - a) A_{old} + a A \big), $$
  //
  // that is $A = m (U - \hat U)$, $m = 2/(a \Delta t^2)$. Crank-Nicolson (C (24) with $\alpha = 0$)
  // has $a = 1/2$, $w = 1$ and $A$ at the end of the step, the midpoint scheme (A (3.2)) $a = 1$,
  // $w = 1/2$ and $A$ of the whole step. Times $U - U_{old}$ the equation is the balance of energy
  // $E - E_{old} + (U - U_{old}) \cdot ((1 - a) F_{c,old} + a F_c) = 0$, which is checked.
  double
  advance(const double a)
  {
    U_old   = U;
    A_old   = A;
    F_c_old = F_c;
    U.add(dt, V, .5 * (1. - a) * dt * dt, A);
    U_hat = U;
    solve(2. / (a * dt * dt), .5 / a);
    V.add((1. - a) * dt, A_old, a * dt, A);
    F_c_old.sadd(1. - a, a, F_c);
    return F_c_old * U - F_c_old * U_old; // J
  }

  void
  run(RunFolder &folder)
  {
    make_matrices();
    for (unsigned int i = 0; i < U.size(); ++i) // at rest, half as long
      U(i) = .5 * (U.size() - 1 - i) * h;
    U_w = U;
    stiffness.vmult(residual, U);
    add_contact(1.);
    tangent.invert(mass);
    tangent.vmult(A, residual);
    A *= -1.;
    double time, kinetic, elastic, modified, balance, contact_work = 0.;
    double energy = .5 * stiffness.matrix_norm_square(U);
    const std::vector<std::tuple<std::string, std::string, double *>> columns =
      {{"time", "s", &time},
       {"kinetic_energy", "J", &kinetic},
       {"elastic_energy", "J", &elastic},
       {"energy", "J", &energy},
       {"modified_energy", "J", &modified},
       {"contact_work", "J", &contact_work},
       {"balance_residual", "1", &balance},
       {"contact_force_left", "N", &pressure},
       {"displacement_left", "m", &U(0)},
       {"velocity_left", "m/s", &V(0)}};
    EnergyLedger ledger(folder);
    for (const auto &[name, unit, value] : columns)
      ledger.add_column(name, unit);
    folder.begin();
    ledger.start();
    const double start_energy = energy, a = scheme == "midpoint" ? 1. : .5;
    for (unsigned int step = 0; step < final_time / dt + 1. - 1e-9; ++step)
      {
        const double work = step == 0 ? 0. : advance(a);
        time              = step * dt;
        kinetic           = .5 * mass.matrix_norm_square(V);
        elastic           = .5 * stiffness.matrix_norm_square(U);
        balance           = (kinetic + elastic - energy + work) / start_energy;
        energy            = kinetic + elastic;
        modified          = energy + potential;
        contact_work += work;
        std::vector<double> row;
        for (const auto &column : columns)
          row.push_back(*std::get<2>(column));
        ledger.add_row(row);
        folder.log("t = " + to_text(time) + " s, gap " + to_text(U(0)) + " m");
        if (!(std::abs(balance) <= 1e-9))
          folder.leave_open({"The energy balance does not close."});
      }
    ledger.write_hdf5();
  }
};

int
main(int argc, char **argv)
{
  return run_program<BarByHand>(
    argc,
    argv,
    "bar_by_hand",
    "1D-SD by hand: an elastic bar hits an obstacle.");
}
