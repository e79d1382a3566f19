#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Static cases of other codes and of theory: their numbers and those of Ricochet.

    examples/verification/verification.py                all of them, and the table
    examples/verification/verification.py patch_equal    some of them
    examples/verification/verification.py --write        with the table in doc/verification.md

Prints a table in Markdown; the exit code is 1 if a number is out of its bound or a run fails.
"""

import argparse
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
MARKS = ("<!-- verification: begin -->", "<!-- verification: end -->")

# A quantity, the number that it must have, its bound relative to that, and what was found.
Number = namedtuple("Number", "what expected bound found")


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


JOINTS = [f"{k} and {k + 1}" for k in range(1, 9)] + ["left foot", "right foot"]

# Source, function, file and options.
CASES = {
    "patch_equal": ("smith, contact patch: equal meshes", patch_equal),
    "patch_unequal": ("smith, contact patch: 4 cells against 3", patch_unequal),
    "beam": ("smith, contact beam: nodes in front of facets", beam),
    "hertz_4c": ("4C, half cylinder on a base", hertz_4c),
    "hertz_asimov": ("asimov-contact, Hertz at four loads", hertz_asimov),
    "hertz_ball": ("Hertz 1882, ball on a half space", hertz_ball),
    "lame": ("Lamé 1852, ring under pressure", lame),
    "shrink_fit": ("Lamé 1852, shrink fit", shrink_fit),
    "cook": ("Cook 1974, membrane", cook),
    "capstan": ("Euler 1762, capstan", capstan),
    "twist": ("smith, cubes pressed and turned by 90 degrees", twist),
    "ironing": ("ironing, mirror image by hand", ironing),
    "slope": ("by hand, block at rest on a slope", slope),
    "stack": ("by hand, stack at rest", stack),
    "arch": ("Heyman 1966, arch at rest", arch),
}
# Variants of examples that move.
VARIANTS = {
    "arch": ("../arch.prm",
             ["Time/Scheme=static", "Time/Final time=0.1", "Time/Time step=0.05"] +
             [f"Contact {joint}/Treatment=standard normal compliance" for joint in JOINTS]),
}
QUICK = ("patch_equal", "beam", "hertz_4c", "hertz_ball", "lame", "shrink_fit", "ironing", "slope",
         "stack", "arch")


def compute(name, programs, output):
    """Run a case. @return its numbers. Raises RuntimeError if the run fails."""
    file, settings = VARIANTS.get(name, (f"{name}.prm", []))
    folder = pathlib.Path(output) / name
    result = check.run_file(HERE / file, programs, folder, settings)
    if result.returncode != 0:
        raise RuntimeError(f"{name} ended with exit code {result.returncode}:\n{result.stderr}")
    return CASES[name][1](Run(folder))


def is_good(number):
    return abs(number.found - number.expected) <= number.bound * abs(number.expected)


def table_row(name, number):
    off = abs(number.found / number.expected - 1.)
    return (f"| {CASES[name][0]} | {number.what} | {number.expected:.7g} | "
            f"{number.found:.7g} | {off:.1e} | {number.bound:.1g} |")


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="default: all")
    parser.add_argument("--programs", default=ROOT / "build" / "release", type=pathlib.Path,
                        help="folder of the built programs")
    parser.add_argument("--output", default=ROOT / "output" / "verification",
                        type=pathlib.Path, help="folder for the runs")
    parser.add_argument("--write", action="store_true",
                        help="write the table of all cases into doc/verification.md")
    options = parser.parse_args()
    for name in options.names:
        if name not in CASES:
            parser.error(f"there is no case '{name}'. There are: " + ", ".join(CASES))
    lines = ["| case | quantity | must be | is | off by | bound |", "|---|---|---|---|---|---|"]
    print("\n".join(lines))
    n_bad = 0
    for name in options.names or CASES:
        try:
            numbers = compute(name, options.programs, options.output)
        except (OSError, RuntimeError, KeyError) as error:
            n_bad += 1
            print(f"{name}: {error}")
            continue
        for number in numbers:
            n_bad += not is_good(number)
            lines.append(table_row(name, number) + ("" if is_good(number) else " **off**"))
            print(lines[-1], flush=True)
    if options.write and not options.names:
        text = PAGE.read_text(encoding="utf-8")
        begin, end = (text.index(mark) for mark in MARKS)
        PAGE.write_text(text[:begin] + MARKS[0] + "\n\n" + "\n".join(lines) + "\n\n" + text[end:],
                        encoding="utf-8")
    print(f"{n_bad} numbers or runs are off." if n_bad else "All numbers are within their bounds.")
    return 1 if n_bad else 0


if __name__ == "__main__":
    sys.exit(main())
