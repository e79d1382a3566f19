#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Cost of the contact examples of the public code smith (LLNL, formerly serac;
examples/contact/ of its repository) at their size, with inertia: examples/twisted_cubes.prm
(their "twist"), examples/ball_on_block.prm ("sphere") and ironing.prm. Steps are of the length of
theirs unless --step says otherwise. Seconds are those of the processor, so that other
jobs on the machine do as little harm as may be; they include the start of the program.
"""

import argparse
import pathlib

from measuring import measure

HERE = pathlib.Path(__file__).resolve().parent
# Time of their code for a step on 4 ranks (s), measured elsewhere.
CASES = {"examples/twisted_cubes": ("twist", 1.2),
         "examples/ball_on_block": ("sphere", 3.2),
         "benchmarks/ironing": ("ironing", .8)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build-dir", default="build/release")
    parser.add_argument("names", nargs="*", help="default: " + ", ".join(CASES))
    parser.add_argument("--step", help="length of a step (s)")
    arguments = parser.parse_args()
    program = str(pathlib.Path(arguments.build_dir) / "ricochet")
    print("| case | unknowns | step (s) | steps | Newton iterations a step | solver "
          "| CPU s a step, 1 rank | theirs, 4 ranks (s) | MB |\n"
          "|---|---|---|---|---|---|---|---|---|")
    for name in arguments.names or CASES:
        run = measure(program,
                      [f"Time/Time step={arguments.step}"] if arguments.step else [],
                      str(HERE.parent / f"{name}.prm"))
        theirs, seconds = CASES[name]
        print(f"| {name.split('/')[1]} ({theirs}) | {run['unknowns']} | {arguments.step or 1} "
              f"| {run['steps']} | {run['iterations'] / run['steps']:.1f} "
              f"| {run['solver']} | {run['cpu'] / run['steps']:.2f} | {seconds} "
              f"| {run['memory']:.0f} |", flush=True)


if __name__ == "__main__":
    main()
