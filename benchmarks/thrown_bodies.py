#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of a step of the elastic ball and the hyperelastic ring (paper A, tables
2 and 4), on one rank or several: seconds per step against unknowns, and their parts.

The timings come from the last lines of the programs' logs; start-up and set-up
are not part of them. The exponent is that of cost ~ unknowns^exponent between
the three largest meshes.
"""

import argparse
import pathlib

from measuring import exponent, measure

METHODS = [
    ("Signorini multipliers", ["Contact/Treatment=Signorini multipliers"]),
    ("persistent contact", ["Contact/Treatment=persistent contact"]),
    ("INC, alpha = 3", ["Contact/Treatment=improved normal compliance",
                        "Contact/Compliance exponent=3"]),
    ("SNC, alpha = 3", ["Contact/Treatment=standard normal compliance",
                        "Contact/Compliance exponent=3"]),
]

# Program, parameters, meshes, default final time; that of the papers.
BODIES = {
    "elastic_ball": (
        ["Time/Time step=0.01", "Start/Initial gap=15.05"],
        [[f"Mesh/Nodes={n}", f"Mesh/Boundary nodes={b}"]
         for n, b in ((25, 16), (96, 32), (392, 64), (1580, 128), (6260, 256))],
        2., 2.),
    "hyperelastic_ring": (
        ["Time/Time step=0.01"],
        [[f"Mesh/Nodes around={a}", f"Mesh/Nodes across={b}"]
         for a, b in ((32, 3), (64, 3), (128, 7), (256, 9), (512, 15))],
        1., 10.),
}

def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("--body", choices=BODIES, action="append",
                        help="only this one")
    parser.add_argument("--repeat", type=int, default=1,
                        help="runs of each; the fastest counts")
    parser.add_argument("--meshes", type=int, default=5,
                        help="only so many, counted from the finest")
    parser.add_argument("--whole-run", action="store_true",
                        help="to the papers' final time (the ring: 10 s)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of each run")
    arguments = parser.parse_args()
    for body in arguments.body or BODIES:
        parameters, meshes, final_time, whole = BODIES[body]
        program = str(pathlib.Path(arguments.build_dir) / body)
        print(f"\n{body}, dt = 0.01 s\n")
        print("| method | unknowns | steps | ms a step | residuals | tangents "
              "| factorisations | back-substitutions | exponent |")
        print("|---|---|---|---|---|---|---|---|---|")
        for name, method in METHODS:
            points = []
            for mesh in meshes[-arguments.meshes:]:
                end = whole if arguments.whole_run else final_time
                run = min((measure(program, parameters + method + mesh +
                                   [f"Time/Final time={end}"],
                                   n_ranks=arguments.ranks)
                           for _ in range(arguments.repeat)),
                          key=lambda run: run["seconds"])
                step = run["seconds"] / run["steps"]
                points.append((run["unknowns"], step))
                slope = ""
                if mesh is meshes[-1] and len(points) >= 3:
                    slope = f"{exponent(points[-3:]):.2f}"

                def share(key):
                    return f"{100 * run[key] / run['seconds']:.0f} %"

                print(f"| {name} | {run['unknowns']} | {run['steps']} "
                      f"| {1e3 * step:.2f} | {share('residuals')} "
                      f"| {share('tangents')} | {run['factorisations']}: "
                      f"{share('factorising')} | {share('substituting')} "
                      f"| {slope} |", flush=True)


if __name__ == "__main__":
    main()
