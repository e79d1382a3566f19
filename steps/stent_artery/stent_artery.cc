// SPDX-License-Identifier: LGPL-2.1-or-later

// # A stent in an artery
//
// A longitudinal section, in plane stress, of a soft tube and of a stent that
// is pressed against its wall: two deformable bodies, both of which move, with
// friction. This is the last example of paper B (section 7), whose text prints no lengths and no
// path but "towards the walls of the artery": one wall, and a motion along it, too, are ours. The
// programs hyperelastic_ring (material, Gonzalez' stress, friction) and
// colliding_disks (gap between bodies) explain these parts; new is a prescribed
// motion, and its work.
//
// ## The problem
//
// In wall and stent, both Ciarlet-Geymonat materials, the stent 400 times
// stiffer,
//
// $$ \rho\, \ddot u - \mathrm{Div} (F S) = 0 , $$
//
// between the inner wall and the upper side of the stent **persistent contact**
// (B (2.10)) and Coulomb's friction (B (2.1)),
//
// $$ g > 0: \; p = 0, \qquad
//    g = 0: \; \dot g \ge 0, \; p \ge 0, \; p\, \dot g = 0, \qquad
//    |t| \le \mu p \;\text{ against the slip} . $$
//
// The outer side and the ends of the artery are held, and the lower side of the
// stent is moved by
//
// $$ u = (1.0,\, 0.4)\, r(t) \;\mathrm{mm}, \qquad r = 3 t^2 - 2 t^3 , $$
//
// from rest to rest in one second. Units are mm, N, MPa, s and tonnes, so
// energies are in mJ = N mm: any consistent system does, and the labels of the
// library, which are those of SI units, mean the ones of this system.
//
// ## Weak form
//
// For all $v$ that are zero where the displacement is prescribed (B (2.29)),
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int F S : \nabla v \, dx
//    - \sum_j w_j \big( p_j \delta g_j(v) + t_j \delta s_j(v) \big) = 0 . $$
//
// The nodes $j$ of the wall are the slave points. Each faces a facet of the
// stent, with the gap $g_j$ in front of it or behind it; along the facet it has
// slipped by $s_j$.
//
// ## One step of this program
//
// With the midpoint scheme (B (3.4)), Gonzalez' stress (B (3.2)) in $F_{int}$,
// and rows with $D \cdot \Delta x = \Delta g$ and $T \cdot \Delta x = \Delta s$
// (`lib/contact/surfaces/facet_chain.h`):
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    - \sum_j w_j \big( p_j D_j + t_j T_j \big) = R, \qquad
//    \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} . $$
//
// $R$ is zero except in the prescribed unknowns: there $U_1$ is known, and $R$
// is the residual of the equation, the force that moves the stent. Which nodes
// may touch is decided once in a step: those whose gap in the middle of the
// step is not positive, if the rate of the step before goes on (B (3.7), 5.3),
// and, which B does not have, those that were pressed in the step before. For
// them $\Delta g \ge 0$, $p \ge 0$ and $p\, \Delta g = 0$, by active sets
// within Newton's method (B 5.3). Multiplied by $U_1 - U_0$:
//
//     E_1 - E_0 = R . (U_1 - U_0)     work of the imposed displacement
//                 - friction - viscosity
//
// Persistent contact does no work, so it has no term. The balance closes to the
// tolerance of Newton's method in each step, also when nodes slide over the
// vertices of the stent: this is the column `balance_residual` of energy.csv,
// over the largest energy so far (at first there is next to none, so that the
// quotient begins larger).
//
// ## Run it
//
//     stent_artery parameter_files/stent_artery/default.prm
//     stent_artery --set "Contact/Friction coefficient=0.2"
//     stent_artery --print-parameters

#include <base/exceptions.h>
#include <base/program.h>
#include <materials/material_parameters.h>
#include <output/part_columns.h>
#include <problems/impact_loop.h>
#include <problems/part_meshes.h>

#include <deal.II/distributed/shared_tria.h>

#include <cstdio>

using namespace dealii;
using namespace Ricochet;

class StentArtery
{
public:
  StentArtery();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  /// The displacement of the lower side of the stent (mm) at a time (s).
  Tensor<1, 2>
  deployment(const double time) const;

  ImpactParameters    impact;
  MaterialParameters  artery, stent;
  StentArteryGeometry geometry;
  double              radial = .4, axial = 1., duration = 1.;
};



// ## Data
//
// Both laws have $\mu = 2 (c_1 + c_2)$ and $\lambda = 4 (c_2 + d)$ at small
// strains: about 1 MPa and 1.4 MPa for the wall.
StentArtery::StentArtery()
{
  artery.section      = "Artery";
  artery.law          = "Ciarlet-Geymonat";
  artery.plane_state  = "plane stress";
  artery.density      = 1e-9;
  artery.values["c1"] = .5;
  artery.values["c2"] = .005;
  artery.values["d"]  = .35;

  stent              = artery;
  stent.section      = "Stent";
  stent.values["c1"] = 200.;
  stent.values["c2"] = 2.;
  stent.values["d"]  = 140.;

  impact.time.final_time   = 1.;
  impact.time.time_step    = 1. / 50.;
  impact.time.fields_every = 5;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment = "persistent contact";
  impact.contact.values["Compliance coefficient"] =
    1e5; // The numbers of B's c_nu
  impact.contact.values["Tangential compliance"] =
    100.; // and c_tau of active sets.
  impact.contact.values["Augmentation"]     = 5.;
  impact.contact.values["Penalty epsilon0"] = 1e-5;
}



void
StentArtery::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  impact.contact.add_pair_parameters(prm);
  artery.add_parameters(prm);
  stent.add_parameters(prm);

  prm.enter_subsection("Geometry");
  const auto length =
    [&](const std::string &name, double &value, const std::string &text) {
      prm.add_parameter(name, value, text, Patterns::Double());
    };
  const auto number =
    [&](const std::string &name, unsigned int &value, const std::string &text) {
      prm.add_parameter(name, value, text, Patterns::Integer(1, 100000));
    };
  length("Artery length", geometry.artery_length, "Length of the wall (mm).");
  length("Artery thickness",
         geometry.artery_thickness,
         "Thickness of the wall (mm).");
  number("Artery nodes along",
         geometry.artery_nodes_along,
         "Nodes along the wall.");
  number("Artery nodes across",
         geometry.artery_nodes_across,
         "Nodes through the wall.");
  length("Stent begin",
         geometry.stent_begin,
         "Where the stent begins along the wall (mm).");
  length("Stent length", geometry.stent_length, "Length of the stent (mm).");
  length("Stent thickness",
         geometry.stent_thickness,
         "Thickness of the stent, vertically (mm).");
  number("Stent nodes along",
         geometry.stent_nodes_along,
         "Nodes along the stent.");
  number("Stent nodes across",
         geometry.stent_nodes_across,
         "Nodes through the stent.");
  length("Gap",
         geometry.gap,
         "Distance of the crests of the stent from the wall (mm).");
  length("Strut height",
         geometry.strut_height,
         "Amplitude of the wave of the stent (mm).");
  number("Struts", geometry.n_struts, "Number of waves of the stent.");
  prm.leave_subsection();

  prm.enter_subsection("Deployment");
  prm.add_parameter("Radial displacement",
                    radial,
                    "How far the lower side of the stent moves towards the "
                    "wall (mm).");
  prm.add_parameter("Axial displacement",
                    axial,
                    "How far it moves along the wall meanwhile (mm); without, "
                    "everything sticks already with little friction.");
  prm.add_parameter("Duration",
                    duration,
                    "How long it takes (s); it begins and ends at rest.",
                    Patterns::Double(1e-30));
  prm.leave_subsection();
}



void
StentArtery::validate() const
{
  check_pair_combination(impact.contact, scheme_traits(impact.scheme.name));
  for (const MaterialParameters *material : {&artery, &stent})
    {
      material->validate(2, impact.scheme.name);
      impact.validate(material->is_linear(), material->velocity_force());
    }
  impact.check_size(2. *
                      (static_cast<double>(geometry.artery_nodes_along) *
                         geometry.artery_nodes_across +
                       static_cast<double>(geometry.stent_nodes_along) *
                         geometry.stent_nodes_across),
                    2);
  Triangulation<2> triangulation;
  make_stent_artery(geometry, triangulation);
}



std::vector<UnusedParameter>
StentArtery::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  for (const auto &own :
       {artery.unused_parameters(), stent.unused_parameters()})
    unused.insert(unused.end(), own.begin(), own.end());
  return unused;
}



// ## The deployment
//
// $r = 3 t^2 - 2 t^3$ begins and ends at rest, so that nothing is hit by the
// start.
Tensor<1, 2>
StentArtery::deployment(const double time) const
{
  const double part = std::min(time / duration, 1.);
  return part * part * (3. - 2. * part) * Tensor<1, 2>({axial, radial});
}



// ## The run
void
StentArtery::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_stent_artery(geometry, triangulation);

  // Two parts in one mesh; conditions that hold and move them; the surfaces
  // that may touch. The wall is the softer one and the slave, though its mesh
  // is the coarser one: stiff nodes, two or three to a facet, would hold it in
  // too many places. The ends of the stent belong to its surface: a node of the
  // wall that slides off the upper side, which in the end is higher than the
  // wall was, would else be found below it a little later.
  const Material<2> wall_material  = artery.make<2>();
  const Material<2> stent_material = stent.make<2>();
  ImpactSetup<2>    setup{wall_material};
  setup.parts.push_back({"artery", wall_material, artery.density});
  setup.parts.push_back({"stent", stent_material, stent.density});
  setup.clamped = {StentArteryGeometry::artery_outer_side,
                   StentArteryGeometry::artery_ends};
  setup.imposed[StentArteryGeometry::stent_lower_side] = {
    {{true, true}},
    [this](const double time, const Point<2> &) { return deployment(time); }};
  setup.pairs = {
    {"wall",
     {StentArteryGeometry::artery_inner_wall},
     {StentArteryGeometry::stent_upper_side, StentArteryGeometry::stent_ends}}};
  Impact<2> assembly(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " cells, " + std::to_string(assembly.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", mu = " +
             to_text(impact.contact.values["Friction coefficient"]));

  // Both begin at rest.
  const State initial_state = assembly.state_of_parts();

  ImpactLoop<2>        loop(impact.time,
                     assembly,
                     {wall_material, stent_material},
                     {{StentArteryGeometry::artery_inner_wall, "wall"}},
                     folder);
  const PartColumns<2> parts(assembly.body,
                             assembly.system,
                             wall_material.linear.has_value(),
                             {"artery", "stent"});
  parts.add_to(loop);

  loop.run(initial_state);

  // Numbers for comparison with other programs.
  const EnergyLedger &ledger = loop.energy_ledger();
  for (const std::string name : {"imposed_work",
                                 "viscous_dissipation",
                                 "friction_work",
                                 "energy",
                                 "contact_force_wall"})
    {
      char line[80];
      std::snprintf(line,
                    sizeof(line),
                    "%-20s %16.8e",
                    name.c_str(),
                    ledger.rows().back()[ledger.column_number(name)]);
      folder.log(line);
    }
}



int
main(int argc, char **argv)
{
  return run_program<StentArtery>(
    argc,
    argv,
    "stent_artery",
    "A stent is pressed against the wall of an artery: paper B, section 7.");
}
