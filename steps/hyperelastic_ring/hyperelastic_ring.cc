// SPDX-License-Identifier: LGPL-2.1-or-later

// # The hyperelastic ring
//
// A soft ring, 1 m thick and with an outer radius of 10 m, is thrown at a rigid
// foundation under 45 degrees. It flattens by several metres, rebounds, and
// goes on vibrating and turning. This is the second benchmark of paper A
// (section 6.2) and of paper B (section 6.2, with viscosity and friction). It
// has the contact treatments of the elastic ball, and three things that the
// ball does not have: large strains, friction, and viscosity. The introduction
// of the program elastic_ball comes first.
//
// ## The problem
//
// Strains and rotations are large, so that linear elasticity will not do: a
// ring that only turns would be strained. The small strain is replaced by a
// measure that is invariant under rotations. With the deformation gradient $F =
// I + \nabla u$, all derivatives and integrals being on the undeformed ring,
// that is $C = F^T F$, and the energy per volume is a function of it (A 6.2),
//
// $$ W = c_1 (I_1 - 3) + c_2 (I_2 - 3) + d (I_3 - 1)
//      - (c_1 + 2 c_2 + d) \ln I_3 , $$
//
// with $I_1 = \mathrm{tr}\, C$, $I_2 = \tfrac12 (I_1^2 - \mathrm{tr}\, C^2)$
// and $I_3 = \det C$: Ciarlet and Geymonat's law, which the papers call Ogden's
// (`lib/materials/laws/ciarlet_geymonat.h`). For small strains it is linear
// elasticity with $\mu = 2 (c_1 + c_2)$ and $\lambda = 4 (c_2 + d)$. The
// equation of motion is
//
// $$ \rho\, \ddot u - \mathrm{Div} (F S) = 0, \qquad
//    S = 2 \frac{\partial W}{\partial C} + S_v, $$
//
// with the second Piola-Kirchhoff stress $S$, of which $S_v$ is the viscous
// part: $S_v = 2 \eta \dot C$ by Curnier,
// $\eta\, [\mathrm{tr}\, C - 3]_+ \dot C$ by Pioletti (B (2.14), not clipped there). In plane
// stress $C_{33}$ follows from the condition that there is no stress across the
// sheet, $\partial W / \partial C_{33} = 0$, which has a closed solution here
// (with trace and determinant of the in-plane part of $C$):
//
// $$ C_{33} = \frac{c_1 + 2 c_2 + d}{c_1 + c_2 \mathrm{tr}\, C + d \det C} . $$
//
// On the outer circle there is contact with the half plane below $x_2 = 0$,
// with the gap $g = x_2 + u_2$ and a pressure $p$ per undeformed area, and
// **Coulomb's friction**: the traction $t$ of the foundation along its surface
// is at most $\mu p$, and where the ring slips, with the velocity $v_\tau$, it
// is that much and against the slip (A (2.2), B (2.1)),
//
// $$ |t| \le \mu p, \qquad t = -\mu p \, \frac{v_\tau}{|v_\tau|}
//    \;\text{ if } v_\tau \ne 0 . $$
//
// ## Weak form
//
// For all $v$ (B (2.29), (2.30), with our signs)
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int F S : \nabla v \, dx
//    - \int_\Gamma \big( p\; \nu \cdot v + t \cdot v_\tau \big) \, ds = 0 . $$
//
// ## The scheme: Gonzalez' stress
//
// Only a time scheme that knows the stored energy keeps it. Over a step from
// $C_0$ to $C_1$, with $\Delta C = C_1 - C_0$, the midpoint scheme takes the
// stress (A (3.7), B (3.2); `lib/materials/gonzalez.h`)
//
// $$ S = 2 W'(C_m) + 2\, \frac{W(C_1) - W(C_0) - W'(C_m) : \Delta C}
//    {\Delta C : \Delta C} \, \Delta C, \qquad C_m = \tfrac12 (C_0 + C_1) . $$
//
// The first term alone would be right for small steps. The second one corrects
// it along $\Delta C$, so that $S : \tfrac12 \Delta C = W(C_1) - W(C_0)$ for
// any step. (The mean is that of $C_0$ and $C_1$, not $F_m^T F_m$ of the mean
// $F_m$. Where $\Delta C$ is nearly zero the quotient is left out.) The force
// acts with $F_m$, and since the symmetric part of $F_m^T (F_1 - F_0)$ is
// exactly $\tfrac12 \Delta C$, the work of $F_m S$ over the step is the change
// of the stored energy (A (3.8)). The rate of the viscous stress is
// $\dot C = \Delta C / \Delta t$, by the same identity its dissipation is
// $\Delta t\, \eta |\dot C|^2$ per volume, and never negative.
//
// ## One step of this program
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    - \sum_j w_j \big( p_j N_j + T_j t_j \big) = 0, \qquad
//    \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2}, $$
//
// where $F_{int}$ is the force of $F_m S$
// (`lib/discretization/hyperelastic_bulk.cc`), $p_j$ follows from the gaps of
// both ends of the step by the treatment, as in the elastic ball, and $t_j$
// from the slip of the step $\Delta s$ (a vector along the foundation, $T_j$
// puts it in the rows of the node): either exactly,
//
//     stick   slip = 0, |t| <= mu p
//     slip    t = -mu p (slip)/|slip|
//
// by active sets (persistent contact, two-step, Signorini active set; B (5.7),
// with the sets of Hüeber, Stadler and Wohlmuth 2008), or by a tangential
// compliance $c_\tau$ (the others; A (2.11)):
// $t = -c_\tau\, \Delta s / \Delta t$ as long as that is below $\mu p$, as
// above otherwise. In the code $-t$ has the sign of the internal forces
// (`lib/contact/laws/coulomb_friction.h`). Multiply by $U_1 - U_0$:
//
//     E_1 - E_0 = - work against contact - work against friction - viscous part
//
// The last two are never negative. The first is zero with persistent contact,
// and the change of a potential with improved normal compliance: so every
// change of the energy at the impact is due to the contact method.
//
// ## Numbers
//
// The printed start, 90 m above the foundation, would fill nine of the ten
// seconds with flight. The default gap is small, five steps and a half. The
// unit of $c_\nu$ is not printed either: the penetrations of paper A's table 3
// with $\alpha = 2$ and with $\alpha = 3$ both follow from 8e11 Pa/m^(alpha-1),
// which is the default here (as_printed.prm has 1000 MPa; figure A-T3 scans the
// readings).
//
// ## Run it
//
//     hyperelastic_ring parameter_files/hyperelastic_ring/default.prm
//     hyperelastic_ring parameter_files/hyperelastic_ring/default.prm --set "Contact/Friction coefficient=0.2"
//     hyperelastic_ring --help
//
// coarse.prm of the same folder is the ring with a few nodes, for trying
// things.

#include <base/program.h>
#include <problems/thrown_body.h>

#include <deal.II/distributed/shared_tria.h>

using namespace dealii;
using namespace Ricochet;

class HyperelasticRing
{
public:
  HyperelasticRing();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const
  {
    return parameters.unused_parameters();
  }

  void
  run(RunFolder &folder);

private:
  void
  make_grid(Triangulation<2> &triangulation) const;

  static constexpr double             inner_radius = 9.;  // m
  static constexpr double             outer_radius = 10.; // m
  static constexpr types::boundary_id outer_circle = 0;
  static constexpr types::boundary_id inner_circle = 1;

  ThrownBodyParameters parameters;
  unsigned int         n_nodes_around = 128;
  unsigned int         n_nodes_across = 13;
  bool                 touches_itself = false;
};



// ## Data
HyperelasticRing::HyperelasticRing()
{
  parameters.initial_gap      = .55;
  parameters.initial_velocity = Tensor<1, 2>({10., -10.});

  parameters.material.law          = "Ciarlet-Geymonat";
  parameters.material.plane_state  = "plane stress";
  parameters.material.density      = 1000.;
  parameters.material.values["c1"] = .5e6;
  parameters.material.values["c2"] = 5e3;
  parameters.material.values["d"]  = .35e6;

  ImpactParameters &impact = parameters.impact;
  impact.time.final_time   = 10.;
  impact.time.time_step    = 1e-2;
  impact.time.fields_every = 20;
  impact.scheme.name       = "midpoint";

  // Stiff contact of a soft body: full steps of Newton's method converge,
  // though not monotonically, and shortened ones stagnate.
  impact.newton.max_iterations    = 60;
  impact.newton.line_search_after = 40;

  impact.contact.treatment = "improved normal compliance";
  impact.contact.values["Compliance coefficient"] = 8e11;
  impact.contact.values["Compliance exponent"]    = 2.;
  impact.contact.values["Tangential compliance"]  = 1e9;
  impact.contact.values["Augmentation"]           = 3e6;
  impact.contact.values["Penalty epsilon0"]       = 3e-8;
}



void
HyperelasticRing::add_parameters(ParameterHandler &prm)
{
  parameters.add_parameters(prm);
  prm.enter_subsection("Mesh");
  prm.add_parameter("Nodes around",
                    n_nodes_around,
                    "Number of vertices on each circle.",
                    Patterns::Integer(8));
  prm.add_parameter("Nodes across",
                    n_nodes_across,
                    "Number of circles of vertices, the boundaries included.",
                    Patterns::Integer(2));
  prm.leave_subsection();
  prm.enter_subsection("Contact");
  prm.add_parameter(
    "Self",
    touches_itself,
    "Self-contact of the ring: its circles touch each other and "
    "themselves, by the same treatment as the foundation. In papers A and B "
    "contact is with the foundation only.",
    Patterns::Bool());
  prm.leave_subsection();
}



void
HyperelasticRing::validate() const
{
  parameters.validate();
  if (touches_itself)
    check_pair_combination(parameters.impact.contact,
                           scheme_traits(parameters.impact.scheme.name),
                           {/* is_self */ true});
  parameters.impact.check_size(2. * n_nodes_around * n_nodes_across *
                                 parameters.degree * parameters.degree,
                               2);
  // The construction of the mesh checks its parameters.
  Triangulation<2> triangulation;
  make_grid(triangulation);
}



// ## Mesh
//
// The reference position is the one at the start, so that the displacement
// begins with zero and the gap is the second coordinate: $g = x_2 + u_2$.
void
HyperelasticRing::make_grid(Triangulation<2> &triangulation) const
{
  make_ring(Point<2>(0., outer_radius + parameters.initial_gap),
            inner_radius,
            outer_radius,
            n_nodes_around,
            n_nodes_across,
            parameters.shape(),
            triangulation);
}



// ## The run
//
// The rest is the same for every thrown body, see
// `lib/problems/thrown_body.cc`. Without friction the momentum along the
// foundation is constant; off contact so is the angular momentum,
// although the ring turns and vibrates: $F_m S$ has a symmetric $S$ and does
// not turn the ring as a whole.
//
// With `Contact/Self` the two circles are surfaces that touch themselves: each
// node is kept from penetrating the facets that it faces, by the same
// treatment. Both sides of such a contact move, see the program
// colliding_disks.
void
HyperelasticRing::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_grid(triangulation);

  // The names of the circles, for the columns of the energy table.
  std::map<types::boundary_id, std::string> touching_itself;
  if (touches_itself)
    touching_itself = {{outer_circle, "outer_circle"},
                       {inner_circle, "inner_circle"}};
  throw_body(parameters, triangulation, outer_circle, folder, touching_itself);
}



int
main(int argc, char **argv)
{
  return run_program<HyperelasticRing>(
    argc,
    argv,
    "hyperelastic_ring",
    "A soft ring is thrown at a rigid foundation (papers A "
    "and B, section 6.2).");
}
