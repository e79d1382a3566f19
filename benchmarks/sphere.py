#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of the soft sphere (paper C, 4.3; Nitsche's method, Crank-Nicolson).

First the whole run on the paper's mesh; then a fall and the first steps in contact
on meshes of several sizes, on one and two ranks, with the solver that the program
chooses by itself (timings are those of the first rank); then the same with multigrid up
to 300 000 unknowns, with exponent of the cost of a step, and memory (largest resident
size of the process) per unknown.
"""

import argparse
import pathlib

from measuring import exponent, measure

# All of the run on the paper's mesh.
WHOLE = "parameter_files/sphere/default.prm"
FALL = ["Time/Final time=7.5"]
MULTIGRID = ["Linear solver/Type=multigrid"]


def row(name, run, n_ranks):
    def share(key):
        return f"{100 * run[key] / run['seconds']:.0f} %"

    print(f"| {name} | {run['solver']} | {n_ranks} | {run['unknowns']} | {run['steps']} "
          f"| {1e3 * run['seconds'] / run['steps']:.0f} "
          f"| {1e3 * run['seconds'] / run['iterations']:.0f} | {share('residuals')} "
          f"| {share('tangents')} | {run['factorisations']}: {share('factorising')} "
          f"| {share('substituting')} | {run['seconds']:.1f} | {run['memory']:.0f} |",
          flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("--quick", action="store_true",
                        help="meshes of at most 90 000 unknowns")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.build_dir) / "sphere")
    print("| run | solver | ranks | unknowns | steps | ms a step | ms an iteration "
          "| residuals | tangents | factorisations | solves | s in steps | MB |")
    print("|---|---|---|---|---|---|---|---|---|---|---|---|---|")
    for solver in ([], MULTIGRID):
        row("whole", measure(program, solver, WHOLE), 1)
    for size in (4, 3, 2):
        for n_ranks in (1, 2):
            row(f"h = {size}", measure(program, FALL + [f"Mesh/Mesh size={size}"],
                                       n_ranks=n_ranks), n_ranks)
    points = []
    for size in (4, 3, 2) if arguments.quick else (4, 3, 2, 1.5, 1.28):
        run = measure(program, FALL + MULTIGRID + [f"Mesh/Mesh size={size}"])
        row(f"h = {size}", run, 1)
        points.append(run)
    slope = exponent([(run["unknowns"], run["seconds"] / run["steps"]) for run in points])
    first, last = points[0], points[-1]
    memory = ((last["memory"] - first["memory"]) * 1024 /
              (last["unknowns"] - first["unknowns"]))
    print(f"\nmultigrid: cost of a step ~ unknowns^{slope:.2f}; memory {memory:.2f} kB for "
          f"each further unknown, {last['memory'] * 1024 / last['unknowns']:.2f} kB in all")


if __name__ == "__main__":
    main()
