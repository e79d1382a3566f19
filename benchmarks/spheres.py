#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of two bodies in 3D: the spheres of colliding_spheres just before they touch
and their first steps in contact (neo-Hookean, persistent contact) on meshes of several
sizes, on one and two ranks, with the solver that the program chooses by itself; with
exponent of the cost of a step, and memory of all ranks.
"""

import argparse
import pathlib

from measuring import exponent, measure

TOUCH = ["Spheres/Distance=2.001", "Time/Final time=0.016"]


def touching(mesh_size):
    """The parameters of both spheres with cells of this size (m)."""
    return TOUCH + [f"Spheres/Mesh size of the {side} sphere={mesh_size}"
                    for side in ("left", "right")]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("--quick", action="store_true",
                        help="meshes of at most 30 000 unknowns")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.build_dir) / "colliding_spheres")
    print("| mesh size | solver | ranks | unknowns | s a step | Newton iterations a step "
          "| residuals | tangents | factorisations | solves | MB |\n"
          "|---|---|---|---|---|---|---|---|---|---|---|")
    points = []
    for size in (.13, .09) if arguments.quick else (.09, .066, .046, .0415):
        for n_ranks in (1, 2):
            run = measure(program, touching(size), n_ranks=n_ranks)
            print(f"| {size} | {run['solver']} | {n_ranks} | {run['unknowns']} "
                  f"| {run['seconds'] / run['steps']:.2f} "
                  f"| {run['iterations'] / run['steps']:.1f} | " +
                  " | ".join(f"{100 * run[key] / run['seconds']:.0f} %" for key in
                             ("residuals", "tangents", "factorising", "substituting")) +
                  f" | {run['memory']:.0f} |", flush=True)
            if n_ranks == 1:
                points.append((run["unknowns"], run["seconds"] / run["steps"]))
    print(f"\ncost of a step ~ unknowns^{exponent(points):.2f}")


if __name__ == "__main__":
    main()
