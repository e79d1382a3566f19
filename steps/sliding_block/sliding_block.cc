// SPDX-License-Identifier: LGPL-2.1-or-later

// # A block on a strip
//
// An elastic block slides, under its weight, along an elastic strip that is
// held below and may be a slope: two deformable bodies with Coulomb's friction.
// The expected results are those of a rigid block, computed by hand. Gap and
// forces between bodies are explained in the program colliding_disks.
//
// ## The problem
//
// In block and strip, with a stress that is linear in the strain $C - I$ (Saint
// Venant and Kirchhoff) and some viscosity (Curnier, $S_v = 2 \eta \dot C$),
//
// $$ \rho\, \ddot u - \mathrm{Div} (F S) = \rho\, b, \qquad
//    b = \bar g \, (\sin \beta, -\cos \beta) , $$
//
// where $\bar g$ is gravity's acceleration: the strip lies along $x$, and a
// slope of the angle $\beta$ turns gravity instead. Below the strip $u = 0$.
// Between both $g \ge 0$, $p \ge 0$, $p\, g = 0$ or its like, and Coulomb's
// friction (A (2.2), B (2.1)) for the traction $t$ along the strip,
//
// $$ |t| \le \mu p, \qquad t = -\mu p \,\frac{\dot s}{|\dot s|}
//    \;\text{ if the slip rate } \dot s \ne 0 . $$
//
// Seen as a rigid body, the block slides down a slope if $\mu < \tan \beta$,
// with the acceleration $\bar g (\sin \beta - \mu \cos \beta)$, and rests
// otherwise; on the level it is slowed down by $\mu \bar g$. A block of many
// elements must reproduce that: its underside is pressed unevenly, and each
// node sticks or slips on its own.
//
// ## Weak form
//
// $$ \int \rho\, \ddot u \cdot v \, dx + \int F S : \nabla v \, dx
//    - \sum_j w_j (p_j \delta g_j(v) + t_j \delta s_j(v))
//    = \int \rho\, b \cdot v \, dx . $$
//
// ## One step of this program
//
// With the midpoint scheme, rows $D$ and $T$ of each node of the underside on
// its own coordinates and on those of the facet below it,
// $D \cdot \Delta x = \Delta g$ and $T \cdot \Delta x = \Delta s$:
//
// $$ M \frac{V_1 - V_0}{\Delta t} + F_{int}(U_0, U_1)
//    = \sum_j w_j \big( p_j D_j + t_j T_j \big) + L, \qquad
//    \frac{U_1 - U_0}{\Delta t} = \frac{V_0 + V_1}{2} . $$
//
// With persistent contact (the default) $p$ and $t$ are unknowns in each node,
// and the equations for them are chosen by active sets (B section 5; Hüeber,
// Stadler and Wohlmuth 2008):
//
//     no contact   p = 0,  t = 0
//     stick        dg = 0, ds = 0          while |t - r ds| < mu p
//     slip         dg = 0, t = -mu p ds/|ds|
//
// with any $r > 0$. The work of friction over the step is
// $-t\, \Delta s \ge 0$: it is zero in nodes that stick and $\mu p |\Delta s|$
// in those that slip. Multiplied by $U_1 - U_0$ the equation is the row of the
// energy table,
//
//     E_1 - E_0 = work of gravity - friction - viscosity
//
// The weight acts at once, and the vibrations that it excites do not decay: the
// midpoint rule keeps them all. So there is some viscosity by default; without,
// a block stops late.
//
// ## Run it
//
//     sliding_block parameter_files/sliding_block/default.prm
//     sliding_block --set "Slope/Tangent=0.5" --set "Start/Initial velocity=0"
//     sliding_block --print-parameters
//
// and look at the column slide_block of energy.csv, the displacement of the
// centre.

#include <base/exceptions.h>
#include <base/program.h>
#include <materials/material_parameters.h>
#include <output/part_columns.h>
#include <problems/impact_loop.h>
#include <problems/part_meshes.h>

#include <deal.II/distributed/shared_tria.h>

#include <cmath>

using namespace dealii;
using namespace Ricochet;

class SlidingBlock
{
public:
  SlidingBlock();

  void
  add_parameters(ParameterHandler &prm);

  void
  validate() const;

  std::vector<UnusedParameter>
  unused_parameters() const;

  void
  run(RunFolder &folder);

private:
  void
  make_grid(Triangulation<2> &triangulation) const;

  ImpactParameters   impact;
  MaterialParameters material;
  double             block_length = 1., block_height = .5;
  double             strip_length = 4., strip_height = .5;
  double             begin       = .5;
  unsigned int       block_cells = 8, strip_cells = 26;
  double             gravity = 9.81, slope = 0., initial_velocity = 2.;
};



// ## Data
SlidingBlock::SlidingBlock()
{
  material.law                     = "Saint Venant-Kirchhoff";
  material.plane_state             = "plane strain";
  material.density                 = 1000.;
  material.values["Young modulus"] = 1e7;
  material.values["Poisson ratio"] = .3;
  material.viscosity               = "Curnier";
  material.viscosity_eta           = 1e4;

  impact.time.final_time   = .5;
  impact.time.time_step    = 2e-3;
  impact.time.fields_every = 10;
  impact.scheme.name       = "midpoint";

  impact.contact.treatment                        = "persistent contact";
  impact.contact.values["Friction coefficient"]   = .3;
  impact.contact.values["Compliance coefficient"] = 1e9;
  impact.contact.values["Tangential compliance"]  = 1e6;
  impact.contact.values["Augmentation"]           = 1e7;
  impact.contact.values["Penalty epsilon0"]       = 1e-8;
}



void
SlidingBlock::add_parameters(ParameterHandler &prm)
{
  impact.add_parameters(prm);
  impact.contact.add_pair_parameters(prm);
  material.add_parameters(prm);
  prm.enter_subsection("Block");
  const auto length =
    [&](const std::string &name, double &value, const std::string &text) {
      prm.add_parameter(name, value, text, Patterns::Double(1e-30));
    };
  length("Length", block_length, "Length of the block (m).");
  length("Height", block_height, "Height of the block (m).");
  prm.add_parameter("Cells",
                    block_cells,
                    "Number of cells along the block; they are squares or "
                    "nearly so.",
                    Patterns::Integer(1, 10000));
  prm.leave_subsection();
  prm.enter_subsection("Strip");
  length("Length", strip_length, "Length of the strip (m).");
  length("Height", strip_height, "Height of the strip (m).");
  prm.add_parameter("Cells",
                    strip_cells,
                    "Number of cells along the strip.",
                    Patterns::Integer(1, 10000));
  prm.leave_subsection();
  prm.enter_subsection("Slope");
  prm.add_parameter("Tangent",
                    slope,
                    "Tangent of the angle of the slope, which falls along x.");
  prm.add_parameter("Gravity",
                    gravity,
                    "Acceleration of gravity (m/s^2).",
                    Patterns::Double(0.));
  prm.leave_subsection();
  prm.enter_subsection("Start");
  prm.add_parameter("Position",
                    begin,
                    "Where the block begins along the strip (m).",
                    Patterns::Double(0.));
  prm.add_parameter("Initial velocity",
                    initial_velocity,
                    "Velocity of the block along the strip (m/s).");
  prm.leave_subsection();
}



void
SlidingBlock::validate() const
{
  check_pair_combination(impact.contact, scheme_traits(impact.scheme.name));
  material.validate(2, impact.scheme.name);
  impact.validate(material.is_linear(), material.velocity_force());
  if (begin + block_length > strip_length)
    throw InputError(
      "The block would begin beyond the end of the strip: "
      "Start/Position + Block/Length = " +
      to_text(begin + block_length) +
      " m is more than Strip/Length = " + to_text(strip_length) + " m.");
  impact.check_size(2. * block_cells * block_cells * block_height /
                        block_length +
                      2. * strip_cells * strip_cells * strip_height /
                        strip_length,
                    2);
  Triangulation<2> triangulation;
  make_grid(triangulation);
}



std::vector<UnusedParameter>
SlidingBlock::unused_parameters() const
{
  std::vector<UnusedParameter> unused = impact.unused_parameters();
  const auto                   own    = material.unused_parameters();
  unused.insert(unused.end(), own.begin(), own.end());
  return unused;
}



// ## Mesh
//
// Part 0 is the block, part 1 the strip; both touch at $y = 0$.
void
SlidingBlock::make_grid(Triangulation<2> &triangulation) const
{
  const auto cells =
    [](const double length, const double height, const unsigned int along) {
      return std::array<unsigned int, 2>{
        {along,
         static_cast<unsigned int>(
           std::max(1., std::round(along * height / length)))}};
    };
  make_rectangles({{Point<2>(begin, 0.),
                    Point<2>(begin + block_length, block_height),
                    cells(block_length, block_height, block_cells),
                    0.,
                    Tensor<1, 2>()},
                   {Point<2>(0., -strip_height),
                    Point<2>(strip_length, 0.),
                    cells(strip_length, strip_height, strip_cells),
                    0.,
                    Tensor<1, 2>()}},
                  CellShape::quadrilaterals,
                  triangulation);
}



// ## The run
void
SlidingBlock::run(RunFolder &folder)
{
  parallel::shared::Triangulation<2> triangulation(folder.communicator);
  make_grid(triangulation);

  const Material<2> elastic = material.make<2>();
  ImpactSetup<2>    setup{elastic};
  setup.parts.push_back(
    {"block", elastic, material.density, Tensor<1, 2>({initial_velocity, 0.})});
  setup.parts.push_back({"strip", elastic, material.density});
  setup.clamped = {rectangle_side(1, Rectangle::lower)};
  // The block is the slave, whose nodes carry $p$ and $t$: they stay above the
  // strip, whose ends the block does not reach.
  const types::boundary_id underside = rectangle_side(0, Rectangle::lower);
  setup.pairs = {{"block", {underside}, {rectangle_side(1, Rectangle::upper)}}};
  // Gravity of a slope of the angle $\beta$,
  // $b = \bar g (\sin \beta, -\cos \beta)$.
  const double angle = std::atan(slope);
  setup.gravity = gravity * Tensor<1, 2>({std::sin(angle), -std::cos(angle)});
  Impact<2> assembly(impact, triangulation, setup, folder.communicator);
  folder.log(std::to_string(triangulation.n_global_active_cells()) +
             " cells, " + std::to_string(assembly.body.owned_indices().size()) +
             " unknowns, " + impact.contact.treatment + ", mu = " +
             to_text(impact.contact.values["Friction coefficient"]));

  const State initial_state = assembly.state_of_parts();

  ImpactLoop<2>        loop(impact.time,
                     assembly,
                     {elastic, elastic},
                     {{underside, "block"}},
                     folder);
  const PartColumns<2> parts(assembly.body,
                             assembly.system,
                             elastic.linear.has_value(),
                             {"block", "strip"});
  parts.add_to(loop);
  // Displacement of the block: its momentum, with displacements for velocities,
  // over its mass.
  const double mass =
    parts.momenta(0).linear(assembly.uniform(Tensor<1, 2>({1., 0.})))[0];
  loop.add_column("slide_block", "m", [&](const State &state) {
    return parts.momenta(0).linear(state.solution)[0] / mass;
  });

  loop.run(initial_state);
}



int
main(int argc, char **argv)
{
  return run_program<SlidingBlock>(
    argc,
    argv,
    "sliding_block",
    "An elastic block slides along an elastic strip, or down a slope.");
}
