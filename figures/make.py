#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
"""Make figures of the papers: run what is missing, draw, and check the numbers.

    figures/make.py C-6          one figure (several names may be given)
    figures/make.py all
    figures/make.py short        those whose runs take little time: most of the ball, bars, sphere
    figures/make.py timed        those that show seconds, which "all" leaves out
    figures/make.py all --keep   and put small copies and the checks into figures/kept/
    figures/make.py --list
    figures/make.py --table      write the table of the papers' numbers in doc/benchmarks.md

Images, checks.csv and index.html go to output/figures/, runs to output/runs/.
The last lines are a table of our numbers beside the paper's and the exact ones;
the exit code is 1 if one of them is off, and 2 if a figure could not be made.
"""

import argparse
import fcntl
import os
import pathlib
import sys

from shared import interpreter

interpreter.need("numpy", "matplotlib", "vtkmodules")

import matplotlib  # noqa: E402

matplotlib.use("Agg")

from shared import CHECKOUT, finding, making, numbers_table, runs  # noqa: E402

from ricochet import RicochetError  # noqa: E402


def command_line(figures):
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument(
        "names", nargs="*", metavar="FIGURE", help="a name such as C-6, or all, short, timed"
    )
    parser.add_argument("--list", action="store_true", help="list the figures and stop")
    parser.add_argument(
        "--table", action="store_true", help="write the table in doc/benchmarks.md and stop"
    )
    parser.add_argument(
        "--build-dir",
        type=pathlib.Path,
        default=CHECKOUT / "build" / "release",
        help="folder with the programs (default: build/release of the checkout)",
    )
    parser.add_argument(
        "--keep",
        action="store_true",
        help="put small copies of the pictures, the tables and the checks into figures/kept, which "
        "the site of a fresh clone shows, with today's date and the commit",
    )
    parser.add_argument("--force", action="store_true", help="repeat runs that are there already")
    parser.add_argument(
        "--jobs",
        type=int,
        default=os.cpu_count() or 1,
        help="runs at the same time (default: the number of cores)",
    )
    arguments = parser.parse_args()
    if arguments.list or arguments.table:
        return arguments
    if not arguments.names:
        parser.error("name a figure, or all; --list shows the names")
    if arguments.jobs < 1:
        parser.error("--jobs must be at least 1")
    unknown = [name for name in arguments.names if name not in ("all", "short", "timed", *figures)]
    if unknown:
        parser.error(f"no figure {', '.join(unknown)}; there are {', '.join(figures)}")
    return arguments


def chosen(figures, names):
    """The figures that are called by their names or as a group."""
    return [
        figure
        for name, figure in figures.items()
        if name in names
        or ("timed" if figure.timed else "all") in names
        or ("short" in names and figure.is_short)
    ]


def make_locked(figures, arguments):
    """Make the figures, unless another process does; returns the exit code."""
    runs.OUTPUT.mkdir(exist_ok=True)
    with open(runs.OUTPUT / ".figures.lock", "w", encoding="utf-8") as lock:
        # Two processes would write into the same folders.
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            print("Another figures/make.py is at work in this checkout.", file=sys.stderr)
            return 2
        good = making.make(
            figures, arguments.build_dir.resolve(), arguments.jobs, arguments.force, arguments.keep
        )
    return 0 if good else 1


def main():
    try:
        figures = finding.find()
        arguments = command_line(figures)
        if arguments.list:
            for figure in figures.values():
                print(f"{figure.name:<6} {figure.title}")
            return 0
        if arguments.table:
            numbers_table.write()
            return 0
        return make_locked(chosen(figures, arguments.names), arguments)
    except RicochetError as error:
        print(error, file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("Interrupted; what has finished is kept.", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
