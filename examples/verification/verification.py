#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cases of other codes and of theory, static and dynamic: their numbers and those of Ricochet.

    examples/verification/verification.py                all of them, and the table
    examples/verification/verification.py patch_equal    some of them
    examples/verification/verification.py --write        with the tables in doc/verification.md
                                                         and all numbers in doc/verification.csv

Prints a table in Markdown; the exit code is 1 if a number is out of its bound or a run fails.
"""

import argparse
import csv
import math
import pathlib
import sys
from collections import namedtuple

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
sys.path[:0] = [str(ROOT / "python"), str(HERE.parent)]

import check  # noqa: E402
from ricochet import Run  # noqa: E402

PAGE = ROOT / "doc" / "verification.md"
LIST = PAGE.with_suffix(".csv")
MARKS = ("<!-- verification: begin -->", "<!-- verification: end -->")

# A quantity, the number that it must have, its bound relative to that, what was found, and what
# the other code has found where that is not the number that it must have.
Number = namedtuple("Number", "what expected bound found theirs", defaults=(None,))

# A name, the place where data and numbers come from, and the function of a run that gives them.
Case = namedtuple("Case", "title source numbers")


def last(run, column):
    return float(run.table[column][-1])


def chosen_points(grid):
    """Numbers and places of points, each node once. Nodes of two bodies may coincide; one body
    has no number."""
    places = np.array([grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())])
    part = grid.GetPointData().GetArray("part")
    first = {}
    for i, place in enumerate(places):
        first.setdefault((*np.round(place, 9), part.GetTuple1(i) if part else 0), i)
    chosen = list(first.values())
    return chosen, places[chosen]


def nodes(run, step=-1):
    """Places of the nodes before the deformation."""
    return chosen_points(run.fields(step))[1]


def nodal(run, name, step=-1):
    """Values of a field at the nodes."""
    grid = run.fields(step)
    array = grid.GetPointData().GetArray(name)
    return np.array([array.GetTuple(i) for i in chosen_points(grid)[0]])


def patch_equal(run):
    return [Number("lateral stretch", 1.002446972592, 1e-10,
                   1. + last(run, "corner_displacement_x")),
            Number("Cauchy stress", -.003719196503, 1e-9, last(run, "middle_stress_zz")),
            Number("force", .003737420316, 1e-9, last(run, "contact_force_joint"))]


def patch_unequal(run):
    return [Number("lateral stretch", 1.002446972592, 1e-3,
                   1. + last(run, "corner_displacement_x")),
            Number("force", .003737420316, 1e-2, last(run, "contact_force_joint"))]


def beam(run):
    return [Number("norm of all nodal displacements", 1.5665, .01 / 1.5665,
                   float(np.linalg.norm(nodal(run, "displacement"))))]


def hertz_4c(run):
    return [Number("u_x(8, 0)", .0356246, 2e-3, last(run, "end_displacement_x")),
            Number("u_y(8, 0)", -.1380591, 2e-3, last(run, "end_displacement_y")),
            Number("force", 10., 1e-6, last(run, "resultant_y_joint"))]


def hertz_asimov(run):
    numbers = []
    for step, pressure in enumerate((3.306, 4.676, 5.727, 6.612), 1):
        load = 2.5 * step
        numbers += [Number(f"largest pressure, F = {load:g}", pressure, .03,
                           float(nodal(run, "contact_pressure", step).max())),
                    Number(f"force, F = {load:g}", load, 1e-6,
                           float(run.table["resultant_y_joint"][step]))]
    return numbers


def hertz_ball(run):
    force = 4. * last(run, "resultant_z_joint")
    modulus = 1000. / (1. - .3**2)
    width = (3. * force / (4. * modulus))**(1. / 3.)
    # Pressures of nodes scatter with their areas; they follow sqrt(1 - (r/a)^2).
    pressure = nodal(run, "contact_pressure")[:, 0]
    place = nodes(run)
    radius = np.hypot(place[:, 0], place[:, 1])
    on_ball = np.abs(np.hypot(radius, place[:, 2] - 1.) - 1.) < 1e-6
    inside = on_ball & (radius < .9 * width)
    profile = np.sqrt(1. - (radius[inside] / width)**2)
    return [Number("largest pressure", 3. * force / (2. * math.pi * width**2), .03,
                   float(pressure[inside] @ profile / (profile @ profile)))]


def lame(run):
    return [Number("inner displacement", 1.3e-3 * (.4 + 4.) / 3., 1e-3,
                   last(run, "inner_displacement_x")),
            Number("outer displacement", 2. * .91e-3 * 2. / 3., 1e-3,
                   last(run, "outer_displacement_x"))]


def shrink_fit(run):
    sides = (1. + .25) / (1. - .25) + (4. + 1.) / (4. - 1.)
    return [Number("pressure", .004 * 1000. / (1. - .3**2) / sides, 2e-3,
                   last(run, "contact_pressure_fit"))]


def cook(run):
    return [Number("displacement of the tip", 23.96, 1e-3, last(run, "tip_displacement_y"))]


def capstan(run):
    # The first step in which all of it slips.
    step = int(np.argmin(np.abs(run.table["time"] - 1.5)))
    return [Number("ratio of the tensions", math.exp(.3 * math.pi / 1.005), 3e-3,
                   -float(run.table["pull_force_y"][step]) / 10.)]


def at(run, column, time):
    return float(run.table[column][int(np.argmin(np.abs(run.table["time"] - time)))])


def twist(run):
    return [Number("force before the turn, between two bars by hand", .701, .013 / .701,
                   at(run, "contact_force_joint", 1.)),
            Number("force after the turn over that before", 1., 2e-3,
                   last(run, "contact_force_joint") / at(run, "contact_force_joint", 1.)),
            Number("energy after the turn over that before", 1., 5e-3,
                   last(run, "elastic_energy") / at(run, "elastic_energy", 1.))]


def ironing(run):
    return [Number("vertical force at the end over that at the start", 1., 1e-6,
                   last(run, "resultant_y_joint") / at(run, "resultant_y_joint", 1.)),
            Number("horizontal force at the end over that at the start", -1., 1e-5,
                   last(run, "resultant_x_joint") / at(run, "resultant_x_joint", 1.)),
            Number("energy at the end over that at the start", 1., 1e-6,
                   last(run, "elastic_energy") / at(run, "elastic_energy", 1.))]


def slope(run):
    return [Number("normal force", 9218.3846, 1e-6, last(run, "resultant_y_joint")),
            Number("friction", -3355.2176, 1e-6, last(run, "resultant_x_joint"))]


def stack(run):
    return [Number(f"force of the {name.replace('_', ' ')}", mass * 9.81, 1e-6,
                   last(run, f"resultant_z_{name}"))
            for name, mass in (("floor", 1500.), ("lower_joint", 1000.),
                               ("upper_joint", 500.))]


def arch(run):
    weight = check.stone_weight(.18)
    smallest, largest = (9. * weight * part for part in check.thrusts(.18))
    middle = .5 * (smallest + largest)
    numbers = [Number(f"force of the {side} foot", 4.5 * weight, 5e-3,
                      last(run, f"contact_force_{side}_foot")) for side in ("left", "right")]
    for k in range(4):
        phi = (k + 1) * math.pi / 9.
        thrust = (last(run, f"contact_force_{k + 1}_and_{k + 2}") -
                  (3.5 - k) * weight * math.cos(phi)) / math.sin(phi)
        numbers.append(Number(f"thrust in joint {k + 1}, within Heyman's bounds", middle,
                              .5 * (largest - smallest) / middle, thrust))
    return numbers


def touches(run, contact, force):
    """From when to when its force is more than half of this. A row has the force of the step
    before it."""
    on = np.flatnonzero(run.table[f"contact_force_{contact}"] > .5 * force)
    return float(run.table["time"][on[0] - 1]), float(run.table["time"][on[-1]])


def rebound(run, axis, body=""):
    """Momentum at the end over that at the start, the other way."""
    momentum = run.table[f"momentum_{axis}{body}"]
    return -float(momentum[-1] / momentum[0])


def energy_ratio(run):
    return last(run, "energy") / float(run.table["energy"][0])


# The front of a wave in linear cells is as wide as (h/L)^(2/3) of the way L that it has come, 5 %
# with 100 cells: the instant at which half of the force is there is right to a fifth of that.
FRONT = .01


def ansys_rod(run):
    speed, gap, length, young, density = 202.2, .01, 10., 3e7, .73e-3
    wave = math.sqrt(young / density)
    force = density * wave * speed
    begin, end = touches(run, "wall", force)
    return [Number("touches from (s)", gap / speed, 2. * FRONT, begin),
            Number("touches until (s)", gap / speed + 2. * length / wave, FRONT, end),
            Number("force in the middle of it (lbf)", force, FRONT,
                   at(run, "contact_force_wall", gap / speed + length / wave)),
            Number("velocity after over that before", 1., FRONT, rebound(run, "x"))]


def ansys_bar(run):
    return [Number("energy after over that before", 1., 1e-9, energy_ratio(run),
                   683.01 / 239.61),
            Number("velocity after over that before, with nu = 0.35", 1., .07,
                   rebound(run, "z"), 383.25 / 227.)]


def aster_bar(run):
    force = 8000. * 5000. * 100. * .02
    return [Number("near end at 40 us (m)", -2e-3, FRONT, at(run, "near_displacement_x", 4e-5),
                   -2.02899518e-3),
            Number("far end at 80 us (m)", -4e-3, FRONT, at(run, "far_displacement_x", 8e-5),
                   -4.07373647e-3),
            Number("force in the middle of it (N/m)", force, FRONT,
                   at(run, "contact_force_wall", 6e-5)),
            Number("touches until (s)", 1e-4, FRONT, touches(run, "wall", force)[1]),
            Number("kinetic energy after over that before", 1., FRONT,
                   last(run, "kinetic_energy") / float(run.table["energy"][0]), 2934.38 / 3200.)]


def aster_bars(run):
    meet, turn = 1e-5, 2. / math.sqrt(2e11 * .7 / (7800. * 1.3 * .4))

    def end(time):
        """Displacement of the end of the first bar: half of the velocity, back, all of it."""
        on = min(time - meet, turn)
        back = min(max(time - meet - turn, 0.), turn)
        return -meet - .5 * on + .5 * back + max(time - meet - 2. * turn, 0.)

    theirs = (-1.04999990e-4, -1.55408246e-4, -5.54082648e-5, 9.43019347e-5, 2.94450601e-4)
    return [Number(f"end of the first bar at {200 * k} us (m)", end(2e-4 * k), FRONT,
                   at(run, "end_displacement_x", 2e-4 * k), number)
            for k, number in enumerate(theirs, 1)]


def norma_bars(run):
    """Bounds are those of Norma's test, which asserts nothing of the velocity."""
    return [Number("elastic energy of the left bar at 1 us (J)", 5e-5, .06,
                   at(run, "elastic_energy_left", 1e-6)),
            Number("elastic energy of the right bar at 1 us (J)", 5e-5, .08,
                   at(run, "elastic_energy_right", 1e-6)),
            Number("stress at 1 us (Pa)", -1e8, .1, at(run, "left_stress_xx", 1e-6)),
            Number("velocity after over that before", 1., .05, rebound(run, "x", "_left"))]


def bouncing_bar(run):
    on = np.flatnonzero(np.diff(run.table["contact_force_floor"] > 100.))
    instants = [float(run.table["time"][i]) for i in on[:4]]
    return [Number(what, number, FRONT, found) for what, number, found in zip(
        ("meets the floor at (s)", "leaves it at (s)", "meets it again at (s)", "leaves it at (s)"),
        (1., 5. / 3., 11. / 3., 13. / 3.), instants)] + [
            Number("force in the middle of the first time", 400., FRONT,
                   at(run, "contact_force_floor", 4. / 3.)),
            # The fronts of both impacts leave energy in vibrations.
            Number("height at the end", 5., 4. * FRONT, 5. + last(run, "bar_displacement_y"))]


def column_with_damping(time, modes=400):
    """Force at the foot and elastic energy of the block of moose_block.prm, as a column that is
    held at its lower end, from when it touches: a sum over its modes."""
    young, density, gravity, delay, fall = 1e6, 10., 98.1, 1e-3, 1e-4
    k = (np.arange(modes) + .5) * math.pi
    omega = k * math.sqrt(young / density)
    share = 2. / k
    static = -share * gravity / omega**2
    root = np.sqrt((.25 * (delay * omega**2)**2 - omega**2).astype(complex))
    slow, fast = -.5 * delay * omega**2 + root, -.5 * delay * omega**2 - root
    first = (static * fast - share * math.sqrt(2. * gravity * fall)) / (slow - fast)
    parts = first * np.exp(slow * time), -(static + first) * np.exp(fast * time)
    place = (static + parts[0] + parts[1]).real
    velocity = (slow * parts[0] + fast * parts[1]).real
    return (-young * float(k @ (place + delay * velocity)),
            .25 * young * float(k**2 @ place**2))


def moose_block(run):
    # The first force is one of viscosity, and infinite.
    late = run.table["time"] > 3e-3
    exact = [column_with_damping(time) for time in np.arange(1.5e-3, 1e-2, 1e-5)]
    return [Number("largest pressure after 3 ms", max(force for force, _ in exact), FRONT,
                   float(run.table["contact_force_base"][late].max()), 1481.3012843712),
            Number("largest elastic energy", max(energy for _, energy in exact), FRONT,
                   float(run.table["elastic_energy"].max()), .38862994666022)]


def wedge(run):
    return [Number("force over weight", (.1 + .3) / (1. - .3 * .1), 1e-6,
                   last(run, "push_force_x") / last(run, "resultant_y_joint"), .412168)]


def aster_plate(run):
    place = nodes(run)
    node = int(np.argmin(np.hypot(place[:, 0] - .03875, place[:, 1])))
    return [Number(f"u_x of node {name} (m)", number, .05, last(run, f"{name}_displacement_x"))
            for name, number in zip("ABCDE", (2.86e-5, 2.72e-5, 2.28e-5, 1.98e-5, 1.5e-5))] + [
                Number("force of node R (N/m)", 1.04864e5, .01,
                       float(nodal(run, "contact_force")[node, 1]))]


def cattaneo(run):
    press, push = last(run, "resultant_y_joint"), abs(last(run, "resultant_x_joint"))
    width = math.sqrt(4. * press * 8. * (1. - .3**2) / (math.pi * 200.))
    pressure = 2. * press / (math.pi * width)
    place, pressures = nodes(run), nodal(run, "contact_pressure")[:, 0]
    # Both bodies have a node there, and the first surface has the pressure.
    middle = int(np.argmax(pressures * (np.hypot(place[:, 0], place[:, 1] + 8.) < 1e-6)))
    force = nodal(run, "contact_force")[middle]
    return [Number("pressure in the middle", pressure, .01, float(pressures[middle])),
            Number("shear in the middle over pressure",
                   .2 * (1. - math.sqrt(1. - push / (.2 * press))), .03,
                   abs(float(force[0] / force[1])))]


def sliding(run):
    acceleration = 9.81 * (.5 - .2 * math.sqrt(.75))
    mass, way = 80., .5 * acceleration * .25
    return [Number("way after 0.5 s (m)", way, 1e-4, last(run, "block_displacement_x")),
            Number("work of friction (J)", .2 * mass * 9.81 * math.sqrt(.75) * way, 1e-4,
                   last(run, "friction_work"))]


def rolling(run):
    velocity = run.table["momentum_x"] / run.table["momentum_x"][0]
    return [Number("velocity when it rolls over that before", 2. / 3., .01,
                   float(velocity[run.table["time"] > .2].mean())),
            Number("work of friction over the energy before", 1. / 3., .01,
                   last(run, "friction_work") / float(run.table["energy"][0]))]


def hertz_impact(run):
    speed, stiffness = .005, 4. / 3. * 1000. / (1. - .3**2)
    mass = -4. * float(run.table["momentum_z"][0]) / speed
    depth = (5. * mass * speed**2 / (4. * stiffness))**.4
    begin, end = touches(run, "floor", 0.)
    return [Number("largest force", stiffness * depth**1.5, .04,
                   4. * float(run.table["resultant_z_floor"].max())),
            Number("duration", 2.9432 * depth / speed, .05, end - begin),
            Number("velocity after over that before", 1., .002, rebound(run, "z"))]


def belt(run):
    speed, gravity = .5, 9.81
    return [Number("work of the belt (J)", 20. * speed**2, .01, last(run, "obstacle_work")),
            Number("work of friction (J)", 10. * speed**2, .01, last(run, "friction_work")),
            Number("slides behind the belt by (m)", speed**2 / (2. * .3 * gravity), .01,
                   speed * last(run, "time") - last(run, "suitcase_displacement_x"))]


def cradle(run):
    by_hand = check.chain_of_cylinders(5, .02, 1e7, .3, 1000., 1.)
    momentum = float(run.table["momentum_x"][0])
    return [Number("momentum of the last disk over all", by_hand[4], .01,
                   last(run, "momentum_x_disk_5") / momentum),
            Number("momentum at the end over that at the start", 1., 1e-11,
                   last(run, "momentum_x") / momentum),
            Number("energy at the end over that at the start", 1., 1e-11, energy_ratio(run))]


JOINTS = [f"{k} and {k + 1}" for k in range(1, 9)] + ["left foot", "right foot"]

SMITH = "LLNL's smith, src/smith/physics/tests/"
ASTER = "Code_Aster, astest/"
MAPDL = "Ansys, verification manual: github.com/ansys/pymapdl, ansys/mapdl/core/examples/verif/"

CASES = {
    "patch_equal": Case("smith, contact patch: equal meshes", SMITH + "contact_patch.cpp",
                        patch_equal),
    "patch_unequal": Case("smith, contact patch: 4 cells against 3", SMITH + "contact_patch.cpp",
                          patch_unequal),
    "beam": Case("smith, contact beam: nodes in front of facets", SMITH + "contact_beam.cpp", beam),
    "hertz_4c": Case("4C, half cylinder on a base", "4C, contact2D_hertz_linstatic_new_struct",
                     hertz_4c),
    "hertz_asimov": Case("asimov-contact, Hertz at four loads",
                         "asimov-contact, demo_hertzian_contact.py", hertz_asimov),
    "hertz_ball": Case("Hertz 1882, ball on a half space",
                       "K. L. Johnson, Contact Mechanics, 1985", hertz_ball),
    "lame": Case("Lamé 1852, ring under pressure", "by hand", lame),
    "shrink_fit": Case("Lamé 1852, shrink fit", "by hand", shrink_fit),
    "cook": Case("Cook 1974, membrane",
                 "R. D. Cook, Journal of the Structural Division 100, 1974", cook),
    "capstan": Case("Euler 1762, capstan", "by hand", capstan),
    "twist": Case("smith, cubes pressed and turned by 90 degrees",
                  "LLNL's smith, examples/contact/twist.cpp", twist),
    "ironing": Case("ironing, mirror image by hand",
                    "M. A. Puso, T. A. Laursen, Computer Methods in Applied Mechanics and "
                    "Engineering 193, 2004; LLNL's smith, examples/contact/ironing.cpp", ironing),
    "slope": Case("by hand, block at rest on a slope", "by hand", slope),
    "stack": Case("by hand, stack at rest", "by hand", stack),
    "arch": Case("Heyman 1966, arch at rest", "J. Heyman, The Stone Skeleton, 1966", arch),
    "wedge": Case("NAFEMS CGS-4, block pushed up a slope (FrontISTR)",
                  "gitlab.com/FrontISTR-Commons/FrontISTR, merge request 599", wedge),
    "aster_plate": Case("Code_Aster SSNV128, plate with friction",
                        ASTER + "ssnv128a.comm (V6.04.128)", aster_plate),
    "cattaneo": Case("Ansys VM272, Cattaneo and Mindlin, stick and slip", MAPDL + "vm272.dat",
                     cattaneo),
    "ansys_rod": Case("Ansys VM265, rod on a wall", MAPDL + "vm265.dat, after N. J. Carpenter, "
                      "R. L. Taylor, M. G. Katona, International Journal for Numerical Methods in "
                      "Engineering 32, 1991", ansys_rod),
    "ansys_bar": Case("Ansys, copper bar on a wall, 227 m/s",
                      "Ansys' help, release 24.2, ans_tec/tecmetalbarresults.html", ansys_bar),
    "aster_bar": Case("Code_Aster SDNV100, bar on a wall", ASTER + "sdnv100a.comm (V5.03.100)",
                      aster_bar),
    "aster_bars": Case("Code_Aster SDNL111, bar on a bar", ASTER + "sdnl111c.comm (V5.02.111)",
                       aster_bars),
    "norma_bars": Case("Norma.jl, two bars, nu = 0.25", "github.com/sandialabs/Norma.jl, "
                       "test/schwarz-contact-dynamic-bars-hex8.jl", norma_bars),
    "bouncing_bar": Case("Doyen, Ern, Piperno 2011, bouncing bar",
                         "SIAM Journal on Scientific Computing 33, doi.org/10.1137/100791440",
                         bouncing_bar),
    "moose_block": Case("MOOSE, a block settles", "github.com/idaholab/moose, modules/contact/test/"
                        "tests/explicit_dynamics/settlement.i", moose_block),
    "hertz_impact": Case("Hertz 1882, a ball hits a floor",
                         "K. L. Johnson, Contact Mechanics, 1985", hertz_impact),
    "sliding": Case("by hand, block sliding down a slope", "by hand", sliding),
    "rolling": Case("by hand, disk thrown along a floor", "by hand", rolling),
    "belt": Case("by hand, suitcase on a belt", "by hand", belt),
    "cradle": Case("Newton's cradle of disks", "point masses with the force between cylinders: "
                   "K. L. Johnson, Contact Mechanics, 1985", cradle),
}
# Files elsewhere, and what is set in them.
VARIANTS = {
    "arch": ("../arch.prm",
             ["Time/Scheme=static", "Time/Final time=0.1", "Time/Time step=0.05"] +
             [f"Contact {joint}/Treatment=standard normal compliance" for joint in JOINTS]),
    "norma_bars": ("../colliding_bars.prm",
                   [f"Body {bar}/{setting}" for bar in ("left", "right")
                    for setting in ("Poisson ratio=0.25", "Cells along=60, 2, 2")] +
                   ["Time/Final time=2.5e-6"]),
    "belt": ("../suitcase_on_belt.prm", []),
    "cradle": ("../newtons_cradle.prm", []),
}
# Cases in the suite.
QUICK = ("patch_equal", "beam", "hertz_4c", "hertz_ball", "lame", "shrink_fit", "ironing", "slope",
         "stack", "arch", "wedge", "aster_plate", "ansys_rod", "ansys_bar", "aster_bar",
         "aster_bars", "bouncing_bar", "moose_block", "sliding", "rolling")


def file_and_settings(name):
    return VARIANTS.get(name, (f"{name}.prm", []))


def compute(name, programs, output):
    """Run a case. @return its numbers. Raises RuntimeError if the run fails."""
    file, settings = file_and_settings(name)
    folder = pathlib.Path(output) / name
    result = check.run_file(HERE / file, programs, folder, settings)
    if result.returncode != 0:
        raise RuntimeError(f"{name} ended with exit code {result.returncode}:\n{result.stderr}")
    return CASES[name].numbers(Run(folder))


def is_good(number):
    return abs(number.found - number.expected) <= number.bound * abs(number.expected)


HEAD = ["| case | quantity | must be | theirs | is | off by | bound |",
        "|---|---|---|---|---|---|---|"]


def off_by(number):
    return abs(number.found / number.expected - 1.)


def table_row(name, number):
    theirs = "" if number.theirs is None else f"{number.theirs:.7g}"
    return (f"| {CASES[name].title} | {number.what} | {number.expected:.7g} | {theirs} | "
            f"{number.found:.7g} | {off_by(number):.1e} | {number.bound:.1g} |"
            + ("" if is_good(number) else " **off**"))


def table_of_sources():
    lines = ["| case | file | source |", "|---|---|---|"]
    for name, case in CASES.items():
        file, settings = file_and_settings(name)
        path = (HERE / file).resolve().relative_to(ROOT)
        lines.append(f"| {case.title} | `{path}`"
                     f"{' with other settings' if settings else ''} | {case.source} |")
    return lines


def write(found):
    """The tables into the page, and all numbers into the list."""
    text = PAGE.read_text(encoding="utf-8")
    begin, end = (text.index(mark) for mark in MARKS)
    parts = [text[:begin] + MARKS[0], "\n".join(HEAD + [table_row(*row) for row in found]),
             "\n".join(table_of_sources()), text[end:]]
    PAGE.write_text("\n\n".join(parts), encoding="utf-8")
    with open(LIST, "w", encoding="utf-8", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["case", "title", "source", "quantity", "must be", "theirs", "is", "off by",
                        "bound"])
        for name, number in found:
            table.writerow([name, CASES[name].title, CASES[name].source, number.what,
                            f"{number.expected:.10g}",
                            "" if number.theirs is None else f"{number.theirs:.10g}",
                            f"{number.found:.10g}", f"{off_by(number):.3g}",
                            f"{number.bound:.10g}"])


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    parser.add_argument("--programs", default=ROOT / "build" / "release", type=pathlib.Path,
                        help="folder of the built programs")
    parser.add_argument("--output", default=ROOT / "output" / "verification",
                        type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--write", action="store_true",
                        help="write the numbers of all cases into doc/verification.md and .csv")
    options = parser.parse_args()
    for name in options.names:
        if name not in CASES:
            parser.error(f"there is no case '{name}'. There are: " + ", ".join(CASES))
    print("\n".join(HEAD))
    found, n_bad = [], 0
    for name in options.names or CASES:
        try:
            numbers = compute(name, options.programs, options.output)
        except (OSError, RuntimeError, KeyError) as error:
            n_bad += 1
            print(f"{name}: {error}")
            continue
        for number in numbers:
            n_bad += not is_good(number)
            found.append((name, number))
            print(table_row(name, number), flush=True)
    if options.write and not options.names:
        write(found)
    print(f"{n_bad} numbers or runs are off." if n_bad else "All numbers are within their bounds.")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
